"""Grid transfers between each level and the next coarser one (every second node), all levels in one launch.

The transfers to and from the finest level run in parallel; the others are too small for that and run in one thread.
"""

import taichi as ti

from tehl_taichi.kernels.fields import COR, DRY, JN, RES, TOUCH, H, P
from tehl_taichi.kernels.reynolds import Table, cells


@ti.func
def inject_row(S: ti.template(), G: ti.template(), l, J):
    nx, ny, off = cells(G, l)
    mx, my, coff = cells(G, l + 1)
    for I in range(mx + 1):
        c, k = coff + J * (mx + 1) + I, off + 2 * J * (nx + 1) + 2 * I
        for row in ti.static((P, H, DRY, TOUCH)):
            S[row, c] = S[row, k]


@ti.kernel
def inject(S: Table, G: Table, levels: ti.i32):
    """State and sets of every coarser level from the coinciding nodes of the finest."""
    for _ in range(1):
        for l in range(levels - 1):
            for J in range(cells(G, l + 1)[1] + 1):
                inject_row(S, G, l, J)


@ti.func
def wet(S: ti.template(), k):
    return S[RES, k] * (1.0 - S[DRY, k])


@ti.func
def weighted_row(S: ti.template(), k):
    return 0.5 * wet(S, k) + 0.25 * (wet(S, k - 1) + wet(S, k + 1))


@ti.func
def restrict_row(S: ti.template(), G: ti.template(), l, J):
    nx, ny, off = cells(G, l)
    mx, my, coff = cells(G, l + 1)
    mirrored_top = int(G[l, JN]) == ny + 1
    for I in range(mx + 1):
        c, k = coff + J * (mx + 1) + I, off + 2 * J * (nx + 1) + 2 * I
        s = 0.0
        if S[DRY, c] == 0.0:
            s = weighted_row(S, k)
            if ny > 0:
                below = k - nx - 1 if J > 0 else k + nx + 1
                above = k + nx + 1 if J < my else k - nx - 1
                s = 0.5 * s + 0.25 * weighted_row(S, below)
                if J < my or mirrored_top:
                    s += 0.25 * weighted_row(S, above)
        S[RES, c] = 2.0 * s


@ti.kernel
def restrict(S: Table, G: Table, levels: ti.i32):
    """RES of the coarser levels: twice the full weighting (rows carry dx), 0 at dry nodes of either level."""
    for J in range(cells(G, 1)[1] + 1):
        restrict_row(S, G, 0, J)
    for _ in range(1):
        for l in range(1, levels - 1):
            for J in range(cells(G, l + 1)[1] + 1):
                restrict_row(S, G, l, J)


@ti.func
def prolong_row(S: ti.template(), G: ti.template(), l, j, damping):
    nx, ny, off = cells(G, l)
    mx, my, coff = cells(G, l + 1)
    for i in range(1, nx):
        k = off + j * (nx + 1) + i
        if S[DRY, k] == 0.0:
            c = coff + j // 2 * (mx + 1) + i // 2
            right, up = i % 2, (j % 2) * (mx + 1)
            v = S[COR, c] + S[COR, c + right] + S[COR, c + up] + S[COR, c + up + right]
            S[COR, k] += damping * 0.25 * v


@ti.kernel
def prolong(S: Table, G: Table, levels: ti.i32, damping: ti.f64):
    """COR of each level += damping * bilinear interpolation of the next coarser one, from coarse to fine, where wet."""
    for _ in range(1):
        for step in range(levels - 2):
            l = levels - 2 - step
            for j in range(cells(G, l)[1] + 1):
                prolong_row(S, G, l, j, damping)
    for j in range(cells(G, 0)[1] + 1):
        prolong_row(S, G, 0, j, damping)
