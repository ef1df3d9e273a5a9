"""Below the surface: rows against whole planes, the depth that is found, what the run, the table and the figures say of it."""

from types import SimpleNamespace

import numpy as np
import pytest
from rolling import BothSides, Rolling

import tehl_taichi as tehl
from tehl_taichi.errors import RuntimeUnavailable
from tehl_taichi.fatigue import (
    assessment,
    candidate_rows,
    contact_alone,
    depth_profile,
    depth_search,
    exact_depths,
    findley,
    judged_layers,
    von_mises,
)
from tehl_taichi.fatigue.sought import Box
from tehl_taichi.fatigue.stress import half_space
from tehl_taichi.fatigue.stress import workers as stress_workers
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.stress.row_histories import at_the_surface, histories_of
from tehl_taichi.fatigue.stress.row_stress import RowStress
from tehl_taichi.fatigue.stress.steady_sweep import SteadySweep
from tehl_taichi.fatigue.stress.thermal_stress import ThermalStress
from tehl_taichi.runs.summary import result_warnings, summary_rows
from tehl_taichi.scene import SceneError
from tehl_taichi.values.coded_text import without_options
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.run_figures import write_fatigue

NU = 0.3
DEPTHS = [0.0, 2e-6, 15e-6, 80e-6]


def test_stresses_between_rungs_follow_as_many_rungs_of_either_side():
    """What is odd about the middle of two rungs is zero there, a quintic too, which no cubic is."""
    logs = 0.4 * np.arange(8.0)
    for rung in range(1, 6):
        middle = 0.5 * (logs[rung] + logs[rung + 1])
        histories = ((logs - middle) ** 5)[:, None, None, None] * np.ones((1, 2, 3, 6))
        found = depth_profile._between(SimpleNamespace(varies_in_residual=False), logs, histories, middle)
        np.testing.assert_allclose(found, 0.0, atol=1e-12)


@pytest.mark.parametrize("line,mirrored,row", [(True, True, 0), (True, True, 3), (False, True, 2), (False, False, 5)])
def test_rows_are_those_of_the_whole_plane(line, mirrored, row):
    x, y = np.arange(24) * 11e-6, np.arange(9) * 7e-6
    loads = np.random.default_rng(3).standard_normal((3, 2, 24, 9)) * 1e9
    found = RowStress(x, y, NU, line, mirrored, DEPTHS, [7, row])(*loads)
    for n, depth in enumerate(DEPTHS):
        loads[2, ..., 0] *= depth > 0 or not mirrored  # odd: nothing on the axis, whatever is stored there
        whole = half_space.HalfSpaceStress(x, y, NU, line, mirrored, depth)(*loads[:, 1])
        for component, values in enumerate(whole.values()):
            np.testing.assert_allclose(found[1, :, :, n, component], values[:, [7, row]], atol=1e-3)  # of 1e9 Pa
    alone = RowStress(x, y, NU, line, mirrored, DEPTHS[:1], [7, row])(*loads)
    np.testing.assert_allclose(alone[:, :, :, 0], found[:, :, :, 0], atol=1e-3)


def test_rows_by_any_number_of_threads(monkeypatch):
    monkeypatch.setattr(stress_workers, "WORTH", 0)
    x, y, found = np.arange(24) * 11e-6, np.arange(9) * 7e-6, []
    for count in (1, 3):
        monkeypatch.setattr(stress_workers, "WORKERS", count)
        found.append(RowStress(x, y, NU, True, True, DEPTHS, [3]).rows.tobytes())
    assert found[0] == found[1]


def test_one_row_alone_is_plane_strain():
    x, p = np.arange(24) * 11e-6, np.random.default_rng(4).standard_normal((3, 1, 24, 1)) * 1e9
    found = RowStress(x, np.zeros(1), NU, True, True, DEPTHS, [0])(*p)[0, :, 0]
    whole = half_space.HalfSpaceStress(x, np.zeros(1), NU, depth=15e-6)(*p[:, 0])
    np.testing.assert_allclose(found[:, 2], np.stack(list(whole.values()), axis=-1)[:, 0], atol=1e-3)


