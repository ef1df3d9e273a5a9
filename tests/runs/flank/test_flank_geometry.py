"""Gear geometry along the path of contact: the published FZG numbers, closed forms, and what is refused."""

import dataclasses
import math

import pytest

from tehl_taichi.runs.flank.mesh import Mesh
from tehl_taichi.runs.flank.positions import positions_along
from tehl_taichi.scene import SceneError
from tehl_taichi.scene.gear_pair import GearPair, angle_of, gear_pair, inv

STEEL = 206e9 / (1 - 0.3**2)  # E' in Pa


def at_point(name, point, **options):
    return positions_along(Mesh(gear_pair(name)), at=(point,), **options)[0]


def hertz(position):
    return math.sqrt(position.load * STEEL / (2 * math.pi * position.R))


@pytest.mark.parametrize("name, eps_alpha, d_a1, d_a2", [("fzg-c", 1.438, 82.46e-3, 118.36e-3),
                                                         ("fzg-a", 1.361, 88.77e-3, 112.50e-3)])
def test_the_fzg_gears_have_their_published_geometry(name, eps_alpha, d_a1, d_a2):
    mesh = Mesh(gear_pair(name))
    assert math.degrees(mesh.alpha_w) == pytest.approx(22.44, abs=0.005)
    assert mesh.pair.distance_of_shifts == pytest.approx(91.5e-3, abs=1e-6)
    assert mesh.rho_C(1) == pytest.approx(13.97e-3, abs=5e-6) and mesh.rho_C(2) == pytest.approx(20.96e-3, abs=5.1e-6)
    assert at_point(name, "C").R == pytest.approx(8.38e-3, abs=5e-6)
    assert mesh.eps_alpha == pytest.approx(eps_alpha, abs=5e-4)
    assert (mesh.d_a(1), mesh.d_a(2)) == pytest.approx((d_a1, d_a2), abs=5.1e-6)


@pytest.mark.parametrize("torque, p_H", [(265.1, 1547e6), (215.6, 1395e6), (171.6, 1245e6), (70.0, 795e6)])
def test_type_c_has_its_published_hertz_pressures(torque, p_H):
    mesh = Mesh(dataclasses.replace(gear_pair("fzg-c"), torque=torque))
    assert hertz(positions_along(mesh, at=("C",))[0]) == pytest.approx(p_H, rel=5e-3)


@pytest.mark.parametrize("torque, p_H", [(372.6, 1539e6), (534.5, 1841e6)])
def test_type_a_has_its_published_hertz_pressures_with_one_pair(torque, p_H):
    mesh = Mesh(dataclasses.replace(gear_pair("fzg-a"), torque=torque, load_share=((-0.02, 1.0), (0.02, 1.0))))
    assert hertz(positions_along(mesh, at=("C",))[0]) == pytest.approx(p_H, rel=1e-2)


@pytest.mark.parametrize("name", ["fzg-c", "fzg-a"])
@pytest.mark.parametrize("on", ["pinion", "gear"])
def test_the_pitch_point_rolls(name, on):
    at = at_point(name, "C", on=on)
    mesh = Mesh(gear_pair(name))
    assert at.srr == 0 and at.u_a == at.u_b == mesh.omega[0] * mesh.rho_C(1) and at.x_pl == at.arc == 0


def test_a_driving_pinion_slides_from_root_to_tip_and_the_gear_mirrors_it():
    pinion, gear = (positions_along(Mesh(gear_pair("fzg-c")), on, 12) for on in ("pinion", "gear"))
    assert pinion[0].point == "A" and pinion[0].srr < 0 < pinion[-1].srr and pinion[-1].point == "E"
    assert gear[0].point == "E" and gear[0].srr < 0 < gear[-1].srr and gear[-1].point == "A"
    for one, other in zip(pinion, reversed(gear)):
        assert (one.point, one.srr, one.x_pl, one.R, one.load) == (other.point, -other.srr, -other.x_pl, other.R, other.load)
        assert (one.u_a, one.rho_a) == (other.u_b, other.rho_b)
    assert all(low.x_pl <= high.x_pl and low.arc <= high.arc for low, high in zip(pinion, pinion[1:]))


