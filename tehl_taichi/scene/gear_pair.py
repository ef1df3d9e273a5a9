"""Pair of external involute gears as on a drawing: teeth, profile shifts, centre distance, tips, torque and speed."""

import math

from tehl_taichi.errors import SceneError
from tehl_taichi.values.checks import missing_file, nearest
from tehl_taichi.values.quantity import check, count, documented, pairs, quantity

LOOSE, TIGHT = 0.1, 0.001  # m_n by which a given centre distance may exceed that of the shifts (backlash), or fall short of it

LARGEST = 15.0  # m, of a wheel: 91.5 was meant in mm


@documented
class GearPair:
    """A pair of external involute gears; the pinion (1) drives the gear (2).

    Of x1, x2 and a_w, missing values follow from the others. load_share is for spur gears; without it: 1/3 to 2/3 from A to B,
    1 to D, 2/3 to 1/3 at E.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.GearPair(torque=300.0)
    GearPair(x1=0.0, x2=0.0, a_w=0.09, torque=300.0)
    """

    z1: int = count(16, "teeth of the pinion", 5, 1000)
    z2: int = count(24, "teeth of the gear", 5, 1000)
    m_n: float = quantity(4.5e-3, "m", "normal module", 1e-4, 0.1)
    alpha_n: float = quantity(20.0, "deg", "normal pressure angle", 10.0, 35.0)
    beta: float = quantity(0.0, "deg", "helix angle, 0: spur", 0.0, 45.0)
    x1: float = quantity(math.inf, "", "profile shift of the pinion over m_n; inf: not given", -3.0, infinite=True)
    x2: float = quantity(math.inf, "", "profile shift of the gear; inf: not given", -3.0, infinite=True)
    a_w: float = quantity(0.0, "m", "centre distance; 0: from x1 and x2", 0.0, LARGEST, usual=0.1)
    b: float = quantity(14e-3, "m", "common face width", 1e-4, 5.0)
    d_a1: float = quantity(0.0, "m", "tip diameter of the pinion; 0: m_n (z/cos beta + 2 + 2 x - 2 Delta)", 0.0, LARGEST,
                            usual=0.1)
    d_a2: float = quantity(0.0, "m", "tip diameter of the gear; 0: as for the pinion", 0.0, LARGEST, usual=0.1)
    torque: float = quantity(265.1, "N m", "torque of the pinion", 0.0, 1e8, strict=True)
    n1: float = quantity(2170.0, "1/min", "speed of the pinion", 0.0, 1e6, strict=True)
    load_share: tuple = pairs((), "[distance past C along the line of action from pinion root to tip in m, share of the tooth "
                                  "normal force]; a repeated distance is a jump", 2, 1000, jumps=True)

    Ra1: float = quantity(0.0, "m", "mean roughness Ra of the pinion's flanks; 0: not given", 0.0, 1e-4, usual=4e-7)
    Ra2: float = quantity(0.0, "m", "mean roughness Ra of the gear's flanks; 0: not given", 0.0, 1e-4, usual=4e-7)
    lambda_GFP: float = quantity(0.0, "", "permissible specific film of the oil, from a micropitting test; 0: not given", 0.0,
                                 100.0)
    bulk_temperature: float = quantity(math.inf, "deg C", "temperature of the teeth and of the oil at the inlet; inf: that of "
                                                          "the scene", -50.0, infinite=True)

    def __post_init__(self):
        check(self, "gear")
        self._check_roughness()
        self._settle_shifts()
        self._check_share()

    def _settle_shifts(self):
        given = [math.isfinite(x) for x in (self.x1, self.x2)]
        if not any(given) and not self.a_w:
            self._set(x1=0.0, x2=0.0)
        elif all(given):
            self._settle_distance()
        elif self.a_w and any(given):
            self._set(**{"x2" if given[0] else "x1": self._sum_of_shifts() - (self.x1 if given[0] else self.x2)})
        else:
            known = f"gear.a_w = {self.a_w:g} m" if self.a_w else f"gear.x{1 if given[0] else 2}"
            raise SceneError(f"{known} alone does not determine the profile shifts; allowed: x1 and x2, or a_w with one of "
                             "them")
        if not self.a_w:
            self._set(a_w=self.distance_of_shifts)

    def _settle_distance(self):
        """Check a centre distance given with both shifts: the teeth must not jam, and their play must not exceed the
        backlash.
        """
        tight = self.distance_of_shifts
        if self.a_w and not -TIGHT * self.m_n <= self.a_w - tight <= LOOSE * self.m_n:
            raise SceneError(f"gear.a_w = {self.a_w:g} m and x1 + x2 = {self.x1 + self.x2:g} contradict each other: without "
                             f"backlash they give {tight:.6g} m; allowed: up to {tight + LOOSE * self.m_n:.6g} m, or omit one "
                             "of x1, x2 and a_w")

    def _check_roughness(self):
        if (self.Ra1 > 0) != (self.Ra2 > 0):
            raise SceneError(f"gear.Ra1 = {self.Ra1:g} m and gear.Ra2 = {self.Ra2:g} m: the specific film needs both; "
                             "give both, or none")
        if self.lambda_GFP and not self.Ra1:
            raise SceneError(f"gear.lambda_GFP = {self.lambda_GFP:g} has no effect without gear.Ra1 and gear.Ra2")

    def _check_share(self):
        if self.load_share and self.beta:
            raise SceneError(f"gear.load_share applies to spur gears, not to gear.beta = {self.beta:g} deg (mean load of its "
                             "contact lines)")
        for _, share in self.load_share:
            if not 0 < share <= 1:
                raise SceneError(f"gear.load_share: a share of {share:g} is out of range; allowed: more than 0 and at most 1")

    def _set(self, **values):
        for key, value in values.items():
            object.__setattr__(self, key, value)

    @property
    def Ra(self):
        """Mean of the roughness of both flanks, m; 0: not given."""
        return 0.5 * (self.Ra1 + self.Ra2)

    @property
    def bulk(self):
        """Bulk temperature, deg C; None if it is not given."""
        return self.bulk_temperature if math.isfinite(self.bulk_temperature) else None

    @property
    def alpha_t(self):
        """Transverse pressure angle, rad."""
        return math.atan(math.tan(math.radians(self.alpha_n)) / math.cos(math.radians(self.beta)))

    @property
    def m_t(self):
        """Transverse module, m."""
        return self.m_n / math.cos(math.radians(self.beta))

    @property
    def a_0(self):
        """Centre distance without shifts, m."""
        return 0.5 * self.m_t * (self.z1 + self.z2)

    @property
    def distance_of_shifts(self):
        """Centre distance without backlash (m): inv alpha_w = inv alpha_t + 2 tan alpha_n (x1 + x2)/(z1 + z2) (ISO 21771)."""
        rise = 2 * math.tan(math.radians(self.alpha_n)) * (self.x1 + self.x2) / (self.z1 + self.z2)
        if inv(self.alpha_t) + rise <= 0:
            raise SceneError(f"gear.x1 + x2 = {self.x1 + self.x2:g} leaves no centre distance; allowed: more than "
                             f"{self.x1 + self.x2 - (inv(self.alpha_t) + rise) * (self.x1 + self.x2) / rise:.3g}")
        return self.a_0 * math.cos(self.alpha_t) / math.cos(angle_of(inv(self.alpha_t) + rise))

    def _sum_of_shifts(self):
        """Sum x1 + x2 that the centre distance needs."""
        cosine = self.a_0 * math.cos(self.alpha_t) / self.a_w
        if cosine >= 1:
            raise SceneError(f"gear.a_w = {self.a_w:g} m leaves no line of action; allowed: more than "
                             f"{self.a_w * cosine:.6g} m, the sum of the base radii")
        rise = inv(math.acos(cosine)) - inv(self.alpha_t)
        return rise * (self.z1 + self.z2) / (2 * math.tan(math.radians(self.alpha_n)))


