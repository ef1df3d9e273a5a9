"""Every --out: what is there stays, without --force whatever it is, with it unless tehl wrote it; nothing inside a store."""

import os
import re

import made_results
import pytest
from commands import here
from disk.test_hostile_archives import cli, flanked, snapshot, stored, swept
from small_stores import SMALL, store

pytest.importorskip("matplotlib")
pytestmark = pytest.mark.usefixtures("without_library")
FAST = ("--dpi", 40)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs")
    made_results.run(folder / "other.zarr", SMALL, 3)
    return made_results.run(folder / "made.zarr", SMALL, 3)


def single_files(run):
    """{name: (words before --out, name of the file)} of commands that write one file."""
    return {"compare": (("compare", run, run.with_name("other.zarr"), *FAST), "a.png"),
            "animate": (("animate", run, "--frames", 2, *FAST), "a.gif"),
            "report": (("report", run), "a.html"), "netcdf": (("export", run, "--format", "netcdf"), "a.nc")}


def folders(run):
    """{name: (words before --out, a file that is made in the folder)}."""
    return {"plot": (("plot", run, *FAST), "centreline.png"), "csv": (("export", run), "series.csv"),
            "vtk": (("export", run, "--format", "vtk"), "passage.pvd")}


NEEDS = {"report": ("jinja2", "plotly"), "netcdf": ("xarray", "h5netcdf")}


@pytest.mark.parametrize("command", ["compare", "animate", "report", "netcdf"])
def test_a_file_that_is_there(run, tmp_path, command):
    for module in NEEDS.get(command, ()):
        pytest.importorskip(module)
    words, name = single_files(run)[command]
    out = tmp_path / "new" / name
    assert cli(*words, "--out", out)[0] == 0 and [path.name for path in out.parent.iterdir()] == [name]
    before = out.stat()
    code, said = cli(*words, "--out", out)
    assert code == 2 and "exists already" in said and out.stat() == before
    assert cli(*words, "--out", out, "--force")[0] == 0 and out.stat().st_ino != before.st_ino  # ours is replaced
    for mine in (b"my thesis", b"", out.read_bytes()[:8] + b" and the rest is mine"):
        out.write_bytes(mine)
        for more in ((), ("--force",)):
            code, said = cli(*words, "--out", out, *more)
            assert code == 2 and str(out) in said and out.read_bytes() == mine
    out.unlink()
    for number, put in enumerate((lambda: out.symlink_to(tmp_path / "thesis"), lambda: os.mkfifo(out))):
        put()
        for more in ((), ("--force",)):
            code, said = cli(*words, "--out", out, *more)
            assert code == 2 and f"{out} is a {('link', 'special file')[number]}" in said
            assert ("remove it" in said) == (number == 0)
        assert not (tmp_path / "thesis").exists() and os.path.lexists(out)
        out.unlink()
    assert [path.name for path in out.parent.iterdir()] == []


@pytest.mark.parametrize("command", ["plot", "csv", "vtk"])
def test_files_in_a_folder_that_is_there(run, tmp_path, command):
    words, name = folders(run)[command]
    out = tmp_path / "out"
    assert cli(*words, "--out", out)[0] == 0
    before = snapshot(out)
    code, said = cli(*words, "--out", out)
    assert code == 2 and "exists already" in said and snapshot(out) == before
    assert cli(*words, "--out", out, "--force")[0] == 0 and snapshot(out).keys() == before.keys()
    (out / name).write_text("my thesis")
    for more in ((), ("--force",)):
        code, said = cli(*words, "--out", out, *more)
        assert code == 2 and str(out) in said and (out / name).read_text() == "my thesis"
    (out / name).unlink()
    (out / name).symlink_to(tmp_path / "thesis")
    code, said = cli(*words, "--out", out, "--force")
    assert code == 2 and not (tmp_path / "thesis").exists() and (out / name).is_symlink()


