"""Grids of one contact problem: a grid of nx x ny cells and its coarser ones, each of every second node."""

import numpy as np

from tehl_taichi.engine import simd
from tehl_taichi.laws.gap import undeformed
from tehl_taichi.pressure import influence
from tehl_taichi.values.arrays import nearest_index

COARSEST_2D = 16  # of Grids
COARSEST_1D = 32
DENSE_LIMIT = 700  # nodes up to which the coarsest grid is solved directly
PAD = 4  # columns in front of the first and behind the last level that stencils may touch


class Grids:
    """Places, spacings and blocks of all levels, the finest first; dimensionless.

    description: the grid of a scene; scales: its Hertz units; nx, ny: cells (ny = 0: one-dimensional); full: the domain begins
    at -y_max, not at the plane of symmetry; coarsest: cells along x below which no coarser grid is made, in two dimensions.
    """

    def __init__(self, description, scales, nx, ny, full=False, coarsest=COARSEST_2D):
        self.scales, self.line, self.mirrored = scales, scales.line, not full
        self.nx, self.ny, y_max = nx, ny, description.y_max * scales.b / scales.a
        self.X = np.linspace(description.x_min, description.x_max, nx + 1)
        self.Y = np.linspace(-y_max if full else 0.0, y_max, ny + 1) if ny else np.zeros(1)
        # not as differences: the coarser levels of all grids of a start then have the very same spacings
        self.dx = (description.x_max - description.x_min) / nx
        self.dy = (2 if full else 1) * y_max / ny if ny else 1.0
        self.middle = nearest_index(self.Y, 0.0) if not self.line else ny  # row of a central film without feature
        self.sizes = coarsen(nx, ny, coarsest)
        self.dense, self.lines = solved_by(self.sizes)
        self.blocks = self._blocks([*self.lines, *self.dense])
        self.fine = self.sizes[0][1] // simd.W + 1  # blocks of the finest grid

    def _blocks(self, levels):
        """(level, block) of all blocks of these levels."""
        return np.array([(l, s) for l in levels for s in range(self.sizes[l][1] // simd.W + 1)], np.int32)

    def grid(self, l):
        """Cells and spacings (nx, ny, dx, dy) of level l."""
        return (*self.sizes[l], self.dx * 2**l, self.dy * 2**l)

    def smooth_gap(self):
        """Undeformed gap without features (ny+1, nx+1)."""
        return undeformed(self.X[None, :], self.Y[:, None], self.scales.curvature)

    def near_kernel(self, l, length=2):
        """Deflection at distances 0..length-1 along x of a node in an inner and in the outermost row; shape (2, length)."""
        _, ny, dx, dy = self.grid(l)
        if self.line:
            strip = influence.strip(length, dx)[:length]
        if ny == 0:
            return np.vstack([strip, strip])
        inner = influence.rectangle(length, 1, dx, dy, self.scales.compliance)[:length, 0]
        # the outermost row of a line contact continues to infinity on one side only
        return np.vstack([inner, 0.5 * (inner + strip) if self.line else inner])

    def deflection_key(self, l):
        """Values on which the deflection of level l depends: cells, spacings, compliance, line, mirrored."""
        return (*self.grid(l), self.scales.compliance, self.line, self.mirrored)


def load_weights(grids):
    """Weights w (ny+1, nx+1) such that sum(w P) is the load (model.md section 4, Hertz units).

    Line: mean over y (trapezoid over the stored rows) of int P dX = pi/2. Point: double integral over both halves, without the
    sides, whose pressure is given and deflects nothing. Along x every node counts with a whole cell, also at the border,
    because its pressure deflects the bodies as a whole cell.
    """
    w_y = np.full((grids.ny + 1, 1), grids.dx)
    if grids.ny:
        w_y[0] *= 0.5 if grids.line or grids.mirrored else 0.0
        if not grids.line:
            w_y *= 2 * grids.dy if grids.mirrored else grids.dy
            w_y[-1] = 0.0
        else:
            w_y[-1] *= 0.5
            w_y /= grids.ny
    return np.broadcast_to(w_y, (grids.ny + 1, grids.nx + 1))


def coarsen(nx, ny, coarsest=COARSEST_2D):
    """Sizes of the grids from (nx, ny) down to the coarsest."""
    sizes = [(nx, ny)]
    while _can_halve(*sizes[-1], coarsest):
        sizes.append((sizes[-1][0] // 2, sizes[-1][1] // 2))
    return sizes


def solved_by(sizes):
    """([levels solved as a dense matrix: the coarsest, if it is small], [levels solved by lines: every second of the others]).

    Krylov iterations per step, gear on 128 / 256 / 512 columns: with lines on all levels 16.7 / 18.6 / 19.5, on every second
    one 17.2 / 18.2 / 20.3, with 0.9 of the time of an iteration and 0.8 of that of a linearisation.
    """
    (nx, ny), last = sizes[-1], len(sizes) - 1
    if last > 0 and (nx + 1) * (ny + 1) <= DENSE_LIMIT:
        return [last], list(range(0, last, 2))
    return [], [*range(0, last, 2), last]


def _can_halve(nx, ny, coarsest):
    if nx % 2 or ny % 2:
        return False
    return nx // 2 >= COARSEST_1D if ny == 0 else nx // 2 >= coarsest and ny // 2 >= 3


def columns(nx, ny):
    """Columns of one grid in the state table."""
    return (ny // simd.W + 1) * (nx + 1)


def table_columns(sizes):
    """Columns of grids of these sizes, with the margins at both ends that stencils access."""
    return sum(columns(*size) for size in sizes) + 2 * (PAD + sizes[0][0] + 1)
