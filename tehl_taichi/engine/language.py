"""Taichi for all modules: `from tehl_taichi.engine.language import ti`. Another engine with the same language would be named
here and in `taichi_patches`, nowhere else.

Taichi's decorators search the source of the module for the class of every function: 1.3 s of a coarse run (64x16), none here.
Other repeated requests: :mod:`tehl_taichi.engine.taichi_patches.fast_tracing`.
"""

import contextlib
import inspect
import linecache
import os
import sys

from tehl_taichi.engine.taichi_patches import fast_calls, fast_tracing
from tehl_taichi.engine.user_folders import give_home

give_home()


@contextlib.contextmanager
def _line_only():
    """Give Taichi's decorators only the line of a frame; otherwise they read the whole source of its module."""
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
    """Whether the decorated function is in a class; the level is that of the surrounding frame."""
    return "__qualname__" in sys._getframe(level_of_class_stackframe - 1).f_locals


def attempt(change):
    """Call change(); if it raises an error that an unexpected Taichi causes, nothing is changed."""
    try:
        change()
    except (ImportError, AttributeError, AssertionError):  # another Taichi: slower, not broken
        pass


def _ask_less():
    """Patch these requests. Raises AttributeError or ImportError, without any change, if Taichi differs from the expected
    version.
    """
    from taichi.lang import kernel_impl

    assert callable(kernel_impl._inside_class)
    kernel_impl._inside_class = _in_class


attempt(_ask_less)
if ti.__version__ == fast_tracing.KNOWN and not os.environ.get("TEHL_DEBUG"):
    for change in (fast_tracing.trees, fast_tracing.nodes, fast_tracing.expressions, fast_calls.calls):
        attempt(change)