def test_radii_and_speeds_follow_the_line_of_action():
    pair = gear_pair("fzg-c")
    mesh, omega = Mesh(pair), 2 * math.pi * pair.n1 / 60
    line = pair.a_w * math.sin(mesh.alpha_w)  # between the interference points
    for at in positions_along(mesh, count=20):
        s = mesh.rho_C(1) + at.x_pl
        assert at.rho_a == pytest.approx(s) and at.rho_b == pytest.approx(line - s)
        assert at.R == pytest.approx(s * (line - s) / line)
        assert at.u_a == pytest.approx(omega * s) and at.u_b == pytest.approx(omega * 16 / 24 * (line - s))
        assert at.srr == pytest.approx((at.u_a - at.u_b) / at.u_m)
        assert at.arc == pytest.approx((s**2 - mesh.rho_C(1) ** 2) / (2 * mesh.r_b(1)), abs=1e-12)


def test_the_points_are_where_the_tips_and_the_base_pitch_put_them():
    mesh = Mesh(gear_pair("fzg-c"))
    s = {name: mesh.rho_C(1) + x for name, x in mesh.points.items()}
    line = mesh.rho_C(1) + mesh.rho_C(2)
    assert list(s) == ["A", "B", "C", "D", "E"]
    assert s["A"] == pytest.approx(line - math.sqrt((mesh.d_a(2) / 2) ** 2 - mesh.r_b(2) ** 2))
    assert s["E"] == pytest.approx(math.sqrt((mesh.d_a(1) / 2) ** 2 - mesh.r_b(1) ** 2))
    assert s["E"] - s["B"] == pytest.approx(math.pi * 4.5e-3 * math.cos(math.radians(20))) == s["D"] - s["A"]


def test_the_load_is_the_trapezoid_with_both_sides_of_its_jumps():
    mesh = Mesh(gear_pair("fzg-c"))
    full = 265.1 / (8 * 4.5e-3 * math.cos(math.radians(20))) / 14e-3
    load = {at.point: at.load / full for at in positions_along(mesh, count=7)}
    assert load == pytest.approx({"A": 1 / 3, "B-": 2 / 3, "B+": 1, "C": 1, "D-": 1, "D+": 2 / 3, "E": 1 / 3})
    A, B = mesh.points["A"], mesh.points["B"]
    assert positions_along(mesh, at=(0.5 * (A + B),))[0].load == pytest.approx(full / 2)


def test_a_table_of_shares_takes_the_place_of_the_trapezoid():
    table = ((-0.0096, 0.2), (-0.002, 0.4), (-0.002, 0.9), (0.0097, 0.5))
    mesh = Mesh(dataclasses.replace(gear_pair("fzg-c"), load_share=table))
    at = positions_along(mesh, at=(-0.002, 0.0))
    assert [round(p.load / mesh.full_load, 12) for p in at] == [0.4, 0.9, round(0.9 - 0.4 * 0.002 / 0.0117, 12)]


def test_positions_fill_the_widest_gaps_evenly():
    at = positions_along(Mesh(gear_pair("fzg-c")), count=40)
    ways = sorted({p.x_pl for p in at if p.point or abs(p.srr) > 0.05})
    steps = [high - low for low, high in zip(ways, ways[1:])]
    assert len(at) == 40 and max(steps) < 2 * min(steps) and {"A", "B-", "B+", "C", "D-", "D+", "E"} <= {p.point for p in at}


