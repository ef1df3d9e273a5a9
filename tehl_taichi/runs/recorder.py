"""Recorder of a run: writes each step into the store while the next one is computed; checkpoints and publishing are less
frequent.

Publishing a step rewrites every series, three times the work of its fields. With a checkpoint and publishing at every step,
writing took 3.3 of the 33 CPU s of the gear passage and a quarter of its time, since threads share the interpreter.
"""

import dataclasses
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

from tehl_taichi.march.passage import march
from tehl_taichi.march.step_output import Scalar, entries
from tehl_taichi.scene.timeline import total_steps

SWITCH = 1e-4  # s, interpreter switch interval while a thread writes
EVERY = 2.0  # s between the states that a run can continue from; a thermal one has 11 MB at 257x65x9, a tenth of a step's time
SHOWN = 1.0  # s between the steps that readers see, at 30 ms each: readers look no more often, and no run resumes from one


class Interval:
    """Timer: due again after a number of seconds, and at the last step."""

    def __init__(self, every, total):
        self.every, self.total, self.last = every, total, time.monotonic()

    def at(self, step):
        """Whether it is due at this step; if so, the time starts again."""
        if step < self.total and time.monotonic() - self.last < self.every:
            return False
        self.last = time.monotonic()
        return True


class Thinned:
    """Every n-th snapshot and the last (step `total`), with scalars reduced over the omitted steps (see :class:`Scalar`)."""

    METHODS: dict[str, Callable[[Sequence[float]], float]] = {
        "maximum": max, "minimum": min, "sum": sum, "mean": lambda values: sum(values) / len(values),
        "point": lambda values: values[-1]}

    def __init__(self, every, total):
        self.every, self.total, self.waiting = every, total, []

    def of(self, snapshot):
        """Snapshot to store, or None if it is omitted."""
        self.waiting.append(snapshot.scalars)
        if snapshot.step % self.every and snapshot.step < self.total:
            return None
        over = {name: self.METHODS[scalar.over] for name, scalar in entries(Scalar).items()}
        scalars = {name: over[name]([one[name] for one in self.waiting]) for name in snapshot.scalars}
        self.waiting = []
        return dataclasses.replace(snapshot, scalars=scalars)


def march_on(saved, state, notify=None, changes=()):
    """March from the last checkpoint of the store (`state`, as :meth:`Store.go_back` returns it) to the end of its scene.

    notify(snapshot): called after each step; changes: of the surfaces, see :func:`tehl_taichi.march.passage.march`. One step is
    written while the next one is computed. States stay in `saved.kept_states`, unless that is None. The solver releases
    the interpreter lock thousands of times per step; it must not wait 5 ms for the writer each time.
    """
    before, total, pending = sys.getswitchinterval(), total_steps(saved.scene), None
    states, shown, thinned = Interval(EVERY, total), Interval(SHOWN, total), Thinned(saved.scene.output.every, total)
    sys.setswitchinterval(SWITCH)
    try:
        with ThreadPoolExecutor(1) as writer:  # leaving it waits for the last write
            for snapshot in march(saved.scene, state, changes):
                if saved.kept_states:
                    saved.kept_states.add_heat(snapshot.step, snapshot.carried)
                if (entry := thinned.of(snapshot)) is not None:
                    keep = entry.state if states.at(entry.step) else None
                    if keep and saved.kept_states:
                        saved.kept_states.add(keep)
                    if pending:
                        pending.result()
                    pending = writer.submit(saved.append, entry, keep, shown.at(entry.step))
                if notify:
                    notify(snapshot)
            if pending:
                pending.result()
    finally:
        sys.setswitchinterval(before)
        saved.show()
