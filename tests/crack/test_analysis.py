"""Where cracks go: trajectories, growth and why it stops, what is refused, the command. In planes of made-up stresses."""

import json
import os
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from read_pages import Seen, numbers
from rolling import Rolling
from small_stores import SMALL, shot

import tehl_taichi as tehl
from tehl_taichi.crack import analysis, body, growth
from tehl_taichi.crack.analysis import follow, run
from tehl_taichi.crack.crack_options import CrackOptions
from tehl_taichi.crack.residual_stress import ResidualStress, read
from tehl_taichi.crack.symmetry_plane import GROWTH, SymmetryPlane, plane_of, principal
from tehl_taichi.crack.trajectory import start, trajectory
from tehl_taichi.errors import StoreError
from tehl_taichi.fatigue import assessment
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.scene import SceneError
from tehl_taichi.scene.scales import Scales
from tehl_taichi.store.crack_file import _drawn
from tehl_taichi.store.store import Store

MICRO, E_STAR, SCENE = 1e-6, 206e9 / 0.91, tehl.scene("gear")


def plane(xx, zz=0.0, xz=0.0, residual=None):
    """Stresses as functions of x' and depth (m), or numbers, at three moments (the feature before, in and behind the middle) of
    which the second one has all of it, the others a tenth; the fourth is unloaded."""
    x, depths = np.arange(-60, 61) * 5 * MICRO, 5 * MICRO * (GROWTH ** np.arange(17) - 1)
    field = [part(x[:, None], depths) if callable(part) else part + 0 * x[:, None] * depths for part in (xx, zz, xz)]
    stress = np.stack(field, axis=-1)[:, :, None] * np.array([0.1, 1.0, 0.1, 0.0])[:, None]
    return SymmetryPlane(x, 5 * MICRO, stress, np.array([-1, -0.5, 1, np.nan]) * 360 * MICRO, 360 * MICRO, 100 * MICRO,
                         residual)


def grown(stresses, **wanted):
    return growth.grow(stresses, start(stresses, "entry", -30 * MICRO), CrackOptions(**wanted), E_STAR)


def test_stresses_between_the_nodes():
    """A cubic along x and in the logarithm of the depth is met exactly; on nodes it is the table."""
    table = plane(lambda x, z: 1e6 * ((x / 100e-6) ** 3 + np.log1p(z / 5e-6) ** 3 - x / 100e-6 * np.log1p(z / 5e-6)))
    points = np.array([-33.3 + 7.7j, 120.1 + 0j, 299.9 + 200j, -300 + 0.3j]) * MICRO
    u, v = points.real / 100e-6, np.log1p(points.imag / 5e-6)
    np.testing.assert_allclose(table.at(points)[:, 1, 0], 1e6 * (u**3 + v**3 - u * v), rtol=1e-9)
    np.testing.assert_array_equal(table.at(points, slice(1, 2)), table.at(points)[:, 1:2])
    assert list(table.holds(np.array([0, 301e-6, 0 - 1e-9j, 1j * table.depths[-1]]))) == [True, False, False, True]


def test_principal_stresses():
    value, angle = principal(np.array([[1.0, 1.0, 0.5], [3.0, 1.0, 0.0], [1.0, 3.0, 0.0]]))
    np.testing.assert_allclose(value, (1.5, 3.0, 3.0))
    np.testing.assert_allclose(np.degrees(angle), (45.0, 0.0, 90.0))


def test_a_trajectory_is_normal_to_the_largest_tension():
    """Uniform tension across a line at 60 degrees: that line. And where the direction turns with depth, its slope is
    tan(direction) everywhere: x = z^2/(2 R) for principal directions that turn as z/R."""
    angle = np.radians(-30.0)
    uniform = plane(2e8 * np.cos(angle) ** 2, 2e8 * np.sin(angle) ** 2, 2e8 * np.sin(angle) * np.cos(angle))
    line, tension = trajectory(uniform, start(uniform, "entry"), 50 * MICRO)
    np.testing.assert_allclose(np.degrees(np.angle(line[1:] - line[0])), 60.0, atol=1e-6)
    assert tension == pytest.approx(2e8) and abs(line[-1] - line[0]) == pytest.approx(50 * MICRO, rel=0.01)

    def part(first, second):
        return lambda x, z: 1e8 * first(np.arctan(-z / 100e-6)) * second(np.arctan(-z / 100e-6)) + 0 * x

    turning = plane(part(np.cos, np.cos), part(np.sin, np.sin), part(np.sin, np.cos))
    line, _ = trajectory(turning, start(turning, "entry", -30 * MICRO), 60 * MICRO)
    np.testing.assert_allclose(line.real + 30 * MICRO, line.imag**2 / (2 * 100e-6), atol=0.05 * MICRO)


def test_the_start_is_the_largest_tension_of_its_side_and_time():
    def humps(x, z):
        return 3e8 * np.exp(-(((x + 40e-6) / 20e-6) ** 2) - z / 10e-6) + 1e8 * np.exp(-(((x - 25e-6) / 10e-6) ** 2))

    hump = plane(humps)
    entry, exit_ = start(hump, "entry"), start(hump, "exit")
    assert (entry.x, entry.moment) == (pytest.approx(-40e-6), 1) and entry.sigma1 == pytest.approx(3e8, rel=1e-3)
    assert (exit_.x, exit_.moment) == (pytest.approx(25e-6), 2) and exit_.sigma1 == pytest.approx(1e7, rel=0.01)
    assert start(plane(-1e8), "entry") is None


