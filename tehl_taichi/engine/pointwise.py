"""Functions of one point for numbers, arrays and kernels, also on lanes; without taichi until a kernel uses them.

Laws are written with the functions below, which have numpy's names, and with :func:`pointwise` or :func:`unrolled`.
"""

import functools
import importlib
import inspect
import sys

import numpy as np


def in_kernel():
    """Whether Taichi is tracing a kernel."""
    impl = sys.modules.get("taichi.lang.impl")
    return impl is not None and impl.inside_kernel()


class Pointwise:
    """Callable: function(*arguments) outside of kernels; inside them the result of traced(), made once."""

    _is_taichi_function = False  # its existence marks the object as callable in kernels for Taichi

    def __init__(self, function, traced):
        functools.update_wrapper(self, function)
        self.function, self.traced = function, functools.cache(traced)

    def __call__(self, *arguments):
        return (self.traced() if in_kernel() else self.function)(*arguments)


def pointwise(function):
    """Decorator for functions that Taichi compiles: plain arithmetic, the functions below and other laws; no loops and no
    choices.

    The first argument carries the numbers of the law: they become constants of the kernel.
    """
    return Pointwise(function, lambda: _compiled(function))


def unrolled(function):
    """Decorator for functions that Python runs while a kernel is traced, for loops over constants and for choices between
    laws.
    """
    return Pointwise(function, lambda: function)


def _compiled(function):
    from tehl_taichi.engine.language import ti

    first = next(iter(inspect.signature(function).parameters))
    function.__annotations__[first] = ti.template()
    return ti.func(function)


def _elementary(by_numpy, name, module="taichi"):
    return Pointwise(by_numpy, lambda: getattr(importlib.import_module(module), name))


exp = _elementary(np.exp, "exp", "tehl_taichi.engine.elementary")
log = _elementary(np.log, "log", "tehl_taichi.engine.elementary")
sqrt = _elementary(np.sqrt, "sqrt")
asin = _elementary(np.arcsin, "asin")
absolute = _elementary(np.absolute, "abs")
minimum = _elementary(np.minimum, "minimum", "tehl_taichi.engine.elementary")
maximum = _elementary(np.maximum, "maximum", "tehl_taichi.engine.elementary")
where = _elementary(np.where, "select")
