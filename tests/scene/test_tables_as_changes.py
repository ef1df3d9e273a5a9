"""Tables, sections and whole features as changes of a scene: the same as their keys one by one."""

import dataclasses

import pytest

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.scene import idle_keys, scene_file
from tehl_taichi.scene.grid_for_features import is_grid_open
from tehl_taichi.scene.sections import SECTIONS

TABLES = [{"operation": {"temperature": 40.0}}, {"contact": {"kind": "point", "load": 20.0}}, {"grid": {"nx": 96}},
          {"bodies": {"a": {"E": 2e11}}}, {"bodies.b": {"k": 30.0}}, {"oil": {"eta0": 0.02}}, {"fatigue": {"kappa": 0.5}},
          {"oil": {"name": "mineral-vg220"}}]


@pytest.mark.parametrize("table", TABLES, ids=str)
def test_a_table_changes_its_keys_alone(table):
    mtm = tehl.scene("mtm")
    if table == {"oil": {"eta0": 0.02}}:
        mtm = tehl.scene("ball-on-disc")
    (section, values), = table.items()
    if section == "bodies":
        section, values = "bodies.a", values["a"]
    one_by_one = mtm.replace(**{f"{section}.{key}": value for key, value in values.items()})
    assert mtm.replace(**table) == one_by_one
    as_file = scene_file.from_data({"base": mtm.name, **({"bodies": {section[-1]: values}} if "." in section else table)}, "f")
    assert as_file.replace(name=mtm.name, note=mtm.note).to_dict() == one_by_one.to_dict()
    assert scene_file.from_data({"base": mtm.name}, mtm.name, table).to_dict() == one_by_one.replace(note=mtm.note).to_dict()


def test_a_key_that_a_table_gives_otherwise_is_a_contradiction():
    with pytest.raises(SceneError, match="contradict each other"):
        tehl.scene("gear").replace(**{"operation": {"srr": 0.1}, "operation.srr": 0.2})


@pytest.mark.parametrize("feature", [{"seed": 4}, {"shape": "ridge", "length": 1e-4},
                                     tehl.Feature(shape="ridge", length=1e-4)], ids=str)
def test_keys_of_a_whole_feature_without_effect_are_refused(feature):
    with pytest.raises(SceneError, match="has no effect"):
        tehl.scene("gear").replace(feature=[feature])


def test_keys_of_a_table_without_effect_are_warned_of():
    gear = tehl.scene("gear")
    found = gear.replace(rheology={"law": "newtonian", "tau_0": 3e6}, thermal={"on": False, "nodes": 17})
    said = "; ".join(found.warnings())
    assert "rheology.tau_0 has no effect" in said and "thermal.nodes has no effect" in said
    assert not is_grid_open(gear.replace(grid={"nx": 64, "ny": 16}))


def test_features_of_another_scene_bring_no_keys_of_their_own():
    """A table with all keys counts with its unusual values only."""
    gear, dent = tehl.scene("gear"), tehl.scene("dent")
    for features in (dent.to_dict()["feature"], list(dent.features)):
        found = gear.replace(feature=features)
        assert found.features == dent.features and not [*idle_keys.doubts(found)]
        assert "feature.0.seed" not in found.user_keys and "feature.0.height" in found.user_keys


@pytest.mark.parametrize("name", ["smooth-line", "dent", "ball-on-disc", "roller-bearing", "twin-disc"])
def test_a_part_may_be_an_object(name):
    """As with dataclasses.replace, and without a word about its usual values."""
    gear, other = tehl.scene("gear"), tehl.scene(name)
    for key in (*SECTIONS, "oil", "bodies.a"):
        part = key.replace("bodies.a", "body_a")
        if key != "contact" or other.contact.kind == "line":
            assert gear.replace(**{key: getattr(other, part)}) == dataclasses.replace(gear, **{part: getattr(other, part)})
        assert gear.replace(**{key: getattr(gear, part)}).warnings() == gear.warnings()


@pytest.mark.parametrize("key, part", [
    ("fatigue", tehl.Fatigue(torsion_limit=4e8)), ("oil", tehl.Oil(nu_40=2e-4, nu_100=1.8e-5)),
    ("oil", tehl.Oil(name="mineral-vg220")), ("bodies.b", tehl.Body(material="100Cr6")),
    ("operation", tehl.Operation(u_m=5.0, srr=0.1))])
def test_numbers_of_an_object_that_follow_from_others_contradict_nothing(key, part):
    found = tehl.scene("gear").replace(**{key: part})
    assert getattr(found, key.replace("bodies.b", "body_b")) == part and not found.replaced
