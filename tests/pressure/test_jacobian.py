"""The Jacobian of the pressure equations against differences of their residual: all that Newton's steps live on."""

import numpy as np
import pytest

from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.isothermal import OneTemperature
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.pressure.newton import ROW_CAP, PressureSolver
from tehl_taichi.scene import scene


def mismatch(description, warm=None, step=1e-5):
    """Largest difference of Jacobian times change and difference of residuals, over the largest of these, for changes of the
    pressure in a few long and short waves and of the rigid approach; with a time derivative in a moving frame."""
    levels = Levels(description, 64, 16)
    film = OneTemperature(levels) if warm is None else FilmHeat(levels, 1e-6)
    solver, X, Y = PressureSolver(levels, film), levels.X[None, :], levels.Y[:, None]
    ends = (levels.X[-1] - X) * (X - levels.X[0]) / 4
    P = 0.12 * ends * (1 + 0.1 * np.cos(3 * X) * np.cos(np.pi * Y))
    levels.put(fields.GAP0, levels.smooth_gap() + 0.3 + 0.02 * np.sin(2 * X) * np.cos(np.pi * Y))
    levels.numbers.set_rate(11.0, 0.7)
    if warm is not None:
        film.start(warm(film.across.zeta[:, None, None], X, Y))

    def residual(pressure, H0):
        levels.put(fields.P, pressure)
        solver.H0 = H0
        solver.residual()
        return levels.vector(fields.R)

    inside = levels.vector(fields.MASK) > 0
    worst = 0.0
    for kx, ky, approach in ((1.0, 0.0, 0.0), (9.0, np.pi, 0.1), (25.0, 8 * np.pi, -0.3), (0.0, 0.0, 1.0)):
        change = ends * np.cos(kx * X + 0.3) * np.cos(ky * Y) * (kx > 0)
        found = [residual(P + sign * step * change, sign * step * approach) for sign in (1, -1)]
        exact = (found[0] - found[1]) / (2 * step)
        residual(P, 0.0)
        solver.equations.linearise()
        solver.measure()
        solver._choose_sets()
        levels.put(fields.P, change)  # in the order of the table
        rows = solver.linear.krylov.apply(levels.vector(fields.P) * inside, approach)
        scale = np.where(levels.vector(fields.DRY) > 0, 1.0, np.minimum(levels.vector(fields.D), ROW_CAP))
        product = rows * scale
        worst = max(worst, float(np.abs(product - exact)[inside].max() / np.abs(exact)[inside].max()))
    return worst


def thick(name, **changes):
    """A scene whose film, a third of a^2/R', carries with all terms of about one size."""
    return scene(name).replace(**{"grid.nx": 64, "grid.ny": 16, "grid.x_min": -2.5, "grid.y_max": 1.25,
                                  "contact.hertz_pressure": 0.4e9, "height": 0.1e-6, **changes})


def test_isothermal(taichi_cpu):
    assert mismatch(thick("gear", **{"thermal.on": False, "rheology.law": "newtonian", "speed": 3.0})) < 1e-5


def test_isothermal_with_a_shear_limit(taichi_cpu):
    """The flow depends on pressure and film by the stress of the sliding, too."""
    assert mismatch(thick("gear", **{"thermal.on": False, "srr": -1.9, "temperature": 40.0})) < 1e-5


def test_with_temperatures_and_a_shear_limit(taichi_cpu):
    """The flow depends on what the temperatures make of both its parts, too."""
    def warm(z, X, Y):
        return 40 + 30 * z + 20 * z * (1 - z) * (1 + 0.2 * np.cos(X) * np.cos(np.pi * Y))

    # so weak that walls yield: the ratio of both fluidities counts
    weak = {"rheology.tau_L0": 1e5, "rheology.gamma": 5e-4, "speed": 3.0, "srr": -1.9}
    assert mismatch(thick("gear", **{"thermal.on": True, "temperature": 40.0, **weak}), warm, 1e-8) < 2e-5


@pytest.mark.parametrize("srr", [0.0, -0.1])
@pytest.mark.parametrize("law, step", [({"law": "limiting", "tau_L0": 1e5, "gamma": 5e-4}, 1e-8),
                                       # 4 and 10 s of compilation; tests/laws/test_sheared_flow.py has their derivatives
                                       pytest.param({"law": "eyring", "tau_0": 3e4}, 1e-6, marks=pytest.mark.slow),
                                       pytest.param({"law": "carreau", "tau_0": 3e4, "carreau_n": 0.5}, 1e-6,
                                                    marks=pytest.mark.slow)],
                         ids=lambda law: law["law"] if isinstance(law, dict) else "")
def test_walls_that_yield_to_the_pressure(taichi_cpu, law, step, srr):
    """In pure rolling, where the law acts by the gradient of the pressure alone, and with some slip; limiting: a step that few
    walls come to their limit within, where the flow bends."""
    weak = {f"rheology.{key}": value for key, value in law.items()}
    assert mismatch(thick("gear", **{"thermal.on": False, "srr": srr, "speed": 3.0, **weak}), step=step) < 1e-4


def diagonals(turned):
    """The diagonal of a line whose walls switch: by tangents, and after a linearisation of the same state, or (turned) of the
    one with the opposite ripple."""
    description = scene("smooth-line").replace(**{"thermal.on": False, "srr": 0.12, "grid.nx": 64})
    levels = Levels(description, 64, 0)
    solver, X = PressureSolver(levels, OneTemperature(levels)), levels.X[None, :]

    def linearised(ripple, again):
        levels.put(fields.P, np.sqrt(np.maximum(1 - X**2, 0)) + ripple * np.cos(20 * X) * (np.abs(X) < 0.8))
        solver.residual()
        solver.equations.linearise(again=again)
        return levels.get(fields.D)[0, 1:-1].copy()

    tangents = linearised(0.3, False)
    linearised(-0.3 if turned else 0.3, False)
    return tangents, linearised(0.3, True)


def test_a_flux_that_was_expected_has_its_tangent(taichi_cpu):
    tangents, found = diagonals(turned=False)
    np.testing.assert_allclose(found, tangents, rtol=1e-9)


def test_a_flux_that_was_not_expected_has_a_steeper_slope(taichi_cpu):
    """Between tangent and secant: nowhere flatter, and by far steeper where the walls have switched."""
    tangents, found = diagonals(turned=True)
    assert (found > 0.999 * tangents).all() and (found > 1.1 * tangents).sum() > 5 and (found > 1.5 * tangents).any()
