"""Parallel jobs: each result is returned as soon as it is known.

A single worker is this process. Several are local processes (:mod:`tehl_taichi.runs.sweep.local_workers`) or a Dask cluster
(:mod:`tehl_taichi.runs.sweep.dask_cluster`).
"""

import contextlib

from tehl_taichi.disk.drafts import clean
from tehl_taichi.engine import cores, runtime
from tehl_taichi.errors import SceneError
from tehl_taichi.runs.sweep import dask_cluster
from tehl_taichi.runs.sweep.job import LostJob
from tehl_taichi.values.checks import integer
from tehl_taichi.values.coerce import plain

__all__ = ["LostJob", "check", "ended", "results", "sizes"]
MOST = 1024  # processes, and threads of one


def results(work, jobs, *, workers=1, scheduler=None, say_line=None, tick=None):
    """Generator of (number of the job, work(job) or LostJob), in order of completion.

    work: a function that other processes can import; it starts the engine itself. jobs: an iterable, read as workers become
    free. workers: number of processes; 1 is this process, None uses `scheduler` (its address, or a distributed.Client).
    say_line: called with sentences; tick: called every second while local processes work. Raises RuntimeUnavailable if a
    scheduler is named and Dask is not installed, StoreError if no scheduler answers.
    """
    if workers == 1:
        yield from ((number, work(job)) for number, job in enumerate(jobs))
        return
    if workers:
        from tehl_taichi.runs.sweep import local_workers

        yield from local_workers.results(work, jobs, workers, tick)
        return
    yield from dask_cluster.results(work, jobs, scheduler, say_line or (lambda sentence: None))


@contextlib.contextmanager
def ended(found, folder):
    """Context manager of :func:`results`: at its end the workers have ended, and `folder` has no drafts of theirs."""
    try:
        with contextlib.closing(found):
            yield
    finally:
        clean(folder)


def sizes(workers=None, threads=None, scheduler=None, jobs=MOST, words="--threads-per-worker"):
    """(processes, threads of each). Raises SceneError.

    Default: one thread on every core, or as many as fit the given number. (1, None): this process as it was started; (None,
    threads): a running scheduler. Never more processes than jobs. words: option of the threads.
    """
    if workers is not None and scheduler is not None:
        raise SceneError(f"--workers {workers} and --scheduler contradict each other; a running cluster has its own workers")
    check_numbers(workers, threads, words)
    if scheduler is not None:
        return None, threads or 1
    if workers is None:
        workers = max(1, min(jobs, cores.available() // (threads or 1)))
        return workers, threads or (1 if workers > 1 else None)
    workers = min(workers, max(1, jobs))
    return workers, threads or (max(1, cores.available() // workers) if workers > 1 else None)


def check_numbers(workers, threads, words):
    """Refuse numbers of processes and threads that no machine has. Raises SceneError."""
    for name, number in (("--workers", workers), (words, threads)):
        if number is not None:
            integer(name, plain(number), 1, MOST)


def check(workers, threads, scheduler=None):
    """Raise the errors that :func:`results` would raise before its first job, including those of jobs in this process."""
    runtime.end_if_importing()
    if scheduler is not None:
        dask_cluster.check(scheduler)
    elif workers == 1:
        runtime.check(threads=threads)
