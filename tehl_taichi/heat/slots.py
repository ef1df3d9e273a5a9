"""The table of a film with temperatures, Z[column, slot].

A column is a block of W rows at one x, as on the finest level of the state table; a slot is one quantity at one node of zeta,
or one of the column.
"""

import numpy as np

from tehl_taichi.engine import tables
from tehl_taichi.engine.lanes import Table, V, W, cells
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.launches import Carriers, bind

# nz numbers each from T on, then the single ones
# temperature, that of the last step and the one before; velocities; h int_0 rho (u, v, 1), the last one of the last two
# steps too; 1/eta, rho; temperature and pressure change at the departure points; temperature of the last round
T, TN, TNN, U, VY, MX, MY, MS, MSN, MSNN, NIE, NRHO, TS, PS, LAST = range(15)
KINDS = 15
# pressure of the last step and the one before (Pa); heat into the bodies; A of T_s = A + B q; stress of the Couette part;
# shear on the walls z = 0 and z = h
PN, PNN, QA, QB, AA, AB, TAU, XA, YA, XB, YB = range(11)
SINGLES = 11
SHEARS = 4  # from XA on


@ti.func
def slots_around(Z: ti.template(), at: ti.template(), q, slot):
    """Slot of column q, in the block of rows of the place `at`, at j - 1 and j + 1; where there is no such row, at j."""
    here, n2 = Z[q, slot], at.nx + 1
    before, behind = Z[q - (n2 if at.s > 0 else 0), slot][W - 1], Z[q + (n2 if at.s < at.ny // W else 0), slot][0]
    lower, upper = here, here
    for u in ti.static(range(W - 1)):
        lower[u + 1], upper[u] = here[u], here[u + 1]
    lower[0], upper[W - 1] = before, behind
    for u in ti.static(range(W)):  # chosen, not branched: that would keep what follows from vector instructions
        j = at.s * W + u
        lower[u], upper[u] = ti.select(j > 0, lower[u], here[u]), ti.select(j < at.ny, upper[u], here[u])
    return lower, upper


@ti.kernel
def get_slots(Z: ti.template(), G: Table, first: ti.i32, count: ti.i32, out: ti.types.ndarray(dtype=ti.f64, ndim=3)):
    """out (count, ny+1, nx+1) = the slots from `first` on."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        for i in range(nx + 1):
            for n in range(count):
                v = Z[s * (nx + 1) + i, first + n]
                for u in ti.static(range(W)):
                    if s * W + u <= ny:
                        out[n, s * W + u, i] = v[u]


@ti.kernel
def put_slots(Z: ti.template(), G: Table, first: ti.i32, count: ti.i32, values: ti.types.ndarray(dtype=ti.f64, ndim=3)):
    """The slots from `first` on = values (count, ny+1, nx+1); ghosts repeat the last row."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        for i in range(nx + 1):
            for n in range(count):
                v = V(0.0)
                for u in ti.static(range(W)):
                    v[u] = values[n, ti.min(s * W + u, ny), i]
                Z[s * (nx + 1) + i, first + n] = v


class SlotTable:
    """A table of `slots` slots on the finest grid of `levels`; read and written as arrays (slots, ny+1, nx+1)."""

    def __init__(self, levels, slots):
        self.levels, self.carriers = levels, Carriers()
        self.field = tables.lease(self, 0, W, levels.fine * (levels.nx + 1), slots)

    def get(self, first, count=1):
        """`count` slots from `first` on as a new array."""
        return self._carry(get_slots, first, count).copy()

    def put(self, first, values):
        """Set the slots from `first` on."""
        self._carry(put_slots, first, len(values), values)

    def _carry(self, kernel, first, count, values=None):
        v = self.levels
        return self.carriers.carry((kernel, first, count), (count, v.ny + 1, v.nx + 1),
                                   lambda array: bind(kernel, self.field, v.G, first, count, array), values)


class Columns(SlotTable):
    """The table Z of a film with nz nodes across: quantities at the nodes (nz, ny+1, nx+1), others (ny+1, nx+1), by name."""

    def __init__(self, levels, nz):
        super().__init__(levels, KINDS * nz + SINGLES)
        self.nz = nz

    def place(self, single):
        """Slot of one of the single quantities."""
        return KINDS * self.nz + single

    def nodes(self, kind):
        return self.get(kind * self.nz, self.nz)

    def put_nodes(self, kind, values):
        self.put(kind * self.nz, values)

    def single(self, name):
        return self.get(self.place(name))[0]

    def put_single(self, name, values):
        self.put(self.place(name), np.asarray(values)[None])
