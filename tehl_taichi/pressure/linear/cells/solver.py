"""The linear solve with columns as jobs: its fields and kernels, with a few launches per iteration."""

import numpy as np

from tehl_taichi.engine import field_pool, simd
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.resident import there
from tehl_taichi.engine.simd import Flat, LinearFlat, Table, W
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.linear import convolution as symbols_of
from tehl_taichi.pressure.linear import gmres, operations
from tehl_taichi.pressure.linear.cells import lines, transfer, vectors
from tehl_taichi.pressure.linear.cells.convolution import Convolutions, convolve
from tehl_taichi.pressure.linear.cells.sizes import Level
from tehl_taichi.pressure.linear.cells.sums import CHUNKS, GROUPS, add_up, products
from tehl_taichi.pressure.linear.gmres import (
    COUNT,
    DOT_SUM,
    FIXED,
    LEFT,
    LIFT_LOAD,
    LOAD,
    LOAD_SUM,
    MASS,
    MASS_SUM,
    NORM,
    RISE,
    SCALARS,
    TOLERANCE,
)
from tehl_taichi.pressure.linear.preconditioner import REST, REST_LINE, STORED, STORED_LINE
from tehl_taichi.pressure.linear.solver import dense_entries, dense_rows

ENOUGH, CONTINUES = 1, 0


class CellFields:
    """Constants and fields that kernels of a solver use.

    S, J: tables (see :mod:`fields`). V: vectors. D: inverse of the coarsest level. levels: list of Level. K, Q: Convolutions of
    the deflection and of the distributions. lines: CyclicLines. most: largest number of iterations. bounds: between the kinds
    of nodes.
    """

    def __init__(self, levels, symbols):
        v = self.owner = levels
        self.S, self.J, self.most = v.S, v.J, v.scene.numerics.krylov_max
        rows = operations.BASIS + 2 * self.most + 2
        lease = dict(precision=v.precision, clean=False)
        self.V = field_pool.lease(self, rows, W, v.most_columns, **lease)
        self.D = field_pool.lease(self, 1, W, max(dense_entries(v.sizes, v.dense), 1), **lease)
        self.levels = [Level(v, l) for l in range(len(v.sizes))]
        self.fine, self.dense = self.levels[0], [self.levels[l] for l in v.dense]
        self.solved = [self.levels[l] for l in (*v.lines, *v.dense)]
        self.K = Convolutions(v, symbols[:1], v.precision, v.linear)
        self.Q = Convolutions(v, symbols[1:], v.precision, v.linear)
        self.lines = lines.CyclicLines(v, symbols[1:])
        self.bounds = (REST, *STORED) if v.ny else (REST_LINE, *STORED_LINE)


@ti.kernel
def bands(F: ti.template(), G: Table):
    """Set the kinds of all nodes and the matrices of all lines."""
    for n in ti.static(range(len(F.solved))):
        vectors.classify(F.S, F.J, G, F.solved[n], *ti.static(F.bounds))
    lines.fill_bands(F.J, F.lines)
    lines.gather(F.J, F.lines)


@ti.kernel
def reduce(F: ti.template(), n: ti.i32):
    """Do step n of the reduction of all lines."""
    lines.reduce_matrices(F.lines, n)


@ti.kernel
def invert(F: ti.template()):
    """Invert the blocks of all lines after the reduction."""
    lines.invert(F.lines)


@ti.kernel
def precondition(F: ti.template(), G: Table, N: Table, parts: Table):
    """Apply the preconditioner: COR of the finest level from RES, and the partial sums of its load."""
    for l in ti.static(range(len(F.levels) - 1)):
        transfer.restrict(F.J, G, F.levels[l], F.levels[l + 1])
    for level in ti.static(F.dense):
        vectors.dense(F.J, F.D, level)
    lines.solve(F.J, F.lines)
    vectors.put_columns(F, N, F.Q, F.most, vectors.line_part)
    convolve(F.Q)
    vectors.collect(F, F.Q, F.lines)
    for n in ti.static(range(len(F.levels) - 1)):
        transfer.prolong(F.J, F.levels[ti.static(len(F.levels) - 2 - n)], F.levels[ti.static(len(F.levels) - 1 - n)])
    vectors.load_parts(F, F.fine, parts)


