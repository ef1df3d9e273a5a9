"""Slow and resting surfaces of point contacts against exact half-spaces under the same heat."""

import math

import numpy as np
import pytest

from tehl_taichi.heat import conduction_modes, film_tables
from tehl_taichi.heat.bodies import ConductingBody
from tehl_taichi.heat.conduction_modes import is_fast, widths
from tehl_taichi.heat.strips import DECAY, GAIN, GAIN_LAST, WEIGHT
from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march.alternating_start import time_step
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales, peclet

pytestmark = pytest.mark.usefixtures("taichi_cpu")
STEEL = dict(k=47.0, rho=7850.0, c=450.0)
ALPHA = STEEL["k"] / STEEL["rho"] / STEEL["c"]


def film(srr, ratio):
    """A FilmHeat on 64 columns of a point contact, steel on steel, and its levels."""
    steel = {f"bodies.{body}.{key}": value for body in "ab" for key, value in STEEL.items()}
    description = scene("ball-on-disc").replace(
        srr=srr, speed=2.0, **{"thermal.on": True, "rheology.law": "limiting", "oil.name": "reference-pao",
                               "contact.kind": "elliptic" if ratio != 1 else "point",
                               "contact.radius_x": 0.0127, "contact.radius_y": 0.0127 * ratio, "grid.nx": 64, "grid.ny": 24,
                               "grid.x_min": -2.0, "grid.x_max": 1.5, "grid.y_max": 1.5, **steel})
    levels = Levels(description, 64, 24)
    heat = FilmHeat(levels, time_step(levels))
    heat.start()
    return heat, levels


def hertzian(levels, q=1e8):
    """(nx+1, 2 ny+1) W/m2 on the whole ellipse; dx, dy in m."""
    s = levels.scales
    y = np.arange(-levels.ny, levels.ny + 1) * levels.dy
    flux = q * np.sqrt(np.maximum(1 - levels.X[:, None] ** 2 - (y * s.a / s.b) ** 2, 0))
    return flux, levels.dx * s.a, levels.dy * s.a


def exact(flux, dx, dy, u):
    """Steady rise (K) of the surface of a half-space that moves at u along x under the flux (nodes in x, y): the moving point
    source exp(-u (r - x)/2 alpha)/(2 pi k r) (Carslaw & Jaeger 1959, section 10.7), averaged over cells near its pole."""
    n, m = 4 * flux.shape[0], 4 * flux.shape[1]
    part = (np.arange(24) - 11.5) / 24
    x, y = (np.fft.fftfreq(count, 1 / count) * step for count, step in ((n, dx), (m, dy)))

    def source(x, y):
        r = np.hypot(x, y)
        return np.exp(-u * (r - x) / (2 * ALPHA)) / (2 * np.pi * STEEL["k"] * np.maximum(r, 1e-12))

    G = source(x[:, None], y[None, :])
    for i in range(-5, 6):
        for j in range(-5, 6):
            G[i, j] = source((i + part)[:, None] * dx, (j + part)[None, :] * dy).mean()
    padded = np.zeros((n, m))
    padded[: flux.shape[0], : flux.shape[1]] = flux
    return np.fft.ifft2(np.fft.fft2(padded) * np.fft.fft2(G)).real[: flux.shape[0], : flux.shape[1]] * dx * dy


def heated(srr, ratio):
    """(rise of surface b under a Hertzian flux, exact rise, flux) on the half domain, Peclet number."""
    heat, levels = film(srr, ratio)
    body, flux = heat.bodies.each[1], None
    whole, dx, dy = hertzian(levels)
    flux = whole[:, levels.ny :].T
    steps = 0 if body.rests else math.ceil(4 / levels.dx * levels.scene.operation.u_m / body.speed)
    for _ in range(steps + 1):
        B = heat.bodies.begin(heat.dt)[1]
        for slot in (film_tables.QA, film_tables.QB):
            heat.columns.put_single(slot, flux)
        rise = heat.columns.single(film_tables.AB) - levels.scene.operation.temperature + B * flux
        if not body.rests:
            heat.bodies.steady = False
            heat.bodies.accept()
    own = exact(whole, dx, dy, body.speed)[:, levels.ny :].T
    return rise, own, flux, peclet(levels.scene.body_b, body.speed, levels.scales)


