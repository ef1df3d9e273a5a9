"""Every value of a scene is declared once, and what is declared is what is checked and printed."""

import math

import pytest

from tehl_taichi.io import scene_file
from tehl_taichi.scene import SceneError, scene
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.parts import Body, Contact
from tehl_taichi.scene.whole import SECTIONS
from tehl_taichi.values.quantity import Choice, Count, Number, Numbers, Switch, check, kinds, quantity

PARTS = {**SECTIONS, "bodies": Body, "oil": Oil, "feature": Feature}
KEYS = [(section, key) for section, kind in PARTS.items() for key in kinds(kind)]
BASE = {Contact: {"load": 1e6}}  # what a part needs before it can be made at all


def made_with(section, key, value):
    return PARTS[section](**{**BASE.get(PARTS[section], {}), key: value})


def beyond(kind):
    """Values that `kind` does not allow."""
    if isinstance(kind, Numbers):
        return [3.0, ("x",), (kind.high * 2,)]
    if isinstance(kind, Number):
        outside = [kind.low - abs(kind.low) - 1] * (kind.low > -math.inf) + [2 * abs(kind.high) + 1] * (kind.high < math.inf)
        return ["much", None, math.nan, True, *outside]
    if isinstance(kind, Count):
        return [kind.low - 1, kind.high + kind.multiple, kind.low + 0.5, *([kind.low + 1] * (kind.multiple > 1))]
    return ["nonsense"] * isinstance(kind, Choice) + [{}, 7, 1 if isinstance(kind, Switch) else None]


@pytest.mark.parametrize("section, key", KEYS, ids=map(".".join, KEYS))
def test_what_lies_beyond_the_declared_range_is_refused_by_name(section, key):
    for value in beyond(kinds(PARTS[section])[key]):
        with pytest.raises(SceneError, match=f"{section}.{key}"):
            made_with(section, key, value)


def test_the_template_tells_unit_meaning_and_range_of_every_key():
    text = scene_file.dumps(scene("gear"))
    lines = {line.split(" = ")[0]: line for line in text.splitlines() if " = " in line}
    for section, key in KEYS:
        kind = kinds(PARTS[section])[key]
        found = [line for line in text.splitlines() if line.startswith(f"{key} = ") and kind.sentence in line]
        assert kind.about and found, (section, key, lines.get(key))
    assert "# m: along x" in lines["width"] and "[1e-06 to 0.1]" in lines["width"]
    assert "[5 to 33]" in lines["nodes"] and "[true, false or auto]" in lines["thermal_stress"]


def test_a_changed_declaration_changes_check_and_sentence_together():
    from dataclasses import dataclass

    @dataclass(frozen=True)
    class Part:
        size: float = quantity(1.0, "m", "how big", 0.5, 2.0)

        def __post_init__(self):
            check(self, "part")

    assert kinds(Part)["size"].sentence == "m: how big [0.5 to 2]" and Part(2.0).size == 2.0
    with pytest.raises(SceneError, match="part.size = 2.1 m is out of range; allowed: at least 0.5 m and at most 2 m"):
        Part(2.1)


def test_the_load_is_refused_in_the_unit_of_its_contact():
    with pytest.raises(SceneError, match="at least 0 N/m and"):
        Contact(load=-1.0)
    with pytest.raises(SceneError, match="at least 0 N and"):
        Contact(kind="point", radius_y=10.6e-3, load=-1.0)
