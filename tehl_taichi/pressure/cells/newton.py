"""Newton's method with its vectors on the card: only sums and the largest change are copied back in a step."""

import numpy as np

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.resident import there
from tehl_taichi.engine.simd import LinearFlat, Table, V, W, cells, lanes_in, row_shares
from tehl_taichi.pressure import balances
from tehl_taichi.pressure.fields import FLOOR, K0, MASK, RHO, WEIGHT, H, P, R
from tehl_taichi.pressure.linear.cells.cell_gmres import CellGmres
from tehl_taichi.pressure.linear.cells.sums import CHUNKS, GROUPS, add_up
from tehl_taichi.pressure.newton import ROW_CAP, PressureSolver
from tehl_taichi.values.arrays import nearest_index

SUMS = 6  # number of sums: those of `balances`, then the square of the right-hand side and its net outflow


@ti.kernel
def sums(S: ti.template(), G: Table, middle: ti.i32, parts: Table, groups: Table, totals: Table) -> ti.types.vector(4, ti.f64):
    """Sums PHI2, LOAD, OUTFLOW, COUETTE, as of :func:`tehl_taichi.pressure.balances.sums`."""
    for c in range(CHUNKS):
        nx, ny, off = cells(G, 0)
        phi2, load, mass, couette = V(0.0), V(0.0), V(0.0), V(0.0)
        columns = (ny // W + 1) * (nx + 1)
        for n in range((columns + CHUNKS - 1) // CHUNKS):
            q = c + n * CHUNKS
            if q < columns:
                k, s = off + q, q // (nx + 1)
                share = row_shares(s, ny)
                x, y, z = balances.parts(S, k, G[0, FLOOR], 1 / G[0, K0])
                phi = ti.select(S[MASK, k] > 0.0, ti.min(ti.min(x, y), z), V(0.0))
                touch, dry = balances.sets(x, y, z, S[MASK, k])
                phi2 += phi * phi
                load += S[WEIGHT, k] * S[P, k]
                mass += share * S[R, k] * (1.0 - touch) * (1.0 - dry)
                if q % (nx + 1) == middle:
                    share = ti.select(S[MASK, k] > 0.0, share, V(1.0))  # given rows lie on no mirror
                    for u in ti.static(range(W)):
                        if s * W + u <= ny:
                            couette[u] += share[u] * S[RHO, k][u] * S[H, k][u]
        parts[balances.PHI2, c], parts[balances.LOAD, c] = phi2.sum(), load.sum()
        parts[balances.OUTFLOW, c], parts[balances.COUETTE, c] = mass.sum(), couette.sum()
    add_up(parts, groups, totals, 0, balances.SUMS)
    return ti.Vector([totals[0, 0], totals[0, 1], totals[0, 2], totals[0, 3]])


@ti.kernel
def defects(columns: ti.i32, b: LinearFlat, mass_row: LinearFlat, parts: Table, groups: Table, totals: Table
            ) -> ti.types.vector(2, ti.f64):
    """(sum of squares of the right-hand side, its net outflow)."""
    for c in range(CHUNKS):
        square, outflow = ti.cast(0.0, ti.f64), ti.cast(0.0, ti.f64)
        for n in range((columns + CHUNKS - 1) // CHUNKS):
            q = c + n * CHUNKS
            if q < columns:
                x = lanes_in(b, q)
                square += ti.cast((x * x).sum(), ti.f64)
                outflow += ti.cast((x * lanes_in(mass_row, q)).sum(), ti.f64)
        parts[4, c], parts[5, c] = square, outflow
    add_up(parts, groups, totals, 4, SUMS)
    return ti.Vector([totals[0, 4], totals[0, 5]])


@ti.kernel
def scale(values: LinearFlat, factor: ti.f64):
    """Multiply `values` by `factor`."""
    for n in range(values.shape[0]):
        values[n] = values[n] * factor


@ti.kernel
def largest(S: ti.template(), G: Table, step: LinearFlat, out: Table) -> ti.f64:
    """Largest size of a step at the nodes with unknown pressure."""
    for _ in range(1):
        out[0, 0] = 0.0
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        x = ti.select(S[MASK, off + q] > 0.0, ti.abs(ti.cast(lanes_in(step, q), ti.f64)), V(0.0))
        ti.atomic_max(out[0, 0], x.max())
    return out[0, 0]


class CellNewton(PressureSolver):
    """The :class:`tehl_taichi.pressure.newton.PressureSolver` for graphics cards.

    Its steps stay on the card; `_step` returns (largest change of P, change of H0).
    """

    def __init__(self, levels, film, most_rises=np.inf, carries_load=True):
        super().__init__(levels, film, most_rises, CellGmres, carries_load)

    def _bind(self):
        v = self.levels
        kind = ti.f32 if v.precision == "f32" else ti.f64
        self.b, self.mass_row = (ti.ndarray(kind, v.n) for _ in range(2))
        self.step, self.old, self.part = self.linear.krylov.out, ti.ndarray(ti.f64, v.n), np.ones(1)
        self.sums = tuple(ti.ndarray(ti.f64, size) for size in ((SUMS, CHUNKS), (SUMS, GROUPS), (1, SUMS)))
        self.partial, self.touching = np.zeros((1, balances.SUMS)), np.zeros((v.fine, 1))
        self.middle = nearest_index(v.X, 0.0)
        self._keep_pressure = v.launch(balances.save, v.S, v.G, P, self.old)
        self._move_pressure = v.launch(balances.advance, v.S, v.G, self.old, self.step, self.part)
        self._choose_sets = v.launch(balances.choose_sets, v.S, v.J, v.G, ROW_CAP, self.b, self.mass_row, self.touching)

    def _sums(self):
        self.partial[0] = sums(self.levels.S, there(self.levels.G), self.middle, *self.sums).to_numpy()

    def _scale_mass(self, b):
        square, defect = defects(self.levels.n // W, b, self.mass_row, *self.sums).to_numpy()
        factor = np.sqrt(self.levels.unknowns) / self.couette
        if defect != 0:
            factor *= min(1.0, float(np.sqrt(square) / abs(factor * defect)))
        scale(self.mass_row, factor)

    def _step(self, found):
        return np.array([largest(self.levels.S, there(self.levels.G), found.pressure, self.sums[-1]), found.approach])

    def _keep(self, step):
        self._keep_pressure()
        return self.H0