def test_in_pure_tension_it_goes_straight_down():
    """K_I = 1.1215 sigma sqrt(pi a) at every length, no K_II beyond rounding."""
    path = grown(plane(1e8), length=40 * MICRO)
    np.testing.assert_allclose(path.points, -30 * MICRO + 1j * np.arange(0, 41, 5) * MICRO, atol=1e-9 * MICRO)
    K = [step["K_I_max"] for step in path.steps]
    np.testing.assert_allclose(K, 1.1215e8 * np.sqrt(np.pi * np.arange(5, 41, 5) * MICRO), rtol=1e-3)
    assert path.why == "length" and max(step["K_II_range"] for step in path.steps) < 1e-6 * K[0]


def test_the_last_piece_ends_at_the_length():
    path = grown(plane(1e8), length=22 * MICRO)
    assert [step["length_m"] for step in path.steps] == pytest.approx(np.array([5, 10, 15, 20, 22]) * MICRO)
    assert path.points[-1].imag == pytest.approx(22 * MICRO) and path.why == "length"


def test_the_first_kink_is_that_of_the_largest_tangential_stress():
    """A crack at 45 degrees in tension, asked near its tip: cos(t/2) (K_I sin t + K_II (3 cos t - 1)) = 0 (Erdogan & Sih)."""
    path = grown(plane(1e8), angle=45.0, first=50 * MICRO, step=MICRO, length=51 * MICRO, distance=0.02 * MICRO, elements=48)
    K_I, K_II = path.first.K[:, 1]
    t = 2 * np.arctan(0.25 * (K_I / K_II - np.sign(K_II) * np.hypot(K_I / K_II, np.sqrt(8.0))))
    turn = np.angle((path.points[2] - path.points[1]) / (path.points[1] - path.points[0]))
    assert abs(np.degrees(t)) > 30 and np.degrees(turn) == pytest.approx(abs(np.degrees(t)), abs=0.8)


UP = 2e8 * np.sin(np.radians(20)) ** 2, 2e8 * np.cos(np.radians(20)) ** 2, 1e8 * np.sin(np.radians(40))


@pytest.mark.parametrize("stresses,wanted,why", [
    ((1e8,), {"length": 20 * MICRO}, "length"), ((1e8,), {"threshold": 1e6}, "threshold"),
    ((lambda x, z: 1e8 - 2e8 * (z > 12e-6) + 0 * x,), {"threshold": 0.3e6}, "threshold"),
    ((lambda x, z: 1e8 - 9e8 * (z > 0) + 0 * x,), {}, "closed"),
    ((1e8,), {"length": 500 * MICRO, "step": 50 * MICRO}, "window"), (UP, {"angle": 20.0, "length": 400 * MICRO}, "surface")])
def test_why_it_stops(stresses, wanted, why):
    """UP: pulled across a line that rises at 20 degrees."""
    path = grown(plane(*stresses), **wanted)
    assert path.why == why in growth.WHY
    assert path.points.imag.min() >= 0 and path.steps[-1]["length_m"] == pytest.approx(np.abs(np.diff(path.points)).sum())
    assert (path.steps[-1]["K_I_max"] == 0) == (why == "closed")


def test_a_threshold_of_nothing_is_none():
    free, zero = (grown(plane(1e8), threshold=threshold, length=20 * MICRO) for threshold in (None, 0.0))
    np.testing.assert_array_equal(free.points, zero.points)


def test_residual_stress_by_number_and_by_table(tmp_path):
    """A pull of -sigma at a depth takes away the load's there; the table is linear between its rows."""
    table = ResidualStress([(0.0, -2e8), (20 * MICRO, 1e8)])
    np.testing.assert_allclose(table(np.array([0, 10, 20, 90]) * MICRO), (-2e8, -0.5e8, 1e8, 1e8))
    (tmp_path / "depths.csv").write_text("0, -2e8\n20e-6, 1e8\n")
    np.testing.assert_array_equal(read(str(tmp_path / "depths.csv")), ((0, -2e8), (20e-6, 1e8)))
    assert read("-1e8") == -1e8
    with_it = plane(3e8, residual=table)
    np.testing.assert_allclose(with_it.at(np.array([0j, 10j]) * MICRO)[:, 1, 0], (1e8, 2.5e8))
    assert with_it.sigma1()[0, 0] == pytest.approx(1e8)
    whole, half = (grown(plane(1e8 + more, residual=ResidualStress(-more)), length=10 * MICRO).steps for more in (0.0, 5e7))
    assert half[0]["K_I_max"] == pytest.approx(whole[0]["K_I_max"], rel=1e-9)


@pytest.mark.parametrize("given", [float("nan"), "much", [1.0, 2.0], [(0, 1e8), (0, 2e8)], [(-1e-6, 1e8)], [(0, float("inf"))],
                                   1e12, [(1e-6, 1e8), (0, 2e8)]])
def test_bad_residual_stress_is_refused(given):
    with pytest.raises(SceneError, match="residual"):
        ResidualStress(given)


DEPTHS = [[0.0, -2e8], [2e-5, 1e8]]


def residual(tmp_path, text):
    (tmp_path / "depths.csv").write_text(text)
    return read(str(tmp_path / "depths.csv"))


@pytest.mark.parametrize("head", [
    "depth_m,stress_Pa", "depth/m,stress/Pa", "depth in m,stress in Pa", "depth (m),residual [Pa]",
    "Depth below surface,sigma_xx", "depth,residual stress axial / (Pa)", "depth metres,stress PA"])
def test_heads_in_m_and_pa_are_read(tmp_path, head):
    assert residual(tmp_path, f"{head}\n0,-2e8\n20e-6,1e8\n").tolist() == DEPTHS