def result(heat=False, **changes):
    scene = tehl.scene("gear").replace(**{"thermal.on": heat, "fatigue.surfaces": "a", **changes})
    return scene, assessment.run(scene, Rolling(scene, *((12, 9) if heat else (8, 5))))


@pytest.fixture(scope="module")
def found(taichi_cpu):
    """Without heat, depths "auto"."""
    return result()[1]


@pytest.mark.parametrize("heat", [False, True])
def test_the_depth_found_is_the_worst_of_all(taichi_cpu, heat):
    """Searched at all points at the depth found and at a finer ladder of depths around it."""
    _, found = result(heat)
    deep = found.summary["below"]
    near = [float(deep["depth_m"] * ratio) for ratio in (0.8, 1.0, 1.25)]
    _, layers = result(heat, **{"fatigue.depths": near})
    by_depth = [layer["findley_stress_max_Pa"] for layer in layers.summary["by_depth"]]
    assert deep["Fi_max"] > found.summary["Fi_max"]
    assert deep["findley_stress_max_Pa"] == pytest.approx(max(by_depth[1:]), rel=2e-3)
    assert by_depth[2] >= max(by_depth[1:]) * (1 - 1e-3)
    assert layers.summary["below"]["y_m"] == deep["y_m"] == 0.0


@pytest.mark.parametrize("depths", [[5e-6], [1.4e-3]])
def test_the_worst_depth_is_looked_for_where_others_are_listed(found, depths):
    """An answer by the listed ones alone would be that of the deepest or of the next to the surface."""
    _, listed = result(**{"fatigue.depths": depths})
    assert listed.summary["below"] == found.summary["below"]
    assert [layer["depth_m"] for layer in listed.summary["by_depth"]] == [0.0, *depths]
    for name, dim in (("findley_stress_under_row", "under_row_depth"), ("findley_stress_contact_alone", "under_row_depth"),
                      ("findley_stress_at_depth", "fatigue_depth")):
        values, dims, *_ = listed.maps[name]
        assert dims[0] == dim and values.shape[0] == listed.maps[dim][0].size
        if name in found.maps:
            np.testing.assert_array_equal(values, found.maps[name][0])


def test_the_rows_of_the_worst_of_listed_depths_are_searched(taichi_cpu, monkeypatch):
    """Else the section would not go through the worst point."""
    scene, asked = tehl.scene("gear").replace(**{"thermal.on": False}), []
    monkeypatch.setattr(depth_search, "_under", lambda passage, rows, *_: asked.append(rows) or ([], []))
    monkeypatch.setattr(depth_search, "passes", lambda passage: 0)
    reader = Rolling(scene, rows=9)
    layers = [SimpleNamespace(worst=SimpleNamespace(y=y), early=None) for y in (reader.y[2], reader.y[5])]
    chosen = Box((-np.inf, np.inf), (-np.inf, np.inf), chosen_y=(reader.y[3],))
    for box in (None, chosen):
        depth_search.search(scene, StressHistories(scene, reader, reader.centres, box=box), layers, None, None)
    assert asked == [[0, 2, 5], [3]]


@pytest.mark.parametrize("row, excess, window, searched", [(1, 0.01, True, [0]), (1, 0.03, True, [0, 1]),
                                                           (1, 0.01, False, [0, 1]), (2, 0.01, True, [0, 2])])
@pytest.mark.parametrize("part", ["all", "early"])
def test_rows_of_a_window_that_are_alike_are_searched_once(taichi_cpu, monkeypatch, row, excess, window, searched, part):
    """Those beside the row of the feature with hardly more stress at the surface; rows are 5.7 um apart."""
    scene, asked = tehl.scene("gear").replace(**{"thermal.on": False}), []
    monkeypatch.setattr(depth_search, "_under", lambda passage, rows, *_: asked.append(rows) or ([], []))
    monkeypatch.setattr(depth_search, "passes", lambda passage: 0)
    monkeypatch.setattr(depth_search, "has_window", lambda reader: window)
    passage = StressHistories(scene, reader := Rolling(scene, rows=65), reader.centres)
    f = np.ones((passage.x.size, passage.y.size))
    axis = SimpleNamespace(worst=SimpleNamespace(y=0.0), f=f, early=None)
    f = f.copy()
    f[3, row] += excess
    beside = SimpleNamespace(worst=SimpleNamespace(y=reader.y[row]), f=f, early=None)
    layers = [beside if part == "all" else SimpleNamespace(worst=axis.worst, f=axis.f, early=beside)]
    depth_search.search(scene, passage, layers, None, None)
    assert asked == [searched]


