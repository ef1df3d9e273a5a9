"""Laws are entries: each holds what it promises. (That a new one is one file: tests/test_new_entries.py.)"""

import math
import subprocess
import sys
from pathlib import Path

import pytest
from values.test_registry import hold

from tehl_taichi.laws.choices import ALONE, CHOICES
from tehl_taichi.laws.law import Law, ShearLaw, declared
from tehl_taichi.laws.law import beyond as left_behind
from tehl_taichi.laws.sheared_flow import beyond, flow
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.sections import Rheology
from tehl_taichi.values.quantity import Choice, Number, Pairs, kinds, quantity

ROOT = Path(__file__).parents[2]
SECTIONS = {"rheology": Rheology, "oil": Oil}
LAWS = [(key, law) for key, registry in {**CHOICES, "": ALONE}.items() for law in registry.values()]


@pytest.mark.parametrize("key, law", LAWS, ids=lambda value: value if isinstance(value, str) else value.name)
def test_laws_hold_what_they_promise(key, law):
    hold(law)
    assert isinstance(law, Law) and law.most_p > 0
    for name, one in law.numbers.items():
        kind = one.metadata["kind"]
        assert isinstance(kind, (Number, Pairs)) and kind.about, name
        kind.check(name, one.default)


def of(key):
    return pytest.mark.parametrize("law", CHOICES[key].values(), ids=lambda law: law.name)


@of("rheology.law")
def test_shear_laws_are_odd_and_newtonian_where_the_stress_is_small(law):
    rheology = law.having()
    for s in (1.0, 1e5, 1e7, 1e9, 1e12):
        tau = law.stress(rheology, s, 1e9)
        assert law.stress(rheology, -s, 1e9) == pytest.approx(-tau) and 0 < tau <= s * (1 + 1e-9)
    assert law.stress(rheology, 1e3, 1e9) == pytest.approx(1e3, rel=1e-6)
    assert (law.stress(rheology, 1e9, 1e9) < 0.99e9) == law.thins


@of("rheology.law")
def test_pressure_drives_more_through_oil_that_thins_the_more_it_strains_the_walls(law):
    rheology = law.having(law=law.name)

    def driven(wall):
        return float(wall * sum(part(rheology, wall, 0.0, 1e9)[0] for part in (flow, beyond)))

    flows = [driven(wall) / wall for wall in (1e3, 5e7, 7e7, 9e7, 1.3e8)]
    assert flows[0] == pytest.approx(1.0, rel=1e-8)
    assert all((flows[0] < one) == law.thins for one in flows[1:])
    assert driven(5e7) < driven(7e7) < driven(9e7) < driven(1.3e8)


@of("oil.viscosity")
def test_viscosity_laws_know_what_the_temperature_does(law):
    """The numbers that they name are those without which it does nothing; all rise with pressure."""
    def fall(**numbers):
        oil = law.having(**{"table": ((0.0, -4.0), (1e9, 6.0)), **numbers})
        assert law.ln_eta(oil, 2e8, 40.0) > law.ln_eta(oil, 1e8, 40.0)
        return law.ln_eta(oil, 1e8, 40.0) - law.ln_eta(oil, 1e8, 60.0)

    if law.thinned_by:
        assert fall(**dict.fromkeys(law.thinned_by, 0.03)) > 0
    assert (fall(**dict.fromkeys(law.thinned_by or (), 0.0)) == 0) == (law.thinned_by is not None)
    assert set(law.usual) | set(law.thinned_by or ()) <= set(law.numbers)


@of("oil.density")
def test_density_laws_agree_with_themselves(law):
    """1 at p = 0 and 40 deg C; expansivity is the slope of the logarithm."""
    oil = law.having()
    assert law.compression(oil, 0.0) == 1 and law.compression(oil, 1e9) > 1.05
    for p in (0.0, 1e9):
        low, high = (law.expansion(oil, p, Gamma) for Gamma in (89.9, 90.1))
        assert law.expansion(oil, p, 40.0) == 1
        assert law.expansivity(oil, p, 90.0) == pytest.approx(math.log(low / high) / 0.2, rel=1e-6)


@pytest.mark.parametrize("key", CHOICES)
def test_scenes_read_the_registries(key):
    section, choice = key.split(".")
    offered = kinds(SECTIONS[section])
    assert isinstance(offered[choice], Choice) and offered[choice].words == tuple(CHOICES[key])
    for law in CHOICES[key].values():
        for name, one in law.numbers.items():
            assert law.name in offered[name].sentence and one.metadata["kind"].about in offered[name].sentence
            assert getattr(SECTIONS[section](), name) == one.default


def test_a_number_of_two_laws_is_declared_once():
    common, again = quantity(1.0, "Pa", "a stress"), quantity(1.0, "Pa", "a stress")
    one, two, three = (ShearLaw(name=name, says="", source="", checked=(), numbers={"tau": number}, stress=max)
                       for name, number in (("one", common), ("two", common), ("three", again)))
    assert declared({"one": one, "two": two})["tau"].metadata["kind"].sentence == "Pa: one, two: a stress"
    with pytest.raises(ValueError, match="tau is declared twice, also by the law 'three'"):
        declared({"one": one, "two": two, "three": three})


def test_limits_that_a_film_leaves_behind():
    laws = {name: Law(name=name, says="", source="", checked=(), numbers={}, most_p=p, most_Gamma=Gamma)
            for name, p, Gamma in (("a", 1e9, 100.0), ("b", 2e9, 50.0))}
    assert left_behind(laws, 1e9, 50.0) == {}
    assert left_behind(laws, 3e9, 60.0) == {"a and b measured up to Pa": 1e9, "b measured up to degC": 50.0}


def test_laws_need_no_taichi_for_numbers():
    code = ("import sys, tehl_taichi as tehl; from tehl_taichi.scene.film_formula import central_film; "
            "assert 3e-7 < central_film(tehl.scene('gear')) < 6e-7; sys.exit('taichi' in sys.modules)")
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT).returncode == 0


def test_the_command_lists_all_laws(capsys):
    from tehl_cli.show_commands import laws

    laws()
    printed = capsys.readouterr().out
    for key, law in LAWS:
        assert f" {law.name} " in printed and key in printed