@pytest.mark.parametrize("head", ["depth_{}", "depth/{}", "depth ({})", "depth in {}", "depth {}", "depth [{}]"])
@pytest.mark.parametrize("unit, own", [
    *((unit, "m") for unit in ("microns", "millimetres", "mil", "inches", "MM")),
    *((unit, "Pa") for unit in ("ksi", "megapascal", "kgf", "MPA"))])
def test_an_unknown_unit_in_a_head_is_refused(tmp_path, head, unit, own):
    names = [head.format(unit), "stress"] if own == "m" else ["depth", head.format(unit).replace("depth", "stress")]
    with pytest.raises(SceneError, match=f"its column '.*' is in {unit}, which is not one of {own}, .*; allowed: lines with"):
        residual(tmp_path, f"{','.join(names)}\n0,-2e8\n20e-6,1e8\n")


@pytest.mark.parametrize("head", ["{}_{}", "{}/{}", "{} ({})", "{} in {}", "{} {}", "{} [{}]", "{}/({})"])
@pytest.mark.parametrize("depth, micro", [("mm", 1e-3), ("um", 1.0), ("\u00b5m", 1.0), ("nm", 1e3), ("in", 1e-3 / 25.4)])
@pytest.mark.parametrize("stress, mega", [("MPa", 1.0), ("GPa", 1e-3), ("bar", 10.0), ("psi", 1e6 / 6894.757293168361)])
def test_known_units_in_heads_are_converted(tmp_path, head, depth, micro, stress, mega):
    """As in tables of strength, flanks and cams."""
    heads = f"{head.format('depth', depth)};{head.format('residual stress', stress)}"
    found = residual(tmp_path, f"{heads}\n0;{-200 * mega}\n{20 * micro};{100 * mega}\n")
    np.testing.assert_allclose(found, DEPTHS, rtol=1e-12)


def test_a_unit_of_two_words_in_brackets(tmp_path):
    found = residual(tmp_path, "depth (mm) below surface,sigma (N/mm2)\n0,-200\n0.02,100\n")
    np.testing.assert_allclose(found, DEPTHS, rtol=1e-12)


@pytest.mark.parametrize("text", [
    "0;-2e8\n0,00002;1e8\n", "depth;stress;\n0;-2e8;\n0,00002;1e8;\n", "depth\tstress\n0\t-2e8\n,00002\t1e8\n",
    "stress,depth,note\n-2e8,0,top\n1e8,20e-6,\n", "0,-2e8,\n20e-6,1e8,\n"])
def test_tables_of_spreadsheets(tmp_path, text):
    assert residual(tmp_path, text).tolist() == DEPTHS


@pytest.mark.parametrize("text, said", [
    ("0,-2e8\n0,00002,1e8", "line 2 has 3 columns; allowed: 2, depth and stress"),
    ("depth,stress\n0,-2e8\n0,00002,1e8", "line 3 has 3 columns; allowed: 2, as in the line of names .a decimal comma"),
    ("depth,stress\n0,-2e8\n20e-6", "line 3 has 1 column; allowed: 2"),
    ("depth,stress\n0,high", "line 2: 'high' is not a number"), ("depth,stress\n", "it has no numbers"), ("", "it is empty")])
def test_lines_of_another_length_are_refused(tmp_path, text, said):
    with pytest.raises(SceneError, match=said):
        residual(tmp_path, text)


@pytest.mark.parametrize("rows", [[(0.0, -6e9), (1e-4, 1e8)], [(0.0, -1e8), (1e-4, 6e9)]])
def test_a_residual_stress_beyond_steel_is_refused_in_either_direction(rows):
    with pytest.raises(SceneError, match="the largest residual stress = -?6e.09 Pa is out of range"):
        ResidualStress(rows)


def test_oil_inside_adds_its_pressure_to_the_faces():
    """Pulled along x by 1e8, half of a pressure of 1e8 inside: as tension reaches 1.5e8."""
    pressed = plane(1e8, -1e8)
    dry, wet = (grown(pressed, oil=oil, length=5 * MICRO).steps[0]["K_I_max"] for oil in (0.0, 0.5))
    assert wet == pytest.approx(1.5 * dry, rel=1e-9)


@pytest.mark.parametrize("wanted,said", [
    ({"side": "left"}, "entry"), ({"angle": 14.0}, "15 degrees"), ({"angle": 166.0}, "165"), ({"step": 0.0}, "more than|1e-08"),
    ({"step": 2e-4}, "longer than"), ({"first": 2e-4}, "longer than"), ({"threshold": -1.0}, "0, or at least 1000 Pa"),
    ({"face_friction": -0.1}, "at least 0"), ({"oil": 1.5}, "at most 1"), ({"oil": float("nan")}, "not a number"),
    ({"oil": "flwo"}, "did you mean 'flow'"), ({"oil": "much"}, "dry, film, flow, sealed, a share"),
    ({"oil": "pressure"}, "pressure from 0 to 1$"),  # a text that describes values is no name
    ({"elements": 3}, "6 to 200"), ({"distance": -1e-6}, "1e-08"), ({"length": "long"}, "not a number")])
def test_what_is_out_of_range_is_refused(wanted, said):
    with pytest.raises(SceneError, match=said):
        CrackOptions(**wanted)


def test_a_start_outside_is_refused():
    with pytest.raises(SceneError, match="start = 0.001 m is outside"):
        follow(plane(1e8), SCENE, CrackOptions(start=1e-3))
    with pytest.raises(SceneError, match="leads out of"):
        follow(plane(1e8), SCENE, CrackOptions(start=299e-6, angle=15.0, first=50e-6))


def of_a(**wanted):
    """Of cracks below the bump, which the reader has on surface a."""
    return CrackOptions(surface="a", **wanted)


class Still(Rolling):
    def feature_x(self, n):
        return np.nan


