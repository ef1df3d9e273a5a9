"""Which precision of the linear solves suits a scene."""

import math

from tehl_taichi.scene import closed_form
from tehl_taichi.scene.parts import AUTO
from tehl_taichi.scene.scales import Scales, reduced_modulus

# Central film (in a^2/R') from which on they are done in single precision. The deflection of a trial pressure is known to
# 1e-7 of its largest value then, too little for thin films on coarse grids: of 200 random scenes 7 converge in double only,
# all of them thinner than 0.003; the gear has 0.03.
THICK = 0.01


def of(scene):
    """"f32" or "f64": what the scene asks for, or what suits it."""
    wanted = scene.numerics.precision
    return suited(scene) if wanted == AUTO else wanted


def suited(scene):
    """"f32" for thick films, else "f64"; the state and its residual are in double precision either way."""
    return "f32" if expected_film(scene) > THICK else "f64"


def expected_film(scene):
    """Central film in units of a^2/R' by the formulas for line (Moes) and circular contacts (Nijenbanning et al. 1994)."""
    from tehl_taichi.physics.viscosity import ln_eta  # imports taichi

    s, E, Gamma = Scales.of(scene), reduced_modulus(scene), scene.operation.temperature
    ln0, step = float(ln_eta(scene.oil, 0.0, Gamma)), 1e6
    alpha = (float(ln_eta(scene.oil, step, Gamma)) - ln0) / step
    M, L = closed_form.moes_numbers(scene.load, s.R, E, math.exp(ln0), alpha, s.u_m, "line" if s.line else "point")
    film = closed_form.moes_line(M, L) if s.line else closed_form.nijenbanning(M, L)
    return film * math.sqrt(2 * math.exp(ln0) * s.u_m / (E * s.R)) * s.R / s.h
