"""The two surfaces of a contact: their body, speed and features.

Both share one clock: the centre X of the first feature moves with its surface (the reference). Points of the other surface move
by pace * X; pace is the ratio of its speed to that of the reference.
"""

from dataclasses import dataclass

from tehl_taichi.scene.sections import Body

NAMES = ("a", "b")
STANDS = 1e-3  # of the mean speed: a slower surface does not pass


@dataclass(frozen=True)
class MovingSurface:
    """One surface: name ("a" or "b"), body, speed (m/s), pace (speed relative to the reference), its features, and `stands`: it
    is at rest, so its features are in the contact from the start.
    """

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
    """Name of the surface with the first feature, else a; of a steady contact the moving one if that is at rest."""
    first = scene.features[0].surface if scene.features else NAMES[0]
    if scene.transient or getattr(scene.operation, f"u_{first}"):
        return first
    return next(name for name in NAMES if name != first)


def _pace(speeds, name, reference):
    """Pace of a surface; exactly 1 for the reference, also if that is at rest."""
    return 1.0 if name == reference else speeds[name] / speeds[reference] if speeds[reference] else float("inf")
