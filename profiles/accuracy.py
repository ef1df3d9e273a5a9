"""Accuracy: error against run time, for steady and passing scenes; which grid is enough for 5 %, 1 % and 0.1 %."""

import math
import textwrap
import time

import numpy as np
from tehl_taichi.profiles.speed import circular

from tehl_taichi.engine.taichi_patches.prebound import binding_seconds
from tehl_taichi.fatigue import assessment
from tehl_taichi.fatigue.assessment import Snapshots
from tehl_taichi.march.accuracy.error_bars import observed_order
from tehl_taichi.march.passage import march
from tehl_taichi.march.zoom.zoomed_passage import passages
from tehl_taichi.march.zoom.zoomed_reader import ZoomedReader
from tehl_taichi.scene import scene
from tehl_taichi.scene.grid_for_error import columns_per_width
from tehl_taichi.scene.scales import Scales

TARGETS = (0.05, 0.01, 0.001)
COLUMNS = {"steady line": (64, 128, 256, 512, 1024), "steady circle": (64, 128, 256),
           "passage": (64, 128, 256, 512), "thermal passage": (64, 128, 256, 512)}
QUICK = {"steady line": (64, 128, 256), "steady circle": (32, 64, 128), "passage": (32, 64, 128)}
# (columns, factor of a window that moves with the feature over the whole passage) of a family
WINDOWS = {family: ((64, 4), (64, 8), (128, 2), (128, 4)) for family in ("passage", "thermal passage")}
QUICK_WINDOWS = {"passage": ((64, 2),)}
CLOSE, LETTERS = 0.1, 46  # of the chart: difference of the logarithms of times whose numbers need two rows; width of a list
QUANTITIES = ("h_c_m", "h_min_m", "p_max_Pa", "film_max_C", "Fi_max")
# of a thermal passage on one grid, against REFERENCE. Not in it: the time step. Steps of whole cells carry the film nearly from
# node to node; shorter ones interpolate it more often, which costs film where 128 columns hardly resolve it (256: 0.5 %)
REFERENCE = {"thermal.nodes": 13, "thermal.tolerance": 5e-3, "numerics.tolerance": 1e-8, "numerics.mass_tolerance": 1e-8}
SETTINGS = {"as it is": {}, "half the time step": {"time.courant": 0.5}, "one lagged temperature round": {"thermal.rounds": 1},
            "isothermal": {"thermal.on": False},
            "tolerances 1e-4": {"numerics.tolerance": 1e-4, "numerics.mass_tolerance": 1e-4},
            "tolerances 1e-8": {"numerics.tolerance": 1e-8, "numerics.mass_tolerance": 1e-8},
            "Krylov 0.3": {"numerics.krylov_tolerance": 0.3}, "Krylov 1e-3": {"numerics.krylov_tolerance": 1e-3},
            "5 nodes in z": {"thermal.nodes": 5}, "7 nodes in z": {"thermal.nodes": 7}, "13 nodes in z": {"thermal.nodes": 13}}
AGAIN, COMPILED = 20.0, 0.05  # s; part of the time
OF_A = {"fatigue.surfaces": "a"}
IN_DOUBLE = "linear solves in f64"  # in a process of its own
SETTINGS_COLUMNS, QUICK_SETTINGS = (128, 32), 2  # (in full, quick); so many of the settings


def run(quick=False, progress=None):
    """Rows: family, columns, setting, seconds, quantity, value, error (relative), order, front (whether no faster run of the
    family has a smaller error). The finest grid's error is that of its own extrapolation; time steps shrink with the cells."""
    say, rows = progress or (lambda text: None), []
    for family, columns in (QUICK if quick else COLUMNS).items():
        found = []
        for nx in columns:
            say(f"{family}: {nx} columns")
            found.append((nx, *timed(solve, family, nx)))
        windows = []
        for nx, factor in (QUICK_WINDOWS if quick else WINDOWS).get(family, ()):
            say(f"{family}: {nx} columns, zoom {factor}")
            windows.append((nx, factor, *timed(zoomed_values, scene_of(family, nx), factor)))
        rows += judged(family, found, windows)
    return [*rows, *settings(SETTINGS_COLUMNS[quick], list(SETTINGS)[: QUICK_SETTINGS if quick else None], say)]


