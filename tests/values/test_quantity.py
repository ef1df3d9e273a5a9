"""Every value of a scene is declared once, and what is declared is what is checked and printed."""

import math
import re

import pytest

from tehl_taichi.scene import SceneError, scene, scene_file
from tehl_taichi.scene.description import SECTIONS
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.sections import Body, Contact
from tehl_taichi.values.checks import nearest
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
    assert "# m: size along x" in lines["width"] and "[1e-06 to 0.03]" in lines["width"]
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


@pytest.mark.parametrize("section, key, value, said", [
    ("fatigue", "endurance", 400, "400e6 Pa (400 MPa)"), ("bodies", "E", 206, "206e9 Pa (206 GPa)"),
    ("contact", "radius_x", 7.5, "7.5e-3 m (7.5 mm)"), ("feature", "height", 1.5, "1.5e-6 m (1.5 um)"),
    ("feature", "width", 200, "200e-6 m (200 um)"), ("feature", "pixel", 2.53, "2.53e-6 m (2.53 um)"),
    ("oil", "nu_40", 220, "220e-6 m2/s (220 mm2/s)"), ("fatigue", "depths", [50], "50e-6 m (50 um)"),
    ("bodies", "rho", 0.785, "0.785e3 kg/m3 (0.785 kg/l)"), ("bodies", "alpha", 12, "12e-6 1/K (12 um/mK)"),
])
def test_what_is_out_of_range_by_its_unit_is_asked_about(section, key, value, said):
    """The unit that comes nearest to a usual value, of those that people write: 206 of a modulus is GPa, 400 of a limit MPa."""
    with pytest.raises(SceneError) as error:
        made_with(section, key, value)
    assert str(error.value).endswith(f"; did you mean {said}?")


@pytest.mark.parametrize("section, key, value", [
    ("bodies", "nu", 30), ("fatigue", "endurance", -400), ("bodies", "E", 10**400), ("fatigue", "endurance", math.nan),
    ("contact", "radius_x", 1e30), ("feature", "width", 0.0), ("oil", "c0", 1e12)])
def test_what_no_unit_explains_is_not_guessed_at(section, key, value):
    with pytest.raises(SceneError) as error:
        made_with(section, key, value)
    assert "did you mean" not in str(error.value)


@pytest.mark.parametrize("name, changes, said", [
    ("gear", {"load": 350.0}, "did you mean 350e3 N/m (350 N/mm)?"),
    ("gear", {"hertz_pressure": 1.3}, "did you mean 1.3e9 Pa (1.3 GPa)?"),
    ("gear", {"hertz_pressure": 1300.0}, "did you mean 1300e6 Pa (1300 MPa)?"),
    ("gear", {"load": 50.0, "height": 10e-6}, ""), ("ball-on-disc", {"load": 1e-8}, ""), ("gear", {"load": 1e-8}, "")])
def test_a_load_that_makes_no_contact_is_asked_about(name, changes, said):
    with pytest.raises(SceneError) as error:
        scene(name).replace(**changes)
    assert str(error.value).endswith(said) and ("did you mean" in str(error.value)) == bool(said)


def test_a_part_of_a_name_finds_it():
    """Whoever asks for friction gets the column that has it in its name."""
    assert nearest("friction", ["transient_friction_coefficient_mean", "x"]).endswith("'transient_friction_coefficient_mean'?)")
    assert nearest("HV", ["depth_um", "hardness_HV"]) == " (did you mean 'hardness_HV'?)"
    assert nearest("qqq", ["x", "steady"]) == nearest("st", ["xxxxxxxxxxxxxxxst"]) == ""


@pytest.mark.parametrize("change, said", [
    ({"oil.frictn": 1}, "unknown key oil.frictn"),
    ({"feature.0.hight": 1}, "unknown key feature.hight (did you mean 'height'?)"),
    ({"frction": 1}, "unknown key frction (did you mean 'operation'?)")])
def test_long_lists_of_names_are_not_printed(change, said):
    """45 keys of an oil hide the proposal; the file of `tehl new` has all."""
    with pytest.raises(SceneError) as error:
        scene("gear").replace(**change)
    head, _, tail = str(error.value).partition("; ")
    short = ", and `tehl run --help` for short ones" if "." not in said else ""
    assert head == said and re.fullmatch(rf"all \d\d names: `tehl new FILE`{short}", tail)


def test_short_lists_of_names_are_printed():
    with pytest.raises(SceneError, match="^unknown key grid.frction; known: nx, ny, x_min, x_max, y_max, inlet$"):
        scene("gear").replace(**{"grid.frction": 1})


@pytest.mark.parametrize("section, key", KEYS)
def test_the_documented_type_is_that_of_the_default(section, key):
    kind, usual = kinds(PARTS[section])[key], getattr(PARTS[section], key, None)
    if usual not in (None, "auto"):
        assert kind.word == type(usual).__name__ or kind.word.startswith("sequence") and isinstance(usual, tuple)
    assert f"\n    {key} : {kind.word}" in (PARTS[section].__doc__ or "")
