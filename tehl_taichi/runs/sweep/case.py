"""One case of a sweep, as a worker runs it: into its store, resumed if an earlier attempt stopped; gives a record."""

import contextlib
import socket
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

from tehl_taichi.disk.drafts import PART, staging_path
from tehl_taichi.disk.links import is_folder
from tehl_taichi.disk.locks import LOCK, lock_content
from tehl_taichi.errors import Error, NotConverged, are_options_typed, typed_options
from tehl_taichi.runs import single_run
from tehl_taichi.runs.sweep import warm_cache
from tehl_taichi.scene import Scene


@dataclass(frozen=True)
class CaseJob:
    """scene: of the case; store: path of its store, None to keep only its summary; threads: of the engine (None: those of a
    running engine, otherwise all); shared: other workers of this machine need the same kernels; typed: see
    :func:`tehl_taichi.errors.typed_options`.
    """

    scene: Scene
    store: str | None
    threads: int | None = None
    shared: bool = False
    typed: bool = field(default_factory=are_options_typed)


def run_case(job, progress=None):
    """Run a case: {"status", "reason", "summary", "seconds"}; errors of the disk or the machine give a failed case.

    progress: listener of the run, a :class:`tehl_taichi.runs.progress.Progress`.
    """
    began = time.perf_counter()
    status, reason, summary = "converged", "", None
    try:
        with typed_options(job.typed):
            summary = _summary(job, progress)
    except NotConverged as error:
        status, reason = "not converged", str(error)
    except Exception as error:  # noqa: BLE001  whatever it is, the other cases continue
        status, reason = "failed", str(error) if isinstance(error, Error) else f"{type(error).__name__}: {error}"
    return {"status": status, "reason": reason, "summary": summary, "seconds": time.perf_counter() - began}


def _summary(job, progress):
    if job.shared:
        warm_cache.ensure_kernels(job.scene)
    if job.store is None:
        with tempfile.TemporaryDirectory(prefix="tehl-") as folder:
            return {**_run(job, Path(folder) / "case.zarr", progress), "store": None}
    return _run(job, Path(job.store), progress)


def _run(job, path, progress):
    """Summary of the run in the store at `path`: started, resumed, or already finished."""
    _take_over_lock(path)
    return single_run.run_or_resume(job.scene, path, threads=job.threads, progress=progress).store.summary


def _take_over_lock(path):
    """Take over the lock of a worker on another machine; the worker is gone, otherwise it would still have the case."""
    for folder in (path, staging_path(path, PART)):
        content = lock_content(folder)
        if is_folder(folder) and content and content["host"] != socket.gethostname():
            with contextlib.suppress(OSError):
                (folder / LOCK).unlink()
