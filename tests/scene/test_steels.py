"""The registry of named steels, and what a name means for a body."""

import pytest
from tehl_cli.main import app
from typer.testing import CliRunner
from values.test_registry import hold

from tehl_taichi.scene import SceneError, scene, scene_file
from tehl_taichi.scene.named_steels import STEELS
from tehl_taichi.scene.sections import Body
from tehl_taichi.values.quantity import kinds

NAMED = {name: Body(material=name, **steel.numbers) for name, steel in STEELS.items()}


@pytest.mark.parametrize("name", STEELS)
def test_every_named_steel_holds_and_brings_all_its_numbers(name):
    hold(STEELS[name])
    free = {"material", "yield_stress", "hardening"}  # no source for hardened yield stresses
    assert {*free, *STEELS[name].numbers} == set(kinds(Body))
    changed = scene("gear").replace(**{"bodies.b.material": name})
    assert changed.body_b == NAMED[name] and changed.body_a == Body() and not changed.warnings()
    assert Body(material=name) == Body(name) == NAMED[name] and Body(material=name, k=40.0).c == NAMED[name].c


def test_a_scene_file_names_a_steel(tmp_path):
    path = tmp_path / "steel.toml"
    path.write_text('base = "gear"\n[bodies.a]\nmaterial = "16MnCr5"\n[bodies.b]\nmaterial = "100Cr6"\nk = 40.0\n')
    found = scene_file.load(path)
    assert found.body_a == NAMED["16MnCr5"] and (found.body_b.k, found.body_b.E) == (40.0, NAMED["100Cr6"].E)
    path.write_text(scene_file.dumps(found))
    assert scene_file.load(path) == found


def test_a_number_beside_the_name_is_used_and_warned_about():
    changed = scene("gear").replace(**{"bodies.a.material": "100Cr6", "bodies.a.k": 40.0})
    assert changed.body_a.k == 40.0 and changed.body_a.c == NAMED["100Cr6"].c
    warned, = changed.warnings()
    assert warned.startswith("bodies.a.material = 100Cr6 has other numbers than that steel (k)")


def test_unknown_steels_are_refused_with_the_nearest(tmp_path):
    with pytest.raises(SceneError, match=r"bodies.b.material = '100Cr7' is not known; allowed: .*did you mean '100Cr6'"):
        scene("gear").replace(**{"bodies.b.material": "100Cr7"})
    (tmp_path / "bad.toml").write_text('base = "gear"\n[bodies.a]\nmaterial = "18MnCr5"\n')
    with pytest.raises(SceneError, match="bodies.a.material = '18MnCr5' is not known"):
        scene_file.load(tmp_path / "bad.toml")


def test_the_command_lists_numbers_and_sources():
    told = " ".join(CliRunner().invoke(app, ["steels"]).stdout.split())
    assert all(name in told and steel.source in told for name, steel in STEELS.items()) and "208" in told


@pytest.mark.parametrize("command", ["scenes", "oils", "steels", "laws"])
def test_lists_stay_within_the_width_of_the_terminal(command, monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    lines = CliRunner().invoke(app, [command]).stdout.splitlines()
    assert len(lines) > 5 and [line for line in lines if len(line.rstrip()) > 100] == []