def test_a_position_on_each_side_of_the_pitch_point():
    """Where friction rises: with 3 % slip, from nine positions on, on both flanks; not where the table of shares is as fine."""
    mesh = Mesh(gear_pair("fzg-c"))
    for on in ("pinion", "gear"):
        at = positions_along(mesh, on, 9)
        n = [p.point for p in at].index("C")
        assert [p.srr for p in at[n - 1 : n + 2]] == pytest.approx([-0.03, 0.0, 0.03], rel=5e-3)
    assert [p.point for p in positions_along(mesh, count=8)].count("") == 1 and positions_along(mesh, count=8)[1].srr < -0.5
    pair = dataclasses.replace(gear_pair("fzg-c"), load_share=((-0.01, 0.5), (2e-4, 0.5), (2e-4, 1.0), (0.01, 1.0)))
    assert min(abs(p.srr) for p in positions_along(Mesh(pair)) if p.point != "C") < 0.026


def test_shifts_and_centre_distance_give_each_other():
    both = GearPair(x1=0.1817, x2=0.1715)
    assert both.a_w == pytest.approx(91.5e-3, abs=1e-6)
    assert GearPair(x1=0.1817, a_w=both.a_w).x2 == pytest.approx(0.1715, abs=1e-9)
    assert GearPair(x2=0.1715, a_w=both.a_w).x1 == pytest.approx(0.1817, abs=1e-9)
    assert GearPair().a_w == pytest.approx(0.5 * 40 * 4.5e-3)
    for angle in (0.05, 0.35, 0.9):
        assert angle_of(inv(angle)) == pytest.approx(angle, abs=1e-14)


def test_tips_thin_out_to_a_point_where_the_refusal_says():
    mesh = Mesh(GearPair())
    assert mesh.tip_thickness(1, 16 * 4.5e-3) == pytest.approx(math.pi * 4.5e-3 / 2)  # half a pitch on the pitch circle
    with pytest.raises(SceneError, match="pointed.*less than 0.0853") as error:
        Mesh(GearPair(d_a1=0.088))
    limit = float(str(error.value).split("less than ")[1].split()[0])
    assert mesh.tip_thickness(1, limit) == pytest.approx(0, abs=1e-7)


def test_helical_gears_by_the_transverse_section():
    pair = GearPair(z1=20, z2=60, m_n=3e-3, beta=20.0, x1=0.2, x2=0.1, b=30e-3, torque=500.0)
    mesh = Mesh(pair)
    beta_b = math.atan(math.tan(math.radians(20)) * math.cos(pair.alpha_t))  # the other formula of ISO 21771
    assert mesh.beta_b == pytest.approx(beta_b)
    rho_1, rho_2 = mesh.rho_C(1), mesh.rho_C(2)
    at = positions_along(mesh, at=("C",))[0]
    assert at.R == pytest.approx(rho_1 * rho_2 / (rho_1 + rho_2) / math.cos(beta_b))
    F_bn, length = 500.0 / mesh.r_b(1) / math.cos(beta_b), 30e-3 * mesh.eps_alpha / math.cos(beta_b)
    assert {p.load for p in positions_along(mesh, count=8)} == {at.load} and at.load == pytest.approx(F_bn / length)


@pytest.mark.parametrize("beta", [0.0, 20.0])
def test_teeth_without_backlash_fill_the_working_pitch_circle(beta):
    """Both transverse thicknesses there are one pitch, at the distance that the shifts give."""
    mesh = Mesh(GearPair(z1=20, z2=60, m_n=3e-3, beta=beta, x1=0.4, x2=0.1))
    d_w = [2 * mesh.r_b(wheel) / math.cos(mesh.alpha_w) for wheel in (1, 2)]
    assert sum(d_w) / 2 == pytest.approx(mesh.pair.a_w)
    assert sum(mesh.tip_thickness(wheel, d) for wheel, d in zip((1, 2), d_w)) == pytest.approx(math.pi * d_w[0] / 20)


