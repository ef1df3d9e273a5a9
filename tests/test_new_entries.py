"""A new shape, criterion, oil and output field are one file each: those of CONTRIBUTING.md, in a copy of the package."""

import json

import numpy as np
import pytest
from laws.test_new_laws import extended, shown

RUN = '''
import json, tomllib
import numpy as np
import tehl_taichi as tehl
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.fatigue import findley
from tehl_taichi.scene import scene_file
from tehl_taichi.march.step_output import Field, entries
from tehl_taichi.profiles import stability
from tehl_taichi.scene.feature import SHAPES, Feature
from tehl_taichi.scene.named_oils import NAMED

made = {"shape": SHAPES["plateau"], "criterion": CRITERIA["ellipse"], "oil": NAMED["glycerol"],
        "field": entries(Field)["traction_coefficient"]}
data = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "oil.name": "glycerol", "thermal.on": False, "time.steps": 3,
                                     "hertz_pressure": 1e9, "load": 0.0, "temperature": 40.0, "kappa": 0.25,
                                     "fatigue.criterion": "ellipse", "fatigue.depths": [], "numerics.estimate_error": False})
data = {**data.to_dict(), "feature": [{"shape": "plateau", "height": 1e-6, "flat": 0.25}]}
scene = tehl.Scene.from_dict(data)
run = tehl.run(scene, "new.zarr", threads=2)
bending = np.zeros((1, 36, 6))
bending[0, :, 0] = 100 * np.cos(np.arange(36) * np.pi / 18)
out = {"checked": {kind: [one.compute() / one.expected for one in entry.checked] for kind, entry in made.items()},
       "template": scene_file.dumps(scene), "suite": list(stability.cases()),
       "drawn": sum(s.features[0].shape == "plateau" for s in stability.random_cases(30).values() if hasattr(s, "features")),
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
    """The folder with a copy of the package and four files more in which :data:`RUN` ran."""
    copy = tmp_path_factory.mktemp("package")
    extended(copy, map(shown, ("A feature shape", "A fatigue criterion", "An oil", "An output field")), RUN)
    return copy


@pytest.fixture(scope="module")
def out(new):
    return json.loads((new / "out.json").read_text())


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