@ti.kernel
def direct(F: ti.template(), N: Table, parts: Table, groups: Table, totals: Table):
    """Set the border of the preconditioned vector (its change of H0), then the newest direction."""
    add_up(parts, groups, totals, LOAD_SUM, DOT_SUM)
    for _ in range(1):
        gmres.border(N, totals, ti.cast(N[SCALARS, COUNT], ti.i32))
    vectors.put_columns(F, N, F.K, F.most, vectors.directed)


@ti.kernel
def multiply(F: ti.template(), N: Table):
    """Multiply the direction by the Jacobian."""
    convolve(F.K)
    vectors.rows(F, N, F.K, F.fine)


@ti.func
def project(F: ti.template(), N: ti.template(), parts: ti.template(), groups: ti.template(), totals: ti.template()):
    """Subtract the components along the basis from the newest vector."""
    products(F.V, parts, F.most, F.fine.columns, operations.OUTFLOW, operations.BASIS, N)
    add_up(parts, groups, totals, 0, DOT_SUM + F.most)
    for _ in range(1):
        gmres.project(N, totals, ti.cast(N[SCALARS, COUNT], ti.i32))
    vectors.update(F, N, F.fine)


@ti.kernel
def extend(F: ti.template(), N: Table, parts: Table, groups: Table, totals: Table) -> ti.i32:
    """Project the product twice and take it into the basis. Returns ENOUGH or CONTINUES."""
    for _ in ti.static(range(2)):
        project(F, N, parts, groups, totals)
    products(F.V, parts, 0, F.fine.columns, operations.OUTFLOW, operations.BASIS, N)
    add_up(parts, groups, totals, 0, DOT_SUM)
    for _ in range(1):
        N[SCALARS, gmres.NEXT] = gmres.extend(N, totals, ti.cast(N[SCALARS, COUNT], ti.i32), F.most, False)
    return ti.cast(N[SCALARS, gmres.NEXT], ti.i32)


@ti.kernel
def begin(F: ti.template(), N: Table, parts: Table, groups: Table, totals: Table, right: LinearFlat, outflow: LinearFlat,
          load: ti.f64, fixed: ti.f64, tolerance: ti.f64):
    """Set the first vector of the basis."""
    for _ in range(1):
        N[SCALARS, COUNT], N[SCALARS, LOAD], N[SCALARS, FIXED], N[SCALARS, TOLERANCE] = -1.0, load, fixed, tolerance
    vectors.start(F, F.fine, right, outflow)
    products(F.V, parts, 0, F.fine.columns, operations.OUTFLOW, operations.BASIS, N)
    add_up(parts, groups, totals, 0, DOT_SUM)
    for _ in range(1):
        N[SCALARS, MASS] = totals[0, MASS_SUM]
        gmres.begin(N, totals)
        N[SCALARS, NORM] = -1.0


@ti.kernel
def ones(F: ti.template()):
    """Set RES for a change of H0."""
    vectors.ones(F.J, F.fine)


@ti.kernel
def lift(F: ti.template(), N: Table, parts: Table, groups: Table, totals: Table):
    """Keep the preconditioner's answer to a change of H0, and its load."""
    vectors.lift(F, F.fine)
    vectors.load_parts(F, F.fine, parts)
    add_up(parts, groups, totals, LOAD_SUM, DOT_SUM)
    for _ in range(1):
        N[SCALARS, LIFT_LOAD] = totals[0, LOAD_SUM]


@ti.kernel
def finish(F: ti.template(), N: Table, out: LinearFlat, numbers: Flat):
    """Write the solution to `out`; numbers: iterations, norm at the start and at the end, change of H0."""
    vectors.finish(F, N, F.fine, F.most, out)
    for _ in range(1):
        for n, which in ti.static(enumerate((COUNT, gmres.BETA, LEFT, RISE))):
            numbers[n] = N[SCALARS, which]