def test_listed_depths_are_told_of_as_one_count_with_the_search(taichi_cpu):
    told = []
    scene = tehl.scene("gear").replace(**{"thermal.on": False, "fatigue.depths": [2e-5, 6e-5]})
    assessment.run(scene, Rolling(scene), lambda *parts: told.append(parts))
    last, total = [done for done, _ in told][-2:], told[0][1]
    assert last == [total, total] and {of for _, of in told} == {total}  # its last part ends it: no jump


def test_it_is_searched_under_the_surface_s_worst_row_too(taichi_cpu):
    """A feature beside the row of the bump: both rows are looked at."""
    _, found = result(**{"feature.y": 0.25e-3})
    assert found.summary["below"]["y_m"] == found.summary["y_m"] < 0.1e-3


def test_the_surface_answers_as_it_did(found):
    _, top = result(**{"fatigue.depths": []})
    assert "below" not in top.summary and top.worst_below is None
    deeper = dict.fromkeys(("below", "contact_alone", "von_mises"), 0)
    assert {**top.summary, **deeper} == {**found.summary, **deeper}
    surface, both = top.summary["von_mises"], found.summary["von_mises"]
    assert surface["max_Pa"] == surface["surface_max_Pa"] == both["surface_max_Pa"] < both["max_Pa"]
    for name, (values, *_) in top.maps.items():
        np.testing.assert_array_equal(values, found.maps[name][0])


def test_of_a_row_alone_the_profile_is_that_of_the_row(taichi_cpu):
    scene = tehl.scene("furrow-line").replace(**{"thermal.on": False})
    found = assessment.run(scene, Rolling(scene, 12, 1))
    under = found.maps["findley_stress_under_row"][0]
    np.testing.assert_array_equal(under[0], found.maps["findley_stress"][0][:, 0])
    assert found.summary["below"]["findley_stress_max_Pa"] >= under[1:].max() * (1 - 1e-9)


@pytest.mark.parametrize("heat", [False, True])
def test_a_row_s_histories_at_the_surface_are_those_of_all_points(taichi_cpu, heat):
    scene = tehl.scene("gear").replace(**{"thermal.on": heat, "fatigue.residual_xx": 3e6})
    passage = StressHistories(scene, reader := Rolling(scene, rows=9), reader.centres)
    surface, deep = at_the_surface(passage)(slice(0, 4)).reshape(passage.x.size, 4, -1, 6), 40e-6
    for histories, row in zip(histories_of(passage, [0.0, deep], [(0, False), (3, False)]), (0, 3)):
        points = passage.history(slice(row, row + 1), passage.stresses(deep))
        np.testing.assert_allclose(histories[1], points, atol=1e-4 * np.abs(points).max())
        np.testing.assert_allclose(histories[0], surface[:, row], atol=1e-6 * np.abs(surface).max())


@pytest.mark.parametrize("heat,kind", [(False, "line"), (True, "line"), (True, "point")])
def test_histories_at_the_surface_are_those_of_whole_planes(taichi_cpu, heat, kind):
    """By transforms across, entry by entry, in place of products."""
    base = "gear" if kind == "line" else "ridge-on-ball"
    scene = tehl.scene(base).replace(**{"thermal.on": heat, "fatigue.residual_xx": 3e6})
    passage = StressHistories(scene, reader := Rolling(scene), reader.centres)
    rows, operator = slice(0, passage.y.size), passage.operator(0.0)
    found = at_the_surface(passage)(rows).reshape(passage.x.size, passage.y.size, -1, 6)
    wanted, thermal = np.zeros_like(found), passage.heat(ThermalStress) if heat else None
    for entry in range(len(reader)):
        fields = operator(*passage.loads(entry))
        if heat:
            w, held = thermal.waves, -thermal.stiffness * thermal._extended(thermal.rises[entry])
            spectrum = 2 * thermal.stiffness * thermal.thetas[passage.ticks[entry]] / np.where(w.k > 0, w.k, 1.0)
            nu, window = thermal.nu, (slice(0, thermal.columns), passage.rows)
            fields["sxx"] += (held + w.values((w.kx**2 + nu * w.ky**2) * spectrum))[window]
            fields["syy"] += (held + w.values((w.ky**2 + nu * w.kx**2) * spectrum))[window]
            fields["sxy"] += w.values((1 - nu) * w.kx * w.ky * spectrum, odd=True)[window]
        passage.follow(wanted, {entry: np.stack(list(fields.values()), axis=-1)})
    np.testing.assert_allclose(found, passage.resting(wanted, 0.0, rows), atol=2e-6 * np.abs(wanted).max())


