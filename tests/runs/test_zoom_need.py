"""Windows that a run needs: none where its grid resolves everything, else the first that settles the largest pressure."""

import types

import pytest

import tehl_taichi as tehl
from tehl_taichi.runs import single_run, zoom_need, zoom_store
from tehl_taichi.runs.progress import Progress
from tehl_taichi.scene import refinement, zoom_room

SCENE = tehl.scene("pitch-line").replace(**{"feature.length": float("inf"), "grid.nx": 256})


class Stored(types.SimpleNamespace):
    def __len__(self):
        return 99


def finished(scene, resolved=None, error=None, monkeypatch=None):
    """A finished run whose grid resolves the pressure up to a place, with the error of its largest pressure."""
    monkeypatch.setattr(zoom_need.coarse_runs, "resolved", lambda *given: resolved)
    store = Stored(scalar=None, scene=scene, seeks_window=False, window_search=None)
    return types.SimpleNamespace(scene=scene, store=store, path="a.zarr", finished=True, rest=lambda: None,
                                 summary={"transient": {"error": {"p_max_Pa": error}}})


def test_a_resolved_passage_needs_none(monkeypatch):
    run = finished(SCENE, error=1e7, monkeypatch=monkeypatch)
    assert zoom_need.reason(run) == "" and zoom_need.factors(run) == ()


def test_numbers_of_unknown_error_need_one_unless_all_are_unknown(monkeypatch):
    run = finished(SCENE, error=1e7, monkeypatch=monkeypatch)
    run.summary["transient"]["error"]["h_min_m"] = None
    assert zoom_need.reason(run) == "the error of the smallest film is not known" and zoom_need.factors(run) == (4, 8)
    assert zoom_need.reason(finished(SCENE, monkeypatch=monkeypatch)) == ""  # no coarse-grid runs


@pytest.mark.parametrize("changes, resolved, words", [({"grid.nx": 64}, None, "a feature of 8.8 cells"),
                                                      ({}, 0.8, "pressure peaks of a few cells behind 0.80 a")])
def test_few_cells_and_sharp_peaks_need_one(monkeypatch, changes, resolved, words):
    assert zoom_need.reason(finished(SCENE.replace(**changes), resolved, monkeypatch=monkeypatch)) == words


@pytest.mark.parametrize("changes, hollow", [({}, False), ({"feature.height": -1.5e-6}, True),
                                             ({"feature.shape": "furrow", "feature.height": -1e-6}, True)])
def test_windows_see_the_oil_enter_a_hollow(monkeypatch, changes, hollow):
    """A late window of a rolling dent has 2.979 GPa, one over the whole passage 3.045, a whole fine grid 3.042."""
    scene = tehl.scene("gear").replace(**{"feature.width": 4e-4, **changes})
    run = finished(scene, 0.5, monkeypatch=monkeypatch)
    assert zoom_room.holds_oil(scene) is hollow
    assert zoom_need.begin(run.store) == (None if hollow else 0.5)


