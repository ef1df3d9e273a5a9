"""A new law, shape, criterion, oil and output field are one file each: those of CONTRIBUTING.md, in a copy of the package and
in a folder of the user."""

import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[1]
OWN = {"shear", "shapes", "oils"}


def shown(title):
    """The file below `### title` in CONTRIBUTING.md: its path and its text."""
    text = (ROOT / "CONTRIBUTING.md").read_text().split(f"### {title}\n")[1]
    return text.split("`")[1], text.split("```python\n")[1].split("```")[0]


def extended(copy, files, script):
    """Run `script` in the folder `copy` with a copy of the package and `files` (path, text) more; those of OWN lie in a folder
    of the user."""
    for source, target in (("tehl_taichi", "tehl_taichi"), ("profiles", "tehl_taichi/profiles")):
        shutil.copytree(ROOT / source, copy / target)
    for path, text in files:
        assert not (copy / path).exists()
        folder, name = Path(path).parent.name, Path(path).name
        place = copy / "my_entries" / folder / name if folder in OWN else copy / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    subprocess.run([sys.executable, "-c", script], cwd=copy, check=True, env={**os.environ, "TEHL_PLUGINS": "my_entries"})


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

LAWS = '''
import json, sys
import tehl_taichi as tehl
from tehl_taichi.scene import scene_file
from tehl_taichi.store.store import Store
from tehl_taichi.runs.summary.summary import summarise
from tehl_taichi.laws.choices import CHOICES
from tehl_taichi.laws.density import rho_ratio
from tehl_taichi.laws.rheology import shear_stress
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.profiles import stability_scenes

base = tehl.scene("smooth-line").replace(**{"grid.nx": 64, "thermal.on": False})
film = {"oil.name": "mine", "oil.viscosity": "cameron", "oil.eta0": 0.02, "oil.alpha": 1e-8, "oil.density": "cold-tait",
        "oil.cameron_n": 4.0, "temperature": 60.0}
scenes = {"limiting": base, "rounded": base.replace(**{"rheology.law": "rounded"}),
          "sharp": base.replace(**{"rheology.law": "rounded", "rheology.limit_n": 4.0}), "film": base.replace(**film)}
computed = {name: scenes[name] for name in ("limiting", "rounded", "film")}
out = {"checked": {law.name: [one.compute() / one.expected for one in law.checked] for laws in CHOICES.values()
                   for law in laws.values()},
       "template": scene_file.dumps(scenes["sharp"]), "suite": list(stability_scenes.cases()),
       "back": scene_file.from_data(__import__("tomllib").loads(scene_file.dumps(scenes["film"])), "x") == scenes["film"]}
# kernels trace these very records: a number that acts here acts there
out["stress"] = {name: float(shear_stress(scenes[name].rheology, 85e6, 1e9)) for name in ("rounded", "sharp")}
out["ln_eta"], out["rho"] = (float(law(scenes["film"].oil, 1e9, 60.0)) for law in (ln_eta, rho_ratio))
for name, scene in computed.items():
    shot = next(tehl.march(scene))
    store = Store.create(f"{name}.zarr", scene, shot, 1, {"warnings": "[]"})
    out[name] = summarise(store, {"wall_s": 0.0, "compile_s": 0.0, "steady_error": {}})
try:
    base.replace(**{"rheology.law": "rounded", "rheology.limit_n": 20.0})
except tehl.Error as error:
    out["refused"] = str(error)
json.dump(out, open("laws.json", "w"))
'''

RUN = '''
import json, tomllib
import numpy as np
import tehl_taichi as tehl
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.fatigue import findley
from tehl_taichi.scene import scene_file
from tehl_taichi.march.step_output import Field, entries
from tehl_taichi.profiles import stability_scenes
from tehl_taichi.scene.feature import SHAPES, Feature
from tehl_taichi.scene.named_oils import NAMED

made = {"shape": SHAPES["plateau"], "criterion": CRITERIA["ellipse"], "oil": NAMED["glycerol"],
        "field": entries(Field)["traction_coefficient"]}
data = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "oil.name": "glycerol", "thermal.on": False, "time.steps": 3,
                                     "hertz_pressure": 1e9, "load": 0.0, "temperature": 40.0, "kappa": 0.25,
                                     "fatigue.criterion": "ellipse", "fatigue.depths": [], "numerics.estimate_error": False})
data = {**data.to_dict(), "feature": [{"shape": "plateau", "height": 1e-6, "flat": 0.25}]}
scene = tehl.Scene.from_dict(data)
run = tehl.run(scene, "new.zarr", threads=2)  # first a gear, as in first_kernels.py: by its kernels
bending = np.zeros((1, 36, 6))
bending[0, :, 0] = 100 * np.cos(np.arange(36) * np.pi / 18)
out = {"checked": {kind: [one.compute() / one.expected for one in entry.checked] for kind, entry in made.items()},
       "template": scene_file.dumps(scene), "suite": list(stability_scenes.cases()),
       "drawn": sum(s.features[0].shape == "plateau" for s in stability_scenes.random_cases(30).values()
                    if hasattr(s, "features")),
       "back": scene_file.from_data(tomllib.loads(scene_file.dumps(scene)), "x") == scene,
       "search": findley.search(bending, 0.25, criterion="ellipse")[0][0], "summary": run.summary}
lost = run.store.fields(0)["film"] - run.store.fields(1)["film"]
out["lost"] = [float(lost[i, 0]) for i in np.argmin(np.abs(run.store.x[:, None] - run.store.feature_x(1)), axis=0)]
np.savez("fields.npz", **run.store.fields(2))
for key, wrong in (("feature.flat", 0.99), ("oil.name", "glycerl"), ("fatigue.criterion", "elipse")):
    try:
        scene.replace(**{key: wrong})
    except tehl.Error as error:
        out[key] = str(error)
json.dump(out, open("out.json", "w"))
'''


