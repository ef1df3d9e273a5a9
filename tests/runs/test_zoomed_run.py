"""Runs with a fine window: numbers, bars, what is stored, and windows that are added to a finished run."""

import json
import shutil
import subprocess
import sys
from dataclasses import replace
from types import SimpleNamespace

import made_results
import numpy as np
import pytest
from commands import here
from small_stores import SMALL

import tehl_taichi as tehl
from tehl_taichi.errors import Interrupted
from tehl_taichi.fatigue.judged_surfaces import by_surface
from tehl_taichi.fatigue.search_result import SearchResult
from tehl_taichi.report import chain_plot
from tehl_taichi.store.integrity import EXTENDED
from tehl_taichi.store.reader import Reader
from tehl_taichi.view.zoom_window import ZoomWindow

LINE = tehl.scene("pitch-line").replace(**{"feature.length": float("inf"), "grid.nx": 64, "thermal.on": False,
                                           "fatigue.surfaces": "a", "time.x_end": 0.4, "numerics.estimate_error": False})
WHOLE = LINE.replace(**{"time.x_end": float("inf"), "numerics.estimate_error": True, "fatigue.on": False})
ZOOMED = LINE.replace(**{"zoom.factor": 4})


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("zoom")


@pytest.fixture(scope="module")
def plain(folder):
    return tehl.run(LINE, folder / "plain.zarr")


@pytest.fixture(scope="module")
def zoomed(folder):
    return tehl.run(ZOOMED, folder / "zoomed.zarr")


def numbers(summary):
    """A summary without what belongs to one run."""
    return json.dumps({key: value for key, value in summary.items() if key not in ("store", "wall_s", "compile_s", "crowding")})


def test_its_numbers_are_those_of_the_window(plain, zoomed):
    zoom, base = zoomed.summary["zoom"], plain.summary["transient"]
    assert zoom["factor"] == 4 and len(zoom["window_a"]) == 2 and "ended" not in zoom
    assert zoom["base"]["p_max_Pa"] == base["p_max_Pa"] != zoom["p_max_Pa"]
    for key in ("p_max_Pa", "h_min_m"):
        assert zoomed.summary["transient"][key] == zoom[key]
        assert zoomed.summary["transient"]["error"][key] == zoom["error"][key]
    deep = max(part["Fi_max"] for part in (zoomed.summary["fatigue"], zoomed.summary["fatigue"]["below"]))
    assert zoom["Fi_max"] == deep != plain.summary["fatigue"]["Fi_max"]
    assert zoomed["p_max"].value == zoom["p_max_Pa"]


def test_its_bars_hold_the_numbers_of_a_run_four_times_finer(zoomed, folder):
    fine = tehl.run(LINE.replace(**{"grid.nx": 256}), folder / "fine.zarr").summary
    zoom, error = zoomed.summary["zoom"], zoomed.summary["zoom"]["error"]
    assert abs(zoom["p_max_Pa"] - fine["transient"]["p_max_Pa"]) < min(error["p_max_Pa"], 0.003 * zoom["p_max_Pa"])
    found, there = zoomed.summary["fatigue"], fine["fatigue"]
    assert abs(found["Fi_max"] - there["Fi_max"]) < found["error"]["Fi_max"]
    assert abs(found["below"]["Fi_max"] - there["below"]["Fi_max"]) < found["below"]["error"]["Fi_max"]


def test_its_fatigue_with_other_constants_has_the_window(plain, zoomed):
    """With those of the run it is the stored search; the largest index moves with the limit and keeps its bar."""
    stored, again = zoomed.summary["fatigue"], zoomed.fatigue().summary
    for now, there in ((again, stored), (again["below"], stored["below"])):
        for key in ("Fi_max", "x_m", "y_m"):
            assert now[key] == pytest.approx(there[key], rel=1e-6), key
        assert now["error"]["Fi_max"] == pytest.approx(there["error"]["Fi_max"], rel=1e-5)
    assert again["statistics"]["p99"] == pytest.approx(stored["statistics"]["p99"], rel=1e-6)
    assert again["contact_alone"]["Fi_max"] == pytest.approx(stored["contact_alone"]["Fi_max"], rel=1e-6)
    half = zoomed.fatigue(endurance=800e6).summary
    assert half["Fi_max"] == pytest.approx(stored["Fi_max"] / 2, rel=1e-6)
    assert half["Fi_max"] != pytest.approx(plain.fatigue(endurance=800e6).summary["Fi_max"], rel=1e-3)
    assert half["error"]["Fi_max"] == pytest.approx(stored["error"]["Fi_max"] / 2, rel=1e-5)