@pytest.mark.parametrize("values, why", [
    ({"torque": 0}, "gear.torque = 0 N m is out of range; allowed: more than 0 N m"),
    ({"n1": -5.0}, "gear.n1 = -5 1/min is out of range"),
    ({"z1": 16.5}, "gear.z1 = 16.5 is not a whole number; allowed: 5 to 1000"),
    ({"x1": 0.2}, "gear.x1 alone does not determine the profile shifts; allowed: x1 and x2, or a_w with one of them"),
    ({"a_w": 91.5e-3}, "gear.a_w = 0.0915 m alone does not determine"),
    ({"a_w": 0.05, "x1": 0.1}, "gear.a_w = 0.05 m leaves no line of action; allowed: more than 0.0845"),
    ({"a_w": 0.093, "x1": 0.1817, "x2": 0.1715}, "contradict each other: without backlash they give 0.0915"),
    ({"x1": -2.0, "x2": -2.0}, "gear.x1 . x2 = -4 leaves no centre distance"),
    ({"beta": 20.0, "load_share": ((-1, 1), (1, 1))}, "gear.load_share applies to spur gears"),
    ({"load_share": ((1, 0.5), (-1, 0.5))}, "gear.load_share has 2 pairs; allowed: 2 to 1000 .*rising, or the same twice"),
    ({"load_share": ((-1, 0.5), (0, 0.5), (0, 0.6), (0, 0.7))}, "gear.load_share has 4 pairs"),
    ({"load_share": ((-1, 0.5), (1, 1.5))}, "a share of 1.5 is out of range; allowed: more than 0 and at most 1"),
])
def test_pairs_that_cannot_be_are_refused(values, why):
    with pytest.raises(SceneError, match=why):
        GearPair(**values)


@pytest.mark.parametrize("values, why", [
    ({"d_a2": 0.12}, "gear.d_a2 = 0.12 m: the tips of the gear reach .* beyond the involute .*less than 0.11"),
    ({"d_a1": 0.0735, "d_a2": 0.1095}, "contact ratio eps_alpha of 0.[0-9]+: the teeth lose contact; allowed: at least 1"),
    ({"d_a1": 0.06}, "gear.d_a1 = 0.06 m: the tips of the pinion lie inside its base circle; allowed: more than 0.0676"),
    ({"x1": 1.5, "x2": -0.5}, "teeth of the pinion are pointed"),
    ({"z1": 8}, "gear.d_a2 = .* m: the tips of the gear reach .*undercut"),
])
def test_teeth_that_do_not_mesh_are_refused(values, why):
    with pytest.raises(SceneError, match=why):
        Mesh(GearPair(**values))


def test_the_limits_of_the_refusals_hold():
    """Just inside the limit that a refusal names it meshes."""
    with pytest.raises(SceneError) as error:
        Mesh(GearPair(d_a2=0.12))
    limit = float(str(error.value).split("less than ")[1].split()[0])
    assert Mesh(GearPair(d_a2=limit - 1e-6)).points["A"] + Mesh(GearPair()).rho_C(1) == pytest.approx(0, abs=1e-5)
    high = GearPair(z1=60, z2=80, alpha_n=15.0, d_a1=0.285, d_a2=0.375)
    with pytest.raises(SceneError, match="eps_alpha = 3.38: .*less than 2, or give gear.load_share"):
        Mesh(high)
    assert Mesh(dataclasses.replace(high, load_share=((-0.1, 0.5), (0.1, 0.5)))).eps_alpha > 2


@pytest.mark.parametrize("options, why", [
    ({"on": "wheel"}, "on = 'wheel' is not known"),
    ({"count": 3}, "positions = 3 is out of range; allowed: 7 to 1000"),
    ({"at": ("F",)}, "the point 'F' is not on this flank; known: A, B, C, D, E"),
    ({"at": ("C+",)}, "the point 'C.' is not on this flank"),
    ({"at": (0.02,)}, "0.02 m is out of range; allowed: at least -0.0095.* m and at most 0.0095"),
])
def test_positions_that_are_not_on_the_flank_are_refused(options, why):
    with pytest.raises(SceneError, match=why):
        positions_along(Mesh(gear_pair("fzg-c")), **options)


