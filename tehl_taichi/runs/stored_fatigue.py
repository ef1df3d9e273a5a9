"""Fatigue of a stored passage, if its tractions allow an index."""

import functools
from typing import cast

from tehl_taichi.fatigue import assessment, fatigue
from tehl_taichi.fatigue.pressure_alone import WITHOUT, without_index
from tehl_taichi.fatigue.search_result import SearchResult
from tehl_taichi.runs.progress import FATIGUE
from tehl_taichi.runs.summary.film_warnings import no_index


def assessed(store, scene, progress=None, until=None, threads=None, reader=None, **points):
    """The :class:`tehl_taichi.fatigue.search_result.SearchResult` of a stored passage with the constants of `scene`; of the
    pressure alone if the film has more shear than any oil.

    reader: the run with a window, which is searched in place of the store, without the contact alone; points: its `sought` and
    `boxes` (:func:`tehl_taichi.fatigue.assessment.run`); progress, until, threads: as of :func:`tehl_taichi.fatigue`.
    """
    why = no_index(store) if scene.fatigue.shear else ""
    counted = scene.replace(**WITHOUT) if why else scene
    searched = (fatigue(store, counted, progress=progress, threads=threads, until=until) if reader is None else
                assessment.run(counted, reader, functools.partial(progress.stage, FATIGUE), until, alone=False, **points))
    found = cast(SearchResult, searched)  # of a store, not of single points
    if not why:
        return found
    return found.with_summaries({name: without_index(one, why) for name, one in found.summaries.items()})
