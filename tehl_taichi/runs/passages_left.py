"""Remaining time of several passages, from the steps in their stores; shorter ways, named before they start."""

import contextlib
import time

from tehl_taichi.errors import Error, for_reader
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.runs.pace import about
from tehl_taichi.scene.timeline import total_steps
from tehl_taichi.store.store import Store
from tehl_taichi.values.coded_text import grid_option
from tehl_taichi.values.digits import number_of

EVERY = 15.0  # s between two lines about passages that run
SURE = 0.01  # of the work that has to be done before its pace gives a remaining time
LONG = 1e7  # work of passages that take minutes, as of coarse_runs.heavy_work


def announced(scenes):
    """Sentences about the passages among scenes that will run: their steps, and shorter ways if they take minutes."""
    passing = [scene for scene in scenes if scene.transient]
    if not passing:
        return []
    counts = sorted({total_steps(scene) for scene in passing})
    steps = f"{counts[0]} to {counts[-1]}" if len(counts) > 1 else f"{counts[0]}"
    line = f"{number_of(len(passing), 'passage')} of {number_of(steps, 'step')} on {_cells(passing[0])} cells"
    if sum(map(coarse_runs.heavy_work, passing)) < LONG:
        return [line]
    shorter = for_reader("; ".join(_shorter(passing)))
    return [f"{line}; the remaining time follows from the first steps. Shorter: {shorter}"]


def _cells(scene):
    """Text of its cells, as for --grid."""
    return str(_grid(scene)).removeprefix("--grid ")


def _grid(scene, share=1):
    g = scene.grid
    return grid_option(scene, g.nx // share, g.ny // share)


def _shorter(scenes):
    """Texts of options that save time: no passage, half the cells along each axis."""
    yield "--steady, without passages"
    with contextlib.suppress(Error):
        coarse = [one.replace(**{"grid.nx": one.grid.nx // 2, "grid.ny": one.grid.ny // 2}) for one in scenes]
        share = sum(map(coarse_runs.heavy_work, coarse)) / sum(map(coarse_runs.heavy_work, scenes))
        yield f"{_grid(scenes[0], 2)}, {share:.2g} times the work, larger errors"


class PassagesLeft:
    """Clock of passages that this or other processes write into stores; jobs: [(scene, path of its store)]."""

    def __init__(self, jobs, say):
        self.jobs = [(scene, path) for scene, path in jobs if scene.transient]
        self.say, self.said, self.began = say, time.monotonic(), None

    def tick(self):
        """Print a line about the passages that run, every EVERY seconds."""
        if time.monotonic() - self.said < EVERY:
            return
        self.said = time.monotonic()
        steps = self._steps()
        if self.began is None and any(steps):  # kernels are loaded
            self.began = self.said, self._done(steps)
        running = [text for (scene, path), done in zip(self.jobs, steps) if (text := _state(scene, path, done))]
        if left := self._left(steps):
            running.append(left)
        if running:
            self.say("; ".join(running))

    def left(self):
        """Text of the remaining time at the pace since the first call; "" while it is unknown, and after the last passage."""
        steps = self._steps()
        self.began = self.began or (time.monotonic(), self._done(steps))
        return self._left(steps)

    def _steps(self):
        return [_last_step(path) for _, path in self.jobs]

    def _done(self, steps):
        return sum(coarse_runs.nodes(scene) * n for (scene, _), n in zip(self.jobs, steps))

    def _left(self, steps):
        done, total = self._done(steps), sum(coarse_runs.work(scene) for scene, _ in self.jobs)
        since, before = self.began or (0.0, done)
        if done - before <= SURE * total or done >= total:
            return ""
        seconds = (total - done) * (time.monotonic() - since) / (done - before)
        return f"{about(seconds)} left for {number_of(len(steps), 'passage')}"


def _state(scene, path, done):
    """Text of a run after `done` steps, "" before its first step and after its end."""
    if done < total_steps(scene):
        return f"{scene.name} step {done} of {total_steps(scene)}" if done else ""
    return "" if _ended(path) else f"{scene.name} stresses and error bars"


def _ended(path):
    """Whether the run in a store is finished."""
    with contextlib.suppress(Error):
        return Store.open(path).finished
    return False


def _last_step(path):
    """Number of the last step in a store, 0 without one."""
    with contextlib.suppress(Error):
        return Store.open(path).last_step
    return 0
