"""Heat of the oil that is sheared before the grid: by how much it would warm the surfaces in the contact.

Per area the oil heats by 12 eta_0 u_m^2 (h - h*)^2/h^3 (it flows back) and eta_0 u_s^2/h (surfaces slide), half for each
surface. A share r/(1 + r) conducts to the surfaces until the oil reaches the contact, r = 4 sqrt(kappa |x|/u_m)/h. A surface
with effusivity e and speed u warms by int q/sqrt(|x|) dx/(e sqrt(pi u)) (Carslaw and Jaeger 1959). Smooth line, 0.3 to 0.8 GPa,
2 to 30 m/s, from -2.5, -4.5 and -8.5 a, against -18 a: the error of surface temperatures is 0.4 to 1.7 of it
(docs/decisions/02-inlet.md).
"""

import math

import numpy as np

from tehl_taichi.laws.conduction import conductivity, heat_capacity
from tehl_taichi.pressure import fields

REACHES = 4.0  # oil between walls gives off its heat over a quarter of the film thickness


def heat_before(solver, inlet):
    """Rises (K) of surfaces a and b in the contact by the heat of the oil before the grid; 0 at rest, where it stays outside.

    inlet: the :class:`tehl_taichi.pressure.inlet.Inlet` of the solver.
    """
    v, o = solver.levels, solver.levels.scene.operation
    H = v.get(fields.H)
    X, gap, weights = inlet.far(H)
    flux = _heat(v, gap, inlet.carried(H)) * _conducted(v, np.abs(X), gap) / 2
    exposed = float(np.sum(weights * flux / np.sqrt(np.abs(X)))) * math.sqrt(v.scales.a)
    bodies = zip((v.scene.body_a, v.scene.body_b), (o.u_a, o.u_b), v.scene.at_rest)
    return tuple(0.0 if rests else exposed / math.sqrt(math.pi * u * body.k * body.rho * body.c) for body, u, rests in bodies)


def _heat(v, gap, carried):
    """Heat of the oil per area (W/m2) where the film is `gap`; carried: its flow over the mean speed, both in a^2/R'."""
    back = 12 * v.scene.operation.u_m ** 2 * (gap - carried) ** 2 / gap**3
    return float(v.conditions["eta0"]) * (back + float(v.conditions["u_s"]) ** 2 / gap) / v.scales.h


def _conducted(v, distance, gap):
    """Share of the heat that reaches the surfaces; distance: to the middle of the contact, in a; gap: in a^2/R'."""
    oil, o = v.scene.oil, v.scene.operation
    diffusivity = float(conductivity(oil, 0.0)) / float(heat_capacity(oil, 0.0, o.temperature))
    reach = REACHES * np.sqrt(diffusivity * distance * v.scales.a / o.u_m) / (gap * v.scales.h)
    return reach / (1 + reach)
