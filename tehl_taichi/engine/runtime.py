"""Start of Taichi, only here: architecture and threads, once per process."""

import atexit
import contextlib
import ctypes
import functools
import numbers
import os
import shutil
import sys
import tempfile
import threading
import warnings
from pathlib import Path

from tehl_taichi import __version__
from tehl_taichi.engine import allocator, cores, float_mode, user_folders
from tehl_taichi.errors import RuntimeUnavailable, brief

ARCHES = ("cpu", "cuda", "vulkan")  # that the kernels have been checked on
DRIVER = "libcuda.so.1"
MOST_THREADS = 1024
WORKER, IMPORTED = "tehl worker", 97  # name of its process, exit code of :func:`end_if_importing`
_started = {}
_starting = threading.RLock()  # Taichi's own start is not safe in two threads at once
_home = None  # (process, thread) that Taichi was started in
WORTH_THREADS = 2500
_grown = 1


def preferred_cache():
    """Preferred folder of compiled kernels (`TEHL_CACHE`, else below `XDG_CACHE_HOME` or `~/.cache`).

    It is private to this project and version, because one start option below is not part of Taichi's cache key.
    """
    root = os.environ.get("XDG_CACHE_HOME") or os.path.join(user_folders.home(), ".cache")
    return Path(os.environ.get("TEHL_CACHE") or os.path.join(root, "tehl_taichi")) / f"kernels-{__version__}"


def has_kernels():
    """Whether an earlier process of this version has stored compiled kernels."""
    return any(preferred_cache().glob("*.tic"))


@functools.lru_cache(maxsize=1)
def cache_dir():
    """Writable folder of compiled kernels: the preferred one, or, with a warning, one for this process and those that it
    starts, with a copy of its contents (Taichi crashes at the end of the process if it cannot write its kernels).
    """
    requested = preferred_cache()
    try:
        requested.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=requested):
            return requested
    except OSError as error:
        warnings.warn(f"compiled kernels cannot be kept in "
                      f"{requested} ({error.strerror}), so every run compiles them again; set "
                      "TEHL_CACHE to a writable folder", RuntimeWarning, stacklevel=2)
        return _borrowed(requested)


def _borrowed(requested):
    """Folder with a copy of the readable kernels, for this process, which removes it, and those that it starts."""
    root = tempfile.mkdtemp(prefix="tehl-", dir=user_folders.temporary())
    atexit.register(_give_up, root)
    os.environ["TEHL_CACHE"] = root
    (folder := preferred_cache()).mkdir()
    with contextlib.suppress(OSError):
        for file in requested.iterdir():
            shutil.copyfile(file, folder / file.name)  # without its mode
    return folder


def _give_up(folder):
    if _started:
        from tehl_taichi.engine.language import ti

        ti.reset()  # it writes what it compiled
    shutil.rmtree(folder, ignore_errors=True)


def chosen(arch=None):
    """Architecture: the given one, else that of an earlier start, else the environment variable TEHL_ARCH, else "cpu"."""
    return arch or _started.get("arch") or os.environ.get("TEHL_ARCH") or "cpu"


def check(arch=None, threads=None):
    """Refuse an architecture or number of threads that this machine or process cannot have, without starting anything. Raises
    RuntimeUnavailable.
    """
    end_if_importing()
    arch = chosen(arch)
    if arch not in ARCHES:
        raise RuntimeUnavailable(f"arch = {arch!r} is not available; allowed: {', '.join(ARCHES)}")
    if arch == "cuda":
        _driven()
    check_number(threads)
    if _started and threads is not None:
        _same_start(arch, int(threads))


def check_number(threads):
    """Refuse a number of threads that no machine has, also where nothing is left to compute. Raises RuntimeUnavailable."""
    if threads is not None and (isinstance(threads, bool) or not isinstance(threads, numbers.Integral)):
        raise RuntimeUnavailable(f"threads = {threads!r} is not a whole number; allowed: 1 to {MOST_THREADS}")
    if threads is not None and not 1 <= threads <= MOST_THREADS:
        raise RuntimeUnavailable(f"threads = {threads!r} is out of range; allowed: 1 to {MOST_THREADS}")


def _driven():
    """Refuse a missing graphics card: Taichi would silently use the cores."""
    try:
        ctypes.CDLL(DRIVER)
    except OSError:
        raise RuntimeUnavailable(f"arch = 'cuda' is not available: no driver of a graphics card ({DRIVER}) was found; use "
                                 "'cpu'") from None


def start(arch=None, threads=None):
    """Start Taichi. Returns a dict with the actual arch, threads, taichi (version) and cache (folder).

    arch: "cpu", or "cuda" or "vulkan" (experimental: docs/decisions/06), default see :func:`chosen`; threads: number of CPU
    threads, or None for all available cores. Raises RuntimeUnavailable if arch or threads are not available, if Taichi
    was started with others, or if it runs in another thread or in the parent of this forked process.
    """
    check(arch, threads)
    arch, threads = chosen(arch), int(threads or cores.available())
    with _starting:
        if _started:
            return _same_start(arch, threads)
        _start(arch, threads)
    return dict(_started)


def end_if_importing():
    """End this process if it is a worker that imports the user's script, whose calls would start workers of their own."""
    process = sys.modules.get("multiprocessing.process")
    own = process and process.current_process()
    if own and own.name == WORKER and getattr(own, "_inheriting", False):
        os._exit(IMPORTED)


