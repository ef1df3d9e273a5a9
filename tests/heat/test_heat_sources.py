"""Heat of the film and of the bodies, source by source: solid friction, compression, the bodies' memory, relaxed rounds."""

import math

import numpy as np
import pytest
from heat.test_thermal import film as film_of
from heat.test_thermal import heat_bodies, thermal

from tehl_taichi.heat import conduction_modes, film_tables
from tehl_taichi.heat.temperatures import FEW
from tehl_taichi.laws.sheared_flow import wall_limit
from tehl_taichi.march.passage import Passage
from tehl_taichi.march.start import steady_snapshot
from tehl_taichi.pressure import fields
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

pytestmark = pytest.mark.usefixtures("taichi_cpu")


def film(**changes):
    """A FilmHeat on 64 cells of a line contact, at the inlet temperature, and its levels."""
    heat, levels = film_of(thermal(**{"grid.nx": 64, **changes}), 64)
    heat.start()
    return heat, levels


def step_between_walls(heat, levels, P, h, touch, rate=1e-6):
    """Temperatures of a film of P and h (m) between walls held at 90 deg C; rate: 1/s of the time derivative. Returns the heat
    into both bodies (2, nx+1) W/m2."""
    for row, values in ((fields.P, P), (fields.H, h / levels.scales.h), (fields.TOUCH, touch)):
        levels.put(row, values)
    for slot in (film_tables.AA, film_tables.AB):
        heat.columns.put_single(slot, np.full((1, levels.nx + 1), 90.0))
    heat.step.values[:] = 0.0
    heat.step.set(rate=rate, inv_x=1e-12, tolerance=1e-9, iterations=40, near=1.0)
    for _ in range(3):
        heat.values()  # what the pressure drives heats by the fluidity of the last round
        heat.solve()
    return np.stack([heat.columns.single(name)[0] for name in (film_tables.QA, film_tables.QB)])