class Beside(Rolling):
    """On a whole domain: the bump at 0.25 a across, and shear that is largest at -0.5 a, on the surface's worst row."""

    def __init__(self, scene):
        super().__init__(scene)
        self.y = np.linspace(-1, 1, 17) * self.s.a

    def fields(self, n, names):
        x, y = self.x[:, None] / self.s.a, self.y[None, :] / self.s.a
        hertz = self.s.p_H * np.sqrt(np.maximum(1 - x**2, 0)) + 0 * y
        at = x - self.centres[n] / self.s.a
        bump = np.exp(-(at**2 + (y - 0.25) ** 2) / 0.01) if n else 0 * hertz
        rub = np.exp(-(at**2 + (y + 0.5) ** 2) / 0.01) if n else 0 * hertz
        found = {"pressure": hertz * (1 + bump), "traction_x_a": hertz * (0.05 + 0.4 * rub), "traction_y_a": 0 * hertz}
        return {name: found[name] for name in names}


@pytest.mark.parametrize("until", [None, 0.4])
def test_on_a_whole_domain_the_worst_row_below_is_found(taichi_cpu, until):
    """Neither the row of the feature, 0, nor that of the worst point of the surface, -0.5 a."""
    scene = tehl.scene("gear").replace(**{"thermal.on": False, "fatigue.kappa": 0.0, "fatigue.surfaces": "a"})
    told = []
    found = assessment.run(scene, reader := Beside(scene), lambda *parts: told.append(parts), until)
    deep, a = found.summary["below"], reader.s.a
    assert found.summary["y_m"] == pytest.approx(-0.5 * a) and deep["y_m"] == pytest.approx(0.25 * a)
    plane, depth = found.maps["findley_stress_at_worst_depth"][0], float(found.maps["worst_depth"][0][0])
    whole = assessment.run(scene.replace(**{"fatigue.depths": [depth]}), reader)
    np.testing.assert_array_equal(plane, whole.maps["findley_stress_at_depth"][0][1])
    assert deep["findley_stress_max_Pa"] >= plane.max() * (1 - 1e-9)
    if until:
        early = found.summary["resolved"]["below"]
        assert early["y_m"] == pytest.approx(0.25 * a) and early["Fi_max"] <= deep["Fi_max"] * (1 + 1e-9)
    counts = [done for done, _ in told]
    assert counts == sorted(counts) and told[-1][0] == told[-1][1] and len({total for _, total in told}) == 1


@pytest.mark.parametrize("low_first", [True, False])
def test_windows_know_planes_of_more_moments_alone(taichi_cpu, low_first):
    """Whatever their order: of fewer moments nothing is known for more."""
    scene = tehl.scene("gear").replace(**{"thermal.on": False})
    passage = StressHistories(scene, reader := Rolling(scene), reader.centres)
    windows = [np.append(passage.centres < 0, True), slice(None)][:: 1 if low_first else -1]
    together = depth_profile.profiles(passage, [0, 3], windows)
    apart = [found for window in windows for found in depth_profile.profiles(passage, [0, 3], [window])]
    for one, other in zip(together, [apart[0], apart[2], apart[1], apart[3]]):
        np.testing.assert_allclose(one.f, other.f, rtol=1e-7)
        assert one.worst.y == other.worst.y and one.worst.f == pytest.approx(other.worst.f, rel=1e-7)
    assert max(together[0].f.max(), together[1].f.max()) > 1.02 * min(together[0].f.max(), together[1].f.max())


