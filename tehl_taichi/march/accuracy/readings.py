"""Numbers of a run on one grid, for error bars: values, interpolation error of extremes, and whether the grid resolves them."""

from dataclasses import replace

import numpy as np

from tehl_taichi.march.accuracy.error_bars import GridReading, parabola_offset
from tehl_taichi.march.accuracy.peaks import peak, sharpest
from tehl_taichi.march.quantities import HEAT
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_text import Reason

SETTLED = 0.1  # of thermal.tolerance: rounds end when another one would move temperatures by less; usual are 0.01 to 0.1 of it
# K, that the only difference between two grids may hide in a temperature; at rest (173 bars of lines on 64 columns hold 95 %
# with it, 93 % without), and of a passage (decision 4)
CHANCE = {False: 0.2, True: 1.0}
SPIKE = "a pressure peak of {:.0%} of the largest is only a few cells wide and may grow on finer grids"
EXIT, EXITS = "exit not resolved: ", 0.5  # where the feature, or the oil that it let in, leaves the film: beyond so many a
TOUCH = Reason("the surfaces touch on this grid, which is too coarse for such a thin film", "touch")
ON_FLOOR = 1.01  # of rheology.film_floor: the residual and a store's single precision leave less, a film that flows more


def steady(shot, scene):
    """{name: GridReading} of a snapshot of a steady smooth contact."""
    out = {"h_c_m": GridReading(shot.scalars["h_c_m"], positive=True), "h_min_m": film_reading(shot, scene),
           "p_max_Pa": pressure_reading(shot, Scales.of(scene).a),
           "friction_coefficient": GridReading(shot.scalars["friction_coefficient"]),
           **{name: temperature_reading(shot.scalars[name], scene) for name in HEAT if name in shot.scalars}}
    if "film_max_C" in out:  # a narrow peak of pressure may be the hottest place
        out["film_max_C"] = replace(out["film_max_C"], doubt=out["p_max_Pa"].doubt)
    if shot.fields["contact"].any():  # nothing is known of a film that this grid does not have, nor of what it does
        out = {name: replace(reading, doubt=TOUCH, lost=True) for name, reading in out.items()}
    return out


def temperature_reading(value, scene, passing=False):
    """Reading of a temperature (deg C), whose parts are those of its rise; passing: of a passage."""
    return GridReading(float(value), settled=SETTLED * scene.thermal.tolerance, zero=scene.operation.temperature,
                       chance=CHANCE[passing])


def pressure_reading(shot, a):
    """Reading of the largest pressure of a snapshot, Pa and m; a: half-width of the contact, m."""
    p = shot.fields["pressure"]
    i, j = peak(p)
    height, at = sharpest(p)
    cell, why = float(shot.x[1] - shot.x[0]), doubt(shot.x, height, at[0], a)
    return GridReading(float(p[i, j]), _between(p, i, j), _place(shot, i), cell, why)


def doubt(x, height, i, a):
    """Reason why a grid with nodes at x (m) does not resolve the largest pressure, from
    :func:`tehl_taichi.march.accuracy.peaks.sharpest`; or "".
    """
    if not height:
        return ""
    at_exit = is_at_exit(x[i], a)
    return Reason(EXIT * at_exit + SPIKE.format(height), "exit" if at_exit else "peak")


def is_at_exit(x, a):
    """Whether a peak or ripple at x (m) is at the exit of a contact of half-width a."""
    return bool(x > EXITS * a)


def pressure_doubt(reader, entries, largest, a):
    """The :func:`doubt` about these entries, from the worst peak of all; largest: their largest pressure, Pa."""
    height, at = max(_sharpest_of(reader, n, largest) for n in entries)
    return doubt(reader.x, height, at[0], a)


def _sharpest_of(reader, n, largest):
    """Sharpest peak of an entry; a reader whose fields take work keeps it in its `peaks`."""
    kept = getattr(reader, "peaks", {})
    if (n, largest) not in kept:
        kept[n, largest] = sharpest(reader.fields(n, ("pressure",))["pressure"], largest)
    return kept[n, largest]


def film_reading(shot, scene):
    """Reading of the smallest film of a snapshot, m; a film on its floor has the floor's height on every grid."""
    h = shot.fields["film"]
    i, j = np.unravel_index(h.argmin(), h.shape)
    touches = bool(h[i, j] <= ON_FLOOR * scene.rheology.film_floor * Scales.of(scene).h)
    return GridReading(float(h[i, j]), _between(h, i, j), _place(shot, i), float(shot.x[1] - shot.x[0]),
                       TOUCH if touches else "",
                   touches, positive=True)


def _place(shot, i):
    """Position of a node in m, in the frame of the contact and in that of the feature, if there is one."""
    seen = (shot.x[i], shot.x[i] - shot.feature_x)
    return tuple(float(x) for x in seen if np.isfinite(x))


def _between(values, i, j):
    """Largest difference between the extreme of `values` between the nodes and its value at node (i, j); the first row may be a
    plane of symmetry.
    """
    across = np.concatenate([values[i, 1:2], values[i]])
    return parabola_offset(values[:, j], i) + parabola_offset(across, j + 1)
