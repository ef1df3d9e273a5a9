"""Plugins: folders with entries of the user."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from tehl_cli import entry

from tehl_taichi.errors import SceneError
from tehl_taichi.laws import shear
from tehl_taichi.laws.law import ShearLaw
from tehl_taichi.runs import self_test
from tehl_taichi.values import plugins
from tehl_taichi.values.registry import collect

EXAMPLE = (Path(__file__).parents[2] / "CONTRIBUTING.md").read_text(encoding="utf-8").split("### A shear law\n")[1]
LAW = EXAMPLE.split("```python\n")[1].split("```")[0]


@pytest.fixture
def own(tmp_path, monkeypatch):
    monkeypatch.setenv("TEHL_PLUGINS", str(tmp_path))
    (tmp_path / "shear").mkdir()
    yield tmp_path / "shear"
    for name in [name for name in sys.modules if name.startswith(plugins.PREFIX)]:
        del sys.modules[name]


def test_a_file_of_the_user_is_a_choice(own):
    (own / "mine.py").write_text(LAW)
    found = collect(shear, ShearLaw)
    assert found.keys() - {"carreau", "eyring", "limiting", "newtonian"} == {"rounded"}
    (known,) = found["rounded"].checked
    assert known.compute() == pytest.approx(known.expected, rel=known.rel)
    assert collect(shear, ShearLaw)["rounded"] is found["rounded"]


def test_a_file_that_fails_is_named(own):
    (own / "wrong.py").write_text("1 / 0\n")
    with pytest.raises(SceneError, match=r"wrong\.py cannot be loaded \(ZeroDivisionError: division by zero\)"):
        collect(shear, ShearLaw)


def test_two_entries_of_one_name_are_refused(own):
    (own / "twice.py").write_text("from tehl_taichi.laws.law import ShearLaw\n"
                                  "LAW = ShearLaw(name='eyring', says='', source='', numbers={}, stress=None, checked=())\n")
    with pytest.raises(SceneError, match=r"twice\.py: name = 'eyring' belongs to another entry"):
        collect(shear, ShearLaw)


def test_a_file_without_an_entry_is_refused_unless_its_name_begins_with_an_underscore(own):
    (own / "_help.py").write_text("y = 1\n")
    assert len(collect(shear, ShearLaw)) == 4
    (own / "none.py").write_text("y = 1\n")
    with pytest.raises(SceneError, match=r"none\.py has no entry; assign a ShearLaw"):
        collect(shear, ShearLaw)


@pytest.mark.parametrize("text, computed, good", [(LAW, "5.1e+07", True),
                                                  (LAW.replace("0.8, 1e9", "0.9, 1e9"), "4.71495e+07", False),
                                                  (LAW.replace("rheology.limit_n", "rheology.n"), "AttributeError", False)])
def test_known_values_of_the_user_are_computed(own, text, computed, good):
    (own / "mine.py").write_text(text)
    (own.parent / "lost.py").write_text(text)
    collect(shear, ShearLaw)
    (file, name, known, found, right), = self_test.plugins_checked()
    assert file == str(own / "mine.py") and name == "rounded" and known.endswith("51/0.8 MPa: 5.1e+07")
    assert found.startswith(computed) and right is good
    assert plugins.unread_files() == [own.parent / "lost.py"]


def test_an_error_that_is_not_ours_names_the_files_of_the_user(own):
    (own / "mine.py").write_text(LAW)
    assert entry._sentence(TypeError("\n\x1b[31mno\x1b[0m\n exp")) == "no exp"
    collect(shear, ShearLaw)
    assert re.match(rf"no exp\. The cause may lie in {own}/mine\.py: ", entry._sentence(TypeError("no exp")))
    assert entry._sentence(SceneError("too large")) == "too large"


def test_no_folder_is_refused_and_none_named_is_none(own, monkeypatch):
    monkeypatch.setenv("TEHL_PLUGINS", str(own / "none"))
    with pytest.raises(SceneError, match="TEHL_PLUGINS = .*none' is neither a folder nor a package"):
        collect(shear, ShearLaw)
    monkeypatch.setenv("TEHL_PLUGINS", "")
    assert set(collect(shear, ShearLaw)) == {"carreau", "eyring", "limiting", "newtonian"}


HARDENING = """from tehl_taichi.laws.hardening.hardening_law import HardeningLaw
from tehl_taichi.values.registry import Checked


def flow_stress(yield_stress, strain):
    return yield_stress * (1 + 10 * strain)


LINEAR = HardeningLaw(name="linear", says="linear", source="by hand", flow_stress=flow_stress,
                      checked=(Checked("by hand", 2.42e9, lambda: flow_stress(2.2e9, 0.01)),))
"""
SCENE = '''plugins = ["mylaws"]
base = "smooth-line"
[rheology]
law = "rounded"
[bodies.a]
hardening = "linear"
[grid]
nx = 32
[thermal]
on = false
'''


@pytest.fixture
def scene_file(tmp_path):
    """A scene file beside its plugin."""
    for folder, text in (("shear", LAW), ("hardening", HARDENING)):
        (tmp_path / "mylaws" / folder).mkdir(parents=True)
        (tmp_path / "mylaws" / folder / "mine.py").write_text(text)
    (tmp_path / "my.toml").write_text(SCENE)
    return tmp_path / "my.toml"


def in_a_process(words, folder, **more):
    """A command in a folder of its own; its output."""
    found = {key: value for key, value in os.environ.items() if key not in (plugins.VARIABLE, plugins.OLDER)}
    done = subprocess.run([sys.executable, *words], cwd=folder, env={**found, **more}, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def test_python_sees_the_plugins_of_a_scene_file(scene_file, tmp_path):
    """By tehl.scene, in a process that has read no registry yet; later ones are refused with the remedy."""
    (tmp_path / "other.toml").write_text(SCENE.replace("mylaws", "others"))
    (tmp_path / "others").mkdir()
    code = """import tehl_taichi as tehl