def timed(function, *args):
    """(seconds without tracing and compiling kernels, result); of a second call where the first was short or compiled much:
    a kernel's first launch costs more than its binding says."""
    for _ in range(2):
        started, compiling = time.perf_counter(), binding_seconds()
        result = function(*args)
        compiling = binding_seconds() - compiling
        seconds = time.perf_counter() - started - compiling
        if seconds >= AGAIN and compiling < COMPILED * seconds:
            break
    return seconds, result


def settings(nx, names, say):
    """Rows of a thermal passage on one grid with one of the SETTINGS changed, against REFERENCE."""
    base, found = scene_of("thermal passage", nx), []
    for name in ("reference", *names):
        say(f"settings: {name}")
        found.append((name, *timed(passage_values, base.replace(**(SETTINGS | {"reference": REFERENCE})[name]))))
    say(f"settings: {IN_DOUBLE}")
    found.append((IN_DOUBLE, *timed(passage_values, base.replace(**{"numerics.precision": "f64"}))))
    exact, rows = found[0][2], []
    for quantity in [key for key in QUANTITIES if key in exact]:
        own = [{"family": f"settings, {nx} columns", "columns": nx, "setting": name, "seconds": seconds, "quantity": quantity,
                "value": values[quantity], "error": abs(values[quantity] / exact[quantity] - 1)}
               for name, seconds, values in found[1:] if quantity in values]
        rows += marked(own)
    return rows


