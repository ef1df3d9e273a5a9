"""What is asked of a crack: where it starts, how far it may grow, what acts on its faces."""

from dataclasses import dataclass
from typing import Union

from tehl_taichi.crack.fillings import FILLINGS
from tehl_taichi.errors import SceneError
from tehl_taichi.values.checks import choice, integer, normalise, number

SIDES = ("entry", "exit")
FLATTEST = 15.0  # degrees to the surface: flatter cracks have not been compared with anything


@dataclass(frozen=True)
class Wanted:
    """side: entry, exit or both (of the feature: ahead of its centre is the exit). start: x' of the mouth, m (None: where the
    surface is pulled most on that side); angle: of the first piece, degrees from +x' into the body (90: straight down, more:
    leaning with rolling); first: its length, step: of the others, length: of the whole, m. distance: ahead of the tip, m, at
    which the largest tension around it is looked for. threshold: of K_I, Pa sqrt(m), below which it stops (None: it has
    none). residual: stress along x, Pa or rows (depth, Pa); None: fatigue.residual_xx of the scene. face_friction: of closed
    faces. oil: a name of :data:`tehl_taichi.crack.fillings.FILLINGS`, or the share of the film's pressure at the mouth that
    acts on both faces (an upper bound). elements: of a straight crack. Raises SceneError for values out of range.
    """

    side: str = "both"
    start: Union[float, None] = None
    angle: float = 90.0
    first: float = 5e-6
    step: float = 5e-6
    length: float = 100e-6
    distance: float = 3e-6
    threshold: Union[float, None] = None
    residual: object = None
    face_friction: float = 0.0
    oil: Union[float, str] = "dry"
    elements: int = 12

    def __post_init__(self):
        normalise(self)
        choice("side", self.side, (*SIDES, "both"))
        for key in ("first", "step", "length", "distance"):
            number(key, getattr(self, key), "m", 1e-8, 0.1)
        number("angle", self.angle, "degrees", FLATTEST, 180 - FLATTEST)
        number("face_friction", self.face_friction, "", 0.0, 1.0)
        if isinstance(self.oil, str):
            choice("oil", self.oil, (*FILLINGS, "a share of the film's pressure from 0 to 1"))
        else:
            number("oil", self.oil, "", 0.0, 1.0)
        integer("elements", self.elements, 6, 200)
        for key, unit, low, high in (("start", "m", -0.1, 0.1), ("threshold", "Pa sqrt(m)", 0.0, 1e9)):
            if getattr(self, key) is not None:
                number(key, getattr(self, key), unit, low, high)
        for key in ("first", "step"):
            if getattr(self, key) > self.length * (1 + 1e-9):
                raise SceneError(f"{key} = {getattr(self, key):g} m is longer than length = {self.length:g} m")

    @property
    def filling(self):
        """Name of what is inside."""
        if isinstance(self.oil, str):
            return self.oil
        return "film" if self.oil else "dry"

    @property
    def oil_share(self):
        """Of the film's pressure at the mouth, where all of the crack has it."""
        return 1.0 if isinstance(self.oil, str) else self.oil

    @property
    def sides(self):
        """The sides wanted; of a given start that on which it is."""
        if self.side == "both" and self.start is not None:
            return SIDES[self.start >= 0 :][:1]
        return SIDES if self.side == "both" else (self.side,)
