"""Taichi, as every module takes it: `from tehl_taichi.engine.language import ti`. Another engine of the same language is named
here and in `taichi_patches`, nowhere else.

Its decorators look for the class that a function stands in in the source of the module, at every one: 1.3 s of a coarse run
(64x16), none here. What else is asked again and again: :mod:`tehl_taichi.engine.taichi_patches.fast_tracing`.
"""

import contextlib
import inspect
import linecache
import os
import sys

from tehl_taichi.engine.taichi_patches import fast_tracing
from tehl_taichi.engine.user_folders import give_home

give_home()


@contextlib.contextmanager
def _line_only():
    """The line of a frame is all that a decorator wants to know; the whole source of its module is looked for."""
    known = inspect.getframeinfo
    inspect.getframeinfo = lambda f, context=1: (f.f_code.co_filename, f.f_lineno, f.f_code.co_name,
                                                 [linecache.getline(f.f_code.co_filename, f.f_lineno)], 0)
    try:
        yield
    finally:
        inspect.getframeinfo = known


with _line_only():  # decorators of its own
    import taichi as ti

__all__ = ["attempt", "ti"]


def _in_class(level_of_class_stackframe):
    """Whether the decorated function stands in a class; the level is that of the frame around it."""
    return "__qualname__" in sys._getframe(level_of_class_stackframe - 1).f_locals


def attempt(change):
    """change(), which leaves everything as it is where it raises what an unexpected Taichi gives rise to."""
    try:
        change()
    except (ImportError, AttributeError, AssertionError):  # another Taichi: slower, not broken
        pass


def _ask_less():
    """Raises AttributeError or ImportError where Taichi looks otherwise than expected: then nothing is changed."""
    from taichi.lang import kernel_impl

    assert callable(kernel_impl._inside_class)
    kernel_impl._inside_class = _in_class


attempt(_ask_less)
if ti.__version__ == fast_tracing.KNOWN and not os.environ.get("TEHL_DEBUG"):
    for change in (fast_tracing.trees, fast_tracing.nodes, fast_tracing.expressions):
        attempt(change)
