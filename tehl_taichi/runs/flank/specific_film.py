"""Specific film thickness of ISO/TS 6336-22 (micropitting): film by a formula over the mean roughness of both flanks.

lambda_GF,Y = h_Y/Ra with Ra = (Ra1 + Ra2)/2 and h_Y = 1.6 R' G^0.6 U^0.7 W^-0.13 S^0.22 (Dowson & Higginson). S_lambda = the
smallest lambda_GF,Y over lambda_GFP: Jbily et al., Procedia Structural Integrity 57 (2024) 199-216, Eq 1 and 8 to 10. G = alpha
E_r, U = eta u_m/(E_r R'), W = 2 pi p_H^2/E_r^2, S = alpha eta at the contact temperature over alpha eta at the bulk
temperature, and the flash temperature are formulae 5, 12, 22, 27 and 80 of ISO/TR 15144-1:2014. Oil and bulk temperature are
those of the scene, the friction coefficient is that of the run, load factors (K_A ...) are 1.
"""

import math

from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.scene.film_formula import pressure_coefficient
from tehl_taichi.scene.scales import Scales, reduced_modulus


def film_ratios(scene, summary, Ra):
    """{"lambda_GF": by formula, "h_min_Ra": computed minimum film of the steady contact over Ra}; {} without Ra (m) or
    result.
    """
    if not Ra or not summary:
        return {}
    steady = summary["steady"]
    h = formula_film(scene, abs(steady.get("friction_coefficient", 0.0)))
    return {"lambda_GF": h / Ra, "h_min_Ra": steady["h_min_m"] / Ra}


def formula_film(scene, friction):
    """Film thickness h_Y (m)."""
    s, E, bulk = Scales.of(scene), reduced_modulus(scene), scene.operation.temperature
    eta, alpha = oil_at(scene, bulk)
    hot_eta, hot_alpha = oil_at(scene, bulk + flash(scene, friction))
    G, U, W = alpha * E, eta * scene.operation.u_m / (E * s.R), 2 * math.pi * (s.p_H / E) ** 2
    return 1.6 * s.R * G**0.6 * U**0.7 * W**-0.13 * (hot_alpha * hot_eta / (alpha * eta)) ** 0.22


def oil_at(scene, temperature):
    """Viscosity (Pa s) and pressure coefficient (1/Pa) at p = 0."""
    return math.exp(float(ln_eta(scene.oil, 0.0, temperature))), pressure_coefficient(scene.oil, temperature)


def flash(scene, friction):
    """Flash temperature: rise of the surface temperature in the contact by Blok, K."""
    s, E, o = Scales.of(scene), reduced_modulus(scene), scene.operation
    takes = sum(math.sqrt(b.rho * b.c * b.k * abs(u)) for b, u in ((scene.body_a, o.u_a), (scene.body_b, o.u_b)))
    return math.sqrt(math.pi) / 2 * friction * s.p_H * abs(o.u_a - o.u_b) / takes * math.sqrt(8 * s.R * s.p_H / E)


def smallest(flank):
    """(lambda_GF,min, its position) of a flank, None without values."""
    found = [(at.film_ratios["lambda_GF"], at) for at in flank.positions if at.film_ratios]
    return min(found, key=lambda one: one[0], default=None)


def safety(flank):
    """Safety factor S_lambda, None without a permissible value."""
    least, allowed = smallest(flank), flank.record["geometry"].get("lambda_GFP")
    return least[0] / allowed if least and allowed else None
