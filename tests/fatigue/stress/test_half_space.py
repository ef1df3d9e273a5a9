"""Surface stresses: coefficients against quadrature and known values, Hertz contacts, sliding, the endless line."""

import numpy as np
import pytest

from tehl_taichi.engine.fftw import SINGLE
from tehl_taichi.fatigue.stress import half_space as hs
from tehl_taichi.fatigue.stress import rectangle

NU = 0.3


def gauss(a, b, n=40):
    nodes, weights = np.polynomial.legendre.leggauss(n)
    s, t = np.meshgrid(a * nodes, b * nodes, indexing="ij")
    return s, t, a * b * np.outer(weights, weights)


def point_pressure(X, Y):
    """(sxx, syy, sxy) at the surface from a unit normal force (Johnson 3.18, 3.19 at z = 0)."""
    r2 = X * X + Y * Y
    c = (1 - 2 * NU) / (2 * np.pi * r2 * r2)
    return c * (X * X - Y * Y), c * (Y * Y - X * X), 2 * c * X * Y


def point_shear(X, Y):
    """(sxx, syy, sxy) at the surface from a unit force along x on the body (Johnson 3.75 at z = 0)."""
    r = np.hypot(X, Y)
    m = 1 - 2 * NU
    sxx = -3 * X**3 / r**5 + m * (X / r**3 - 3 * X / r**3 + X**3 / r**5 + 2 * X**3 / r**5)
    syy = -3 * X * Y * Y / r**5 + m * (X / r**3 - X / r**3 + X * Y * Y / r**5 + 2 * X * Y * Y / r**5)
    sxy = -3 * X * X * Y / r**5 + m * (-Y / r**3 + X * X * Y / r**5 + 2 * X * X * Y / r**5)
    return tuple(v / (2 * np.pi) for v in (sxx, syy, sxy))


@pytest.mark.parametrize("x,y", [(2.0, 0.7), (-1.4, 1.9), (0.3, -2.5), (3.0, 0.0)])
def test_coefficients_agree_with_quadrature_of_the_point_force(x, y):
    a, b = 0.5, 0.4
    s, t, w = gauss(a, b)
    for exact, point in ((rectangle.pressure_coefficients, point_pressure), (rectangle.shear_x_coefficients, point_shear)):
        sums = [np.sum(w * v) for v in point(x - s, y - t)]
        np.testing.assert_allclose(exact(x, y, a, b, NU), sums, atol=1e-12)


def test_coefficients_have_their_known_values():
    np.testing.assert_allclose(rectangle.pressure_coefficients(0.0, 0.0, 0.5, 0.5, NU), (-0.8, -0.8, 0), atol=1e-14)
    known = 0.0590334470601733
    np.testing.assert_allclose(rectangle.pressure_coefficients(1.0, 0.0, 0.5, 0.5, NU), (known, -known, 0), atol=1e-14)
    np.testing.assert_allclose(rectangle.pressure_coefficients(0.0, 1.0, 0.5, 0.5, NU), (-known, known, 0), atol=1e-14)
    np.testing.assert_allclose(rectangle.shear_x_coefficients(0.0, 0.0, 0.5, 0.5, NU), 0, atol=1e-14)


def test_shear_along_y_is_shear_along_x_turned():
    sxx, syy, sxy = rectangle.shear_y_coefficients(0.9, -1.3, 0.5, 0.4, NU)
    np.testing.assert_allclose((syy, sxx, sxy), rectangle.shear_x_coefficients(-1.3, 0.9, 0.4, 0.5, NU), rtol=1e-14)


@pytest.mark.parametrize("depth", [0.0, 0.4])
def test_a_line_without_loads_at_its_side_is_a_point_contact(depth):
    """Nothing continues along y."""
    rng = np.random.default_rng(4)
    loads = rng.normal(size=(3, 9, 5))
    loads[..., -1] = 0.0
    x, y = np.arange(9) * 0.3, np.arange(5) * 0.2
    line, point = (hs.HalfSpaceStress(x, y, NU, line, depth=depth)(*loads) for line in (True, False))
    for name in hs.COMPONENTS:
        np.testing.assert_allclose(line[name], point[name], atol=1e-12, err_msg=name)


