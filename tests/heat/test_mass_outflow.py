"""Flow of mass from a node of the film to its neighbours, which the energy equation takes along."""

import numpy as np
import pytest

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import Record, read
from tehl_taichi.engine.simd import Flat, Table, W, block_at, tile, tiles
from tehl_taichi.heat import energy, film_tables
from tehl_taichi.heat.heat_step import HeatStep
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene import scene

pytestmark = pytest.mark.usefixtures("taichi_cpu")
NODES, ROWS, COLUMNS = 3, 12, 32


def outflow(across):
    """Flow of mass out of the rows, of a film whose oil flows so much across them (ROWS + 1,) and not along."""
    @ti.kernel
    def collect(Z: ti.template(), G: Table, numbers: Flat, out: Table):
        nx, ny, step = int(G[0, 1]), int(G[0, 2]), read(HeatStep, numbers)
        for c in range(tiles(nx, ny)):
            s, first, last = tile(c, nx)
            for i in range(first, last):
                found = energy.outflow(Z, block_at(G, c, i), NODES, 0, step)
                for u in ti.static(range(W)):
                    if s * W + u <= ny:
                        out[s * W + u, i] = found[u]

    description = scene("smooth-line").replace(**{"thermal.on": True, "grid.nx": COLUMNS, "grid.ny": ROWS})
    levels, step, out = Levels(description, COLUMNS, ROWS), Record(HeatStep), np.zeros((ROWS + 1, 33))
    film = film_tables.FilmTables(levels, NODES)
    step.set(inv_x=1.0, inv_y=2.0)
    film.put_nodes(film_tables.MY, across[None, :, None] + np.zeros((NODES, ROWS + 1, COLUMNS + 1)))
    collect(film.field, levels.G, step.values, out)
    return out


def test_both_sides_are_mirrors():
    """Across a mirror nothing flows, so the flow behind it is the opposite one; inside it is the central difference."""
    across = np.sin(np.arange(ROWS + 1.0))
    found = outflow(across)
    beyond = np.concatenate([[-across[1]], across, [-across[-2]]])
    np.testing.assert_allclose(found, -(beyond[2:] - beyond[:-2])[:, None] + np.zeros(found.shape), atol=1e-12)
    np.testing.assert_allclose(outflow(-across[::-1]), found[::-1], atol=1e-12)
