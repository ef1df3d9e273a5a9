"""Hertz units of a scene, by which dimensionless capitals (X, P, H ...) are scaled."""

import math
from dataclasses import dataclass

from tehl_taichi.scene import hertz


@dataclass(frozen=True)
class Scales:
    """Hertz units. kind: line or point (circular, elliptic); R = R' (along x) m; E = E' Pa; a m half-width along x (X = x/a), b
    m along y (line: a); p_H Pa (P = p/p_H); h = a^2/R' m (H = h R'/a^2); u_m m/s; t = a/u_m s (T = t u_m/a); curvature: the
    undeformed gap is X^2/2 + curvature Y^2/2.
    """

    kind: str
    R: float
    E: float
    a: float
    b: float
    p_H: float
    u_m: float
    curvature: float

    @property
    def h(self):
        return self.a**2 / self.R

    @property
    def t(self):
        return self.a / self.u_m

    @property
    def words(self):
        """Description of the dry contact."""
        across = "" if self.line else f", half-axis b = {self.b * 1e3:.4f} mm across"
        return f"Hertz contact: half-width a = {self.a * 1e3:.4f} mm{across}, p_H = {self.p_H / 1e9:.4f} GPa"

    @property
    def line(self):
        return self.kind == "line"

    @property
    def compliance(self):
        """Factor C in W = C int P/r dX dY: 1/(2 pi) for a line, 2/pi^2 for a circular contact."""
        return 2 * self.p_H * self.R / (math.pi * self.E * self.a)

    @property
    def load(self):
        """Load int P dX (line) or int P dX dY in Hertz units."""
        return math.pi / 2 if self.line else 2 * math.pi / 3 * self.b / self.a

    def cell(self, grid):
        """Size of a cell of the :class:`tehl_taichi.scene.sections.Grid` in m, (along x, along y)."""
        return (grid.x_max - grid.x_min) * self.a / grid.nx, grid.y_max * self.b / grid.ny

    @classmethod
    def of(cls, scene):
        """Scales of a scene."""
        contact, E = scene.contact, reduced_modulus(scene)
        R, R_y, u_m = contact.radius_x, contact.radius_y, scene.operation.u_m
        if contact.kind == "line":
            a, p_H = hertz.line(scene.load, R, E)
            return cls("line", R, E, a, a, p_H, u_m, 0.0)
        a, b, p_H = hertz.ellipse(scene.load, R, R_y, E)
        return cls("point", R, E, a, b, p_H, u_m, R / R_y)


def peclet(material, speed, scales):
    """Peclet number u a/alpha of a body's surface, alpha = k/(rho c): its motion while heat diffuses over one half-width."""
    return abs(speed) * scales.a * material.rho * material.c / material.k


def reduced_modulus(scene):
    """Reduced modulus E' with 2/E' = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b [Eq 1]."""
    return 2 / sum((1 - b.nu**2) / b.E for b in (scene.body_a, scene.body_b))


def load_of(scene):
    """Load in N/m (line) or N (point), however the contact was described."""
    contact = scene.contact
    R, E = contact.radius_x, reduced_modulus(scene)
    if contact.load > 0:
        return contact.load
    if contact.hertz_pressure > 0:
        if contact.kind == "line":
            return hertz.line_load(contact.hertz_pressure, R, E)
        return hertz.ellipse_load(contact.hertz_pressure, R, contact.radius_y, E)
    U = moes_speed(scene) * 2 * scene.oil.eta0 / (E * R)
    return contact.moes_M * (E * R * math.sqrt(U) if contact.kind == "line" else E * R**2 * U**0.75)


def moes_speed(scene):
    """Speed u_m (m/s) at which the oil's alpha and eta0 give moes_L = alpha E' U^(1/4), U = 2 eta0 u_m/(E' R')."""
    R, E = scene.contact.radius_x, reduced_modulus(scene)
    return (scene.contact.moes_L / (scene.oil.alpha * E)) ** 4 * E * R / (2 * scene.oil.eta0)