def test_convolution_equals_the_direct_sum():
    rng = np.random.default_rng(2)
    x, y = np.arange(9) * 0.3, np.arange(5) * 0.2
    p, qx, qy = rng.standard_normal((3, 9, 5))
    qy[:, 0] = 0
    got = hs.HalfSpaceStress(x, y, NU, line=False)(p, qx, qy)
    full = np.concatenate([-y[:0:-1], y])
    lag_x = x[:, None, None, None] - x[None, None, :, None]
    lag_y = y[None, :, None, None] - full[None, None, None, :]
    kernels = [k(lag_x, lag_y, 0.15, 0.1, NU)
               for k in (rectangle.pressure_coefficients, rectangle.shear_x_coefficients, rectangle.shear_y_coefficients)]
    loads = [np.concatenate([s * v[:, :0:-1], v], axis=1) for v, s in ((p, 1), (qx, 1), (qy, -1))]
    for n, name in enumerate(("sxx", "syy", "sxy")):
        direct = sum(np.einsum("ijkl,kl->ij", k[n], load) for k, load in zip(kernels, loads))
        np.testing.assert_allclose(got[name], direct, atol=1e-12)
    np.testing.assert_array_equal(got["szz"], -p)
    np.testing.assert_array_equal(got["sxz"], -qx)


@pytest.mark.parametrize("depth", [0.0, 0.15])
@pytest.mark.parametrize("mirrored,rows", [(True, slice(0, 5)), (True, slice(2, 9)), (False, slice(3, 6)),
                                           (False, slice(None))])
def test_some_rows_in_single_precision_are_those_of_the_whole(mirrored, rows, depth):
    x, y, loads = np.arange(20) * 0.3, np.arange(12) * 0.2, np.random.default_rng(4).standard_normal((3, 20, 12))
    whole = hs.HalfSpaceStress(x, y, NU, mirrored=mirrored, depth=depth)(*loads)
    some = hs.HalfSpaceStress(x, y, NU, mirrored=mirrored, depth=depth, rows=rows)(*loads)
    single = hs.HalfSpaceStress(x, y, NU, mirrored=mirrored, depth=depth, rows=rows, kind=SINGLE)(*loads)
    for name, values in whole.items():
        np.testing.assert_allclose(some[name], values[:, rows], atol=1e-12)
        np.testing.assert_allclose(single[name], values[:, rows], atol=4e-6)
    if rows.start == 0:  # odd: nothing on the axis, to the last digit
        assert not any(single[name][:, 0].any() for name in (("sxy", "syz") if depth else ("sxy",)))


def hertz_point(cells):
    n = int(1.5 * cells)
    x, y = np.arange(-n, n + 1) / cells, np.arange(n + 1) / cells
    p = np.sqrt(np.maximum(1 - x[:, None] ** 2 - y[None, :] ** 2, 0))
    return x, hs.HalfSpaceStress(x, y, NU, line=False)(p, 0 * p, 0 * p)


