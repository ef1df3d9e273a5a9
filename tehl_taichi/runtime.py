"""The only place that starts Taichi: architecture, precision and threads, once per process."""

import functools
import gc
import os
import sys
import time
import weakref
from pathlib import Path

import numpy as np

from tehl_taichi import __version__

ARCHES = ("cpu",)  # that the kernels have been checked on
PRECISIONS = ("f64", "f32")  # of the linear solves; the state and its residual are always f64
_defined = None  # precision that the kernels were defined with
_started = {}
_tables = []  # [field, weak reference to its owner]
WORTH_THREADS = 2500
SMALLEST_TABLE = 5000  # columns; sizes grow by factors of 4, because every size of a field compiles its kernels anew


class RuntimeUnavailable(RuntimeError):
    """The requested architecture or precision cannot be had in this process."""


def cache_dir():
    """Folder of compiled kernels (`TEHL_CACHE`, else below `XDG_CACHE_HOME` or `~/.cache`).

    It is private to this project and version, because one start option below is not part of Taichi's cache key.
    """
    root = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    return Path(os.environ.get("TEHL_CACHE") or os.path.join(root, "tehl_taichi")) / f"kernels-{__version__}"


def start(arch="cpu", threads=None, precision=None):
    """Start Taichi and say what was really started.

    arch: "cpu" (others when their kernels are checked); threads: number of CPU threads or None for all;
    precision: "f64" (default) or "f32", of the linear solves inside Newton's iteration (the state, its laws and its
    residual are always f64: the answers differ by less than the solver's tolerance; see :mod:`tehl_taichi.precision`).
    Returns a dict with arch, threads, precision, taichi (version) and cache (folder).
    Raises RuntimeUnavailable when the arch or precision cannot be had or another start is already active.
    """
    precision = precision or PRECISIONS[0]
    _check(arch, precision)
    threads = int(threads or os.cpu_count() or 1)
    if _started:
        return _same_start(arch, threads, precision)
    import taichi as ti

    with _no_banner():
        ti.init(arch=ti.cpu, default_fp=ti.f64, fast_math=False, cpu_max_num_threads=threads, log_level=ti.ERROR,
                # its own optimisation passes take 40 s for the Findley search (2 s without) and gain nothing over LLVM's
                advanced_optimization=False,
                # Taichi would run loops of up to 512 rows on one thread: our loops run over rows of that number
                make_cpu_multithreading_loop=False,
                offline_cache=True, offline_cache_file_path=str(cache_dir()))
    _trace_without_positions()
    _started.update(arch=arch, threads=threads, precision=precision, taichi=".".join(map(str, ti.__version__)),
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


def precision():
    """Precision of the linear solves, "f64" or "f32", which the kernels are defined with once and for all."""
    global _defined
    _defined = _defined or _started.get("precision", PRECISIONS[0])
    return _defined


def ensure(precision=None):
    """Start with the defaults, or with this precision, unless something is running already."""
    return dict(_started) if _started else start(precision=precision)


def alone(work):
    """Whether a loop of `work` (in units of the lane vectors that a copy moves) is better run by the calling thread.

    To hand a loop to Taichi's threads takes 20 us at once and 50 to 100 us after some work outside, a copy 30 ns a vector.
    """
    return ensure()["threads"] == 1 or work < WORTH_THREADS


def lease(owner, rows, lanes, columns, slots=0, precision="f64"):
    """A vector field of `rows` x at least `columns` columns of `lanes` numbers, zero, for `owner` alone while it lives; with
    `slots` (and rows 0) of at least `columns` columns x `slots`.

    Fields are never freed by Taichi and a new one compiles its kernels anew, so that of a former owner is used again.
    """
    wanted = (lanes, precision), (rows, columns, slots)
    entry = _free_table(*wanted)
    if entry is None:
        gc.collect()  # 28 ms; an owner that is only held by a reference cycle is gone then
        entry = _free_table(*wanted)
    if entry is not None:
        field, entry[1] = entry[0], weakref.ref(owner)
        field.fill(0.0)
        return field
    import taichi as ti

    capacity = SMALLEST_TABLE
    while capacity < columns:
        capacity *= 4
    field = ti.Vector.field(lanes, getattr(ti, precision), shape=(capacity, slots) if slots else (rows, capacity))
    _tables.append([field, weakref.ref(owner)])
    return field


def _free_table(kind, size):
    for entry in _tables:
        field, holder = entry
        if holder() is None and (field.n, str(field.dtype)) == kind and _fits(field.shape, *size):
            return entry
    return None


def _fits(shape, rows, columns, slots):
    return shape[0] >= columns and shape[1] == slots if slots else shape[0] == rows and shape[1] >= columns


def bind(kernel, *args):
    """A launch of `kernel` with these very arguments, to be called without any, as often as wanted.

    Arrays are bound by address: they must stay alive (they are held here) and their contents may change. Taichi's own
    call inspects every argument anew, some 40 us an array, more than most kernels run; here the argument record is made
    once. Where the pinned Taichi's internals are not found, the launch falls back to the plain call.
    """
    global _binding
    started = time.perf_counter()
    try:
        launch = _recorded(kernel, args)
    except (AttributeError, TypeError):
        launch = functools.partial(kernel, *args)
    _binding += time.perf_counter() - started
    return launch if _watched is None else _timed(kernel, args, launch)


class Carriers:
    """Launches that copy between a field and an array, bound at their first use (an unbound one costs 40 us an array)."""

    def __init__(self):
        self.bound = {}

    def carry(self, key, shape, make_launch, values=None):
        """Fill the array of `key` with `values`, if any, and launch. Returns that array: a buffer.

        make_launch(array) is asked for the launch at the first use of the key.
        """
        if key not in self.bound:
            array = np.empty(shape)
            self.bound[key] = array, make_launch(array)
        array, launch = self.bound[key]
        if values is not None:
            array[:] = values
        launch()
        return array


_binding = 0.0  # s spent in `bind`


def binding_seconds():
    """Time (s) spent so far on tracing and compiling bound kernels, or on finding them in the cache."""
    return _binding


_watched = None  # {kernel: [launches, seconds, bytes]} once somebody wants to know
_bytes_of = None


def watch_launches(bytes_of):
    """The dictionary {kernel: [launches, seconds, bytes]} that all launches bound from now on are counted in.

    bytes_of(kernel, args): bytes that one launch moves.
    """
    global _watched, _bytes_of
    _watched, _bytes_of = {}, bytes_of
    return _watched


def _timed(kernel, args, launch):
    moved = _bytes_of(kernel, args)

    def counted():
        started = time.perf_counter()
        launch()
        entry = _watched.setdefault(kernel.__name__, [0, 0.0, 0])
        entry[0] += 1
        entry[1] += time.perf_counter() - started
        entry[2] += moved

    return counted


def _recorded(kernel, args):
    from taichi.lang import impl
    from taichi.types.annotations import template

    primal = kernel._primal
    compiled = primal.compiled_kernels[primal.ensure_compiled(*args)]
    record = compiled.make_launch_context()
    slot = 0
    for argument, value in zip(primal.arguments, args):
        if isinstance(argument.annotation, template):
            continue
        _set(record, (slot,), value, argument.annotation)
        slot += 1
    program = impl.get_runtime().prog
    code = program.compile_kernel(program.config(), program.get_device_caps(), compiled)

    def launch(held=args):
        program.launch_kernel(code, record)

    return launch


def _set(record, slot, value, annotation):
    if isinstance(value, np.ndarray):
        if not value.flags.c_contiguous:
            raise ValueError("bound arrays must be contiguous")
        shape = value.shape[: annotation.ndim]  # without the lanes
        record.set_arg_external_array_with_shape(slot, int(value.ctypes.data), value.nbytes, shape, 0)
    elif isinstance(value, int):
        record.set_arg_int(slot, value)
    else:
        record.set_arg_float(slot, float(value))


def _check(arch, precision):
    if arch not in ARCHES:
        raise RuntimeUnavailable(f"arch = {arch!r} is not available in this version: {', '.join(map(repr, ARCHES))} is")
    if precision not in PRECISIONS:
        raise RuntimeUnavailable(f"precision = {precision!r} is not known: 'f64' and 'f32' are")
    if _defined not in (None, precision):
        raise RuntimeUnavailable(f"the kernels of this process are defined for precision = {_defined!r}; start a new one")


def _same_start(arch, threads, precision):
    wanted = dict(arch=arch, threads=threads, precision=precision)
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
