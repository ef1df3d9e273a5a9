"""Load of the oil beyond the border: it counts in the balance of the load, which the grid and that oil carry together."""

import numpy as np
import pytest

from tehl_taichi.march.passage import march
from tehl_taichi.march.steady import solve_steady
from tehl_taichi.pressure import fields
from tehl_taichi.pressure import inlet as module
from tehl_taichi.pressure.grids import load_weights
from tehl_taichi.pressure.inlet import Inlet
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

NEWTONIAN = {"thermal.on": False, "rheology.law": "newtonian", "srr": 0.0}
# 0.6 GPa and 10 m/s of hot oil: a fifth of the load lies outside the usual domain
THICK = {**NEWTONIAN, "hertz_pressure": 6e8, "speed": 10.0, "grid.nx": 64, "grid.ny": 24}


def film(description, height):
    """The Inlet of a table with the gap of the rigid bodies and a film of this height (a^2/R')."""
    s = Scales.of(description)
    levels = Levels(description, description.grid.nx, 0 if s.line else description.grid.ny)
    levels.put(fields.H, levels.smooth_gap() + height)
    levels.put(fields.RHO, np.ones((levels.ny + 1, levels.nx + 1)))
    return Inlet(levels)


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("name, changes", [("mtm", {}), ("ball-bearing", {"grid.x_min": -6.5, "grid.y_max": 3.0})])
def test_of_rigid_paraboloids_it_is_the_integral_of_their_pressure(name, changes, monkeypatch):
    """Pressure 12 eta0 u |x|/((3 + 2 R_x/R_y) h^2) over the plane x < 0 outside the grid, cell by cell."""
    inlet = film(scene(name).replace(**NEWTONIAN, **{"grid.nx": 64, "grid.ny": 24, **changes}), 0.3)
    v = inlet.levels
    monkeypatch.setattr(Inlet, "warmth", lambda self: 1.0)
    monkeypatch.setattr(Inlet, "_kappa", lambda self, H, carried: 1.0)
    monkeypatch.setattr(Inlet, "_pressure", lambda self, q: q / v.scales.p_H)
    k, factor = v.scales.curvature, 1 / v.numbers.inv_lambda
    t = (np.arange(2000) + 0.5) / 2000
    x, y = -t / (1 - t) * 3, t / (1 - t) * 3  # up to infinity
    dx = 3 / (1 - t) ** 2 / 2000
    X, Y = x[:, None], y[None, :]
    outside = (X < v.X[0] - v.dx / 2) | (Y > v.Y[-1] - v.dy / 2)
    P = factor * np.abs(X) / ((3 + 2 * k) * (0.5 * X**2 + 0.5 * k * Y**2 + 0.3) ** 2)
    exact = 2 * np.sum(P * outside * dx[:, None] * dx[None, :])
    assert inlet.load() == pytest.approx(exact, rel=0.04)


@pytest.mark.usefixtures("taichi_cpu")
def test_of_a_line_it_is_the_integral_of_the_pressure_beyond(monkeypatch):
    """Beside a parabola without flow H = X^2/2: P = 4/(3 |X|^3) over inv_lambda, its integral 2/(3 X^2)."""
    inlet = film(scene("smooth-line").replace(**NEWTONIAN, **{"grid.nx": 64}), 0.0)
    v = inlet.levels
    monkeypatch.setattr(Inlet, "carried", lambda self, H: 0.0)
    far = module.far
    monkeypatch.setattr(module, "far", lambda X, H, log: far(X, H, 0.0))
    assert inlet.load() == pytest.approx(2 / (3 * v.X[0] ** 2) / v.numbers.inv_lambda, rel=1e-6)
    starved = film(scene("smooth-line").replace(**NEWTONIAN, **{"grid.nx": 64, "grid.inlet": "starved"}), 0.0)
    assert starved.load() == 0.0


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("name, share, changes", [("mtm", 0.15, {}),
                                                  ("smooth-line", 0.01, {"temperature": 60.0, "speed": 20.0})])
def test_the_grid_and_the_oil_beyond_carry_the_load_together(name, share, changes):
    one = scene(name).replace(**{**THICK, **changes})
    s = Scales.of(one)
    found = solve_steady(one, one.grid.nx, 0 if s.line else one.grid.ny)
    v = found.solver.levels
    carried, beyond = np.sum(load_weights(v) * v.get(fields.P)), Inlet(v).load()
    assert found.report.converged and beyond > share * s.load
    assert carried + beyond == pytest.approx(s.load, rel=1e-5)


@pytest.mark.usefixtures("taichi_cpu")
def test_thick_films_of_circles_are_those_of_large_domains():
    """Film and largest pressure on the usual domain lie inside their bars; without that load they were 6 % and half as much
    again off."""
    usual, large = (next(march(scene("mtm").replace(**{**THICK, **changes}))) for changes in (
        {"grid.nx": 128, "grid.ny": 48},
        {"grid.x_min": -20.0, "grid.x_max": 3.0, "grid.y_max": 16.0, "grid.nx": 368, "grid.ny": 128}))
    for name in ("h_c_m", "p_max_Pa"):
        assert abs(usual.scalars[name] / large.scalars[name] - 1) < 0.06
        assert abs(usual.scalars[name] - large.scalars[name]) < usual.error[name]
    assert usual.scalars["h_c_m"] == pytest.approx(2.03e-6, rel=0.02)


@pytest.mark.usefixtures("taichi_cpu")
def test_a_passage_keeps_the_load_of_its_start():
    """So that a resumed one gives the same bits."""
    ridge = scene("ridge-on-ball").replace(**{**NEWTONIAN, "speed": 3.0, "grid.nx": 64, "grid.ny": 16, "time.steps": 4})
    first, *rest = march(ridge)
    states = [first.state, *(shot.state for shot in rest[-1:])]
    assert states[0]["load"] == states[1]["load"] < Scales.of(ridge).load
    again = [*march(ridge, first.state)]
    for one, other in zip(rest, again):
        assert (one.fields["pressure"] == other.fields["pressure"]).all()
