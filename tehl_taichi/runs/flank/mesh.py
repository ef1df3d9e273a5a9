"""Line of action of a gear pair: contact positions of its teeth, with radii, speeds and load (SI; no taichi).

All coordinates x run along the line of action from the pitch point C, positive towards the tip of the driving pinion: contact
runs from A (root of the pinion, tip of the gear, x < 0) over B, C, D to E. Helical pairs are treated in their transverse
section, with radii in the normal section (ISO/TS 15144-1).
"""

import functools
import math
from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.gear_pair import GearPair, inv

MESHES = 2.0  # transverse contact ratio from which on a spur pair never carries on one pair of teeth


@dataclass(frozen=True)
class Mesh:
    """Geometry of a meshing pair. Raises SceneError if its teeth do not mesh."""

    pair: GearPair

    def __post_init__(self):
        self._check_tips()
        self._check_path()

    @functools.cached_property
    def alpha_w(self):
        """Working pressure angle, rad."""
        return math.acos(self.pair.a_0 * math.cos(self.pair.alpha_t) / self.pair.a_w)

    @property
    def beta_b(self):
        """Helix angle at the base circles, rad."""
        return math.asin(math.sin(math.radians(self.pair.beta)) * math.cos(math.radians(self.pair.alpha_n)))

    def r_b(self, wheel):
        """Base radius of the pinion (1) or gear (2), m."""
        return 0.5 * self.pair.m_t * self._z(wheel) * math.cos(self.pair.alpha_t)

    def _z(self, wheel):
        return (self.pair.z1, self.pair.z2)[wheel - 1]

    def d_a(self, wheel):
        """Tip diameter, m: given, or m_n (z/cos beta + 2 + 2 x - 2 Delta), Delta = x1 + x2 - (a_w - a_0)/m_n."""
        p = self.pair
        Delta = p.x1 + p.x2 - (p.a_w - p.a_0) / p.m_n
        x = (p.x1, p.x2)[wheel - 1]
        return (p.d_a1, p.d_a2)[wheel - 1] or p.m_t * self._z(wheel) + p.m_n * (2 + 2 * x - 2 * Delta)

    def rho_C(self, wheel):
        """Radius of curvature at the pitch point in the transverse section, m."""
        return self.r_b(wheel) * math.tan(self.alpha_w)

    @property
    def p_bt(self):
        """Base pitch, m."""
        return math.pi * self.pair.m_t * math.cos(self.pair.alpha_t)

    def _to_tip(self, wheel):
        """Distance (m) from the pitch point to the contact position of the tip of this wheel."""
        return math.sqrt((self.d_a(wheel) / 2) ** 2 - self.r_b(wheel) ** 2) - self.rho_C(wheel)

    @functools.cached_property
    def points(self):
        """{letter: x in m} of A to E, sorted; C only if the teeth touch there."""
        A, E = -self._to_tip(2), self._to_tip(1)
        found = {"A": A, "B": E - self.p_bt, "C": 0.0, "D": A + self.p_bt, "E": E}
        return {name: x for name, x in sorted(found.items(), key=lambda item: item[1]) if A <= x <= E}

    @property
    def ends(self):
        """x of A and E, m."""
        return self.points["A"], self.points["E"]

    @property
    def eps_alpha(self):
        """Transverse contact ratio."""
        return (self.ends[1] - self.ends[0]) / self.p_bt

    @property
    def omega(self):
        """Angular speeds of pinion and gear, 1/s."""
        omega = 2 * math.pi * self.pair.n1 / 60
        return omega, omega * self.pair.z1 / self.pair.z2

    @property
    def F_bt(self):
        """Tooth force in the transverse section, N."""
        return self.pair.torque / self.r_b(1)

    @property
    def full_load(self):
        """Load per length (N/m) of one pair of teeth that carries all; helical: mean over the contact lines b eps_alpha/cos
        beta_b of the normal force F_bt/cos beta_b.
        """
        return self.F_bt / self.pair.b / (self.eps_alpha if self.pair.beta else 1.0)

    def radii(self, x):
        """Radii of curvature (m) of pinion and gear at x, in the normal section."""
        return tuple(rho / math.cos(self.beta_b) for rho in (self.rho_C(1) + x, self.rho_C(2) - x))

    def speeds(self, x):
        """(u_1, u_2, slip u_1 - u_2) in m/s along the profiles; exactly equal at C."""
        omega_1, omega_2 = self.omega
        u_C = omega_1 * self.rho_C(1)
        return u_C + omega_1 * x, u_C - omega_2 * x, (omega_1 + omega_2) * x

    def arc(self, x, wheel):
        """Distance (m) along the flank of this wheel from its pitch point, negative in the dedendum: (rho^2 - rho_C^2)/(2
        r_b).
        """
        towards_tip = x if wheel == 1 else -x
        return towards_tip * (2 * self.rho_C(wheel) + towards_tip) / (2 * self.r_b(wheel))

    def _check_tips(self):
        for wheel, name in ((1, "pinion"), (2, "gear")):
            d_a, r_b = self.d_a(wheel), self.r_b(wheel)
            if d_a <= 2 * r_b:
                raise SceneError(f"gear.d_a{wheel} = {d_a:.6g} m: the tips of the {name} lie inside its base circle; allowed: "
                                 f"more than {2 * r_b:.6g} m")
            if (thickness := self.tip_thickness(wheel)) <= 0:
                raise SceneError(f"gear.d_a{wheel} = {d_a:.6g} m: the teeth of the {name} are pointed, {thickness:.3g} m thick "
                                 f"at the tip; allowed: less than {self._pointed(wheel):.6g} m")

    def tip_thickness(self, wheel, d=None):
        """Transverse thickness of a tooth at its tip or at the diameter d, m (ISO 21771)."""
        p, x, d = self.pair, (self.pair.x1, self.pair.x2)[wheel - 1], d or self.d_a(wheel)
        half = (math.pi / 2 + 2 * x * math.tan(math.radians(p.alpha_n))) / self._z(wheel)
        return d * (half + inv(p.alpha_t) - inv(math.acos(2 * self.r_b(wheel) / d)))

    def _pointed(self, wheel):
        """Diameter at which the flanks of a tooth meet, m."""
        low, high = 2 * self.r_b(wheel), self.d_a(wheel)
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.tip_thickness(wheel, middle) > 0 else (low, middle)
        return low

    def _check_path(self):
        for wheel, other, name in ((2, 1, "gear"), (1, 2, "pinion")):
            room, way = self.rho_C(other), self._to_tip(wheel)
            if way >= room:
                most = 2 * math.hypot(self.r_b(wheel), self.rho_C(1) + self.rho_C(2))
                raise SceneError(f"gear.d_a{wheel} = {self.d_a(wheel):.6g} m: the tips of the {name} reach {way - room:.3g} m "
                                 f"beyond the involute of the other wheel (interference, undercut); allowed: less than "
                                 f"{most:.6g} m, or other profile shifts")
        if self.eps_alpha < 1:
            raise SceneError(f"the tip diameters {self.d_a(1):.6g} m and {self.d_a(2):.6g} m give a contact ratio eps_alpha of "
                             f"{self.eps_alpha:.3g}: the teeth lose contact; allowed: at least 1")
        if self.eps_alpha >= MESHES and not (self.pair.beta or self.pair.load_share):
            raise SceneError(f"eps_alpha = {self.eps_alpha:.3g}: at least two pairs of teeth carry everywhere, which the "
                             f"built-in load sharing does not cover; allowed: less than {MESHES:g}, or give gear.load_share")
