"""Compiled kernels on disk while the process that compiled them goes on, so that the commands that tests start find them."""

import os
import signal
import sys

WORTH = 0.3  # s of compilation; what is on disk already is looked at again in 0.05 s
LONGEST = 30  # s
_written = 0.0


def write():
    """Taichi writes them where a program ends: that of a copy of this process ends here."""
    global _written
    compiled = _compiled()
    if compiled - _written < WORTH:
        return
    _written = compiled
    copy = os.fork()
    if not copy:
        _end()
    os.waitpid(copy, 0)


def _compiled():
    """Seconds of compilation of this process."""
    runtime = sys.modules.get("tehl_taichi.engine.runtime")
    if runtime is None or not runtime._started:
        return 0.0
    from taichi.lang import impl

    return impl.get_runtime().prog.get_total_compilation_time()


def _end():
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.alarm(LONGEST)
    try:
        from taichi.lang import impl

        impl.get_runtime().prog.finalize()
    finally:
        os._exit(0)
