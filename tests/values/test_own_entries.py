"""Entries of the user: files in the folder TEHL_ENTRIES."""

from pathlib import Path

import pytest

from tehl_taichi.errors import SceneError
from tehl_taichi.laws import shear
from tehl_taichi.laws.law import ShearLaw
from tehl_taichi.values.registry import collect

EXAMPLE = (Path(__file__).parents[2] / "CONTRIBUTING.md").read_text(encoding="utf-8").split("### A shear law\n")[1]


@pytest.fixture
def own(tmp_path, monkeypatch):
    monkeypatch.setenv("TEHL_ENTRIES", str(tmp_path))
    (tmp_path / "shear").mkdir()
    return tmp_path / "shear"


def test_a_file_of_the_user_is_a_choice(own):
    (own / "mine.py").write_text(EXAMPLE.split("```python\n")[1].split("```")[0])
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
    with pytest.raises(ValueError, match="two entries named 'eyring'"):
        collect(shear, ShearLaw)


def test_no_folder_is_refused_and_none_named_is_none(own, monkeypatch):
    monkeypatch.setenv("TEHL_ENTRIES", str(own / "none"))
    with pytest.raises(SceneError, match="TEHL_ENTRIES = .*none' is not a folder"):
        collect(shear, ShearLaw)
    monkeypatch.setenv("TEHL_ENTRIES", "")
    assert set(collect(shear, ShearLaw)) == {"carreau", "eyring", "limiting", "newtonian"}
