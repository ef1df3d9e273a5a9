"""The deflection: exact coefficients, a matrix and transforms that are the direct sum, parabolas under Hertz pressure."""

import numpy as np
import pytest
from direct_deflection import deflected

from tehl_taichi.pressure import influence
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

pytestmark = pytest.mark.usefixtures("taichi_cpu")


def test_influence_coefficients_against_quadrature():
    nodes, weights = np.polynomial.legendre.leggauss(40)
    dx, dy = 0.1, 0.07
    x, y = 3 * dx + dx / 2 * nodes, 2 * dy + dy / 2 * nodes
    integral = dx * dy / 4 * np.sum(weights[:, None] * weights / np.hypot(x[:, None], y))
    assert influence.rectangle(4, 4, dx, dy, COMPLIANCE["line"])[3, 2] == pytest.approx(integral / (2 * np.pi), rel=1e-12)
    integral = dx / 2 * np.sum(weights * np.log(x))
    assert influence.strip(4, dx)[3] == pytest.approx(-integral / np.pi, rel=1e-12)


COMPLIANCE = {"line": 1 / (2 * np.pi), "point": 2 / np.pi**2}


def by_matrix(P, dx, dy, kind="line", mirrored=True):
    """Deflection of P (ny+1, nx+1) by the matrix of the coarsest grid; the pressure vanishes where it enters."""
    P[:, 0] = 0.0
    key = P.shape[1] - 1, P.shape[0] - 1, dx, dy, COMPLIANCE[kind], kind == "line", mirrored
    return (influence.matrix(*key) @ P.ravel()).reshape(P.shape)


def both(P, dx, dy, kind="line", mirrored=True):
    """By the matrix, which must be what the transforms give."""
    found = by_matrix(P, dx, dy, kind, mirrored)
    assert found == pytest.approx(deflected(P, dx, dy, COMPLIANCE[kind], kind == "line", mirrored), abs=1e-13)
    return found


@pytest.mark.parametrize("kind", ["line", "point"])
def test_deflection_is_the_direct_sum(kind):
    nx, ny, dx, dy = 16, 8, 0.2, 0.15
    p = np.random.default_rng(1).random((9, 17))
    found = both(p, dx, dy, kind)
    edge = p[-1] if kind == "line" else 0 * p[-1]
    K, k = influence.rectangle(nx, 2 * ny, dx, dy, COMPLIANCE[kind]), influence.strip(nx, dx)
    i = np.arange(17)
    direct = np.zeros((9, 17))
    for j in range(9):
        for q in range(-ny, ny + 1):
            direct[j] += K[np.abs(i[:, None] - i), abs(j - q)] @ (p - edge)[abs(q)]
        direct[j] += k[np.abs(i[:, None] - i)] @ edge
    assert found == pytest.approx(direct, abs=1e-13)


def unevenness(cells):
    """Largest difference of the gap under a Hertz pressure, which should be flat."""
    x = np.linspace(-2, 2, cells + 1)
    W = deflected(np.sqrt(np.maximum(1 - x**2, 0))[None], x[1] - x[0], 1.0, COMPLIANCE["line"], True)[0]
    return np.ptp((W + x**2 / 2)[np.abs(x) < 0.9])


def test_hertz_pressure_deflects_to_a_parabola():
    errors = [unevenness(cells) for cells in (512, 1024, 2048)]
    assert errors[1] < 5e-5 and np.log2(errors[1] / errors[2]) > 1.3 and np.log2(errors[0] / errors[1]) > 1.3


def test_plain_deflection_is_the_direct_sum():
    nx, ny, dx, dy = 16, 8, 0.2, 0.15
    p = np.random.default_rng(2).random((9, 17))
    K = influence.rectangle(nx, ny, dx, dy, COMPLIANCE["point"])
    i, j = np.arange(17), np.arange(9)
    found = both(p, dx, dy, "point", mirrored=False)
    direct = np.einsum("ikjl,lk->ji", K[np.abs(i[:, None] - i)][:, :, np.abs(j[:, None] - j)], p)
    assert found == pytest.approx(direct, abs=1e-13)


def test_elliptic_hertz_pressure_deflects_to_a_parabola():
    data = scene("ball-on-disc").to_dict()
    data["contact"].update(kind="elliptic", radius_y=40e-3)
    s = Scales.of(type(scene()).from_dict(data))
    X = np.linspace(-1.5, 1.5, 257)
    Y = np.linspace(0, 1.5, 129) * s.b / s.a
    r2 = X[None, :] ** 2 + (Y[:, None] * s.a / s.b) ** 2
    P = np.sqrt(np.maximum(1 - r2, 0))
    out = deflected(P, X[1] - X[0], Y[1], s.compliance, False)
    gap = out + 0.5 * X**2 + 0.5 * s.curvature * Y[:, None] ** 2
    assert np.ptp(gap[r2 < 0.9]) < 2e-3
