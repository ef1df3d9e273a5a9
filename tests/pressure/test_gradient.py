"""Gradients of the pressure for velocities and heat, and slopes across the film, against numbers worked out by hand."""

import numpy as np
import pytest

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import LaneBlock, Table, V, W, block_at, tile, tiles
from tehl_taichi.heat.chebyshev import ChebyshevNodes
from tehl_taichi.heat.energy import one_sided, turn_upstream
from tehl_taichi.heat.node_table import Nodes
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.gradient import limited_gradient
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene import scene

pytestmark = pytest.mark.usefixtures("taichi_cpu")
THIN = 1e4  # times as mobile as the oil around it
FACE = (THIN - 1) / np.log(THIN)  # logarithmic mean of the mobilities on both sides of a face


@pytest.fixture(scope="module")
def levels():
    description = scene("smooth-line").replace(**{"thermal.on": False})
    return Levels(description, 32, 16)


def gradients(levels, P, thin=None):
    """(dP/dx, dP/dy) per cell (ny+1, nx+1) of oil of one mobility, at the node `thin` = (j, i) THIN times that."""
    @ti.kernel
    def collect(S: ti.template(), G: Table, along: Table, across: Table):
        nx, ny = int(G[0, 1]), int(G[0, 2])
        for c in range(tiles(nx, ny)):
            s, first, last = tile(c, nx)
            for i in range(first, last):
                px, py = limited_gradient(S, G, block_at(G, c, i))
                for u in ti.static(range(W)):
                    if s * W + u <= ny:
                        along[s * W + u, i], across[s * W + u, i] = px[u] * G[0, fields.DX], py[u] * G[0, fields.DY]

    ie = np.ones(P.shape)
    if thin:
        ie[thin] = THIN
    for row, values in ((fields.P, P), (fields.ROOT, 1.0), (fields.GAP, 1.0), (fields.IE, ie), (fields.LE, -np.log(ie))):
        levels.put(row, values)
    out = np.zeros(P.shape), np.zeros(P.shape)
    collect(levels.S, levels.G, *out)
    return out


def test_in_oil_of_one_mobility_they_are_those_of_the_pressure(levels):
    j, i = np.mgrid[:17, :33]
    along, across = gradients(levels, 0.1 + 0.01 * i + 0.002 * j)
    np.testing.assert_allclose(along, 0.01, rtol=1e-12)
    np.testing.assert_allclose(across[1:-1], 0.002, rtol=1e-12)
    assert not across[[0, -1]].any()


@pytest.mark.parametrize("axis", (0, 1))
def test_thin_oil_needs_no_more_than_what_brings_it_the_flow(levels, axis):
    """Both faces of the thin node let FACE times as much through as oil around it, which takes FACE/THIN of the fall there; its
    neighbours keep the fall that they have. Falls of another sign turn the answer."""
    at, steps = (9, 20), np.mgrid[:17, :33][1 - axis]
    for fall in (0.01, -0.01):
        found = gradients(levels, 1.0 + fall * steps, at)[axis]
        assert found[at] == pytest.approx(fall * FACE / THIN, rel=1e-9)
        found[at] = fall
        inner = found[1:-1]
        np.testing.assert_allclose(inner, fall, rtol=1e-9)


def test_slopes_across_the_film_come_from_where_the_flow_does():
    """Polynomials where conduction rules, the node behind where the flow does, a part of both between."""
    Z, X = (ti.Vector.field(W, ti.f64, shape=(1, size)) for size in (5, 25))

    @ti.kernel
    def collect(N: Nodes, n: ti.i32, swept: ti.f64, conduction: ti.f64, out: ti.types.ndarray(dtype=ti.f64, ndim=1)):
        for _ in range(1):
            out[0] = one_sided(N, n, V(swept), V(conduction))[0]
            out[1] = turn_upstream(Z, X, N, LaneBlock(k=0, q=0, c=0, i=0, s=0, nx=1, ny=0), n, V(swept))[0]

    across, out = ChebyshevNodes(5), np.zeros(2)
    z, T = across.zeta, np.array([3.0, 5.0, 4.0, 8.0, 1.0])
    Z.from_numpy(np.repeat(T[None, :, None], W, axis=2))
    for swept, behind in ((2.0, 1), (-2.0, 3)):
        distance, slope = abs(z[2] - z[behind]), (T[2] - T[behind]) / (z[2] - z[behind])
        for carried, part in ((1.0, 0.0), (2.0, 0.0), (3.0, 0.5), (4.0, 1.0), (9.0, 1.0)):  # times what is conducted
            X.fill(0.0)
            collect(across.table, 2, swept, 2.0 * distance / carried, out)
            assert out[0] == pytest.approx(part, abs=1e-12)
        rows = X.to_numpy()[0, :, 0].reshape(5, 5)
        assert out[1] == pytest.approx(swept * slope, rel=1e-12) == rows[2] @ T
        assert not rows[[0, 1, 3, 4]].any()
