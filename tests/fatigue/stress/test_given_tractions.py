"""tehl.stresses against closed forms: Hertz line (McEwen), Hertz sphere with and without sliding (Hamilton & Goodman 1966, in
the form of Hamilton 1983), lengths in a, stresses in p0."""

import tracemalloc

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.disk import memory_limit

NU, CELLS = 0.3, 60
DEPTHS = (0.25, 0.5, 1.0)
PLACES = ((0.5, 0.3), (-0.8, 0.9), (0.3, -1.2), (0.1, 0.2))
XX, YY, ZZ, XY, XZ, YZ = range(6)


@pytest.fixture(scope="module")
def sphere():
    """(nodes, stresses under the pressure, under shear of the same shape) on a square of 3 a."""
    c = np.arange(-1.5 * CELLS, 1.5 * CELLS + 1) / CELLS
    p = np.sqrt(np.maximum(1 - c[:, None] ** 2 - c**2, 0))
    return c, tehl.stresses(p, dx=1 / CELLS, depths=DEPTHS, nu=NU), tehl.stresses(0 * p, p, dx=1 / CELLS, depths=DEPTHS, nu=NU)


def lengths(x, y, z):
    """A, S, M, N of Hamilton 1983."""
    A = x * x + y * y + z * z - 1
    S = np.sqrt(A * A + 4 * z * z)
    return A, S, np.sqrt((S + A) / 2), np.sqrt((S - A) / 2)


def pressed(x, y, z):
    """{component: stress} under the pressure."""
    A, S, M, N = lengths(x, y, z)
    r2, phi, G, H = x * x + y * y, np.arctan(1 / M), M * M - N * N + z * M - N, 2 * M * N + M + z * N

    def along(x, y):
        bent = (1 - NU) * N * z * z - (1 - 2 * NU) / 3 * (N * S + 2 * A * N + 1) - NU * M * z
        return (1 + NU) * z * phi + ((y * y - x * x) / r2 * bent - N * (x * x + 2 * NU * y * y) - M * x * x * z / S) / r2

    tilted = -z * (N / S - z * H / (G * G + H * H))
    return {XX: along(x, y), YY: along(y, x), ZZ: -N + z * M / S, XZ: x * tilted, YZ: y * tilted}


def sheared(x, y, z):
    """The same under shear towards +x."""
    A, S, M, N = lengths(x, y, z)
    r2, phi = x * x + y * y, np.arctan(1 / M)
    last = -0.75 * (S + 2 * A) + z * z - 0.75 - 0.25 * r2 + 0.5 * z * z * (0.5 - 2 * x * x / r2)
    return {ZZ: x * z * N / (2 * r2) * (1 - (r2 + z * z + 1) / S),
            XZ: 1.5 * z * phi + z * M / r2 * (1 + x * x / r2 - x * x / S) + N / r2 * last}


@pytest.mark.parametrize("place", PLACES)
def test_sphere_pressed_and_sliding(sphere, place):
    c, normal, shear = sphere
    i, j = (int(np.argmin(abs(c - at))) for at in place)
    for k, z in enumerate(DEPTHS):
        for found, known in ((normal, pressed), (shear, sheared)):
            for component, value in known(c[i], c[j], z).items():
                assert found[i, j, k, component] == pytest.approx(value, abs=1.5e-4), (place, z, component)


def test_sliding_sphere_on_the_surface_and_on_its_axis(sphere):
    """Inside, sxx = -pi/2 x (1 + nu/4); on the axis sxz = -1 + 3/2 z atan(1/z) - z^2/(1 + z^2)/2."""
    c, _, shear = sphere
    p = np.sqrt(np.maximum(1 - c[:, None] ** 2 - c**2, 0))
    surface = tehl.stresses(0 * p, p, dx=1 / CELLS, nu=NU)
    middle, inner = c.size // 2, abs(c) < 0.6
    np.testing.assert_allclose(surface[inner, middle, XX], -np.pi / 2 * c[inner] * (1 + NU / 4), atol=0.01)
    np.testing.assert_array_equal(surface[..., XZ], -p)
    for k, z in enumerate(DEPTHS):
        axis = -1 + 1.5 * z * np.arctan(1 / z) - 0.5 * z * z / (1 + z * z)
        assert shear[middle, middle, k, XZ] == pytest.approx(axis, abs=1.5e-4)


