"""The whole passage of windows through the run of a scene: their fields at every step, and why they ended."""

import itertools
from dataclasses import dataclass, field

import numpy as np

from tehl_taichi.march.zoom.base_states import BaseStates
from tehl_taichi.march.zoom.window import Window, windows_of
from tehl_taichi.march.zoom.window_passage import WindowPassage
from tehl_taichi.scene.zoom_room import followed
from tehl_taichi.values.quantity import AUTO

LEAD = 0.4  # a: distance of the feature that a window begins before it is needed, so that all oil in it is its own by then


@dataclass
class ZoomedPassage:
    """Results of a window at the steps of the run.

    entries: numbers of the run's entries (from 1 on). origins: first fine column of the window at each. fields: {name: list of
    (nx+1, ny+1) f4, SI units}. numbers: {name: list}, extremes of the run with the window. between: moments between these
    entries, as :attr:`tehl_taichi.march.zoom.window_passage.WindowPassage.between`. ended: reason why it stopped before its
    last step, or "". newton, cycles, attempts: Newton steps, linear iterations, time steps.
    """

    window: Window
    entries: list = field(default_factory=list)
    origins: list = field(default_factory=list)
    fields: dict = field(default_factory=dict)
    numbers: dict = field(default_factory=dict)
    between: list = field(default_factory=list)
    ended: str = ""
    newton: int = 0
    cycles: int = 0
    attempts: int = 0

    def cut(self, count):
        """Keep the results at the first `count` entries."""
        end = self.entries[count - 1] if count else 0
        for values in (self.entries, self.origins, *self.fields.values(), *self.numbers.values()):
            del values[count:]
        self.between = [one for one in self.between if one[0] < end]

    def add(self, entry, origin, values, numbers):
        """Add the results at one entry; values: {name: (nx+1, ny+1)}."""
        self.entries.append(entry)
        self.origins.append(origin)
        for name, value in values.items():
            self.fields.setdefault(name, []).append(value)
        for name, number in numbers.items():
            self.numbers.setdefault(name, []).append(number)

    def count(self, reports):
        """Add the work of some SolveReports."""
        self.newton += sum(report.newton for report in reports)
        self.cycles += sum(report.cycles for report in reports)
        self.attempts += len(reports)


def passages(scene, reader, factors, notify=lambda done, total: None, until=None):
    """Move windows of these factors through the run of a scene; return for each factor a list of the ZoomedPassages of its
    windows.

    reader: every step of the run, the steady start first. until: position (a) of the feature up to which the run resolves the
    pressure; None: windows begin with the passage. notify: called with (done, total) steps of the run. A window that does
    not converge ends, with the others of its factor; those of other factors continue.
    """
    base = BaseStates(scene, reader)
    first, last = steps_of(scene, base, until)
    base.skip_to(first)
    out, done = {}, itertools.count(1)
    places = [(factor, n) for factor in sorted(factors, reverse=True) for n in range(len(followed(scene)))]
    # each by itself if the states of the run can be read several times: it then uses the tables and compiled kernels of the one
    # before (gear with temperatures, factors 4 and 2: 4.5 s of processor time for kernels)
    groups = [[place] for place in places] if base.holds(first) else [places]

    def notify_one():
        notify(next(done), len(groups) * (last - first))

    for group in groups:
        out |= zip(group, _marched(base, group, first, last, notify_one))
    return [_together([found for (own, _), found in sorted(out.items()) if own == factor]) for factor in factors]


def _marched(base, places, first, last, notify):
    """The ZoomedPassages of windows that move together from step `first` of the run to `last`; places: [(factor, number of
    the window)]; notify(): called at each step."""
    marches = [_march(base, *place) for place in places]
    out = [ZoomedPassage(march.window) for march in marches]
    for march in marches:
        march.begin(first)
    for step in range(first, last):
        for march, found in zip(marches, out):
            if not found.ended:
                _advance(march, found, step)
        notify()
    return out


def _march(base, factor, n):
    """The WindowPassage of window n of a factor."""
    windows = windows_of(base.scene, factor)
    return WindowPassage(base, windows[n], windows[:n] + windows[n + 1 :])


def _together(found):
    """The ZoomedPassages of the windows of a factor, all up to the step at which the first one ended."""
    last = min(len(one.entries) for one in found)
    for one in found:
        one.cut(last)
    return found


def _advance(march, found, step):
    """Advance one window from `step` to the next step of the run, and add its results to `found`."""
    reports = march.advance(step)
    found.count(reports)
    if reports[-1].converged:
        found.add(step + 1, march.origin, march.fields(), march.numbers(step + 1))
        found.between += march.between
    else:
        found.ended = f"it did not converge with the feature at {march.base.position(step + 1):.2f} a"


def steps_of(scene, base, until=None):
    """(first, last) step of the run with a window, by zoom.from_x and to_x; until: see :func:`passages`."""
    at = np.array([base.position(n) for n in range(base.last + 1)])
    inside = np.flatnonzero((at >= begin_of(scene, until)) & (at <= scene.zoom.to_x))
    return (int(inside[0]), int(inside[-1])) if inside.size else (0, 0)


def begin_of(scene, until):
    """Position (a) of the first feature from which windows move: zoom.from_x, or before `until` (:func:`passages`), so that the
    oil of the slowest one is its own by then.
    """
    if scene.zoom.from_x != AUTO:
        return scene.zoom.from_x
    return -np.inf if until is None else until - LEAD / min(surface.pace for surface in followed(scene))