@pytest.mark.parametrize("workers", [1, 3])
def test_rows_that_look_bad_at_some_depth_are_named(taichi_cpu, monkeypatch, workers):
    """That of the worst point below among the two of all moments, by any number of threads; none of moments before it loads."""
    monkeypatch.setattr(candidate_rows, "WORKERS", workers)
    scene, told = tehl.scene("gear").replace(**{"thermal.on": False}), []
    passage = StressHistories(scene, reader := Beside(scene), reader.centres)
    rungs, worst = depth_profile.ladder(passage), int(np.argmin(np.abs(reader.y - 0.25 * reader.s.a)))
    found = candidate_rows.rows(passage, rungs, [slice(None)], lambda *parts: told.append(parts))
    assert worst in found and len(found) <= candidate_rows.MOST and told[-1][0] == told[-1][1] \
        == len(rungs[::candidate_rows.DEPTHS])
    early = [n for n in range(passage.centres.size) if passage.centres[n] < -1.2 * passage.a]
    least, = candidate_rows._ranges(passage, rungs[4], [np.array(early)])
    most, = candidate_rows._ranges(passage, rungs[4], [slice(None)])
    assert (least <= most).all() and least.max() < 0.7 * most.max()


def test_rows_are_chosen_by_the_strength_of_their_depth(monkeypatch):
    """Half of the strength at the second measured depth."""
    y = np.arange(5.0)
    measures = iter([np.array([[0.0, 1.0, 0.0, 0.9, 0.0]]), np.array([[0.0, 0.0, 0.0, 0.0, 0.8]])])
    monkeypatch.setattr(candidate_rows, "_ranges", lambda *_: [next(measures)])
    strength = SimpleNamespace(at=lambda depth: SimpleNamespace(share=2.0 if depth > 1 else 1.0))
    passage = SimpleNamespace(x=np.zeros(1), y=y, rows=slice(3, 8), a=1.0, strength=strength)
    assert candidate_rows.rows(passage, np.arange(4.0), [slice(None)]) == [3 + 4, 3 + 1]


def test_a_stress_that_is_equal_in_all_directions_has_no_shears():
    stress = dict(zip(half_space.COMPONENTS, 1e8 * np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]).reshape(6, 1, 1)))
    assert not candidate_rows._shears(stress).any()
    for axis in ("sxx", "syy", "szz"):
        pulled = {**stress, axis: stress[axis] + 1e8}
        assert sorted(np.abs(candidate_rows._shears(pulled)).ravel()) == [0.0] * 4 + [0.5e8] * 2


def test_depths_beyond_the_rungs_are_interpolated_well(taichi_cpu):
    """Histories between two rungs against those computed there: 0.5 % of the largest stress."""
    scene = tehl.scene("gear").replace(**{"thermal.on": False})
    passage = StressHistories(scene, reader := Rolling(scene, 12, 9), reader.centres)
    rungs = depth_profile.ladder(passage)
    assert rungs[0] == pytest.approx(passage.dx / 2) and rungs[-1] == pytest.approx(0.9 * passage.a)
    depths = np.sort(np.append(rungs, between := np.sqrt(rungs[3] * rungs[4])))
    histories = histories_of(passage, depths, [(0, False)])[0]
    kept = depths != between
    found = depth_profile._between(passage.strength, np.log(rungs), histories[kept], np.log(between))
    np.testing.assert_allclose(found, histories[~kept][0], atol=5e-3 * np.abs(histories[~kept]).max())


def test_a_worst_point_below_is_said():
    fatigue_ = {"Fi_max": 1.008, "below": {"Fi_max": 1.39, "depth_m": 24.8e-6},
                "contact_alone": {"Fi_max": 1.2, "depth_m": 183e-6, "error": {"Fi_max": 0.01}}}
    store = SimpleNamespace(scene=tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16}))
    said, = result_warnings.worst_below(store, {"fatigue": fatigue_})
    assert "Fi = 1.39 (error unknown) at 25 um, 1.01 (error unknown) at the surface" in said
    assert "1.200 ± 0.010 at 183 um" in said
    assert result_warnings.worst_below in result_warnings.CHECKS and "finer" not in said
    first = {**fatigue_["below"], "searched_m": [24.8e-6, 1e-3]}
    grid, = result_warnings.worst_below(store, {"fatigue": {**fatigue_, "below": first}})
    assert grid.endswith("use a finer grid: --grid 128x32 (8 times the work)")
    assert without_options(grid).endswith("use a finer grid: a grid of 128 × 32 cells (8 times the work)")
    assert result_warnings.worst_below(store, {"fatigue": {**fatigue_, "Fi_max": 1.5}}) == []
    assert result_warnings.worst_below(store, {"fatigue": {"Fi_max": 1.0}}) == result_warnings.worst_below(store, {}) == []


