"""Workers on this machine: processes that receive jobs through pipes. No port is opened, so no other program can send a job.

A job whose worker died is given once to a new worker; a worker that exceeds its share of the memory is ended.
"""

import contextlib
import multiprocessing
import os
import signal
import sys
import threading
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any

from tehl_taichi.disk import memory_limit
from tehl_taichi.engine import runtime
from tehl_taichi.errors import RuntimeUnavailable
from tehl_taichi.runs.sweep.job import DIED, failed, in_one_thread

SHARE = 0.95  # of the part of a worker in the memory that is available
PAUSE = 1.0  # s between two looks at that
TRIES = 2
READY = "ready"  # first message of a worker, which has imported what it needs
GUARD = 'imports the script that started it, whose calls belong below `if __name__ == "__main__":`; or use --workers 1'
COMPUTES, FAILS = f"workers cannot start: each {GUARD}", f"a worker cannot start, for the reason above; it {GUARD}"


def results(work, jobs, workers, tick=None):
    """Run jobs: see :func:`tehl_taichi.runs.sweep.pool.results`. Raises RuntimeUnavailable if no worker can start."""
    runtime.cache_dir()  # else each worker would borrow its own, and leave it behind
    crew = LocalWorkers(workers, tick or (lambda: None))
    try:
        yield from crew.results(work, iter(enumerate(jobs)))
        crew.leave()
    finally:
        crew.stop()


class LocalWorkers:
    """A number of workers, started when jobs are waiting; tick: called between two looks at them."""

    def __init__(self, count, tick=lambda: None):
        self.tick, self.count, self.room, self.busy, self.idle = tick, count, SHARE * memory_limit.available() / count, {}, []

    def results(self, work, waiting):
        """Generator of (number of the job, its answer) in order of completion."""
        self._hand_out(work, waiting)
        while self.busy:
            for pipe in wait(list(self.busy), PAUSE):
                if found := self._heard(pipe, work):
                    self._hand_out(work, waiting)
                    yield found
            self._end_the_greedy()
            self.tick()

    def _heard(self, pipe, work):
        """(number of the job, its answer) of the worker at a pipe; None while it is computed, there or by a new worker."""
        worker = self.busy.pop(pipe)
        number, job = worker.job
        if (answer := worker.answer()) == READY:
            self.busy[pipe] = worker
            return None
        if answer is not None:
            self.idle.append(worker)
            return number, answer
        if code := worker.own_end:
            raise RuntimeUnavailable(COMPUTES if code == runtime.IMPORTED else FAILS)
        if worker.tries < TRIES:
            self._give(Worker(), work, number, job, worker.tries + 1)
            return None
        return number, DIED

    def _hand_out(self, work, waiting):
        while len(self.busy) < self.count and (job := next(waiting, None)):
            self._give(self.idle.pop() if self.idle else Worker(), work, *job)

    def _give(self, worker, work, number, job, tries=1):
        worker.give(work, number, job, tries)
        self.busy[worker.pipe] = worker

    def _end_the_greedy(self):
        for worker in self.busy.values():
            if worker.memory() > self.room:
                worker.process.kill()

    def leave(self):
        """Let the workers end by themselves, so that Taichi stores its compiled kernels."""
        for worker in self.idle:
            worker.pipe.close()
        for worker in self.idle:
            worker.process.join(10)

    def stop(self):
        """End all workers at once."""
        for worker in (*self.busy.values(), *self.idle):
            if worker.process.is_alive():
                worker.process.terminate()
        for worker in (*self.busy.values(), *self.idle):
            worker.process.join()


class Worker:
    """A process, its pipe and its current job."""

    job: tuple[int, Any]
    tries: int
    ready = False

    def __init__(self):
        context = multiprocessing.get_context("spawn")  # a forked one would have Taichi, but none of its threads
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=_serve, args=(theirs,), daemon=True, name=runtime.WORKER)
        with _without_missing_script():
            self.process.start()
        theirs.close()

    def give(self, work, number, job, tries):
        """Send a job; for a dead worker :meth:`answer` gives None."""
        self.job, self.tries = (number, job), tries
        with contextlib.suppress(OSError):
            self.pipe.send((work, job))

    def answer(self):
        """Result of its job: the answer, a :class:`LostJob`, or None if the process died; before that READY, once."""
        try:
            answer = self.pipe.recv()
            self.ready = self.ready or answer == READY
            return answer
        except (EOFError, OSError):
            self.process.join()
            return None

    @property
    def own_end(self):
        """Exit code of a process that ended by itself before it was ready, else 0 (a signal has a negative code)."""
        return 0 if self.ready else max(self.process.exitcode or 0, 0)

    def memory(self):
        """Bytes of memory that the process uses, 0 if unknown."""
        with contextlib.suppress(OSError, ValueError):
            return int(Path(f"/proc/{self.process.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        return 0


@contextlib.contextmanager
def _without_missing_script():
    """Context manager: a script that is no file (read from stdin) has no name. A new process would import it by that name."""
    main = sys.modules["__main__"]
    name = getattr(main, "__file__", None)
    try:
        if name and not os.path.exists(name):
            main.__file__ = None
        yield
    finally:
        if name:
            main.__file__ = name


def _serve(pipe):
    """Main function of the process: job after job, until the sweep ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the sweep, which then ends its workers
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    threading.Thread(target=_end_with_the_sweep, daemon=True).start()
    with contextlib.suppress(EOFError, OSError):
        pipe.send(READY)
        while True:
            work, job = pipe.recv()
            pipe.send(_done(work, job))
    leave = getattr(sys.modules.get("tehl_taichi.engine.runtime"), "leave", None)
    if leave:
        leave(0)


def _done(work, job):
    try:
        return in_one_thread(work, job)
    except Exception as error:  # noqa: BLE001  whatever it is, the other jobs continue
        return failed(error)


def _end_with_the_sweep():
    """End together with a killed sweep; its cases resume from their stores."""
    if sweep := multiprocessing.parent_process():
        wait([sweep.sentinel])
        os._exit(1)