def _start(arch, threads):
    global _home
    user_folders.temporary()  # Taichi needs one too
    cache = str(cache_dir())
    allocator.keep_freed()
    from tehl_taichi.engine.language import attempt, ti
    from tehl_taichi.engine.taichi_patches import rolled_loops

    # in a notebook prints do not go to file 1
    with _start_errors(), float_mode.kept(), _no_banner(), contextlib.redirect_stdout(None), cores.pinned(threads):
        ti.init(arch=getattr(ti, arch), default_fp=ti.f64, fast_math=False, cpu_max_num_threads=threads, log_level=ti.ERROR,
                # its own optimisation passes take 40 s for the Findley search (2 s without) and gain nothing over LLVM's
                advanced_optimization=False,
                # Taichi would run loops of up to 512 rows on one thread: our loops run over rows of that number
                make_cpu_multithreading_loop=False,
                offline_cache=True, offline_cache_file_path=cache)
        if ti.cfg.arch != getattr(ti, arch):
            ti.reset()
            raise RuntimeUnavailable(f"arch = {arch!r} is not available: the driver finds no graphics card")
        attempt(rolled_loops.keep_rolled)
        attempt(functools.partial(float_mode.launching, ti.lang.impl.get_runtime().prog, float_mode.now()))
    if arch != "cpu":
        warnings.warn(f"arch = {arch!r} is experimental: faster than 16 cores without temperatures from 1024x256 cells on, "
                      "slower than one core with temperatures; see docs/decisions/06-graphics-cards.md",
                      RuntimeWarning, stacklevel=2)
    _started.update(arch=arch, threads=threads, taichi=".".join(map(str, ti.__version__)), cache=cache)
    _home = os.getpid(), threading.get_ident()


@contextlib.contextmanager
def _start_errors():
    """Context manager: Taichi's own errors, as without its GB of address space (`ulimit -v`), become a RuntimeUnavailable."""
    try:
        yield
    except RuntimeUnavailable:
        raise
    except RuntimeError as error:
        raise RuntimeUnavailable(f"Taichi does not start: {brief(error).rstrip('.')}; it needs more than 1 GB of address space "
                                 "(`ulimit -v`)") from None


def ensure():
    """Start with the defaults unless Taichi is running. Raises RuntimeUnavailable."""
    if not _started:
        return start()
    _check_home()
    return dict(_started)


def start_or_join(arch=None, threads=None):
    """Start as :func:`start`; threads=None: those of an earlier start, if any."""
    return start(arch, threads if threads is not None or not _started else _started["threads"])


def _check_home():
    """Refuse another thread or a forked process: Taichi extends its program only in the thread that started it, and a fork has
    none of its threads.
    """
    process, thread = _home
    if os.getpid() != process:
        raise RuntimeUnavailable("Taichi was started before this process was forked and would block; use "
                                 "multiprocessing.get_context('spawn')")
    if threading.get_ident() != thread:
        raise RuntimeUnavailable("Taichi works only in the thread that started it; simulate in that thread, or in other "
                                 "processes (multiprocessing.get_context('spawn'))")


def leave(code):
    """End this process at once after writing its kernels: the system frees the memory faster than Taichi does (0.2 of the 3 s
    of a steady circle). Returns if nothing was started here, or if this Taichi is unknown.
    """
    if not _started or _home[0] != os.getpid():
        return
    from taichi.lang import impl

    with contextlib.suppress(AttributeError, OSError, ValueError):  # a closed stream
        impl.get_runtime().prog.finalize()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


def alone(work):
    """Whether a loop of `work` (in lane-vector copies) is faster in the calling thread.

    Starting a loop on Taichi's threads takes 20 us immediately after another one, 50 to 100 us after other work; a copy takes
    30 ns per vector.
    """
    return not by_cells() and (ensure()["threads"] == 1 or _grown * work < WORTH_THREADS)


def by_cells():
    """Whether jobs are cells (:mod:`tehl_taichi.pressure.cells`), not rows: on a graphics card, whose threads must not wait for
    each other, and on the cores if the environment variable TEHL_CELLS is 1."""
    return ensure()["arch"] != "cpu" or os.environ.get("TEHL_CELLS") == "1"


@contextlib.contextmanager
def grown(times):
    """Context manager: treat loops as if they had `times` their work, so that existing kernels are used."""
    global _grown
    before, _grown = _grown, times
    try:
        yield
    finally:
        _grown = before


def _same_start(arch, threads):
    _check_home()
    requested = dict(arch=arch, threads=threads)
    if any(_started[key] != value for key, value in requested.items()):
        count = _started["threads"]
        raise RuntimeUnavailable(f"this process already runs with {_started['arch']}, {count} thread{'s' * (count != 1)}; "
                                 "start a new process for other settings")
    return dict(_started)


class _no_banner:
    """Suppresses Taichi's banner on stdout, which must stay clean for `--json`; errors are exceptions."""

    def __enter__(self):
        sys.stdout.flush()
        self.saved, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.close(nowhere)

    def __exit__(self, *_):
        sys.stdout.flush()
        os.dup2(self.saved, 1)
        os.close(self.saved)
