"""The examples of the public names run, in a folder of their own each."""

import doctest
import importlib
import inspect
import tomllib
from pathlib import Path

import pytest

import tehl_taichi as tehl

ROOT = Path(__file__).parents[1]
NAMES = sorted(set(tehl.__all__) - {"__version__"})


def called(name):
    """The function or class behind a public name."""
    found = getattr(tehl, name)
    return getattr(found, "called", found)


@pytest.mark.parametrize("name", NAMES)
def test_every_public_name_says_what_it_is_and_shows_it(taichi_cpu, monkeypatch, tmp_path, name):
    thing = called(name)
    inherited = isinstance(thing, type) and issubclass(thing, tehl.Error) and thing is not tehl.Error
    assert thing.__doc__ and (inherited or ">>> " in thing.__doc__)
    monkeypatch.chdir(tmp_path)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for test in doctest.DocTestFinder(recurse=False).find(thing, name, globs=vars(inspect.getmodule(thing)).copy()):
        assert runner.run(test).failed == 0


def test_public_functions_are_typed():
    for name in NAMES:
        thing = called(name)
        if not isinstance(thing, type):
            signature = inspect.signature(thing)
            assert signature.return_annotation is not signature.empty, name
            assert inspect.signature(getattr(tehl, name)) == signature
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]["package-data"]["tehl_taichi"]
    assert "py.typed" in declared and (ROOT / "tehl_taichi" / "py.typed").exists()


@pytest.mark.parametrize("room", ["fatigue", "march", "scene"])
def test_a_folder_that_is_called_stays_a_folder(room):
    assert callable(getattr(tehl, room)) and importlib.import_module(f"tehl_taichi.{room}") is getattr(tehl, room)


def test_a_scene_by_whatever_names_it(tmp_path):
    file = tmp_path / "my.toml"
    file.write_text('base = "gear"\n[operation]\nu_m = 10.0\nsrr = 0.2\n')
    by_path, by_text = tehl.scene(file), tehl.scene(str(file))
    assert by_path == by_text and by_path.operation.srr == 0.2 and by_path.name == "my" and tehl.scene(by_path) is by_path
    for wrong, said in (("geer", "gear"), (tmp_path / "none.toml", "cannot read"), (None, "None is no scene")):
        with pytest.raises(tehl.SceneError, match=said):
            tehl.scene(wrong)