found = tehl.scene("my.toml")
print(found.rheology.law, found.body_a.hardening)
try:
    tehl.scene("other.toml")
except tehl.SceneError as error:
    print(error)"""
    ok, text = in_a_process(["-c", code], tmp_path)
    assert ok == 0 and text.startswith("rounded linear\n")
    assert f"come too late: the laws of this process are already read; set TEHL_PLUGINS={tmp_path / 'others'} before" in text


@pytest.mark.parametrize("call, end", [
    ("tehl.flank(scene='my.toml', workers=0)", "workers = 0 is out of range; allowed: 1 to 1024"),
    ("tehl.cam('cycle.csv', scene='my.toml', workers=0)", "workers = 0 is out of range; allowed: 1 to 1024"),
    ("tehl.march('my.toml', precision='f16')", "precision = 'f16' is"),
    ("tehl.crack([], 'my.toml')", "as tehl_taichi.simulate gives them")])
def test_every_function_with_a_scene_sees_its_plugins(scene_file, tmp_path, call, end):
    """Also where it is the first call of a process."""
    (tmp_path / "cycle.csv").write_text("angle_deg,load_N_per_mm,R_mm,u_a_m_s,u_b_m_s\n0,100,10,1,2\n")
    ok, text = in_a_process(["-c", f"import tehl_taichi as tehl\n{call}\n"], tmp_path)
    assert ok == 1 and end in text and "too late" not in text and "'rounded' is not known" not in text, text


@pytest.mark.slow
def test_commands_and_their_workers_see_them(scene_file, tmp_path):
    """A sweep on two processes; without the plugin the command says which law is missing. No kernel has the hardening law."""
    text = SCENE.replace('law = "rounded"', "")
    scene_file.write_text(text)
    code = "import sys; from tehl_cli.entry import main; sys.argv[0] = 'tehl'; main()"
    sweep = ["-c", code, "sweep", "my.toml", "--over", "srr=0.1,0.2", "--workers", "2", "--quiet", "--keep", "summary"]
    ok, said = in_a_process(sweep, tmp_path)
    assert ok == 0 and said.count("ok") >= 2, said
    scene_file.write_text(text.replace('plugins = ["mylaws"]', ""))
    ok, said = in_a_process(sweep, tmp_path)
    assert ok == 2 and "bodies.a.hardening = 'linear' is not known" in said
    ok, said = in_a_process([*sweep[:3], "my.toml", "--over", "srr=0.1,0.2", "--dry-run"], tmp_path, TEHL_PLUGINS="mylaws")
    assert ok == 0, said


def test_several_folders_and_packages_and_the_older_name(tmp_path, monkeypatch):
    (tmp_path / "one").mkdir()
    package = tmp_path / "site" / "two_laws"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("raise RuntimeError('not imported')\n")
    (tmp_path / "three").mkdir()
    monkeypatch.syspath_prepend(tmp_path / "site")
    monkeypatch.setenv("TEHL_PLUGINS", f"{tmp_path / 'one'}:two_laws")
    monkeypatch.setenv("TEHL_ENTRIES", str(tmp_path / "three"))
    assert plugins.folders() == {tmp_path / "one": "TEHL_PLUGINS", package: "TEHL_PLUGINS", tmp_path / "three": "TEHL_ENTRIES"}
    monkeypatch.setattr(plugins, "_entry_points", lambda: (("mine", "two_laws"),))
    monkeypatch.setenv("TEHL_PLUGINS", "")
    assert plugins.folders() == {package: "entry point mine", tmp_path / "three": "TEHL_ENTRIES"}


def test_two_folders_may_have_files_of_one_name(tmp_path, monkeypatch):
    """Their modules do not stand for each other."""
    for n, name in enumerate(("one", "two")):
        (tmp_path / name / "shear").mkdir(parents=True)
        (tmp_path / name / "shear" / "mine.py").write_text(LAW.replace('"rounded"', f'"rounded-{n}"'))
    monkeypatch.setenv("TEHL_PLUGINS", os.pathsep.join(str(tmp_path / name) for name in ("one", "two")))
    assert {"rounded-0", "rounded-1"} <= collect(shear, ShearLaw).keys()
    for name in [name for name in sys.modules if name.startswith(plugins.PREFIX)]:
        del sys.modules[name]


def test_the_scene_of_a_gear_file_counts_too(scene_file, tmp_path, monkeypatch):
    monkeypatch.setenv("TEHL_PLUGINS", "")
    monkeypatch.setattr(sys.modules["tehl_taichi.values.registry"], "started", set())
    (tmp_path / "gears.toml").write_text('base = "fzg-c"\nscene = "my.toml"\n')
    plugins.use_plugins_of(tmp_path / "gears.toml")
    assert os.environ["TEHL_PLUGINS"] == str(tmp_path / "mylaws")
    plugins.use_plugins_of(tmp_path / "my.toml")
    assert os.environ["TEHL_PLUGINS"] == str(tmp_path / "mylaws")


@pytest.mark.parametrize("value, words", [('"mylaws"', "must be a list of folders"), ("[1]", "must be a list of folders"),
                                          ('["none"]', "neither a folder nor a package")])
def test_what_is_no_plugin_is_refused(scene_file, value, words):
    scene_file.write_text(SCENE.replace('["mylaws"]', value))
    with pytest.raises(SceneError, match=words):
        plugins.use_plugins_of(scene_file)
