"""The public face: what it lists, what it says, its examples, which run in a folder of their own each."""

import doctest
import importlib
import inspect
import pickle
import pydoc
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi import api

ROOT = Path(__file__).parents[1]
NAMES = sorted({*tehl.__all__, "open"} - {"__version__"})
CLASSES = [name for name in NAMES if isinstance(getattr(tehl, name), type)]
FUNCTIONS = [name for name in NAMES if name not in CLASSES]
# methods of public classes that only this package calls
OWN_USE = {"add", "check", "density_ratio", "faded", "filtered", "flush", "from_arrays", "from_values", "height_at", "index",
           "let_go", "line", "load_meant", "nearest", "passing", "place_in_file", "position_in_file", "table_text",
           "to_arrays", "to_rim", "with_position", "with_ring", "write", "x_of"}


def inherits(thing):
    """Whether it is one of the errors, which their base explains."""
    return isinstance(thing, type) and issubclass(thing, tehl.Error) and thing is not tehl.Error


@pytest.mark.parametrize("name", NAMES)
def test_every_public_name_says_what_it_is_and_shows_it(taichi_cpu, monkeypatch, tmp_path, name):
    thing = getattr(tehl, name)
    assert thing.__doc__ and (inherits(thing) or "Examples\n" in thing.__doc__ and ">>> " in thing.__doc__)
    monkeypatch.chdir(tmp_path)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for test in doctest.DocTestFinder(recurse=not inherits(thing)).find(thing, name, globs={}):
        assert runner.run(test).failed == 0


OTHERS = sorted({*(path.relative_to(ROOT).with_suffix("") for path in (ROOT / "tehl_taichi").rglob("*.py")
                  if ">>> " in path.read_text(encoding="utf-8"))}
                - {Path(getattr(tehl, name).__module__.replace(".", "/")) for name in NAMES} - {Path("tehl_taichi/__init__")})


@pytest.mark.parametrize("path", OTHERS, ids=str)
def test_examples_of_inner_functions_hold(path):
    found = doctest.testmod(importlib.import_module(".".join(path.parts)))
    assert found.attempted and not found.failed


@pytest.mark.parametrize("name", FUNCTIONS)
def test_public_functions_are_plain_typed_and_say_what_goes_in_and_out(name):
    thing = getattr(tehl, name)
    assert inspect.isfunction(thing) and thing.__module__ == "tehl_taichi.api" and pickle.loads(pickle.dumps(thing)) is thing
    signature = inspect.signature(thing)
    assert signature.return_annotation is not signature.empty
    for part in ("Parameters\n    ------", "Yields\n    ---" if name == "march" else "Returns\n    ---", "Raises\n    ---"):
        assert part in thing.__doc__, part
    for parameter in signature.parameters:
        assert parameter in thing.__doc__
    assert pydoc.render_doc(f"tehl_taichi.{name}", renderer=pydoc.plaintext).startswith("Python Library Documentation: func")


@pytest.mark.parametrize("name", CLASSES)
def test_methods_that_users_call_are_typed(name):
    """A strict check of a script with types refuses calls of others."""
    methods = {key: method for base in getattr(tehl, name).__mro__ if base.__module__.startswith("tehl_taichi")
               for key, method in inspect.getmembers(base, callable) if not key.startswith("_") and key in vars(base)}
    for key in methods.keys() - OWN_USE:
        signature = inspect.signature(methods[key])
        given = [one.annotation for one in signature.parameters.values() if one.name != "self"]
        assert inspect.Signature.empty not in (signature.return_annotation, *given), key


@pytest.mark.parametrize("name", CLASSES)
def test_documented_attributes_of_a_class_exist(name):
    thing = getattr(tehl, name)
    section = inspect.getdoc(thing).partition("Attributes\n----------\n")[2].partition("\n\n")[0]
    documented = [each for line in section.splitlines() if line[:1].strip() for each in line.partition(" : ")[0].split(", ")]
    known = {*dir(thing), *(key for base in thing.__mro__ for key in vars(base).get("__annotations__", ())),
             *getattr(getattr(thing.__init__, "__code__", None), "co_names", ())}
    assert set(documented) <= known


def test_the_package_is_typed():
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]["package-data"]["tehl_taichi"]
    assert "py.typed" in declared and (ROOT / "tehl_taichi" / "py.typed").exists()


def test_tab_completion_lists_what_users_call_and_a_star_leaves_the_builtin():
    assert dir(tehl) == sorted({*tehl.__all__, "open"}) and set(api.FUNCTIONS) | set(tehl.CLASSES) < set(dir(tehl))
    code = "import builtins; from tehl_taichi import *; assert open is builtins.open; assert run and Scene and march"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_functions_stay_where_folders_have_their_names():
    for name in ("march", "scene", "fatigue", "crack", "report"):
        folder = importlib.import_module(f"tehl_taichi.{name}")
        assert inspect.ismodule(folder) and getattr(tehl, name) is getattr(api, name)


