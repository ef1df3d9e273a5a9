"""The smooth contact alone: against Hertz, against passages in which nothing changes, its error bars, what is said of it."""

from types import SimpleNamespace

import numpy as np
import pytest
from rolling import Dry, Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment, contact_alone, findley, von_mises
from tehl_taichi.fatigue.stress.row_histories import histories_of
from tehl_taichi.fatigue.stress.steady_sweep import SteadySweep
from tehl_taichi.march.accuracy import contact_alone_bars
from tehl_taichi.report import verdict
from tehl_taichi.runs.summary import summary_rows
from tehl_taichi.scene.scales import Scales

pytestmark = pytest.mark.usefixtures("taichi_cpu")
NO_SHEAR = {"fatigue.shear": False, "fatigue.kappa": 0.0, "thermal.on": False}


@pytest.mark.parametrize("name, stress, depth", [("smooth-line", 0.25, 0.5), ("ball-on-disc", 0.214, 0.35)])
def test_without_shear_it_is_the_shear_along_the_surface_below_a_dry_contact(name, stress, depth):
    """From -0.25 p_H to 0.25 p_H at 0.5 a of a line, 0.214 p_H at 0.35 a of a circle (Johnson 1985, sections 4.2, 4.3)."""
    scene = tehl.scene(name).replace(**NO_SHEAR)
    found, s = contact_alone.search(scene, Dry(scene), scene.surfaces[0]).summary, Scales.of(scene)
    assert found["findley_stress_max_Pa"] == pytest.approx(stress * s.p_H, rel=0.02)
    assert found["depth_m"] == pytest.approx(depth * s.a, rel=0.06)
    assert found["Fi_max"] == pytest.approx(found["findley_stress_max_Pa"] / scene.fatigue.endurance)


@pytest.mark.parametrize("surface", ["a", "b"])
@pytest.mark.parametrize("heat", [False, True])
def test_a_passage_in_which_nothing_changes_has_the_same(heat, surface):
    """Under the far row and at the surface, with shear, with heat."""
    scene = tehl.scene("gear").replace(**{"thermal.on": heat, "srr": -0.12, "fatigue.surfaces": surface,
                                          "feature.surface": surface})

    class Steady(Rolling):
        def fields(self, n, names):
            return super().fields(0, names)

    found = assessment.run(scene, Steady(scene, 16, 2)).summary
    alone = found["contact_alone"]
    assert alone["Fi_max"] == pytest.approx(max(found["Fi_max"], found["below"]["Fi_max"]), rel=4e-3)
    assert alone["surface_Fi_max"] == pytest.approx(found["Fi_max"], rel=4e-3)
    assert alone["depth_m"] == pytest.approx(found["below"]["depth_m"], rel=0.03)


def test_shear_counts_where_it_is_to_count_and_the_mirror_has_the_same():
    scene = tehl.scene("smooth-line").replace(**{"thermal.on": False})
    with_shear, turned, without = (contact_alone.search(one, Dry(scene, shear=f), scene.surfaces[0]).summary for one, f in (
        (scene, 0.3), (scene, -0.3), (scene.replace(**{"fatigue.shear": False}), 0.3)))
    assert with_shear["surface_Fi_max"] > 1.5 * without["surface_Fi_max"] and with_shear["shear_counted"]
    assert turned["Fi_max"] == pytest.approx(with_shear["Fi_max"], rel=1e-6)
    assert not without["shear_counted"]
    assert contact_alone.search(scene, Dry(scene, shear=1.0), scene.surfaces[0]).summary["depth_m"] == 0.0


def test_the_feature_the_moments_and_the_listed_depths_have_no_part_in_it():
    scene = tehl.scene("gear").replace(**{"thermal.on": False})
    others = [scene.replace(**changes) for changes in ({"height": 2e-6}, {"fatigue.from_x": 0.5}, {"fatigue.depths": [1e-5]})]
    first, *rest = (contact_alone.search(one, Rolling(one), one.surfaces[0]).summary for one in (scene, *others))
    assert all(one == first for one in rest)
    none = scene.replace(**{"fatigue.depths": []})
    at_top = contact_alone.search(none, Rolling(none), none.surfaces[0]).summary
    assert (at_top["depth_m"], at_top["Fi_max"]) == (0.0, first["surface_Fi_max"])


