"""Entries of the registries: complete, and each with a number that comes out."""

import sys
import types

import pytest

from tehl_taichi.errors import SceneError
from tehl_taichi.values.registry import Checked, Entry, collect


def folder_with(monkeypatch, tmp_path, **files):
    for name, text in files.items():
        (tmp_path / f"{name}.py").write_text("from tehl_taichi.values.registry import Entry\n" + text)
    package = types.ModuleType("folder_of_entries")
    package.__path__ = [str(tmp_path)]
    monkeypatch.setitem(sys.modules, package.__name__, package)
    for name in files:
        monkeypatch.delitem(sys.modules, f"{package.__name__}.{name}", raising=False)
    return package


def test_a_file_is_an_entry(monkeypatch, tmp_path):
    text = "ENTRY = Entry(name='{}', says='', source='', checked=())\n"
    package = folder_with(monkeypatch, tmp_path, two=text.format("b"), one=text.format("c"))
    assert list(collect(package, Entry)) == ["b", "c"]


def test_two_of_one_name_are_refused(monkeypatch, tmp_path):
    text = "ENTRY = Entry(name='same', says='', source='', checked=())\n"
    with pytest.raises(SceneError, match=r"three\.py: name = 'same' belongs to another entry of folder_of_entries"):
        collect(folder_with(monkeypatch, tmp_path, three=text, four=text), Entry)


def hold(entry):
    """What every entry promises; for the tests of the registries."""
    assert entry.says and entry.source and entry.checked
    for number in entry.checked:
        assert number.where and number.compute() == pytest.approx(number.expected, rel=number.rel)


def test_an_entry_with_a_wrong_number_fails():
    entry = Entry(name="wrong", says="it", source="somebody", checked=(Checked("by hand", 2.0, lambda: 2.1),))
    with pytest.raises(AssertionError):
        hold(entry)
