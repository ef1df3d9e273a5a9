"""Oil that flows along the crack: lubrication in its own opening, in and out at the mouth, none through the tip.

Volumes of cells in time, implicitly (first order); between the middles of two cells the resistances of the way add up. Faces
that touch leave a gap (:data:`tehl_taichi.crack.filling.GAP`). No pressure is below zero: a cavity fills before it has one.
"""

import numpy as np

from tehl_taichi.crack.filling import Filling
from tehl_taichi.crack.fillings import in_tension
from tehl_taichi.values.registry import Checked

SAME, ROUNDS = 1e-6, 120  # of the largest pressure: resistances and pressures fit; rounds of a moment until it is unsettled
CALM = 20  # rounds after which half of a change of the resistances (of their logarithm) is taken, later a third, a fourth ...


def inside(wet):
    """Pressures in the crack, one per element of a straight crack."""
    return wet.marched(wet.cells, lambda march: _full(march, march.under(0, wet.mouth[0])), _step)


def _full(march, found):
    fluid = march.wet.fluid
    return found, fluid.compression(found.pressure) * (march.volume @ found.values + fluid.gap * march.length)


def _step(march, n, found, content):
    """Found and contents after the time since the last moment."""
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
    """(cells,) Pa s/m^2 on the way from the mouth to the first middle of a cell, and from each to the next one."""
    faces, fluid, halves = march.wet.faces, march.wet.fluid, 2 * p.size
    half = faces.parts(halves)
    h = np.maximum(faces.opening() @ values, 0.0) + fluid.gap
    each = np.bincount(half, 12 * fluid.viscosity(p)[half // 2] * faces.length / h**3, halves)
    return each[:-1:2] + np.concatenate([[0.0], each[1:-1:2]])


def _conductance(resistance):
    """(cells, cells): T p is what flows out of every cell, m^2/s, against no pressure at the mouth."""
    g = 1 / resistance
    return np.diag(g + np.append(g[1:], 0.0)) - np.diag(g[1:], 1) - np.diag(g[1:], -1)


ALONG: Filling = Filling(
    name="flow", says="oil flows along the crack, in and out at the mouth: Reynolds equation in the crack opening",
    source="Reynolds 1886; cavities after Elrod 1981", inside=inside,
    checked=(Checked("normal edge crack, tension 1, pressure 3 at the mouth for long: four times that of the tension",
                     4 * 1.1215, lambda: in_tension(ALONG, mouth=3.0), 1e-3),))
