"""Runs with run-in: what they store and say, a killed one resumed, and that runs without it know nothing of it."""

import shutil
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment
from tehl_taichi.fatigue.assessment import Snapshots
from tehl_taichi.march.passage import march
from tehl_taichi.plastic import run_in
from tehl_taichi.plastic.run_in import RunInState
from tehl_taichi.report import verdict
from tehl_taichi.runs import run_in_stage
from tehl_taichi.runs.summary import result_warnings, summary_rows
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.zoom_window import ZoomWindow

STEEL = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "feature.height": 3e-6,
                                      "time.run_in": 2, "bodies.a.yield_stress": 2.2e9, "numerics.estimate_error": False})


def test_a_run_without_it_imports_nothing_of_it():
    code = ("import sys; from tehl_taichi.runs import single_run, recorder, background_errors; from tehl_taichi.store import "
            "store; from tehl_taichi.runs.summary import summary; from tehl_taichi.march.accuracy import coarse_runs; "
            "from tehl_taichi.fatigue import assessment; sys.exit(any('tehl_taichi.plastic' in name for name in sys.modules))")
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


class Stop(tehl.Progress):
    """Stops a run at a step of a passage of run-in."""

    def __init__(self, passage, step):
        self.passage, self.at, self.begun = passage, step, 0

    def begin(self, scene):
        self.begun += 1

    def step(self, snapshot):
        if self.begun == self.passage and snapshot.step == self.at:
            raise KeyboardInterrupt


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    return tehl.run(STEEL, tmp_path_factory.mktemp("run") / "steel.zarr", threads=2)


@pytest.mark.slow
def test_it_flattens_the_asperity_and_counts_what_that_leaves(done):
    """5.5 GPa, 2.5 yield stresses, is what J2 leaves of 6.4 GPa (prototype: 5.55 GPa and 303 nm on 256x32 cells)."""
    found, elastic = done.summary["run_in"], tehl.run(STEEL.replace(**{"time.run_in": 0}), done.path.with_name("elastic.zarr"))
    assert done["p_max"].value == pytest.approx(2.52 * 2.2e9, rel=0.03) and elastic["p_max"].value > 6.2e9
    assert 200e-9 < found["surface_change_max_m"] < 330e-9 and found["contained"] and found["unsettled_m"] == 0.0
    assert found["height_after_m"] == pytest.approx(found["height_before_m"] - found["surface_change_max_m"], rel=0.01)
    below = [run.summary["fatigue_by_surface"]["a"]["below"]["Fi_max"] for run in (elastic, done)]
    assert 0.75 < below[1] / below[0] < 0.92
    assert "run_in" not in elastic.summary and not elastic.store.residual_fields


@pytest.mark.slow
def test_arrays_rows_and_sentences_say_what_it_left(done):
    data, found = done.to_xarray(), done.summary["run_in"]
    assert float(data.sinking_a.max()) == pytest.approx(found["surface_change_max_m"])
    assert float(data.residual_xx_a.min()) >= found["residual_min_Pa"] * 1.001 and data.residual_xx_a.units == "Pa"
    assert "sinking_b" not in data
    rows = dict(summary_rows.summary_rows(done.summary))
    assert rows["height after run-in"].startswith("2.7") and "passages of run-in" in rows
    said = " ".join(verdict.of(done.store).sentences)
    assert "passages of run-in the height is 2.7" in said and "residual stress" in said
    assert not any(one.code == "yield" and "both bodies" in one for one in done.warnings)
    again = done.fatigue()
    assert again.summary["Fi_max"] == done.summary["fatigue"]["Fi_max"]


