"""Places of the levels as constants of kernels: loops with constant bounds are one launch on a card, others two."""

from tehl_taichi.engine import simd
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import W


class Level:
    """Level `number` of `levels` (see :class:`tehl_taichi.pressure.levels.Levels`): cells nx, ny; its first column in the
    tables; blocks of W rows, columns of a block (n2) and of the level; rows: those with unknowns; own: whether lines are
    solved on it."""

    def __init__(self, levels, number):
        self.number, (self.nx, self.ny) = number, levels.sizes[number]
        self.first, self.rows = int(levels.G[number, simd.OFF]), int(levels.G[number, simd.JN])
        self.blocks, self.n2 = self.ny // W + 1, self.nx + 1
        self.columns, self.own = self.blocks * self.n2, number in levels.lines


class Jobs:
    """Jobs of several parts in one loop: `total`; `parts`: (part, its first job, the one behind its last)."""

    def __init__(self, counted):
        """counted: (part, number of its jobs), ..."""
        self.total, self.parts = 0, []
        for part, count in counted:
            self.parts.append((part, self.total, self.total + count))
            self.total += count


@ti.func
def place(level: ti.template(), q):
    """Block and column along x of column q of a level."""
    return q // level.n2, q % level.n2
