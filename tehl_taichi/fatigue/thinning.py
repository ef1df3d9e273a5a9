"""Reduction of the moments of a stress history for the first part of a search.

All other moments lie close to the chords between the kept ones. Shear (from any centre) and normal stress are convex functions
of the stress. So on every plane a moment on a chord is at most as bad as the worse end, and a moment beside it is worse by at
most its distance. Half of a history hardly changes, far from the contact.
"""

from tehl_taichi.engine.language import ti
from tehl_taichi.fatigue.plane_components import stress

OFF = 2e-4  # largest distance over the range of the stresses: 110 of 539 moments of the gear's passage on 512 columns are kept
LONGEST = 32  # largest number of moments from one kept moment to the next


@ti.func
def extent(S: ti.template(), row, steps):
    """(smallest, largest) of every stress component, each (6,)."""
    low, high = stress(S, row, 0), stress(S, row, 0)
    for t in range(1, steps):
        s = stress(S, row, t)
        low, high = ti.min(low, s), ti.max(high, s)
    return low, high


@ti.func
def thin(S: ti.template(), some: ti.template(), row, steps, low, high):
    """Choose the moments some[row] to keep, including the first and the last; returns their number. low, high: extent of the
    history.
    """
    limit = OFF * OFF * (high - low).dot(high - low)
    some[row, 0] = 0
    count, last = 1, 0
    while last < steps - 1:
        first, going = last, 1
        last += 1
        while going == 1 and last < steps - 1 and last < first + LONGEST:
            going = along(S, row, first, last + 1, limit)
            last += going
        some[row, count] = last
        count += 1
    return count


@ti.func
def along(S: ti.template(), row, first, last, limit):
    """1 if all moments between two lie within sqrt(limit) of their chord, else 0."""
    start, good = stress(S, row, first), 1
    chord = stress(S, row, last) - start
    length = chord.dot(chord)
    for t in range(first + 1, last):
        way = stress(S, row, t) - start
        part = 0.0
        if length > 0:
            part = ti.min(ti.max(way.dot(chord) / length, 0.0), 1.0)
        off = way - part * chord
        if off.dot(off) > limit:
            good = 0
    return good


@ti.func
def all_of(some: ti.template(), row, steps):
    """Keep all moments in some[row]; returns their number."""
    for t in range(steps):
        some[row, t] = t
    return steps
