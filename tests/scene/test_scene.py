"""Scenes: defaults, checks at the door, files."""

import math
import re

import numpy as np
import pytest

from tehl_taichi.scene import BUILT_INS, SceneError, scene, scene_file, scene_warnings
from tehl_taichi.scene.scales import Scales


def test_temperatures_come_with_slip_and_with_a_warm_inlet():
    assert not scene("gear").isothermal and not scene("addendum").isothermal and not scene("pitch-line").isothermal
    slow = scene("gear").replace(speed=0.5)
    assert not slow.isothermal and slow.replace(srr=0.0).isothermal
    assert not slow.replace(**{"srr": 0.0, "thermal.on": True}).isothermal
    assert scene("pitch-line").replace(**{"thermal.on": False}).isothermal
    assert scene("ridge-on-ball").replace(srr=-1.0).isothermal
    with pytest.raises(SceneError, match="auto"):
        scene("gear").replace(**{"thermal.on": "maybe"})


def test_gear_has_the_hertz_units_of_the_thesis():
    s = Scales.of(scene("gear"))
    assert s.a == pytest.approx(0.362e-3, rel=1e-3) and s.p_H == pytest.approx(1.934e9, rel=1e-3)


def test_srr_keeps_the_mean_speed():
    o = scene("gear").replace(srr=-0.2).operation
    assert (o.u_m, o.u_a, o.u_b) == pytest.approx((8.5, 7.65, 9.35)) and o.u_s < 0


def test_hertz_pressure_gives_back_its_load():
    s = scene("gear").replace(hertz_pressure=1.5e9)
    assert Scales.of(s).p_H == pytest.approx(1.5e9)
    assert scene("gear").replace(load=s.load).load == pytest.approx(s.load)


@pytest.mark.parametrize("M, L", [(20.0, 10.0), (200.0, 10.0)])
def test_moes_pair_comes_out(M, L):
    from tehl_taichi.scene.film_formula import moes_numbers

    s = moes(M, L)
    units = Scales.of(s)
    assert moes_numbers(s.load, units.R, units.E, 0.04, 2.2e-8, s.operation.u_m) == pytest.approx((M, L))


def moes(M, L):
    return scene("smooth-line").replace(**{"oil.name": "moes-test-fluid", "contact.load": 0.0, "contact.moes_M": M,
                                           "contact.moes_L": L})


@pytest.mark.parametrize("name", BUILT_INS)
def test_file_round_trip(name, tmp_path):
    path = tmp_path / "s.toml"
    path.write_text(scene_file.dumps(scene(name)))
    assert scene_file.load(path) == scene(name)


