"""Names with markup of rich, mathematics, escape sequences, HTML, formulas and line breaks come out as they are, everywhere."""

import csv
import io
import json

import fake_cases
import made_results
import numpy as np
import pytest
from commands import here
from disk.test_hostile_archives import cli
from made_results import smooth
from small_stores import SMALL

import tehl_taichi as tehl
from tehl_taichi.runs.sweep import sweeping
from tehl_taichi.values.escape import cell, label, printable

pytestmark = pytest.mark.usefixtures("without_library")
ESC = "\x1b]0;owned\x07\x1b[2J"
NAMES = ["[bold red]x[/] [/y]", "$\\frac{$", "$x^2$ <i>", "=HYPERLINK(1)", "<b>bold</b><script>", "_under", "100 % {x}",
         "a&amp;b"]
CONTROL = [f"e{ESC}", "two\nlines", "a\rb", "turned\u202egnp", "c1\x9b31m"]


@pytest.mark.parametrize("text", [*NAMES, *CONTROL])
def test_no_letter_of_a_terminal_is_left_in_what_is_printed(text):
    found = printable(text)
    assert all(c.isprintable() for c in found) and (found == text) == (text in NAMES)
    assert printable("ä µ σ ± 1\u202f000 \u00a0") == "ä µ σ ± 1\u202f000 \u00a0"


@pytest.mark.parametrize("text", ["=1+1", "+1+1", "-1+1", "@SUM(A1)", "\t=1", "\r=1", " =1", "＝1"])
def test_no_cell_is_a_formula(text):
    assert cell(text).startswith("'") and cell(text)[1:].lstrip() == printable(text, "\n").lstrip()


def test_numbers_and_words_stay_as_they_are_in_a_table():
    for value in (-0.5, 3, None, "-0.5", "+1e-6", "word", "a = b", "", np.float64(-2.0)):
        assert cell(value) is value or cell(value) == value


def named(folder, name, **more):
    return made_results.run(folder / "a.zarr", SMALL.replace(name=name, **more), 3, said=[f"doubt about {name}"])


@pytest.mark.rendered
@pytest.mark.parametrize("name", NAMES)
def test_the_name_of_a_scene_in_the_terminal_and_in_figures(tmp_path, name):
    pytest.importorskip("matplotlib")
    if name == "a&amp;b":
        name = "a&b"
    name = name.replace("/", "|").replace("\\", "|")
    path = named(tmp_path, name)
    code, said = cli("show", path)
    assert code == 0 and f"scene {name}" in said and f"doubt about {name}" in said.replace("\n", " ").replace("  ", " ")
    if name != "$x^2$ <i>":  # the one for figures: mathematics that would be set, and a tag
        return
    import matplotlib

    with matplotlib.rc_context({"svg.fonttype": "none"}):
        code, said = cli("plot", path, "--format", "svg", "--dpi", 40)
    drawn = (tmp_path / "a" / "centreline.svg").read_text()
    from xml.sax.saxutils import escape

    assert code == 0 and escape(name) in drawn, said


@pytest.mark.parametrize("text", [f"x{ESC}", "x\nforged: done", "x[red]", "x$y$"])
def test_names_of_files_in_messages_and_tables(tmp_path, text):
    """Of stores that are there and that are not; in tables, errors and what typer says."""
    path = tmp_path / f"{text}.zarr"
    for words in (("show", path), ("plot", path), ("new", path / "a.toml"), ("sweep", path), ("flank", path), ("run", path)):
        found = here(*words)
        assert found.returncode == 2 and printable(text) in found.stderr
        assert all(c.isprintable() or c == "\n" for c in found.stdout + found.stderr)
    made_results.run(path, SMALL, 3)
    other = made_results.run(tmp_path / "other.zarr", SMALL.replace(srr=-0.1), 3)
    for words in (("show", path), ("compare", path, other, "--dpi", 40), ("export", path), ("resume", path), ("report", path)):
        found = here(*words)
        assert found.returncode in (0, 2), found.stderr
        assert all(c.isprintable() or c == "\n" for c in found.stdout + found.stderr)
        assert printable(text) in "".join((found.stdout + found.stderr).split("\n")) or words[0] == "resume"
    assert all(c.isprintable() or c == "\n" for c in here("run", f"--x{text}", "gear").stderr)
    assert all(c.isprintable() or c == "\n" for c in here("run", "--steps", text).stderr)
    assert all(c.isprintable() or c == "\n" for c in here(f"run{text}").stderr)


