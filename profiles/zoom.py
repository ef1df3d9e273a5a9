"""Zoom: runs with a fine window against runs that are as fine everywhere, and what both cost."""

import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from tehl_taichi.profiles import measure

from tehl_taichi.runs.single_run import run_or_resume
from tehl_taichi.scene import scene
from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.values.summary_values import error_of, value_at
from tehl_taichi.view.zoom_window import ZoomWindow

GRID, FACTOR = (128, 32), 4
QUICK_GRID, QUICK_FACTOR = (64, 16), 2
SLIPS = {"SRR -0.12": -0.12, "SRR 0": 0.0, "SRR +0.12": 0.12}
FEATURES = {"asperity": 1.5e-6, "dent": -1.5e-6}
# {number: (where it is in a summary, unit, that in SI)}
NUMBERS = {"p_max": (("transient", "p_max_Pa"), "GPa", 1e9), "h_min": (("transient", "h_min_m"), "um", 1e-6),
           "h_middle": (("middle", "h_min_m"), "um", 1e-6),
           "film_max": (("transient", "film_max_C"), "degC", 1.0),
           **{f"Fi {body}, {name}": (("fatigue_by_surface", body, *place, "Fi_max"), "", 1.0) for body in "ab"
              for name, place in (("surface", ()), ("below", ("below",)), ("surface, averaged", ("averaged",)),
                                  ("below, averaged", ("averaged", "below")))}}


@dataclass(frozen=True)
class ZoomRow:
    """number of a case: of the coarse run (None: it has none), with its window (and the error bar of that), of the fine run;
    run times, s."""

    case: str
    number: str
    unit: str
    coarse: float | None
    zoom: float
    error: float | None
    fine: float
    coarse_s: float
    zoom_s: float
    fine_s: float

    @property
    def off(self):
        """Distance of the zoomed number from that of the fine run, relative."""
        return abs(self.zoom - self.fine) / abs(self.fine)

    @property
    def holds(self):
        """Whether the error bar holds it; None without a bar."""
        return None if self.error is None else abs(self.zoom - self.fine) <= self.error


def cases(quick=False):
    """{name: scene}; quick: one line contact without temperatures."""
    nx, ny = QUICK_GRID if quick else GRID
    warm = scene("gear").replace(**{"grid.nx": nx, "grid.ny": ny})
    base = warm.replace(**{"thermal.on": False})
    if quick:
        return {"line, SRR 0": base.replace(srr=0.0, **{"feature.length": np.inf})}
    return {f"{kind}, {slip}{heat}": one.replace(srr=srr, height=height)
            for heat, one in (("", base), (", temperatures", warm)) for kind, height in FEATURES.items()
            for slip, srr in SLIPS.items()}


def run(folder, quick=False, threads=None, progress=None):
    """Generator of all rows so far, after every case; stores lie in `folder` and are used again. progress: called with a line
    of text."""
    say, rows, factor = progress or (lambda text: None), [], QUICK_FACTOR if quick else FACTOR
    for name, description in cases(quick).items():
        say(f"{name}: coarse, with a window, fine")
        g = description.grid
        runs = [_finished(one, Path(folder) / f"{_file(name)}-{kind}.zarr", threads) for kind, one in (
            ("coarse", description), (f"zoom{factor}", description.replace(**{"zoom.factor": factor})),
            ("fine", description.replace(**{"grid.nx": g.nx * factor, "grid.ny": g.ny * factor})))]
        middle = _moment(runs[0][0].store, 0.0)[1]
        found = [({**one.summary, "middle": {"h_min_m": _film_under(one.store, middle)}}, s) for one, s in runs]
        rows += [_row(name, number, *found) for number in NUMBERS
                 if all(value_at(summary, *NUMBERS[number][0]) is not None for summary, _ in found[1:])]
        yield rows


def _file(name):
    return name.replace(",", "").replace(" ", "-").replace("+", "plus").lower()


def _finished(description, path, threads):
    """(Run, s) of a finished run."""
    began = time.perf_counter()
    run = run_or_resume(description, path, threads=threads)
    return run, max(time.perf_counter() - began, run.summary["wall_s"])


def _moment(store, x):
    """(entry, position in m) of the moment with the feature closest to x (m)."""
    places = [store.feature_x(n) for n in range(1, len(store))]
    n = nearest_index(np.asarray(places), x)
    return n + 1, places[n]


def _film_under(store, at):
    """Smallest film (m) under the feature when it is closest to x = `at` (m); in the window, if the run has one."""
    (n, centre), window = _moment(store, at), ZoomWindow.of(store)
    feature, x, y, reader = store.scene.features[0], store.x, store.y, store
    if window and n in window:
        x, y, reader = window.lefts[window.place[n]] + window.x, window.y, window
    under = [np.abs(there - middle) <= reach for there, middle, reach in
             ((x, centre, feature.reach), (y, feature.y, feature.reach_y))]
    return float(np.min(reader.fields(n, ["film"])["film"][np.ix_(*under)]))


def _row(case, number, coarse, zoomed, fine):
    place, unit, si = NUMBERS[number]
    values = [_in(si, value_at(summary, *place)) for summary, _ in (coarse, zoomed, fine)]
    error = error_of(zoomed[0], *place)
    return ZoomRow(case, number, unit, *values[:2], _in(si, error), values[2],
                   *(seconds for _, seconds in (coarse, zoomed, fine)))


def _in(unit, value):
    return None if value is None else value / unit


# columns of the table, and the numbers that they show
SHOWN = {"p_max, GPa": "p_max", "h_min, um": "h_min", "h_middle, um": "h_middle", "film_max, degC": "film_max",
         **{f"Fi {body} {part}": f"Fi {body}, {part}, averaged" for body in "ab" for part in ("surface", "below")}}
COLUMNS = ("case", *SHOWN, "time, s")


def lines(rows):
    """A line of texts for each case: numbers with the window, and by how much % they are off, after the fine run's; times of
    the coarse run, with its window, of the fine one."""
    out = []
    for case in dict.fromkeys(row.case for row in rows):
        own = {row.number: row for row in rows if row.case == case}
        times = own["p_max"]
        out.append([case, *(_pair(own.get(name)) for name in SHOWN.values()),
                    f"{times.coarse_s:.0f}, {times.zoom_s:.0f}, {times.fine_s:.0f}"])
    return out


def _pair(row):
    return f"{row.fine:.4g}: {row.zoom:.4g} ({100 * row.off:.2f})" if row else ""


def chart(plt, rows):
    """Distance from the fine run, of the coarse run and with its window."""
    figure, ax, at = measure.chart_of_rows(plt, [f"{row.case}, {row.number}" for row in rows], 0.28)
    coarse = [np.nan if row.coarse is None else abs(row.coarse / row.fine - 1) for row in rows]
    for name, values in (("coarse", coarse), ("with window", [row.off for row in rows])):
        ax.plot(100 * np.maximum(values, 1e-6), at, "o", label=name)
    ax.set(xscale="log", xlabel="distance from the fine run, %")
    ax.legend()
    return figure