def test_pressed_line():
    x, z = np.linspace(-2, 2, 801), 0.4
    found = tehl.stresses(np.sqrt(np.maximum(1 - x**2, 0)), dx=0.005, depths=[z], nu=NU)[:, 0]
    part, root = 1 - x**2 + z * z, np.sqrt((1 - x**2 + z * z) ** 2 + 4 * x**2 * z * z)
    m, n = np.sqrt((root + part) / 2), np.sign(x) * np.sqrt(np.maximum((root - part) / 2, 0))
    share = (z * z + n * n) / (m * m + n * n)
    known = {XX: 2 * z - m * (1 + share), ZZ: -m * (1 - share), XZ: -n * (m * m - z * z) / (m * m + n * n), XY: 0 * x}
    for component, values in known.items():
        np.testing.assert_allclose(found[:, component], values, atol=3e-4)
    np.testing.assert_allclose(found[:, YY], NU * (found[:, XX] + found[:, ZZ]), rtol=1e-12)


def test_shear_along_y_is_shear_along_x_turned():
    q = np.random.default_rng(1).standard_normal((9, 7))
    one = tehl.stresses(0 * q, q, dx=0.3, dy=0.2, depths=0.1)
    other = tehl.stresses(0 * q.T, None, q.T, dx=0.2, dy=0.3, depths=0.1)
    np.testing.assert_allclose(other.swapaxes(0, 1)[..., [YY, XX, ZZ, XY, YZ, XZ]], one, atol=1e-12)


def test_shapes_follow_the_loads_and_depths():
    p = np.ones((5, 4))
    assert tehl.stresses(p, dx=1e-6).shape == (5, 4, 6) and tehl.stresses(p, dx=1e-6, depths=[0, 1e-6]).shape == (5, 4, 2, 6)
    assert tehl.stresses(p[0], dx=1e-6).shape == (4, 6) and tehl.stresses(p[0], p[0], dx=1e-6, depths=[0]).shape == (4, 1, 6)


@pytest.mark.parametrize("wrong, said", [
    ({"pressure": np.ones(1)}, "at least 2 nodes"), ({"pressure": "x"}, "array of real numbers"),
    ({"dx": None}, "dx is missing"), ({"dx": 0.0}, "dx = 0 m is out of range"),
    ({"pressure": [1.0, np.nan]}, "finite"), ({"depths": [-1e-6]}, "depths = -1e-06 m is out of range"),
    ({"traction_x": [1.0]}, "must agree"), ({"traction_y": [1.0, 1.0]}, "a line contact has none"),
    ({"nu": 0.6}, "nu = 0.6 is out of range"), ({"depths": "deep"}, "'deep' is not a number"), ({"depths": []}, "one or more"),
    ({"pressure": [1.0, 2.0 + 1j]}, "real numbers in Pa"), ({"pressure": np.ones(3) + 0j}, "real numbers in Pa"),
    ({"pressure": np.ma.array([1.0, 2.0], mask=[True, False])}, "1 of the 2 values of pressure are masked, nan or too"),
    ({"traction_x": np.ma.array([1.0, 2.0], mask=[True, False])}, "1 of the 2 values of traction_x are masked"),
    ({"depths": np.ma.array([0.0, 1e-6], mask=[False, True])}, "is not a number"), ({"depths": [1j]}, "1j is not a number"),
    ({"dy": 1e-5}, r"dy = 1e-05 has no effect on a pressure of shape \(nx,\); allowed: no dy, or"),
    ({"dy": None, "pressure": np.ma.array([1.0, 2.0]), "dx": 0.0}, "dx = 0 m")])
def test_refusals(wrong, said):
    with pytest.raises(tehl.SceneError, match=said):
        tehl.stresses(**{"pressure": [1.0, 2.0], "dx": 1e-6, **wrong})


@pytest.mark.parametrize("shape, depths", [((400, 300), 1), ((400, 300), 12), ((60_000,), 5)])
def test_memory_is_checked_before_it_is_requested(monkeypatch, shape, depths):
    """The need is that of the largest moment, within a factor of two."""
    p, depths = np.ones(shape), np.linspace(0, 1e-3, depths)
    tehl.stresses(p[:8], dx=1e-6, depths=depths)
    tracemalloc.start()
    tehl.stresses(p, dx=1e-6, depths=depths)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    monkeypatch.setattr(memory_limit, "available", lambda: 0.5 * peak)
    nodes = " x ".join(map(str, shape))
    with pytest.raises(tehl.SceneError, match=rf"computing stresses at {nodes} nodes and {depths.size} depths? needs [\d.]+ MB "
                                              r"of memory; [\d.]+ MB are available"):
        tehl.stresses(p, dx=1e-6, depths=depths)
    monkeypatch.setattr(memory_limit, "available", lambda: 2 * peak)
    assert np.isfinite(tehl.stresses(p, dx=1e-6, depths=depths)).all()