def hostile_study(path):
    """A study whose records were edited: columns and reasons with whatever one likes."""
    from tehl_taichi.runs.sweep.plan import plan

    oils = ["mineral-vg100", "reference-pao"]
    steps = plan(SMALL.replace(name="[bold]=x$1$"), {"oil.name": oils, "feature.height": [0.5e-6, 1e-6]})
    sweeping.run(steps, path, workers=1, work=fake_cases.formula, keep="summary")
    lines = [json.loads(line) for line in (path / "cases.jsonl").read_text().splitlines()]
    lines[0]["summary"]["transient"] |= {"../../out": 1.0, f"[red]{ESC}": 2.0, "\n=2": 3.0, "=1+1": 4.0, "a/b": 5.0}
    lines[1] |= {"status": "failed", "reason": f"[bold]no{ESC}\nforged: all converged", "summary": None}
    (path / "cases.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))
    return path


def test_a_study_of_strangers(tmp_path):
    path = hostile_study(tmp_path / "s.zarr")
    found = here("show", path)
    assert found.returncode == 0 and all(c.isprintable() or c == "\n" for c in found.stdout)
    assert "[bold]no" in found.stdout and "\nforged" not in found.stdout
    study = tehl.open(path)
    head, *rows = csv.reader(io.StringIO(study._csv()))
    assert not any(text[:1] in "=+-@" or "/" in text for text in head)
    sweeping.run(study.plan, path, workers=1, work=fake_cases.formula, keep="summary")  # its arrays are written again
    assert sorted(file.name for file in tmp_path.iterdir()) == ["s.zarr"]
    assert len(rows) == 4 and all(len(row) == len(head) for row in rows)
    pytest.importorskip("plotly")
    assert cli("report", path)[0] == 0
    page = (tmp_path / "s.html").read_text(encoding="utf-8")
    assert "\x1b" not in page and "[bold]=x$1$" in page


def test_the_table_of_a_flank_of_strangers(tmp_path):
    pytest.importorskip("matplotlib")
    folder = made_results.flank(tmp_path / "f") if (tmp_path / "f").mkdir() is None else None
    told = json.loads((folder / "flank.json").read_text())
    told["positions"][0] |= {"point": "=A$x$", "=more": "@SUM(1)", "note[/]": f"-{ESC}"}
    told["name"] = "[/]$\\frac$"
    (folder / "flank.json").write_text(json.dumps(told))
    flank = tehl.open(folder)
    flank.write()
    table = list(csv.reader(io.StringIO((folder / "flank.csv").read_text())))
    assert not any(text[:1] in ("=", "@") or text.startswith("-\\") for row in table for text in row)
    found = here("show", folder)
    assert found.returncode == 0 and "[/]$\\frac$" in found.stdout and "=A$x$" in found.stdout
    assert cli("plot", folder, "--dpi", 40)[0] == 0


def test_headers_of_an_exported_table(tmp_path):
    path = made_results.run(tmp_path / "a.zarr", SMALL, 3)
    root = json.loads((path / "zarr.json").read_text())
    root["consolidated_metadata"]["metadata"]["film"]["attributes"]["units"] = 'm],=1+1,"\n=2'
    (path / "zarr.json").write_text(json.dumps(root))
    made = tehl.export(path, "csv", tmp_path / "out")
    with open(made / "centreline_steady.csv", newline="") as file:
        head, *rows = csv.reader(file)
    assert all(len(row) == len(head) for row in rows) and not any(text.startswith("=") for text in head)


def test_labels_of_plotly_are_no_tags():
    from tehl_taichi.report.document import _escape_labels

    spec = {"data": [{"name": "<a href='x'>", "x": [1.0], "hovertemplate": "a<extra></extra>"}],
            "layout": {"xaxis": {"title": {"text": "<b>"}, "ticktext": ["<i>", "b"]}}}
    found = _escape_labels(spec)
    assert found["data"][0] == {"name": "&lt;a href='x'&gt;", "x": [1.0], "hovertemplate": "a<extra></extra>"}
    assert found["layout"]["xaxis"] == {"title": {"text": "&lt;b&gt;"}, "ticktext": ["&lt;i&gt;", "b"]}
    assert label("a & <b>") == "a &amp; &lt;b&gt;"


@pytest.mark.rendered
def test_no_text_of_a_figure_is_mathematics(tmp_path, monkeypatch):
    """Whatever the settings of the user are."""
    matplotlib = pytest.importorskip("matplotlib")
    monkeypatch.setitem(matplotlib.rcParams, "text.usetex", True)
    path = made_results.run(tmp_path / "a.zarr", SMALL.replace(name="$\\alpha$".replace("\\", "|")), 3)
    assert smooth(0, SMALL).x.size and tehl.open(path).save_figures(dpi=40)