def test_its_page_has_pressure_of_the_window_and_stress_of_the_smooth_contact(zoomed):
    """From the load to the verdict: the depths of the window differ from those of the run."""
    store = zoomed.store
    result = SearchResult.from_arrays(by_surface(store.summary), store.map)
    figure, = chain_plot.figures(store, SimpleNamespace(result=result, scene=store.scene, on=""))
    lines = {(one["name"], one["xaxis"]): np.array(one["y" if one["xaxis"] == "x" else "x"]) for one in figure.traces}
    assert lines["zoom window", "x"].max() * 1e9 == pytest.approx(store.map("zoom_pressure").max(), rel=1e-6)
    assert lines["zoom window", "x"].max() != lines["with the feature", "x"].max()
    smooth = lines["smooth contact", "x4"].max()
    assert smooth == pytest.approx(zoomed.summary["fatigue"]["contact_alone"]["Fi_max"], rel=0.01)


def test_its_fields_are_stored_with_their_places(zoomed):
    store = Reader.open(zoomed.path)
    p, left, x, entries = (store.map(f"zoom_{name}") for name in ("pressure", "left", "x", "entry"))
    assert p.shape == (len(entries), x.size, 1) and p.dtype == np.float32
    assert p.max() <= zoomed.summary["zoom"]["p_max_Pa"] * (1 + 1e-6) < 1.01 * p.max()  # that of moments between steps, too
    step = x[1] - x[0]
    assert step == pytest.approx((store.x[1] - store.x[0]) / 4)
    last = int(entries[-1])
    at = np.round((store.x - left[-1]) / step).astype(int)
    shared = (at >= 0) & (at < x.size) & (np.abs(at * step + left[-1] - store.x) < 1e-9)
    run = store.fields(last, ("pressure",))["pressure"][shared, 0]
    assert np.abs(p[-1, at[shared], 0] - run)[[0, 1, -1]].max() < 1e-5 * run.max()  # the border of the window is the run's


def test_a_window_that_is_added_later_is_the_same_and_can_be_removed(plain, zoomed, folder):
    later = tehl.run(LINE, folder / "later.zarr")
    later = tehl.zoom(later.path)
    assert later.scene == ZOOMED and numbers(later.summary) == numbers(zoomed.summary)
    assert tehl.zoom(later.path) is not later and numbers(tehl.open(later.path).summary) == numbers(zoomed.summary)
    removed = tehl.zoom(later.path, 0)
    assert numbers(removed.summary) == numbers(plain.summary) and Reader.open(later.path).map("zoom_pressure") is None


@pytest.mark.slow  # kernels of a window with temperatures; quick: tests/march/zoom/test_window_heat.py
def test_a_window_with_temperatures_has_the_hottest_film(folder):
    """Added to a finished run, which marches again for it, and with it."""
    scene = tehl.scene("gear").replace(**{"feature.length": float("inf"), "grid.nx": 64, "fatigue.surfaces": "a",
                                          "time.x_end": -0.2, "numerics.estimate_error": False})
    run = tehl.run(scene, folder / "warm.zarr")
    later = tehl.zoom(run.path, 2)
    zoom, transient = later.summary["zoom"], later.summary["transient"]
    for key in ("film_max_C", "surface_a_max_C", "surface_b_max_C"):
        assert transient[key] == zoom[key] != zoom["base"][key] == run.summary["transient"][key]
        assert transient["error"][key] == zoom["error"][key] >= 0.5 * abs(zoom[key] - zoom["base"][key])
    store = Reader.open(later.path)
    assert store.map("zoom_temperature_b").max() == pytest.approx(zoom["surface_b_max_C"], abs=0.01)
    assert later.summary["fatigue"]["Fi_max"] != run.summary["fatigue"]["Fi_max"]
    whole = tehl.run(scene.replace(**{"zoom.factor": 2}), folder / "warm_whole.zarr")
    assert numbers(later.summary) == numbers(whole.summary)


