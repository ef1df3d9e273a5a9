"""Error bars: estimated distance of a number from its limit, from a sequence of grids, each twice as fine as the last.

Where the differences between grids fall evenly: Richardson's extrapolation with the observed order (Roache 1994), at most log2
3, and a factor of safety. This works for the central film of thick films. It does not work for thin films on coarse grids
(differences fall by 10, not 4), for extremes over nodes (they depend on the places of the nodes), and for a pressure spike,
whose height depends on the grid. There the last difference bounds the error; a part of the earlier ones is a lower limit of the
bar. A number that neither its grid nor three grids together resolve has no bar. The factors were calibrated on 1000 bars of
random scenes: `tehl bench accuracy`, docs/performance.md.
"""

import math
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any

from tehl_taichi.values.coded_text import Reason

EVENLY, STEEPEST = 1.5, 3.0  # differences that fall by less from grid to grid show no order, by more no higher one
# of the error by Richardson's extrapolation, and of the last difference where there is none; the blur of an extreme adds to it
SAFETY, UNEVEN = {False: 2.0, True: 1.75}, {False: 1.75, True: 1.25}
# Of the difference before the last, and the one before that: left as error, at most; at rest, and of a passage (473 bars of 50
# passages: 92.2 % hold with the shares at rest, 93.4 % with twice as much, 94.3 % with three times; 5.7, 5.8, 6.2 as wide)
EARLIER = {False: (0.1, 0.01), True: (0.2, 0.02)}
# Of the only difference there is, and least part of a number with one, as two grids may agree by accident; at rest (of numbers
# that are no extremes: 210 bars on 64 columns hold 98.1 %, with 1e-3 97.6 %, both 6.7 times as wide), and of a passage (24 on
# 64 columns: 95 %, those at rest 88 %, docs/performance.md)
ALONE, ACCIDENT = {False: 1.5, True: 2.0}, {False: 2e-3, True: 1e-2}
BLURRED = 1.5  # of the distance between an extreme over nodes and that of the parabola through them
HOPELESS = 0.5  # a number that changes by more than this part of itself from grid to grid is not resolved
NOTHING = 1e-15  # friction in pure rolling, that is rounding on every grid
WHOLE = Reason("its error may be as large as its value", "value")  # of one that is positive: nothing is known of it but that
MOVED = 4.0  # cells of the coarser grid that the place of an extreme may move: more is another extreme
# A number of a peak too narrow for one grid is known from three whose differences halve at least (those of a singular peak grow
# by 1.41); its bar is no smaller than the last difference, and than a quarter of the one before
HALVES, BEFORE = 2.0, 0.25
# Of what such a peak sways, but does not decide, three times the larger of the last two differences (20 passages with exits in
# one dimension, `tehl bench accuracy --only exits`: bars of surface temperatures and mean friction that hold 64 -> 94 %)
SWAY = 3.0
# Of a number of a distribution, which shows no order, since coarse grids have other waves: of the last difference, beside a
# part of the one before (rough lines, `tehl bench accuracy --only roughness`: docs/decisions/09-rough-statistics.md)
SPREAD = 1.5
# Parts of a course continue as a geometric series, for so many of the last difference at most; they may exceed the largest by
# so much of it, which then is part of the bar
GROWS_ON, EXCEEDS = 4.0, 0.1


@dataclass(frozen=True)
class GridReading:
    """A number on one grid.

    blur: largest distance of the true extreme from the extreme over nodes; place: its position in each frame of reference;
    cell: the spacing there (() and nan for a number that is no extreme); doubt: reason why this grid does not resolve the
    number, or ""; lost: the value is not even a step towards the next grid's; settled: iteration error of the solution; zero:
    value from which parts of the number count (of a temperature the inlet's, so that no bar depends on the scale); chance:
    error that the only difference between two grids may hide; positive: the number is positive by nature, as a film is; course:
    largest pressures by parts of the passage (nan: none), if several grids may remove the doubt, else (); swayed: a pressure
    that this grid does not resolve affects the number; spread: for a number of a distribution, which each finer grid samples
    again, with more short waves, the part of the last difference but one that may remain as error, else 0.
    """

    value: float
    blur: float = 0.0
    place: tuple = ()
    cell: float = math.nan
    doubt: str = ""
    lost: bool = False
    settled: float = 0.0
    zero: float = 0.0
    chance: float = 0.0
    positive: bool = False
    course: tuple = ()
    swayed: bool = False
    spread: float = 0.0

    @property
    def size(self):
        """Distance of the value from its zero."""
        return abs(self.value - self.zero)


def bar(readings, passing=False):
    """(error bar of the last of `readings`, coarsest first, or None if unknown; the reason, or ""); passing: of a passage.

    Lost readings, and those before them, do not count.
    """
    last = readings[-1]
    known = readings[max((n + 1 for n, r in enumerate(readings) if r.lost), default=0) :]
    least, doubt = _bar_of_passage(known) if known else (0.0, last.doubt)
    if doubt:
        return None, doubt
    if len(known) < 2:
        return None, Reason("no coarser grid gives it", "alone")
    before = known[-2]
    if last.positive and last.value == 0 and not last.place:  # a film that carries all here does so on finer grids, too
        return 0.0, ""
    if all(abs(reading.value) < NOTHING and not reading.blur for reading in known):
        return 0.0, ""
    if last.place and all(abs(a - b) > MOVED * before.cell for a, b in zip(last.place, before.place)):
        return None, Reason("its place differs from that on the next coarser grid", "place")
    steps = [b.value - a.value for a, b in zip(known[:-1], known[1:])][::-1]
    if abs(steps[0]) > max(HOPELESS * last.size, last.chance) and not last.spread:
        part = f"{abs(steps[0]) / last.size:.0%}" if last.size else f"{abs(steps[0]):.2g} (from zero)"
        return None, Reason(f"it still changes by {part} from grid to grid", "changes")
    accident = _accident(last, passing) if len(steps) == 1 else 0.0
    sway = SWAY * max(map(abs, steps[:2])) if last.swayed else 0.0
    left = _left_of_spread(steps, last.spread) if last.spread else _left(steps, bool(last.place), passing)
    size = max(accident, last.settled, BLURRED * last.blur, left, least, sway)
    return (None, WHOLE) if last.positive and size >= last.value else (size, "")