class Broken(Rolling):
    def fields(self, n, names):
        return {name: np.where(n == 3, np.nan, values) for name, values in super().fields(n, names).items()}


class Whole(Rolling):
    def __init__(self, *args):
        super().__init__(*args)
        self.y = self.y - self.y[-1] / 2


@pytest.mark.parametrize("reader,changes,said", [
    (Still, {}, "passage of a feature"), (Broken, {}, "not numbers"), (Whole, {}, "not a plane of symmetry"),
    (Rolling, {"feature.y": 0.1e-3}, "feature.y = 0.0001 m")])
def test_what_has_no_plane_of_symmetry_is_refused(taichi_cpu, reader, changes, said):
    scene = SCENE.replace(**{"thermal.on": False, **changes})
    with pytest.raises(SceneError, match=said):
        plane_of(scene, reader(scene))


@pytest.fixture(scope="module")
def rolled(taichi_cpu):
    """Of a Hertz line over which a bump of pressure passes."""
    scene = SCENE.replace(**{"thermal.on": False})
    return run(scene, Rolling(scene), of_a(length=30 * MICRO))


def test_the_answer(rolled):
    found = rolled.summary["sides"]
    entry = found["entry"]
    assert entry["opens"] and entry["start_x_m"] < 0 and entry["moment_x_m"] < 0 and entry["sigma1_surface_Pa"] > 1e8
    assert entry["trajectory"]["lean"] == "with rolling" and rolled.summary["pit_angles_deg"] == [18.0, 50.0]
    chords = entry["trajectory"]["chord_deg_at_um"]
    assert 0 < chords["20"] < chords["10"] < 90
    assert [step["length_m"] for step in entry["K"]] == pytest.approx(np.arange(5, 31, 5) * MICRO)
    assert entry["K_I_max"] == max(step["K_I_max"] for step in entry["K"]) and entry["unsettled"] == 0
    assert 0 < entry["error_at_last_length"]["K_I_max"] < 0.1 * entry["K_I_max"]
    line = rolled.sides["entry"].trajectory
    across = np.interp(20 * MICRO, line.imag, line.real) - line[0].real
    assert chords["20"] == pytest.approx(np.degrees(np.arctan2(20 * MICRO, -across)), abs=1e-6)
    assert not found["exit"]["opens"] and "never in tension" in found["exit"]["why"] and "exit" not in rolled.sides


class Turned(Rolling):
    """The same passage with the bodies in exchange."""

    def fields(self, n, names):
        other = {name: f"{name[:-1]}{'ba'['ab'.index(name[-1])]}" if name[-2] == "_" else name for name in names}
        found = super().fields(n, other.values())
        return {name: found[own] for name, own in other.items()}


@pytest.mark.parametrize("surface,mirror", ["ab", "ba"])
def test_a_crack_in_b_is_one_in_a_with_the_slip_turned(taichi_cpu, surface, mirror):
    """Of the body that carries the feature, and of the other one, whose elastic constants are others."""
    scene, wanted = SCENE.replace(**{"thermal.on": False, "bodies.b.E": 150e9}), {"length": 15 * MICRO}
    turned = SCENE.replace(**{"thermal.on": False, "bodies.a.E": 150e9, "srr": 0.12, "feature.surface": "b"})
    one = run(scene, Rolling(scene), CrackOptions(surface=surface, **wanted))
    other = run(turned, Turned(turned), CrackOptions(surface=mirror, **wanted))
    assert one.summary.pop("surface") == surface and other.summary.pop("surface") == mirror
    assert one.summary["carries_feature"] == (surface == "a") and one.summary.pop("srr") == -other.summary.pop("srr")
    assert one.sides and repr(one.summary) == repr(other.summary)


def test_the_body_is_that_of_the_verdict(taichi_cpu):
    scene = SCENE.replace(**{"thermal.on": False})
    reader, worse = Rolling(scene, 6, 5), {"surface": "b", "Fi_max": 0.9, "below": {"Fi_max": 1.2}}
    assert body.cracked_surface(scene, reader, "worse").name == assessment.run(scene, reader).summary["surface"]
    reader.summary = {"fatigue": worse, "fatigue_by_surface": {"a": {"Fi_max": 1.1}, "b": worse}}
    assert body.cracked_surface(scene, reader, "worse").name == "b" and body.cracked_surface(scene, reader, "a").name == "a"
    reader.summary = {"fatigue": {"Fi_max": 1.1}}  # of a version that searched body a alone
    assert body.cracked_surface(scene, reader, "worse").name == "a"
    rest = scene.replace(srr=2.0)
    assert body.cracked_surface(rest, Rolling(rest), "worse").name == "a"
    with pytest.raises(SceneError, match="surface b is at rest"):
        body.cracked_surface(rest, reader, "b")


def test_sides_of_the_other_body_are_those_of_the_feature_as_it_slides(taichi_cpu):
    """At SRR -0.5 surface b moves 5/3 as far: the feature is at x' = -2/3 X on it."""
    scene = SCENE.replace(**{"thermal.on": False, "srr": -0.5})
    plane = plane_of(scene, Rolling(scene), surface=scene.surfaces[1])
    for side, sign in (("entry", -1), ("exit", 1)):
        if begun := start(plane, side):
            X = plane.centres[begun.moment]
            ahead = begun.x + 5 / 3 * X - X
            assert sign * X > 0 and 0 < sign * ahead < 1.5 * plane.reach
    assert start(plane, "entry") or start(plane, "exit")
    np.testing.assert_allclose(np.diff(plane.times[:-1]), np.diff(plane.centres[:-1]) / scene.operation.u_a, rtol=1e-9)


