"""Provenance of the numbers: code, libraries, machine, command and time."""

import functools
import importlib.metadata
import json
import platform
import shlex
import sys
from datetime import datetime, timezone
from pathlib import Path

from tehl_taichi import __version__
from tehl_taichi.commit import commit
from tehl_taichi.engine import cores, runtime
from tehl_taichi.pressure import precision

LIBRARIES = ("numpy", "pyfftw", "zarr")


def provenance(scene):
    """Attributes of a store of `scene` written by this process: version, commit, versions of Python and the libraries, machine,
    cores, command, date (UTC), precision of the linear solves, runtime (JSON: arch, threads, taichi, cache).
    """
    return {"version": __version__, "commit": commit(), **versions(), "machine": machine(), "cores": cores.available(),
            "command": shlex.join(sys.argv), "date": datetime.now(timezone.utc).isoformat(timespec="seconds"),
            "precision": precision.of(scene), "runtime": json.dumps(runtime.ensure())}


@functools.cache
def versions():
    """{name: version} of Python and of the libraries that affect numbers (taichi: see :func:`runtime.start`)."""
    return {"python": platform.python_version(), **{name: importlib.metadata.version(name) for name in LIBRARIES}}


@functools.cache
def machine():
    """Operating system, architecture and, if known, the processor."""
    return ", ".join(part for part in (platform.platform(), _processor()) if part)


def _processor():
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), "")
