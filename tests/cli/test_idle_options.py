"""Options that only act together with another: said where it is missing; what cannot be written is refused before the work."""

import made_results
import pytest
from disk.test_hostile_archives import cli, flanked, thesis
from small_stores import SMALL


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return made_results.run(tmp_path_factory.mktemp("runs") / "made.zarr", SMALL, 3)


@pytest.fixture
def no_work(monkeypatch):
    """Long work is not done: whoever starts it fails."""
    from tehl_taichi.runs.flank import outcomes
    from tehl_taichi.runs.stored_run import Run

    for owner, name in ((Run, "fatigue"), (Run, "crack"), (outcomes, "summaries")):
        monkeypatch.setattr(owner, name, lambda *_, **__: pytest.fail("the work was started"))


@pytest.mark.parametrize("words, said", [
    (("run", "gear", "--dry-run", "--force"), ["--force"]), (("run", "gear", "--dry-run", "--json"), []),
    (("run", "gear", "--dry-run", "--zoom", "auto", "--steady"), ["--zoom auto"]),
    (("run", "smooth-line", "--dry-run", "--zoom", "auto"), ["--zoom auto"]),
    (("run", "gear", "--dry-run", "--zoom", "auto", "--steps", 1), []),
    (("run", "gear", "--dry-run", "--zoom", "auto", "--set", "zoom.width_x=0.5"), []),
    (("run", "gear", "--dry-run", "--zoom", 4, "--steps", 1), ["zoom.factor"]),
    (("run", "gear", "--dry-run", "--zoom", 0, "--steady"), []),
    (("fatigue", "none", "--dpi", 300, "--force", "--kappa", 0.2), ["--dpi 300", "--force"]),
    (("crack", "none", "--format", "pdf", "--width", 8.5), ["--format pdf", "--width 8.5"]),
    (("flank", "none", "--no-figure", "--figure-width", 8.5), ["--figure-width 8.5"]),
    (("flank", "none", "--no-figure", "--width", "300um"), []),
    (("traction", "none", "--no-figure", "--figure-width", 8.5), ["--figure-width 8.5"]),
    (("bearing", "none", "--no-run", "--threads", 2), ["--threads 2"]),
    (("report", "none", "--threads", 2), ["--threads 2"]), (("report", "none", "--threads", 2, "--kappa", 0.2), []),
    (("fatigue", "none", "--dpi", 300, "--figures", "new"), []), (("run", "gear", "--dry-run"), []),
    (("bench", "stability", "--match", "none", "--random", 0, "--seed", 3, "--again", 2), ["--again 2", "--seed 3"]),
    (("bench", "stability", "--match", "none", "--random", 0, "--confirm", "--starts"), ["--starts"]),
    (("bench", "accuracy", "--judge", "--only", "coverage", "--keep", "--seed", 3), ["--keep", "--seed 3"])])
def test_what_acts_only_with_another_option_is_said(words, said, tmp_path, monkeypatch):
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    found = [line for line in cli(*words)[1].splitlines() if "no effect" in line]
    assert [line.partition(" has no effect here: ")[0].removeprefix("warning: ") for line in found] == said


@pytest.mark.parametrize("steps, said", [(0, True), (1, True), (20, False)])
def test_a_window_that_a_longer_passage_gets_is_not_without_effect(steps, said, tmp_path, monkeypatch):
    """`tehl resume` continues the search: the option has an effect, later."""
    monkeypatch.chdir(tmp_path)
    text = " ".join(cli("run", "gear", "--dry-run", "--zoom", "auto", "--steps", steps)[1].split())
    assert ("--zoom auto waits for more steps: a window needs at least 3 stored moments" in text) is said


@pytest.mark.parametrize("words", [("bearing", "6206", "--on", "middle", "--no-run"), ("report", "none", "--threads", 0)])
def test_a_refused_value_has_one_message(words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, said = cli(*words)
    assert code == 2 and "; allowed: " in said and "no effect" not in said


FIGURES = [("fatigue", "fatigue.png"), ("fatigue", "fatigue_point.png"), ("crack", "crack.png")]


@pytest.mark.parametrize("command, name", FIGURES)
def test_figures_in_the_way_are_seen_before_the_search(run, tmp_path, no_work, command, name):
    pytest.importorskip("matplotlib")
    (tmp_path / name).write_text("mine")
    code, said = cli(command, run, "--figures", tmp_path)
    assert code == 2 and f"{tmp_path / name} exists already" in said
    code, said = cli(command, run, "--figures", tmp_path, "--force")
    assert code == 2 and "was not written by tehl" in said and (tmp_path / name).read_text() == "mine"
    code, said = cli(command, run, "--figures", tmp_path / name / "new")
    assert code == 2 and f"{tmp_path / name} is not a folder" in said


def test_the_kept_crack_and_the_picture_of_a_flank_are_seen_before_the_work(run, tmp_path, no_work):
    pytest.importorskip("matplotlib")
    kept = run.with_name("made.crack.json")
    kept.write_text("mine")
    code, said = cli("crack", run, "--keep")
    assert code == 2 and str(kept) in said and kept.read_text() == "mine"
    folder = flanked(tmp_path / "flank")
    (folder / "flank.png").write_text("mine")
    code, said = cli("flank", "fzg-c", "--out", folder)
    assert code == 2 and "flank.png was not written by tehl" in said
    code, said = cli("flank", "fzg-c", "--out", folder / "1.zarr")
    assert code == 2 and str(folder) in said


@pytest.mark.parametrize("command", ["fatigue", "crack", "flank"])
def test_missing_matplotlib_is_said_before_the_work(run, tmp_path, no_work, command, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "matplotlib", None)
    words = ("flank", "fzg-c", "--out", tmp_path / "f") if command == "flank" else (command, run, "--figures", tmp_path)
    code, said = cli(*words)
    assert code == 2 and "figures need matplotlib" in said


def test_errors_that_cannot_be_kept_are_seen_before_they_are_computed(tmp_path, monkeypatch):
    from tehl_taichi.scene import grid_for_error

    monkeypatch.setattr(grid_for_error, "FILE", tmp_path / "none" / "errors.json")
    code, said = cli("bench", "accuracy", "--keep", "--out", thesis(tmp_path / "out"))
    assert code == 2 and "--keep" in said and "cannot be written" in said
