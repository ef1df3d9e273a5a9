"""Where numbers come from: the commit, versions, what a store says about its making, what the package declares."""

import ast
import json
import re
import runpy
import shutil
import subprocess
import sys
import tomllib
from datetime import datetime, timezone
from pathlib import Path

import pytest

from tehl_taichi import __version__, commit, scene

ROOT = Path(__file__).parents[2]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())


def git(folder, *words):
    identity = ("-c", "user.name=n", "-c", "user.email=n@example.org", "-c", "commit.gpgsign=false")
    return subprocess.run(["git", *identity, "-C", folder, *words], capture_output=True, text=True, check=True).stdout.strip()


@pytest.fixture
def checkout(tmp_path):
    """A git checkout whose package is commit.py and its file."""
    package = tmp_path / "checkout" / "tehl_taichi"
    package.mkdir(parents=True)
    for name in ("commit.py", "commit.txt"):
        shutil.copy(ROOT / "tehl_taichi" / name, package)
    (package / "commit.txt").write_text("$Format:%H$\n")  # these tests may run in an archive, where it is filled in
    (package.parent / ".gitattributes").write_text((ROOT / ".gitattributes").read_text())
    git(package.parent, "init", "-q")
    git(package.parent, "add", ".")
    git(package.parent, "commit", "-q", "-m", "first")
    return package.parent


def commit_of(folder):
    return runpy.run_path(str(folder / "tehl_taichi" / "commit.py"))["commit"]()


def test_a_checkout_knows_its_commit_and_its_changes(checkout):
    head = git(checkout, "rev-parse", "HEAD")[:12]
    (checkout / "results.csv").touch()  # not part of the code
    assert commit_of(checkout) == head
    with (checkout / "tehl_taichi" / "commit.py").open("a") as file:
        file.write("# changed\n")
    assert commit_of(checkout) == head + "+changes"


def test_an_archive_and_a_wheel_know_their_commit_and_other_copies_say_unknown(checkout, tmp_path):
    head, archive = git(checkout, "rev-parse", "HEAD")[:12], tmp_path / "archive"
    git(checkout, "archive", "--format=tar", f"--output={tmp_path}/a.tar", "HEAD")
    shutil.unpack_archive(tmp_path / "a.tar", archive)
    assert commit_of(archive) == head
    (archive / "tehl_taichi" / "commit.txt").write_text(head + "+changes\n")  # by the build of a wheel
    assert commit_of(archive) == head + "+changes"
    inside = checkout / "venv"  # a copy inside somebody's checkout is not that checkout
    shutil.copytree(checkout / "tehl_taichi", inside / "tehl_taichi")
    assert commit_of(inside) == "unknown"


def test_the_version_is_told_with_the_commit():
    done = subprocess.run([sys.executable, "-m", "tehl_taichi", "--version"], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0 and done.stdout.startswith(f"tehl_taichi {__version__}, commit {commit.commit()}, Python 3.")


def test_provenance(taichi_cpu, monkeypatch):
    from tehl_taichi.runs.provenance import provenance

    monkeypatch.setattr(sys, "argv", ["tehl", "run", "--set", "name=two words"])
    told = provenance(scene("gear"))
    assert told["version"] == __version__ and told["commit"] == commit.commit() and told["precision"] == "f32"
    assert told["command"] == "tehl run --set 'name=two words'" and told["cores"] >= 1
    assert abs((datetime.now(timezone.utc) - datetime.fromisoformat(told["date"])).total_seconds()) < 60
    assert all(re.match(r"\d+\.\d+", told[name]) for name in ("python", "numpy", "pyfftw", "zarr"))
    assert json.loads(told["runtime"])["threads"] == 2 and "Linux" in told["machine"] or sys.platform != "linux"
    assert provenance(scene("gear").replace(**{"numerics.precision": "f64"}))["precision"] == "f64"


def test_what_is_imported_is_declared():
    groups = [PYPROJECT["project"]["dependencies"], *PYPROJECT["project"]["optional-dependencies"].values()]
    declared = {re.match(r"\w+", name).group() for group in groups for name in group}
    sources = [path for folder in ("tehl_taichi", "cli", "profiles") for path in (ROOT / folder).rglob("*.py")]
    nodes = [node for path in sources for node in ast.walk(ast.parse(path.read_text()))]
    imported = {node.module for node in nodes if isinstance(node, ast.ImportFrom)}
    imported |= {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    ours = {"tehl_taichi", "tehl_cli", *(path.stem for path in (ROOT / "profiles" / "examples").glob("*.py"))}
    packages = {{"PIL": "pillow"}.get(name, name) for name in (name.partition(".")[0] for name in imported)}
    assert packages - ours - sys.stdlib_module_names <= declared


def test_pythons_that_are_supported():
    assert PYPROJECT["project"]["requires-python"] == ">=3.11,<3.14"
    assert "3.11, 3.12 or 3.13" in (ROOT / "README.md").read_text()
    assert "python3.11 python3.12 python3.13" in (ROOT / ".ci" / "run").read_text()


def test_the_version_stands_in_one_place():
    """And in CITATION.cff, which no program reads."""
    from tehl_taichi import __released__

    assert "version" not in PYPROJECT["project"] and PYPROJECT["project"]["dynamic"] == ["version"]
    cited = (ROOT / "CITATION.cff").read_text()
    assert set(re.findall(r"^ *version: (.*)$", cited, re.M)) == {__version__} and f"date-released: {__released__}" in cited
    assert set(re.findall(r"^  year: (.*)$", cited.partition("references:")[0], re.M)) == {__released__[:4]}


def test_the_program_says_how_it_is_cited():
    from tehl_cli.cite_command import AUTHORS, TITLE, bibtex

    cited = (ROOT / "CITATION.cff").read_text()
    assert TITLE in cited and AUTHORS in cited
    entry = bibtex()
    assert f"version = {{{__version__}}}" in entry and entry.count("{") == entry.count("}") and commit.commit() in entry
    done = subprocess.run([sys.executable, "-m", "tehl_taichi", "cite"], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0 and done.stdout.strip() == entry
