"""Grid transfers between a level l and the next coarser one, l + 1 (every second node)."""

import taichi as ti

from tehl_taichi.kernels.fields import COR, DRY, H, JN, P, RES, TOUCH
from tehl_taichi.kernels.reynolds import Table, cells


@ti.kernel
def inject(S: Table, G: Table, l: ti.i32):
    """State and sets of level l + 1 from the coinciding nodes of level l."""
    nx, ny, off = cells(G, l)
    mx, my, coff = cells(G, l + 1)
    for J in range(my + 1):
        for I in range(mx + 1):
            c, k = coff + J * (mx + 1) + I, off + 2 * J * (nx + 1) + 2 * I
            for row in ti.static((P, H, DRY, TOUCH)):
                S[row, c] = S[row, k]


@ti.func
def wet(S: ti.template(), k):
    return S[RES, k] * (1.0 - S[DRY, k])


@ti.func
def weighted_row(S: ti.template(), k):
    return 0.5 * wet(S, k) + 0.25 * (wet(S, k - 1) + wet(S, k + 1))


@ti.kernel
def restrict(S: Table, G: Table, l: ti.i32):
    """RES of level l + 1: twice the full weighting (rows are scaled with dx), 0 at dry nodes of either level."""
    nx, ny, off = cells(G, l)
    mx, my, coff = cells(G, l + 1)
    mirrored_top = int(G[l, JN]) == ny + 1
    for J in range(my + 1):
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
def prolong(S: Table, G: Table, l: ti.i32, damping: ti.f64):
    """COR of level l += damping * bilinear interpolation of COR of level l + 1, on wet nodes only."""
    nx, ny, off = cells(G, l)
    mx, my, coff = cells(G, l + 1)
    for j in range(ny + 1):
        for i in range(1, nx):
            k = off + j * (nx + 1) + i
            if S[DRY, k] == 0.0:
                c = coff + j // 2 * (mx + 1) + i // 2
                right, up = i % 2, (j % 2) * (mx + 1)
                v = S[COR, c] + S[COR, c + right] + S[COR, c + up] + S[COR, c + up + right]
                S[COR, k] += damping * 0.25 * v
