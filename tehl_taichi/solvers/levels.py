"""The grids of one contact problem and their state table."""

import math

import numpy as np

from tehl_taichi.kernels import fields, reynolds, transfer
from tehl_taichi.physics.viscosity import ln_eta
from tehl_taichi.runtime import bind
from tehl_taichi.solvers import influence
from tehl_taichi.solvers.transforms import Deflection

COARSEST_2D = 16  # cells along x below which no coarser grid is made
COARSEST_1D = 32
DENSE_LIMIT = 700  # nodes up to which the coarsest grid is solved directly


class Levels:
    """State table S, level table G and the constants of one contact on a grid of nx x ny cells and its coarser ones.

    scene: the description; scales: its Hertz units; nx, ny: cells (ny = 0: one-dimensional). Arrays that a caller may
    read or write as (ny+1, nx+1) views of the finest grid come from :meth:`view`.
    """

    def __init__(self, scene, scales, nx, ny):
        self.scene, self.scales, self.kind = scene, scales, scales.kind
        self.nx, self.ny = nx, ny
        grid = scene.grid
        self.X = np.linspace(grid.x_min, grid.x_max, nx + 1)
        self.Y = np.linspace(0.0, grid.y_max, ny + 1) if ny else np.zeros(1)
        self.dx, self.dy = self.X[1] - self.X[0], grid.y_max / ny if ny else 1.0
        self.sizes = _coarsen(nx, ny)
        self.rows = np.array([(l, j) for l, (_, my) in enumerate(self.sizes) for j in range(my + 1)], np.int32)
        self.G = self._level_table()
        self.n = (nx + 1) * (ny + 1)
        self.S = np.zeros((fields.NROWS, int(self.G[-1, fields.OFF]) + self.nodes(-1) + 2))
        self.deflection = Deflection(nx, ny, self.dx, self.dy, self.kind)
        self._set_laws()
        self._bind()

    def nodes(self, l):
        return (self.sizes[l][0] + 1) * (self.sizes[l][1] + 1)

    def _level_table(self):
        G = np.zeros((len(self.sizes), fields.NCOLS))
        off = 0
        for l, (nx, ny) in enumerate(self.sizes):
            dx, dy = self.dx * 2**l, self.dy * 2**l
            own = self.near_kernel(l)[0]
            rows = ny + 1 if self.kind == "line" else ny
            G[l] = [off, nx, ny, rows, dx, dy, 0.0, own[0], own[1], self.scene.rheology.film_floor, 0, 0]
            off += (nx + 1) * (ny + 1)
        return G

    def near_kernel(self, l, length=8):
        """Deflection at distances 0..7 along x of a node in an inner and in the outermost row; shape (2, 8)."""
        dx, dy = self.dx * 2**l, self.dy * 2**l
        if self.kind == "line":
            strip = influence.strip(length, dx)[:length]
        if self.sizes[l][1] == 0:
            return np.vstack([strip, strip])
        inner = influence.rectangle(length, 1, dx, dy, self.kind)[:length, 0]
        # the outermost row of a line contact goes on to infinity on one side only
        return np.vstack([inner, 0.5 * (inner + strip) if self.kind == "line" else inner])

    def _set_laws(self):
        scene, s = self.scene, self.scales
        self.Gamma = scene.operation.temperature
        self.ln_eta0 = float(ln_eta(scene.oil, 0.0, self.Gamma))
        lam = 12 * math.exp(self.ln_eta0) * s.u_m * s.R**2 / (s.a**3 * s.p_H)
        self.inv_lambda = 1 / lam

    def _bind_laws(self, first, last, slopes):
        return bind(reynolds.laws, self.S, self.G, self.rows, first, last, self.scene.oil, self.scales.p_H, self.Gamma,
                    self.ln_eta0, self.inv_lambda, int(slopes))

    def _bind(self):
        """Launches of the kernels that this table is used with, on the finest level and on the coarser ones."""
        fine, coarse = (0, self.ny + 1), (self.ny + 1, len(self.rows))
        self.laws = self._bind_laws(*fine, slopes=False)
        self._slopes, self._slopes_coarse = self._bind_laws(*fine, True), self._bind_laws(*coarse, True)
        self._faces = bind(reynolds.linearise, self.S, self.G, self.rows, *fine)
        self._faces_coarse = bind(reynolds.linearise, self.S, self.G, self.rows, *coarse)
        self.evaluate_residual = bind(reynolds.residual, self.S, self.G, 0)
        self.inject = bind(transfer.inject, self.S, self.G, len(self.sizes))
        self.restrict = bind(transfer.restrict, self.S, self.G, len(self.sizes)) if len(self.sizes) > 1 else _nothing

    def linearise(self):
        """Laws with slopes, face derivatives and the diagonal of the finest level."""
        self._slopes()
        self._faces()

    def linearise_coarse(self):
        """The same on every coarser level, about the injected state."""
        self.inject()
        self._slopes_coarse()
        self._faces_coarse()

    def view(self, row):
        """Field `row` of the finest grid as (ny+1, nx+1)."""
        return self.S[row, : self.n].reshape(self.ny + 1, self.nx + 1)

    def flat(self, row):
        return self.S[row, : self.n]

    def set_rate(self, weight):
        """Weight of the newest level in d/dT, 1/T units (0: steady); scaled with dx on every level."""
        self.G[:, fields.CT] = weight * self.G[:, fields.DX]


def _nothing():
    """Stands for the transfers of a table with one level."""


def _coarsen(nx, ny):
    sizes = [(nx, ny)]
    while _can_halve(*sizes[-1]):
        sizes.append((sizes[-1][0] // 2, sizes[-1][1] // 2))
    return sizes


def _can_halve(nx, ny):
    if nx % 2 or ny % 2:
        return False
    return nx // 2 >= COARSEST_1D if ny == 0 else nx // 2 >= COARSEST_2D and ny // 2 >= 3