def test_a_worst_point_below_is_said_with_the_numbers_of_the_verdict():
    """Of averaged stresses, of the resolved part or of the other body, as the answer has them."""
    def part(Fi, error, **more):
        return {"Fi_max": Fi, "error": {"Fi_max": error}, "surface_angle_deg": 30.0, **more}

    whole = part(1.1, None, below=part(1.67, None, depth_m=2.3e-6))
    wide = {"averaged": part(1.0, 0.04, length_m=5e-6, below=part(1.25, 0.06, depth_m=5.1e-6))}
    early = {"resolved": part(0.8, 0.02, to_x_a=0.5, below=part(0.94, 0.03, depth_m=2e-5))}
    sound = part(0.7, 0.01)
    for searches, said in (
            ({"a": {**whole, **wide}}, "surface: Fi = 1.250 ± 0.060 at 5.1 um (stresses averaged over 5 um), 1.000 ± 0.040 at "
                                       "the surface (stresses averaged over 5 um)"),
            ({"a": {**whole, **early}}, "surface, while the grid resolves the pressure: Fi = 0.940 ± 0.030 at 20 um, "
                                        "0.800 ± 0.020 at the surface"),
            ({"a": part(0.9, 0.01), "b": {**sound, "below": part(0.95, 0.02, depth_m=2e-5)}},
             "surface of body b: Fi = 0.950 ± 0.020 at 20 um, 0.700 ± 0.010 at the surface"),
            ({"a": {**sound, "below": part(0.65, 0.01, depth_m=2e-5), **wide}}, None)):
        summary = {"fatigue": searches["a"], "fatigue_by_surface": searches}
        assert [str(one) for one in result_warnings.worst_below(None, summary)] == \
            [f"the critical point lies below the {said}"] * bool(said)
        point = judged_layers.judged_point(searches)
        assert bool(point.depth) == bool(said) and f"{point.Fi:.2f}" in (said or f"{point.Fi:.2f}")


def test_the_table_names_the_worst_point_s_own_tension(found):
    """sigma1_max_Pa is the largest anywhere on the surface, sigma1_worst_Pa that of the worst point."""
    f = found.summary
    i, j = (int(np.argmin(np.abs(found.maps[name][0] - f[key])))
            for name, key in (("feature_frame_x", "x_m"), ("feature_frame_y", "y_m")))
    tension = found.maps["sigma1_max"][0]
    assert f["sigma1_worst_Pa"] == pytest.approx(tension[i, j]) and f["sigma1_max_Pa"] == tension.max() > 1.02 * tension[i, j]
    rows = summary_rows.fatigue_rows(f)
    values = dict(reversed(rows))  # of equal words the first: those of the surface
    assert values["largest principal stress there"] == f"{f['sigma1_worst_Pa'] / 1e6:.1f} MPa"
    assert values["largest principal stress at the surface"] == f"{f['sigma1_max_Pa'] / 1e6:.1f} MPa"
    deep = f["below"]
    assert (f"Fi_max below the surface, at {deep['depth_m'] * 1e6:.0f} um", f"{deep['Fi_max']:.3g} (error unknown)") in rows


def test_the_angle_to_the_surface_is_that_of_the_plane(found):
    """Pulled and pressed along z, kappa 0.3: the normal at half arctan(1/kappa) = 36.7 degrees from z, so the plane lies 36.7
    degrees to the surface; alike along x and y (the same but for a pressure): 53.3 degrees. In a passage n . z = cos of it."""
    S, wave = np.zeros((2, 41, 6)), 1e8 * np.cos(np.linspace(0, 2 * np.pi, 41))
    S[0, :, 2] = S[1, :, 0] = S[1, :, 1] = wave
    half = np.degrees(np.arctan(1 / 0.3)) / 2
    theta, _ = findley.angles(findley.search(S, 0.3)[1])
    np.testing.assert_allclose(theta, (half, 90 - half), atol=0.01)
    normal, f = found.worst["normal"], found.summary
    assert np.cos(np.radians(f["surface_angle_deg"])) == pytest.approx(normal[2], abs=1e-9)
    assert np.tan(np.radians(f["plane_phi_deg"])) == pytest.approx(normal[1] / normal[0], rel=1e-6)


