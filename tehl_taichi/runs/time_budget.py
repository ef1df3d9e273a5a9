"""Time budget of a command: its parts do not overlap, and their sum is the elapsed time."""

import contextlib
import functools
import threading
import time

from tehl_taichi.engine.watched_calls import wrapped
from tehl_taichi.runs.progress import ERRORS, FATIGUE, PASSAGE, STEADY, ZOOM

SETUP, MACHINE_CODE, REST = "imports and scene", "kernels: tracing, machine code or cache", "summary and writing"
LABELS = {STEADY: "steady start", PASSAGE: "passage: rest", FATIGUE: "fatigue: rest", ERRORS: "coarse-grid runs: waiting",
          ZOOM: "zoom window: rest"}
ENDED = {STEADY: "contact alone, new store"}  # what follows the end of a stage, if not REST
# what the main thread does inside a stage: {name: function or method}
MARCHED = {"pressure": "pressure.newton:PressureSolver.solve", "temperatures": "heat.temperatures:FilmHeat.solve",
           "start values": "march.prediction:Prediction.put", "snapshots": "march.snapshot:take"}
SEARCHED = {"stresses": "fatigue.stress.histories:StressHistories.gathered", "planes": "fatigue.findley:search",
            "stress by heat below": "fatigue.stress.row_histories:_heat"}
INSIDE = {PASSAGE: MARCHED, ZOOM: {name: MARCHED[name] for name in ("pressure", "temperatures")}, FATIGUE: SEARCHED}


class TimeBudget:
    """Seconds of each part of a command since `began` (of time.perf_counter()), in `spent`; :meth:`stage` receives the stages
    of a :class:`tehl_taichi.runs.progress.Progress`.
    """

    def __init__(self, began):
        self.spent, self.since, self.compiled, self.stage_now = {}, began, 0.0, SETUP
        self.open = [SETUP]

    def stage(self, name, done, total):
        """Receive that `done` of `total` parts of a stage are complete."""
        self._charge()
        self.stage_now = name if done < total else ENDED.get(name, REST)
        self.open[0] = LABELS.get(self.stage_now, self.stage_now)

    @contextlib.contextmanager
    def watching(self):
        """Context manager: calls inside stages are timed as separate parts."""
        with wrapped({**MARCHED, **SEARCHED}, self._wrapper):
            yield
        self._charge()

    def rows(self):
        """[(part, s, share)], the longest first, and their sum."""
        whole = sum(self.spent.values())
        parts = sorted(self.spent.items(), key=lambda part: -part[1])
        return [(name, seconds, seconds / whole) for name, seconds in parts] + [("sum", whole, 1.0)]

    def _wrapper(self, name, function):
        @functools.wraps(function)
        def watched(*args, **options):
            stage = self.stage_now
            if name not in INSIDE.get(stage, ()) or threading.current_thread() is not threading.main_thread():
                return function(*args, **options)
            self._charge()
            self.open.append(f"{LABELS[stage].partition(':')[0]}: {name}")
            try:
                return function(*args, **options)
            finally:
                self._charge()
                self.open.pop()

        return watched

    def _charge(self):
        """Add the time since the last call to the open part, without the time for making kernels."""
        from tehl_taichi.engine.taichi_patches.prebound import binding_seconds

        now, compiled = time.perf_counter(), binding_seconds()
        made = min(compiled - self.compiled, now - self.since)
        for name, seconds in ((MACHINE_CODE, made), (self.open[-1], now - self.since - made)):
            self.spent[name] = self.spent.get(name, 0.0) + seconds
        self.since, self.compiled = now, compiled
