"""Launches of kernels with fixed arguments, at a few microseconds instead of about 40 per array; and their timing."""

import contextlib
import functools
import gc
import time

import numpy as np

from tehl_taichi.engine import runtime


def bind(kernel, *args, writes=None):
    """A launch of `kernel` with these arguments, callable without any, as often as wanted.

    Arrays are bound by address: they are held here and their contents may change. Taichi's own call inspects every argument
    again, about 40 us per array, more than most kernels run; here the argument record is made once. If the internals of the
    pinned Taichi are not found, the launch is the plain call; also on a graphics card, which writes its own addresses into the
    record. If jobs are cells, small arrays stay there; writes: numbers of the arguments that the kernel fills, None: unknown.
    """
    global _binding
    started = time.perf_counter()
    try:
        with _uncollected():
            launch = _of_cells(kernel, args, writes) if runtime.by_cells() else _recorded(kernel, args)
    except (AttributeError, TypeError):
        launch = functools.partial(kernel, *args)
    _binding += time.perf_counter() - started
    return launch if _watched is None else _timed(kernel, args, launch)


def _of_cells(kernel, args, writes):
    """A launch where jobs are cells."""
    if writes is None:
        return functools.partial(kernel, *args)
    from tehl_taichi.engine import resident

    return resident.bind(kernel, args, writes)


@contextlib.contextmanager
def _uncollected():
    """Context manager: no garbage collection while a kernel is traced, which makes a hundred thousand objects: 0.2 of the 4 s
    of a start.
    """
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()


class Carriers:
    """Launches that copy between a field and an array, bound at their first use (an unbound one costs 40 us per array)."""

    def __init__(self):
        self.bound = {}

    def carry(self, key, shape, make_launch, values=None):
        """Fill the array of `key` with `values`, if any, and launch. Returns that array: a buffer.

        make_launch(array) makes the launch at the first use of the key.
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
    """Time (s) spent so far on tracing and compiling bound kernels, or loading them from the cache."""
    return _binding


_watched = None  # {kernel: [launches, seconds, bytes]} while launches are watched
_bytes_of = None


def watch_launches(bytes_of):
    """Dictionary {kernel: [launches, seconds, bytes]} that counts all launches bound from now on.

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
        record.set_arg_external_array_with_shape(slot, value.__array_interface__["data"][0], value.nbytes, shape, 0)
    elif isinstance(value, int):
        record.set_arg_int(slot, value)
    else:
        record.set_arg_float(slot, float(value))