def drawn(monkeypatch, found, tmp_path):
    """{name: figure} that write_fatigue would have saved."""
    kept = {}
    monkeypatch.setattr(FigureStyle, "save", lambda page, draw, path: kept.setdefault(path.stem, draw()))
    write_fatigue(found, tehl.scene("gear"), tmp_path, FigureStyle())
    return kept


def lines(ax):
    return [line.get_xydata() for line in ax.lines]


@pytest.mark.parametrize("depths", [[20e-6, 60e-6], [1.4e-3]])
def test_figures_show_the_listed_depth_next_to_the_worst(taichi_cpu, monkeypatch, tmp_path, depths):
    """Beside the surface, never that again; the profile has every depth of the ladder."""
    _, layers = result(**{"fatigue.depths": depths})
    figures = drawn(monkeypatch, layers, tmp_path)
    index = [ax.collections[0].get_array().max() for ax in figures["fatigue"].axes if ax.get_title()]
    worst = layers.summary["below"]["depth_m"]
    near = min(layers.summary["by_depth"][1:], key=lambda layer: abs(layer["depth_m"] - worst))
    assert index == pytest.approx([layers.summary["Fi_max"], near["findley_stress_max_Pa"] / 400e6])
    ladder = lines(figures["fatigue_depth"].axes[1])[0]
    assert ladder[:, 1] == pytest.approx(layers.maps["under_row_depth"][0] * 1e6) and len(ladder) > 5


def test_figures_show_what_was_searched(found, monkeypatch, tmp_path):
    """The profile has every depth; one row: lines, not an empty map."""
    profile = lines(drawn(monkeypatch, found, tmp_path)["fatigue_depth"].axes[1])[0]
    assert profile[:, 0].max() == pytest.approx(found.maps["findley_stress_under_row"][0].max() / 400e6)
    scene = tehl.scene("furrow-line").replace(**{"thermal.on": False})
    row = assessment.run(scene, Rolling(scene, 12, 1))
    curve = lines(drawn(monkeypatch, row, tmp_path)["fatigue"].axes[0])[0]
    np.testing.assert_allclose(curve[:, 1], row.maps["Fi"][0][:, 0])


@pytest.mark.parametrize("value,said", [("deep", "auto"), (3.0, "auto"), ([0.5], "at most 0.03 m"), ([-1e-6], "1e-07")])
def test_depths_are_checked(value, said):
    with pytest.raises(SceneError, match="fatigue.depths") as error:
        tehl.scene("gear").replace(**{"fatigue.depths": value})
    assert said in str(error.value)


@pytest.mark.parametrize("threads", [0, -3])
def test_threads_of_the_fatigue_command_are_checked(threads):
    from tehl_cli.fatigue_command import fatigue as command

    with pytest.raises(RuntimeUnavailable, match=f"threads = {threads} is out of range") as refused:
        command("none.zarr", threads=threads)
    assert refused.value.exit_code == 2


def below_numbers(summary):
    """Fi and von Mises stress below the surface, of the passage and of the contact alone, and the depths of the passage."""
    alone = summary["contact_alone"]
    return [summary["below"]["Fi_max"], summary["von_mises"]["max_Pa"], alone["Fi_max"], alone["von_mises"]["max_Pa"],
            summary["below"]["depth_m"], summary["von_mises"]["depth_m"]]


@pytest.mark.parametrize("heat", [False, True])
def test_both_halves_of_a_passage_have_the_numbers_of_one(taichi_cpu, heat):
    """On the whole domain all points of the worst depth are searched, on the half domain its row alone."""
    scene = tehl.scene("gear").replace(**{"thermal.on": heat, "fatigue.surfaces": "a"})
    one, both = (below_numbers(assessment.run(scene, reader(scene, 12, 9)).summary) for reader in (Rolling, BothSides))
    np.testing.assert_allclose(both, one, rtol=1e-6)


