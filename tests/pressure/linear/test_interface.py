"""A second linear solver behind the interface: dense matrices of numpy lead Newton to the same film."""

import numpy as np
import pytest
from pressure.linear.test_solver import pressed

from tehl_taichi.engine import simd
from tehl_taichi.pressure import fields, influence
from tehl_taichi.pressure.linear.interface import Correction
from tehl_taichi.pressure.newton import PressureSolver


class DenseSolver:
    """The linearised problem as one matrix, from the tables of the finest level."""

    STEPS = ((-2, 0), (-1, 0), (0, 0), (1, 0), (0, 1), (0, -1))  # along x and y, of the entries of a row

    def __init__(self, levels):
        self.levels, self.solves, self.lanes, self.first = levels, 0, simd.W, int(levels.G[0, simd.OFF])
        self.stencil, self.scale = fields.STENCIL, fields.SCALE
        self.j, self.i = (q.ravel() for q in np.mgrid[: levels.ny + 1, : levels.nx + 1])
        self.place = (self.j // simd.W * (levels.nx + 1) + self.i) * simd.W + self.j % simd.W
        self.bending = influence.matrix(*levels.deflection_key(0))
        self.weights = levels.vector(fields.WEIGHT)[self.place]

    def solve(self, rhs):
        """The outflow is a sum of the rows, which an exact solution satisfies with them."""
        self.solves += 1
        table = self._table()
        J, by_film = self._matrices(table)
        rows = np.column_stack([J + by_film @ self.bending, by_film.sum(axis=1)]) / table[self.scale][:, None]
        found = np.linalg.solve(np.vstack([rows, np.append(self.weights, 0.0)]), np.append(rhs.rows[self.place], rhs.load))
        pressure = np.zeros(self.levels.n)
        pressure[self.place] = found[:-1]
        return Correction(pressure, found[-1], 1)

    def _table(self):
        """Rows of the finest level in the table of the linear problem, node by node."""
        blocks = self.levels.n // self.lanes
        return self.levels.J.to_numpy()[:, self.first : self.first + blocks].reshape(-1, self.levels.n)[:, self.place]

    def _matrices(self, table):
        """Jacobian by the pressure alone, and by the film."""
        nodes, half, out = np.arange(self.place.size), len(self.stencil) // 2, []
        for entries in (self.stencil[:half], self.stencil[half:]):
            matrix = np.zeros((nodes.size, nodes.size))
            for row, (p, q) in zip(entries, self.STEPS):
                i, j = np.clip(self.i + p, 0, self.levels.nx), np.clip(self.j + q, 0, self.levels.ny)
                np.add.at(matrix, (nodes, j * (self.levels.nx + 1) + i), table[row])
            out.append(matrix)
        return out


def test_newton_converges_with_another_linear_solver(taichi_cpu):
    first = pressed("f64", "jacobi")
    levels, film = first.levels, first.equations.film
    assert first.solve().converged
    exact = levels.get(fields.P)
    other = PressureSolver(levels, film, linear=DenseSolver)
    levels.put(fields.P, exact * (1 + 0.01 * np.cos(3 * levels.X)))
    other.H0, other.load = first.H0 + 1e-3, first.load
    report = other.solve()
    assert report.converged and report.newton == report.cycles == other.linear.solves > 1
    assert np.abs(levels.get(fields.P) - exact).max() < 1e-4 * exact.max()
    assert other.H0 == pytest.approx(first.H0, abs=1e-4)
