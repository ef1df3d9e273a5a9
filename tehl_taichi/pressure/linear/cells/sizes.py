"""Places of the levels as constants of kernels: a loop with constant bounds is one launch on a card, another loop two."""

from tehl_taichi.engine import simd
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import W


class Level:
    """Level `number` of a :class:`tehl_taichi.pressure.levels.Levels`.

    nx, ny: cells. first: its first column in the tables. blocks: number of blocks of W rows. n2, columns: numbers of columns of
    a block and of the level. rows: number of rows with unknowns. own: whether lines are solved on it.
    """

    def __init__(self, levels, number):
        self.number, (self.nx, self.ny) = number, levels.sizes[number]
        self.first, self.rows = int(levels.G[number, simd.OFF]), int(levels.G[number, simd.JN])
        self.blocks, self.n2 = self.ny // W + 1, self.nx + 1
        self.columns, self.own = self.blocks * self.n2, number in levels.lines


class Jobs:
    """Jobs of several parts in one loop; total: their number; parts: list of (part, its first job, end)."""

    def __init__(self, counted):
        """counted: list of (part, number of its jobs)."""
        self.total, self.parts = 0, []
        for part, count in counted:
            self.parts.append((part, self.total, self.total + count))
            self.total += count


@ti.func
def place(level: ti.template(), q):
    """(block, number along x) of column q of a level."""
    return q // level.n2, q % level.n2