@pytest.fixture(scope="module")
def new(tmp_path_factory):
    """The folder with a copy of the package and seven files more in which :data:`LAWS` and :data:`RUN` ran, in one process."""
    copy = tmp_path_factory.mktemp("package")
    names = "A shear law", "A viscosity law", "A feature shape", "A fatigue criterion", "An oil", "An output field"
    extended(copy, [*map(shown, names), ("tehl_taichi/laws/densities/cold_tait.py", TAIT)], RUN + LAWS)
    return copy


@pytest.fixture(scope="module")
def laws(new):
    return json.loads((new / "laws.json").read_text())


@pytest.fixture(scope="module")
def out(new):
    return json.loads((new / "out.json").read_text())


def test_a_file_is_a_shear_law(laws):
    """Choice, template, range, suite, checked number, kernel and summary: with exponent 2 it is the limiting law."""
    out = laws
    assert "limit_n = 4.0               # -: rounded: exponent (2: limiting) [0.5 to 10]" in out["template"]
    assert "law = \"rounded\"" in out["template"] and "limiting, newtonian, rounded]" in out["template"]
    assert "rheology.limit_n = 20" in out["refused"] and "at most 10" in out["refused"]
    assert "shear law rounded" in out["suite"] and out["checked"]["rounded"] == pytest.approx([1.0])
    assert out["stress"] == pytest.approx({"rounded": 85e6 / 2**0.5, "sharp": 85e6 / 2**0.25})
    same, limiting = (out[name]["steady"] for name in ("rounded", "limiting"))
    for key in ("h_c_m", "p_max_Pa", "friction_coefficient"):
        assert same[key] == pytest.approx(limiting[key], rel=1e-6)


def test_a_file_is_a_law_of_viscosity_or_density(laws):
    """The film formula takes the new viscosity, too, and the film of the kernels is near it."""
    out = laws
    assert out["checked"]["cameron"] == pytest.approx([1.0]) and out["checked"]["cold-tait"] == pytest.approx([1.0])
    assert out["back"] and "cameron" in out["template"] and "cold-tait: bulk modulus" in out["template"]
    assert out["ln_eta"] == pytest.approx(math.log(0.02) + 4 * math.log(1 + 10 / 4))
    assert out["rho"] == pytest.approx(1 / (1 - math.log(1 + 11 / 1.4) / 11))
    film = out["film"]["steady"]
    assert film["h_c_m"] == pytest.approx(film["film_formula_m"], rel=0.25)
    assert abs(film["h_c_m"] / out["limiting"]["steady"]["h_c_m"] - 1) > 0.05
    assert any("depends neither on the inlet temperature" in line for line in out["film"]["warnings"])


@pytest.mark.parametrize("kind", ["shape", "criterion", "oil", "field"])
def test_its_numbers_come_out(out, kind):
    assert out["checked"][kind] == pytest.approx(np.ones(len(out["checked"][kind])), rel=0.1 if kind == "oil" else 1e-8)


def test_a_file_is_a_shape(out):
    """Choice, key of its own, range, suites, and the film that it takes away."""
    assert "flat = 0.25" in out["template"] and "plateau: share of its width that is flat [0 to 0.95]" in out["template"]
    assert "ridge, plateau" in out["template"] or "plateau, ridge" in out["template"] and out["back"]
    assert "shape plateau" in out["suite"] and out["drawn"] > 3
    assert "feature.flat = 0.99" in out["feature.flat"] and "at most 0.95" in out["feature.flat"]
    assert out["lost"][0] == pytest.approx(1e-6, rel=0.3)


def test_a_file_is_a_criterion(out):
    """Choice, meaning of kappa, kernel, and the fatigue of a passage."""
    assert "ellipse: the square of tension" in out["template"] and "did you mean 'ellipse'" in out["fatigue.criterion"]
    assert out["search"] == pytest.approx(100 / 3**0.5, rel=1e-7)
    worst = out["summary"]["fatigue"]
    pull = max(worst["sigma_n_max_Pa"], 0.0)
    assert worst["criterion"] == "ellipse"
    assert worst["findley_stress_max_Pa"] == pytest.approx(np.hypot(worst["tau_amp_Pa"], 0.5 * pull), rel=1e-6)


def test_a_file_is_an_oil(out):
    """Its numbers in the scene, its name in refusals, its film."""
    assert 'name = "glycerol"' in out["template"] and "did you mean 'glycerol'" in out["oil.name"]
    steady = out["summary"]["steady"]
    assert steady["h_c_m"] == pytest.approx(steady["film_formula_m"], rel=0.25)


def test_an_entry_is_a_field(new):
    """Stored with unit and long name; the quotient of two other fields."""
    about = json.loads((new / "new.zarr" / "traction_coefficient" / "zarr.json").read_text())["attributes"]
    assert (about["units"], about["long_name"]) == ("1", "shear along x on body a over the pressure")
    fields = np.load(new / "fields.npz")
    p, found = fields["pressure"], fields["traction_coefficient"]
    np.testing.assert_allclose(found[p > 0], np.abs(fields["traction_x_a"][p > 0]) / p[p > 0], rtol=1e-6)
    assert (found[p == 0] == 0).all() and found.max() > 0.001
