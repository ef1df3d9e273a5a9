"""Fatigue of a finished run with its zoom windows, from the stored fields of the windows."""

from tehl_taichi.march.zoom.read_once import ReadOnce
from tehl_taichi.march.zoom.zoomed_passage import ZoomedPassage
from tehl_taichi.march.zoom.zoomed_reader import ZoomedReader
from tehl_taichi.runs import zoomed_points, zoomed_run
from tehl_taichi.runs.progress import progress_of
from tehl_taichi.view.zoom_window import EXTREMES, ZoomWindow


def refined(store, scene, alone, progress=None, until=None):
    """Search the run with its windows, as the run itself does; return the SearchResult, `alone` if it has none.

    scene: of the run, with other constants of fatigue. alone: SearchResult of the run without its window, which determines the
    searched points. until: position (a) of the feature, see :func:`tehl_taichi.runs.zoomed_run.searched`.
    """
    windows = ZoomWindow.all_of(store)
    if not windows or not windows[0].entries.size:
        return alone
    reader = ZoomedReader(ReadOnce(store), [_passage(window) for window in windows], scene.symmetric)
    found = zoomed_run.searched(store, scene, reader, zoomed_points.ends(scene, alone), progress_of(progress), until)
    return zoomed_points.deeper(found, alone).with_summaries(_completed(found.summaries, alone.summaries))


def _passage(window):
    """The ZoomedPassage of a stored window, with the extremes of its stored moments."""
    fields = {name: [window.fields(entry, [name])[name] for entry in window.entries] for name in window.names}
    at, lefts, parts = window.between
    return ZoomedPassage(window.place_on_grid, window.entries.tolist(), window.origins(window.lefts).tolist(), fields,
                         {name: window.extremes(name) for name in EXTREMES},
                         list(zip(at.tolist(), window.origins(lefts).tolist(), parts)))


def _completed(summaries, run):
    """{surface: summary} with the statistics and the smooth contact of the search without the window."""
    found = zoomed_points.completed(summaries, run)
    return {name: {**one, **{key: run[name][key] for key in ("contact_alone",) if key in run[name]}}
            for name, one in found.items()}