def test_file_with_a_base(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text('base = "gear"\n[operation]\nu_a = 8.0\nu_b = 9.0\n[contact]\nhertz_pressure = 1.2e9\n')
    s = scene_file.load(path)
    assert s.name == "mine" and s.operation.srr == pytest.approx(-1 / 8.5) and s.contact.load == 0
    assert s.features == scene("gear").features


def test_a_named_oil_replaces_that_of_the_base(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text('base = "gear"\n[oil]\nname = "moes-test-fluid"\nalpha = 2e-8\n')
    oil = scene_file.load(path).oil
    assert oil.viscosity == "roelands" and oil.alpha == 2e-8 and oil.expansion == "never"
    path.write_text('base = "gear"\n[oil]\nG0 = 4.0\n')
    assert scene_file.load(path).oil == scene("gear").replace(**{"oil.G0": 4.0}).oil


@pytest.mark.parametrize("key, value, words", [
    ("load", -1.0, "at least 0 N/m"), ("load", math.nan, "not a number"), ("load", math.inf, "finite"),
    ("speed", 0.0, "no film"), ("srr", 3.0, "at most 2"), ("temperature", 1e4, "deg C"), ("height", 1.0, "at most"),
    ("grid.nx", 100, "multiple of 16"), ("grid.nx", 64.5, "whole number"), ("oil.viscosity", "roeland", "roelands"),
    ("feature.hight", 1e-6, "height"), ("bodies.a.E", -1.0, "Pa"), ("thermal.nodes", 8, "odd"),
    ("feature.y", 1.0, "at most 0.03 m"), ("srr", -2.0, "never passes"), ("load", 1e9, "Hertz pressure"),
    ("contact.radius_y", 0.01, "line"), ("feature.shape", "map", ".csv, .txt, .asc, .npy"),
    ("feature.shape", "waviness", "extent_x"),
    ("time.x_start", -0.5, "steady start"), ("contact.kind", "elliptic", "a load of its own"),
    ("hertz_pressure", 0.3e9, "undeformed gap"), ("time.courant", 0.0, "at least"), ("sr", 0.1, "srr"),
])
def test_bad_values_are_refused_with_a_sentence(key, value, words):
    with pytest.raises(SceneError, match=words):
        scene("gear").replace(**{key: value})


def test_zero_entrainment_is_refused(tmp_path):
    path = tmp_path / "zero.toml"
    path.write_text('base = "gear"\n[operation]\nu_a = 5.0\nu_b = -5.0\n')
    with pytest.raises(SceneError, match="no entrainment"):
        scene_file.load(path)


def test_unknown_keys_name_the_nearest(tmp_path):
    path = tmp_path / "typo.toml"
    path.write_text('base = "gear"\n[operation]\ntemprature = 80\n')
    with pytest.raises(SceneError, match="temperature"):
        scene_file.load(path)
    with pytest.raises(SceneError, match="smooth-line"):
        scene("smoothline")


def test_features_that_are_alike_are_doubted_and_shown_once(tmp_path):
    np.savetxt(tmp_path / "m.csv", 200 * np.sin(np.arange(40) / 3)[:, None] * np.ones(60), delimiter=",")
    alike = {"shape": "map", "file": str(tmp_path / "m.csv"), "unit": "nm", "pixel": 5e-6}
    (tmp_path / "two.toml").write_text("\n".join(["base = 'gear'", *(
        "[[feature]]\n" + "\n".join(f"{key} = {value!r}" for key, value in {**alike, "x": x}.items()) for x in (0.0, -6e-4))]))
    two = scene_file.load(tmp_path / "two.toml")
    assert len(two.features) == 2
    for told in (two.warnings(), scene_warnings.preview(two)):
        assert any("m.csv" in line for line in told) and len(told) == len(set(told))


def test_a_cut_is_left_out_where_no_warning_tells_of_it():
    cut = scene("gear").replace(**{"time.steps": 4})
    assert [line for line in cut.left_out() if line not in cut.left_out(cut=False)] == [
        line for line in cut.left_out() if line.startswith("rest of the passage")]
    assert any("passage cut at" in sentence for sentence in cut.warnings())


def test_a_run_tells_of_a_cut_once():
    from tehl_taichi.runs import single_run
    from tehl_taichi.runs.progress import Progress

    said, progress = [], Progress()
    progress.say = progress.warn = said.append
    single_run._announce(scene("gear").replace(**{"time.steps": 4}), progress)
    assert sum("cut at" in line for line in said) == 1 and any(line.startswith("left out: half") for line in said)


def test_left_out_says_why():
    assert any("steady" in line or "no feature" in line for line in scene("smooth-line").left_out())
    assert any("friction" in line for line in scene("pitch-line").left_out())


def test_hertz_ellipse_is_the_circle_and_keeps_the_load():
    from tehl_taichi.scene import hertz

    a, b, p = hertz.ellipse(50.0, 0.01, 0.01 * (1 + 1e-5), 2e11)
    circle = hertz.point(50.0, 0.01, 2e11)
    assert (a, b, p) == pytest.approx((circle[0], circle[0], circle[1]), rel=1e-5)
    a, b, p = hertz.ellipse(50.0, 0.01, 0.06, 2e11)
    assert b > a and 2 * math.pi / 3 * p * a * b == pytest.approx(50.0)
    assert hertz.ellipse(50.0, 0.06, 0.01, 2e11) == pytest.approx((b, a, p))
    assert hertz.ellipse_load(p, 0.01, 0.06, 2e11) == pytest.approx(50.0)


def test_elliptic_integrals_against_quadrature():
    import numpy as np

    from tehl_taichi.scene.hertz import elliptic_integrals

    t, w = np.polynomial.legendre.leggauss(60)
    root = np.sqrt(1 - 0.9 * np.sin((t + 1) * math.pi / 4) ** 2)
    assert elliptic_integrals(0.9) == pytest.approx(((w / root).sum() * math.pi / 4, (w * root).sum() * math.pi / 4), rel=1e-12)


def test_long_features_start_earlier_and_end_later():
    short, long = scene("gear"), scene("gear").replace(width=1e-3)
    assert short.path == (-1.6, 1.4)
    assert long.path[0] + 0.5e-3 / Scales.of(long).a == pytest.approx(-1.3) and long.path[1] > 2.4


def test_rough_patch_has_its_rms_and_fades_out():
    import numpy as np

    f = scene("rough").features[0]
    x = np.linspace(-f.extent_x / 2, f.extent_x / 2, 301)
    s = f.height_at(x[None, :], x[:, None])
    inner = np.abs(x) < f.extent_x / 2 - f.taper
    assert s[np.ix_(inner, inner)].std() == pytest.approx(f.height, rel=0.3)
    assert np.abs(s[[0, -1]]).max() < 1e-12 and np.allclose(s, s[::-1])


def test_a_point_contact_must_fit_into_the_grid():
    with pytest.raises(SceneError, match="y_max = 1 b"):
        scene("ball-on-disc").replace(**{"grid.y_max": 1.0})


def test_thick_films_are_solved_in_single_precision():
    from tehl_taichi.pressure.precision import suited
    from tehl_taichi.scene.film_formula import central_film

    gear = scene("gear")
    assert central_film(gear) == pytest.approx(0.44e-6, rel=0.12)  # computed: 0.44 um isothermal
    assert suited(gear) == "f32" and suited(gear.replace(speed=0.05)) == "f64"
    ball = scene("ball-on-disc")
    assert central_film(ball) == pytest.approx(0.1356e-6, rel=0.03)  # computed
    assert central_film(ball.replace(speed=2 * ball.operation.u_m)) > 1.5 * central_film(ball)


def test_contacts_of_machines_are_those_of_their_commands():
    """Inner rings of the 6206 under 3 kN and of the 209 roller bearing under 4.45 kN at 3000 1/min; rigs at 1 GPa."""
    from tehl_taichi.runs.bearing.bearing_run import solve_mechanics
    from tehl_taichi.runs.bearing.bearing_source import bearing_source
    from tehl_taichi.runs.bearing.ring_scenes import base_of

    for name, which, load in (("ball-bearing", "6206", 3000.0), ("roller-bearing", "209-roller", 4450.0)):
        _, _, rings = solve_mechanics(bearing_source(which, {"load": load, "speed": 3000.0}), base_of(scene()), {}, "")
        found, own = rings["inner"].scene, scene(name)
        assert (own.contact.radius_x, own.load, own.operation.u_m, own.operation.srr) == pytest.approx(
            (found.contact.radius_x, found.load, found.operation.u_m, found.operation.srr), rel=5e-3)
    for name in ("mtm", "twin-disc"):
        assert Scales.of(scene(name)).p_H == pytest.approx(1e9) and not scene(name).transient
    glass = scene("ball-on-glass")
    assert glass.body_b.E < 0.5 * glass.body_a.E and Scales.of(glass).p_H == pytest.approx(0.527e9, rel=2e-3)
    rigs = ("mtm", "twin-disc", "ball-on-glass", "ball-bearing", "roller-bearing", "cam")
    doubts = [line for name in rigs for line in scene(name).warnings()]
    assert all(line.startswith("thick film") for line in doubts)


@pytest.mark.parametrize("name", BUILT_INS)
def test_the_words_about_a_built_in_scene_have_its_pressure_and_slip(name):
    """In as many digits as they show."""
    made, words = BUILT_INS[name]
    for said in re.findall(r"([\d.]+) GPa", words):
        assert f"{Scales.of(made).p_H / 1e9:.{len(said.partition('.')[2])}f}" == said
    for said in re.findall(r"SRR ([-+]?[\d.]+)[):,]", words.replace("(SRR -1 or 1: sliding)", "")):
        assert float(said) == made.operation.srr
