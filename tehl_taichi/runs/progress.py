"""Progress of a run: the protocol, silent by default, and one that prints lines."""

import contextlib
import math
import sys
import time
from typing import TYPE_CHECKING, TextIO

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.pace import Pace

if TYPE_CHECKING:
    from tehl_taichi.march.snapshot import Snapshot
    from tehl_taichi.scene import Scene

STAGES = "steady start", "passage", "zoom", "stresses and fatigue", "coarse-grid runs"
STEADY, PASSAGE, ZOOM, FATIGUE, ERRORS = STAGES
LATE = ZOOM, FATIGUE, ERRORS  # stages after the last step, of minutes on fine grids
TOLD = 0.1  # of such a stage, from which on the time left is shown: its first parts, tables, take longer than the others


def progress_of(given):
    """The given progress, or one that ignores everything for None. Raises SceneError for an object without its methods."""
    if given is None:
        return Progress()
    lacks = [name for name, method in vars(Progress).items() if callable(method) and not callable(getattr(given, name, None))]
    if lacks:
        from tehl_taichi.values.coerce import shown

        raise SceneError(f"progress = {shown(given)} has no method {lacks[0]}; allowed: an object derived from "
                         "tehl_taichi.Progress, or None")
    return given


class Progress:
    """Receives the progress of a run and ignores it; derive from it and override what you need.

    Every method is called in the thread that runs; an exception in one of them ends the run like Ctrl-C.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> class Bar(tehl.Progress):
    ...     def stage(self, name, done, total):
    ...         print(f"{name} {done}/{total}")
    >>> Bar().stage("passage", 3, 192)
    passage 3/192
    """

    def begin(self, scene: "Scene") -> None:
        """Receive the scene at the start of its passage."""

    def say(self, text: str) -> None:
        """Receive a sentence about the run: what the scene leaves out, what was read, what comes next."""

    def warn(self, sentence: str) -> None:
        """Receive warnings about the scene, known before the run (those of its results are in :attr:`Run.warnings`)."""

    def stage(self, name: str, done: int, total: int) -> None:
        """Receive the progress of a stage (one of STAGES): `done` of `total` parts are complete.

        A stage begins with done = 0, a resumed passage with the number of stored steps.
        """

    def step(self, snapshot: "Snapshot") -> None:
        """Receive an accepted time step, a :class:`tehl_taichi.march.snapshot.Snapshot`, right after its stage."""


class Lines(Progress):
    """Print progress as lines: messages at once, steps and parts of later stages every few seconds, with the remaining time.

    Parameters
    ----------
    stream : file, optional
          Where to print; default: stderr.

    Examples
    --------
    >>> import sys
    >>> import tehl_taichi as tehl
    >>> tehl.Lines(sys.stdout).warn("passage cut at -1.37 a")
    warning: passage cut at -1.37 a
    """

    EVERY = 5.0  # seconds between the lines of steps and parts

    def __init__(self, stream: TextIO | None = None) -> None:
        self.stream, self.total, self.last, self.pace, self.yielded = stream, 0, time.perf_counter(), Pace(), False
        self.limit = math.inf  # Pa, of pressures: from it on a body of the scene may yield

    def begin(self, scene: "Scene") -> None:
        from tehl_taichi.scene import yield_stress

        self.limit = math.inf if scene.runs_in else yield_stress.pressure(scene)

    def say(self, text: str) -> None:
        with contextlib.suppress(BrokenPipeError):  # a run continues where its output is closed
            print(text, file=self.stream or sys.stderr, flush=True)

    def warn(self, sentence: str) -> None:
        self.say(f"warning: {sentence}")

    def stage(self, name: str, done: int, total: int) -> None:
        if name == PASSAGE:
            self.total = total
            self.pace.at(done)
        elif name in LATE:
            self.pace.at(done)
            share = done / total if total else 1.0  # coarse-grid runs may all be refused
            left = self.pace.left(total) if share >= TOLD else ""
            self._say_at_intervals(f"{name}: {share:.0%}{f', {left}' if left else ''}")

    def step(self, snapshot: "Snapshot") -> None:
        self.beyond_steel(snapshot)
        left = self.pace.left(self.total)
        self._say_at_intervals(f"step {snapshot.step}/{self.total}  {line(snapshot)}{f'  {left}' if left else ''}")

    def beyond_steel(self, snapshot: "Snapshot") -> None:
        """Report, once, a pressure beyond the yield limit of steel, so that the user can stop the run."""
        p = snapshot.scalars["p_max_Pa"]
        if p > self.limit and not self.yielded:
            self.yielded = True
            self.say(f"step {snapshot.step}: p_max {p / 1e9:.2f} GPa; bodies like these yield under asperities above about "
                     f"{self.limit / 1e9:.1f} GPa, and both are elastic here. The run continues (Ctrl-C stops it). Reduce the "
                     "load, or set feature.cutoff for a rough scan")

    def _say_at_intervals(self, text):
        if time.perf_counter() - self.last > self.EVERY:
            self.last = time.perf_counter()
            self.say(text)


def line(snapshot):
    """Text with the main numbers of a step."""
    s = snapshot.scalars
    return (f"p_max {s['p_max_Pa'] / 1e9:.3f} GPa  h_min {s['h_min_m'] * 1e6:.4f} um  residual {s['residual']:.0e}  "
            f"cycles {s['cycles']:.0f}" + (f"  film {s['film_max_C']:.0f} °C" if "film_max_C" in s else ""))
