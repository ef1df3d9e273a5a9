"""Floating-point mode of a thread.

Taichi's start sets its thread to flush subnormal numbers to zero, permanently. Kernels keep that mode, which their own threads
also have; the caller's mode is restored before, between and after launches.
"""

import contextlib
import ctypes
import functools

SIZE = 64  # bytes, at least those of a fenv_t: 32 on x86-64, 8 on AArch64


@functools.lru_cache(maxsize=1)
def _library():
    """fegetenv and fesetenv of the C library, as functions of a buffer; None if they do not exist."""
    with contextlib.suppress(OSError, AttributeError):
        library = ctypes.PyDLL("libm.so.6")  # keeps the lock of the interpreter: a call takes 0.2 us
        return library.fegetenv, library.fesetenv
    return None


def now():
    """Present mode of this thread, for :func:`back`."""
    mode = ctypes.create_string_buffer(SIZE)
    if functions := _library():
        functions[0](mode)
    return mode


def back(mode):
    """Set the mode of this thread to a result of :func:`now`."""
    if functions := _library():
        functions[1](mode)


@contextlib.contextmanager
def kept():
    """Context manager: restore the mode at the end of the block."""
    before = now()
    try:
        yield
    finally:
        back(before)


def launching(program, mode):
    """Run the kernels of Taichi's `program` in this mode, and restore the caller's mode after every launch."""
    functions, kind = _library(), type(program)
    if not functions or hasattr(kind.launch_kernel, "plain"):
        return
    (get, set_), plain = functions, kind.launch_kernel
    before = ctypes.create_string_buffer(SIZE)  # Taichi belongs to one thread

    def launch_kernel(self, *args):
        get(before)
        set_(mode)
        try:
            return plain(self, *args)
        finally:
            set_(before)

    launch_kernel.plain = plain
    kind.launch_kernel = launch_kernel
