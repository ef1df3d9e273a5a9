"""The whole passage of a window through the run of a scene: its fields at every step, and why it ended."""

import itertools
from dataclasses import dataclass, field

import numpy as np

from tehl_taichi.march.zoom.base_states import BaseStates
from tehl_taichi.march.zoom.window import Window
from tehl_taichi.march.zoom.window_passage import WindowPassage
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
    """Move windows of these factors through the run of a scene; return a list of their ZoomedPassages.

    reader: every step of the run, the steady start first. until: position (a) of the feature up to which the run resolves the
    pressure; None: windows begin with the passage. notify: called with (done, total) steps of the run. A window that does
    not converge ends; the others continue.
    """
    base = BaseStates(scene, reader)
    first, last = steps_of(scene, base, until)
    base.skip_to(first)
    out, done = {}, itertools.count(1)
    groups = _groups(sorted(factors, reverse=True), base.holds(first))

    def notify_one():
        notify(next(done), len(groups) * (last - first))

    for group in groups:
        out |= zip(group, _marched(base, group, first, last, notify_one))
    return [out[factor] for factor in factors]


def _groups(factors, repeatable):
    """Lists of the factors whose windows move together: each by itself if the states of the run can be read several times, so
    that it uses the tables and compiled kernels of the one before (gear with temperatures, factors 4 and 2: 4.5 s of processor
    time for kernels)."""
    return [[factor] for factor in factors] if repeatable else [factors]


def _marched(base, factors, first, last, notify):
    """The ZoomedPassages of windows that move together from step `first` of the run to `last`; notify(): called at each."""
    marches = [WindowPassage(base, Window.of(base.scene, factor)) for factor in factors]
    out = [ZoomedPassage(march.window) for march in marches]
    for march in marches:
        march.begin(first)
    for step in range(first, last):
        for march, found in zip(marches, out):
            if not found.ended:
                _advance(march, found, step)
        notify()
    return out


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
    at, begin = np.array([base.position(n) for n in range(base.last + 1)]), scene.zoom.from_x
    if begin == AUTO:
        begin = -np.inf if until is None else until - LEAD
    inside = np.flatnonzero((at >= begin) & (at <= scene.zoom.to_x))
    return (int(inside[0]), int(inside[-1])) if inside.size else (0, 0)