def scene_of(family, nx):
    """The scene of a family on nx columns."""
    if family == "steady line":
        return scene("smooth-line").replace(**{"thermal.on": False, "grid.nx": nx})
    if family == "steady circle":
        return circular(nx)
    return scene("gear").replace(**{"thermal.on": family == "thermal passage", "grid.nx": nx, "grid.ny": nx // 4})


def solve(family, nx):
    """{quantity: value} of one run."""
    description = scene_of(family, nx)
    return passage_values(description) if description.transient else _numbers(description)


def passage_values(description):
    """{quantity: value} with the feature at x = 0, Fi of body a over the whole passage."""
    shots = Snapshots(march(description))
    return _of_passage(description, shots, assessment.run(description.replace(**OF_A), shots))


def zoomed_values(description, factor):
    """Values as of :func:`passage_values`, of a run with a window."""
    description = description.replace(**{"zoom.factor": factor, "zoom.from_x": -np.inf})
    shots = Snapshots(march(description))
    zoomed = ZoomedReader(shots, passages(description, shots, [factor])[0], description.symmetric)
    return _of_passage(description, zoomed, assessment.run(description.replace(**OF_A), zoomed, alone=False))


def _of_passage(description, reader, searched):
    at = np.array([reader.feature_x(n) for n in range(1, len(reader))]) / Scales.of(description).a
    heat = () if description.isothermal else ("film_max_C",)
    middle = {key: float(np.interp(0.0, at, reader.scalar(key)[1:])) for key in ("h_min_m", "p_max_Pa", *heat)}
    return {**middle, "Fi_max": searched.summary["Fi_max"]}


def _numbers(description):
    scalars = next(march(description)).scalars
    return {key: scalars[key] for key in ("h_c_m", "h_min_m", "p_max_Pa")}


def judged(family, found, windows=()):
    """Rows of one family; found: (columns, seconds, values) of each grid, twice as fine each time; windows: (columns, factor,
    seconds, values) of runs with a window."""
    rows = []
    for quantity in [key for key in QUANTITIES if key in found[0][2]]:
        values = [values[quantity] for _, _, values in found]
        limit, order = extrapolated(values)
        runs = [({"columns": nx}, seconds, value) for (nx, seconds, _), value in zip(found, values)]
        runs += [({"columns": nx, "setting": f"{nx} zoom {factor}"}, seconds, own[quantity])
                 for nx, factor, seconds, own in windows]
        rows += marked([{"family": family, **which, "seconds": seconds, "quantity": quantity, "value": value,
                         "error": abs(value / limit - 1), "order": order} for which, seconds, value in runs])
    return rows


def marked(rows):
    """The rows of one quantity with `front`: 1 where no faster one has a smaller error (the Pareto front), else 0."""
    best = math.inf
    for row in sorted(rows, key=lambda row: row["seconds"]):
        row["front"] = int(row["error"] < best)
        best = min(best, row["error"])
    return rows


def extrapolated(values):
    """(limit, observed order) of values on grids each twice as fine; where the differences show no order that is None, and 1 is
    used."""
    order = observed_order(values)
    used = min(max(order, 1.0), 2.0) if math.isfinite(order) else 1.0
    return values[-1] + (values[-1] - values[-2]) / (2**used - 1), order if math.isfinite(order) else None


def enough(rows):
    """[(family, quantity, observed order, columns for each target or None)]."""
    out = []
    for family, quantity in dict.fromkeys((row["family"], row["quantity"]) for row in rows if "setting" not in row):
        own = [row for row in rows if (row["family"], row["quantity"]) == (family, quantity)]
        out.append((family, quantity, own[0]["order"], [_coarsest(own, target) for target in TARGETS]))
    return out


def _coarsest(own, target):
    """The first grid from which on every error stays below the target."""
    good = None
    for row in sorted(own, key=lambda row: -row["columns"]):
        if row["error"] > target:
            break
        good = row["columns"]
    return good


def chart(plt, rows):
    """Error over run time, a panel per family; runs carry their columns or the setting that was changed."""
    families = list(dict.fromkeys(row["family"] for row in rows))
    figure, axes = plt.subplots(1, len(families), figsize=(3.6 * len(families), 4.2), constrained_layout=True, squeeze=False)
    for ax, family in zip(axes[0], families):
        own = [row for row in rows if row["family"] == family]
        for quantity in dict.fromkeys(row["quantity"] for row in own):
            _curve(ax, sorted((row for row in own if row["quantity"] == quantity), key=lambda row: row["seconds"]), quantity)
        ax.set(title=family, xlabel=f"run time (s)\n{_numbered(ax, own)}", xscale="log", yscale="log")
        ax.xaxis.set_major_locator(plt.matplotlib.ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.xaxis.set_major_formatter("{x:g}")
        ax.xaxis.set_minor_formatter("")
        ax.legend(fontsize=7)
    axes[0][0].set_ylabel("relative error")
    return figure


def _curve(ax, own, quantity):
    """All points, joined along the front."""
    points = [_point(row) for row in own]
    color = f"C{QUANTITIES.index(quantity)}"
    ax.plot(*zip(*(point for point, row in zip(points, own) if row["front"])), "-", lw=1, label=quantity, color=color)
    ax.plot(*zip(*points), "o", ms=4, color=color)


def _numbered(ax, own):
    """Numbers of the runs in order of time, each above its largest error; returns their list: columns or settings."""
    runs: dict[str, list] = {}
    for row in sorted(own, key=lambda row: row["seconds"]):
        runs.setdefault(str(row.get("setting", row["columns"])), []).append(_point(row))
    tops = [max(points, key=lambda point: point[1]) for points in runs.values()]
    for number, top in enumerate(tops, 1):
        near = sum(abs(math.log(top[0] / other[0])) < CLOSE for other in tops[:number - 1])
        ax.annotate(str(number), top, fontsize=7, xytext=(0, 5 + 7 * near), textcoords="offset points", ha="center")
    ax.margins(0.05, 0.3)
    return textwrap.fill("; ".join(f"{number}: {name}".replace(" ", "\u00a0") for number, name in enumerate(runs, 1)), LETTERS)


def _point(row):
    return row["seconds"], max(row["error"], 1e-8)


def grid_errors(rows):
    """{family: ...} of rows of a full run, as :mod:`tehl_taichi.scene.grid_for_error` reads them from its file."""
    out = {}
    for family in dict.fromkeys(row["family"] for row in rows if "setting" not in row):
        own = [row for row in rows if row["family"] == family and row["quantity"] != "film_max_C"]
        columns = dict.fromkeys(row["columns"] for row in own)
        errors = {nx: float(f'{max(row["error"] for row in own if row["columns"] == nx):.2g}') for nx in columns}
        out[family] = {"columns_per_width": columns_per_width(scene_of(family, 256)), "errors": errors}
    return out
