"""Laws are entries: each holds what it promises, and a new one is one file."""

import json
import math
import shutil
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


def shown(title):
    """The file below `### title` in CONTRIBUTING.md: its path and its text."""
    text = (ROOT / "CONTRIBUTING.md").read_text().split(f"### {title}\n")[1]
    return text.split("`")[1], text.split("```python\n")[1].split("```")[0]


def extended(copy, files, script):
    """What `script` leaves in out.json, run in the folder `copy` with a copy of the package and `files` (path, text) more."""
    for source, target in (("tehl_taichi", "tehl_taichi"), ("profiles", "tehl_taichi/profiles")):
        shutil.copytree(ROOT / source, copy / target)
    for path, text in files:
        assert not (copy / path).exists()
        (copy / path).write_text(text)
    subprocess.run([sys.executable, "-c", script], cwd=copy, check=True)
    return json.loads((copy / "out.json").read_text())


TAIT = '''"""Density of Tait's form, at one temperature."""

import math

from tehl_taichi.engine.pointwise import log, pointwise
from tehl_taichi.laws.densities import RHO0
from tehl_taichi.laws.law import DensityLaw
from tehl_taichi.values.registry import Checked
from tehl_taichi.values.quantity import quantity


@pointwise
def compression(oil, p):
    """1/(1 - ln(1 + (1 + K1) p/K)/(1 + K1))."""
    return 1 / (1 - log(1 + (1 + oil.cold_K1) * p / oil.cold_K) / (1 + oil.cold_K1))


@pointwise
def expansion(oil, p, Gamma):
    return 1.0 + 0.0 * p


@pointwise
def expansivity(oil, p, Gamma):
    return 0.0 * p


LAW = DensityLaw(
    name="cold-tait", says="1/(1 - ln(1 + (1 + K1) p/K)/(1 + K1))", source="after Tait 1888",
    compression=compression, expansion=expansion, expansivity=expansivity,
    numbers={"rho0": RHO0, "cold_K": quantity(1.4e9, "Pa", "bulk modulus at p = 0", 1e8, 1e11),
             "cold_K1": quantity(10.0, "", "its rise with pressure", 1, 30)},
    checked=(Checked("by hand", 1 / (1 - math.log(2) / 11), lambda: compression(LAW.having(cold_K=11e9), 1e9)),))
'''

RUN = '''
import json, sys
import tehl_taichi as tehl
from tehl_taichi.engine import runtime
from tehl_taichi.scene import scene_file
from tehl_taichi.store.store import Store
from tehl_taichi.runs.summary.summary import summarise
from tehl_taichi.laws.choices import CHOICES
from tehl_taichi.laws.density import rho_ratio
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.profiles import stability

base = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
film = {"oil.name": "mine", "oil.viscosity": "cameron", "oil.eta0": 0.02, "oil.alpha": 1e-8, "oil.density": "cold-tait",
        "oil.cameron_n": 4.0, "temperature": 60.0}
scenes = {"limiting": base, "rounded": base.replace(**{"rheology.law": "rounded"}),
          "sharp": base.replace(**{"rheology.law": "rounded", "rheology.limit_n": 4.0}), "film": base.replace(**film)}
runtime.start(threads=2)
out = {"checked": {law.name: [one.compute() / one.expected for one in law.checked] for laws in CHOICES.values()
                   for law in laws.values()},
       "template": scene_file.dumps(scenes["sharp"]), "suite": list(stability.cases()),
       "back": scene_file.from_data(__import__("tomllib").loads(scene_file.dumps(scenes["film"])), "x") == scenes["film"]}
out["ln_eta"], out["rho"] = (float(law(scenes["film"].oil, 1e9, 60.0)) for law in (ln_eta, rho_ratio))
for name, scene in scenes.items():
    shot = next(tehl.march(scene))
    store = Store.create(f"{name}.zarr", scene, shot, 1, {"warnings": "[]"})
    out[name] = summarise(store, {"wall_s": 0.0, "compile_s": 0.0, "steady_error": {}})
try:
    base.replace(**{"rheology.law": "rounded", "rheology.limit_n": 20.0})
except tehl.Error as error:
    out["refused"] = str(error)
json.dump(out, open("out.json", "w"))
'''


@pytest.fixture(scope="module")
def with_new_laws(tmp_path_factory):
    """What :data:`RUN` says in a copy of the package with three files more."""
    files = (*map(shown, ("A shear law", "A viscosity law")), ("tehl_taichi/laws/densities/cold_tait.py", TAIT))
    return extended(tmp_path_factory.mktemp("package"), files, RUN)


def test_a_file_is_a_shear_law(with_new_laws):
    """Choice, template, range, suite, checked number, kernel and summary: with exponent 2 it is the limiting law."""
    out = with_new_laws
    assert "limit_n = 4.0               # -: rounded: exponent (2: limiting) [0.5 to 10]" in out["template"]
    assert "law = \"rounded\"" in out["template"] and "limiting, newtonian, rounded]" in out["template"]
    assert "rheology.limit_n = 20" in out["refused"] and "at most 10" in out["refused"]
    assert "shear law rounded" in out["suite"] and out["checked"]["rounded"] == pytest.approx([1.0])
    same, limiting, sharp = (out[name]["steady"] for name in ("rounded", "limiting", "sharp"))
    for key in ("h_c_m", "p_max_Pa", "friction_coefficient"):
        assert same[key] == pytest.approx(limiting[key], rel=1e-6)
    assert sharp["friction_coefficient"] > 1.001 * limiting["friction_coefficient"]


def test_a_file_is_a_law_of_viscosity_or_density(with_new_laws):
    """The film formula takes the new viscosity, too, and the film of the kernels is near it."""
    out = with_new_laws
    assert out["checked"]["cameron"] == pytest.approx([1.0]) and out["checked"]["cold-tait"] == pytest.approx([1.0])
    assert out["back"] and "cameron" in out["template"] and "cold-tait: bulk modulus" in out["template"]
    assert out["ln_eta"] == pytest.approx(math.log(0.02) + 4 * math.log(1 + 10 / 4))
    assert out["rho"] == pytest.approx(1 / (1 - math.log(1 + 11 / 1.4) / 11))
    film = out["film"]["steady"]
    assert film["h_c_m"] == pytest.approx(film["film_formula_m"], rel=0.25)
    assert abs(film["h_c_m"] / out["limiting"]["steady"]["h_c_m"] - 1) > 0.05
    assert any("depends neither on the inlet temperature" in line for line in out["film"]["warnings"])
