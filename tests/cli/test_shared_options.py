"""Options that several commands share are those of one function."""

import ast
from collections import Counter
from dataclasses import fields
from inspect import signature
from pathlib import Path

import pytest
import tehl_cli
import typer
from tehl_cli.crack_command import crack
from tehl_cli.main import app
from tehl_cli.scene_options import changes_of
from tehl_cli.shared_options import sharing
from typer.testing import CliRunner

from tehl_taichi.crack.crack_options import CrackOptions
from tehl_taichi.errors import SceneError, typed_options

COMMANDS = typer.main.get_command(app).commands


def loads(load: float = 1.0):
    """An option."""


def names(command):
    return [one.name for one in COMMANDS[command].params]


def test_shared_parameters_stand_at_their_place_and_arrive_with_their_values():
    app, arrived = typer.Typer(add_completion=False), []

    @app.command()
    @sharing(1, loads, lambda on="inner": None)
    def run(name: str, own: int = 2, **shared):
        arrived.append((name, own, shared))

    assert [one.name for one in typer.main.get_command(app).params] == ["name", "load", "own", "on"]
    assert CliRunner().invoke(app, ["a", "--load", "3", "--on", "outer"]).exit_code == 0
    run("b", own=5)
    assert arrived == [("a", 2, {"load": 3.0, "on": "outer"}), ("b", 5, {"load": 1.0, "on": "inner"})]


def test_balls_and_rollers_differ_in_their_dimensions_alone():
    balls, rollers = ({"ball_diameter", "balls", "osculation", "osculation_outer"},
                      {"roller_diameter", "rollers", "length", "crown", "taper"})
    assert set(names("bearing")) - set(names("roller")) == balls and set(names("roller")) - set(names("bearing")) == rollers
    assert [name for name in names("bearing") if name not in balls] == [name for name in names("roller") if name not in rollers]


def test_no_help_of_an_option_is_written_twice():
    nodes = [node for file in Path(tehl_cli.__file__).parent.glob("*.py") for node in ast.walk(ast.parse(file.read_text()))]
    calls = [node for node in nodes if isinstance(node, ast.Call) and "Argument" not in ast.unparse(node.func)]
    written = [word.value.value for call in calls for word in call.keywords
               if word.arg == "help" and isinstance(word.value, ast.Constant)]
    assert len(written) > 80
    assert [text for text, count in Counter(written).items() if count > 1] == []


def test_a_factor_that_no_window_has_is_named_by_its_option_too():
    with pytest.raises(SceneError, match="^--zoom 3 and --set zoom.factor=2 contradict each other"), typed_options():
        changes_of({"zoom.factor": 3}, None, ["zoom.factor=2"])


def test_the_command_and_the_call_of_a_crack_have_equal_defaults():
    """`tehl crack` names its defaults for --help, where the class behind `tehl_taichi.crack` would take long to import."""
    of_command = {name: getattr(one.default, "default", one.default) for name, one in signature(crack).parameters.items()}
    of_call = {one.name: one.default for one in fields(CrackOptions)}
    assert {name: of_command[name] for name in of_call} == of_call
