"""A rolling bearing as in a catalogue or on a drawing: elements, pitch circle, grooves, load and speed."""

import math

from tehl_taichi.errors import SceneError
from tehl_taichi.values.quantity import check, choice, count, documented, quantity

BALL, ROLLER = "ball", "roller"
LARGEST = 5.0  # m, of a pitch circle: 46 was meant in mm
NEEDED = ("diameter", "count", "pitch_diameter")  # of every bearing
OF_BALLS, OF_ROLLERS = ("osculation_inner", "osculation_outer"), ("length", "crown", "taper")


@documented
class RollingBearing:
    """A single-row ball or roller bearing under a radial and an axial load; the inner ring turns at `speed`.

    The default osculations are those behind the ratings of ISO 76 and ISO 281.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.RollingBearing(diameter=9.525e-3, count=9, pitch_diameter=46e-3)
    RollingBearing(diameter=0.009525, count=9, pitch_diameter=0.046)
    """

    element: str = choice(BALL, "rolling elements", (BALL, ROLLER))
    diameter: float = quantity(None, "m", "diameter of a ball, or of a roller at half its length; needed", 0.0, 0.5,
                               strict=True, usual=1e-2)
    count: int = count(None, "number of rolling elements; needed", 3, 1000)
    pitch_diameter: float = quantity(None, "m", "diameter of the circle of the centres of the elements; needed", 0.0, LARGEST,
                                     strict=True, usual=5e-2)
    contact_angle: float = quantity(0.0, "deg", "contact angle without load; tapered rollers: of the outer ring", 0.0, 75.0)
    clearance: float = quantity(0.0, "m", "radial clearance in operation (of the whole diameter)", 0.0, 1e-3, usual=1e-5)
    osculation_inner: float = quantity(0.52, "", "groove radius over ball diameter, inner ring", 0.501, 0.7)
    osculation_outer: float = quantity(0.53, "", "groove radius over ball diameter, outer ring", 0.501, 0.7)
    length: float = quantity(None, "m", "effective length of a roller; needed of rollers", 0.0, 1.0, strict=True, usual=1e-2)
    crown: float = quantity(math.inf, "m", "radius of the profile of a roller; inf: straight", 0.01, 100.0, infinite=True,
                            usual=3.0)
    taper: float = quantity(0.0, "deg", "whole angle of a tapered roller; 0: cylindrical", 0.0, 20.0)
    load: float = quantity(1000.0, "N", "radial load", 0.0, 1e8)
    axial: float = quantity(0.0, "N", "axial load; 0 with a contact angle: that of a purely radial displacement", 0.0, 1e8)
    speed: float = quantity(1500.0, "1/min", "speed of the inner ring", 0.0, 1e6)
    outer_speed: float = quantity(0.0, "1/min", "speed of the outer ring, negative: against the inner ring", -1e6, 1e6)

    def __post_init__(self):
        check(self, "bearing")
        self._check_needed()
        self._check_element()
        self._check_room()
        self._check_duty()

    def _check_needed(self):
        needed = (*NEEDED, "length") if self.rollers else NEEDED
        for key in needed:
            if getattr(self, key) is None:
                raise SceneError(f"bearing.{key} is not given; a {self.element} bearing needs {', '.join(needed)}")

    def _check_element(self):
        """Refuse keys of the other kind of bearing."""
        for key in OF_BALLS if self.rollers else OF_ROLLERS:
            if getattr(self, key) != getattr(type(self), key):
                raise SceneError(f"bearing.{key} = {getattr(self, key):g} has no effect on a {self.element}; omit this key")
        if self.taper >= 2 * self.contact_angle and self.taper > 0:
            raise SceneError(f"bearing.taper = {self.taper:g} deg and contact_angle = {self.contact_angle:g} deg contradict "
                             "each other; allowed: a taper of less than twice the contact angle of the outer ring")
        if self.contact_angle > 0 and self.clearance > 0:
            raise SceneError(f"bearing.clearance = {self.clearance:g} m and contact_angle = {self.contact_angle:g} deg: the "
                             "contact angle already includes the clearance; allowed: one of them")

    def _check_room(self):
        """Refuse more elements than fit on the pitch circle."""
        if self.pitch_diameter * math.sin(math.pi / self.count) < self.diameter:
            largest = self.pitch_diameter * math.sin(math.pi / 3)
            allowed = f"3 to {self.most}" if self.most >= 3 else f"a diameter of at most {largest:.4g} m"
            raise SceneError(f"bearing.count = {self.count}: {self.element}s of {self.diameter:g} m on a circle of "
                             f"{self.pitch_diameter:g} m; allowed: {allowed}")

    @property
    def most(self):
        """Largest number of elements that fit on the pitch circle."""
        share = self.diameter / self.pitch_diameter
        return int(math.pi / math.asin(share) + 1e-9) if share < 1 else 0

    def _check_duty(self):
        if self.load == self.axial == 0:
            raise SceneError("bearing.load = 0 N and axial = 0 N: without a load nothing touches; allowed: one of them more "
                             "than 0 N")
        if self.axial > 0 and self.rollers and not self.contact_angle:
            raise SceneError(f"bearing.axial = {self.axial:g} N: cylindrical rollers carry no axial load; allowed: 0 N, or a "
                             "contact angle")
        if self.speed == self.outer_speed:
            raise SceneError(f"bearing.speed = {self.speed:g} 1/min of both rings: the elements do not roll, and there is no "
                             "film; allowed: different speeds")

    @property
    def rollers(self):
        return self.element == ROLLER

    @property
    def alpha(self):
        """Contact angle of the outer ring, rad."""
        return math.radians(self.contact_angle)

    @property
    def nu(self):
        """Half of the taper, rad."""
        return math.radians(self.taper) / 2

    @property
    def groove_distance(self):
        """Distance A of the centres of curvature of both grooves (m): (f_i + f_o - 1) D."""
        return (self.osculation_inner + self.osculation_outer - 1) * self.diameter
