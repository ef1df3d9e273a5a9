"""The only place that starts Taichi: architecture and threads, once per process."""

import os
import sys
from pathlib import Path

from tehl_taichi import __version__
from tehl_taichi.errors import RuntimeUnavailable

ARCHES = ("cpu",)  # that the kernels have been checked on
_started = {}
WORTH_THREADS = 2500


def cache_dir():
    """Folder of compiled kernels (`TEHL_CACHE`, else below `XDG_CACHE_HOME` or `~/.cache`).

    It is private to this project and version, because one start option below is not part of Taichi's cache key.
    """
    root = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    return Path(os.environ.get("TEHL_CACHE") or os.path.join(root, "tehl_taichi")) / f"kernels-{__version__}"


def start(arch="cpu", threads=None):
    """Start Taichi and say what was really started.

    arch: "cpu" (others when their kernels are checked); threads: number of CPU threads or None for all. Returns a dict with
    arch, threads, taichi (version) and cache (folder).
    Raises RuntimeUnavailable when the arch cannot be had or another start is already active.
    """
    if arch not in ARCHES:
        raise RuntimeUnavailable(f"arch = {arch!r} is not available in this version: {', '.join(map(repr, ARCHES))} is")
    threads = int(threads or os.cpu_count() or 1)
    if _started:
        return _same_start(arch, threads)
    import taichi as ti

    with _no_banner():
        ti.init(arch=ti.cpu, default_fp=ti.f64, fast_math=False, cpu_max_num_threads=threads, log_level=ti.ERROR,
                # its own optimisation passes take 40 s for the Findley search (2 s without) and gain nothing over LLVM's
                advanced_optimization=False,
                # Taichi would run loops of up to 512 rows on one thread: our loops run over rows of that number
                make_cpu_multithreading_loop=False,
                offline_cache=True, offline_cache_file_path=str(cache_dir()))
    _trace_without_positions()
    _started.update(arch=arch, threads=threads, taichi=".".join(map(str, ti.__version__)),
                    cache=str(cache_dir()))
    return dict(_started)


def _trace_without_positions():
    """Taichi notes the source line of every node it traces, half of the start of a large kernel (Findley search 2.9 s ->
    1.2 s), for messages that only developers see: TEHL_DEBUG=1 keeps them."""
    if os.environ.get("TEHL_DEBUG"):
        return
    try:
        from taichi.lang.ast.ast_transformer_utils import ASTTransformerContext

        assert callable(ASTTransformerContext.get_pos_info)
    except (ImportError, AttributeError):
        return
    ASTTransformerContext.get_pos_info = lambda context, node: ""


def ensure():
    """Start with the defaults unless something is running already."""
    return dict(_started) if _started else start()


def alone(work):
    """Whether a loop of `work` (in units of the lane vectors that a copy moves) is better run by the calling thread.

    To hand a loop to Taichi's threads takes 20 us at once and 50 to 100 us after some work outside, a copy 30 ns a vector.
    """
    return ensure()["threads"] == 1 or work < WORTH_THREADS


def _same_start(arch, threads):
    wanted = dict(arch=arch, threads=threads)
    if any(_started[key] != value for key, value in wanted.items()):
        raise RuntimeUnavailable(f"this process already runs with {_started['arch']}, {_started['threads']} threads; "
                                 "start a new process for other settings")
    return dict(_started)


class _no_banner:
    """Taichi prints a banner to stdout, which must stay clean for `--json`; failures are exceptions."""

    def __enter__(self):
        sys.stdout.flush()
        self.saved, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.close(nowhere)

    def __exit__(self, *_):
        sys.stdout.flush()
        os.dup2(self.saved, 1)
        os.close(self.saved)
