"""Reports as files: where they go, what is refused, what they need."""

import subprocess
import sys

import pytest
from tehl_cli.main import app
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.errors import StoreError

pytest.importorskip("plotly")
pytest.importorskip("jinja2")


def test_a_file_that_is_there_stays_unless_forced(thermal, tmp_path):
    (tmp_path / "mine.html").write_text("mine")
    words = ["report", str(thermal), "--out", str(tmp_path / "mine.html")]
    refused = CliRunner().invoke(app, words).exception
    assert isinstance(refused, StoreError) and "exists already; choose another --out, or use --force" in str(refused)
    assert (tmp_path / "mine.html").read_text() == "mine"
    refused = CliRunner().invoke(app, [*words, "--force"]).exception
    assert isinstance(refused, StoreError) and "was not written by tehl" in str(refused)
    assert (tmp_path / "mine.html").read_text() == "mine"
    words[-1] = str(tmp_path / "page.html")
    for more in ([], ["--force"]):
        assert CliRunner().invoke(app, [*words, *more]).output.strip() == words[-1]
        assert (tmp_path / "page.html").read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mine.html", "page.html"]


@pytest.mark.slow
def test_it_needs_no_matplotlib(thermal, tmp_path):
    code = f"import sys; sys.modules['matplotlib'] = None; import tehl_taichi as tehl; tehl.report({str(thermal)!r}, 'a.html')"
    assert subprocess.run([sys.executable, "-c", code], cwd=tmp_path).returncode == 0 and (tmp_path / "a.html").exists()


def test_open_shows_the_file_that_was_written(thermal, tmp_path, monkeypatch):
    shown = []
    monkeypatch.setattr("typer.launch", shown.append)
    for words in ([], ["--open"]):
        CliRunner().invoke(app, ["report", str(thermal), "--out", str(tmp_path / f"{len(words)}.html"), *words])
    assert shown == [(tmp_path / "1.html").as_uri()]


def test_what_is_no_result_is_refused_and_nothing_written(tmp_path):
    (tmp_path / "empty").mkdir()
    with pytest.raises(StoreError, match="is not a store"):
        tehl.report(tmp_path / "empty")
    (tmp_path / "flank").mkdir()
    (tmp_path / "flank" / "flank.json").write_text('{"name": "half"')
    with pytest.raises(StoreError, match="flank.json is damaged"):
        tehl.report(tmp_path / "flank")
    with pytest.raises(StoreError, match="is a folder; path takes the name of a file"):
        tehl.report(tmp_path / "empty", tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["empty", "flank"]


def test_the_page_goes_beside_the_folder(thermal):
    made = tehl.report(tehl.open(thermal))
    assert made == thermal.with_suffix(".html") and made.stat().st_size < 4e6
    made.unlink()


@pytest.mark.parametrize("name", ["plotly", "jinja2"])
def test_what_is_not_installed_is_named_with_how_to_get_it(thermal, tmp_path, monkeypatch, name):
    monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(StoreError, match=rf"a report needs {name}: pip install 'tehl_taichi\[report\]'"):
        tehl.report(thermal, tmp_path / "a.html")
