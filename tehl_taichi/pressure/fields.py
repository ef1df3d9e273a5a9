"""Fields of the pressure problem in two tables; row = field, column = a block of W nodes, levels one after another.

S (double precision) holds the state and all that decides about convergence, J (in the precision of the scene) its linearisation
and the linear solve. Column k of a level = OFF + s (NX + 1) + i: i along x (rolling), block s holds the nodes j = W s ... W s +
W - 1 along y, one per lane. Capital letters are dimensionless (X = x/a, P = p/p_H, H = h R'/a^2). Lanes beyond the last row are
ghosts: MASK 0, always dry.
"""

import itertools
from dataclasses import dataclass

from tehl_taichi.engine.simd import JN, NX, NY, OFF  # noqa: F401  columns of the level table too

_row, _linear = itertools.count(), itertools.count()


def _rows(count):
    return [next(_linear) for _ in range(count)]


# S, the state
P = next(_row)  # pressure
H = next(_row)  # film thickness
GAP0 = next(_row)  # undeformed gap without the rigid approach H0: X^2/2 (+ Y^2/2) - feature
QOLD = next(_row)  # dx * (what d(rho H)/dT in its moving frame takes from old levels)
MASK = next(_row)  # 1 where P is unknown, 0 on the border and on ghosts
WEIGHT = next(_row)  # weight of P in the load
RHO = next(_row)  # density over rho_0
LE = next(_row)  # ln(eta / eta(p=0)), without a shear law
IE = next(_row)  # exp(-LE)
ROOT = next(_row)  # root of RHO / lambda: times that of a neighbour, in the mobility of the face between them
GAP = next(_row)  # film thickness, at least the floor: what the mobility sees
DLE = next(_row)  # d LE / dP
DRP = next(_row)  # d ROOT / dP
QP = next(_row)  # d(RHO H)/dP at fixed H
R = next(_row)  # residual of the Reynolds equation, times dx
D = next(_row)  # its diagonal
DRY = next(_row)  # 1 where P = 0 is the equation (cavitated, or outside the unknowns)
TOUCH = next(_row)  # 1 where H = H_floor is the equation (solid contact)
BASE = next(_row)  # flux to the next node along x by the difference g of P, as the last linearisation had it: BASE + RISE g,
RISE = next(_row)  # times the distance (laws that thin only)
NROWS = next(_row)
RHOC = NROWS  # with temperatures: density that the Couette flow carries, over rho_0 (isothermal: RHO)
QCP = next(_row)  # d(RHOC H)/dP at fixed H (isothermal: QP)
SKEW = next(_row)  # fluidity that the pressure flow feels over that of the Couette flow (isothermal: 1),
DSKEW = next(_row)  # and d SKEW/dP in the row behind
NROWS_THERMAL = next(_row)
STATE = (P, H, DRY, TOUCH)  # carried to the coarser levels
LAWS = (RHO, LE, IE, ROOT, GAP, DLE, DRP, QP)  # and these, which follow from them
FILM_LAWS = (RHOC, QCP, SKEW, DSKEW)  # of a film with temperatures


@dataclass(frozen=True)
class LawRows:
    """Rows of the table with the law values of a film, for its equations.

    couette: density in the Couette flow; slope: its derivative by P; skew: ratio of both fluidities, or -1 if they are equal;
    follow: all rows that the coarser levels need.
    """

    couette: int
    slope: int
    skew: int
    follow: tuple


ISOTHERMAL = LawRows(couette=RHO, slope=QP, skew=-1, follow=LAWS)
THERMAL = LawRows(couette=RHOC, slope=QCP, skew=SKEW, follow=LAWS + FILM_LAWS)

# J, the linear problem
A = _rows(4)  # row of the Jacobian: pressure of the nodes i-2, i-1, i, i+1
AU, AD = _rows(2)  # and of j+1, j-1
B = _rows(4)  # the same for the film
BU, BD = _rows(2)
STENCIL = (*A, AU, AD, *B, BU, BD)  # rows without a gap
EPS = next(_linear)  # sum of the four face mobilities of the row
SCALE = next(_linear)  # row scale of the Krylov norm
KIND = next(_linear)  # line solver: 0 dry, 1 Gauss-Seidel column, 2 column distributed with K^-1
RES = next(_linear)  # right-hand side handed to the preconditioner on this level
SOL = next(_linear)  # solution of the line solves
COR = next(_linear)  # correction of this level
TRIAL = next(_linear)  # pressure change that the Jacobian is applied to
FILM = next(_linear)  # film change that goes with it
BAND = _rows(7)  # factorised line systems
NROWS_LINEAR = next(_linear)

# columns of the level table, behind those of every table of grids (OFF, NX, NY, JN)
_col = itertools.count(JN + 1)
DX = next(_col)
DY = next(_col)
CT = next(_col)  # dx times the weight of the newest level in d/dT (0: steady)
FRAME = next(_col)  # speed over u_m of the frame in which d/dT is taken (0: at rest)
K0 = next(_col)  # deflection of a node by its own unit pressure
K1 = next(_col)  # and by that of its neighbour in x
FLOOR = next(_col)  # film floor H_min
ILAM = next(_col)  # 1/lambda; larger than that of the scene while a steady start is approached through slower ones
WALL = next(_col)  # Pa on both walls of a film H = 1 by a difference of P of 1 along x
P_H = next(_col)  # Pa of P = 1
SHEAR = next(_col)  # Newtonian stress (Pa) on body a of oil at p = 0 in a film H = 1, by the slip
LINES = next(_col)  # 1 where lines are solved, 0 where corrections only pass through
NCOLS = next(_col)
