"""The heat of the oil before the grid: what it is, and what the bars of the temperatures make of it."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from tehl_taichi.march.accuracy.domain_error import DomainError
from tehl_taichi.march.accuracy.domain_error import _before as friction_before
from tehl_taichi.march.accuracy.heat_before import heat_before
from tehl_taichi.march.passage import march
from tehl_taichi.march.steady import solve_steady
from tehl_taichi.pressure import fields, inlet
from tehl_taichi.pressure.inlet import Inlet
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales, load_of

# a thick film that hardly slides: most of its heat is that of oil that flows back
LIGHT = {"contact.hertz_pressure": 3.5e8, "speed": 8.0, "srr": 0.2, "temperature": 80.0, "grid.nx": 128, "grid.x_min": -4.5}


def light(**changes):
    return scene("smooth-line").replace(**{**LIGHT, "thermal.on": True, **changes})


def solved(description):
    return solve_steady(description, description.grid.nx, 0, lambda *_: None, False).solver


@pytest.mark.usefixtures("taichi_cpu")
def test_heat_before_the_grid_is_the_integral_along_the_inlet():
    """Summed along x, from the film at the border on, in m and with the oil's own numbers."""
    description = light()
    solver, s, o = solved(description), Scales.of(description), description.operation
    H, eta0 = solver.levels.get(fields.H), float(solver.levels.conditions["eta0"])
    carried = Inlet(solver.levels).carried(H) * s.h
    X = np.geomspace(4.5, 4e3, 200001)
    h = (H[0, 0] + (X**2 - 4.5**2) / 2 - np.log(X / 4.5) / 2) * s.h
    heat = eta0 * (12 * o.u_m**2 * (h - carried) ** 2 / h**3 + (o.u_a - o.u_b) ** 2 / h)
    oil = description.oil
    diffusivity = oil.k0 / (oil.rho0 * oil.c0 * (1 + oil.b0 * (o.temperature - 22)))
    reach = 4 * np.sqrt(diffusivity * X * s.a / o.u_m) / h
    exposed = np.trapezoid(heat / 2 * reach / (1 + reach) / np.sqrt(X * s.a), X * s.a)
    body = description.body_a
    for rise, speed in zip(heat_before(solver, Inlet(solver.levels)), (o.u_a, o.u_b)):
        assert rise == pytest.approx(exposed / math.sqrt(math.pi * speed * body.k * body.rho * body.c), rel=2e-3)


@pytest.mark.usefixtures("taichi_cpu")
def test_surfaces_that_a_longer_domain_warms_more_lie_inside_their_bars():
    short, far = (next(march(light(**{"grid.x_min": x, "grid.nx": nx}))) for x, nx in ((-4.5, 192), (-14.5, 512)))
    for name in ("surface_a_max_C", "surface_b_max_C"):
        error = far.scalars[name] - short.scalars[name]
        assert 0 < error < short.parts[name]["domain"] < 5 * error


@pytest.mark.usefixtures("taichi_cpu")
def test_the_faster_surface_is_warmed_less_and_one_at_rest_not_at_all():
    slow, fast = heat_before(solver := solved(light(srr=-0.5)), Inlet(solver.levels))
    assert slow / fast == pytest.approx(math.sqrt(1.25 / 0.75)) and solver.levels.scene.operation.u_a < 8.0
    moving, rests = heat_before(solver := solved(light(srr=2.0)), Inlet(solver.levels))
    assert rests == 0.0 < moving


@pytest.mark.parametrize("name", ["smooth-line", "ball-on-disc"])
def test_friction_before_the_grid_is_the_shear_of_the_oil_there_over_the_load(name):
    """Along the inlet in m; of a point contact over the width of the grid, on both sides of y = 0. Neither sign changes it."""
    description = scene(name).replace(srr=0.2)
    s, o = Scales.of(description), description.operation
    shear, side = 0.012 * (o.u_a - o.u_b), 1.5 * s.b  # Pa m
    far = inlet.far(-4.5, 12.0, float(s.line))
    X = np.geomspace(4.5, 1e6, 400001)
    h = (12.0 + (X**2 - 4.5**2) / 2 - s.line * np.log(X / 4.5) / 2) * s.h
    friction = np.trapezoid(shear / h, X * s.a) * (1.0 if s.line else 2 * side) / load_of(description)
    for slip in (o.u_a - o.u_b, o.u_b - o.u_a):
        grid = SimpleNamespace(line=s.line, Y=np.linspace(0.0, side / s.a, 9), scales=s,
                               conditions={"eta0": 0.012, "u_s": slip})
        assert friction_before(grid, SimpleNamespace(far=lambda H: far), None) == pytest.approx(friction, rel=1e-5)


def test_the_film_has_the_error_of_its_warmer_surface():
    found = DomainError(film=0.01, pressure=0.02, warmed_a=0.3, warmed_b=0.5)
    for passing, part in ((False, 2.0), (True, 3.0)):
        for name, warmed in (("film_max_C", 0.5), ("surface_a_max_C", 0.3), ("surface_b_max_C", 0.5)):
            assert found.of(name, 110.0, 90.0, passing) == pytest.approx(part * 0.01 * 20 + warmed)
    assert found.of("p_max_Pa", 1e9, 90.0, False) == pytest.approx(2e7)
    assert found.of("p_max_Pa", 1e9, 90.0, True) == pytest.approx(3e7)
