"""Cores available to this process, and Taichi's threads on separate cores."""

import contextlib
import functools
import math
import os
from pathlib import Path

GROUPS = Path("/sys/fs/cgroup")
OWN = Path("/proc/self/cgroup")
TASKS = Path("/proc/self/task")


def available(groups=None, own=None):
    """Number of cores that this process may use, at least 1: by its affinity, and by the quota of its control group
    (containers, batch systems).
    """
    return max(1, math.floor(min(len(allowed()), quota(groups, own))))


def allowed():
    """Cores of the process's affinity, sorted."""
    if hasattr(os, "sched_getaffinity"):
        return sorted(os.sched_getaffinity(0))
    return list(range(os.cpu_count() or 1))


def quota(groups=None, own=None):
    """Number of cores granted by the control groups of this process; infinite without a limit, or if they cannot be read."""
    return _quota(groups or GROUPS, own or OWN)


@functools.lru_cache(maxsize=1)  # each team of workers asks, and reading the files takes 0.3 ms
def _quota(groups, own):
    return min(map(_granted, _groups(groups, own)), default=math.inf)


def _groups(groups, own):
    """Folders of its control groups and of their parents, for both versions of control groups."""
    with contextlib.suppress(OSError):
        for line in own.read_text().splitlines():
            _, controllers, path = line.split(":", 2)
            if controllers in ("", "cpu", "cpu,cpuacct"):
                top = groups / controllers
                inner = top / path.lstrip("/")
                yield from {top, inner, *(folder for folder in inner.parents if folder.is_relative_to(top))}


def _granted(folder):
    with contextlib.suppress(OSError, ValueError, ZeroDivisionError):
        share, period = (folder / "cpu.max").read_text().split()
        return math.inf if share == "max" else int(share) / int(period)
    with contextlib.suppress(OSError, ValueError, ZeroDivisionError):
        share, period = (int((folder / f"cpu.cfs_{what}_us").read_text()) for what in ("quota", "period"))
        return math.inf if share <= 0 else share / period
    return math.inf


@contextlib.contextmanager
def pinned(threads):
    """Context manager: give each of the last `threads` threads started inside (Taichi's pool; earlier ones compile) its own
    core, if they use all cores of this process.

    Otherwise a thread often wakes on the core of another and waits for it. With fewer threads than cores they stay free, so
    that several runs spread over the cores.
    """
    cores, before = allowed(), _running()
    yield
    new = sorted(_running() - before)[-threads:]
    if threads > 1 and threads == len(cores) == len(new):
        for thread, core in zip(new, cores):
            with contextlib.suppress(OSError):
                os.sched_setaffinity(thread, {core})


def _running():
    with contextlib.suppress(OSError):
        return {int(task.name) for task in TASKS.iterdir()}
    return set()