def test_a_late_window_follows_the_run_from_a_state_that_it_kept(folder, monkeypatch):
    """With the digits of one that follows it from its start."""
    from tehl_taichi.march.zoom import marched_heat
    from tehl_taichi.runs import recorder

    scene = tehl.scene("gear").replace(**{"feature.length": float("inf"), "grid.nx": 64, "time.x_end": 0.0,
                                          "fatigue.depths": (), "numerics.estimate_error": False, "zoom.factor": 2,
                                          "zoom.from_x": -0.2})
    begun, march = [], marched_heat.march

    def watched(scene, state=None, changes=()):
        begun.append(0 if state is None else int(state["step"]))
        return march(scene, state, changes)

    monkeypatch.setattr(marched_heat, "march", watched)
    summaries = []
    for name, seconds in (("kept", 0.0), ("start", 1e9)):  # between the states that are kept
        monkeypatch.setattr(recorder, "EVERY", seconds)
        run = tehl.run(scene, folder / f"{name}.zarr")
        first = int(Reader.open(run.path).map("zoom_entry")[0]) - 1
        assert begun[-1] > 0 if name == "kept" else set(begun) == {0}
        assert begun[-1] <= first - 4
        summaries.append(numbers(run.summary))
        begun.clear()
    assert summaries[0] == summaries[1]


def test_what_cannot_have_a_window(plain, folder):
    with pytest.raises(tehl.SceneError, match="zoom.factor = 5 is not one of"):
        tehl.zoom(plain.path, 5)
    assert tehl.open(plain.path).finished
    steady = tehl.run(tehl.scene("smooth-line").replace(**{"grid.nx": 64, "thermal.on": False}), folder / "steady.zarr")
    with pytest.raises(tehl.SceneError, match="steady.zarr cannot have a window: nothing passes"):
        tehl.zoom(steady.path)
    with pytest.raises(tehl.SceneError, match="steady.zarr cannot have a window: nothing passes"):
        tehl.zoom(steady.path, "auto")
    with pytest.raises(tehl.StoreError, match="nothing.zarr"):
        tehl.zoom(folder / "nothing.zarr")


@pytest.mark.parametrize("factor", [4, "auto"])
def test_a_run_of_too_few_moments_has_no_window(tmp_path, factor):
    path = made_results.run(tmp_path / "made.zarr", tehl.scene("gear").replace(**{"time.steps": 1}), 2)
    with pytest.raises(tehl.SceneError, match="a window needs at least 3 stored moments, this run has 2; extend it"):
        tehl.zoom(path, factor)


def test_a_window_that_is_there_already_is_said(tmp_path, capsys):
    path = made_results.run(tmp_path / "made.zarr", SMALL, 3)
    assert not tehl.zoom(path, 0, progress=tehl.Lines()).scene.zooms and "has no window already" in capsys.readouterr().err


def test_a_window_that_ends_early_is_a_warning(folder, monkeypatch):
    from tehl_taichi.march.zoom import zoomed_passage

    whole = zoomed_passage.passages

    def end(scene, reader, factors, *more):
        passages = whole(scene, reader, factors, *more)
        for found, in passages:
            for values in (found.entries, found.origins, *found.fields.values()):
                del values[20:]
            found.ended = "it did not converge with the feature at -0.37 a"
        return passages

    monkeypatch.setattr(zoomed_passage, "passages", end)
    run = tehl.run(ZOOMED.replace(**{"fatigue.on": False}), folder / "ended.zarr")
    warning = next(one for one in run.warnings if one.code == "zoom")
    assert "ended early: it did not converge with the feature at -0.37 a" in warning
    assert run.finished and run.summary["zoom"]["to_a"] < 0


@pytest.mark.slow  # a process of its own
def test_without_a_window_only_its_check_is_loaded(tmp_path):
    code = ("import sys, tehl_taichi as tehl; "
            "tehl.run(tehl.scene('pitch-line').replace(**{'feature.length': float('inf'), 'grid.nx': 64, 'time.steps': 3}), "
            "'a.zarr'); print([name for name in sys.modules if 'zoom' in name or 'windowed' in name])")
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, text=True, capture_output=True)
    assert done.stdout.strip().splitlines()[-1] == "['tehl_taichi.scene.zoom_room']", done.stderr[-500:]


@pytest.fixture(scope="module")
def of_both():
    """A line with a dent on body a and an asperity on b."""
    dent, asperity = (replace(LINE.features[0], surface=name, height=height, x=x)
                      for name, height, x in (("a", -1.5e-6, 0.0), ("b", 1.5e-6, -2e-4)))
    return replace(LINE, features=(dent, asperity)).replace(srr=0.12, **{"fatigue.surfaces": "both"})