def test_unknown_pairs_are_refused_with_the_nearest():
    with pytest.raises(SceneError, match="unknown gear pair 'fzg-b'.*did you mean 'fzg-[ac]'"):
        gear_pair("fzg-b")


def test_roughness_and_permissible_film_come_together():
    assert GearPair(Ra1=0.4e-6, Ra2=0.6e-6, lambda_GFP=0.2).Ra == pytest.approx(0.5e-6)
    with pytest.raises(SceneError, match="gear.Ra1 = 4e-07 m and gear.Ra2 = 0 m: the specific film needs both"):
        GearPair(Ra1=0.4e-6)
    with pytest.raises(SceneError, match="gear.lambda_GFP = 0.2 has no effect without gear.Ra1 and gear.Ra2"):
        GearPair(lambda_GFP=0.2)


def test_a_commented_gear_file_is_the_pair_again(tmp_path):
    from commands import here

    from tehl_taichi.runs.flank.flank_source import flank_source
    from tehl_taichi.values.quantity import kinds

    assert here("new", "pair.toml", "--gears", "--base", "fzg-a", cwd=tmp_path).returncode == 0
    text = (tmp_path / "pair.toml").read_text()
    assert flank_source(tmp_path / "pair.toml").pair == gear_pair("fzg-a")
    assert all(f"\n{key} = " in text and declared.about in text for key, declared in kinds(GearPair).items())
    assert here("new", "pair.toml", "--gears", cwd=tmp_path).returncode == 2, "it exists"
    refused = here("new", "other.toml", "--gears", "--scan", "scan.csv", cwd=tmp_path)
    assert refused.returncode == 2 and "--gears and --scan scan.csv contradict each other" in refused.stderr
    unknown = here("new", "other.toml", "--gears", "--base", "gear", cwd=tmp_path)
    assert unknown.returncode == 2 and "unknown gear pair 'gear'" in unknown.stderr


@pytest.mark.parametrize("on", ["pinion", "gear"])
def test_arcs_grow_as_fast_as_the_profile_passes_the_contact(on):
    """The contact moves along the line of action at omega r_b; surface a at u_a past it meanwhile, linear along the path."""
    mesh = Mesh(gear_pair("fzg-c"))
    places, v = positions_along(mesh, on, 40), mesh.omega[0] * mesh.r_b(1)
    for one, two in zip(places, places[1:]):
        passed = 0.5 * (one.u_a + two.u_a) * (two.x_pl - one.x_pl) / v
        assert two.arc - one.arc == pytest.approx(passed, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("on", ["pinion", "gear"])
def test_the_record_has_the_points_and_radii_of_its_positions(on, tmp_path):
    """Of the flank that carries the feature; radii at C are as the numbers of teeth, and give the speed and the force there."""
    from tehl_taichi.runs.flank.flank_run import describe
    from tehl_taichi.runs.flank.flank_source import flank_source

    found = flank_source("fzg-c")
    geometry, pair = describe(found, tmp_path, on)["geometry"], found.pair
    for at in found.positions(on, 7):
        assert at.x_pl == geometry["points_x_pl_m"][at.point.strip("+-")], at.point
    assert geometry["rho_C2_m"] / geometry["rho_C1_m"] == pytest.approx(pair.z2 / pair.z1)
    alpha_w = math.radians(geometry["alpha_w_deg"])
    assert geometry["rho_C1_m"] + geometry["rho_C2_m"] == pytest.approx(pair.a_w * math.sin(alpha_w))
    assert geometry["u_C_m_s"] == pytest.approx(2 * math.pi * pair.n1 / 60 * geometry["rho_C1_m"])
    assert geometry["F_bt_N"] * geometry["rho_C1_m"] / math.tan(alpha_w) == pytest.approx(pair.torque)
