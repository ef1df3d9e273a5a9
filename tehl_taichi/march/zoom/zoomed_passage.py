"""The whole passage of a window through the run of a scene, its fields at every step, and what ended it."""

from dataclasses import dataclass, field

import numpy as np

from tehl_taichi.march.zoom.window import Window
from tehl_taichi.march.zoom.window_passage import WindowPassage

NAMES = ("pressure", "film", "traction_x_a", "traction_y_a", "traction_x_b", "traction_y_b")


@dataclass
class ZoomedPassage:
    """window; entries of the run (from 1 on) and first fine columns of the window at each; fields {name: list of
    (nx+1, ny+1) f4, SI}; ended: why it did not reach its last step, or ""; newton, cycles, attempts: work."""

    window: Window
    entries: list = field(default_factory=list)
    origins: list = field(default_factory=list)
    fields: dict = field(default_factory=lambda: {name: [] for name in NAMES})
    ended: str = ""
    newton: int = 0
    cycles: int = 0
    attempts: int = 0

    def add(self, entry, origin, values):
        """One moment."""
        self.entries.append(entry)
        self.origins.append(origin)
        for name, value in values.items():
            self.fields[name].append(np.ascontiguousarray(value.T, np.float32))

    def count(self, reports):
        """Add the work of some steps."""
        self.newton += sum(report.newton for report in reports)
        self.cycles += sum(report.cycles for report in reports)
        self.attempts += len(reports)


def passage(scene, reader, factor, notify=lambda done, total: None):
    """The ZoomedPassage of a scene through its run in `reader` (every step, the steady start first), with windows of `factor`.

    A step that fails for good ends it; notify(done, total) after each step of the run.
    """
    march = WindowPassage(scene, reader, Window.of(scene, factor))
    out, (first, last) = ZoomedPassage(march.window), steps_of(scene, march.base)
    march.begin(first)
    for step in range(first, last):
        reports = march.advance(step)
        out.count(reports)
        if not reports[-1].converged:
            out.ended = f"it did not converge with the feature at {march.base.position(step + 1):.2f} a"
            break
        out.add(step + 1, march.origin, march.fields())
        notify(step + 1 - first, last - first)
    return out


def steps_of(scene, base):
    """(first, last) step of the run between which there is a window, from zoom.from_x to to_x."""
    at = np.array([base.position(n) for n in range(base.last + 1)])
    inside = np.flatnonzero((at >= scene.zoom.from_x) & (at <= scene.zoom.to_x))
    return (int(inside[0]), int(inside[-1])) if inside.size else (0, 0)
