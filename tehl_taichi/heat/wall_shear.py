"""Shear tractions on both surfaces of a thermal film: the wall stresses where it carries load."""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import read
from tehl_taichi.engine.simd import Flat, Table, block_at, cells, tile, tiles
from tehl_taichi.heat.film_tables import XA, XB, YA, YB
from tehl_taichi.pressure.conditions import Conditions
from tehl_taichi.pressure.fields import TOUCH, P
from tehl_taichi.pressure.tractions import Stack, on_bodies, store


@ti.kernel
def wall_shear(S: ti.template(), G: Table, C: ti.template(), rheology: ti.template(), conditions: Flat, out: Stack):
    """Compute tractions as :func:`tehl_taichi.pressure.tractions.tractions`, with the same values in ruptured and touching
    nodes.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        scene = read(Conditions, conditions)
        for i in range(first, last):
            at = block_at(G, c, i)
            a_x, a_y, b_x, b_y = on_bodies(S, G, at, rheology, scene)
            carries = (S[P, at.k] > 0.0) & (S[TOUCH, at.k] == 0.0)
            store(out, at, ti.select(carries, C[at.q, XA], a_x), ti.select(carries, C[at.q, YA], a_y),
                  ti.select(carries, -C[at.q, XB], b_x), ti.select(carries, -C[at.q, YB], b_y))