def test_hertz_point_tension_approaches_a_seventh_of_the_pressure():
    """Largest sigma_1 = (1 - 2 nu) p_0 / 3 at r = a."""
    errors = [abs(hertz_point(n)[1]["sxx"].max() - (1 - 2 * NU) / 3) for n in (16, 32, 64)]
    assert errors[2] < errors[1] < errors[0] < 0.012 and errors[2] < 0.003
    x, stress = hertz_point(64)
    assert abs(stress["sxx"][x.size // 2, 0] + (1 + 2 * NU) / 2) < 1e-3


def sliding_cylinder(cells):
    """Rows of an endless line: q = sqrt(1 - x^2) towards +x."""
    x = np.arange(-2 * cells, 2 * cells + 1) / cells
    q = np.sqrt(np.maximum(1 - x**2, 0))[:, None]
    return x, hs.HalfSpaceStress(x, [0.0], NU)(0 * q, q, 0 * q)


def test_sliding_cylinder():
    """sxx = -2 x q_0 inside, so 2 q_0 of tension at the trailing edge; -2 (x -+ sqrt(x^2 - 1)) outside."""
    peaks = [sliding_cylinder(n)[1]["sxx"].max() for n in (25, 50, 100)]
    assert 1.8 < peaks[0] < peaks[1] < peaks[2] < 2.0
    x, stress = sliding_cylinder(100)
    sxx = stress["sxx"][:, 0]
    inner, outer = np.abs(x) < 0.8, np.abs(x) > 1.2
    np.testing.assert_allclose(sxx[inner], -2 * x[inner], atol=5e-3)
    exact = -2 * (x - np.sign(x) * np.sqrt(np.maximum(x**2 - 1, 0)))
    np.testing.assert_allclose(sxx[outer], exact[outer], atol=5e-3)
    np.testing.assert_allclose(stress["syy"][:, 0], NU * sxx, rtol=1e-13)


def sliding_sphere(cells):
    """q = sqrt(1 - r^2) towards +x."""
    n = int(1.5 * cells)
    x, y = np.arange(-n, n + 1) / cells, np.arange(n + 1) / cells
    q = np.sqrt(np.maximum(1 - x[:, None] ** 2 - y[None, :] ** 2, 0))
    return x[:, None], y[None, :], hs.HalfSpaceStress(x, y, NU, line=False)(0 * q, q, 0 * q)


def test_sliding_sphere():
    """Linear inside (Hamilton 1983), so pi (4 + nu)/8 q_0 of tension at the trailing edge, met with an infinite slope."""
    edge = np.pi * (4 + NU) / 8
    peaks = [edge - sliding_sphere(n)[2]["sxx"].max() for n in (16, 32, 64)]
    assert peaks[0] > 1.3 * peaks[1] > 1.3**2 * peaks[2] > 0
    (x, y, coarse), (_, _, fine) = sliding_sphere(32), sliding_sphere(64)
    inner = np.hypot(x, y) < 0.8
    exact = {"sxx": -np.pi / 2 * x * (1 + NU / 4) + 0 * y, "syy": -3 * np.pi / 8 * NU * x + 0 * y,
             "sxy": np.pi / 4 * y * (NU / 2 - 1) + 0 * x}
    for name, values in exact.items():  # first order: the edge of the load lies between nodes
        limit = 2 * fine[name][::2, ::2] - coarse[name]
        np.testing.assert_allclose(limit[inner], values[inner], atol=1.5e-3)


def test_endless_line_pressure_has_no_surface_tension():
    x, y = np.linspace(-2, 2, 81), np.linspace(0, 1, 17)
    p = np.repeat(np.sqrt(np.maximum(1 - x**2, 0))[:, None], 17, axis=1)
    stress = hs.HalfSpaceStress(x, y, NU)(p, 0 * p, 0 * p)
    np.testing.assert_allclose(stress["sxx"], -p, atol=1e-14)
    np.testing.assert_allclose(stress["syy"], -2 * NU * p, atol=1e-14)


def test_endless_line_is_the_limit_of_a_long_one():
    """The truncated line misses 0.2 a / L of sxx in the middle; the analytic line part misses nothing."""
    x = np.linspace(-1.5, 1.5, 61)
    for length in (5.0, 20.0):
        y = np.linspace(0, length, int(10 * length) + 1)
        p = np.repeat(np.sqrt(np.maximum(1 - x**2, 0))[:, None], y.size, axis=1)
        middle = hs.HalfSpaceStress(x, y, NU, line=False)(p, 0 * p, 0 * p)["sxx"][30, 0]
        assert abs(middle + 1 - 0.2 / length) < 0.1 / length


def test_grids_are_checked():
    with pytest.raises(ValueError, match="uniform"):
        hs.HalfSpaceStress([0.0, 1.0, 3.0], [0.0], NU)
    with pytest.raises(ValueError, match="line"):
        hs.HalfSpaceStress([0.0, 1.0], [0.0], NU, line=False)


# unit loads on |x|, |y| <= 1/2, nu = 0.3: sxx, syy, szz, sxy, sxz, syz by Gauss quadrature of the point-force formulas
AT_DEPTH = {("pressure", 1, 0, 0.5): (-0.0984101600102759, -0.0204387722573749, -0.056368169840978, 0, -0.0822907450593984, 0),
            ("pressure", 0.25, 0.125, 0.1): (-0.51251555756349, -0.53726627166508, -0.984792808200483, 0.00387328551647392,
                                             -0.0349879317806091, -0.0106108686500211),
            ("shear_x", 1, 1, 0.25): (-0.0916774732733702, -0.0503355768556804, -0.006929186118215, -0.0732497670475674,
                                      -0.0236695560979495, -0.0219676724470521),
            ("shear_y", 1, 0, 0.5): (0, 0, 0, -0.0398536524936325, 0, -0.0153182796921643)}


@pytest.mark.parametrize("case", AT_DEPTH)
def test_coefficients_at_depth_have_their_known_values(case):
    load, x, y, z = case
    found = getattr(rectangle, load + "_at_depth")(x, y, z, 0.5, 0.5, NU)
    np.testing.assert_allclose(found, AT_DEPTH[case], atol=1e-14)


@pytest.mark.parametrize("x,y,z", [(0.2, 0.7, 0.3), (-0.4, 1.9, 1.0), (1.3, -0.5, 0.05)])
def test_stresses_at_depth_are_in_equilibrium(x, y, z):
    """Divergence of the stress of every load is zero (differences, order four)."""
    weights, step = {-2: 1 / 12, -1: -2 / 3, 1: 2 / 3, 2: -1 / 12}, 2e-3
    for load in (rectangle.pressure_at_depth, rectangle.shear_x_at_depth, rectangle.shear_y_at_depth):
        d = [sum(w * np.array(load(x + (k == 0) * n * step, y + (k == 1) * n * step, z + (k == 2) * n * step, 0.6, 0.4, NU))
                 for n, w in weights.items()) / step for k in range(3)]
        xx, yy, zz, xy, xz, yz = range(6)
        for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)):
            assert abs(sum(d[k][row[k]] for k in range(3))) < 1e-6 * max(np.abs(d).max(), 1)


