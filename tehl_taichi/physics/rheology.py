"""Shear laws: the stress that a film bears for a given Newtonian stress eta * (shear rate), all in Pa."""

import taichi as ti

from tehl_taichi.engine.elementary import exp, log

LARGEST = 1e100  # Pa: beyond any trial state, and its square is still a number


@ti.pyfunc
def shear_limit(rheology: ti.template(), p):
    """Limiting shear stress tau_L0 + gamma p."""
    return rheology.tau_L0 + rheology.gamma * p


@ti.pyfunc
def boundary_stress(rheology: ti.template(), p):
    """Friction where the surfaces touch: mu_boundary p, at most the shear limit of what is left between them."""
    return ti.min(rheology.mu_boundary * p, shear_limit(rheology, p))


@ti.pyfunc
def secant(rheology: ti.template(), newtonian, p):
    """shear_stress / newtonian: what is left of the viscosity, 1 without shear."""
    small = ti.abs(newtonian) < 1e-3
    safe = ti.select(small, newtonian + 1.0, ti.min(ti.max(newtonian, -LARGEST), LARGEST))
    return ti.select(small, 0.0 * newtonian + 1.0, shear_stress(rheology, safe, p) / safe)


@ti.pyfunc
def sensitivity(rheology: ti.template(), newtonian, p, b):
    """d shear_stress/d newtonian over the secant b: 1 + d ln b/d ln newtonian."""
    return (secant(rheology, newtonian * 1.001, p) * 1.001 - b) * 1000.0 / b


@ti.pyfunc
def shear_stress(rheology: ti.template(), newtonian, p):
    """Stress by the chosen law.

    limiting: shear rate = (tau/eta) (1 - (tau/tau_L)^2)^(-1/2), solved for tau; eyring: tau_0 asinh(newtonian/tau_0);
    carreau: newtonian (1 + (newtonian/tau_0)^2)^((n-1)/2); newtonian: as it is.
    """
    out = newtonian
    if ti.static(rheology.law == "limiting"):
        r = newtonian / shear_limit(rheology, p)
        out = newtonian / ti.sqrt(1 + r * r)
    elif ti.static(rheology.law == "eyring"):
        r = ti.abs(newtonian) / rheology.tau_0
        sign = ti.select(newtonian < 0, -1.0, 1.0)
        out = sign * rheology.tau_0 * log(r + ti.sqrt(r * r + 1))
    elif ti.static(rheology.law == "carreau"):
        r = newtonian / rheology.tau_0
        out = newtonian * exp(0.5 * (rheology.carreau_n - 1) * log(1 + r * r))
    return out