def _accident(reading, passing):
    """Error that the only difference between grids may hide; of extremes at rest their blur is known."""
    return max(ACCIDENT[passing] * reading.size if passing or not reading.place else 0.0, reading.chance)


def _left_of_spread(steps, part):
    """Remaining error of a number of a distribution; part: see :class:`GridReading`."""
    last, *earlier = (abs(step) for step in steps)
    return max([SPREAD * last, *(part * step for step in earlier[:1])])


def _left(steps, extreme, passing):
    """Remaining error from the differences between grids, the newest first; extreme: of an extreme over nodes; passing: see
    :func:`bar`."""
    last, *earlier = (abs(step) for step in steps)
    if not earlier:
        return ALONE[passing] * last
    even = steps[0] * steps[1] > 0 and earlier[0] >= EVENLY * last
    part = SAFETY[extreme] / (min(earlier[0] / last, STEEPEST) - 1) if even else UNEVEN[extreme]
    return max(part * last, *(share * step for share, step in zip(EARLIER[passing], earlier)))


def _bar_of_passage(known):
    """(lower limit of the bar, reason why there is none or "") of a number that depends on the highest pressures of a
    passage.
    """
    last, parts = known[-1], _parts([reading.course for reading in known[-3:]])
    if not parts:
        return 0.0, last.doubt
    top, rival = max(parts, key=lambda part: part[2]), max(parts, key=lambda part: _may_reach(*part))
    excess = max(0.0, _may_reach(*rival) / max(top[2] + abs(top[2] - top[1]), _may_reach(*top)) - 1)
    if excess > EXCEEDS:
        return 0.0, last.doubt or _rival(rival)
    values, least = [reading.value for reading in known[-3:]], excess * last.size
    if not last.doubt:
        return least, ""
    if not (_halves(*values) and _halves(*top)):  # what follows from a pressure settles no earlier than that does
        return 0.0, last.doubt
    return max(least, abs(values[2] - values[1]), BEFORE * abs(values[1] - values[0])), ""


def _rival(pressures):
    """Reason if another part of the passage makes a number unknown; pressures: Pa there on three grids."""
    grown = ", ".join(f"{p / 1e9:.2f}" for p in pressures)
    return Reason(f"the pressure in another part of the passage ({grown} GPa) grows with grid refinement and may become the "
                  "largest", "rival")


def _parts(courses):
    """Pressures on three grids in every part of a passage that all of them have; [] for fewer grids."""
    if len(courses) < 3 or not courses[-1] or len({len(course) for course in courses}) > 1:
        return []
    return [part for part in zip(*courses) if not any(map(math.isnan, part))]


def _halves(first, second, third):
    """Whether the differences of three grids fall at least by half."""
    return abs(second - first) >= HALVES * abs(third - second)


def _may_reach(first, second, third):
    """Largest pressure expected beyond three grids: the differences continue to fall; their sum is limited to GROWS_ON of the
    last.
    """
    before, last = abs(second - first), abs(third - second)
    return third + min(last / (before / last - 1) if before > last > 0 else math.inf, GROWS_ON * last)


def bars(grids, passing=False):
    """({name: error bar or None}, {name: reason of None}) of the numbers of the last of `grids`, each {name: GridReading};
    passing: see :func:`bar`."""
    found = {name: bar([grid[name] for grid in grids if name in grid], passing) for name in grids[-1]}
    return {name: size for name, (size, _) in found.items()}, {name: why for name, (size, why) in found.items() if size is None}


def estimated_error(values, doubt="", courses=()):
    """(bar of plain numbers on grids each twice as fine as the last, or nan; reason if unknown, or "").

    doubt: of the last of them; courses: of all (see :class:`GridReading`), if any.
    """
    pairs: Any = zip_longest(values, courses, fillvalue=())
    size, why = bar([GridReading(value, doubt=doubt, course=course) for value, course in pairs])
    return (math.nan if size is None else size), why


def observed_order(values):
    """Observed order with which the last three of `values` (each grid twice as fine as the last) approach their limit; nan with
    fewer values, or if they do not approach one.
    """
    if len(values) < 3 or values[-1] == values[-2]:
        return math.nan
    ratio = (values[-2] - values[-3]) / (values[-1] - values[-2])
    return math.log2(ratio) if ratio > 0 else math.nan


def parabola_offset(profile, i):
    """Difference between the extreme of the parabola through three nodes and the middle value, which is an extreme."""
    if not 0 < i < len(profile) - 1:
        return 0.0
    left, middle, right = (float(v) for v in profile[i - 1 : i + 2])
    bend = left - 2 * middle + right
    return (right - left) ** 2 / (8 * abs(bend)) if bend else 0.0
