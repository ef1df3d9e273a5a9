"""Named oils, and how a scene uses their names."""

import dataclasses

from tehl_taichi.errors import SceneError
from tehl_taichi.laws import viscosity
from tehl_taichi.scene import data_sheet, oils
from tehl_taichi.scene.oil import NO_SOURCE, Oil
from tehl_taichi.values import checks
from tehl_taichi.values.checks import build, nearest
from tehl_taichi.values.coerce import plain
from tehl_taichi.values.registry import collect

NAMED = collect(oils, oils.NamedOil)
OILS = {name: entry.oil for name, entry in NAMED.items()}


def from_values(values):
    """Oil from a table.

    The name of a known oil supplies all values that the table lacks. A new name needs the numbers of its viscosity law (see
    :func:`check_new`) or a data sheet; the others are those of the reference oil.
    """
    if not isinstance(values, dict):
        return build(Oil, values, "oil")
    name = values.get("name", data_sheet.NAME if data_sheet.has_sheet(values) else Oil.name)
    known = dataclasses.asdict(OILS[name]) if isinstance(name, str) and name in OILS else {}
    if data_sheet.has_sheet({**known, **values}):
        return _from_sheet(name, known, values)
    if known:
        return build(Oil, {**known, **values}, "oil")
    check_new(name, values)
    return build(Oil, {"source": NO_SOURCE, **values}, "oil")


def _from_sheet(name, known, values):
    """Oil from a data sheet. None marks a number that follows from it; a given number must agree with it."""
    checks.text("oil.name", name, 100, empty=False)
    changed = {"source": ""} if data_sheet.has_sheet(values) else {}  # of a known oil: it is another one
    merged = {**known, **changed, "name": name, **values}
    free = data_sheet.derived_keys(merged)
    oil = build(Oil, {key: value for key, value in merged.items() if key not in free}, "oil")
    data_sheet.check_agreement({key: plain(values[key]) for key in free if values.get(key) is not None}, vars(oil))
    return oil


def check_new(name, given):
    """Refuse an unknown name without its viscosity law and the numbers of that law."""
    checks.text("oil.name", name, 100, empty=False)
    law = given.get("viscosity")
    needed = viscosity.LAWS[law].needed if isinstance(law, str) and law in viscosity.LAWS else ()
    missing = [key for key in ("viscosity", *needed) if key not in given]
    if missing:
        raise SceneError(f"oil.name = {name!r} is not known{nearest(name, OILS)}; known: {', '.join(OILS)}; a new oil needs "
                         f"its viscosity law and numbers: oil.{', oil.'.join(missing)} missing, or its data sheet: oil.nu_40, "
                         "oil.nu_100")
