"""Thermal stress: closed forms, the steady state as a limit of the history, the same correction by Cerruti's way."""

import math

import numpy as np
import pytest

from tehl_taichi.fatigue.stress import half_space
from tehl_taichi.fatigue.stress import thermal_stress as ts
from tehl_taichi.scene.sections import Body

STEEL = Body()
D = STEEL.k / (STEEL.rho * STEEL.c)
HELD = STEEL.E * STEEL.alpha / (1 - STEEL.nu)


def test_erfcx():
    for x in (0.0, 0.1, 1.0, 3.0):
        assert ts.erfcx(np.array([x]))[0] == pytest.approx(math.exp(x * x) * math.erfc(x), rel=1e-11)
    assert ts.erfcx(np.array([200.0]))[0] == pytest.approx(1 / (200 * math.sqrt(math.pi)), rel=1e-4)


def test_depth_after_a_sudden_heating():
    """Theta = int erfc(z/2 sqrt(D t)) exp(-k z) dz for little time, 1/(2 k) (harmonic temperatures) after a long one."""
    k, t = 2e4, 1e-6
    z = np.linspace(0, 60e-6, 20001)
    shape = np.array([math.erfc(v / (2 * math.sqrt(D * t))) for v in z])
    along = 1 + 0 * z  # conduction along the surface is negligible by then (D k^2 t = 0.005)
    assert ts.depth_after(np.array([k]), D, t)[0] == pytest.approx(np.trapezoid(shape * along * np.exp(-k * z), z), rel=5e-3)
    assert ts.depth_after(np.array([k]), D, 1.0)[0] == pytest.approx(0.5 / k, rel=1e-6)
    assert ts.depth_after(np.array([0.0]), D, t)[0] == pytest.approx(2 * math.sqrt(D * t / math.pi))


def make(rises, dt=1e-6, speed=0.0, n=64, rows=1, length=1e-3):
    x, y = np.arange(n) * length / n, np.arange(rows) * length / n
    return x, y, ts.ThermalStress(STEEL, speed, rises(x[:, None], y[None, :]), dt, x, y, 0, n, 0.1e-3, True)


def test_temperatures_fade_from_those_at_the_end_of_the_grid():
    stress = make(lambda x, y: (1.0 + x / 1e-3 + 0 * y)[None])[2]  # from 1 K to 2 K
    wide = stress._extended(stress.rises[0])[:, 0]
    steps = np.diff(wide[wide > 0])
    assert wide.max() == wide[63] and (steps[:63] > 0).all() and (steps[63:] < 0).all()
    assert np.abs(steps).max() < 0.6 and wide[64] > 1.5


def at(stress, entry):
    """sxx, syy, sxy (columns, rows) of an entry."""
    return np.moveaxis(stress.on(range(stress.waves.rows))(entry), -1, 0)


def test_resting_harmonic_temperatures_give_no_stress_in_their_plane():
    """cos(kx) exp(-kz): sigma_xx = 0, sigma_yy = -E alpha T (plane strain; Boley & Weiner)."""
    w = ts.WaveNumbers(64, 1, 1e-5, 1.0, True)
    theta = ts.steady_depth(w.kx, w.k, D, 0.0)[1:, 0].real
    k = w.k[1:, 0]
    np.testing.assert_allclose(-1 + 2 * k * theta, 0, atol=1e-12)
    np.testing.assert_allclose(HELD * (-1 + 2 * STEEL.nu * k * theta), -STEEL.E * STEEL.alpha, rtol=1e-12)


def test_a_hot_layer_is_held():
    """Wide and shallow heating: -E alpha T/(1 - nu) in both directions."""
    def heated(x, y):
        return [np.zeros_like(x + y), 10.0 * np.exp(-((x - 0.5) ** 2) / 0.02) + 0 * y]

    x, y, stress = make(heated, dt=1e-9, length=1.0)
    sxx, syy, sxy = at(stress, 1)
    assert sxx.min() == pytest.approx(-10 * HELD, rel=1e-3) and syy.min() == pytest.approx(-10 * HELD, rel=1e-3)


def cerruti(n, step):
    """Largest difference of the correction from that of loads q = -(E alpha/(1 - nu)) grad Theta on rectangles."""
    x, y = np.arange(n) * step, np.arange(n // 2 + 1) * step
    bell = np.exp(-((x[:, None] - 256e-6) ** 2 + y[None, :] ** 2) / (40e-6) ** 2)
    stress = ts.ThermalStress(STEEL, 3.0, [10.0 * bell], 1e-6, x, y, 0, n, 50e-6, True)
    theta = stress.waves.values(stress.thetas[0])
    qx, qy = (-HELD * d for d in np.gradient(theta, step))
    load = half_space.HalfSpaceStress(np.arange(theta.shape[0]) * step, y, STEEL.nu, line=False)(0 * qx, qx, qy)
    wide, inner = np.abs(load["sxx"]).max(), (slice(n // 6, -n // 3), slice(0, n // 4))
    return max(np.abs(field + HELD * 10 * bell * (name != "sxy") - load[name][:n])[inner].max() / wide
               for field, name in zip(at(stress, 0), ("sxx", "syy", "sxy")))


def test_the_correction_is_cerruti_s():
    """5.3 % and 2.4 % of the largest on cells of 4 and 2 um: constant loads on rectangles are of first order here."""
    coarse, fine = cerruti(128, 4e-6), cerruti(256, 2e-6)
    assert fine < 0.03 and coarse / fine > 1.9


def test_the_history_of_a_standing_field_ends_in_the_steady_one():
    speed, dt = 8.0, 0.5e-6

    def bell(x, y):
        return 50.0 * np.exp(-((x - 0.3e-3) ** 2) / (0.06e-3) ** 2) + 0 * y

    x, y, steady = make(lambda x, y: [bell(x, y)], speed=speed, n=256)
    _, _, history = make(lambda x, y: [0 * bell(x, y), *[bell(x, y)] * 240], dt=dt, speed=speed, n=256)
    (one, two, _), (a, b, _) = at(steady, 0), at(history, 240)
    near = x < 0.6e-3  # farther on the first heat is still to be seen
    np.testing.assert_allclose(a[near], one[near], atol=0.02 * np.abs(one).max())
    np.testing.assert_allclose(b[near], two[near], atol=0.02 * np.abs(two).max())
    assert np.abs(one + HELD * bell(x[:, None], y[None, :])).max() > 0.2 * np.abs(one).max()  # the correction matters