@pytest.mark.slow
@pytest.mark.parametrize("passage, step", [(1, 20), (3, 30)])
def test_a_killed_run_resumes_inside_its_passage_to_the_same_numbers(done, tmp_path, passage, step):
    path = tmp_path / "killed.zarr"
    with pytest.raises(KeyboardInterrupt):
        tehl.run(STEEL, path, threads=2, progress=Stop(passage, step))
    where = ", passage 1 of run-in (round 1)" if passage == 1 else ", passage 1 of run-in (round 3)"
    assert run_in_stage.words(tehl.open(path).store) == where
    again = tehl.resume(path, threads=2)
    assert not run_in_stage.words(again.store)
    for key in ("surface_change_max_m", "residual_min_Pa", "plastic_strain_max", "history"):
        assert again.summary["run_in"][key] == done.summary["run_in"][key]
    assert again["p_max"].value == done["p_max"].value
    assert np.array_equal(again.store.fields(30, ["film"])["film"], done.store.fields(30, ["film"])["film"])


@pytest.mark.slow
def test_a_steady_start_that_is_resumed_runs_in(done, tmp_path):
    start = tehl.run(STEEL.replace(**{"time.steps": 0}), tmp_path / "start.zarr", threads=2)
    assert "run_in" not in start.summary and start.store.run_in.bodies == {}
    assert tehl.resume(start.path, threads=2).summary["run_in"]["history"] == done.summary["run_in"]["history"]


@pytest.mark.slow
def test_where_nothing_yields_the_passage_is_the_elastic_one(tmp_path):
    hard = STEEL.replace(**{"bodies.a.yield_stress": 4e9})
    runs = [tehl.run(scene, tmp_path / f"{n}.zarr") for n, scene in enumerate((hard, hard.replace(**{"time.run_in": 0})))]
    assert runs[0].summary["run_in"]["passages"] == 0 and runs[0].summary["run_in"]["shaken_down"]
    assert runs[0].summary["fatigue"]["Fi_max"] == runs[1].summary["fatigue"]["Fi_max"]
    assert "no steel yields" in " ".join(verdict.of(runs[0].store).sentences)


@pytest.mark.slow
def test_coarse_grid_runs_run_in_by_themselves(tmp_path):
    scene = STEEL.replace(**{"grid.nx": 128, "grid.ny": 16, "feature.height": 1.5e-6, "bodies.a.yield_stress": 1.5e9,
                             "numerics.estimate_error": True, "time.run_in": 1})
    found = tehl.run(scene, tmp_path / "bars.zarr").summary["run_in"]
    assert set(found["error"]) == {"surface_change_max_m", "height_after_m", "plastic_strain_max", "residual_min_Pa",
                                   "residual_max_Pa"}
    assert found["error"]["height_after_m"] is None or 0 < found["error"]["height_after_m"] < 0.3e-6


@pytest.mark.slow
def test_a_window_has_the_surface_and_the_residual_stress_of_its_run(done, tmp_path):
    """As a passage on a grid twice as fine over the same surface and steel, which differs from the run by ten times as much."""
    path, state = shutil.copytree(done.path, tmp_path / "zoomed.zarr"), done.store.run_in
    found = tehl.zoom(path, 2)
    fine = STEEL.replace(**{"grid.nx": 128, "grid.ny": 32, "time.run_in": 0})
    reader = Snapshots(march(fine, changes=state.changes), state.residual_fields)
    p = max(shot.scalars["p_max_Pa"] for shot in reader.items[1:])
    assert abs(found["p_max"].value - p) < min(1e-3 * p, 0.2 * abs(done["p_max"].value - p))
    own, there = found.summary["fatigue_by_surface"]["a"], assessment.run(fine, reader, alone=False).summaries["a"]
    assert own["Fi_max"] == pytest.approx(there["Fi_max"], rel=0.02)
    assert own["below"]["Fi_max"] == pytest.approx(there["below"]["Fi_max"], rel=0.01)
    assert found.summary["run_in"]["history"] == done.summary["run_in"]["history"] and found.store.map("sinking_a").max() > 2e-7
    removed = tehl.zoom(path, 0)
    assert removed.summary["fatigue"] == done.summary["fatigue"] and removed.store.map("zoom_pressure") is None


