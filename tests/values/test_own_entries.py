"""Entries of the user: files in the folder TEHL_ENTRIES."""

import re
import sys
from pathlib import Path

import pytest
from tehl_cli import entry

from tehl_taichi.errors import SceneError
from tehl_taichi.laws import shear
from tehl_taichi.laws.law import ShearLaw
from tehl_taichi.runs import self_test
from tehl_taichi.values import own_entries
from tehl_taichi.values.registry import collect

EXAMPLE = (Path(__file__).parents[2] / "CONTRIBUTING.md").read_text(encoding="utf-8").split("### A shear law\n")[1]
LAW = EXAMPLE.split("```python\n")[1].split("```")[0]


@pytest.fixture
def own(tmp_path, monkeypatch):
    monkeypatch.setenv("TEHL_ENTRIES", str(tmp_path))
    (tmp_path / "shear").mkdir()
    yield tmp_path / "shear"
    for name in [name for name in sys.modules if name.startswith(own_entries.PREFIX)]:
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
    (file, name, known, found, right), = self_test.own_entries_checked()
    assert file == str(own / "mine.py") and name == "rounded" and known.endswith("51/0.8 MPa: 5.1e+07")
    assert found.startswith(computed) and right is good
    assert own_entries.unread() == [own.parent / "lost.py"]


def test_an_error_that_is_not_ours_names_the_files_of_the_user(own):
    (own / "mine.py").write_text(LAW)
    assert entry._sentence(TypeError("\n\x1b[31mno\x1b[0m\n exp")) == "no exp"
    collect(shear, ShearLaw)
    assert re.match(rf"no exp\. The cause may lie in {own}/mine\.py: ", entry._sentence(TypeError("no exp")))
    assert entry._sentence(SceneError("too large")) == "too large"


def test_no_folder_is_refused_and_none_named_is_none(own, monkeypatch):
    monkeypatch.setenv("TEHL_ENTRIES", str(own / "none"))
    with pytest.raises(SceneError, match="TEHL_ENTRIES = .*none' is not a folder"):
        collect(shear, ShearLaw)
    monkeypatch.setenv("TEHL_ENTRIES", "")
    assert set(collect(shear, ShearLaw)) == {"carreau", "eyring", "limiting", "newtonian"}