@pytest.mark.parametrize("load,surface", [("pressure", "pressure_coefficients"), ("shear_x", "shear_x_coefficients"),
                                          ("shear_y", "shear_y_coefficients")])
def test_stresses_at_little_depth_are_those_of_the_surface(load, surface):
    for x, y in ((0.1, 0.2), (1.4, -0.3)):
        deep = getattr(rectangle, load + "_at_depth")(x, y, 1e-7, 0.5, 0.4, NU)
        np.testing.assert_allclose([deep[n] for n in (0, 1, 3)], getattr(rectangle, surface)(x, y, 0.5, 0.4, NU), atol=1e-6)


@pytest.mark.parametrize("z", [0.25, 1.0])
def test_line_and_point_hertz_on_the_axis_at_depth(z):
    """Line: -1/sqrt(1+z^2), -((1+2z^2)/sqrt(1+z^2) - 2z) (Johnson 4.46); sphere: -1/(1+z^2), 4.19."""
    x = np.linspace(-2, 2, 401)
    p = np.sqrt(np.maximum(1 - x[:, None] ** 2, 0))
    line = hs.HalfSpaceStress(x, [0.0], NU, depth=z)(p, 0 * p, 0 * p)
    root = np.sqrt(1 + z * z)
    assert line["szz"][200, 0] == pytest.approx(-1 / root, abs=2e-4)
    assert line["sxx"][200, 0] == pytest.approx(-((1 + 2 * z * z) / root - 2 * z), abs=2e-4)
    x, y = np.linspace(-1.2, 1.2, 121), np.linspace(0, 1.2, 61)
    p = np.sqrt(np.maximum(1 - x[:, None] ** 2 - y**2, 0))
    point = hs.HalfSpaceStress(x, y, NU, line=False, depth=z)(p, 0 * p, 0 * p)
    radial = -(1 + NU) * (1 - z * np.arctan(1 / z)) + 0.5 / (1 + z * z)
    assert point["szz"][60, 0] == pytest.approx(-1 / (1 + z * z), abs=2e-3)
    assert point["sxx"][60, 0] == pytest.approx(radial, abs=2e-3) and point["syy"][60, 0] == pytest.approx(radial, abs=2e-3)


def test_an_endless_row_at_depth_is_plane_strain():
    """The strips of a line contact = long rectangles."""
    x, z, far = np.arange(9) * 0.3, 0.2, 0.3 * np.subtract.outer(np.arange(9), np.arange(9))
    q = np.random.default_rng(3).standard_normal(9)
    strips = hs.HalfSpaceStress(x, [0.0], NU, depth=z)(q[:, None], 0.5 * q[:, None], 0 * q[:, None])
    pressure, shear = (load(far, 0.0, z, 0.15, 1e3, NU) for load in (rectangle.pressure_at_depth, rectangle.shear_x_at_depth))
    for name, n in (("szz", 2), ("sxz", 4)):
        np.testing.assert_allclose(strips[name][:, 0], pressure[n] @ q + 0.5 * shear[n] @ q, atol=1e-5)
    np.testing.assert_allclose(strips["syy"], NU * (strips["sxx"] + strips["szz"]), rtol=1e-14)
