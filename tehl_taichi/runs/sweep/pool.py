"""Jobs in parallel: a list of jobs goes in, what became of each comes out as soon as it is known.

One worker is this process. More of them are processes of our own (:mod:`tehl_taichi.runs.sweep.local_workers`), a scheduler
somewhere else is Dask's (:mod:`tehl_taichi.runs.sweep.dask_cluster`).
"""

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.sweep.job import LostJob
from tehl_taichi.values.checks import integer
from tehl_taichi.values.coerce import plain

__all__ = ["LostJob", "check", "results", "sizes"]
MOST = 1024  # processes, and threads of one


def results(work, jobs, *, workers=1, scheduler=None, say_line=None):
    """Generator of (number of the job, work(job) or LostJob), in the order in which they end.

    work: a function that other processes can import; it starts the engine itself; jobs: an iterable, drawn from as workers
    come free; workers: processes, 1 is this one, None those of the scheduler: its address, or a distributed.Client; say_line:
    called with sentences. Raises RuntimeUnavailable where a scheduler is named and Dask is not installed, StoreError where
    none answers.
    """
    if workers == 1:
        yield from ((number, work(job)) for number, job in enumerate(jobs))
        return
    if workers:
        from tehl_taichi.runs.sweep import local_workers

        yield from local_workers.results(work, jobs, workers)
        return
    from tehl_taichi.runs.sweep import dask_cluster

    yield from dask_cluster.results(work, jobs, scheduler, say_line or (lambda sentence: None))


def sizes(workers=None, threads=None, scheduler=None, jobs=MOST):
    """(processes, threads of each): one thread on every core, or what the given number leaves of the cores; (1, None) is this
    process as it is started; (None, threads) a scheduler that runs already. No more processes than jobs. Raises SceneError."""
    from tehl_taichi.engine import cores

    if workers is not None and scheduler is not None:
        raise SceneError(f"--workers {workers} and --scheduler contradict each other; a running cluster has its own workers")
    for name, number in (("--workers", workers), ("--threads-per-worker", threads)):
        if number is not None:
            integer(name, plain(number), 1, MOST)
    if scheduler is not None:
        return None, threads or 1
    if workers is None:
        workers = max(1, min(jobs, cores.available() // (threads or 1)))
        return workers, threads or (1 if workers > 1 else None)
    workers = min(workers, max(1, jobs))
    return workers, threads or (max(1, cores.available() // workers) if workers > 1 else None)


def check(workers, threads, scheduler=None):
    """Raise what :func:`results` would raise before its first job, and what this process would at each where it does them."""
    if scheduler is not None:
        from tehl_taichi.runs.sweep import dask_cluster

        dask_cluster.check(scheduler)
    elif workers == 1:
        from tehl_taichi.engine import runtime

        runtime.check(threads=threads)