class Moved(Rolling):
    """A passage whose feature lies at x = `ahead` (m), so that its positions are those of feature.x = 0."""

    ahead = 0.4e-3

    def feature_x(self, n):
        return super().feature_x(n) - self.ahead


@pytest.mark.parametrize("surface", ["a", "b"])
def test_places_count_from_the_feature_wherever_its_x_lies(taichi_cpu, surface):
    """The start, the sides and the path of a crack do not depend on the x from which its scene counts."""
    scene = SCENE.replace(**{"thermal.on": False, "srr": -0.3})
    plain, moved = (run(scene.replace(**{"feature.x": x}), reader(scene), CrackOptions(surface=surface, length=2e-5)).summary
                    for x, reader in ((0.0, Rolling), (Moved.ahead, Moved)))
    for side, found in plain["sides"].items():
        other = moved["sides"][side]
        assert found["opens"] == other["opens"]
        for key in ("start_x_m", "sigma1_surface_Pa", "moment_x_m") if found["opens"] else ():
            assert other[key] == pytest.approx(found[key], rel=1e-2, abs=1e-8), key
    assert any(found["opens"] for found in plain["sides"].values())


@pytest.mark.parametrize("at, opens", [(-130, True), (-170, False)])
def test_tension_farther_than_one_and_a_half_half_widths_is_not_of_the_feature(at, opens):
    """The feature has a half width of 100 µm, and the tension 10 µm."""
    found = start(plane(lambda x, z: 1e8 * (np.abs(x - at * MICRO) < 11 * MICRO) + 0 * z), "entry")
    assert (found is not None) == opens and (not opens or abs(found.x - at * MICRO) < 11 * MICRO)


def test_numbers_of_a_length_are_those_of_their_moment():
    K = np.array([[1.0, 3.0, 2.0], [0.5, -0.25, 1.0]])
    crack = SimpleNamespace(K=K, faces=SimpleNamespace(a=1e-5), pressure=np.array([1e6, 2e6, 0.0]), missed=1)
    found = growth._step_numbers(SimpleNamespace(centres=np.array([-1.0, 0.0, 2.0])), crack)
    assert (found["K_I_max"], found["K_II_there"], found["K_II_range"], found["feature_x_m"]) == (3.0, -0.25, 1.25, 0.0)
    finer = K + np.array([[0.0, 0.0, 0.0], [0.0, -1.0, 0.0]])  # the largest slip back
    assert analysis._element_error(K, K + 0.5) == {"K_I_max": 0.5, "K_II_range": 0.0}
    assert analysis._element_error(K, finer) == {"K_I_max": 0.0, "K_II_range": 1.0}


@pytest.mark.parametrize("depth, doubted", [(5, True), (7, False)])
def test_a_crack_is_near_the_surface_after_its_first_piece_alone(depth, doubted):
    """Its first piece of 5 µm always is, within twice the distance of 3 µm."""
    points, last = np.array([0, 5j, 3 + depth * 1j]) * MICRO, SimpleNamespace(K=np.ones((2, 4)))
    path = SimpleNamespace(points=points, steps=[{}], last=last)
    said = list(analysis._doubts(path, CrackOptions(), 0, 0.0, 1.0))
    assert len(said) == doubted and all("closer to the surface" in one for one in said)


def test_largest_numbers_of_a_crack_that_slows_down():
    """Tension down to 12 µm, pressure below: K_I is largest before the end; only the moment of the start has all of the
    tension."""
    falling = plane(lambda x, z: 1e8 - 2e8 * (z > 12e-6) + 0 * x, lambda x, z: -3e8 * (z > 12e-6) + 0 * x)
    entry = follow(falling, SCENE, CrackOptions(side="entry")).summary["sides"]["entry"]
    K = [step["K_I_max"] for step in entry["K"]]
    assert entry["K_I_max"] == max(K) > K[-1] == 0.0 and entry["stopped"] == "closed"
    assert entry["moment_x_m"] == pytest.approx(-0.5 * 360 * MICRO)
    assert entry["tension_depth_m"] == pytest.approx(12 * MICRO, abs=3 * MICRO), "between the depths of the table"


def fading(scale=1.0, noise=0.0):
    """Tension that fades with exp(-z/4 um), and noise of the stresses on both sides of zero."""
    def field(x, z):
        rough = np.random.default_rng(5).standard_normal((x + z).shape)
        return scale * 1e8 * (np.exp(-z / (4 * MICRO)) + noise * rough)

    return plane(field, scale * -1e6)


@pytest.mark.parametrize("scale, noise", [(1.0, 0.0), (3.0, 0.0), (0.2, 0.0), (1.0, 1e-4), (1.0, -1e-4), (3.0, 1e-3)])
def test_the_depth_of_tension_ends_at_a_share_of_it(scale, noise):
    """4 um ln 20 for 5 %, whatever the load and the noise, whose zeros lie anywhere below 30 um."""
    stresses = fading(scale, noise)
    origin = start(stresses, "entry", -30 * MICRO)
    depth = analysis._tension_depth(*trajectory(stresses, origin, 100 * MICRO))
    assert depth == pytest.approx(4 * MICRO * np.log(20), rel=0.02 if abs(noise) < 1e-3 else 0.03)
    if noise:
        smooth = analysis._tension_depth(*trajectory(fading(scale), origin, 100 * MICRO))
        assert depth == pytest.approx(smooth, rel=20 * abs(noise))


@pytest.mark.parametrize("tension, depth", [((4, 2, 1, 0.6), 3), ((4, 2, 0.1, -1), 2 - 0.1 / 1.9), ((1, 4, -4, 4), 3),
                                            ((4, -4, 8, 0), 3 - 0.05), ((1, 0, 0, 0), 0.95)])
