"""The linear solve with cells as jobs against that with rows: products, lines, solutions."""

import numpy as np
import pytest
from pressure.linear.test_solver import LOAD, pressed

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import W
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.linear import line_solver
from tehl_taichi.pressure.linear.cells import lines
from tehl_taichi.pressure.linear.cells.cell_gmres import CellGmres
from tehl_taichi.pressure.linear.interface import RightHandSide

EQUAL = {"f32": 1e-5, "f64": 1e-12}


@pytest.fixture(scope="module", params=("f64", pytest.param("f32", marks=pytest.mark.slow)))
def problem(request, taichi_cpu):
    """(solver by rows, solver by cells, rows and net outflow of a right-hand side, precision) of one linear problem."""
    solver = pressed(request.param, "jacobi")
    rows, outflow = solver.linear.krylov.right.copy(), solver.linear.krylov.outflow.copy()
    cells = CellGmres(solver.levels)
    solver._choose_sets()  # the row scales, which a new solver of the same tables sets to 1
    return solver.linear.krylov, cells, (rows, outflow), request.param


def right_hand_side(rows, outflow, tolerance):
    return RightHandSide(rows, outflow, LOAD, tolerance, np.inf)


def test_products_of_the_jacobian(problem):
    by_rows, cells, (rows, _), precision = problem
    z = np.random.default_rng(1).standard_normal(rows.size) * by_rows.levels.inside
    one, other = by_rows.apply(z, 0.3).copy(), cells.krylov.apply(z, 0.3)
    assert np.abs(one - other).max() < EQUAL[precision] * np.abs(one).max() > 0


def test_corrections_and_their_iterations(problem):
    by_rows, cells, (rows, outflow), precision = problem
    by_rows.right[:], by_rows.outflow[:] = rows, outflow
    rise, count, _ = by_rows.solve(LOAD, float(outflow @ rows), 1e-4)
    found = cells.solve(right_hand_side(rows, outflow, 1e-4))
    assert found.iterations == count > 10
    assert found.approach == pytest.approx(rise, rel=1e-4)
    assert np.abs(found.pressure - by_rows.out).max() < {"f32": 1e-4, "f64": 1e-10}[precision] * np.abs(by_rows.out).max()


def test_a_solution_has_the_residual_that_was_asked_for(problem):
    by_rows, cells, (rows, outflow), precision = problem
    tolerance = {"f32": 1e-4, "f64": 1e-10}[precision]
    found = cells.solve(right_hand_side(rows, outflow, tolerance))
    b, weights = rows.astype(float), outflow.astype(float)
    left = b - cells.krylov.apply(found.pressure, found.approach)
    rest = np.append(left, [LOAD - by_rows.levels.vector(fields.WEIGHT) @ found.pressure, weights @ left])
    assert np.sqrt(rest @ rest) < 1.2 * tolerance * np.sqrt(b @ b + LOAD**2 + (weights @ b) ** 2)


def test_lines_by_cyclic_reduction(problem):
    """Of all levels with lines, against the factors of the solver by rows; the preconditioner of both is the same."""
    @ti.kernel
    def line_solutions(F: ti.template()):
        lines.solve(F.J, F.lines)

    by_rows, cells, (rows, _), precision = problem
    v, lanes = by_rows.levels, []
    cells.krylov.build()
    table = v.J.to_numpy()
    band = table[list(fields.BAND)]
    for l in v.lines:
        nx, ny = v.sizes[l]
        first, n2 = int(v.G[l, 0]), nx + 1
        for s in range(ny // W + 1):
            columns = slice(first + s * n2, first + (s + 1) * n2)
            lanes += [(l, columns, u, band[:, columns, u]) for u in range(W)]
    right = np.random.default_rng(2).standard_normal(table[fields.RES].shape)
    table[fields.RES] = right
    v.J.from_numpy(table)
    line_solutions(cells.krylov.memory)
    solved = v.J.to_numpy()[fields.SOL]
    for l, columns, u, entries in lanes:
        exact = np.linalg.solve(dense_band(entries.astype(float), line_solver.HALF), right[columns, u])
        assert np.abs(solved[columns, u] - exact).max() < {"f32": 1e-5, "f64": 1e-12}[precision] * np.abs(exact).max(), (l, u)


def dense_band(entries, half):
    """The matrix of diagonals (2 half + 1, n)."""
    n = entries.shape[1]
    out = np.zeros((n, n))
    for row, i in np.ndindex(entries.shape):
        if 0 <= i + row - half < n:
            out[i, i + row - half] = entries[row, i]
    return out


def test_another_right_hand_side_without_a_load(problem):
    """H0 stays where nothing is asked of the load."""
    _, cells, (rows, outflow), _ = problem
    found = cells.solve(RightHandSide(rows, outflow, None, 1e-3, np.inf))
    assert found.approach == 0.0 and np.abs(found.pressure).max() > 0
