"""Cycles of a passage on the critical plane: rainflow counting of the shear there, and the number above the fatigue limit.

The shear is taken along the direction of its largest range. Passages repeat, so a history is counted as periodic (ASTM
E1049-85, section 5.4.5): starting at its largest value, which leaves only whole cycles.
"""

import numpy as np

from tehl_taichi.fatigue import findley
from tehl_taichi.laws.criteria import CRITERIA

DIRECTIONS = 90  # of the plane: the range is right to 2e-4
LEAST = 0.05  # of the limit: smaller cycles are noise of the grid


def rainflow(values):
    """Cycles of a periodic history (n,) from :func:`from_largest`, (n, 3): indices of both ends, and of the value that closes
    the cycle, the first one that is back at its beginning.
    """
    stack, out = [], []
    for n in _turns(values):
        stack.append(n)
        while len(stack) > 2 and abs(values[n] - values[stack[-2]]) >= (size := abs(values[stack[-2]] - values[stack[-3]])):
            one, other = stack[-3:-1]
            out.append((one, other, other + int(np.argmax(np.abs(values[other : n + 1] - values[other]) >= size))))
            del stack[-3:-1]
    return np.array(out, int).reshape(-1, 3)


def from_largest(values, *others):
    """One period of a history and of others beside it, from its largest value to the same value."""
    top = int(np.argmax(values))
    return [np.append(np.roll(one, -top), one[top]) for one in (values, *others)]


def _turns(values):
    """Indices of the first and last value and of the turning points."""
    moves = np.flatnonzero(np.diff(values)) + 1  # equal neighbours are one
    kept = np.append(0, moves)
    steps = np.diff(values[kept])
    return [0, *kept[1:-1][steps[:-1] * steps[1:] < 0], kept[-1]] if kept.size > 1 else [0]


def above(history, normal, local):
    """Number of cycles per passage above the limit at a point.

    history (times, 6) Pa, the last moment unloaded; normal (3,) of its critical plane; local: the
    :class:`tehl_taichi.scene.strength.strength.LocalStrength` there. The stress of a cycle is the criterion with half its range
    as amplitude, and with the largest normal and mean stress during the cycle.
    """
    dip, strike, normal_stress = findley.shear_path(history, normal)
    mean = history[:, :3].mean(axis=1)
    shear, normal_stress, mean = from_largest(_along_the_largest(dip, strike), normal_stress, mean)
    rule, count = CRITERIA[local.criterion], 0
    for one, other, closes in rainflow(shear):
        amplitude = 0.5 * abs(shear[one] - shear[other])
        time = slice(one, closes + 1)
        stress = rule.value(amplitude, normal_stress[time].max(), mean[time].max(), local.kappa)
        count += amplitude >= LEAST * local.endurance and stress > local.endurance
    return int(count)


def _along_the_largest(u, v):
    """Path (u, v) along the direction of its largest range."""
    angles = np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    along = np.outer(np.cos(angles), u) + np.outer(np.sin(angles), v)
    return along[int(np.argmax(np.ptp(along, axis=1)))]
