"""One word opens runs, studies and flanks, and the commands that look at them."""

import json

import made_results
import pytest
from commands import here
from fake_cases import formula

import tehl_taichi as tehl
from tehl_taichi.errors import StoreError
from tehl_taichi.runs.flank import Flank
from tehl_taichi.runs.open_results import kind, open_run
from tehl_taichi.runs.sweep import sweeping
from tehl_taichi.runs.sweep.plan import plan


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A folder with a run, a study and a flank."""
    folder = tmp_path_factory.mktemp("results")
    made_results.run(folder / "run.zarr")
    line = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16})
    sweeping.run(plan(line, {"srr": [-0.1, 0.1]}), folder / "study.zarr", workers=1, work=formula)
    made_results.flank(folder / "flank")
    return folder


def test_what_lies_there_is_what_comes_out(made):
    found = {name: tehl.open(made / name) for name in ("run.zarr", "study.zarr", "flank")}
    assert [kind(made / name) for name in found] == ["run", "study", "flank"]
    assert found["run.zarr"].summary["steady"]["h_c_m"] > 0 and isinstance(found["run.zarr"], tehl.Run)
    assert found["study.zarr"].values["fatigue_Fi_max"].tolist() == pytest.approx([1.05, 0.85])
    flank = found["flank"]
    assert isinstance(flank, Flank) and [Fi["fatigue"]["Fi_max"] for *_, Fi in flank.rows[:2]] == [1.4, 0.7]
    assert [(at.point, reason) for at, reason in flank.failed] == [("E", "step 7 failed")]
    assert flank.title == "fzg-c: flank of the pinion, 265.1 N m and 2170 1/min at the pinion"


@pytest.mark.parametrize("name, said", [
    (".", "is not a run, study, flank, bearing or cam: it has none of zarr.json, flank.json, bearing.json and cam"),
    ("nothing", "the folder does not exist")])
def test_what_is_nothing_of_ours_is_refused(made, name, said):
    with pytest.raises(StoreError, match=said):
        tehl.open(made / name)


@pytest.mark.parametrize("name, said", [("study.zarr", r"is a study: its table is .*table.csv; .*cases/NUMBER.zarr"),
                                        ("flank", r"is a flank: its table is .*flank.csv; .*POSITION.zarr")])
def test_where_a_run_is_needed_the_others_say_where_theirs_lie(made, name, said):
    with pytest.raises(StoreError, match=said):
        open_run(made / name)
    for words in (("resume",), ("fatigue",), ("crack",), ("export",)):
        done = here(*words, name, cwd=made)
        assert done.returncode == 2 and f"{name} is a " in done.stderr and "use the store" in done.stderr, words


def test_show_prints_a_flank_as_it_was_printed(made):
    done = here("show", "flank", cwd=made)
    assert done.returncode == 0 and "while the feature passes" in done.stdout and "no result: E" in done.stdout
    assert json.loads(here("show", "flank", "--json", cwd=made).stdout) == json.loads((made / "flank/flank.json").read_text())


def test_plot_draws_each_and_refuses_what_is_of_another(made):
    pytest.importorskip("matplotlib")
    done = here("plot", "flank", "--dpi", 40, "--out", "drawn", cwd=made)
    assert done.returncode == 0 and done.stdout.split() == ["drawn/flank.png"] and (made / "drawn/flank.png").exists()
    for words, said in ((("flank", "--at", 0.5), "--at 0.5 applies to a run, but flank is a flank"),
                        (("run.zarr", "--quantity", "x"), "--quantity x applies to a study, but run.zarr is a run")):
        assert said in here("plot", *words, cwd=made).stderr