@pytest.mark.slow
def test_a_window_with_temperatures_has_the_surface_heat_and_residual_stress_after_run_in(tmp_path, monkeypatch):
    """In one command; as a thermal passage on a grid twice as fine over the same surfaces and steel of both bodies. Any
    surface will do, so one round leaves it. Up to 0.9 a: later oil leaves the touching outlet under a pressure one cell wide,
    where temperatures have two solutions on 64 columns (230 and 303 deg C at 0.96 a; 233 on 128 columns)."""
    monkeypatch.setattr(run_in, "ROUNDS", 1)
    scene = STEEL.replace(**{"thermal.on": True, "time.run_in": 1, "zoom.factor": 2, "bodies.b.yield_stress": 2.2e9,
                             "fatigue.to_x": 0.9})
    found = tehl.run(scene, tmp_path / "hot.zarr", threads=2)
    state, end, window = found.store.run_in, 0.9 * Scales.of(scene).a, ZoomWindow.of(found.store)
    fine = scene.replace(**{"grid.nx": 128, "grid.ny": 32, "time.run_in": 0, "zoom.factor": 0})
    reader = Snapshots(march(fine, changes=state.changes), state.residual_fields)
    for name in ("pressure", "temperature_mid", "temperature_a", "temperature_b"):
        own, base, there = (max(float(np.max(one.fields(n, (name,))[name])) for n in entries if one_x(n) <= end)
                            for one, one_x, entries in (
                                (window, found.store.feature_x, window.entries.tolist()),
                                (found.store, found.store.feature_x, range(1, len(found.store))),
                                (reader, reader.feature_x, range(1, len(reader)))))
        assert abs(own - there) < max(1e-3 * there, 0.3 * abs(base - there)), (name, own, base, there)
    searched = assessment.run(fine, reader, alone=False).summaries
    for body in "ab":
        now, there = found.summary["fatigue_by_surface"][body], searched[body]
        assert now["Fi_max"] == pytest.approx(there["Fi_max"], rel=0.02), body
        assert now["below"]["Fi_max"] == pytest.approx(there["below"]["Fi_max"], rel=0.02), body


def test_a_window_says_that_steel_flowed_on_the_grid_of_the_run():
    """And under less pressure than it has, where that is so."""
    zoom = {"p_max_Pa": 5.5e9, "base": {"p_max_Pa": 5e9}}
    run_in = {"new_plastic_strain": 0.0, "plastic_strain_max": 1e-3, "unsettled_m": 0.0, "contained": True,
              "surface_change_max_m": 1.73e-7, "error": {"surface_change_max_m": 2.5e-8}}
    store = SimpleNamespace(scene=STEEL)
    said, = result_warnings.running_in(store, {"run_in": run_in, "zoom": zoom})
    assert "bars of the zoom window do not contain that of the run-in" in said and "(surface change 173 ± 25 nm); it" in said
    assert "it flowed under up to 5.00 GPa, while the window has 5.50 GPa" in said
    for less in ({"p_max_Pa": 5.1e9, "base": {"p_max_Pa": 5e9}}, {"p_max_Pa": 4.5e9, "base": {"p_max_Pa": 4e9}}):
        said, = result_warnings.running_in(store, {"run_in": {**run_in, "error": {"surface_change_max_m": None}}, "zoom": less})
        assert said.endswith("(surface change 173 nm, error unknown)")
    assert not list(result_warnings.running_in(store, {"run_in": {**run_in, "plastic_strain_max": 0.0}, "zoom": zoom}))
    assert not list(result_warnings.running_in(store, {"run_in": run_in}))


@pytest.mark.parametrize("state, words", [
    (None, ""), (RunInState(), ", passage 1 of run-in (round 1)"), (RunInState(rounds=2), ", passage 1 of run-in (round 3)"),
    (RunInState(passages=1), ", passage 2 of run-in"), (RunInState(passages=2), ", the passage after run-in"),
    (RunInState(passages=1, done=True), "")])
def test_an_unfinished_run_says_which_passage_it_has_reached(state, words):
    assert run_in_stage.words(SimpleNamespace(run_in=state, scene=STEEL)) == words
