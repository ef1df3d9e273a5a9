"""Windows of a finished run: their passages, the fatigue search with them, their numbers with error bars.

Windows of half the factor and of the full factor are, with the run itself, three grids; error bars follow from them as from
coarse-grid runs.
"""

import functools
import math
from dataclasses import dataclass, field

import numpy as np

from tehl_taichi.fatigue.sought import Sought
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.march.accuracy.domain_error import widened
from tehl_taichi.march.accuracy.error_bars import bars
from tehl_taichi.march.zoom import zoomed_passage
from tehl_taichi.march.zoom.read_once import ReadOnce
from tehl_taichi.march.zoom.zoomed_reader import ZoomedReader, extreme
from tehl_taichi.runs import zoom_need, zoomed_points
from tehl_taichi.runs.progress import ZOOM
from tehl_taichi.runs.stored_fatigue import assessed
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.zoom_window import FIRST

FIELDS = {"pressure": ("Pa", "pressure in the zoom window"), "film": ("m", "film thickness in the zoom window"),
          **{f"traction_{axis}_{body}": ("Pa", f"shear on body {body} along {axis} in the zoom window")
             for body in "ab" for axis in "xy"},
          "temperature_mid": ("degC", "mid-film temperature in the zoom window"),
          **{f"temperature_{body}": ("degC", f"temperature of surface {body} in the zoom window") for body in "ab"}}
EARLY = {"h_min_m": coarse_runs.MIDDLE,
         **dict.fromkeys((coarse_runs.FI, coarse_runs.AVERAGED), coarse_runs.RESOLVED),
         **dict.fromkeys((coarse_runs.BELOW, coarse_runs.AVERAGED_BELOW), coarse_runs.RESOLVED_BELOW)}


@dataclass
class ZoomLevel:
    """Windows of one factor: their passages, the reader of the run with them, and {surface: summary of the search}."""

    passages: list[zoomed_passage.ZoomedPassage]
    reader: ZoomedReader
    searches: dict = field(default_factory=dict)


def refined(saved, passage, alone, domain, progress):
    """Add the windows of a finished run; return (error bars and numbers, SearchResult or None, arrays of the windows).

    saved: store of the run. passage: its error bars, see :func:`corrected`. alone: its SearchResult, None without an index.
    domain: the DomainError of the run (:mod:`tehl_taichi.march.accuracy.domain_error`).
    """
    windows = levels(saved, progress)
    found = search(saved, windows, alone, progress) if alone else None
    both = corrected(saved, windows, alone.summaries if alone else {}, passage, domain)
    numbers = summary(saved, windows, both, windows[-1].searches)
    return {**both, "zoom": numbers}, found, arrays(windows)


def levels(saved, progress):
    """Compute the windows of the run in the store `saved`; return their ZoomLevels, coarsest first."""
    scene = saved.scene
    factors = zoom_need.levels(scene.zoom.factor)
    progress.stage(ZOOM, 0, len(saved) - 1)
    found = zoomed_passage.passages(scene, saved, factors, functools.partial(progress.stage, ZOOM), zoom_need.begin(saved))
    saved.kept_states = None
    run = ReadOnce(saved)
    return [ZoomLevel(one, ZoomedReader(run, one, scene.symmetric)) for one in found]


def search(saved, found, alone, progress):
    """Search the fatigue of every level; return the SearchResult of the finest one.

    alone: SearchResult of the run without windows, which determines the searched points.
    """
    *others, finest = found
    boxes = zoomed_points.ends(saved.scene, alone)
    result = searched(saved, saved.scene, finest.reader, boxes, progress)
    finest.searches = zoomed_points.completed(result.summaries, alone.summaries)
    boxes = zoomed_points.under_worst(boxes, result)
    for level in others:  # after the finest one, whose thermal stresses of the run and tables they use
        level.reader.kept_heat, level.reader.tables = finest.reader.kept_heat, finest.reader.tables
        their = searched(saved, saved.scene, level.reader, boxes, progress, sought=Sought.WORST)
        level.searches = zoomed_points.completed(their.summaries, alone.summaries)
    return zoomed_points.deeper(result, alone).with_summaries(finest.searches)


def searched(saved, scene, reader, boxes, progress, until=None, sought=Sought.ALL):
    """The SearchResult of a run with a window, at the points of `boxes` {surface: Box}; at all points if the worst one lies at
    an end.

    scene: its fatigue constants are used; reader: ZoomedReader; until: position (a) of the feature, by default up to where the
    window resolves the pressure.
    """
    if until is None:
        until = coarse_runs.resolved(scene, reader, reader.scalar)
    found = assessed(saved, scene, progress, until, reader=reader, sought=sought, boxes=boxes)
    if not zoomed_points.at_an_end(found, boxes, float(reader.x[1] - reader.x[0])):
        return found
    return assessed(saved, scene, progress, until, reader=reader, sought=sought)