@pytest.mark.parametrize("ratio, srr", [*((1.0, srr) for srr in (2.0, 1.97, 1.9, 1.5, 0.0)), (3.0, 2.0), (3.0, 1.9), (0.5, 1.9),
                                        *(pytest.param(3.0, srr, marks=pytest.mark.slow) for srr in (1.97, 1.5, 0.0)),
                                        *(pytest.param(0.5, srr, marks=pytest.mark.slow) for srr in (2.0, 1.97, 1.5, 0.0))])
def test_a_slow_surface_is_as_hot_as_an_exact_half_space(srr, ratio):
    rise, own, flux, number = heated(srr, ratio)
    assert 0.1 * (2 - srr) < number < 20 * (2 - srr) or srr == 2
    within = 0.05 if ratio <= 1 else 0.07
    assert rise.max() == pytest.approx(own.max(), rel=within)
    assert (rise * flux).sum() == pytest.approx((own * flux).sum(), rel=within)


def test_the_memory_loses_heat_as_its_kernel_does():
    """Steady flux: the integral of K, at every step, and after a long time."""
    spread = 300.0, 2000.0
    v = np.concatenate([[0.0], np.geomspace(1e-3, 1e5, 400001)])
    K = 2 / np.sqrt(np.pi * (1 + v * v / spread[0]) * (1 + v * v / spread[1]))
    whole = np.concatenate([[0.0], np.cumsum(0.5 * (K[1:] + K[:-1]) * np.diff(v))])
    known, memory, worst = conduction_modes.memory(1.0, 1.0, 1.0, spread=spread), np.zeros(conduction_modes.MODES), 0.0
    for n in range(1, 3000):
        warm = (known.weight * known.decay * memory).sum() + known.B + known.B_last
        worst = max(worst, abs(warm / np.interp(math.sqrt(n), v, whole) - 1))
        memory = known.decay * memory + known.gain + known.gain_last
    assert worst < 4e-3
    settled = (known.weight * known.decay) @ conduction_modes.steady_modes(1.0, math.inf, spread) + known.B + known.B_last
    assert settled == pytest.approx(whole[-1], rel=5e-3)


@pytest.mark.parametrize("ratio, slowest", [(0.2, 2500.0), (0.5, 400.0), (1.0, 100.0), (3.0, 100.0)])
def test_a_surface_is_fast_where_sideways_conduction_takes_less_than_a_hundredth(ratio, slowest):
    """Of the rise by a steady flux over the whole length of the contact; ratio: b/a. Time in a^2/alpha, its root from 0 on."""
    assert is_fast(1.01 * slowest, 1.0, ratio) and not is_fast(0.99 * slowest, 1.0, ratio)
    assert is_fast(1.01 * slowest, 2e-4, ratio * 2e-4)
    root = np.linspace(0.0, math.sqrt(2 / slowest), 1001)
    kept = np.prod([1 / np.sqrt(1 + 4 * root**2 / width**2) for width in widths(slowest, 1.0, ratio)], axis=0)
    assert 0.99 < kept.mean() < 1.0


def test_fast_surfaces_and_lines_lose_nothing_sideways():
    ball, line = (scene(name) for name in ("ball-on-disc", "smooth-line"))
    for one, speed, alone in ((ball, 50.0, True), (ball, 0.05, False), (line, 0.05, True)):
        assert (ConductingBody(one.body_a, speed, False, 1e-6, Scales.of(one)).spread == conduction_modes.NONE) == alone


def test_a_settled_surface_at_rest_has_the_temperature_of_many_steps():
    """Of the same flux in all of them."""
    line = scene("smooth-line")
    body, modes = ConductingBody(line.body_a, 0.0, True, 1e-6, Scales.of(line)), 0.0
    steady = body.begin(0.1, 0.0, 0.0, settled=True)
    for _ in range(400):
        B = body.begin(0.1, 0.0, 0.0, settled=False)
        found = B + body.drift["B_last"] + (body.modes[WEIGHT] * body.modes[DECAY]) @ (modes + np.zeros(body.modes.shape[1]))
        modes = body.modes[DECAY] * modes + body.modes[GAIN] + body.modes[GAIN_LAST]
    assert found == pytest.approx(steady, rel=1e-6) and found > 1.5 * B
