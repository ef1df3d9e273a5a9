"""Fatigue of a finished run with its zoom window, from the stored fields of the window."""

from dataclasses import replace

import numpy as np

from tehl_taichi.march.zoom.read_once import ReadOnce
from tehl_taichi.march.zoom.window import Window
from tehl_taichi.march.zoom.zoomed_passage import ZoomedPassage
from tehl_taichi.march.zoom.zoomed_reader import ZoomedReader
from tehl_taichi.runs import zoomed_points, zoomed_run
from tehl_taichi.runs.progress import Progress
from tehl_taichi.view.zoom_window import EXTREMES, ZoomWindow


def refined(store, scene, alone, progress=None, until=None):
    """Search the run with its window, as the run itself does; return the SearchResult, `alone` if it has no window.

    scene: of the run, with other constants of fatigue. alone: SearchResult of the run without its window, which determines the
    searched points. until: position (a) of the feature, see :func:`tehl_taichi.runs.zoomed_run.searched`.
    """
    window = ZoomWindow.of(store)
    if window is None or not window.entries.size:
        return alone
    reader = ZoomedReader(ReadOnce(store), _passage(store, window), scene.symmetric)
    found = zoomed_run.searched(store, scene, reader, zoomed_points.ends(scene, alone), progress or Progress(), until)
    return _with_summaries(zoomed_points.deeper(found, alone), _completed(found.summaries, alone.summaries))


def _passage(store, window):
    """The ZoomedPassage of a stored window, with the extremes of its stored moments."""
    place = Window.of(store.scene, store.scene.zoom.factor)
    fine = (store.x[1] - store.x[0]) / place.factor

    def origins(lefts):
        return np.round((lefts - store.x[0]) / fine).astype(int).tolist()

    fields = {name: [window.fields(entry, [name])[name] for entry in window.entries] for name in window.names}
    at, lefts, parts = window.between
    return ZoomedPassage(place, window.entries.tolist(), origins(window.lefts), fields,
                         {name: window.extremes(name) for name in EXTREMES},
                         list(zip(at.tolist(), origins(lefts), parts)))


def _completed(summaries, run):
    """{surface: summary} with the statistics and the smooth contact of the search without the window."""
    found = zoomed_points.completed(summaries, run)
    return {name: {**one, **{key: run[name][key] for key in ("contact_alone",) if key in run[name]}}
            for name, one in found.items()}


def _with_summaries(found, summaries):
    """The SearchResult with other summaries {surface: summary} of its bodies."""
    other = found.other and replace(found.other, summary=summaries[found.other.summary["surface"]])
    return replace(found, summary=summaries[found.summary["surface"]], other=other)
