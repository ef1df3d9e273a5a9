"""Options of a crack: its start, its largest length, the loads on its faces."""

from dataclasses import dataclass, fields
from typing import Union

from tehl_taichi.crack.fillings import FILLINGS
from tehl_taichi.crack.residual_stress import ResidualStress
from tehl_taichi.errors import SceneError
from tehl_taichi.scene.moving_surfaces import NAMES
from tehl_taichi.values.checks import known_names, nearest
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.quantity import Choice, Number, check, choice, count, quantity

SIDES = ("entry", "exit")
WORSE = "worse"  # body: that with the largest fatigue index
FLATTEST = 15.0  # degrees to the surface: flatter cracks have not been compared with anything
LONGEST, PIECE = 0.03, 1e-3  # m, a crack and a piece of it: a contact is a millimetre wide, 0.05 was meant in mm


@dataclass(frozen=True)
class CrackOptions:
    """Options of a crack analysis. Raises SceneError for values out of range.

    surface: a, b or worse (the surface that decides the fatigue verdict). side: entry, exit or both; exit is ahead of the
    feature's centre. start: x' of the mouth, m (None: the place of the largest tension on that side). angle: of the first
    piece, degrees from +x' into the body (90: straight down; more: leaning with rolling). first, step: lengths of the first and
    of every further piece, m. length: largest length, m. distance: distance ahead of the tip at which the direction of the
    largest tension is sought, m. threshold: K_I below which growth stops, Pa sqrt(m) (None: no threshold). residual: stress
    along x, Pa or rows (depth, Pa) (None: fatigue.residual_xx of the scene). face_friction: friction coefficient of closed
    faces. oil: a name of :data:`tehl_taichi.crack.fillings.FILLINGS`, or the share of the mouth's film pressure that acts on
    both faces (an upper bound). elements: number on a straight crack.
    """

    surface: str = choice(WORSE, "body that has the crack", (WORSE, *NAMES))
    side: str = choice("both", "of the feature", (*SIDES, "both"))
    start: Union[float, None] = quantity(None, "m", "x' of the mouth", -LONGEST, LONGEST, usual=5e-5)
    angle: float = quantity(90.0, "degrees", "of the first piece", FLATTEST, 180 - FLATTEST)
    first: float = quantity(5e-6, "m", "length of the first piece", 1e-8, PIECE)
    step: float = quantity(5e-6, "m", "length of the others", 1e-8, PIECE)
    length: float = quantity(100e-6, "m", "of the crack at which to stop", 1e-8, LONGEST)
    distance: float = quantity(3e-6, "m", "ahead of the tip", 1e-8, PIECE)
    threshold: Union[float, None] = quantity(None, "Pa sqrt(m)", "of K_I", 0.0, 1e9, usual=3e6, least=1e3)
    residual: object = None
    face_friction: float = quantity(0.0, "", "of closed faces", 0.0, 1.0)
    oil: Union[float, str] = "dry"
    elements: int = count(12, "on a straight crack", 6, 200)

    def __post_init__(self):
        check(self)
        Choice("", (*FILLINGS, "a share of the film's pressure from 0 to 1")).check("oil", self.oil) if isinstance(
            self.oil, str) else Number("", "", 0.0, 1.0).check("oil", self.oil)
        if self.start is not None and self.side not in ("both", on := SIDES[self.start >= 0]):
            raise SceneError(f"start = {self.start:g} m is on the {on} side, not on the side {self.side!r}: give one of them")
        if self.residual is not None:
            ResidualStress(self.residual)  # refused here, not after the stresses of a passage
        for key in ("first", "step"):
            if getattr(self, key) > self.length * (1 + 1e-9):
                raise SceneError(f"{key} = {getattr(self, key):g} m is longer than length = {self.length:g} m")

    @property
    def filling(self):
        """Name of the filling."""
        if isinstance(self.oil, str):
            return self.oil
        return "film" if self.oil else "dry"

    @property
    def oil_share(self):
        """Share of the mouth's film pressure that acts in the whole crack."""
        return 1.0 if isinstance(self.oil, str) else self.oil

    @property
    def sides(self):
        """Sides of the feature to analyse; with a given start the side on which it lies."""
        if self.side == "both" and self.start is not None:
            return SIDES[self.start >= 0 :][:1]
        return SIDES if self.side == "both" else (self.side,)


def options_of(given):
    """CrackOptions from {name: value}. Raises SceneError, also for an unknown name."""
    known = [field.name for field in fields(CrackOptions)]
    for name in given.keys() - set(known):
        raise SceneError(f"unknown option {shown(name)}{nearest(name, known)}; {known_names(known, 'tehl_taichi.crack')}")
    return CrackOptions(**given)
