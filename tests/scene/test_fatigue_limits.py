"""Fatigue constants by the limits of a handbook: what they become, what they replace, what is refused beside them."""

import math
import tomllib

import pytest

from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.report.scene_text import material
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.scene import Scene, SceneError, scene, scene_file
from tehl_taichi.scene.sections import Fatigue

GEAR = scene("gear")
ONE = GEAR.replace(torsion_limit=400e6)
BOTH = GEAR.replace(bending_limit=600e6, torsion_limit=390e6)


def in_file(text):
    return scene_file.from_data(tomllib.loads(f'base = "gear"\n[fatigue]\n{text}'), "gear")


def constants(of):
    return of.fatigue.kappa, of.fatigue.endurance / 1e6


def test_a_torsion_limit_and_kappa_give_the_endurance_of_findley():
    """By hand: t sqrt(1 + kappa^2)."""
    assert constants(ONE) == pytest.approx((0.3, 400 * math.sqrt(1.09)))
    assert constants(ONE.replace(kappa=0.75)) == pytest.approx((0.75, 500.0))
    assert constants(in_file("torsion_limit = 400e6\nkappa = 0.75")) == pytest.approx((0.75, 500.0))


@pytest.mark.parametrize("name", [name for name, criterion in CRITERIA.items() if criterion.constants])
def test_the_endurance_of_both_limits_is_that_of_each_with_their_kappa(name):
    both = BOTH.replace(**{"fatigue.criterion": name})
    for key, limit in (("torsion_limit", 390e6), ("bending_limit", 600e6)):
        alone = GEAR.replace(**{key: limit, "kappa": both.fatigue.kappa, "fatigue.criterion": name})
        assert constants(alone) == pytest.approx(constants(both), rel=1e-8)


@pytest.mark.parametrize("made", [ONE, BOTH, ONE.replace(kappa=0.2), GEAR.replace(bending_limit=5e8)])
def test_files_and_stores_keep_the_limits(made):
    assert Scene.from_dict(made.to_dict()) == made
    assert scene_file.from_data(tomllib.loads(scene_file.dumps(made)), "gear") == made


def test_what_is_given_anew_replaces_what_it_can_not_stand_beside():
    ended = ONE.replace(endurance=450e6)
    assert constants(ended) == (0.3, 450.0) and ended.fatigue.torsion_limit == 0 and "torsion" not in ended.fatigue.source
    assert constants(BOTH.replace(torsion_limit=420e6))[0] == pytest.approx(0.4364, abs=1e-4)
    alone = BOTH.replace(kappa=0.4, torsion_limit=390e6)
    assert alone == GEAR.replace(kappa=0.4, torsion_limit=390e6) and alone.fatigue.bending_limit == 0


def test_what_was_given_is_the_source_unless_one_is_named():
    assert ONE.fatigue.source == "from the fatigue limit 400 MPa in reversed torsion with kappa = 0.3"
    assert BOTH.fatigue.source == "from the fatigue limits 600 MPa in reversed bending and 390 MPa in torsion"
    assert material(BOTH.fatigue) == BOTH.fatigue.source and material(ONE.fatigue).startswith(ONE.fatigue.source)
    assert "with kappa = 0.4" in ONE.replace(kappa=0.4).fatigue.source
    own = in_file('torsion_limit = 400e6\nsource = "ISO 6336-5"').fatigue
    assert own.source == "ISO 6336-5"
    assert material(own) == "from the fatigue limit 400 MPa in reversed torsion with kappa = 0.3 (ISO 6336-5)"


@pytest.mark.parametrize("changes, example", [
    ({"bending_limit": 5e8}, True), ({"bending_limit": 5e8, "kappa": 0.2}, False), ({"endurance": 5e8}, True),
    ({"endurance": 5e8, "kappa": 0.2}, False), ({"kappa": 0.2}, False)])
def test_the_example_kappa_does_not_pass_for_that_of_a_material(changes, example):
    assert ("this kappa is an example value" in material(GEAR.replace(**changes).fatigue)) == example
    named = GEAR.replace(**changes, **{"fatigue.source": "ISO 6336-5"}).fatigue
    assert "example" not in material(named)


@pytest.mark.parametrize("make, said", [
    (lambda: GEAR.replace(torsion_limit=4e8, endurance=5e8), "endurance = 500000000.0 and torsion_limit = .* contradict"),
    (lambda: in_file("torsion_limit = 390e6\nendurance = 400e6"), "endurance = 4e.08 contradicts .*torsion_limit = 3.9e.08 Pa, "
     "which gives endurance = 4.07172e.08; omit endurance"),
    (lambda: Fatigue(torsion_limit=4e8, endurance=5e8), "endurance = 5e.08 contradicts"),
    (lambda: BOTH.replace(kappa=0.4), "kappa = 0.4 contradicts .*which give kappa = 0.314"),
    (lambda: in_file("torsion_limit = 400"), r"torsion_limit = 400 Pa .*did you mean 400e6 Pa \(400 MPa\)"),
    (lambda: in_file("torsion_limit = 700e6\nbending_limit = 600e6"), "ratio torsion/bending"),
    (lambda: in_file('torsion_limit = "x"'), "not a number"), (lambda: in_file("torsion_limit = -4e8"), "out of range"),
    (lambda: in_file("torsion_limits = 4e8"), "did you mean 'torsion_limit'")])
def test_bad_combinations_are_one_sentence(make, said):
    with pytest.raises(SceneError, match=said) as error:
        make()
    assert len(str(error.value).splitlines()) == 1


def test_a_sweep_over_limits_and_over_kappa():
    cases = plan(ONE, {"torsion_limit": [350e6, 400e6], "kappa": [0.2, 0.75]})
    assert not cases.refused()
    assert [constants(cases.case(n))[1] for n in (1, 3)] == pytest.approx([437.5, 500.0])
