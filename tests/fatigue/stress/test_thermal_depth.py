"""Thermal stress below the surface: conduction by differences, equilibrium, the surface as a limit, resting and deep fields."""

import math

import numpy as np
import pytest

from tehl_taichi.fatigue.stress import thermal_depth as td
from tehl_taichi.fatigue.stress import wave_table
from tehl_taichi.fatigue.stress.thermal_stress import ThermalStress
from tehl_taichi.scene.sections import Body

STEEL = Body()
D = STEEL.k / (STEEL.rho * STEEL.c)
HELD = STEEL.E * STEEL.alpha / (1 - STEEL.nu)
A = 0.1e-3  # m, half-width


def by_differences(k, t, z, steps=4000):
    """Temperature at the depths z a time t after the surface was set to 1: implicit steps of conduction along z."""
    diagonal = D * t / steps / (z[1] - z[0]) ** 2
    upper, lower = -diagonal, -diagonal
    middle = np.full(z.size - 2, 1 + 2 * diagonal + D * k * k * t / steps)
    matrix = np.diag(middle) + np.diag(np.full(z.size - 3, upper), 1) + np.diag(np.full(z.size - 3, lower), -1)
    step, T, wall = np.linalg.inv(matrix), np.zeros(z.size - 2), np.zeros(z.size - 2)
    wall[0] = diagonal
    for _ in range(steps):
        T = step @ (T + wall)
    return np.concatenate([[1.0], T, [0.0]])


@pytest.mark.parametrize("k,t", [(3e4, 20e-6), (3e4, 400e-6), (1e5, 5e-6)])
def test_steps_agree_with_conduction_and_goodiers_potential_by_quadrature(k, t):
    z = np.linspace(0, 8 * math.sqrt(D * t), 401)
    T, e = by_differences(k, t, z), np.exp(-k * z)
    green = (np.exp(-k * np.abs(z[:, None] - z)) - np.exp(-k * (z[:, None] + z))) / (2 * k)
    phi, Theta = -np.trapezoid(green * T, z, axis=1), np.trapezoid(T * e, z)
    slope = np.gradient(phi, z, edge_order=2)
    exact = (-k * k * phi - T + (2 * k - k * k * z) * e * Theta, -T + 2 * STEEL.nu * k * e * Theta,
             k * k * (phi + z * e * Theta), k * (slope + (1 - k * z) * e * Theta))
    for n in (5, 40, 150, 300):
        found = td.step_stresses(np.array(k), z[n], D, STEEL.nu, np.array(t)) * [1, 1, 1, k]
        np.testing.assert_allclose(found, [part[n] for part in exact], atol=1e-3)


def test_resting_harmonic_temperatures_give_no_stress_in_their_plane():
    """cos(kx) exp(-kz): only sigma_yy = -E alpha T (plane strain; Boley & Weiner), at every depth."""
    k, z = np.array([2e4, 1e5]), 15e-6
    ss, tt, zz, sz = td.step_stresses(k, z, D, STEEL.nu, np.array(10.0))
    np.testing.assert_allclose([ss, zz, k * sz], 0, atol=1e-9)
    np.testing.assert_allclose(HELD * tt, -STEEL.E * STEEL.alpha * np.exp(-k * z), rtol=1e-9)


def test_a_slab_is_held_in_its_plane():
    """Waves much longer than the depth of the heat: -E alpha T/(1 - nu) in both directions, T = erfc(z/2 sqrt(D t))."""
    z, t = 20e-6, 30e-6
    T = math.erfc(z / (2 * math.sqrt(D * t)))
    ss, tt, zz, sz = td.step_stresses(np.array([0.0, 1.0]), z, D, STEEL.nu, np.array(t))
    np.testing.assert_allclose([ss, tt], -T, rtol=1e-4)
    np.testing.assert_allclose([zz, sz], 0, atol=1e-4)


def test_stresses_are_none_before_the_heat_and_none_deep_below():
    k, t = np.array([0.0, 3e4]), np.array(30e-6)
    assert not td.step_stresses(k, 5e-6, D, STEEL.nu, 0 * t).any()
    assert np.abs(td.step_stresses(k, 1e-3, D, STEEL.nu, t)[:3]).max() < 1e-9


def bells(x, y, count, width):
    """A hot spot that grows and moves on, K."""
    at = 0.3e-3 + 0.6e-6 * np.arange(count)
    return [60 * (1 + n / count) * np.exp(-((x[:, None] - c) ** 2 + y[None, :] ** 2) / width**2) for n, c in enumerate(at)]


def passing(kind, *more, mirrored=True, columns=72, cell=10e-6, width=60e-6, rows=13):
    """Thermal stress under the moving hot spot, on half the rows or (mirrored=False) on all of them."""
    x, y, dt = np.arange(columns) * cell, np.arange(rows) * cell, 1.2e-6
    y = y if mirrored else np.concatenate([-y[:0:-1], y])
    return kind(STEEL, 8.0, bells(x, y, 12, width), dt, x, y, 0, columns, A, mirrored, *more)