def types_of(values):
    """The types of all numbers in a summary."""
    return {kind for one in values.values() for kind in (types_of(one) if isinstance(one, dict) else {type(one)})}


@pytest.mark.parametrize("table", ["", "case-hardened"])
def test_numbers_are_those_of_python(table):
    """As in summaries that are read from a store: print(summary) shows 1.2, not np.float64(1.2)."""
    scene = tehl.scene("smooth-line").replace(**{"thermal.on": False, "fatigue.table": table, "fatigue.depths": "auto"})
    found = contact_alone.search(scene, Dry(scene, shear=0.05), scene.surfaces[0]).summary
    assert found["depth_m"] > 0 and types_of(found) <= {float, int, bool, str}


class Lobed(Dry):
    """A dry circle with a lobe of shear beside its axis, 0.1 b wide, `at` b from it."""

    at = 0.55

    def fields(self, n, names):
        found, b = super().fields(n, ("pressure", "traction_x_a", "traction_y_a")), self.y[-1] / 1.5
        lobe = np.exp(-((self.x[:, None] / b) ** 2 + (self.y[None] / b - self.at) ** 2) / 0.01)
        found["traction_x_a"] = 0.3 * self.p.max() * lobe
        return {name: found[name] for name in names}


@pytest.mark.parametrize("cells", [16, 32, 48])
def test_the_worst_row_of_a_circle_is_found(cells):
    """As all rows, one by one; on more than 32 of them every second or third one is searched first. And below it."""
    scene = tehl.scene("ball-on-disc").replace(**{"thermal.on": False})
    reader, surface = Lobed(scene, cells), scene.surfaces[0]
    found = contact_alone.search(scene, reader, surface)
    sweep = SteadySweep(scene, reader, surface)
    histories = [histories_of(sweep, [0.0], [(row, False)])[0][0] for row in range(reader.y.size)]
    each = [findley.search(history, scene.fatigue.kappa)[0][0] for history in histories]
    worst = int(np.argmax(each))
    assert abs(reader.y[worst] / reader.y[-1] * 1.5 - Lobed.at) < 0.1 and max(each) > 2 * each[0]
    assert found.summary["surface_Fi_max"] == pytest.approx(max(each) / scene.fatigue.endurance, rel=1e-6)
    assert found.f[0] == pytest.approx(each[0], rel=1e-6)
    assert found.summary["Fi_max"] >= found.summary["surface_Fi_max"]
    mises = max(von_mises.largest(history)[0] for history in histories)
    assert found.summary["von_mises"]["surface_max_Pa"] == pytest.approx(mises, rel=1e-3)


def test_indices_near_a_peak_that_the_grid_does_not_resolve_are_unknown():
    """mtm: its surface, and what lies a cell below it; not the index at a third of the half-width."""
    scene = tehl.scene("mtm").replace(**{"grid.nx": 128, "grid.ny": 64})
    first = next(tehl.march(scene))
    assert first.error["p_max_Pa"] is None
    near = 2 * float(first.x[1] - first.x[0])
    for found in contact_alone_bars.searches(scene, first).values():
        assert found["error"]["surface_Fi_max"] is None and "pressure peak" in found["unknown"]["surface_Fi_max"]
        assert (found["error"]["Fi_max"] is None) == (found["depth_m"] < near)