@pytest.mark.parametrize("columns, late", [(256, True), (240, True), (224, False), (128, False)])
def test_windows_see_the_film_begin_where_the_run_does_not_resolve_it(columns, late, monkeypatch):
    """On 128x32 cells with temperatures, SRR 0.12, a late window has 0.0996 um and Fi 1.558, one over the whole passage 0.1038
    um and 1.587, a whole fine grid 0.1038 um and 1.588."""
    scene = tehl.scene("gear").replace(**{"grid.nx": columns, "grid.ny": columns // 4})
    assert zoom_need.begin(finished(scene, 0.5, monkeypatch=monkeypatch).store) == (0.5 if late else None)


def test_the_work_of_a_window_counts_from_where_it_begins(monkeypatch):
    bump, dent = (zoom_need.work(finished(tehl.scene("gear").replace(height=height), 0.5, monkeypatch=monkeypatch).store, 4)
                  for height in (1.5e-6, -1.5e-6))
    begin, end = tehl.scene("gear").path
    assert (dent - 1) / (bump - 1) == pytest.approx((end - begin) / (end - 0.1), rel=1e-9)


class Said(Progress):
    """Keeps what is said."""

    def __init__(self):
        self.texts = []

    def say(self, text):
        self.texts.append(text)


@pytest.fixture
def windows(monkeypatch):
    """Factors of the windows that a search tries: windows(errors, before) gives (run, factors, what is said); errors: of p_max,
    by factor."""
    def search(errors, before):
        tried, progress, seeks = [], Said(), []

        def window(_, factor, *__):
            tried.append(factor)
            return finished(SCENE.replace(**{"zoom.factor": factor}), 0.8, errors[factor], monkeypatch)

        monkeypatch.setattr(single_run, "open", lambda path: before, raising=False)
        monkeypatch.setattr(zoom_store, "_with_window", window)
        monkeypatch.setattr(zoom_store, "_noted", lambda done, now: seeks.append(now) or done)
        run = zoom_store._with_needed_window(before, None, progress)
        assert seeks == [True] * len(tried) + [None]
        return run, tried, progress.texts

    return search


@pytest.mark.parametrize("errors, tried", [({4: 1e7}, [4]), ({4: None, 8: 1e7}, [4, 8]), ({4: None, 8: None}, [4, 8])])
def test_factors_are_tried_until_the_pressure_is_known(monkeypatch, windows, errors, tried):
    run, found, texts = windows(errors, finished(SCENE, 0.8, None, monkeypatch))
    assert found == tried and run.scene.zoom.factor == tried[-1] and len(texts) == len(tried)


@pytest.mark.parametrize("factor, error, tried", [(4, None, [8]), (4, 1e7, []), (8, None, [])])
def test_a_resumed_search_continues_after_its_last_window(monkeypatch, windows, factor, error, tried):
    before = finished(SCENE.replace(**{"zoom.factor": factor}), 0.8, error, monkeypatch)
    before.store.seeks_window = True
    assert windows({8: 1e7}, before)[1:] == (tried, [f"{zoom_need.reason(before)}: a window of factor 8"] * len(tried))


def test_a_run_without_need_stays_as_it_is(monkeypatch):
    progress, before = Said(), finished(SCENE, error=1e7, monkeypatch=monkeypatch)
    monkeypatch.setattr(single_run, "open", lambda path: before, raising=False)
    assert zoom_store.zoom("a.zarr", "auto", progress=progress) is before
    assert progress.texts == ["this grid resolves the passage: no window is needed"]


@pytest.mark.parametrize("name", ["rough-pair", "pitch-line"])
def test_no_window_is_named_where_the_scene_cannot_have_one(name, monkeypatch):
    description = tehl.scene(name)
    assert (refinement.zoom_option(description, lambda factor: 5.2) == "") is bool(refinement.no_window(description, 4))
    assert bool(refinement.no_window(description, 4)) is (name == "rough-pair")
    if name == "rough-pair":
        progress, before = Said(), finished(description, 0.8, None, monkeypatch)
        monkeypatch.setattr(single_run, "open", lambda path: before, raising=False)
        assert zoom_store.zoom("a.zarr", "auto", progress=progress) is before
        assert len(progress.texts) == 1 and progress.texts[0].startswith("no window: ")


def test_the_work_of_a_window_is_that_of_its_part_of_the_passage(monkeypatch):
    start, end = SCENE.path
    whole, late = (zoom_need.work(finished(SCENE, place, None, monkeypatch).store, 4) for place in (start, 0.4))
    assert whole > late > 1.0 and (late - 1) / (whole - 1) == pytest.approx(end / (end - start))
    eight = zoom_need.work(finished(SCENE, 0.4, None, monkeypatch).store, 8)
    assert eight > 1 + 3 * (late - 1)  # of a line: twice the cells and the steps
