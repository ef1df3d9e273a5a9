"""Jobs on a running Dask cluster."""

import contextlib
import itertools
import uuid
from typing import Any

from tehl_taichi.errors import RuntimeUnavailable, SceneError, StoreError, brief, extra
from tehl_taichi.runs.sweep.job import DIED, LostJob, failed, in_one_thread
from tehl_taichi.values.coerce import shown

AHEAD, LEAST = 3, 16  # jobs that the scheduler knows, for each worker and at least: memory stays bounded, no worker waits
PATIENCE = 30  # s to find a scheduler
AGAIN = ("pending", "lost")  # its worker died with an answer that was not fetched yet: another one works it out again
SETTINGS = {"distributed.comm.timeouts.connect": f"{PATIENCE}s"}


def results(work, jobs, scheduler, say_line):
    """Run jobs: see :func:`tehl_taichi.runs.sweep.pool.results`."""
    distributed = _distributed()
    with _client(distributed, scheduler) as client:
        if not client.nthreads():
            say_line("no worker is connected yet; start one (on any machine: `dask worker ADDRESS --nthreads 1`)")
        waiting, run = iter(enumerate(jobs)), uuid.uuid4().hex[:8]
        running: dict[Any, int] = {}
        ended = distributed.as_completed()

        def submit():
            room = max(LEAST, AHEAD * len(client.nthreads())) - len(running)
            for number, job in itertools.islice(waiting, max(0, room)):
                future = client.submit(in_one_thread, work, job, pure=False, key=f"tehl-{run}-{number}")
                running[future] = number
                ended.add(future)

        submit()
        for future in ended:
            if future.status in AGAIN:
                ended.add(future)
                continue
            answer = _answer(future)
            number = running.pop(future)
            future.release()
            submit()
            yield number, answer


def check(scheduler):
    """Raise the errors that :func:`results` would raise before its first job."""
    distributed = _distributed()
    if not isinstance(scheduler, str) and not callable(getattr(scheduler, "nthreads", None)):
        raise SceneError(f"--scheduler = {shown(scheduler)} is no scheduler; allowed: its address, or a distributed.Client")
    if isinstance(scheduler, str):
        _connected(distributed, scheduler).close()


def _answer(future):
    """Result of a job."""
    if future.status == "finished":
        return future.result()
    if future.status != "error":
        return LostJob("the scheduler lost this case (it was restarted or stopped)")
    error = future.exception()
    return DIED if type(error).__name__ == "KilledWorker" else failed(error)


@contextlib.contextmanager
def _client(distributed, scheduler):
    """Client of that scheduler, or the given client."""
    import dask

    if not isinstance(scheduler, str):
        yield scheduler
        return
    with dask.config.set(SETTINGS), contextlib.closing(_connected(distributed, scheduler)) as client:
        yield client


def _connected(distributed, scheduler):
    try:
        return distributed.Client(scheduler, timeout=PATIENCE)
    except Exception as error:  # whatever answers there need not be Dask, and what it says is read as lengths of messages
        raise StoreError(f"no scheduler answers at {scheduler}: {brief(error)}; `dask scheduler` starts one "
                         "and prints its address") from None


def _distributed():
    try:
        import distributed
    except ImportError:
        raise RuntimeUnavailable(f"a scheduler needs Dask: {extra('sweep')}; --workers uses processes of this machine without "
                                 "Dask") from None
    return distributed