def test_stresses_below_are_those_of_their_depth(taichi_cpu):
    """Of the worst point as a search of all points at that depth has it; of both von Mises stresses by the histories there."""
    scene, found = result()
    deep, steel = found.summary["below"], found.summary["von_mises"]
    _, there = result(**{"fatigue.depths": [deep["depth_m"]]})
    assert deep["findley_stress_max_Pa"] == pytest.approx(there.summary["by_depth"][1]["findley_stress_max_Pa"], rel=1e-6)
    passage = StressHistories(scene, reader := Rolling(scene, 8, 5), reader.centres)
    histories = histories_of(passage, [steel["depth_m"]], [(0, False)])[0][0]
    assert steel["max_Pa"] == pytest.approx(von_mises.largest(histories).max(), rel=1e-6)


def test_the_contact_alone_is_that_of_its_depth(taichi_cpu):
    """Below an endless line with shear: plane strain by the histories of the point at these depths."""
    scene = tehl.scene("gear").replace(**{"thermal.on": False})
    alone = contact_alone.search(scene, reader := Rolling(scene, 8, 5), scene.reference).summary
    sweep = SteadySweep(scene, reader, scene.reference)
    steel = alone["von_mises"]
    one, other = (histories_of(sweep, [part["depth_m"]], [(sweep.middle, True)])[0][0] for part in (alone, steel))
    assert alone["findley_stress_max_Pa"] == pytest.approx(findley.search(one, scene.fatigue.kappa)[0][0], rel=1e-6)
    assert steel["max_Pa"] == pytest.approx(von_mises.largest(other)[0], rel=1e-6)


@pytest.mark.parametrize("until", [None, 0.3])
def test_numbers_below_do_not_depend_on_the_rungs(taichi_cpu, monkeypatch, until):
    """With other rungs the depth moves a little, and the stress with the square of that."""
    scene, found = tehl.scene("gear").replace(**{"thermal.on": False, "fatigue.surfaces": "a"}), []
    for ratio in (1.5, 1.3):
        monkeypatch.setattr(depth_profile, "RATIO", ratio)
        found.append(assessment.run(scene, Rolling(scene, 12, 9), until=until).summary)
    for part in (below_numbers, *([lambda s: [s["resolved"]["below"]["Fi_max"]]] if until else [])):
        one, other = (part(summary) for summary in found)
        np.testing.assert_allclose(other[:4], one[:4], rtol=5e-5)


def test_only_rows_that_may_be_the_worst_are_computed_again(taichi_cpu, monkeypatch):
    """Of each set of moments; the others keep their interpolated worst points."""
    scene, asked = tehl.scene("gear").replace(**{"thermal.on": False}), []
    passage = StressHistories(scene, reader := Rolling(scene, rows=9), reader.centres)
    windows = [slice(None), np.append(np.flatnonzero(passage.centres < -0.2 * passage.a), passage.centres.size)]
    rows = [0, 1, 8]
    found = depth_profile.profiles(passage, rows, windows)
    plain = exact_depths.histories_of
    monkeypatch.setattr(exact_depths, "histories_of", lambda *how: asked.append(how[2][0][0]) or plain(*how))
    computed = exact_depths.computed(passage, rows, found, windows)
    tops = [max(one.worst.f for one in found[first::2]) for first in (0, 1)]
    near = [one.worst.f >= 0.98 * tops[n % 2] for n, one in enumerate(found)]
    assert [one.worst is other.worst for one, other in zip(computed, found)] == [not one for one in near]
    assert 0 in asked and 8 not in asked and not all(near[:2] + near[4:])
    early, = exact_depths.computed(passage, [0], depth_profile.profiles(passage, [0], windows[1:]), windows[1:])
    assert early.worst.f == pytest.approx(computed[1].worst.f, rel=1e-6) and early.mises.value < 0.99 * computed[0].mises.value
    assert all(one.worst.f == pytest.approx(other.worst.f, rel=3e-3) and one.worst.y == other.worst.y
               and one.worst.depth == other.worst.depth and len(one.worst.stress) == len(other.worst.stress)
               for one, other in zip(computed, found))
