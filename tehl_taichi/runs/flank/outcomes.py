"""Jobs of a flank: its scenes run in parallel or in this process; results in existing stores are reused."""

import itertools
import os
from dataclasses import dataclass
from pathlib import Path

from tehl_taichi.disk.locked_folder import only_writer
from tehl_taichi.errors import Interrupted, StoreError, are_options_typed, interrupt
from tehl_taichi.runs import passages_left, single_run
from tehl_taichi.runs.progress import Progress, progress_of
from tehl_taichi.runs.single_run import check_version
from tehl_taichi.runs.sweep import case, pool
from tehl_taichi.values.coded_warning import Kinds
from tehl_taichi.values.digits import number_of, part_of
from tehl_taichi.values.escape import typed

STAGE = "positions"


@dataclass(frozen=True)
class Outcome:
    """Outcome of a scene. summary: as `tehl run --json`, None without one; reason: why it is missing; store: its path."""

    store: Path
    summary: dict | None = None
    reason: str = ""


def computed(made, with_outcome, scenes, workers=None, threads=None, progress=None):
    """The ContactSet `made` with the outcomes of the scenes, written first (unless it lies there) and after each outcome.

    with_outcome(set, n, outcome): the set with the outcome of scene n. Other arguments and errors: :func:`summaries`; also
    raises Busy if another process writes in its folder, StoreError if the folder cannot be written, then Interrupted.
    """
    done = 0
    try:
        with only_writer(Path(made.folder)):
            found = summaries(scenes, made.folder, workers, threads, progress)
            if not made.lies_in(made.folder):
                made.write()
            for n, outcome in found:
                made, done = with_outcome(made, n, outcome), done + 1
                _write(made)
    except KeyboardInterrupt as stop:
        raise interrupt(stop, f" after {part_of(done, len(scenes), 'contact')}; {_remedy(made)}") from None
    return made


def _write(made):
    """Write a set with its outcomes. Raises Interrupted, because its stores are resumed."""
    try:
        made.write()
    except StoreError as error:
        raise Interrupted(f"{error}; {_remedy(made)}") from None


def _remedy(made):
    """How a set that stopped is continued."""
    again = f"command with --out {typed(made.folder)}" if are_options_typed() else f"call with folder={str(made.folder)!r}"
    return f"repeat the {again} to resume"


def summaries(scenes, folder, workers=None, threads=None, progress=None):
    """Iterator of (number of the scene, its Outcome) in order of completion, each with a store NAME.zarr in `folder`.

    A scene that does not converge, or loses its worker twice, does not stop the others. An existing store is resumed. workers,
    threads: see :func:`tehl_taichi.runs.sweep.pool.sizes`. Raises StoreError for a store of another scene; KeyboardInterrupt
    keeps all stored data.
    """
    places = [(scene, Path(folder) / f"{scene.name}.zarr") for scene in scenes]
    done = stored_outcomes(scenes, folder)
    todo = [n for n in range(len(places)) if n not in done]
    workers, threads = pool.sizes(workers, threads, jobs=len(todo), words="--threads")
    pool.check(workers, threads)
    return itertools.chain(done.items(), _run(places, todo, workers, threads, _KindsOnce(progress_of(progress)), Path(folder)))


def stored_outcomes(scenes, folder):
    """{number of a scene: its Outcome} in the finished stores of `folder`. Raises StoreError for a store of another scene."""
    places = enumerate((scene, Path(folder) / f"{scene.name}.zarr") for scene in scenes)
    return {n: outcome for n, place in places if (outcome := _stored_outcome(*place))}


def _stored_outcome(scene, path):
    """Outcome in a finished store, None if the scene has to run. Raises StoreError."""
    if not os.path.exists(path):
        return None
    stored = single_run.open(path)
    check_version(path, stored)
    if stored.scene != scene:
        raise StoreError(f"{path} holds another scene ({stored.scene.name} with other values); choose another folder")
    return Outcome(path, stored.store.summary) if stored.finished else None


def _run(places, todo, workers, threads, progress, folder):
    """Generator of the results of :func:`summaries` for the scenes that have to run."""
    alone, count = workers == 1, len(places)
    jobs = (case.CaseJob(places[n][0], str(places[n][1].absolute()), threads, shared=not alone) for n in todo)
    clock = passages_left.PassagesLeft([places[n] for n in todo], progress.say)
    work = _LocalWork(progress, len(todo), clock) if alone else case.run_case
    if not alone:
        progress.say(f"{number_of(len(todo), 'position')} on {number_of(workers, 'worker')}")
    for sentence in passages_left.announced([places[n][0] for n in todo]):
        progress.say(sentence)
    found = pool.results(work, jobs, workers=workers, tick=clock.tick)
    with pool.ended(found, folder):
        for ended, (place, answer) in enumerate(found, count - len(todo)):
            n = todo[place]
            scene, path = places[n]
            outcome = _outcome(path, answer)
            if not alone:
                _report(progress, scene, outcome, f"{ended + 1} of {count}")
            progress.stage(STAGE, ended + 1, count)
            yield n, outcome
    progress.stage(STAGE, count, count)


def _outcome(path, answer):
    if isinstance(answer, pool.LostJob):
        return Outcome(path, reason=answer.reason)
    return Outcome(path, answer["summary"], answer["reason"])


def _report(progress, scene, outcome, which):
    """Report texts that another process could not print."""
    progress.say(f"{which}: {scene.name}: {outcome.reason or 'done'}")
    for sentence in scene.warnings():
        progress.warn_at(scene.name, sentence)


class _LocalWork:
    """Job function for this process; it passes the progress of each run to the listener."""

    def __init__(self, progress, count, clock):
        self.progress, self.count, self.clock, self.n = progress, count, clock, 0

    def __call__(self, job):
        self.n += 1
        left = self.clock.left()
        self.progress.say(f"{self.n} of {self.count}: {job.scene.name}{f'; {left}' if left else ''}")
        return case.run_case(job, _NamedProgress(self.progress, job.scene.name))


class _Forwarded(Progress):
    """Progress that passes on stages and steps to a listener."""

    def __init__(self, listener):
        self.listener = listener

    def step(self, snapshot):
        self.listener.step(snapshot)

    def stage(self, name, done, total):
        self.listener.stage(name, done, total)


class _KindsOnce(_Forwarded):
    """Progress of a flank: passes on the warnings of each kind once, those of the first position that has the kind."""

    def __init__(self, listener):
        super().__init__(listener)
        self.warned, self.kinds = set(), {}

    def say(self, text):
        self.listener.say(text)

    def warn(self, sentence):
        self.listener.warn(sentence)

    def warn_at(self, name, sentence):
        """Pass on a warning of the run called `name`."""
        kind = self.kinds.setdefault(name, Kinds()).of(sentence)
        if kind not in self.warned:
            self.warned.add(kind)
            self.listener.warn(f"{name}: {sentence}")


class _NamedProgress(_Forwarded):
    """Progress of one of many runs: passes on its warnings with its name."""

    def __init__(self, listener, name):
        super().__init__(listener)
        self.name = name

    def warn(self, sentence):
        self.listener.warn_at(self.name, sentence)
