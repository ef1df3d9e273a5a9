"""The oils that have names, and what a name means in a scene."""

import dataclasses

from tehl_taichi.errors import SceneError
from tehl_taichi.physics import viscosity
from tehl_taichi.registry import collect
from tehl_taichi.scene import oils
from tehl_taichi.scene.oil import Oil
from tehl_taichi.values import checks
from tehl_taichi.values.checks import build, nearest

NAMED = collect(oils, oils.NamedOil)
OILS = {name: entry.oil for name, entry in NAMED.items()}
NO_SOURCE = "not given"


def from_values(values):
    """Oil from a table. The name of a known oil gives the values that are not named; a new name must bring the numbers of its
    viscosity law (see :func:`check_new`), the others are those of the reference oil."""
    if not isinstance(values, dict):
        return build(Oil, values, "oil")
    name = values.get("name", Oil.name)
    if isinstance(name, str) and name in OILS:
        return build(Oil, {**dataclasses.asdict(OILS[name]), **values}, "oil")
    check_new(name, values)
    return build(Oil, {"source": NO_SOURCE, **values}, "oil")


def check_new(name, given):
    """Refuse a name that no known oil has unless its viscosity law and the numbers of that law are given with it."""
    checks.text("oil.name", name, 100, empty=False)
    law = given.get("viscosity")
    needed = viscosity.LAWS[law].needed if isinstance(law, str) and law in viscosity.LAWS else ()
    missing = [key for key in ("viscosity", *needed) if key not in given]
    if missing:
        raise SceneError(f"oil.name = {name!r} is not known{nearest(name, OILS)}; known: {', '.join(OILS)}; a new oil brings "
                         f"its viscosity law and its numbers: oil.{', oil.'.join(missing)} missing")