@pytest.fixture(scope="module")
def with_two(of_both, folder):
    return tehl.zoom(tehl.run(of_both, folder / "two.zarr").path, 4)


def test_features_of_both_bodies_have_windows(of_both, with_two, folder):
    """The largest pressure and the smallest film are those of the asperity, outside of the window of the dent."""
    fine = tehl.run(of_both.replace(**{"grid.nx": 256}), folder / "two_fine.zarr").summary
    zoom, (p, h) = with_two.summary["zoom"], (fine["transient"][key] for key in ("p_max_Pa", "h_min_m"))
    assert len(zoom["windows"]) == 2 and zoom["windows"][0]["window_a"] == zoom["window_a"]
    assert abs(zoom["p_max_Pa"] - p) < 0.006 * p
    assert abs(zoom["h_min_m"] - h) < min(zoom["error"]["h_min_m"], 0.2 * abs(zoom["base"]["h_min_m"] - h))
    first, second = (window.extremes("p_max_Pa").max() for window in ZoomWindow.all_of(with_two.store))
    assert second == pytest.approx(zoom["p_max_Pa"], rel=0.01) and first < 0.8 * second
    assert ZoomWindow.with_most(with_two.store).first == "zoom2_"
    for name in "ab":
        now, there = (one["fatigue_by_surface"][name] for one in (with_two.summary, fine))
        assert abs(now["Fi_max"] - there["Fi_max"]) < 0.01 * there["Fi_max"]
        assert abs(now["below"]["Fi_max"] - there["below"]["Fi_max"]) < 0.01 * there["below"]["Fi_max"]


def test_two_windows_are_stored_and_searched_again(of_both, with_two, folder):
    whole = tehl.run(of_both.replace(**{"zoom.factor": 4}), folder / "two_whole.zarr")
    assert numbers(whole.summary) == numbers(with_two.summary)
    store, again = whole.store, whole.fatigue().summaries
    assert store.map("zoom2_pressure").shape[0] == store.map("zoom_pressure").shape[0]
    for name, stored in whole.summary["fatigue_by_surface"].items():
        for now, there in ((again[name], stored), (again[name]["below"], stored["below"])):
            assert now["Fi_max"] == pytest.approx(there["Fi_max"], rel=1e-6) and now["x_m"] == pytest.approx(there["x_m"])


@pytest.fixture(scope="module")
def without_verdict(folder):
    """A short run whose film has more shear than any oil, on a grid that a window would fill."""
    changes = {"grid.nx": 64, "thermal.on": False, "time.steps": 4, "numerics.estimate_error": False}
    return tehl.run(tehl.scene("furrow-line").replace(**changes), folder / "none.zarr")


def test_a_window_as_large_as_the_grid_keeps_the_missing_verdict(without_verdict):
    before = without_verdict.summary["fatigue"]
    run = tehl.zoom(without_verdict.path, 2)
    width = run.scene.grid.x_max - run.scene.grid.x_min
    assert run.summary["zoom"]["window_a"][0] >= width and run.summary["zoom"]["p_max_Pa"] > 0
    after = run.summary["fatigue"]
    assert after["Fi_max"] is None and after["unknown"] == before["unknown"]
    assert after["pressure_alone"]["Fi_max"] == before["pressure_alone"]["Fi_max"]


@pytest.mark.parametrize("error, finished", [(tehl.NotConverged("a step failed"), True), (ValueError("a bug"), True),
                                             (KeyboardInterrupt(), False), (Interrupted("full disk"), False)])
def test_a_window_that_fails_leaves_the_run_as_it_was(plain, folder, monkeypatch, error, finished):
    from tehl_taichi.runs import single_run

    def fail(*_):
        raise error

    path = shutil.copytree(plain.path, folder / f"{type(error).__name__}.zarr")
    with monkeypatch.context() as failing, pytest.raises(BaseException, match=str(error) or None):
        failing.setattr(single_run, "_finish", fail)
        tehl.zoom(path, 2)
    after = tehl.open(path)
    assert after.finished == finished
    if finished:
        assert numbers(after.summary) == numbers(plain.summary) and after.scene == plain.scene
        np.testing.assert_array_equal(after.store.map("Fi"), plain.store.map("Fi"))
    else:
        assert after.scene.zoom.factor == 2


