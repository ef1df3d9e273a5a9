"""Oil that flows along the crack: lubrication in its own opening, through the mouth, not through the tip.

Implicit first-order volume balance of the cells; the resistances between the middles of two cells add up. Touching faces leave
a gap (:data:`tehl_taichi.crack.filling.GAP`). No pressure is negative: a cavity fills before its pressure rises.
"""

import numpy as np

from tehl_taichi.crack.filling import Filling
from tehl_taichi.crack.fillings import check_value
from tehl_taichi.values.registry import Checked

SAME, ROUNDS = 1e-6, 120  # of the largest pressure: resistances and pressures fit; rounds of a moment until it is unsettled
CALM = 20  # rounds after which half of a change of the resistances (of their logarithm) is taken, later a third, a fourth ...


def inside(wet):
    """State with a pressure per cell; there is one cell per element of a straight crack."""
    return wet.marched(wet.cells, lambda march: _full(march, march.under(0, wet.mouth[0])), _step)


def _full(march, found):
    fluid = march.wet.fluid
    return found, fluid.compression(found.pressure) * (march.volume @ found.values + fluid.gap * march.length)


def _step(march, n, found, content):
    """State and oil contents at moment n, from those of the previous one."""
    wet, dt, p = march.wet, march.wet.times[n] - march.wet.times[n - 1], found.pressure
    later, resistance = content, 1.0
    for round_ in range(ROUNDS):
        part = 1 / (1 + round_ // CALM)
        resistance = _resistance(march, found.values, p) ** part * resistance ** (1 - part)
        T = _conductance(resistance)
        entered = np.eye(p.size)[0] * dt * wet.mouth[n] / resistance[0]
        D = dt * T + np.diag(wet.fluid.compressibility(p) * later)
        found = march.holding(n, content + entered - wet.fluid.gap * march.length, D)
        change, p = np.abs(found.pressure - p).max(), found.pressure
        later = np.maximum(content + entered - dt * T @ p, 0.0)
        if change <= SAME * max(p.max(), wet.mouth[n]):
            return found, later
    return found.unsettled(), later


def _resistance(march, values, p):
    """Flow resistances (cells,), Pa s/m^2: from the mouth to the middle of the first cell, then between neighbouring
    middles.
    """
    faces, fluid, halves = march.wet.faces, march.wet.fluid, 2 * p.size
    half = faces.parts(halves)
    h = np.maximum(faces.opening() @ values, 0.0) + fluid.gap
    each = np.bincount(half, 12 * fluid.viscosity(p)[half // 2] * faces.length / h**3, halves)
    return each[:-1:2] + np.concatenate([[0.0], each[1:-1:2]])


def _conductance(resistance):
    """Matrix T (cells, cells): T p is the outflow of every cell (m^2/s) if the pressure at the mouth is zero."""
    g = 1 / resistance
    return np.diag(g + np.append(g[1:], 0.0)) - np.diag(g[1:], 1) - np.diag(g[1:], -1)


ALONG: Filling = Filling(
    name="flow", says="oil flows along the crack, in and out at the mouth: Reynolds equation in the crack opening",
    source="Reynolds 1886; cavities after Elrod 1981", inside=inside,
    checked=(Checked("normal edge crack, tension 1, pressure 3 at the mouth for long: four times that of the tension",
                     4 * 1.1215, lambda: check_value(ALONG, mouth=3.0), 1e-3),))