@ti.kernel
def given(F: ti.template(), N: Table, right: LinearFlat, rise: ti.f64):
    """Take a given direction, and a change `rise` of H0."""
    for _ in range(1):
        N[SCALARS, COUNT], N[SCALARS, RISE] = -1.0, rise
    vectors.given(F.J, F.K, right)


@ti.kernel
def copy(F: ti.template(), N: Table, out: LinearFlat):
    """Write the newest vector to `out`."""
    vectors.copy(F, N, F.fine, out)


class CellKrylov:
    """FGMRES for the linearised problem in the tables of `levels` (:class:`tehl_taichi.pressure.levels.Levels`).

    out: the last result (levels.n,), a Taichi array.
    """

    def __init__(self, levels):
        v = self.levels = levels
        shapes = symbols_of.transform_sizes(v.sizes, v.lines)
        self.symbols = [symbols_of.deflection(shapes[0], v), *(symbols_of.distribution(c, v) for c in shapes[1:])]
        self.memory = CellFields(v, self.symbols)
        self.most, sums = self.memory.most, DOT_SUM + self.memory.most
        self.out = ti.ndarray(ti.f32 if v.precision == "f32" else ti.f64, v.n)
        sizes = (gmres.TRIANGLE + self.most, self.most + 16), (sums, CHUNKS), (sums, GROUPS), (1, sums)
        self.numbers, self.parts, self.groups, self.totals = (ti.ndarray(ti.f64, size) for size in sizes)
        weights = v.vector(fields.WEIGHT).astype(v.linear).reshape(-1, W)
        self._fill(self.memory.V, operations.LOADING, 0, weights)
        self._fill(v.J, fields.SCALE, self.memory.fine.first, np.ones_like(weights))

    def _fill(self, field, row, first, values):
        simd.fill(*simd.one_of((field,), field), row, first, values)

    def set_dense(self, inverse, place):
        """Set the inverse (nodes, nodes) of the coarsest level, whose node n has the number place[n] in the order of the
        table."""
        self._fill(self.memory.D, 0, 0, dense_rows(inverse, place, self.levels))

    def build(self):
        """Set the kinds of the nodes, and factorise the lines of the linearised problem."""
        bands(self.memory, there(self.levels.G))
        for n in range(len(self.memory.lines.distances)):
            reduce(self.memory, n)
        invert(self.memory)

    def _sums(self):
        return self.numbers, self.parts, self.groups, self.totals

    def _precondition(self):
        precondition(self.memory, there(self.levels.G), self.numbers, self.parts)

    def lift(self):
        """Compute and keep the preconditioner's answer to a change of H0, for the bordered system."""
        ones(self.memory)
        self._precondition()
        lift(self.memory, *self._sums())

    def solve(self, right, outflow, load, tolerance):
        """Solve for the rows `right`, their net outflow by the weights `outflow`, and the load `load` (None: H0 is fixed).

        right, outflow: (levels.n,), numpy or Taichi arrays. Tolerance and result: see
        :meth:`tehl_taichi.pressure.linear.solver.Krylov.solve`; the solution is in `out`.
        """
        begin(self.memory, *self._sums(), right, outflow, load or 0.0, float(load is None), tolerance)
        enough = CONTINUES
        while enough == CONTINUES:
            self._precondition()
            direct(self.memory, *self._sums())
            multiply(self.memory, self.numbers)
            enough = extend(self.memory, *self._sums())
        found = np.zeros(4)
        finish(self.memory, self.numbers, self.out, found)
        count, beta, left, rise = found
        return float(rise), int(count), float(left / beta) if beta > 0 else 0.0

    def apply(self, z, rise):
        """Scaled Jacobian rows (levels.n,) times the change z (levels.n,) of the pressure and `rise` of H0."""
        given(self.memory, self.numbers, np.ascontiguousarray(z, self.levels.linear), rise)
        multiply(self.memory, self.numbers)
        copy(self.memory, self.numbers, self.out)
        return self.out.to_numpy()