def test_an_old_name_works_and_warns():
    with pytest.warns(DeprecationWarning, match="tehl_taichi.simulate"):
        assert importlib.import_module("tehl_taichi.march").simulate is tehl.simulate


def test_classes_and_functions_of_one_name_have_the_same_defaults():
    from tehl_taichi.runs import single_run, zoom_store
    from tehl_taichi.runs.flank.flank_run import flank
    from tehl_taichi.runs.sweep import sweeping
    from tehl_taichi.view.figures.animation import animate

    for inner in (animate, flank, sweeping.sweep, single_run.run, zoom_store.resume, zoom_store.zoom):
        outer = inspect.signature(getattr(api, inner.__name__)).parameters
        assert {name: p.default for name, p in outer.items()} == {
            name: p.default for name, p in inspect.signature(inner).parameters.items()}


def test_a_scene_by_whatever_names_it(tmp_path):
    file = tmp_path / "my.toml"
    file.write_text('base = "gear"\n[operation]\nu_m = 10.0\nsrr = 0.2\n')
    by_path, by_text = tehl.scene(file), tehl.scene(str(file))
    assert by_path == by_text and by_path.operation.srr == 0.2 and by_path.name == "my" and tehl.scene(by_path) is by_path
    for wrong, said in (("geer", "gear"), (tmp_path / "none.toml", "cannot read"), (None, "None is not a scene")):
        with pytest.raises(tehl.SceneError, match=said):
            tehl.scene(wrong)


@pytest.mark.parametrize("changes, meant", [({"SRR": 0.1}, "'operation.srr'"), ({"nx": 64}, "'grid.nx'"), ({"sr": 1}, "'srr'"),
                                            ({"E": 2e11}, "'bodies.a.E' or 'bodies.b.E'"), ({"grid.Nx": 64}, "'nx'")])
def test_a_wrong_name_of_a_change_is_answered_by_the_right_one(changes, meant):
    with pytest.raises(tehl.SceneError, match=f"did you mean {meant}\\?"):
        tehl.scene("gear").replace(**changes)


def test_what_is_shown_is_short():
    scene = tehl.scene("rough").replace(**{"bodies.a.E": 2e11})
    for thing in (scene, scene.oil, *scene.features, scene.grid, scene.body_a):
        assert len(repr(thing)) < 160
    assert repr(scene.features[0]).startswith("Feature(shape='rough', height=1.5e-07, width=4e-05") and "nan" not in repr(scene)
    assert repr(tehl.Grid(nx=128, ny=32)) == "Grid(nx=128, ny=32)"
    assert eval(repr(scene.grid), {"Grid": tehl.Grid}) == scene.grid


def test_heights_in_an_array_are_those_of_a_file(tmp_path):
    z = 1e-6 * np.random.default_rng(2).standard_normal((12, 20)).cumsum(0).cumsum(1) / 20
    np.save(tmp_path / "z.npy", z)
    keys = dict(pixel=5e-6, pixel_y=6e-6, level="plane", taper=1e-5)
    by_array = tehl.Feature.from_heights(z, **keys)
    by_file = tehl.Feature(shape="map", file=str(tmp_path / "z.npy"), unit="m", **keys)
    assert by_array == by_file and (by_array.whole_heights == by_file.whole_heights).all()
    scene = tehl.Scene(features=[by_array])
    assert scene.replace(srr=0.1).features[0].heights is by_array.heights
    assert tehl.scene("gear").replace(feature=[by_array]).features == (by_array,)


@pytest.mark.parametrize("heights, said", [(np.zeros((3, 9)), "at least 4 x 4"),
                                           (np.zeros(7), r"\(rows, columns\), .* or a line profile of at least 8 points"),
                                           ("abc", "array of real numbers"), (1j * np.ones((9, 9)), "real numbers"),
                                           (np.full((9, 8), np.nan), "heights lacks 72 of its 72 heights .100 %., in holes of u"
                                                                     "p to 10 points across; allowed: 5 %"),
                                           (1e3 * np.eye(9), "the array of heights, in m with level = 'plane', ranges over")])
def test_what_is_no_grid_of_heights_is_refused(heights, said):
    with pytest.raises(tehl.SceneError, match=said):
        tehl.Feature.from_heights(heights, pixel=1e-6)


def test_readme_python_example_runs(taichi_cpu, capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "README.md").read_text()
    exec(compile(text.split("```python\n")[1].split("```")[0], "README.md", "exec"), {})
    assert len(capsys.readouterr().out.splitlines()) == 5
