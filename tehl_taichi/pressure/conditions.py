"""Numbers of a scene for kernels, see :mod:`tehl_taichi.engine.records`."""

import math

import numpy as np

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import Record
from tehl_taichi.laws.viscosity import ln_eta


@ti.dataclass
class Conditions:
    """Units, speeds and inlet of a contact."""

    p_H: ti.f64  # Pa, of P = 1
    h: ti.f64  # m, of H = 1
    a: ti.f64  # m, of X = 1
    inlet: ti.f64  # deg C
    ln_eta0: ti.f64  # ln of the viscosity (Pa s) of the inlet, at p = 0
    eta0: ti.f64  # Pa s
    u_a: ti.f64  # m/s, speed of body a
    u_s: ti.f64  # m/s, slip u_a - u_b
    u_m: ti.f64  # m/s, mean speed
    centre: ti.f64  # column of X = 0
    strain: ti.f64  # part of the stress that the pressure puts on the walls which the shear law sees


def conditions(scene, scales, X):
    """Record of the Conditions of a scene, with columns at X."""
    o, inlet = scene.operation, scene.operation.temperature
    ln_eta0 = float(ln_eta(scene.oil, 0.0, inlet))
    return Record(Conditions, p_H=scales.p_H, h=scales.h, a=scales.a, inlet=inlet, ln_eta0=ln_eta0, eta0=math.exp(ln_eta0),
                  u_a=o.u_a, u_s=o.u_s, u_m=o.u_m, centre=np.searchsorted(X, 0.0),
                  strain=1.0)