def test_the_depth_of_tension_is_the_largest_with_a_share_of_it(tension, depth):
    """5 % lies between two points of the trajectory, or beyond its end; points 1 um apart in depth, and 1 um to the side."""
    found = analysis._tension_depth((1 + 1j) * MICRO * np.arange(4), 1e8 * np.array(tension, float))
    assert found == pytest.approx(depth * MICRO)


def test_the_depth_of_tension_of_a_trajectory_that_returns_is_its_largest():
    points = np.array([0, 2j, 3 + 3j, 5 + 1j]) * MICRO
    assert analysis._tension_depth(points, np.array([1.0, 2.0, 3.0, 4.0])) == pytest.approx(3 * MICRO)
    assert analysis._tension_depth(points, np.array([4.0, 2.0, -2.0, 4.0])) == pytest.approx((2 + 1.8 / 4) * MICRO)


@pytest.mark.parametrize("degrees, lean", [(0.0, "neither way"), (0.9, "neither way"), (-0.9, "neither way"),
                                           (1.1, "against rolling"), (-1.1, "with rolling"), (80, "against rolling")])
def test_what_goes_straight_down_leans_neither_way(degrees, lean):
    """Rounding decided it; points at this angle from straight down."""
    points = 1j * np.exp(-1j * np.radians(degrees)) * np.arange(4) * MICRO
    assert analysis._shape(points)["lean"] == lean


def test_a_crack_in_pure_tension_leans_neither_way():
    found = follow(plane(1e8), SCENE, CrackOptions(side="entry", length=20 * MICRO)).summary["sides"]["entry"]
    assert found["path"]["lean"] == found["trajectory"]["lean"] == "neither way"


def test_a_crack_opens_by_the_plane_modulus_of_its_body():
    """At the mouth of a normal edge crack 1.454 times 4 sigma a/E', E' = E/(1 - nu^2) (Tada, Paris & Irwin)."""
    scene = SCENE.replace(**{"bodies.a.E": 300e9, "bodies.a.nu": 0.4})
    last = follow(plane(1e8), scene, CrackOptions(length=20 * MICRO, elements=24, side="entry")).sides["entry"].path.last
    opening = (last.faces.opening() @ last.values)[0, 1]
    assert opening == pytest.approx(1.454 * 4 * 1e8 * 20 * MICRO / (300e9 / (1 - 0.4**2)), rel=0.01)


def test_pressure_all_around_and_inside_changes_no_path():
    """The film and the oil press body and faces alike in the moment that leads the crack."""
    dry = plane(1e8)
    dry.stress[:, :, :3] = np.array([[0.2, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.6]]) * 1e8  # xx, zz, xz of the moments
    wet = plane(1e8)
    wet.stress[:, :, :3] = dry.stress[:, :, :3] - np.array([0.0, 0.0, 0.9])[:, None] * np.array([1e8, 1e8, 0.0])
    paths = [grown(one, oil=oil, length=30 * MICRO).points for one, oil in ((dry, 0.0), (wet, 1.0))]
    assert np.abs(paths[0].real + 30 * MICRO).max() > 3 * MICRO
    np.testing.assert_allclose(paths[1], paths[0], atol=1e-6 * MICRO)


def test_oil_flows_with_the_oil_and_the_speed_of_the_scene(rolled):
    """Between nothing and the film's pressure; and times and viscosity that it goes with."""
    plane, u_a = rolled.plane, SCENE.operation.u_a
    np.testing.assert_allclose(np.diff(plane.times[:-1]) * u_a, np.diff(plane.centres[:-1]), rtol=1e-9)
    assert plane.times[-1] - plane.times[-2] == pytest.approx(plane.times[-2] - plane.times[0]), "unloaded as long after"
    assert np.log(plane.fluid.viscosity(1e8)) == pytest.approx(ln_eta(SCENE.oil, 1e8, SCENE.operation.temperature))
    path = rolled.sides["entry"].start.x + np.array([0, 20 * MICRO * np.exp(0.8j)])
    dry, flow, film = (growth.load_crack(plane, path, CrackOptions(oil=oil), E_STAR) for oil in ("dry", "flow", "film"))
    assert flow.missed == 0 and 0 < flow.pressure.max() < film.pressure.max()
    assert dry.K[0].max() * (1 - 1e-9) <= flow.K[0].max() < film.K[0].max()


def test_shallow_closed_cracks_settle_and_hardly_depend_on_the_elements(rolled):
    """Largest K_I and range of K_II through the passage with 12 against 48 elements: 1 %."""
    x = rolled.sides["entry"].start.x
    for degrees in (15, 45, 90, 135, 165):
        path = x + np.array([0, 20 * MICRO * np.exp(1j * np.radians(degrees))])
        coarse, fine = (growth.load_crack(rolled.plane, path, CrackOptions(), E_STAR, count) for count in (12, 48))
        assert coarse.missed == fine.missed == 0 and fine.touching.max() > 0.5
        scale = np.ptp(fine.K[1])
        assert coarse.K[0].max() == pytest.approx(fine.K[0].max(), abs=0.01 * scale)
        assert np.ptp(coarse.K[1]) == pytest.approx(scale, rel=0.01)


def test_pressed_together_it_stays_closed(taichi_cpu):
    scene = SCENE.replace(**{"thermal.on": False})
    result = run(scene, Rolling(scene, 12, 9), of_a(residual=-2e9, start=-60 * MICRO))
    assert result.summary["sides"]["entry"]["opens"] is False
    result = run(scene, Rolling(scene), of_a(residual=[(0.0, 0.0), (1 * MICRO, -2e9)], length=30 * MICRO, side="entry"))
    entry = result.summary["sides"]["entry"]
    assert entry["K_I_max"] == 0.0 and entry["stopped"] == "closed" and len(entry["K"]) == 1