def corrected(saved, found, searches, passage, domain):
    """Error bars of a run with windows: those of `passage`, replaced for the numbers that the windows change.

    found: ZoomLevels. searches: {surface: summary} of the run without windows. passage: error bars of the run, as of
    :func:`tehl_taichi.march.accuracy.coarse_runs.errors`. domain: see :func:`refined`.
    """
    grids = [coarse_runs.passage_readings(saved.scene, saved, saved.scalar, searches),
             *(coarse_runs.passage_readings(saved.scene, level.reader, level.reader.scalar, level.searches) for level in found)]
    changed = {name for name, reading in grids[-1].items() if name not in grids[0] or reading.value != grids[0][name].value}
    sizes, reasons = bars(grids, passing=True)
    sizes, reasons = ({name: one for name, one in part.items() if name in changed} for part in (sizes, reasons))
    if found[-1].passages[0].entries[:1] > [1]:
        sizes = _with_early(sizes, passage.get("passage_parts", {}))
    values = {name: grids[-1][name].value for name in changed}
    known, unknown, parts = widened(sizes, reasons, values, domain, saved.scene.operation.temperature, passing=True)
    kept = {name: why for name, why in passage.get("passage_unknown", {}).items() if name not in changed}
    return {"passage_error": passage.get("passage_error", {}) | known, "passage_unknown": kept | unknown,
            "passage_parts": passage.get("passage_parts", {}) | parts}


def _with_early(sizes, parts):
    """Error bars {name: size or None} of a window that begins late.

    They also contain the error of the moments before the window, which is that of the run: of the film that the inlet
    determines, and of indices while the run resolves the pressure. parts: "passage_parts" of the run.
    """
    out = dict(sizes)
    for name, size in sizes.items():
        surface, colon, number = name.rpartition(":")
        early = parts.get(surface + colon + EARLY.get(number, ""), {}).get("grid")
        if size is not None and early is not None:
            out[name] = math.hypot(size, early)
    return out


def summary(saved, found, errors, searches):
    """Part "zoom" of the summary: numbers of the finest level.

    errors: result of :func:`corrected`; searches: {surface: summary} of the finest level.
    """
    last = found[-1]
    scene, keys = saved.scene, list(last.reader.series)
    sizes = [_size(scene, one.window) for one in last.passages]
    out = {"factor": last.reader.factor, **sizes[0], **({"windows": sizes} if sizes[1:] else {}),
           **{key: extreme(last.reader, key) for key in keys}}
    bars_of = {key: errors["passage_error"].get(key) for key in keys}
    if searches:
        out |= {"Fi_max": max(_largest(one) for one in searches.values())}
    out |= {"error": bars_of, "base": {key: extreme(saved, key) for key in keys},
            "from_a": _position(saved, last.passages[0].entries[:1]), "to_a": _position(saved, last.passages[0].entries[-1:]),
            "newton_per_step": sum(one.newton for one in last.passages) / max(sum(one.attempts for one in last.passages), 1)}
    ended = next((one.ended for one in last.passages if one.ended), "")
    return out | ({"ended": ended} if ended else {})


def _size(scene, w):
    """Width along x and y (a) and cells of a Window."""
    return {"window_a": [w.nx * w.dx, _width(scene, w)], "cells": [w.nx, w.ny]}


def _largest(search):
    from tehl_taichi.fatigue.pressure_alone import searched

    found = searched(search)
    return max(found["Fi_max"], found.get("below", found)["Fi_max"])


def _width(scene, w):
    """Width of the window along y, a; on a half domain the width of both halves."""
    return w.ny * w.dy * (2 if scene.symmetric and w.ny else 1)


def _position(saved, entries):
    a = Scales.of(saved.scene).a
    return float(saved.feature_x(entries[0])) / a if entries else None


def arrays(found):
    """{name: (values, dimensions, unit, long name)} of the windows of the finest level, for the store."""
    last = found[-1]
    return {name: one for first, passage in zip(FIRST, last.passages)
            for name, one in _of_window(last.reader, passage, first).items()}


def _of_window(reader, last, first):
    """Arrays of a ZoomedPassage as of :func:`arrays`; `first` begins their names."""
    x, w, dims = reader.x, last.window, [f"{first}{axis}" for axis in ("moment", "x", "y")]
    rows = reader.y[w.row : w.row + w.ny + 1]
    stacked = {name: np.stack(values) for name, values in last.fields.items() if values}
    out = _moments(x, last.entries, last.origins, stacked, first, dims, "entry of the run at each moment of the zoom")
    out[dims[1]] = np.arange(w.nx + 1) * (x[1] - x[0]), dims[1:2], "m", "distance from the first column of the zoom window"
    out[dims[2]] = rows, dims[2:], "m", "across, in the zoom window"
    if not last.between:
        return out
    at, origins, between = zip(*last.between)
    stacked = {name: np.stack([one[name] for one in between]) for name in between[0]}
    dims = [f"{first}between", *dims[1:]]
    return out | _moments(x, at, origins, stacked, f"{dims[0]}_", dims, "moment of the zoom between two entries of the run")


def _moments(x, at, origins, stacked, first, dims, what):
    """Arrays of some moments of a window, as of :func:`arrays`; their names begin with `first`.

    x: fine columns (m). at: entries of the run, or places between them. stacked: {name: (moments, columns, rows)}, with these
    dimensions. what: long name of `at`.
    """
    out = {f"{first}{name}": (values, dims, *FIELDS[name]) for name, values in stacked.items()}
    out[f"{first}entry"] = np.array(at, float), dims[:1], "1", what
    out[f"{first}left"] = x[np.array(origins, int)], dims[:1], "m", "x of the first column of the zoom window"
    return out
