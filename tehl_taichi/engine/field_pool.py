"""Pool of fields that pass from one owner to the next: Taichi never frees a field, and a new one needs its kernels compiled
again.
"""

import gc
import itertools
import weakref

from tehl_taichi.engine import runtime

_tables = []  # [field, weak reference to its owner]
SMALLEST_TABLE = 6600  # columns, of 256 x 64 cells with their coarse levels; sizes are 1, 1.5, 2, 3, 4, 6, ... times this: each
# compiles its kernels again, and what is too large is emptied at every start (513 x 257: 0.13 of 3 s by fours)
# columns more, so that rows do not lie a multiple of 4096 bytes apart: all that a loop reads would share a few cache sets then.
# Whole cache lines in both precisions. Isothermal step on 512x128, ms on one / two threads, medians of three: none 113 / 94, 12
# columns 109 / 86, 13 columns 139 / 91
SKEW = 12


def lease(owner, rows, lanes, columns, slots=0, each=1, precision="f64", clean=True):
    """A zeroed vector field for `owner` as long as it lives: `rows` x at least `columns` columns of `each` times `lanes`
    numbers; with `slots` (and rows 0) at least `columns` columns x `slots`.

    The field of a former owner is used again if there is one; clean=False: with its old contents.
    """
    runtime.ensure()
    needed = (lanes, precision), (rows, columns * each, slots)
    fitting = [entry for entry in _tables if _fits(entry[0], *needed)]
    if fitting and not _free(fitting):
        gc.collect()  # 28 ms; an owner that is only held by a reference cycle is gone then
    if entry := _free(fitting):
        field, entry[1] = entry[0], weakref.ref(owner)
        if clean:
            field.fill(0.0)
        return field
    from tehl_taichi.engine.language import ti

    capacity = _capacity(columns)
    field = ti.Vector.field(lanes, getattr(ti, precision), shape=(capacity, slots) if slots else (rows, capacity * each))
    _tables.append([field, weakref.ref(owner)])
    return field


def _capacity(columns):
    """Next standard size of a table with this number of columns."""
    sizes = (size for n in itertools.count() for size in (SMALLEST_TABLE << n, 3 * SMALLEST_TABLE << n >> 1))
    return next(size + SKEW for size in sizes if size + SKEW >= columns)


def _free(entries):
    """First entry whose owner no longer exists, or None."""
    return next((entry for entry in entries if entry[1]() is None), None)


def _fits(field, kind, size):
    (rows, columns, slots), shape = size, field.shape
    large = shape[0] >= columns and shape[1] == slots if slots else shape[0] == rows and shape[1] >= columns
    return (field.n, str(field.dtype)) == kind and large
