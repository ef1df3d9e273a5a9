"""Error bars: how far a number may lie from its limit, from what grids each twice as fine as the one before gave.

Richardson's extrapolation with one observed order (Roache 1994) stands on three grids that approach their limit evenly. These
do so for the central film of thick films only: thin films are not there yet on the coarse grids (differences fall by 10, not
4), extremes over nodes jump about with the places of the nodes, and a pressure spike is as high as its grid is fine. So every
difference seen bounds the error, the earlier ones by what is left of them at least after so many grids, and a number that the
grid cannot know has no bar. The factors are measured: `tehl bench accuracy`, docs/benchmarks.md.
"""

import math
from dataclasses import dataclass

import numpy as np

LEFT = (1.0, 1 / 6, 1 / 36)  # of the last difference, the one before ... is left as error, at most
EXTREME = (2 / 3, 1 / 6, 1 / 36)  # the same of an extreme over nodes, of which its blur bounds the jumps
ALONE = 1.5  # of the only difference there is
HOPELESS = 0.5  # a number that changes by more than this part of itself from grid to grid is not resolved
MOVED = 4.0  # cells of the coarser grid that the place of an extreme may move: more is another extreme
NARROW = 0.75  # a peak with less than this part of its height two cells away, on the mean of both sides, is not resolved
RIVAL = 0.65  # of the largest pressure: a narrow spike that high may overtake it on finer grids (Moes 50, 20: 0.60, 0.65, 1.04)


@dataclass(frozen=True)
class Reading:
    """A number on one grid.

    blur: how far the true extreme may lie from the one over nodes on this grid; place: where that is, in each frame in which it
    may rest, and cell: the spacing there, () and nan for a number that is no extreme; doubt: why this grid cannot know the
    number ("" where it can); lost: whether its value is not even a step towards that of the next grid.
    """

    value: float
    blur: float = 0.0
    place: tuple = ()
    cell: float = math.nan
    doubt: str = ""
    lost: bool = False


def bar(readings):
    """(error bar of the last of `readings`, coarsest first, or None where it is not known; why it is not, or "").

    Lost readings, and those before them, do not count.
    """
    last = readings[-1]
    if last.doubt:
        return None, last.doubt
    known = readings[max((n + 1 for n, r in enumerate(readings) if r.lost), default=0) :]
    if len(known) < 2:
        return None, "no coarser grid tells it"
    before = known[-2]
    if last.place and all(abs(a - b) > MOVED * before.cell for a, b in zip(last.place, before.place)):
        return None, "its place differs from that on the next coarser grid"
    steps = [abs(b.value - a.value) for a, b in zip(known[:-1], known[1:])][::-1]
    if steps[0] > HOPELESS * abs(last.value):
        return None, f"it still changes by {steps[0] / abs(last.value):.0%} from grid to grid"
    left = (ALONE,) if len(steps) == 1 else EXTREME if last.place else LEFT
    return max(last.blur, *(part * step for part, step in zip(left, steps))), ""


def bars(grids):
    """({name: error bar or None}, {name: why it is None}) of the numbers of the last of `grids`, each {name: Reading}."""
    found = {name: bar([grid[name] for grid in grids if name in grid]) for name in grids[-1]}
    return {name: size for name, (size, _) in found.items()}, {name: why for name, (size, why) in found.items() if size is None}


def estimated_error(values):
    """The bar of plain numbers on grids each twice as fine as the one before, or nan."""
    found = bar([Reading(value) for value in values])[0]
    return math.nan if found is None else found


def observed_order(values):
    """Order by which the last three of `values` (each grid twice as fine as the one before) approach their limit; nan with
    fewer, or where they do not."""
    if len(values) < 3 or values[-1] == values[-2]:
        return math.nan
    ratio = (values[-2] - values[-3]) / (values[-1] - values[-2])
    return math.log2(ratio) if ratio > 0 else math.nan


def beside(profile, i):
    """Distance of the extreme of a parabola through three nodes from the value at the middle one, which is an extreme."""
    if not 0 < i < len(profile) - 1:
        return 0.0
    left, middle, right = (float(v) for v in profile[i - 1 : i + 2])
    bend = left - 2 * middle + right
    return (right - left) ** 2 / (8 * abs(bend)) if bend else 0.0


def narrow_peak(P):
    """Height over the largest of the highest peak of P (n,) that is two cells wide at most, 0 without one."""
    top = np.flatnonzero((P[2:-2] > P[1:-3]) & (P[2:-2] >= P[3:-1])) + 2
    sharp = [P[i] for i in top if 0.5 * (P[i - 2] + P[i + 2]) < NARROW * P[i]]
    return float(max(sharp, default=0.0) / P.max())
