"""Central film by the formulas of the field: isothermal, Newtonian, smooth."""

import math

from tehl_taichi.physics.viscosity import ln_eta
from tehl_taichi.scene import closed_form
from tehl_taichi.scene.scales import Scales, reduced_modulus

STEP = 1e6  # Pa, of the pressure coefficient of viscosity


def central_film(scene):
    """Film (m) at the centre by Moes (line) or by Nijenbanning, Venner & Moes 1994 (circle; an ellipse counts as a circle of
    its radius along x)."""
    s, E, Gamma = Scales.of(scene), reduced_modulus(scene), scene.operation.temperature
    ln_eta0 = float(ln_eta(scene.oil, 0.0, Gamma))
    alpha = (float(ln_eta(scene.oil, STEP, Gamma)) - ln_eta0) / STEP
    eta0 = math.exp(ln_eta0)
    M, L = closed_form.moes_numbers(scene.load, s.R, E, eta0, alpha, s.u_m, "line" if s.line else "point")
    film = closed_form.moes_line(M, L) if s.line else closed_form.nijenbanning(M, L)
    return film * math.sqrt(2 * eta0 * s.u_m / (E * s.R)) * s.R
