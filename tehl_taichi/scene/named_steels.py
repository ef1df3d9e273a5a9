"""Named steels for the bodies of a scene."""

from tehl_taichi.scene import steels
from tehl_taichi.values.registry import collect

STEELS = collect(steels, steels.Steel)


def with_steel_numbers(values):
    """Table of a body, completed with the numbers of the steel that it names."""
    name = values.get("material") if isinstance(values, dict) else None
    return {**STEELS[name].numbers, **values} if isinstance(name, str) and name in STEELS else values


def doubts(scene):
    """Sentences about bodies whose numbers differ from the steel that they name."""
    for which, body in (("a", scene.body_a), ("b", scene.body_b)):
        numbers = STEELS[body.material].numbers if body.material else {}
        if other := [key for key, value in numbers.items() if getattr(body, key) != value]:
            yield (f"bodies.{which}.material = {body.material} has other numbers than that steel ({', '.join(other)}); omit "
                   "the name or the numbers")
