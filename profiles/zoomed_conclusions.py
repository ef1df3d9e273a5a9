"""Conclusions over the whole passage, by runs with a fine window: Findley stress over fatigue.length of both bodies."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from tehl_taichi.profiles import conclusions
from tehl_taichi.profiles.conclusions import ConclusionRow
from tehl_taichi.profiles.passage_stresses import DEEP, DEPTHS, LOADS

from tehl_taichi.errors import NotConverged
from tehl_taichi.fatigue.pressure_alone import searched
from tehl_taichi.runs.single_run import run_or_resume
from tehl_taichi.values.summary_values import error_of

GRID, QUICK_GRID = (256, 64), (32, 8)  # cells of the runs
SURFACE, BELOW = ("all", "whole"), DEEP["whole"]
COLUMNS = SURFACE, BELOW
PARTS = "no thermal stress", "pressure"  # of the load, which count in runs of their own; at the surface
BY_PARTS = tuple(f"{conclusions.DECIDE[0]}, SRR {srr:+g}" for srr in conclusions.SLIPS if srr)


def run(folder, factor, quick=False, progress=None, threads=None):
    """Rows of all cases, two each, from windows of this factor; their stores lie in `folder` and are used again. progress:
    called with a line of text."""
    out = []
    for name, description in conclusions.cases(quick).items():
        if progress:
            progress(f"{name}: a window of factor {factor}")
        sized = _sized(description, quick, factor)
        found = rows(name, sized, Path(folder), threads)
        for loads in PARTS if name in BY_PARTS and not quick else ():
            found = with_part(found, rows(f"{name}, {loads}", sized.replace(**LOADS[loads]), Path(folder), threads), loads)
        out += found
    return out


def with_part(rows, parts, loads):
    """`rows` with the stresses at the surface of `parts`, the same bodies with a part of the load."""
    key = loads, "whole"
    pairs = [(row, part) for row, part in zip(rows, parts) if not (row.reason or part.reason)]
    return [replace(row, values={**row.values, key: part.values[SURFACE]}, errors={**row.errors, key: part.errors[SURFACE]},
                    doubts={**row.doubts, key: part.doubts.get(SURFACE, "")}) for row, part in pairs] or rows


def rows(name, description, folder, threads=None):
    """ConclusionRows of both bodies from a run with a window."""
    g, srr = description.grid, description.operation.srr
    grid = f"{g.nx}x{g.ny} zoom {description.zoom.factor}"
    try:
        summary = run_or_resume(description, folder / f"{conclusions.file_name(name)}-zoom{description.zoom.factor}.zarr",
                                threads=threads).summary
    except NotConverged as error:
        return [ConclusionRow(name, srr, {}, {}, (np.nan, np.nan), reason=str(error), grid=grid)]
    return [_of_body(name, srr, body, searched(one), grid) for body, one in sorted(summary["fatigue_by_surface"].items())]


def _sized(description, quick, factor):
    nx, ny = QUICK_GRID if quick else GRID
    return description.replace(**{"grid.nx": nx, "grid.ny": ny, "zoom.factor": factor})


def _of_body(name, srr, body, found, grid):
    """Row of one body by its summary: of averaged stresses, where the cells of the window are less than half of the length."""
    parts = [found.get("averaged", found), found.get("averaged", found)["below"]]
    values = {key: part["findley_stress_max_Pa"] for key, part in zip(COLUMNS, parts)}
    errors = {key: _error(part) * value for (key, value), part in zip(values.items(), parts)}
    doubts = {key: (part.get("unknown") or {}).get("Fi_max", "") for key, part in zip(COLUMNS, parts)}
    return ConclusionRow(name, srr, {**values, DEPTHS[BELOW]: parts[1]["depth_m"]}, errors, (np.nan, np.nan), doubts,
                         body=body, grid=grid)


def _error(part):
    """Relative; nan where it is not known."""
    bar = error_of(part, "Fi_max")
    return np.nan if bar is None else bar / part["Fi_max"]


def verdicts(rows, limit):
    """[(statement, verdict, figures)] over the whole passage, as of :func:`tehl_taichi.profiles.conclusions.verdicts`."""
    loads = [(part, "whole") for part in PARTS if any((part, "whole") in row.values for row in rows)]
    return conclusions.verdicts(rows, limit, ("whole",), (SURFACE, *loads))


def page(rows, judged, description):
    """Markdown of the table and the verdicts."""
    return conclusions.page(rows, judged, description, (SURFACE, *((loads, "whole") for loads in PARTS), BELOW))
