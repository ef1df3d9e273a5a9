"""All state of the pressure problem in one table: row = field, column = node, levels one after another.

Node k of a level = OFF + j (NX + 1) + i, i along x (rolling), j along y. Capital letters are dimensionless (X = x/a,
P = p/p_H, H = h R'/a^2). One table keeps a kernel's argument list at three entries and compiles it once for every size.
"""

import itertools

_row = itertools.count()

P = next(_row)  # pressure
H = next(_row)  # film thickness
GAP0 = next(_row)  # undeformed gap without the rigid approach H0: X^2/2 (+ Y^2/2) - feature
QOLD = next(_row)  # dx * (old levels of d(rho H)/dT)
RHO = next(_row)  # density over rho_0
DRHO = next(_row)  # d RHO / dP
LE = next(_row)  # ln(eta / eta(p=0))
DLE = next(_row)  # d LE / dP
IE = next(_row)  # exp(-LE)
MOB = next(_row)  # RHO H^3 / lambda: the mobility without its viscosity
QP = next(_row)  # d(RHO H)/dP at fixed H
EX = next(_row)  # mobility at the face i+1/2, over dx
EY = next(_row)  # mobility at the face j+1/2, times dx/dy^2
CX = [next(_row) for _ in range(4)]  # linearised x face flux: P_l, P_r, H_l, H_r
CY = [next(_row) for _ in range(4)]  # linearised y face flux
R = next(_row)  # residual of the Reynolds equation, times dx
D = next(_row)  # its diagonal, the row scale
DRY = next(_row)  # 1 where P = 0 is the equation (cavitated, or outside the unknowns)
TOUCH = next(_row)  # 1 where H = H_floor is the equation (solid contact)
KIND = next(_row)  # line solver: 0 dry, 1 Gauss-Seidel column, 2 column distributed with K^-1
RES = next(_row)  # right-hand side handed to the preconditioner on this level
SOL = next(_row)  # solution of the line solves
COR = next(_row)  # correction of this level
NROWS = next(_row)

# columns of the level table
_col = itertools.count()
OFF = next(_col)  # first node
NX = next(_col)  # cells along x
NY = next(_col)  # cells along y (0: one-dimensional)
JN = next(_col)  # rows that carry unknowns (NY + 1 for a line contact, NY for P = 0 at the outer row)
DX = next(_col)
DY = next(_col)
CT = next(_col)  # dx times the weight of the newest level in d/dT (0: steady)
K0 = next(_col)  # deflection of a node by its own unit pressure
K1 = next(_col)  # and by that of its neighbour in x
FLOOR = next(_col)  # film floor H_min
SPREAD = next(_col)  # first entry of this level in the buffers of the distribution transform
PERIOD = next(_col)  # and its row length there
NCOLS = next(_col)
