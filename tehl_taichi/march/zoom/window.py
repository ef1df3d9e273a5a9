"""Position and size of the window of a zoom: nodes of a grid that is `factor` times as fine as that of the run."""

import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi.pressure.grids import Grids
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.zoom_room import changed, extent, followed

# width of the border where the pressure of the run is given: cells of the run, and at least so many of the window. Three paths
# of oil begin there, with the nodes of their interpolation. Window of factor 1 on 128 columns (one dimension, pure rolling),
# largest difference from the run: 0.096 GPa with 2 cells, 3e-5 GPa with 8
GIVEN, LEAST = 2, 8
MORE = 1  # cells of the run inside this border, over which the window's pressure replaces that of the run
# a: distance between these cells and the part that the feature changes. Isothermal oil keeps for long what the inlet made of it
# beside a feature: film under the dent of SRR 0.12 / -0.12 off 512x128 cells by up to 2.2 / 0.6 % with 0.05 a, 0.35 / 0.30 with
# 0.1, 0.05 / 0.04 with 0.2; with temperatures by up to 0.08 / 0.05 % with 0.05 a
BEYOND, BEYOND_FROZEN = 0.05, 0.2
HALF = 0.5  # weight of the core from which a node belongs to the window
COLUMNS, ROWS = 32, 8  # the window has a multiple of so many cells, so that its sizes and coarse levels are few


def windows_of(scene, factor):
    """The windows of this factor of a scene: around the features of the first feature's surface, and of the other one if it has
    a window of its own."""
    return [Window.of(scene, factor, surface) for surface in followed(scene)]


def given(factor):
    """Number of fine cells along the border where the pressure is given."""
    return max(GIVEN * factor, LEAST)


def smooth(t):
    """Smooth step from 0 to 1 for t from 0 to 1, with two continuous derivatives."""
    t = np.clip(t, 0.0, 1.0)
    return t**3 * (10 - 15 * t + 6 * t * t)


@dataclass(frozen=True)
class Window:
    """Position and size of a window.

    factor: fine cells per cell of the run. nx, ny: cells of the window (ny = 0: one row). all_nx, all_ny: cells of the whole
    fine grid. row: its first row. back: cells from its first column to the origin of its surface (of the surface with the first
    feature, the centre of that feature). x_min, y_min, dx, dy: of the fine grid, a. pace: speed of its surface relative to that
    of the first feature. middle: cells from its first column to the middle of its features.
    """

    factor: int
    nx: int
    ny: int
    all_nx: int
    all_ny: int
    row: int
    back: int
    x_min: float
    y_min: float
    dx: float
    dy: float
    pace: float = 1.0
    middle: float = 0.0

    @classmethod
    def of(cls, scene, factor, surface=None):
        """The window of a scene around the features of a MovingSurface, by default that of the first feature."""
        surface = surface or scene.reference
        grid = Grids(scene.grid, Scales.of(scene), scene.grid.nx, scene.rows, not scene.symmetric)
        beyond = BEYOND_FROZEN if scene.isothermal else BEYOND
        low, high = _along(scene, surface, _blend(factor) * grid.dx / factor + beyond)
        dx, all_nx = grid.dx / factor, grid.nx * factor
        nx = min(_multiple((high - low) / dx, COLUMNS), all_nx // COLUMNS * COLUMNS)
        spare = nx - (high - low) / dx
        row, ny = _rows(scene, surface, grid, factor) if grid.ny else (0, 0)
        back = round(-low / dx + spare / 2)
        return cls(factor, nx, ny, all_nx, grid.ny * factor, row, back,
                   float(grid.X[0]), float(grid.Y[0]), dx, grid.dy / factor, surface.pace,
                   back + 0.5 * sum(extent(scene, "x", surface)) / dx)

    def origin(self, X):
        """First fine column of the window with the first feature at X (a)."""
        column = round((self.pace * X - self.x_min) / self.dx) - self.back
        return min(max(column, 0), self.all_nx - self.nx)

    def columns(self, origin):
        """Positions X (nx+1,) of the columns, a; origin: first fine column."""
        return self.x_min + self.dx * np.arange(origin, origin + self.nx + 1)

    def core(self, columns, rows, origin):
        """Weight (rows, columns) of the window's values: 1 inside, 0 at its border, smooth between; 1 up to an end of the grid.

        columns, rows: numbers of nodes of the fine grid.
        """
        along = self._along(np.asarray(columns) - origin, self.nx, (origin == 0, origin + self.nx == self.all_nx))
        if not self.all_ny:
            return along[None, :]
        return self._along(np.asarray(rows) - self.row, self.ny, (self.row == 0, False))[:, None] * along

    def inside(self, origin):
        """Mask (ny+1, nx+1) of the window's nodes that belong to it: its weight is at least HALF."""
        return self.core(origin + np.arange(self.nx + 1), self.row + np.arange(self.ny + 1), origin) >= HALF

    def outside(self, origin):
        """Mask (rows, columns) of the run's nodes that do not belong to the window."""
        columns, rows = (self.factor * np.arange(cells // self.factor + 1) for cells in (self.all_nx, self.all_ny))
        return self.core(columns, rows, origin) < HALF

    def _along(self, at, cells, ends):
        """Weight (n,) along one axis at distances `at` (cells) from the first node; ends: whether each side is an end of the
        grid."""
        width = _blend(self.factor)
        low, high = (np.ones_like(at, float) if end else smooth(way / width) for end, way in zip(ends, (at, cells - at)))
        return low * high * ((at >= 0) & (at <= cells))


def _blend(factor):
    """Number of fine cells from the border to the part where the window's values have weight 1."""
    return given(factor) + MORE * factor


def _multiple(cells, of):
    """The smallest multiple of `of` that is at least `cells`."""
    return max(1, math.ceil(cells / of - 1e-9)) * of


def _along(scene, surface, beyond):
    """(from, to) of the window along x, a from the origin of its surface."""
    if width := scene.zoom.width_x:
        return -width / 2, width / 2
    low, high = changed(scene, surface)
    return low - beyond, high + beyond


def _rows(scene, surface, grid, factor):
    """(first fine row, number of fine cells along y)."""
    dy, (low, high) = grid.dy / factor, extent(scene, "y", surface)
    beyond = _blend(factor) * dy + BEYOND
    low, high = low - beyond, high + beyond
    if width := scene.zoom.width_y:
        low, high = 0.5 * (low + high - width), 0.5 * (low + high + width)
    if scene.symmetric:
        return 0, min(_multiple(high / dy, ROWS), (grid.ny - 1) * factor // ROWS * ROWS)
    ny = min(_multiple((high - low) / dy, ROWS), (grid.ny - 2) * factor // ROWS * ROWS)
    row = round((0.5 * (low + high) - grid.Y[0]) / dy - 0.5 * ny)
    return min(max(row, factor), grid.ny * factor - ny - factor), ny