def test_residual_stress_of_the_scene_counts(taichi_cpu, rolled):
    scene = SCENE.replace(**{"thermal.on": False, "fatigue.residual_xx": 1e8})
    given = run(scene, Rolling(scene), of_a(length=5 * MICRO, side="entry")).summary["sides"]["entry"]
    bare = SCENE.replace(**{"thermal.on": False})
    asked = run(bare, Rolling(bare), of_a(length=5 * MICRO, residual=1e8, side="entry")).summary["sides"]["entry"]
    assert given["K_I_max"] == pytest.approx(asked["K_I_max"], rel=1e-6)
    assert given["K_I_max"] > 1.2 * rolled.summary["sides"]["entry"]["K"][0]["K_I_max"]


def test_figure(rolled, tmp_path):
    from tehl_taichi.view.figures import crack_figures
    from tehl_taichi.view.figures.figure_style import FigureStyle

    pytest.importorskip("matplotlib")
    figure = crack_figures.crack_figure(FigureStyle(), rolled, "rolling")
    section, entry, _ = figure.axes  # the third: its scale of colours
    drawn = [line.get_xydata() for line in section.lines]
    path = rolled.sides["entry"].path.points / MICRO
    assert any(len(line) == path.size and np.allclose(line, np.stack([path.real, path.imag], axis=1)) for line in drawn)
    top = max(line.get_ydata().max() for line in entry.lines)
    assert top == pytest.approx(max(rolled.sides["entry"].path.first.K.max(), rolled.sides["entry"].path.last.K.max()) / 1e6)
    assert ", body a" in figure.get_suptitle() and section.get_xlabel().startswith("x' from the feature's centre")
    assert figure.get_suptitle().endswith("no crack on the exit side") and "entry" in entry.get_ylabel()


def test_lines_of_the_figure_are_those_of_their_labels(rolled):
    """K over the feature's position in half-widths; the feature, the pits and the tension where and as large as they are."""
    from tehl_taichi.view.figures import crack_figures
    from tehl_taichi.view.figures.figure_style import FigureStyle

    pytest.importorskip("matplotlib")
    section, entry, _ = crack_figures.crack_figure(FigureStyle(), rolled, "rolling").axes
    side, plane = rolled.sides["entry"], rolled.plane
    drawn = {line.get_label(): line for line in entry.lines}
    for crack, length in ((side.path.first, 5), (side.path.last, 30)):
        for K, kind in zip(crack.K, ("K_I", "K_II")):
            x, y = drawn[f"{kind} at {length} µm"].get_data()
            np.testing.assert_allclose(x * Scales.of(SCENE).a, plane.centres[:-1])
            np.testing.assert_allclose(y * 1e6, K[:-1])
    bump = next(line for line in section.lines if len(line.get_xdata()) == 2)
    assert list(bump.get_xdata()) == pytest.approx([-1e6 * SCENE.features[0].width / 2, 1e6 * SCENE.features[0].width / 2])
    mouth, low, high = section.patches[0].get_xy()[:3] - [side.start.x / MICRO, 0]
    assert mouth == pytest.approx([0, 0]) and low[0] < 0, "with rolling, to the left"
    assert np.degrees(np.arctan2([low[1], high[1]], [-low[0], -high[0]])) == pytest.approx(rolled.summary["pit_angles_deg"])
    label = next(line.get_label() for line in section.lines if "largest tension" in line.get_label())
    assert label.endswith(f"({side.start.sigma1 / 1e6:.0f} MPa)") and side.start.sigma1 > 1e8


def test_what_is_kept_for_the_page_is_what_the_figure_draws(rolled):
    kept, side = _drawn(rolled), rolled.sides["entry"]
    np.testing.assert_allclose(kept["position"] * Scales.of(SCENE).a, rolled.plane.centres[:-1])
    for crack, found in zip((side.path.first, side.path.last), kept["sides"]["entry"]["K"], strict=True):
        assert found["length"] == crack.faces.a
        np.testing.assert_array_equal([found["K_I"], found["K_II"]], crack.K[:, :-1])
    np.testing.assert_array_equal(kept["sides"]["entry"]["path"] @ [1, 1j], side.path.points)


SIDE = {"opens": True, "sigma1_surface_Pa": 3.21e8, "start_x_m": -41 * MICRO, "moment_x_m": -180 * MICRO, "K_I_max": 2.4e6,
        "tension_depth_m": 33 * MICRO, "trajectory": {"lean": "with rolling", "chord_deg_at_um": {"10": 71.0, "20": 62.0}},
        "path": {"lean": "against rolling", "chord_deg_at_um": {"10": 54.0, "20": 45.0, "40": None}}, "length_m": 25 * MICRO,
        "K": [{"length_m": 25 * MICRO, "K_I_max": 2.4e6, "K_II_there": 0.3e6, "K_II_range": 1.7e6}], "why": "it is long enough",
        "error_at_last_length": {"K_I_max": 0.02e6, "K_II_range": 0.05e6}}


def test_the_printed_numbers_of_a_side_are_in_their_units():
    from tehl_cli.crack_command import _rows

    rows = dict(_rows(SIDE, (18.0, 50.0)))
    assert rows == {"largest tension at the surface": "321 MPa", "at x' (feature position)": "-41.0 um (-180 um)",
                    "tension above 5% of its largest value down to": "33.0 um",
                    "trajectory leans": "with rolling", "path leans": "against rolling",
                    "trajectory: chord at 10, 20, 40 um (pits 18 to 50)": "71, 62 deg",
                    "path: chord at 10, 20, 40 um (pits 18 to 50)": "54, 45, - deg",
                    "K_I up to, range of K_II at 25.0 um": "2.400, 1.70 MPa sqrt(m)",
                    "their errors at the last length": "0.02, 0.05", "stop reason": "it is long enough"}


