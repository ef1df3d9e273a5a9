"""The grids of one contact problem and their state table."""

import numpy as np

from tehl_taichi.engine import lanes, runtime, tables
from tehl_taichi.engine.launches import Carriers, bind
from tehl_taichi.physics.gap import undeformed
from tehl_taichi.pressure import balances, fields, influence, precision, reynolds
from tehl_taichi.pressure.conditions import conditions
from tehl_taichi.pressure.deflection import Deflection

COARSEST_2D = 16  # cells along x below which no coarser grid is made
COARSEST_1D = 32
DENSE_LIMIT = 700  # nodes up to which the coarsest grid is solved directly
DTYPES = {"f32": np.float32, "f64": np.float64}  # of the linear solves
HEAVY = 4  # work of a column in the laws and in the linearisation, in units of a copy
PAD = 4  # columns in front of the first and behind the last level that stencils may touch


class Levels:
    """State table S, table of the linear problem J, level table G and the constants of one contact on a grid of nx x ny
    cells and its coarser ones.

    scene: the description; scales: its Hertz units; nx, ny: cells (ny = 0: one-dimensional); full: from -y_max instead of
    from the plane of symmetry (the lower edge of a line contact is then a mirror far away). The fields of the finest
    grid are read and written as arrays (ny+1, nx+1) with :meth:`get` and :meth:`put`. Vectors of the Krylov solver are
    flat arrays of `n` numbers of type `linear` in the order of the table, ghosts included.
    """

    def __init__(self, scene, scales, nx, ny, full=False):
        self.scene, self.scales, self.line = scene, scales, scales.line
        self.precision = precision.of(scene)
        self.linear = np.dtype(DTYPES[self.precision])
        self.nx, self.ny, self.mirrored = nx, ny, scales.line or not full
        grid, y_max = scene.grid, scene.grid.y_max * scales.b / scales.a
        self.X = np.linspace(grid.x_min, grid.x_max, nx + 1)
        self.Y = np.linspace(-y_max if full else 0.0, y_max, ny + 1) if ny else np.zeros(1)
        # not as differences: the coarser levels of all grids of a start then have the very same spacings
        self.dx, self.dy = (grid.x_max - grid.x_min) / nx, (2 if full else 1) * y_max / ny if ny else 1.0
        self.middle = int(np.argmin(np.abs(self.Y))) if not self.line else ny  # row of a central film without feature
        self.sizes = coarsen(nx, ny)
        self.dense, self.lines = solved_by(self.sizes)
        self.blocks = self._blocks([*self.lines, *self.dense])
        self.fine = self.sizes[0][1] // lanes.W + 1  # blocks of the finest grid
        self.G = self._level_table()
        self.n = columns(nx, ny) * lanes.W
        self.thins = scene.shear_law.thins
        rows = (fields.NROWS_SHEARED if self.thins else fields.NROWS) if scene.isothermal else fields.NROWS_THERMAL
        size = max(table_columns(nx, ny), _final_columns(scene))
        self.S = tables.lease(self, rows, lanes.W, size)
        self.J = tables.lease(self, fields.NROWS_LINEAR, lanes.W, size, precision=self.precision)
        self.conditions = conditions(scene, scales, self.X)
        self.deflection, self._carriers = self.deflection_of(0), Carriers()
        self._set_laws()
        self._bind()
        self._set_masks()

    def _level_table(self):
        G = np.zeros((len(self.sizes), fields.NCOLS))
        off = PAD + self.nx + 1
        for l in range(len(self.sizes)):
            nx, ny, dx, dy = self.grid(l)
            rows = ny + 1 if self.line else ny
            near = self.near_kernel(l)[0]
            numbers = {fields.OFF: off, fields.NX: nx, fields.NY: ny, fields.JN: rows, fields.DX: dx, fields.DY: dy,
                       fields.K0: near[0], fields.K1: near[1], fields.FLOOR: self.scene.rheology.film_floor,
                       fields.LINES: l in self.lines}
            G[l, list(numbers)] = list(numbers.values())
            off += columns(nx, ny)
        return G

    def _blocks(self, levels):
        """(level, block) of all blocks of these levels."""
        return np.array([(l, s) for l in levels for s in range(self.sizes[l][1] // lanes.W + 1)], np.int32)

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
        # the outermost row of a line contact goes on to infinity on one side only
        return np.vstack([inner, 0.5 * (inner + strip) if self.line else inner])

    def deflection_of(self, l, dtype=float):
        """Deflection operator of level l."""
        return Deflection(*self.deflection_key(l), dtype)

    def deflection_key(self, l):
        """What the deflection of level l depends on: cells, spacings, compliance, line, mirrored."""
        return (*self.grid(l), self.scales.compliance, self.line, self.mirrored)

    def _set_laws(self):
        s, now = self.scales, self.conditions
        self.inv_lambda = 1 / (12 * now["eta0"] * s.u_m * s.R**2 / (s.a**3 * s.p_H))
        self.shear = -now["u_s"] * now["eta0"] / s.h
        self.slow_down(1.0)
        self.slip(1.0)

    def _bind(self):
        """Launches of the kernels that this table is used with."""
        d = self.deflection
        self._pressure_rows = self.launch(reynolds.pressure_rows, self.S, self.G, d.pressure.ravel(), d.pressure.shape[1])
        self._set_film = self.launch(reynolds.set_film, self.S, self.G, d.film.ravel(), d.edge, d.film.shape[1])

    def slow_down(self, factor):
        """Take the speed of the film's balance to be that of the scene over `factor`."""
        self.G[:, fields.ILAM] = factor * self.inv_lambda

    def slip(self, part):
        """Take the slip that the shear law acts by to be this part of that of the scene; 0: a Newtonian film."""
        self.G[:, fields.SHEAR] = part * self.shear

    def _set_masks(self):
        inside = np.zeros((self.ny + 1, self.nx + 1))
        inside[0 if self.mirrored else 1 : int(self.G[0, fields.JN]), 1:-1] = 1.0
        self.unknowns = int(inside.sum())
        self.put(fields.MASK, inside)
        self.put(fields.WEIGHT, load_weights(self))
        self._clear_ghosts(fields.MASK, fields.WEIGHT)
        self.inside = self.vector(fields.MASK)
        for l in range(len(self.sizes)):
            self._clear_level(l)
        lanes.put(self.J, self.G, 0, fields.SCALE, np.ones((self.ny + 1, self.nx + 1)), True)

    def _clear_level(self, l):
        """Everything dry with a film of 1 and the diagonal 1, so that ghosts and borders stay finite."""
        nx, ny = self.sizes[l]
        ones = np.ones((ny + 1, nx + 1))
        carried = () if self.scene.isothermal else (fields.RHOC,)
        for row in (fields.DRY, fields.H, fields.GAP, fields.RHO, fields.D, *carried):
            self.put(row, ones, l)

    def _clear_ghosts(self, *rows):
        """`put` repeats the last row in the ghosts; these fields must vanish there."""
        first, last = lanes.W * (self.fine - 1), self.ny
        for row in rows:
            lanes.clear_ghosts(self.S, self.G, row, last - first)

    def get(self, row, l=0):
        """Field `row` of level l as a new array (ny+1, nx+1)."""
        return self._carry(lanes.get, row, l).copy()

    def put(self, row, values, l=0):
        """Set field `row` of level l from an array that broadcasts to (ny+1, nx+1)."""
        self._carry(lanes.put, row, l, values)

    def vector(self, row):
        """Field `row` of the finest level as a new flat vector in table order."""
        return self._carry(balances.save, row).copy()

    def _carry(self, kernel, row, l=None, values=None):
        """Launch a kernel between a field of level l (or in table order) and an array. Returns the array."""
        shape, place = self.n, (row,)
        if l is not None:
            shape, place = (self.sizes[l][1] + 1, self.sizes[l][0] + 1), (l, row)
        return self._carriers.carry((kernel, row, l), shape,
                                    lambda array: self.launch(kernel, self.S, self.G, *place, array), values)

    def fill(self, kernel, shape, *args):
        """A new array of this shape that kernel(S, G, *args, array) fills, for the same arguments every time."""
        return self._carriers.carry(kernel, shape, lambda array: bind(kernel, self.S, self.G, *args, array)).copy()

    def launch(self, kernel, *args, work=1):
        """A launch of `kernel`, whose last argument is `alone`; work: of one column, in units of a copy.

        The same for the smaller grids of a start as for the finest: either way of a kernel takes time to trace.
        """
        largest = max(columns(self.nx, self.ny), columns(self.scene.grid.nx, self.scene.rows))
        return bind(kernel, *args, runtime.alone(work * largest))

    def set_film(self, H0):
        """H from the pressure in the table and the rigid approach H0."""
        self._pressure_rows()
        self.deflection.deflect(H0)
        self._set_film()

    def set_rate(self, weight, frame=0.0):
        """Weight of the newest level in d/dT, 1/T units (0: steady), scaled with dx on every level; frame: speed over u_m of
        the frame in which it is taken."""
        self.G[:, fields.CT] = weight * self.G[:, fields.DX]
        self.G[:, fields.FRAME] = frame


def load_weights(levels):
    """Weights w (ny+1, nx+1) such that sum(w P) is the load (model.md section 4, Hertz units).

    Line: the mean over y (trapezoid over the stored rows) of int P dX = pi/2; point: the double integral, both halves.
    """
    w_y = np.full((levels.ny + 1, 1), levels.dx)
    if levels.ny:
        w_y[0] *= 0.5
        if not levels.line:
            w_y *= 2 * levels.dy if levels.mirrored else levels.dy
        else:
            w_y[-1] *= 0.5
            w_y /= levels.ny
    return np.broadcast_to(w_y, (levels.ny + 1, levels.nx + 1))


def coarsen(nx, ny):
    """Sizes of the grids from (nx, ny) down."""
    sizes = [(nx, ny)]
    while _can_halve(*sizes[-1]):
        sizes.append((sizes[-1][0] // 2, sizes[-1][1] // 2))
    return sizes


def solved_by(sizes):
    """Levels that are solved as a dense matrix (the coarsest, if it is small) and by lines: of the others every second one.

    Krylov iterations a step, gear on 128 / 256 / 512 columns: with lines on all levels 16.7 / 18.6 / 19.5, on every second one
    17.2 / 18.2 / 20.3, at 0.9 of the time of an iteration and 0.8 of that of a linearisation.
    """
    (nx, ny), last = sizes[-1], len(sizes) - 1
    if last > 0 and (nx + 1) * (ny + 1) <= DENSE_LIMIT:
        return [last], list(range(0, last, 2))
    return [], [*range(0, last, 2), last]


def _can_halve(nx, ny):
    if nx % 2 or ny % 2:
        return False
    return nx // 2 >= COARSEST_1D if ny == 0 else nx // 2 >= COARSEST_2D and ny // 2 >= 3


def columns(nx, ny):
    """Columns of one grid in the state table."""
    return (ny // lanes.W + 1) * (nx + 1)


def table_columns(nx, ny):
    """Columns of all its grids, with what stencils touch in front and behind."""
    return sum(columns(*size) for size in coarsen(nx, ny)) + 2 * (PAD + nx + 1)


def _final_columns(scene):
    """Columns of the finest grid of the scene: the steady start takes its smaller tables from the same memory."""
    return table_columns(scene.grid.nx, scene.rows)