@pytest.mark.parametrize("kind", ["store", "study", "flank"])
def test_nothing_is_written_inside_a_store_a_study_or_a_flank(run, tmp_path, kind):
    """A link to its folder leads there, too."""
    inside = {"store": stored, "study": swept, "flank": flanked}[kind](tmp_path / "made")
    (tmp_path / "way").symlink_to(inside)
    (inside / "empty").mkdir()
    before = snapshot(inside)
    kept = next(path for path in inside.rglob("*") if path.is_file() and path.parent != inside)
    commands = [(words, name) for words, name in (*single_files(run).values(), *folders(run).values())]
    commands += [(("run", "gear", "--steps", 0), "x.zarr"), (("flank", "fzg-c", "--workers", 1), "x"),
                 (("sweep", "gear", "--over", "srr=0,0.1", "--workers", 1), "x.zarr"), (("bench", "speed", "--quick"), "")]
    for words, name in commands:
        for out in (inside / name, inside / "empty" / name, inside / "new" / name, tmp_path / "way" / name, kept):
            code, said = cli(*words, "--out", out, *(["--force"] if words[0] not in ("sweep", "flank") else []))
            assert code == 2, (words, out, said)
            assert snapshot(inside) == before, (words, out)
    assert cli("new", inside / "a.toml")[0] == 2 and snapshot(inside) == before


def test_other_files_that_commands_write(run, tmp_path, monkeypatch):
    """The kept answer of a crack, a scene, a suite, a flank's table."""
    kept = run.with_name("made.crack.json")
    kept.write_text("mine")
    from tehl_taichi.disk import user_files
    from tehl_taichi.errors import StoreError

    with pytest.raises(StoreError, match="was not written by tehl"):
        user_files.text(kept, "{}", force=True)
    assert kept.read_text() == "mine"
    kept.unlink()
    (tmp_path / "a.toml").symlink_to(tmp_path / "thesis")
    assert cli("new", tmp_path / "a.toml")[0] == 2 and not (tmp_path / "thesis").exists()
    for name in ("speed.json", "speed.png"):
        (tmp_path / name).write_text("mine")
        for more in ((), ("--force",)):
            assert here("bench", "speed", "--quick", "--out", tmp_path, *more).returncode == 2
        assert (tmp_path / name).read_text() == "mine"
        (tmp_path / name).unlink()
    folder = tmp_path / "flank"
    folder.mkdir()
    (folder / "flank.csv").write_text("mine")
    code, said = cli("flank", "fzg-c", "--out", folder, "--workers", 1)
    assert code == 2 and "is not the folder of a flank" in said and (folder / "flank.csv").read_text() == "mine"


def test_a_flank_plots_into_itself_and_nowhere_else_inside(tmp_path):
    folder = flanked(tmp_path / "flank")
    assert cli("plot", folder, *FAST)[0] == 0 and (folder / "flank.png").exists()
    assert cli("plot", folder, *FAST)[0] == 2 and cli("plot", folder, *FAST, "--force")[0] == 0
    other = store(tmp_path / "other.zarr", 1).path
    assert cli("plot", folder, *FAST, "--out", other)[0] == 2 and not (other / "flank.png").exists()


@pytest.mark.parametrize("name", ["a.xyz", "a", "a.png", "a.html", "a.json", "a.csv", "a.nc", "a.pdf", "a.md", "a.pvd"])
def test_files_of_others_are_not_taken_for_ours(tmp_path, name):
    """Empty, of other programs, or with our name in them."""
    from tehl_taichi.disk.user_files import is_ours

    for content in (b"", b"tehl_taichi", b"\x89PNG tehl_taichi", b'{"note": "made with tehl_taichi"}', b"a,b [m]\n1,2\n",
                    b"<?xml version='1.0'?><p>tehl_taichi</p>", b"%PDF-1.4 tehl_taichi", b"<html>tehl_taichi"):
        (tmp_path / name).write_bytes(content)
        assert not is_ours(tmp_path / name), content


@pytest.mark.parametrize("name, said", [("file.csv", "file.csv"), ("n" * 300, "File name too long"),
                                        ("file.csv/new", "file.csv is not a folder|/file.csv: no permission")])
def test_a_name_that_no_result_can_have(run, tmp_path, monkeypatch, name, said):
    """Refused with the path and exit code 2, before anything is computed."""
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "file.csv"
    file.write_text("angle_deg, load_N_per_mm, R_mm, u_a_m_s, u_b_m_s\n0, 100, 10, 3.0, 1.0\n")
    computing = (("run", "smooth-line"), ("sweep", "smooth-line", "--over", "srr=0,0.1"), ("flank", "fzg-c", "--steady"),
                 ("cam", file), ("bearing", "6206", "--load", 3000, "--speed", 3000), ("traction", "smooth-line"))
    for words in (*computing, ("export", run), ("plot", run)):
        code, words_of_it = cli(*words, "--out", name)
        assert code == 2 and re.search(said, words_of_it) and words_of_it.count("\n") <= 2, words_of_it
        assert [path.name for path in tmp_path.iterdir()] == ["file.csv"]
