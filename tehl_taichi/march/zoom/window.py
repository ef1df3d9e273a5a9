"""Place of the window of a zoom: nodes of a grid that is `factor` times as fine as that of the run."""

import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi.pressure.grids import Grids
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.zoom_room import extent

GIVEN, LEAST = 2, 8  # cells of the run, and of the window at least, along its border where the pressure of the run is given:
# three paths of oil begin there, with the nodes of their interpolation. Window of factor 1 on 128 columns (one dimension, pure
# rolling), largest difference from the run, GPa: 2 cells 0.096, 8 cells 3e-5
MORE = 1  # cells of the run beyond these, over which the pressures of run and window give way to each other
BEYOND = 0.05  # a, between that and what the feature does
HALF = 0.5  # of the core's weight: from there on a node is the window's
COLUMNS, ROWS = 32, 8  # the window has a multiple of so many cells: few sizes, few coarse levels


def given(factor):
    """Cells of the window along its border where the pressure is given."""
    return max(GIVEN * factor, LEAST)


def smooth(t):
    """0 to 1 for t from 0 to 1, with two continuous derivatives."""
    t = np.clip(t, 0.0, 1.0)
    return t**3 * (10 - 15 * t + 6 * t * t)


@dataclass(frozen=True)
class Window:
    """factor; cells `nx`, `ny` of the window and `all_nx`, `all_ny` of the whole fine grid (ny = 0: one row); `row`: its first
    row; `back`: its cells behind the centre of the first feature; x_min, y_min, dx, dy: of the fine grid, a."""

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

    @classmethod
    def of(cls, scene, factor):
        """The window of a scene round the features of the surface that carries its first one."""
        grid = Grids(scene.grid, Scales.of(scene), scene.grid.nx, scene.rows, not scene.symmetric)
        low, high = _along(scene, _blend(factor) * grid.dx / factor + BEYOND)
        dx, all_nx = grid.dx / factor, grid.nx * factor
        nx = min(_multiple((high - low) / dx, COLUMNS), all_nx // COLUMNS * COLUMNS)
        spare = nx - (high - low) / dx
        row, ny = _rows(scene, grid, factor) if grid.ny else (0, 0)
        return cls(factor, nx, ny, all_nx, grid.ny * factor, row, round(-low / dx + spare / 2),
                   float(grid.X[0]), float(grid.Y[0]), dx, grid.dy / factor)

    def origin(self, X):
        """First fine column of the window with the first feature at X (a)."""
        column = round((X - self.x_min) / self.dx) - self.back
        return min(max(column, 0), self.all_nx - self.nx)

    def columns(self, origin):
        """Places (a) of its columns."""
        return self.x_min + self.dx * np.arange(origin, origin + self.nx + 1)

    def core(self, columns, rows, origin):
        """(rows, columns): 1 where the pressure is the window's, 0 at its border, smooth between; 1 up to the ends of the grid.
        columns, rows: numbers of nodes of the fine grid."""
        along = self._along(np.asarray(columns) - origin, self.nx, (origin == 0, origin + self.nx == self.all_nx))
        if not self.all_ny:
            return along[None, :]
        return self._along(np.asarray(rows) - self.row, self.ny, (self.row == 0, False))[:, None] * along

    def inside(self, origin):
        """(rows, columns): whether a node of the window is its own, not given way to the run."""
        return self.core(origin + np.arange(self.nx + 1), self.row + np.arange(self.ny + 1), origin) >= HALF

    def outside(self, origin):
        """(rows, columns): whether a node of the whole grid of the run is not the window's."""
        columns, rows = (self.factor * np.arange(cells // self.factor + 1) for cells in (self.all_nx, self.all_ny))
        return self.core(columns, rows, origin) < HALF

    def _along(self, at, cells, ends):
        width = _blend(self.factor)
        low, high = (np.ones_like(at, float) if end else smooth(way / width) for end, way in zip(ends, (at, cells - at)))
        return low * high * ((at >= 0) & (at <= cells))


def _blend(factor):
    """Cells of the window, from its border on, over which it gives way to the run."""
    return given(factor) + MORE * factor


def _multiple(cells, of):
    return max(1, math.ceil(cells / of - 1e-9)) * of


def _along(scene, beyond):
    """From where to where (a, from the centre of the first feature) the window reaches along x: the oil that has passed over a
    feature is ahead of it or behind, by twice the half-width at most."""
    if width := scene.zoom.width_x:
        return -width / 2, width / 2
    lead = 2.0 * (scene.operation.u_m / scene.reference.speed - 1.0)
    low, high = extent(scene, "x")
    return low + min(lead, 0.0) - beyond, high + max(lead, 0.0) + beyond


def _rows(scene, grid, factor):
    """First fine row and number of rows."""
    dy, (low, high) = grid.dy / factor, extent(scene, "y")
    beyond = _blend(factor) * dy + BEYOND
    low, high = low - beyond, high + beyond
    if width := scene.zoom.width_y:
        low, high = 0.5 * (low + high - width), 0.5 * (low + high + width)
    if scene.symmetric:
        return 0, min(_multiple(high / dy, ROWS), (grid.ny - 1) * factor // ROWS * ROWS)
    ny = min(_multiple((high - low) / dy, ROWS), (grid.ny - 2) * factor // ROWS * ROWS)
    row = round((0.5 * (low + high) - grid.Y[0]) / dy - 0.5 * ny)
    return min(max(row, factor), grid.ny * factor - ny - factor), ny