@pytest.mark.slow
@pytest.mark.parametrize("name, columns", [("smooth-line", (64, 512)), ("ball-on-disc", (64, 128))])
def test_the_bar_of_a_coarse_grid_covers_a_fine_one(name, columns):
    def found(nx):
        scene = tehl.scene(name).replace(**{"grid.nx": nx, "grid.ny": nx // 2, "thermal.on": False})
        return contact_alone_bars.searches(scene, next(tehl.march(scene)))

    coarse, fine = map(found, columns)
    for surface, one in fine.items():
        for key in contact_alone_bars.INDICES:
            assert abs(coarse[surface][key] - one[key]) <= coarse[surface]["error"][key] < 0.2 * one[key]


def test_a_steady_run_says_what_its_smooth_bodies_bear(tmp_path):
    scene = tehl.scene("smooth-line").replace(**{"grid.nx": 64, "thermal.on": False})
    run = tehl.run(scene, tmp_path / "one.zarr")
    summary = run.summary
    alone = summary["contact_alone"]
    assert alone == {"surface": alone["surface"], **summary["contact_alone_by_surface"][alone["surface"]]}
    assert set(summary["contact_alone_by_surface"]) == {"a", "b"} and alone["error"]["Fi_max"] > 0
    assert run["contact_alone.Fi_max"].error == alone["error"]["Fi_max"]
    rows = dict(summary_rows.summary_rows(summary))
    assert any(what.startswith("Fi_max of the smooth contact, at 18") for what in rows)
    answer = verdict.of(run.store)
    assert any(one.startswith("The smooth contact alone: Fi = 1.") and "above 1" in one for one in answer.sentences)
    assert any("fatigue limit σ_eF = 400 MPa" in one for one in answer.doubts)
    off = tehl.run(scene.replace(**{"fatigue.on": False}), tmp_path / "off.zarr").summary
    assert "contact_alone" not in off


@pytest.mark.parametrize("Fi, tail", [(1.2, ". The load alone exceeds it, without any feature."), (1.005, "."), (0.9, ".")])
def test_the_verdict_begins_with_the_load(Fi, tail):
    alone = {"Fi_max": Fi, "depth_m": 183e-6, "surface_Fi_max": 0.6, "error": {"Fi_max": 0.01, "surface_Fi_max": 0.01}}
    found = {"surface": "a", "Fi_max": 1.4, "error": {"Fi_max": 0.05}, "surface_angle_deg": 60.0, "contact_alone": alone}
    _, headline, tone, said = verdict.of_fatigue(found)
    assert tone == "yes" and headline == "Yes: the fatigue limit is exceeded at the surface" + tail
    assert said[0].startswith(f"The smooth contact alone: Fi = {Fi:.3f} ± 0.010 at 183 µm below surface a, ")
    assert said[1].startswith("At the surface: Fi = 1.400 ± 0.050")


BY_LOAD = "yes: the fatigue limit is exceeded by the load alone, without any feature"


@pytest.mark.parametrize("error, Fi, of_load, rest", [
    (0.01, 0.98, f"{BY_LOAD}.", "not decided: the index is 1 within"),
    (0.01, 0.8, f"{BY_LOAD}.", "no: the index stays below 1."),
    (None, 0.8, f"probably {BY_LOAD}; the error of this is unknown.", "no: the index stays below 1.")])
def test_a_load_above_the_limit_answers_where_the_feature_does_not(error, Fi, of_load, rest):
    alone = {"Fi_max": 1.2, "depth_m": 183e-6, "surface_Fi_max": 0.6, "error": {"Fi_max": error}}
    found = {"surface": "a", "Fi_max": Fi, "error": {"Fi_max": 0.05}, "surface_angle_deg": 60.0, "contact_alone": alone}
    _, headline, tone, _ = verdict.of_fatigue(found)
    assert tone == "yes" and headline.startswith(f"{of_load[0].upper()}{of_load[1:]} Around the feature: {rest}")


def test_a_known_load_makes_a_probable_answer_sure():
    alone = {"Fi_max": 1.2, "depth_m": 183e-6, "surface_Fi_max": 0.6, "error": {"Fi_max": 0.01}}
    found = {"surface": "a", "Fi_max": 1.4, "surface_angle_deg": 60.0, "contact_alone": alone}
    assert verdict.of_fatigue(found)[1].startswith("Yes: the fatigue limit is exceeded by the load alone, without any feature. "
                                                   "Around the feature: probably yes: ")


@pytest.mark.parametrize("middle", [0, 48])
def test_the_worst_row_of_a_fine_surface_is_found_on_either_side(monkeypatch, middle):
    """Every third row first, then those beside the worst of them: any row may be the worst."""
    sweep = SimpleNamespace(line=False, middle=middle, reader=SimpleNamespace(y=np.arange(97.0)))
    for worst in range(97):
        def values(sweep, local, rows, worst=worst):
            return np.zeros((len(rows), 2, 6)), -abs(np.array(rows) - worst - 0.1)

        monkeypatch.setattr(contact_alone, "_searched", values)
        rows, histories, f = contact_alone._at_surface(sweep, None)
        assert rows[int(np.argmax(f))] == worst and middle in rows and len(rows) == len(histories) == len(f) < 40