@pytest.mark.parametrize("srr", (-0.2, 0.2))
def test_friction_heats_where_surfaces_touch(srr):
    """mu p |u_s| between walls at 90 deg C, half into each, whatever the film would dissipate; k dT = q h/8 in the middle.
    0.3 p is less than the limit of 10 MPa + 0.075 p up to 44 MPa, and more beyond."""
    heat, levels = film(srr=srr)
    X = levels.X
    p = np.where(X < 0, 20e6, 200e6)
    flux = step_between_walls(heat, levels, p / levels.scales.p_H, np.full(X.size, 0.2e-6), np.ones(X.size))
    stress = np.where(X < 0, 6e6, 25e6)  # 0.3 * 20 MPa; 10 + 0.075 * 200 MPa
    inner = slice(2, -2)
    np.testing.assert_allclose(flux.sum(axis=0)[inner], (stress * 1.7)[inner], rtol=1e-6)  # |u_s| = 0.2 * 8.5 m/s
    np.testing.assert_allclose(flux[0][inner], flux[1][inner], rtol=1e-6)
    k = 0.154 * (1 + 1.4e-9 * p / (1 + 0.34e-9 * p))
    middle = heat.temperature()[heat.nz // 2, 0] - 90
    np.testing.assert_allclose(middle[inner], (stress * 1.7 * 0.2e-6 / 8 / k)[inner], rtol=1e-6)


def test_a_film_that_shears_heats_by_stress_times_slip():
    """Couette flow without pressure gradient: tau |u_s| with the stress that the film itself tells, into both walls."""
    heat, levels = film(srr=-0.2)
    nodes = np.ones(levels.X.size)
    flux = step_between_walls(heat, levels, 0.1 * nodes, 0.2e-6 * nodes, 0 * nodes)
    heat._velocities()
    tau = heat.columns.single(film_tables.TAU)[0]
    inner = slice(2, int(np.searchsorted(levels.X, 0.0)))  # behind X = 0 the sources fade with the pressure
    np.testing.assert_allclose(flux.sum(axis=0)[inner], (tau * 1.7)[inner], rtol=1e-5)
    assert tau[10] > 1e6  # on body a, towards the faster body b


@pytest.mark.parametrize("slope", [-1.0, 1.0])
def test_a_wall_along_which_oil_slips_takes_the_heat_of_that(slope):
    """Frozen oil, a steep pressure: all heats together are the work of both walls and of the pressure, int tau du; what slips
    heats the wall where |tau| is the limit, which takes far more than the other one."""
    heat, levels = film(srr=-0.2, **{"contact.radius_x": 5e-4, "contact.load": 5e4})  # short, so steep
    X, h = levels.X, 0.05e-6
    P = 1.2 + 0.15 * slope * X
    flux = step_between_walls(heat, levels, P, np.full(X.size, h), 0 * X)
    heat._velocities()
    u, px = heat.columns.nodes(film_tables.U)[:, 0], heat.columns.single(film_tables.PX)[0]
    a, b = (heat.columns.single(name)[0] for name in (film_tables.XA, film_tables.XB))
    operation, mean_u = levels.scene.operation, np.tensordot(heat.across.C[-1], u, axes=1)
    work = b * operation.u_b - a * operation.u_a - h * px * mean_u
    inner = slice(int(np.searchsorted(X, -2.4)), int(np.searchsorted(X, 0.0)) - 2)
    np.testing.assert_allclose(flux.sum(axis=0)[inner], work[inner], rtol=5e-3)
    limit = 10e6 + 0.075 * P * levels.scales.p_H
    hot, cold, held = (flux[1], flux[0], b) if slope > 0 else (flux[0], flux[1], a)
    np.testing.assert_allclose(held[inner], limit[inner], rtol=0.02)
    assert np.all(hot[inner] > 3 * cold[inner])


@pytest.mark.slow  # each wall for itself: above
def test_both_walls_take_the_heat_of_oil_that_slips_along_both():
    """No sliding, walls strained by 1.1 times a low limit: the work of the pressure, half into each wall, and a film that stays
    colder than one that dissipates it."""
    heat, levels = film(srr=0.0, **{"rheology.tau_L0": 1e6, "rheology.gamma": 0.0})
    X, h, s = levels.X, 1e-6, levels.scales
    P = 1.2 + 1.1 * 2e6 / h * s.a / s.p_H * X
    flux = step_between_walls(heat, levels, P, np.full(X.size, h), 0 * X)
    heat._velocities()
    u, px = heat.columns.nodes(film_tables.U)[:, 0], heat.columns.single(film_tables.PX)[0]
    work = -h * px * (np.tensordot(heat.across.C[-1], u, axes=1) - levels.scene.operation.u_m)
    inner = slice(4, int(np.searchsorted(X, 0.0)) - 2)
    np.testing.assert_allclose(0.5 * h * px[inner], 1.1e6, rtol=1e-3)
    np.testing.assert_allclose(flux.sum(axis=0)[inner], work[inner], rtol=5e-3)
    np.testing.assert_allclose(flux[0][inner], flux[1][inner], rtol=1e-3)
    k = 0.154 * (1 + 1.4e-9 * P * s.p_H / (1 + 0.34e-9 * P * s.p_H))
    assert np.all((heat.temperature()[:, 0].max(axis=0) - 90)[inner] < 0.3 * (work * h / 8 / k)[inner])


def compressed():
    """A thick film, which conducts nothing, and its levels, from 0.18 to 0.2 GPa; and its state before."""
    heat, levels = film(srr=-0.002)
    nodes = np.ones(levels.X.size)
    for row, value in ((fields.P, 0.18e9 / levels.scales.p_H), (fields.H, 1e-3 / levels.scales.h)):
        levels.put(row, value * nodes)
    heat.start()
    cold = heat.state()
    step_between_walls(heat, levels, 0.2e9 / levels.scales.p_H * nodes, 1e-3 * nodes, 0 * nodes, rate=1e6)
    return heat, levels, cold


def test_oil_that_is_compressed_warms():
    """20 MPa more in a thick film, which conducts nothing: rho c dT = (T + 273.15) beta dp.

    At 0.2 GPa and 90 deg C beta = 6.8e-4 e^-0.3/(1 - 6.8e-4 e^-0.3 50) = 5.1676e-4 1/K and rho c = 853 * 2080 (1 + 0.082/1.21)
    (1 + 6.5e-4 (1 + 0.54 - 0.06) 68) = 2.0184 MJ/m3K, so dT = 363.15 * 5.1676e-4 * 20/2.0184 = 1.860 K.
    """
    heat, _, _ = compressed()
    warmer = heat.temperature()[heat.nz // 2, 0, 4:-4] - 90.0
    np.testing.assert_allclose(warmer, 1.860, rtol=0.008)  # a little more: it is 1.9 K warmer while it is compressed


def test_the_viscosity_follows_every_change_of_the_temperatures():
    """What of it depends on the temperature alone is kept: it must not be of older temperatures, whoever changed them."""
    heat, levels, cold = compressed()

    def viscosity():
        heat.values()
        return levels.get(fields.LE)

    solved = viscosity()
    heat.set_temperature(heat.temperature())
    np.testing.assert_array_equal(viscosity(), solved)
    heat.restore(cold)
    restored = viscosity()
    heat.set_temperature(cold["heat_T"])
    np.testing.assert_array_equal(viscosity(), restored)
    assert np.abs(solved - restored).max() > 0.01


def test_bodies_remember_a_growing_heat():
    """Flux q = t: T = (4/3) t^1.5/(sqrt(pi) e) at every step: new and last flux count each for itself."""
    dt, e = 1e-6, 13000.0
    weight, decay, gain, gain_last, B, B_last = conduction_modes.memory(dt, e, dt)
    memory, worst = np.zeros(conduction_modes.MODES), 0.0
    for n in range(1, 500):
        q, last = n * dt, (n - 1) * dt
        warm = (weight * decay * memory).sum() + B * q + B_last * last
        worst = max(worst, abs(warm / (4 / 3 * (n * dt) ** 1.5 / math.sqrt(math.pi) / e) - 1))
        memory = decay * memory + gain * q + gain_last * last
    assert worst < 1e-4


@pytest.mark.parametrize("sliding, within", [(0.0, 1e-4), (-0.3, 2e-3)])
def test_moving_half_space_under_a_growing_flux(sliding, within):
    """q = g x behind an edge on steel: material points see g u t, so T = (4/3) g x^1.5/sqrt(pi k rho c u) on both bodies;
    where a body moves by broken cells in a step, the edge is interpolated."""
    heat, levels = film(srr=sliding)
    edge = 16
    x = np.maximum((levels.X - levels.X[edge]) * levels.scales.a, 0.0)
    flux = (60e6 * x / 0.5e-3)[None, :]
    heat_bodies(heat, flux, steps=160)
    far = x > 3.5 * levels.dx * levels.scales.a
    for slot, body, B in zip((film_tables.AA, film_tables.AB), heat.bodies.each, ("B_a", "B_b")):
        rise = heat.columns.single(slot)[0] - 90.0 + heat.step[B] * flux[0]
        exact = 4 / 3 * 60e6 / 0.5e-3 * x**1.5 / np.sqrt(math.pi * 47 * 7850 * 450 * body.speed)
        np.testing.assert_allclose(rise[far], exact[far], rtol=within)


def test_the_share_of_each_body_follows_its_effusivity():
    """The same flux into steel and glass: temperatures as 1/sqrt(k rho c), 1/12885 and 1/1486; (4/3) sqrt(dt/pi) q of a flux
    that grows from nothing."""
    heat, _ = film(**{"bodies.b.k": 1.1, "bodies.b.rho": 2510.0, "bodies.b.c": 800.0})
    effusivities = [body.effusivity for body in heat.bodies.each]
    assert effusivities == pytest.approx([math.sqrt(47 * 7850 * 450), math.sqrt(1.1 * 2510 * 800)])
    heat.begin(heat.dt)
    steel, glass = heat.step["B_a"], heat.step["B_b"]
    assert glass / steel == pytest.approx(12885.2 / 1486.2, rel=1e-3)
    assert steel == pytest.approx(4 / 3 * math.sqrt(heat.dt / math.pi) / 12885.2, rel=1e-4)


def test_columns_without_a_solution_keep_the_temperatures_of_the_oil_that_came_in():
    """One Newton step where ten are needed: columns fail, and stop a step; held, they take those of the departure points."""
    heat, levels = film(srr=-0.5)
    X = levels.X
    levels.put(fields.P, np.sqrt(np.maximum(1 - X**2, 0)))
    levels.put(fields.H, np.full(X.size, 0.2e-6 / levels.scales.h))
    heat.begin(heat.dt)
    for holding in (0.0, 1.0):
        heat.step.set(iterations=1, tolerance=1e-12, hold=holding)
        report = heat.solve()
        assert (report.failed > 0) == (holding == 0)
    assert report.clamped > 0
    came, T, inside = heat.columns.nodes(film_tables.TS)[:, 0], heat.temperature()[:, 0], np.abs(X) < 0.7
    assert (T == came)[:, inside].all() and not np.allclose(T[:, inside], heat.columns.nodes(film_tables.LAST)[:, 0, inside])


def test_few_columns_without_a_solution_are_held_once():
    heat, _ = film()
    heat.report.failed = FEW + 1
    assert not heat.hold()
    heat.holding = False
    heat.report.failed = FEW
    assert heat.hold() and heat.holding and not heat.hold()
    heat.begin(heat.dt)
    assert heat.step["hold"] == 1.0
    heat.accept()
    assert not heat.holding


def test_at_a_crest_oil_slips_along_both_walls():
    """Frozen oil; beside the crest along the wall where the stress is larger, and no step is taken in parts."""
    from tehl_taichi.heat import sliding

    stiff = scene("gear").replace(**{"feature.length": math.inf, "grid.nx": 64, "oil.name": "mineral-vg220"})
    scales = Scales.of(stiff)
    passage = Passage(stiff, steady_snapshot(stiff).state)
    shots = [passage.advance() for _ in range(4)]
    assert sum(shot.scalars["rejected"] for shot in shots) == 0
    singles, v = passage.heat.columns.single, passage.levels
    at_a, at_b, px = (singles(kind)[0] for kind in (film_tables.SA, film_tables.SB, film_tables.PX))
    p, h = v.get(fields.P)[0] * scales.p_H, v.get(fields.H)[0] * scales.h
    wall = 0.5 * h * px / (sliding.CREST * wall_limit(stiff.rheology, p))
    loaded = p > 0.8 * scales.p_H
    near, rises, falls = (loaded & part for part in (np.abs(wall) < 0.9, wall > 1.1, wall < -1.1))
    assert near.any() and rises.any() and falls.any()
    assert (at_a[near] > 0).all() and (at_b[near] > 0).all()
    larger, smaller = (at_b, at_a) if stiff.operation.u_s < 0 else (at_a, at_b)
    assert (smaller[rises] < 1e-6 * larger[rises]).all() and (larger[falls] < 1e-6 * smaller[falls]).all()


def test_a_grid_that_moves_has_the_temperatures_of_one_at_rest():
    """States of the last two steps of a grid that has moved by 2 and by 3 columns since."""
    def solved(moved, before):
        heat, levels = film(srr=-0.2)
        X = levels.X
        levels.put(fields.P, 0.5 + 0.1 * np.sin(3 * X))
        levels.put(fields.H, (0.3e-6 + 0.05e-6 * np.cos(2 * X)) / levels.scales.h)
        heat.start()
        past = (film_tables.TN, film_tables.MSN, moved), (film_tables.TNN, film_tables.MSNN, moved + before)
        for n, (warm, below, cells) in enumerate(past, 1):
            T = 100 + 10 * np.sin(2 * X + n) + heat.across.zeta[:, None]
            mass = heat.columns.nodes(film_tables.MS)[:, 0] * (1 + 0.3 * np.sin(X + n) * heat.across.zeta[:, None])
            for kind, values in ((warm, T), (below, mass)):
                heat.columns.put_nodes(kind, np.roll(values, cells, axis=-1)[:, None])
            press = (film_tables.PN, film_tables.PNN)[n - 1]
            heat.columns.put_single(press, np.roll(4e8 * (1 + 0.1 * np.cos(X + n)), cells)[None])
        heat.dt_before, heat.moved_before = heat.dt, before
        heat.begin(heat.dt, moved)
        heat.solve()
        return heat.temperature()[:, 0, 10:-10]

    np.testing.assert_allclose(solved(2, 1), solved(0, 0), rtol=1e-9)
