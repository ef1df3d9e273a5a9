"""Memory: amount available to this process, and a check before a large request."""

import contextlib
import math
from pathlib import Path

from tehl_taichi.errors import SceneError

INFO, STATUS, GROUPS, OWN = Path("/proc/meminfo"), Path("/proc/self/status"), Path("/sys/fs/cgroup"), Path("/proc/self/cgroup")
LIMITS = (("memory.max", "memory.current", "inactive_file"),  # of control groups, version 2 and 1
          ("memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"))
SHARE = 0.95  # of what is available: the rest of the process needs some, too


def check(needed, what, kind=SceneError):
    """Raise an error of class `kind` if `what` needs more bytes than are available."""
    there = available()
    if needed > SHARE * there:
        raise kind(f"{what} needs {words(needed)} of memory; {words(there)} are available")


def available():
    """Bytes available to this process: by the machine, its control groups and its own limits."""
    return max(0.0, min(_of_machine(), _of_groups(), *_of_process()))


def words(number):
    """A number of bytes as text."""
    for unit, size in (("TB", 1e12), ("GB", 1e9), ("MB", 1e6)):
        if number >= size:
            return f"{number / size:.3g} {unit}"
    return f"{number / 1e3:.3g} kB"


def _of_machine():
    return _table(INFO).get("MemAvailable", math.inf)


def _of_process():
    """Bytes left by the limits of `ulimit`: address space and data."""
    used = _table(STATUS)
    with contextlib.suppress(ImportError):
        import resource

        for limit, mine in ((resource.RLIMIT_AS, "VmSize"), (resource.RLIMIT_DATA, "VmData")):
            soft = resource.getrlimit(limit)[0]
            yield math.inf if soft == resource.RLIM_INFINITY else soft - used.get(mine, 0.0)
    yield math.inf


def _table(path):
    """{name: bytes} of a file with lines "name: number kB"."""
    with contextlib.suppress(OSError, ValueError):
        lines = (line.split() for line in path.read_text().splitlines())
        return {words[0].rstrip(":"): 1024.0 * float(words[1]) for words in lines if words[-1:] == ["kB"]}
    return {}


def _of_groups():
    """Bytes left by the control groups of this process and their parents (containers, batch systems)."""
    return min((_left(folder, *names) for folder in _folders() for names in LIMITS), default=math.inf)


def _folders():
    with contextlib.suppress(OSError, ValueError):
        for line in OWN.read_text().splitlines():
            _, controllers, path = line.split(":", 2)
            if controllers in ("", "memory"):
                top = GROUPS / controllers
                inner = top / path.lstrip("/")
                yield from {top, inner, *(folder for folder in inner.parents if folder.is_relative_to(top))}


def _left(folder, limit, usage, idle):
    """Bytes that a group may still take; cached files count as free."""
    with contextlib.suppress(OSError, ValueError):
        most = (folder / limit).read_text().strip()
        if most == "max" or float(most) > 2**60:
            return math.inf
        lines = dict(line.split() for line in (folder / "memory.stat").read_text().splitlines())
        return float(most) - float((folder / usage).read_text()) + float(lines.get(idle, 0))
    return math.inf
