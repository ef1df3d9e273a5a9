"""A job of :mod:`tehl_taichi.runs.sweep.pool` where it is done, and what is left of one that was lost."""

import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass


@dataclass(frozen=True)
class LostJob:
    """Instead of an answer: the job raised, or its worker died twice over it. reason: which of them, a sentence."""

    reason: str


_lane: list[ThreadPoolExecutor] = []
_guard = threading.Lock()


def working():
    """Whether this process is a worker of a study."""
    return bool(_lane)


def in_one_thread(work, job):
    """work(job) in the one thread of this process that Taichi belongs to, whichever thread asks."""
    with _guard:
        if not _lane:
            _lane.append(ThreadPoolExecutor(1, thread_name_prefix="tehl"))
    return _lane[0].submit(work, job).result()
