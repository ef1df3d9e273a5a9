"""The tables of one contact problem on its grids."""

import numpy as np

from tehl_taichi.engine import field_pool, runtime, simd
from tehl_taichi.engine.taichi_patches.prebound import Carriers, bind
from tehl_taichi.pressure import balances, fields, precision
from tehl_taichi.pressure.conditions import conditions
from tehl_taichi.pressure.deflection import bending
from tehl_taichi.pressure.grids import COARSEST_2D, Grids, coarsen, columns, load_weights, table_columns
from tehl_taichi.pressure.level_table import LevelNumbers
from tehl_taichi.scene.scales import Scales

DTYPES = {"f32": np.float32, "f64": np.float64}  # of the linear solves
HEAVY = 4  # work of a column in the laws and in the linearisation, in units of a copy


class Levels(Grids):
    """State table S, table of the linear problem J, numbers of the levels G and of the scene (conditions) on Grids.

    scene: the description; nx, ny, full, coarsest: see :class:`Grids`; scales, domain: units and extent, if not the scene's.
    The fields of the finest grid are read and written as arrays (ny+1, nx+1) with :meth:`get` and :meth:`put`. Vectors of the
    Krylov solver are flat arrays of `n` numbers of type `linear` in the order of the table, ghosts included.
    """

    def __init__(self, scene, nx, ny, full=False, scales=None, domain=None, coarsest=COARSEST_2D):
        scales = scales or Scales.of(scene)
        super().__init__(domain or scene.grid, scales, nx, ny, full, coarsest)
        self.scene, self.thins = scene, scene.shear_law.thins
        self.conditions = conditions(scene, scales, self.X)
        self.numbers = LevelNumbers(self, self.conditions, scene.rheology.film_floor)
        self.G, self.n = self.numbers.G, columns(nx, ny) * simd.W
        self._lease_tables()
        self.bending, self._carriers = bending(self), Carriers()
        self._set_masks()

    def _lease_tables(self):
        self.precision = precision.of(self.scene)
        self.linear = np.dtype(DTYPES[self.precision])
        rows = fields.NROWS if self.scene.isothermal else fields.NROWS_THERMAL
        size = max(table_columns(self.sizes), _final_columns(self.scene))
        self.S = field_pool.lease(self, rows, simd.W, size)
        self.J = field_pool.lease(self, fields.NROWS_LINEAR, simd.W, size, precision=self.precision)

    def _set_masks(self):
        inside = self._unknown_nodes()
        self.unknowns = int(inside.sum())
        self.put(fields.MASK, inside)
        self.put(fields.WEIGHT, load_weights(self))
        self._clear_ghosts(fields.MASK, fields.WEIGHT)
        self.inside = self.vector(fields.MASK)
        for l in range(len(self.sizes)):
            self._clear_level(l)

    def _unknown_nodes(self):
        """Mask (ny+1, nx+1): 1 where the pressure is unknown, else 0."""
        inside = np.zeros((self.ny + 1, self.nx + 1))
        inside[0 if self.line or self.mirrored else 1 : int(self.G[0, fields.JN]), 1:-1] = 1.0
        return inside

    def _clear_level(self, l):
        """Make level l dry with a film of 1 and diagonal 1, so that ghosts and borders stay finite."""
        nx, ny = self.sizes[l]
        ones = np.ones((ny + 1, nx + 1))
        carried = () if self.scene.isothermal else (fields.RHOC, fields.SKEW)
        for row in (fields.DRY, fields.H, fields.GAP, fields.RHO, fields.D, *carried):
            self.put(row, ones, l)

    def _clear_ghosts(self, *rows):
        """Set fields that must vanish in ghosts to 0; `put` repeats the last row there."""
        first, last = simd.W * (self.fine - 1), self.ny
        for row in rows:
            simd.clear_ghosts(self.S, self.G, row, last - first)

    def get(self, row, l=0):
        """Field `row` of level l as a new array (ny+1, nx+1), column-major."""
        return self._carry(simd.get, row, l).copy().T

    def put(self, row, values, l=0):
        """Set field `row` of level l from an array that broadcasts to (ny+1, nx+1)."""
        self._carry(simd.put, row, l, values)

    def vector(self, row):
        """Field `row` of the finest level as a new flat vector in table order."""
        return self._carry(balances.save, row).copy()

    def _carry(self, kernel, row, l=None, values=None):
        """Launch a kernel that copies between a field of level l (or in table order) and an array. Returns the array."""
        shape, place = self.n, (row,)
        if l is not None:
            (nx, ny), place = self.sizes[l], (l, row)
            shape = (nx + 1, ny + 1) if values is None else (ny + 1, nx + 1)
        return self._carriers.carry((kernel, row, l), shape,
                                    lambda array: self.launch(kernel, self.S, self.G, *place, array), values)

    def fill(self, kernel, count, *args):
        """New array (count, ny+1, nx+1), column-major, filled by kernel(S, G, *args, array); every call needs equal
        arguments.
        """
        shape = count, self.nx + 1, self.ny + 1
        array = self._carriers.carry(kernel, shape, lambda array: self._bound(kernel, self.S, self.G, *args, array))
        return array.copy().swapaxes(1, 2)

    def launch(self, kernel, *args, work=1):
        """Launch of `kernel`, whose last argument is `alone`; work: per column, in units of a copy.

        `alone` is equal for the smaller grids of a start and the finest one, because each variant of a kernel takes time to
        trace.
        """
        return self._bound(kernel, *args, runtime.alone(work * self.most_columns))

    def _bound(self, kernel, *args):
        if runtime.by_cells():
            from tehl_taichi.pressure.cells import twins

            return twins.launch(self, kernel, *args)
        return bind(kernel, *args)

    @property
    def most_columns(self):
        """Columns of the finest grid, or of the scene's: smaller grids of a start use its memory, and so its kernels."""
        return max(columns(self.nx, self.ny), columns(self.scene.grid.nx, self.scene.rows))

    def set_film(self, H0):
        """Compute H from the pressure in the table and the rigid approach H0."""
        self.bending.bend(H0)


def _final_columns(scene):
    """Columns of the finest grid of the scene; the steady start uses the same memory for its smaller tables."""
    return table_columns(coarsen(scene.grid.nx, scene.rows))
