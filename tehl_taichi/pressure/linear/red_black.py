"""Lines of the finest level in two colours (numerics.sweep = "red-black"): the second colour solves for the remaining residual.

Slower than all lines together, see docs/decisions/05.
"""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import L, W
from tehl_taichi.pressure.fields import COR, RES, SOL, TRIAL
from tehl_taichi.pressure.linear.blocks import block, number, take
from tehl_taichi.pressure.linear.convolution import M, buffer, clear, pair
from tehl_taichi.pressure.reynolds import reynolds_row

SWEEP = "red-black"  # choice of numerics.sweep
RED, BLACK, SPREAD, BENT, LEFT, ADDED = range(18, 24)  # operations, beside those of :mod:`schedule`


@ti.func
def keep_colour(F: ti.template(), first, n2, operation):
    """Set SOL to 0 in the rows of the other colour (every second row)."""
    kept = L(F.J, 0.0)
    for u in ti.static(range(W)):
        kept[u] = number(F, float((operation == RED) == (u % 2 == 0)))
    for k in range(first, first + n2):
        F.J[SOL, k] = F.J[SOL, k] * kept


@ti.func
def spread(F: ti.template(), C: ti.template(), G: ti.template(), j, w):
    """Take the present correction of a pair of blocks as a direction, and write it to the buffer."""
    first, second, n2 = pair(G, 0, j)
    a = buffer(C, w)
    for i in range(n2):
        take(F, first + i, second + i, a + i, F.J[COR, first + i], F.J[COR, second + i])
    clear(F.Y, a + n2, a + 2 * C[0, M])


@ti.func
def left(F: ti.template(), G: ti.template(), s):
    """RES of the finest level less the product of the Jacobian and the present correction."""
    first, end, off = block(G, s)
    for k in range(off + first, off + end):
        F.J[RES, k] = F.J[RES, k] - reynolds_row(F.J, k, end - first)


@ti.func
def add_first_colour(F: ti.template(), G: ti.template(), s):
    """Add the correction of the first colour to COR."""
    first, end, off = block(G, s)
    for k in range(off + first, off + end):
        F.J[COR, k] = F.J[COR, k] + F.J[TRIAL, k]
