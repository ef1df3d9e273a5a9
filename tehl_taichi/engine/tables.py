"""Fields that are handed from one owner to the next: Taichi never frees them, and a new one compiles its kernels anew."""

import gc
import weakref

from tehl_taichi.engine import runtime

_tables = []  # [field, weak reference to its owner]
SMALLEST_TABLE = 5000  # columns; sizes grow by factors of 4, because every size of a field compiles its kernels anew
# columns more, so that rows do not lie a multiple of 4096 bytes apart: all that a loop reads would share a few cache sets then.
# Whole cache lines in both precisions. Isothermal step on 512x128, ms on one / two threads, medians of three: none 113 / 94, 12
# columns 109 / 86, 13 columns 139 / 91
SKEW = 12


def lease(owner, rows, lanes, columns, slots=0, each=1, precision="f64", clean=True):
    """A vector field of `rows` x at least `columns` columns of `each` times `lanes` numbers, zero, for `owner` alone while it
    lives; with `slots` (and rows 0) of at least `columns` columns x `slots`.

    That of a former owner is used again where there is one; with clean = False as he left it.
    """
    runtime.ensure()
    wanted = (lanes, precision), (rows, columns * each, slots)
    fitting = [entry for entry in _tables if _fits(entry[0], *wanted)]
    if fitting and not _free(fitting):
        gc.collect()  # 28 ms; an owner that is only held by a reference cycle is gone then
    if entry := _free(fitting):
        field, entry[1] = entry[0], weakref.ref(owner)
        if clean:
            field.fill(0.0)
        return field
    from tehl_taichi.engine.language import ti

    capacity = SMALLEST_TABLE
    while capacity + SKEW < columns:
        capacity *= 4
    capacity += SKEW
    field = ti.Vector.field(lanes, getattr(ti, precision), shape=(capacity, slots) if slots else (rows, capacity * each))
    _tables.append([field, weakref.ref(owner)])
    return field


def _free(entries):
    """The first one whose owner is gone, or None."""
    return next((entry for entry in entries if entry[1]() is None), None)


def _fits(field, kind, size):
    (rows, columns, slots), shape = size, field.shape
    large = shape[0] >= columns and shape[1] == slots if slots else shape[0] == rows and shape[1] >= columns
    return (field.n, str(field.dtype)) == kind and large
