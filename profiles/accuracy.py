"""Accuracy: error against run time, for steady and passing scenes; which grid is enough for 5 %, 1 % and 0.1 %."""

import math
import time

import numpy as np
from tehl_taichi.profiles.speed import circular

from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales
from tehl_taichi.solvers.steady import observed_order

TARGETS = (0.05, 0.01, 0.001)
COLUMNS = {"steady line": (64, 128, 256, 512, 1024), "steady circle": (64, 128, 256),
           "passage": (64, 128, 256, 512), "thermal passage": (64, 128, 256)}
QUICK = {"steady line": (64, 128, 256), "steady circle": (32, 64, 128), "passage": (32, 64, 128)}
QUANTITIES = ("h_c_m", "h_min_m", "p_max_Pa", "film_max_C", "Fi_max")


def run(quick=False, progress=None):
    """Rows: family, columns, seconds, quantity, value, error (relative), order; the finest grid's error is that of its own
    extrapolation. Time steps shrink with the cells."""
    rows = []
    for family, columns in (QUICK if quick else COLUMNS).items():
        found = []
        for nx in (columns[0], *columns):  # the first one twice: kernels are compiled then
            if progress:
                progress(f"{family}: {nx} columns")
            started = time.perf_counter()
            values = solve(family, nx)
            found.append((nx, time.perf_counter() - started, values))
        rows += judged(family, found[1:])
    return rows


def solve(family, nx):
    """{quantity: value} of one run; of a passage with the feature at x = 0, Fi over the whole."""
    from tehl_taichi.post import fatigue
    from tehl_taichi.simulation import march

    if family == "steady line":
        return _numbers(next(march(scene("smooth-line").replace(**{"thermal.on": False, "grid.nx": nx}))).scalars)
    if family == "steady circle":
        return _numbers(next(march(circular(nx))).scalars)
    description = scene("gear").replace(**{"thermal.on": family == "thermal passage", "grid.nx": nx, "grid.ny": nx // 4})
    shots = list(march(description))
    at = np.array([shot.feature_x for shot in shots[1:]]) / Scales.of(description).a
    middle = {key: float(np.interp(0.0, at, [shot.scalars[key] for shot in shots[1:]]))
              for key in ("h_min_m", "p_max_Pa", "film_max_C") if key in shots[0].scalars}
    return {**middle, "Fi_max": fatigue.run(description, shots).summary["Fi_max"]}


def _numbers(scalars):
    return {key: scalars[key] for key in ("h_c_m", "h_min_m", "p_max_Pa")}


def judged(family, found):
    """Rows of one family; found: (columns, seconds, values) of each grid, twice as fine each time."""
    rows = []
    for quantity in [key for key in QUANTITIES if key in found[0][2]]:
        values = [values[quantity] for _, _, values in found]
        limit, order = extrapolated(values)
        rows += [{"family": family, "columns": nx, "seconds": seconds, "quantity": quantity, "value": value,
                  "error": abs(value / limit - 1), "order": order} for (nx, seconds, _), value in zip(found, values)]
    return rows


def extrapolated(values):
    """(limit, observed order) of values on grids each twice as fine; order 1 where the differences show none."""
    order = observed_order(values)
    used = min(max(order, 1.0), 2.0) if math.isfinite(order) else 1.0
    return values[-1] + (values[-1] - values[-2]) / (2**used - 1), order


def enough(rows):
    """[(family, quantity, columns for each target or None)]."""
    out = []
    for family, quantity in dict.fromkeys((row["family"], row["quantity"]) for row in rows):
        own = [row for row in rows if (row["family"], row["quantity"]) == (family, quantity)]
        out.append((family, quantity, [_coarsest(own, target) for target in TARGETS]))
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
    """Error over run time, a panel per family."""
    families = list(dict.fromkeys(row["family"] for row in rows))
    figure, axes = plt.subplots(1, len(families), figsize=(3.6 * len(families), 3.6), constrained_layout=True, squeeze=False)
    for ax, family in zip(axes[0], families):
        for quantity in dict.fromkeys(row["quantity"] for row in rows if row["family"] == family):
            own = [row for row in rows if row["family"] == family and row["quantity"] == quantity]
            ax.loglog([row["seconds"] for row in own], [max(row["error"], 1e-8) for row in own], "o-", label=quantity)
        ax.set(title=family, xlabel="run time (s)")
        ax.legend(fontsize=7)
    axes[0][0].set_ylabel("relative error")
    return figure