def test_the_page_has_the_numbers_of_a_side_in_its_sentence_and_its_figures():
    """The chord of the largest depth that the crack reaches; the band of the pits leans with rolling, to the left."""
    from tehl_taichi.report import crack_plots

    sentence, = crack_plots.verdict({"sides": {"entry": SIDE}, "pit_angles_deg": [18.0, 50.0]})
    assert "tension reaches 321 MPa; K_I reaches 2.4 MPa√m (at the last length ± 0.02," in sentence
    assert "leans against rolling at 45° to the surface at 20 µm depth (pits: with rolling, 18 to 50°)" in sentence
    band, = crack_plots._band({"path": [(-41 * MICRO, 0.0)]}, [18.0, 50.0], True)
    x, z = np.array(band["x"])[:3] + 41, np.array(band["y"])[:3]
    assert (x[0], z[0]) == pytest.approx((0, 0)) and np.degrees(np.arctan2(z[1:], -x[1:])) == pytest.approx([18.0, 50.0])
    cracks = [{"length": length, "K_I": [1e6, 2e6], "K_II": [0.0, 3e5]} for length in (5 * MICRO, 30 * MICRO)]
    lines = crack_plots._history("entry", cracks, [-0.5, 0.5]).traces
    assert [line["name"] for line in lines] == ["at 5 µm", "at 30 µm"] * 2
    assert list(lines[0]["y"]) == [1.0, 2.0] and list(lines[2]["y"]) == [0.0, 0.3]


def rolling_store(path):
    """A store of :class:`Rolling` on the small scene's grid."""
    reader = Rolling(SMALL, 8, SMALL.rows + 1)
    shots = [shot(n) for n in range(len(reader))]
    for n, one in enumerate(shots):
        one.x, one.y, one.time, one.feature_x = reader.x, reader.y, float(reader.time[n]), float(reader.centres[n])
        found = reader.fields(n, ("pressure", "traction_x_a", "traction_y_a"))
        one.fields = {name: found.get(name, np.zeros_like(found["pressure"])) for name in one.fields}
        one.state["P"] = np.zeros((reader.y.size, reader.x.size))
    attrs = {"runtime": '{"precision": "f64"}', "steady_error": "{}", "date": "2026-01-31"}
    with Store.create(path, SMALL, shots[0], len(shots), attrs) as made:
        for one in shots[1:]:
            made.append(one, one.state)
    return made


@pytest.mark.rendered
def test_the_command(taichi_cpu, tmp_path, capsys, without_library):
    from tehl_cli.crack_command import crack

    rolling_store(tmp_path / "r.zarr")
    (tmp_path / "depths.csv").write_text("0, 0\n50e-6, -1e8\n")
    options = dict(surface="a", side="entry", start=None, angle=90.0, first=5e-6, step=5e-6, length=15e-6, distance=3e-6,
                   threshold=None, residual=str(tmp_path / "depths.csv"), face_friction=0.1, oil="0", thermal_stress=None,
                   elements=12, threads=None)
    crack(tmp_path / "r.zarr", **options, figures=tmp_path / "figures", as_json=True, keep=False)
    assert not (tmp_path / "r.crack.json").exists()
    summary = json.loads(capsys.readouterr().out)
    assert summary["sides"]["entry"]["opens"] and summary["face_friction"] == 0.1
    assert (tmp_path / "figures" / "crack.png").stat().st_size > 10000
    crack(tmp_path / "r.zarr", **options, figures=None, as_json=False, keep=True)
    shown = capsys.readouterr().out
    assert "crack in body a" in shown and "with rolling" in shown and "MPa sqrt(m)" in shown
    _in_the_report(tmp_path / "r.zarr", summary)


def _in_the_report(store, summary):
    """What was kept stands there, and its path is drawn; not with another run in that place, nor if it is damaged."""
    go = pytest.importorskip("plotly.graph_objects")
    page = Seen(tehl.report(store).read_text(encoding="utf-8"))
    entry, K = summary["sides"]["entry"], page.figures["K-entry"]["data"]
    assert "Cracks" in page.headings and "body\na (with the feature)\n" in page.text
    assert "friction of closed faces\n0.1\n" in page.text and "None" not in page.text
    assert f"tension reaches {entry['sigma1_surface_Pa'] / 1e6:.4g} MPa" in page.text and entry["why"] in page.text
    assert max(numbers(K[0])) == pytest.approx(entry["K"][0]["K_I_max"] / 1e6, rel=1e-3) and len(K) == 4
    for name in ("cracks", "K-entry"):
        go.Figure({key: page.figures[name][key] for key in ("data", "layout")})  # refuses what plotly does not know
    path = next(trace for trace in page.figures["cracks"]["data"] if trace.get("name") == "entry: crack")
    assert numbers(path)[-1] == pytest.approx(entry["path"]["deepest_m"] * 1e6, rel=1e-3)
    kept = store.with_name("r.crack.json")
    kept.write_text(kept.read_text().replace('"run": "', '"run": "another'))
    assert "Cracks" not in Seen(tehl.report(store, force=True).read_text(encoding="utf-8")).headings
    kept.write_text("{")
    with pytest.raises(StoreError, match="crack.json is damaged"):
        tehl.report(store, force=True)


def test_the_command_refuses_in_a_sentence(tmp_path):
    command = [sys.executable, "-m", "tehl_taichi", "crack", str(tmp_path / "none.zarr"), "--angle", "5"]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert done.returncode == 2 and done.stdout == "" and len(done.stderr.strip().splitlines()) == 1
