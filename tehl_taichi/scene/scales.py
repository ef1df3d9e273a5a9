"""Hertz units of a scene: what the dimensionless capitals stand for."""

import math
from dataclasses import dataclass

from tehl_taichi.scene import closed_form


@dataclass(frozen=True)
class Scales:
    """kind; R = R' m; E = E' Pa; a m half-width (X = x/a); p_H Pa (P = p/p_H); h = a^2/R' m (H = h R'/a^2);
    u_m m/s; t = a/u_m s (T = t u_m/a)."""

    kind: str
    R: float
    E: float
    a: float
    p_H: float
    u_m: float

    @property
    def h(self):
        return self.a**2 / self.R

    @property
    def t(self):
        return self.a / self.u_m

    @classmethod
    def of(cls, scene):
        """Scales of a scene."""
        R, E = scene.contact.radius_x, reduced_modulus(scene)
        hertz = closed_form.hertz_line if scene.contact.kind == "line" else closed_form.hertz_point
        a, p_H = hertz(scene.load, R, E)
        return cls(scene.contact.kind, R, E, a, p_H, scene.operation.u_m)


def reduced_modulus(scene):
    """E' with 2/E' = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b [Eq 1]."""
    return 2 / sum((1 - b.nu**2) / b.E for b in (scene.body_a, scene.body_b))


def load_of(scene):
    """Load in N/m (line) or N (point), however the contact was described."""
    contact = scene.contact
    R, E = contact.radius_x, reduced_modulus(scene)
    if contact.load > 0:
        return contact.load
    if contact.hertz_pressure > 0:
        by_pressure = closed_form.hertz_line_load if contact.kind == "line" else closed_form.hertz_point_load
        return by_pressure(contact.hertz_pressure, R, E)
    U = moes_speed(scene) * 2 * scene.oil.eta0 / (E * R)
    return contact.moes_M * (E * R * math.sqrt(U) if contact.kind == "line" else E * R**2 * U**0.75)


def moes_speed(scene):
    """u_m (m/s) at which the oil's alpha and eta0 give moes_L = alpha E' U^(1/4), U = 2 eta0 u_m/(E' R')."""
    R, E = scene.contact.radius_x, reduced_modulus(scene)
    return (scene.contact.moes_L / (scene.oil.alpha * E)) ** 4 * E * R / (2 * scene.oil.eta0)
