"""Relaxation of the rounds that alternate pressure and temperatures, at each place by its own last two changes.

At the outlet of a hot film a few columns follow their pressure back and forth, or creep, each by itself. So each place takes
the share of its last change that would have left the least of the newest one, there and at its neighbours (Anderson's method
of depth 1, Walker & Ni 2011, with local products): x + f - share (x + f - the last x + f), where f is what a round changed.
"""

from tehl_taichi.engine.elementary import maximum, minimum
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import Table, V, block_at, cells, tile, tiles
from tehl_taichi.heat.energy import HOT, largest_row
from tehl_taichi.heat.extrapolation import around
from tehl_taichi.heat.film import keep_parts
from tehl_taichi.heat.film_tables import BENT, CAME, CHANGE, CHANGED, LAST, RESTS, STILLED, TURNED, T

NOTHING = 1e-12  # K^2: smaller squares count as zero
CREEP, BACK = -2.0, 0.8  # limits of the share: a change is tripled at most, or a fifth of it is taken
# Work of a window four times as fine at the exit (32 steps; SRR 0.12, 256x64x9): Newton steps, temperature solves. One share
# for all columns (Aitken) 303, 192; columns solved for to the end (FIRST_LEAVES of :mod:`tehl_taichi.heat.energy`) 266, 155;
# then shares by the products at each node alone 287, 174, around it 254, 143, of 5x5 nodes 256, 145, of 7x7 256, 145; around
# it, but a share of the change itself (Aitken) 258, 147; with the first round, whose pressure is a guess, 257, 146


@ti.func
def measure(Z: ti.template(), C: ti.template(), q, nz):
    """Store the products of the newest change of a column with what changed of it."""
    turned, bent, stilled = V(0.0), V(0.0), V(0.0)
    for at in range(q * nz, q * nz + nz):
        change = Z[T, at] - Z[LAST, at]
        bend = change - Z[CHANGED, at]
        turned, bent, stilled = turned + change * bend, bent + bend * bend, stilled + change * change
    C[q, TURNED], C[q, BENT], C[q, STILLED] = turned, bent, stilled


@ti.func
def rest(Z: ti.template(), C: ti.template(), q, nz):
    """Store that a column has not changed."""
    C[q, TURNED], C[q, BENT], C[q, STILLED] = V(0.0), V(0.0), V(0.0)
    for at in range(q * nz, q * nz + nz):
        Z[CAME, at], Z[CHANGED, at] = Z[T, at], V(0.0)


@ti.func
def share_of(C: ti.template(), at: ti.template(), quiet):
    """Share of a place, see above; 0 where its newest change is quiet."""
    share = around(C, at, TURNED) / (around(C, at, BENT) + NOTHING)
    return ti.select(around(C, at, STILLED) > quiet * quiet, minimum(maximum(share, CREEP), BACK), V(0.0))


@ti.func
def turn(Z: ti.template(), q, nz, share, coldest):
    """Relax a column, and store its result and change. Returns the largest change by this in each row (K)."""
    moved = V(0.0)
    for at in range(q * nz, q * nz + nz):
        came = Z[T, at]
        relaxed = minimum(maximum(came - share * (came - Z[CAME, at]), coldest), HOT)
        Z[CAME, at], Z[CHANGED, at], Z[T, at] = came, came - Z[LAST, at], relaxed
        moved = maximum(moved, ti.abs(relaxed - came))
    return moved


@ti.kernel
def relax(Z: ti.template(), C: ti.template(), G: Table, nz: ti.i32, oil: ti.template(), known: ti.f64, quiet: ti.f64,
          coldest: ti.f64, report: Table):
    """Relax the temperatures of a round, except in tiles that it skipped, and store its results and changes for the next one.

    known: 1 if those of an earlier round are stored, else 0. quiet: changes (K) below this are not relaxed. Each tile's CHANGE
    becomes at least that by its relaxation.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        for q in range(s * (nx + 1) + first, s * (nx + 1) + last):
            if report[c, RESTS] > 0.0:
                rest(Z, C, q, nz)
            else:
                measure(Z, C, q, nz)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        if report[c, RESTS] > 0.0:
            continue
        s, first, last = tile(c, nx)
        most = 0.0
        for i in range(first, last):
            at = block_at(G, c, i)
            moved = largest_row(turn(Z, at.q, nz, known * share_of(C, at, quiet), coldest), at)
            if moved > 0.0:
                keep_parts(Z, at.q, nz, oil)
            most = ti.max(most, moved)
        report[c, CHANGE] = ti.max(report[c, CHANGE], most)