def test_they_are_in_equilibrium():
    """Divergence of the stress by differences of second order, a quarter on a grid of half the step."""
    def worst(cell, columns):
        depth = [20e-6 + n * cell for n in (-1, 0, 1)]
        thermal = passing(td.ThermalBelow, 4e-6, columns=columns, cell=cell)
        s = np.array([thermal.at(d)(9) for d in depth])
        inner = (slice(2, -2), slice(1, 6))
        dx, dy = (np.gradient(s[1], cell, axis=axis) for axis in (1, 2))
        dz = (s[2] - s[0]) / (2 * cell)
        xx, yy, zz, xy, xz, yz = range(6)
        return max(np.abs((dx[i] + dy[j] + dz[k])[inner]).max() for i, j, k in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))) / (
            np.abs(dz[xx][inner]).max())

    coarse, fine = worst(10e-6, 72), worst(5e-6, 144)
    assert coarse < 0.06 and coarse / fine > 3.3


def test_the_surface_is_their_limit():
    """Extrapolated from 1 and 2 um to the surface: the stress of the surface, and no traction."""
    surface = passing(ThermalStress)
    below = passing(td.ThermalBelow, 1e-6)
    sxx, syy, sxy = np.moveaxis(surface.on(range(surface.waves.rows))(9), -1, 0)
    near, far = (np.array(below.at(depth)(9)) for depth in (1e-6, 2e-6))
    limit, scale = 2 * near - far, np.abs(sxx).max()
    for n, exact in ((0, sxx), (1, syy), (3, sxy)):
        assert np.abs(limit[n] - exact).max() < 0.03 * scale
    assert np.abs(near[[2, 4, 5]]).max() < 0.02 * scale and np.abs(limit[[2, 4, 5]]).max() < 4e-3 * scale
    assert np.abs(sxy).max() > 0.05 * scale  # the limit of the shear is no empty statement


@pytest.mark.parametrize("mirrored,row", [(True, 0), (True, 4), (False, 9)])
def test_rows_are_rows_of_the_whole(mirrored, row):
    thermal = passing(td.ThermalBelow, 10e-6, mirrored=mirrored)
    whole, rows = thermal.at(10e-6)(9), thermal.rows(10e-6, [row])[0][9]
    for n in range(6):
        np.testing.assert_allclose(rows[:, n], whole[n][:, row], atol=2e-5 * HELD)
    assert row == 0 or min(np.abs(rows[:, n]).max() for n in (3, 5)) > 0.1 * HELD


def test_any_number_of_threads_gives_the_same_bits(monkeypatch):
    """And works on no more chunks of waves than there are threads before they are taken."""
    found, kernels, made = [], td.ThermalBelow._answers_of, []
    monkeypatch.setattr(td.ThermalBelow, "_answers_of", lambda *given: (made.append(1), kernels(*given))[1])
    monkeypatch.setattr(td, "CHUNK", 20)
    for count in (1, 3):
        monkeypatch.setattr(td, "WORKERS", count)
        thermal = passing(td.ThermalBelow, 10e-6)
        found.append(thermal.rows(10e-6, [0, 4]).tobytes())
    assert found[0] == found[1] and len(made) > 12
    made.clear()
    parts = thermal._responses(10e-6)
    next(parts)
    assert len(made) <= 3
    parts.close()


def test_a_whole_domain_gives_what_half_of_it_does():
    half, all_ = (passing(td.ThermalBelow, 10e-6, mirrored=m, width=40e-6, rows=25).at(10e-6)(9) for m in (True, False))
    for one, other in zip(half, all_):
        np.testing.assert_allclose(other[:, 24:34], one[:, :10], atol=0.005 * 60 * HELD)


def test_a_long_wait_adds_nothing(monkeypatch):
    """The contact has been there long enough: from 4 a to 8 a before."""
    found = []
    for lead in (td.LEAD, 2 * td.LEAD):
        monkeypatch.setattr(td, "LEAD", lead)
        found.append(passing(td.ThermalBelow, 10e-6).rows(10e-6, [0])[0])
    assert np.abs(found[1] - found[0])[:, :50].max() < 0.02 * np.abs(found[0]).max()


def test_a_standing_temperature_moves_over_the_body_within_a_step():
    """Seen from the body a standing wave turns by its angle in a step, whose mean is (1 - exp(-i angle))/(i angle)."""
    angle = np.array([[0.0], [0.3], [1.3]])
    before, now = td._means(angle, 0.0, 1.0)
    exact = [1.0, *((1 - np.exp(-1j * a)) / (1j * a) for a in angle[1:, 0])]
    np.testing.assert_allclose((before * np.exp(-1j * angle) + now)[:, 0], exact, atol=1e-5)
    before, now = td._means(0 * angle, 0.25, 0.5)  # a part of the step: what is left of the old is its mean age
    np.testing.assert_allclose((before[0, 0], now[0, 0]), (0.375, 0.625), atol=1e-12)


@pytest.mark.parametrize("mirrored", [True, False])
@pytest.mark.parametrize("depth", [2e-6, 10e-6, 60e-6])
def test_answers_between_wave_numbers_of_a_table_are_those_of_each(monkeypatch, mirrored, depth):
    """To what single precision leaves, the mean (k = 0) among them."""
    thermal, used = passing(td.ThermalBelow, 2e-6, mirrored=mirrored, rows=25), []
    weights = wave_table.WaveTable._weights
    monkeypatch.setattr(wave_table.WaveTable, "_weights", lambda *given: used.append(given[1].min()) or weights(*given))
    found = []
    for worth in (0, 1e9):
        monkeypatch.setattr(wave_table, "WORTH", worth)
        found.append(thermal.rows(depth, [3])[0])
    assert used and min(used) == 0.0 and np.abs(found[1]).max() > 0.01 * HELD
    np.testing.assert_allclose(found[0], found[1], atol=2e-6 * np.abs(found[1]).max())
