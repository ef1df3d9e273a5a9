"""A store whose law is not installed here: shown and plotted with the name of the law, never computed with."""

import json

import made_results
import pytest
from commands import here

import tehl_taichi as tehl
from tehl_taichi.errors import StoreError
from tehl_taichi.store.reader import Reader


@pytest.fixture
def missing(tmp_path):
    """A function (changes of the stored scene) -> path of a finished run with them."""
    def make(**changes):
        path = made_results.run(tmp_path / "r.zarr", search=made_results.fatigue())
        file = path / "zarr.json"
        root = json.loads(file.read_text())
        data = json.loads(root["attributes"]["scene"])
        for key, value in changes.items():
            section, _, name = key.partition("__")
            data[section][name] = value
        root["attributes"]["scene"] = json.dumps(data)
        file.write_text(json.dumps(root))
        return path
    return make


OWN_LAW = {"rheology__law": "rounded", "rheology__limit_n": 3.0}


def test_results_are_read_and_the_missing_law_is_named(missing):
    run = tehl.open(missing(**OWN_LAW))
    assert "was made with rheology.law = 'rounded', which is not installed here; known: carreau" in run.store.lacks
    assert run["p_max"].value > 0 and run.summary["fatigue"]["Fi_max"] == 1.008 and "gear" in repr(run)
    assert run.store.fields(1)["pressure"].max() > 0


def test_nothing_is_computed_with_it(missing):
    path = missing(**OWN_LAW)
    run = tehl.open(path)
    for compute in (lambda: run.scene, lambda: run.fatigue(kappa=0.2), lambda: run.rest(1), lambda: tehl.scene(path),
                    lambda: tehl.resume(path, steps=1), lambda: tehl.report(path), lambda: Reader.open(path),
                    lambda: run.crack(), lambda: tehl.fatigue(run, kappa=0.2), lambda: tehl.crack(run)):
        with pytest.raises(StoreError, match="rheology.law = 'rounded', which is not installed here"):
            compute()


@pytest.mark.parametrize("key, value", [("oil__viscosity", "cameron"), ("oil__density", "tait-own"),
                                        ("fatigue__criterion", "ellipse")])
def test_other_choices_too(missing, key, value):
    assert f"{key.replace('__', '.')} = {value!r}" in tehl.open(missing(**{key: value})).store.lacks


def test_several_may_be_missing(missing):
    store = Reader.open(missing(**OWN_LAW, oil__viscosity="cameron", oil__cameron_n=16.0), stand_in=True)
    assert "rheology.law = 'rounded'" in store.lacks and store.scene.rheology.law != "rounded"


@pytest.mark.parametrize("changes, why", [({"grid__nx": -3}, "is damaged: .*grid.nx"),
                                          ({**OWN_LAW, "grid__nx": -3}, "needs rheology.law = 'rounded'")])
def test_a_damaged_scene_is_refused(missing, changes, why):
    with pytest.raises(StoreError, match=why):
        tehl.open(missing(**changes))


@pytest.mark.parametrize("command", [("show", "r.zarr"), ("plot", "r.zarr", "--dpi", "40", "--force")])
def test_the_commands_say_which_law_is_missing(missing, command):
    path = missing(**OWN_LAW)
    done = here(*command, cwd=path.parent)
    assert done.returncode == 0 and "warning: r.zarr was made with rheology.law = 'rounded'" in done.stderr
    assert done.stdout
