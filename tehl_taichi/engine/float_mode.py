"""The floating-point mode of a thread.

Taichi's start flushes the subnormal numbers of its thread to zero, for good. Kernels keep that mode, which their own threads
have, too; that of the caller is as it was before, between and behind launches.
"""

import contextlib
import ctypes
import functools

SIZE = 64  # bytes, at least those of a fenv_t: 32 on x86-64, 8 on AArch64


@functools.lru_cache(maxsize=1)
def _library():
    """fegetenv and fesetenv of the C library, as functions of a buffer; None where there are none."""
    with contextlib.suppress(OSError, AttributeError):
        library = ctypes.PyDLL("libm.so.6")  # keeps the lock of the interpreter: a call takes 0.2 us
        return library.fegetenv, library.fesetenv
    return None


def now():
    """The mode of this thread, for :func:`back`."""
    mode = ctypes.create_string_buffer(SIZE)
    if functions := _library():
        functions[0](mode)
    return mode


def back(mode):
    """Give this thread the mode of :func:`now`."""
    if functions := _library():
        functions[1](mode)


@contextlib.contextmanager
def kept():
    """Inside, the mode may become another one."""
    before = now()
    try:
        yield
    finally:
        back(before)


def launching(program, mode):
    """Let the kernels of Taichi's `program` run in that mode, and every launch of theirs end in the mode that it began in."""
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
