"""--dry-run refuses what the run would refuse, and writes nothing."""

import json
import os

import made_results
import pytest
from commands import here
from small_stores import SMALL

from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.runs.sweep.study_table import Study

RUN = ("run", "gear", "--isothermal", "--grid", "64x16", "--dry-run")
SWEEP = ("sweep", "gear", "--isothermal", "--grid", "64x16", "--over", "srr=0.1,0.2", "--dry-run")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with a store, a study, a folder and a file of somebody else."""
    path = tmp_path_factory.mktemp("dry")
    made_results.run(path / "run.zarr", SMALL, 3)
    Study.write(path / "study.zarr", plan(SMALL, {"srr": [0.3, 0.4]})).close()
    (path / "foreign").mkdir()
    (path / "foreign" / "file").write_text("mine")
    return path


def listed(folder):
    return sorted(os.path.join(top, name) for top, folders, files in os.walk(folder) for name in (*folders, *files))


@pytest.mark.parametrize("words, said", [
    ((*RUN, "--threads", 0), "threads = 0 is out of range"), ((*RUN, "--threads", -3), "threads = -3 is out of range"),
    ((*RUN, "--arch", "xyz"), "arch = 'xyz' is not available"), ((*RUN, "--out", "run.zarr"), "run.zarr exists already"),
    ((*RUN, "--out", "foreign/file", "--force"), "not a store"), ((*RUN, "--out", "foreign"), "not a store"),
    ((*RUN, "--out", ""), "not a possible name"), ((*RUN, "--out", "foreign/file/a.zarr"), "cannot write to"),
    ((*RUN, "--out", "run.zarr/a.zarr"), "which holds results"), ((*SWEEP, "--out", "run.zarr"), "is not a study"),
    ((*SWEEP, "--out", "foreign"), "is not a study"), ((*SWEEP, "--out", "study.zarr"), "holds another study"),
    ((*SWEEP, "--out", "foreign/file/a.zarr"), "cannot write to")])
def test_what_the_run_refuses(folder, words, said):
    before = listed(folder)
    found = here(*words, cwd=folder)
    assert found.returncode in (1, 2) and said in found.stderr and not found.stdout and listed(folder) == before


@pytest.mark.parametrize("words", [(*RUN, "--out", "run.zarr", "--force"), (*RUN, "--out", "new.zarr", "--threads", 2), SWEEP])
def test_what_the_run_accepts(folder, words):
    before = listed(folder)
    found = here(*words, cwd=folder)
    assert found.returncode == 0 and found.stdout and listed(folder) == before, found.stderr


@pytest.mark.parametrize("words", [RUN, SWEEP, (*RUN, "--width", 1.2e-4)])
def test_the_plan_as_one_json_object(folder, words):
    found, text = here(*words, "--json", cwd=folder), here(*words, cwd=folder).stdout
    plan = json.loads(found.stdout)
    assert (found.returncode, found.stderr, plan["dry_run"]) == (0, "", True)
    assert all(sentence in text for sentence in plan["warnings"]) and text.count("warning: ") == len(plan["warnings"])


def test_the_plan_says_what_the_summary_will_say(folder):
    """Numbers that a run and its plan both have are equal."""
    plan = json.loads(here("run", folder / "run.zarr", "--dry-run", "--json").stdout)
    whole = json.loads(here("show", folder / "run.zarr", "--json").stdout)
    shared = plan.keys() & whole.keys() - {"steady", "steps", "warnings", "warning_codes", "warning_data"}
    assert {"hertz", "cells", "domain", "left_out"} <= shared and {key: plan[key] for key in shared} == {
        key: whole[key] for key in shared}
    assert plan["steady"].items() <= whole["steady"].items()


@pytest.mark.parametrize("more", [(), ("--json",)])
def test_a_sweep_warns_of_its_scenes(more, tmp_path):
    """As `tehl run --dry-run` does of one."""
    words = ("smooth-line", "--set", "oil.name=mineral-vg220", "--dry-run", *more)
    one = here("run", *words, cwd=tmp_path).stdout
    many = here("sweep", *words, "--over", "speed=5,6", cwd=tmp_path).stdout
    assert (sentence := "oil.alpha_40 is not given") in one and many.count(sentence) == 1 and "2 of 2 cases" in many
