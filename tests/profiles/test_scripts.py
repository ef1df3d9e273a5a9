"""The scripts of profiles/examples run, on small grids and for a few steps."""

import re
import runpy
import sys
from pathlib import Path

import numpy as np
import pytest

import tehl_taichi as tehl

EXAMPLES = Path(__file__).parents[2] / "profiles" / "examples"


@pytest.fixture
def script(monkeypatch, capsys, tmp_path):
    """Runs one with these words in a folder of its own and gives what it printed."""
    def run(name, *words):
        monkeypatch.setattr(sys, "argv", [name, *map(str, words)])
        monkeypatch.syspath_prepend(EXAMPLES)  # as Python does where a script is started
        runpy.run_path(str(EXAMPLES / name), run_name="__main__")
        return capsys.readouterr().out

    monkeypatch.chdir(tmp_path)
    return run


def test_every_script_is_asked_for_here():
    text = Path(__file__).read_text(encoding="utf-8")
    assert [path.name for path in EXAMPLES.glob("*.py") if f'"{path.name}"' not in text] == []


def test_the_scan_of_the_tutorial_is_a_surface_without_doubts(script, tmp_path):
    script("make_scan.py", "scan.csv")
    assert np.loadtxt("scan.csv", delimiter=",").shape == (41, 81)
    (tmp_path / "my_flank.toml").write_text((EXAMPLES / "my_flank.toml").read_text(encoding="utf-8"), encoding="utf-8")
    scene = tehl.scene("my_flank.toml").replace(**{"grid.nx": 128, "grid.ny": 32})
    measures = scene.features[0].measures
    assert scene.warnings() == [] and not scene.symmetric
    assert measures.range == pytest.approx(1.15e-6, rel=0.02) and measures.slope == pytest.approx(1.2, rel=0.1)


def test_own_stresses(taichi_cpu, script):
    lines = script("own_stresses.py").splitlines()
    assert "findley: Fi 0.483 in phase, 0.450 out of phase" in lines and len(lines) == 4


def test_own_loop(taichi_cpu, script):
    assert script("own_loop.py", 1).splitlines()[1].startswith("step 1: dent at -0.557 mm, 1.9")


def test_five_jobs(taichi_cpu, script):
    text = (EXAMPLES / "five_jobs.py").read_text(encoding="utf-8")
    assert text.count("# %% [markdown]\n# ## ") == 5 and text.count("\n# %%\n") == 6
    lines = script("five_jobs.py").splitlines()
    assert re.match(r"steady.h_c: 0\.4\d+ ± 0\.\d+ µm$", lines[0]) and "scan: range 0.80 um, Fi 0." in "\n".join(lines)
    assert sum(line.startswith("{'srr': ") for line in lines) == 4
    tension, shear = map(int, re.findall(r"(\d+) MPa", lines[-1]))
    assert 0.85 < tension / (2 * 0.1 * 1500) < 1  # at the trailing edge 2 mu p0, a square root between the nodes
    assert shear == pytest.approx(0.3003 * 1500, rel=0.03)  # Johnson, without friction


@pytest.mark.slow
def test_the_measured_surface_of_the_tutorial(taichi_cpu, script, tmp_path):
    said = script("measured_surface.py", tmp_path, "grid.nx=64", "grid.ny=16", "time.steps=3")
    assert "of the patch" in said and (tmp_path / "my_flank.zarr").is_dir()
    assert tehl.open(tmp_path / "my_flank.zarr").store.last_step == 3


@pytest.mark.slow
def test_the_passage_of_the_tutorial_ends_and_its_film_holds(taichi_cpu, script, tmp_path):
    """On the coarse grid that its page advises."""
    script("make_scan.py", "scan.csv")
    (tmp_path / "my_flank.toml").write_text((EXAMPLES / "my_flank.toml").read_text(encoding="utf-8"), encoding="utf-8")
    states = list(tehl.march(tehl.scene("my_flank.toml").replace(**{"grid.nx": 128, "grid.ny": 32})))
    assert len(states) == 114 and min(state.scalars["h_min_m"] for state in states) > 5e-8
    assert max(state.scalars["p_max_Pa"] for state in states) == pytest.approx(3.69e9, rel=0.01)


@pytest.mark.slow
def test_the_gallery(taichi_cpu, script, tmp_path):
    pytest.importorskip("matplotlib")
    table = script("gallery.py", "smooth-line", "dent", "--grid", "64x16", "--steps", 3, "--out", tmp_path / "sheet.png")
    assert [line.split(" | ")[0] for line in table.splitlines()[2:]] == ["| smooth-line", "| dent"]
    assert (tmp_path / "sheet.png").stat().st_size > 10_000


@pytest.mark.slow
def test_published_films(taichi_cpu, script):
    rows = [line.split(" | ") for line in script("published_films.py", "--columns", 64).splitlines()[2:]]
    assert len(rows) == 7 and all(abs(float(row[4].strip(" %|"))) < 1 for row in rows)
