"""A job of :mod:`tehl_taichi.runs.sweep.pool` in its process, and the result of a lost job."""

import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass


@dataclass(frozen=True)
class LostJob:
    """Result of a job that raised, or whose worker died twice. reason: a sentence."""

    reason: str


DIED = LostJob("its worker died, also at the second attempt (killed, or out of memory)")


def failed(error):
    """The LostJob of a job that raised an error."""
    return LostJob(f"{type(error).__name__}: {error}")


_lane: list[ThreadPoolExecutor] = []
_guard = threading.Lock()


def is_worker():
    """Whether this process is a worker of a study."""
    return bool(_lane)


def in_one_thread(work, job):
    """Run work(job) in the thread of this process in which Taichi runs, whichever thread calls."""
    with _guard:
        if not _lane:
            _lane.append(ThreadPoolExecutor(1, thread_name_prefix="tehl"))
    return _lane[0].submit(work, job).result()
