"""Tables of a thermal film: Z[kind, column * nz + node] at the nodes of zeta, C[column, single] for columns.

A column is a block of W rows at one x, as on the finest level of the state table. Data are stored kind after kind, so that a
kernel reads contiguous memory. Stored column after column (146 numbers each) kernels wait for memory: on one core and 256x64x9,
ms per call, velocities 3.6 (now 2.7), departures 4.3 (2.4), energy 7.2 (5.0), laws 2.2 (1.9).
"""

import numpy as np

from tehl_taichi.engine import field_pool
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import Table, V, W, cells, columns_around, rows_around
from tehl_taichi.engine.taichi_patches.prebound import Carriers, bind
from tehl_taichi.laws.viscosity import parts

Fields = ti.types.ndarray(dtype=ti.f64, ndim=3)

# temperature, that of the last step and the one before; velocities; h int_0 rho (u, v, 1), the last one of the last two
# steps too; 1/eta, rho; temperature and pressure change at the departure points; temperature before a round; result of the
# round before that and what it changed (:mod:`tehl_taichi.heat.relaxation`)
T, TN, TNN, U, VY, MX, MY, MS, MSN, MSNN, NIE, NRHO, TS, PS, LAST, CAME, CHANGED = range(17)
KEPT = 17  # and from here on what of the viscosity depends on the temperature alone, where its law has such parts
# pressure of the last step and the one before (Pa); heat into the bodies; A of T_s = A + B q; stress of the Couette part;
# gradient of the pressure (Pa/m); shear on the walls z = 0 and z = h; pressure (Pa) and film (m) of the last round; squares of
# what extrapolations would have missed, in the frame of the contact and in that of the feature; heat of the slip along walls;
# products of changes by rounds (:mod:`tehl_taichi.heat.relaxation`)
PN, PNN, QA, QB, AA, AB, TAU, PX, PY, XA, YA, XB, YB, PL, HL, STILL, MOVING, SA, SB, TURNED, BENT, STILLED = range(22)
SINGLES = 22
# report[tile, ...]: largest change of T against the last iterate (K), columns that did not converge, nodes held in range, and 1
# where the tile rests (:mod:`tehl_taichi.heat.skip_tiles`)
CHANGE, FAILED, HELD, RESTS = range(4)
TOLD = 4


@ti.func
def nodes_around(Z: ti.template(), at: ti.template(), kind: ti.template(), nz, n):
    """Values of a kind at node n of the place `at`, at j - 1 and j + 1."""
    before, behind = columns_around(at, at.q)
    return rows_around(at, Z[kind, at.q * nz + n], Z[kind, before * nz + n], Z[kind, behind * nz + n])


@ti.func
def address(by_kind: ti.template(), place, count, q, n):
    """(row, column) of the n-th of `count` numbers of column q: of the kind `place`, or of the slots from `place` on."""
    row, column = q, place + n
    if ti.static(by_kind):
        row, column = place, q * count + n
    return row, column


@ti.kernel
def get(F: ti.template(), G: Table, by_kind: ti.template(), place: ti.i32, out: Fields):
    """Copy the numbers at `place` to `out` (count, ny+1, nx+1)."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        for i in range(nx + 1):
            for n in range(out.shape[0]):
                row, column = address(by_kind, place, out.shape[0], s * (nx + 1) + i, n)
                v = F[row, column]
                for u in ti.static(range(W)):
                    if s * W + u <= ny:
                        out[n, s * W + u, i] = v[u]


@ti.kernel
def put(F: ti.template(), G: Table, by_kind: ti.template(), place: ti.i32, values: Fields):
    """Copy `values` (count, ny+1, nx+1) to the numbers at `place`; ghosts repeat the last row."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        for i in range(nx + 1):
            for n in range(values.shape[0]):
                v = V(0.0)
                for u in ti.static(range(W)):
                    v[u] = values[n, ti.min(s * W + u, ny), i]
                row, column = address(by_kind, place, values.shape[0], s * (nx + 1) + i, n)
                F[row, column] = v


class SlotTable:
    """Table F[column, slot] on the finest grid of `levels`; its arrays are (slots, ny+1, nx+1)."""

    by_kind = False  # how it lies in its field, see :func:`address`

    def __init__(self, levels, slots):
        self.levels, self.carriers = levels, Carriers()
        self.field = field_pool.lease(self, 0, W, levels.most_columns, slots)

    def get(self, first, count=1):
        """New array of `count` slots from `first` on."""
        return self._carry(get, first, count).copy()

    def put(self, first, values):
        """Set the slots from `first` on."""
        self._carry(put, first, len(values), values)

    def _carry(self, kernel, place, count, values=None):
        v = self.levels
        return self.carriers.carry((kernel, place, count), (count, v.ny + 1, v.nx + 1),
                                   lambda array: bind(kernel, self.field, v.G, self.by_kind, place, array), values)


class FilmTables(SlotTable):
    """Tables Z (field) and C (singles) of a film with nz nodes across: quantities at the nodes (nz, ny+1, nx+1), others (ny+1,
    nx+1), by name.
    """

    by_kind = True

    def __init__(self, levels, nz):
        self.levels, self.carriers, self.nz = levels, Carriers(), nz
        self.field = field_pool.lease(self, KEPT + parts(levels.scene.oil), W, levels.most_columns, each=nz)
        self.singles = SlotTable(levels, SINGLES)

    def nodes(self, kind):
        return self.get(kind, self.nz)

    def put_nodes(self, kind, values):
        self.put(kind, values)

    def single(self, name):
        return self.singles.get(name)[0]

    def put_single(self, name, values):
        self.singles.put(name, np.asarray(values)[None])
