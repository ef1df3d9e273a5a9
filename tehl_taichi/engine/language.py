"""Taichi, as every module takes it: `from tehl_taichi.engine.language import ti`. Another engine of the same language is named
here and in :mod:`launches`, nowhere else.

Taichi asks Python again and again for what does not change, a third of the start of a run; here it asks once. Measured with
kernels that are cached, CPU s of a coarse run (64x16): the class that a function stands in, looked for in the source at every
decorator, 1.3 -> 0; the source of a function, read and cut into lines at every call in a kernel, 0.6 -> 0.1, parsed, 0.3 -> 0;
the position of every node (Findley search alone 2.9 -> 1.2), for messages that only developers see: TEHL_DEBUG=1 keeps it.
"""

import ast
import contextlib
import copy
import functools
import inspect
import linecache
import os
import sys
from types import SimpleNamespace


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


_parse = functools.cache(ast.parse)


def _parsed(source):
    """The tree of a function, its body shared with those parsed before; Taichi empties its head."""
    function, = _parse(source).body
    head = ast.FunctionDef(**{**vars(function), "args": copy.copy(function.args)})
    return ast.Module(body=[head], type_ignores=[])


def _ask_once():
    """Raises AttributeError or ImportError where Taichi looks otherwise than expected: then nothing is changed."""
    from taichi.lang import kernel_impl

    lines, file, cut = kernel_impl.getsourcelines, kernel_impl.getsourcefile, kernel_impl.textwrap
    kept = SimpleNamespace(fill=functools.cache(cut.fill), dedent=functools.cache(cut.dedent))
    assert callable(kernel_impl._inside_class) and kernel_impl.ast is ast
    kernel_impl.getsourcelines, kernel_impl.getsourcefile = functools.cache(lines), functools.cache(file)
    kernel_impl._inside_class, kernel_impl.textwrap = _in_class, kept
    kernel_impl.ast = SimpleNamespace(**{**vars(ast), "parse": _parsed})


def _without_positions():
    from taichi.lang.ast.ast_transformer_utils import ASTTransformerContext, Builder
    from taichi.lang.impl import PyTaichi

    assert callable(ASTTransformerContext.get_pos_info) and callable(PyTaichi.get_current_src_info)
    own = Builder.__call__

    def call(builder, context, node):
        build = getattr(builder, _name(node.__class__), None)
        return build(context, node) if build and not context.raised else own(builder, context, node)

    ASTTransformerContext.get_pos_info = lambda context, node: ""
    PyTaichi.get_current_src_info = lambda runtime: ""
    Builder.__call__ = call


@functools.cache
def _name(kind):
    """The method of Taichi's that builds nodes of this kind."""
    return "build_" + kind.__name__


def attempt(change):
    """change(), which leaves everything as it is where it raises what an unexpected Taichi gives rise to."""
    try:
        change()
    except (ImportError, AttributeError, AssertionError):  # another Taichi: slower, not broken
        pass


attempt(_ask_once)
if not os.environ.get("TEHL_DEBUG"):
    attempt(_without_positions)
