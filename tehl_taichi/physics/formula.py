"""Central film by the formulas of the field: isothermal, Newtonian, smooth."""

import functools
import math

import numpy as np

from tehl_taichi.physics.viscosity import ln_eta
from tehl_taichi.scene import closed_form
from tehl_taichi.scene.scales import Scales, reduced_modulus

PRESSURES = np.linspace(0.0, 1.5e9, 201)  # Pa; 1/eta has fallen to 1e-7 at the last


def central_film(scene):
    """Film (m) at the centre by Moes (line) or by Nijenbanning, Venner & Moes 1994 (circle; an ellipse counts as a circle of
    its radius along x)."""
    s, E, Gamma = Scales.of(scene), reduced_modulus(scene), scene.operation.temperature
    eta0, alpha = math.exp(ln_eta(scene.oil, 0.0, Gamma)), pressure_coefficient(scene.oil, Gamma)
    M, L = closed_form.moes_numbers(scene.load, s.R, E, eta0, alpha, s.u_m, "line" if s.line else "point")
    film = closed_form.moes_line(M, L) if s.line else closed_form.nijenbanning(M, L)
    return film * math.sqrt(2 * eta0 * s.u_m / (E * s.R)) * s.R


@functools.lru_cache(maxsize=64)
def pressure_coefficient(oil, Gamma):
    """alpha* (1/Pa) = 1 / int eta0/eta dp, the coefficient that films follow whatever the law (Blok 1963): of the gear's oil
    1.15e-8, its slope at the inlet 1.37e-8."""
    fluidity = np.exp([ln_eta(oil, 0.0, Gamma) - ln_eta(oil, float(p), Gamma) for p in PRESSURES])
    return 1 / float(np.trapezoid(fluidity, PRESSURES))