def inv(alpha):
    """Involute function tan(alpha) - alpha, rad."""
    return math.tan(alpha) - alpha


def angle_of(involute):
    """Angle (rad) whose involute function is `involute` > 0, by Newton from alpha = (3 inv)^(1/3)."""
    alpha = min((3 * involute) ** (1 / 3), 1.4)
    for _ in range(50):
        alpha -= (inv(alpha) - involute) / math.tan(alpha) ** 2
    return alpha


# FZG test gears: ISO 14635-1 (A) and FVA information sheet 54/7 (C, micropitting); load stage 10, 8.3 m/s at the pitch circle
PAIRS = {
    "fzg-c": (GearPair(x1=0.1817, x2=0.1715, a_w=91.5e-3), "FZG test gear type C (spur, 16/24 teeth, 14 mm), load stage 10"),
    "fzg-a": (GearPair(x1=0.8532, x2=-0.5, a_w=91.5e-3, b=20e-3, d_a1=88.77e-3, d_a2=112.5e-3, torque=372.6),
              "FZG test gear type A (spur, 16/24 teeth, 20 mm, long pinion tip: scuffing), load stage 10"),
}


def gear_pair(name):
    """Built-in pair with this name. Raises SceneError with the nearest name."""
    if name not in PAIRS:
        missing_file(name)
        raise SceneError(f"unknown gear pair {name!r}{nearest(name, PAIRS)}; built in: {', '.join(PAIRS)}; or name a TOML or "
                         "CSV file")
    return PAIRS[name][0]