@pytest.fixture(scope="module")
def sought(folder):
    """A run with the window that it needs, as of `tehl run --zoom auto`."""
    from tehl_taichi.runs import zoom_store

    done = zoom_store.run(LINE.replace(**{"numerics.estimate_error": True}), folder / "sought.zarr")
    assert done.scene.zoom.factor == 4 and not done.store.seeks_window
    return done


@pytest.mark.parametrize("where", ["march.passage.march", "runs.zoom_store._factors_left", "runs.zoomed_run.levels",
                                   "runs.zoomed_run.search", "runs.zoom_need.settled", "runs.zoom_store._at_the_end"])
def test_a_stopped_search_for_a_window_is_resumed_to_the_same_result(sought, folder, monkeypatch, where):
    """Stopped before the first entry, after the run, in its window, and before the search ends."""
    from tehl_taichi.runs import single_run, zoom_store

    path = folder / f"{where}.zarr"

    def stop(*_, **__):
        raise KeyboardInterrupt

    with monkeypatch.context() as stopped, pytest.raises(KeyboardInterrupt):
        if where == "march.passage.march":
            stopped.setattr("tehl_taichi.runs.recorder.march", stop)
        else:
            stopped.setattr(f"tehl_taichi.{where}", stop)
        zoom_store.run(sought.scene.replace(**{"zoom.factor": 0}), path)
    assert tehl.open(path).store.seeks_window
    assert "resume with: tehl resume" in single_run._what_is_left(path)
    done = here("resume", path, "--quiet")
    assert done.returncode == 0, done.stderr
    found = tehl.open(path)
    assert not found.store.seeks_window and found.scene == sought.scene and numbers(found.summary) == numbers(sought.summary)
    assert found.store.metadata.keys() == sought.store.metadata.keys()
    for name in found.store.metadata:
        if name != "wall_s":
            np.testing.assert_array_equal(found.to_xarray()[name], sought.to_xarray()[name], err_msg=name)


@pytest.fixture(scope="module")
def whole(folder):
    """The whole passage with the window that it needs, finer than that of its first 20 steps."""
    from tehl_taichi.runs import zoom_store

    done = zoom_store.run(WHOLE, folder / "whole.zarr")
    assert done.scene.zoom.factor == 8 and done.store.window_search is None
    return done


@pytest.mark.parametrize("steps", [1, 20])
def test_a_part_of_a_passage_does_not_end_the_search_for_its_window(whole, folder, steps):
    """A part of it, a longer part, then the rest: the window and all numbers are those of the unbroken run."""
    from tehl_taichi.runs import zoom_store

    path = folder / f"part{steps}.zarr"
    part = zoom_store.run(WHOLE.replace(**{"time.steps": steps}), path)
    assert part.finished and not part.store.seeks_window and part.store.window_search
    for more, last in ((("--steps", 3), steps + 3), ((), whole.store.last_step)):
        done = here("resume", path, "--quiet", *more)
        assert done.returncode == 0 and tehl.open(path).store.last_step == last, done.stderr
    found = tehl.open(path)
    assert found.scene == whole.scene and found.store.window_search is None
    assert numbers(found.summary) == numbers(whole.summary)


@pytest.mark.parametrize("factor", [2, "auto"])
def test_a_refused_window_leaves_the_search_as_it_was(sought, folder, monkeypatch, factor):
    from tehl_taichi.runs import single_run, zoom_need, zoom_store

    def refused(*_):
        raise tehl.SceneError("more memory")

    path = shutil.copytree(sought.path, folder / f"refused-{factor}.zarr")
    state = zoom_store._at_the_end(tehl.open(path)).store.window_search
    assert state == EXTENDED
    monkeypatch.setattr(zoom_need, "factors", lambda done: (2,))
    monkeypatch.setattr(single_run, "continued", refused)
    with pytest.raises(tehl.SceneError, match="more memory"):
        tehl.zoom(path, factor)
    assert tehl.open(path).store.window_search == state


def test_a_chosen_window_ends_the_search(sought, folder):
    from tehl_taichi.runs import zoom_store

    path = shutil.copytree(sought.path, folder / "chosen.zarr")
    zoom_store._noted(tehl.open(path), True)
    assert tehl.open(path).store.seeks_window
    done = tehl.zoom(path, 4)
    assert not done.store.seeks_window and not tehl.open(path).store.seeks_window
