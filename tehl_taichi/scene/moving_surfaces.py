"""The two surfaces of a contact: which body each is of, how fast it moves and what it carries.

One clock for both: the centre of the first feature, X, moves with the surface that carries it (the reference), and a place of
another surface has moved by pace * X when X has: its speed over that of the reference.
"""

from dataclasses import dataclass

from tehl_taichi.scene.sections import Body

NAMES = ("a", "b")
STANDS = 1e-3  # of the mean speed: a slower surface does not pass


@dataclass(frozen=True)
class MovingSurface:
    """name ("a" or "b"), body, speed (m/s), pace (speed over that of the reference), the features that it carries, and whether
    it stands: these are in the contact from the start on."""

    name: str
    body: Body
    speed: float
    pace: float
    features: tuple
    stands: bool = False


def surfaces(scene):
    """Both surfaces of a scene, a first."""
    o = scene.operation
    speeds, reference = {"a": o.u_a, "b": o.u_b}, reference_name(scene)
    return tuple(MovingSurface(name, getattr(scene, f"body_{name}"), speeds[name], _pace(speeds, name, reference),
                               tuple(f for f in scene.features if f.surface == name), _stands(speeds[name], o))
                 for name in NAMES)


def _stands(speed, operation):
    return speed < STANDS * operation.u_m


def reference_name(scene):
    """The surface that carries the first feature; a where there is none."""
    return scene.features[0].surface if scene.features else "a"


def _pace(speeds, name, reference):
    """1 exactly of the reference, also where that is at rest."""
    return 1.0 if name == reference else speeds[name] / speeds[reference] if speeds[reference] else float("inf")
