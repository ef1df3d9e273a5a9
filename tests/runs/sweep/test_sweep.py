"""Sweeps: the table on disk, going on, side by side, what is lost; without a solver but for the last ones."""

import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from commands import CALL, here
from commands import process as tehl
from fake_cases import cubed, formula, greedy, square, unfinished

from tehl_taichi.errors import RuntimeUnavailable, StoreError
from tehl_taichi.report import study_page
from tehl_taichi.runs.sweep import case_records as records
from tehl_taichi.runs.sweep import pool, study_labels, summary_columns, sweeping
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.runs.sweep.study_table import Study
from tehl_taichi.scene import SceneError, scene
from tehl_taichi.values import checks

GEAR = scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16})
OVER = {"srr": "-0.1:0.1:3", "feature.height": [0.5e-6, 1e-6, 1.5e-6]}

def invoked(folder, monkeypatch, *words):
    """The same in this process."""
    from tehl_cli.main import app
    from typer.testing import CliRunner

    monkeypatch.chdir(folder)
    return CliRunner().invoke(app, list(map(str, words)))


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """Nine made-up cases, one of which does not converge."""
    return sweeping.run(plan(GEAR, OVER), tmp_path_factory.mktemp("studies") / "made.zarr", workers=1, work=formula)


@pytest.mark.parametrize("key, value, shown", [
    ("oil.nu_40", 220e-6, "kinematic viscosity at 40 °C (mm²/s)"), ("height", 220e-6, "feature height (µm)"),
    ("oil.alpha_40", 22e-9, "pressure coefficient at 40 °C (1/GPa)"), ("feature.0.x", 30e-6, "feature x (µm)"),
    ("srr", 30.0, "slide-roll ratio"), ("temperature", 90.0, "inlet temperature (°C)"), ("load", 100.0, "load (N/m)"),
    ("rheology.tau_L0", 3e7, "rheology.tau_L0 (MPa)")])
def test_keys_have_names_and_the_units_of_data_sheets(key, value, shown):
    factor, label = study_labels.of_key(GEAR, key, value)
    assert 20 < value * factor < 230 and label == shown


@pytest.mark.parametrize("column, value, shown", [
    ("transient_h_min_m", 2e-7, "passage h_min (µm)"), ("steady_film_max_C", 90.0, "largest film temperature, steady (°C)"),
    ("fatigue_Fi_max", 1.2, "Fi at the surface, largest"), ("transient_friction_coefficient_mean", 0.05,
                                                           "passage friction coefficient, mean"),
    ("hertz_p_Pa", 1e9, "hertz p (GPa)"), ("fatigue_resolved_to_x_a", 1.0, "fatigue resolved to x a")])
def test_columns_have_names_and_units(column, value, shown):
    assert study_labels.of_column(column, value)[1] == shown


def test_a_study_is_a_table_over_the_swept_keys(study):
    xarray = pytest.importorskip("xarray")
    data = xarray.open_zarr(study.path)
    assert data.fatigue_Fi_max.dims == ("srr", "feature.height") and data.sizes == {"srr": 3, "feature.height": 3}
    assert data["feature.height"].attrs["units"] == "m" and data.transient_p_max_Pa.attrs["units"] == "Pa"
    found = float(data.fatigue_Fi_max.sel({"srr": 0.1, "feature.height": 1e-6}))
    assert found == pytest.approx(0.5 + 0.3 - 0.1) and study.to_xarray().equals(data.load())
    assert np.argwhere(data.status.values == records.STATUS["not converged"]).tolist() == [[1, 2]]
    assert np.isnan(data.fatigue_Fi_max.values[1, 2]) and np.isnan(data.fatigue_Fi_max.values).sum() == 1
    with open(study.table) as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 9 and float(rows[7]["fatigue_Fi_max"]) == pytest.approx(found) and rows[5]["fatigue_Fi_max"] == ""
    assert float(rows[0]["fatigue_error_Fi_max"]) == 0.04 and rows[1]["fatigue_error_Fi_max"] == ""
    assert "left_out" not in rows[0] and float(rows[7]["feature.height"]) == 1e-6


def test_a_sweep_that_was_killed_at_its_beginning_is_resumed(tmp_path):
    """Its folder has a lock or a temporary file, and no description yet; other files are not ours."""
    path = tmp_path / "s.zarr"
    path.mkdir()
    (path / ".lock").touch()
    (path / ".zarr.json.0123456789abcdef.tmp").touch()
    Study.write(path, plan(GEAR, OVER)).close()
    assert Study.open(path).counts["waiting"] == 9 and not list(path.glob(".*"))
    (path / "zarr.json").unlink()
    with pytest.raises(StoreError, match="exists already and is not a study"):
        Study.write(path, plan(GEAR, OVER))


def test_the_table_does_not_depend_on_which_case_ends_first(tmp_path):
    """Workers end in any order, and cases have different numbers."""
    over = plan(GEAR, {"srr": [-0.1, 0.1, 0.2]})
    parts = ({"fatigue": {"Fi_max": 1.0}, "transient": {"p_max_Pa": 2e9}},
             {"transient": {"h_min_m": 1e-7}, "steady": {"h_c_m": 4e-7}},
             {"steady": {"h_c_m": 4e-7, "p_max_Pa": 1e9}, "fatigue": {"Fi_max": 0.5}})
    found = set()
    for order in ((0, 1, 2), (2, 0, 1), (1, 2, 0)):
        with Study.write(tmp_path / str(order), over) as study:
            for n in order:
                study.add({"case": n, "changes": {}, "status": "converged", "reason": "", "store": None, "seconds": 1.0,
                           "summary": parts[n]})
        found |= {study.table.read_text(), Study.open(study.path)._csv()}
    assert len(found) == 1


def test_a_damaged_table_is_refused_by_name(study, tmp_path):
    pytest.importorskip("xarray")
    path = shutil.copytree(study.path, tmp_path / "a.zarr")
    for name, said in (("fatigue_Fi_max/c/0/0", "Fi_max/c/0/0"), ("srr/c/0", "srr/c/0"), ("zarr.json", "")):
        file, content = path / name, (path / name).read_bytes()
        opened = Study.open(path)
        file.write_bytes(content[:-9])
        with pytest.raises(StoreError, match=f"{said} is damaged" if said else "does not describe the arrays of a study"):
            opened.to_xarray()
        file.unlink()
        with pytest.raises(StoreError, match=f"{said} is missing" if said else "does not describe the arrays of a study"):
            opened.to_xarray()
        file.write_bytes(content)
    assert opened.to_xarray().equals(study.to_xarray())


def test_a_stopped_sweep_leaves_no_unfinished_stores(tmp_path):
    """Those of its workers, which it ends."""
    def stop(study, record):
        if record:
            assert (study.path / "cases" / ".0001.zarr.part").exists()
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweeping.run(plan(GEAR, OVER), tmp_path / "s.zarr", workers=2, work=unfinished, progress=stop)
    assert list((tmp_path / "s.zarr" / "cases").iterdir()) == []


def test_keys_that_change_together_lie_along_one_dimension(tmp_path):
    xarray = pytest.importorskip("xarray")
    made = plan(GEAR, {("srr", "rheology.law"): [(-0.1, "eyring"), (0.1, "newtonian")]})
    data = xarray.open_zarr(sweeping.run(made, tmp_path / "s.zarr", workers=1, work=formula).path)
    assert data.fatigue_Fi_max.dims == ("case",) and data["rheology.law"].values.tolist() == ["eyring", "newtonian"]
    assert {"srr", "rheology.law"} <= set(data.coords)


def test_the_table_has_the_values_of_the_coordinates(tmp_path):
    """Switches, words and lists, too: they can be typed again."""
    over = {"thermal.on": [True, False], "fatigue.depths": ["auto", [1e-5, 2e-5]], "temperature": [60.0, 353.15 - 273.15]}
    study = sweeping.run(plan(GEAR, over), tmp_path / "s.zarr", workers=1, work=formula)
    data = study.to_xarray()
    with open(study.table) as file:
        rows = list(csv.DictReader(file))
    for key in over:
        assert list(dict.fromkeys(row[key] for row in rows)) == [str(value) for value in data[key].values]
    assert data["temperature"].units == "degC" and data["temperature"].values.tolist() == [60.0, 80.0]
    assert rows[2]["fatigue.depths"] == "[1e-05, 2e-05]" and rows[7]["thermal.on"] == "false"
    from tehl_cli.sweep_display import changes_words

    assert changes_words(study.results()[5]) == "thermal.on = false, fatigue.depths = auto, temperature = 80"


def test_going_on_changes_nothing_that_is_done(tmp_path):
    made, ran = plan(GEAR, OVER), []

    def work(job):
        ran.append(job.store)
        if len(ran) == 5:
            raise KeyboardInterrupt
        return {"status": "failed", "reason": "disk"} if len(ran) == 2 else formula(job)

    with pytest.raises(KeyboardInterrupt):
        sweeping.run(made, tmp_path / "s.zarr", workers=1, work=work)
    before = (tmp_path / "s.zarr" / records.FILE).read_bytes()
    with open(tmp_path / "s.zarr" / records.FILE, "ab") as file:
        file.write(b'{"case": 8, "status": "conv')  # killed in the middle of a line
    study = sweeping.run(made, tmp_path / "s.zarr", workers=1, work=work)
    again = [os.path.basename(store) for store in ran[5:]]
    assert again == ["0001.zarr", *(f"{n:04d}.zarr" for n in range(4, 9))]  # the failed one, and those that never ended
    assert (tmp_path / "s.zarr" / records.FILE).read_bytes().startswith(before)
    assert study.counts == {"waiting": 0, "converged": 8, "not converged": 1, "refused": 0, "failed": 0}
    sweeping.run(made, tmp_path / "s.zarr", workers=1, work=work)
    assert len(ran) == 11 and [one["case"] for one in study.results()] == list(range(9))


def test_a_corner_that_is_refused_is_in_the_table(tmp_path):
    made = plan(GEAR, {"grid.x_max": [1.5, 3.0], "height": [1e-6, 20e-6]})
    study = sweeping.run(made, tmp_path / "s.zarr", workers=1, work=formula)
    assert study.counts["refused"] == 1 and "half-width" in study.results()[1]["reason"] and study.counts["converged"] == 3


def test_another_study_is_not_touched(study, tmp_path):
    with pytest.raises(StoreError, match="another study"):
        sweeping.run(plan(GEAR, {"srr": [0.1]}), study.path, workers=1, work=formula)
    (tmp_path / "file").touch()
    for path, said in ((tmp_path, "is not a study"), (tmp_path / "file", "is not a study")):
        with pytest.raises(StoreError, match=said):
            sweeping.run(plan(GEAR, OVER), path, workers=1, work=formula)
    with Study.write(tmp_path / "held.zarr", plan(GEAR, OVER)), pytest.raises(StoreError, match="still being written"):
        sweeping.run(plan(GEAR, OVER), tmp_path / "held.zarr", workers=1, work=formula)


def test_numbers_of_workers():
    assert pool.sizes(workers=3, threads=2) == (3, 2) and pool.sizes(scheduler="tcp://x:1") == (None, 1)
    assert pool.sizes(workers=1) == (1, None) and pool.sizes(workers=100) == (100, 1)
    assert pool.sizes(jobs=1) == (1, None) and pool.sizes(workers=5, jobs=2)[0] == 2
    for wrong in ({"workers": 0}, {"threads": 0}, {"workers": 2, "scheduler": "tcp://x:1"}, {"workers": 1.5}):
        with pytest.raises(SceneError, match="workers|threads_per_worker"):
            pool.sizes(**wrong)


def test_without_dask_workers_run_and_a_scheduler_says_what_is_missing(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(RuntimeUnavailable, match=r"pip install 'tehl_taichi\[sweep\]'"):
        sweeping.run(plan(GEAR, OVER), tmp_path / "s.zarr", scheduler="tcp://127.0.0.1:1", work=formula)
    assert list(tmp_path.iterdir()) == []
    made = sweeping.run(plan(GEAR, OVER), tmp_path / "s.zarr", workers=2, work=formula)
    assert made.counts["waiting"] == 0 and made.results() == sweeping.run(made.plan, made.path, workers=1,
                                                                          work=formula).results()


@pytest.fixture(scope="module")
def client():
    """Dask in this process, two workers of one thread."""
    distributed = pytest.importorskip("distributed")
    with distributed.Client(processes=False, n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        yield client


def test_results_come_side_by_side_and_errors_stay_with_their_job(client):
    jobs = iter([*range(40), -1])
    found = dict(pool.results(square, jobs, workers=None, scheduler=client))
    assert {n: found[n] for n in range(40)} == {n: n * n for n in range(40)} and len(found) == 41
    assert found[40] == pool.LostJob("ValueError: -1 has no place here")


def test_many_small_cases_on_a_cluster_cost_little(client, tmp_path):
    made = plan(GEAR, {"srr": "-0.3:0.3:15", "feature.height": "0.5e-6:1.1e-6:4"})
    began = time.perf_counter()
    study = sweeping.run(made, tmp_path / "s.zarr", scheduler=client, work=formula)
    assert study.counts["converged"] == 60 and time.perf_counter() - began < 60 * 0.3  # 0.01 s each
    here = sweeping.run(made, tmp_path / "here.zarr", workers=1, work=formula)
    assert all(np.array_equal(study.values[name], values, equal_nan=True) for name, values in here.values.items())


@pytest.mark.rendered
def test_pictures_of_a_quantity_are_no_empty_pages(study, tmp_path):
    pytest.importorskip("matplotlib")
    paths = study.plot(tmp_path, "judged_Fi", dpi=40)
    assert len(paths) == 3 and min(path.stat().st_size for path in paths) > 3000


def test_the_index_of_a_study_is_that_of_the_verdict_of_each_case(tmp_path, monkeypatch):
    """Of the resolved part, of averaged stresses, of the percentile of rough surfaces, of the other body: in table, page and on
    the screen, though the whole passage has more everywhere.
    """
    def part(Fi, error, **more):
        return {"Fi_max": Fi, "error": {"Fi_max": error}, "surface_angle_deg": 30.0, **more}

    late = part(1.4, None, surface="a")
    cases = [{"a": {**late, "resolved": part(0.9, 0.02, to_x_a=0.5)}},
             {"a": {**late, "averaged": part(1.2, 0.1, length_m=1e-5)}},
             {"a": {**late, "rough": True, "statistics": {"p99": 1.05, "error": {"p99": 0.1}}}},
             {"a": {**late, "Fi_max": 0.7}, "b": part(0.8, 0.01)}]

    def work(job, *_):
        searches = cases[round(10 * job.scene.operation.srr) - 1]
        found = formula(job)
        return {**found, "summary": {**found["summary"], "fatigue": searches["a"], "fatigue_by_surface": searches}}

    study = sweeping.run(plan(GEAR, {"srr": [0.1, 0.2, 0.3, 0.4]}), tmp_path / "s.zarr", workers=1, work=work)
    assert study.values["judged_Fi"].tolist() == [0.9, 1.2, 1.05, 0.8]
    assert study.values["judged_error_Fi"].tolist() == [0.02, 0.1, 0.1, 0.01]
    answer = study_page._answer(study)
    assert answer.headline == ("The index that decides is above 1 in 1 of 4 cases with a result; 1 lies within the error in 1 "
                               "more.")
    assert "largest is Fi = 1.2:" in answer.sentences[0] and "smallest is Fi = 0.8:" in answer.sentences[1]
    monkeypatch.setenv("COLUMNS", "200")
    assert "0.900 ± 0.020" in here("show", study.path).stdout and summary_columns.usual_columns(study.values)[0] == "judged_Fi"


def test_pictures_of_a_study(study, tmp_path):
    pytest.importorskip("matplotlib")
    names = {path.name for path in study.plot(tmp_path, dpi=40)}
    assert names == {f"{name}_{kind}.png" for name in ("judged_Fi", "transient_h_min_m", "transient_p_max_Pa")
                     for kind in ("lines", "map")} | {"Fi_over_h_min.png"}
    with pytest.raises(StoreError, match="did you mean 'steady_h_c_m'.*; known: wall_s"):
        study.plot(tmp_path, "steady_h_m")
    drawn = plan(GEAR, {"srr": "-0.1:0.1", "height": "1e-7:1e-6:log", "rheology.law": ["eyring", "newtonian"]}, samples=6)
    sampled = sweeping.run(drawn, tmp_path / "s.zarr", workers=1, work=formula)
    assert sampled.plot(tmp_path / "p", "fatigue_Fi_max")[0].name == "fatigue_Fi_max_points.png"


def test_many_columns_are_not_listed(study, tmp_path, monkeypatch):
    pytest.importorskip("matplotlib")
    monkeypatch.setattr(checks, "MANY", len(study.values) - 1)
    with pytest.raises(StoreError, match="did you mean 'steady_h_c_m'") as unknown:
        study.plot(tmp_path, "steady_h_m")
    assert str(unknown.value).endswith(f"; all {len(study.values)} names: first line of {study.table}")
    assert set(study.values) <= set(study.table.read_text().splitlines()[0].split(","))


def test_lines_carry_the_errors_that_are_known(study):
    pytest.importorskip("matplotlib")
    from tehl_taichi.runs.sweep import study_figures
    from tehl_taichi.view.figures.figure_style import FigureStyle

    (ax,) = study_figures.lines(FigureStyle(), study, "fatigue_Fi_max").axes
    bars = [container.lines[2][0].get_segments() for container in ax.containers]
    drawn = [[float(np.ptp(bar[:, 1])) for bar in of_line if len(bar) and np.isfinite(bar).all()] for of_line in bars]
    assert drawn == [pytest.approx([0.08] * 3), [], []]
    hollow = [line.get_xdata().tolist() for line in ax.lines if str(line.get_color()) == "white"]
    assert [len(x) for x in hollow] == [0, 3, 3] and "hollow: error unknown" in ax.figure.get_suptitle()


def test_the_table_shows_errors_and_marks_those_that_are_not_known(study, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")  # on 80 a longer time of the cases leaves the errors no room
    shown = here("show", study.path).stdout
    assert "0.750 ± 0.040" in shown and "0.9 ± ?" in shown and shown.count("±") - shown.count("± ?") == 3


def test_the_heat_map_shows_each_case_where_it_belongs(study):
    pytest.importorskip("matplotlib")
    from tehl_taichi.runs.sweep import study_figures
    from tehl_taichi.view.figures.figure_style import FigureStyle

    ax = study_figures.heat_map(FigureStyle(), study, "fatigue_Fi_max").axes[0]
    shown = ax.images[0].get_array()
    assert shown[1, 2] == pytest.approx(0.7) and np.ma.getmaskarray(np.ma.masked_invalid(shown))[2].tolist() == [0, 1, 0]
    assert [text.get_text() for text in ax.get_yticklabels()] == ["0.5", "1", "1.5"] and "µm" in ax.get_ylabel()


@pytest.mark.parametrize("srr, height, told", [([-0.1, 0.1, 0.3], [1e-6, 2e-6, 4e-6], "y"), ([-0.1, 0.1], [1e-6, 2e-6], ""),
                                              ([-0.1, 0.0, 0.3], [1e-6, 2e-6, 3e-6], "x")])
def test_a_heat_map_says_where_its_cells_are_not_to_scale(tmp_path, srr, height, told):
    pytest.importorskip("matplotlib")
    from tehl_taichi.runs.sweep import study_figures
    from tehl_taichi.view.figures.figure_style import FigureStyle

    study = sweeping.run(plan(GEAR, {"srr": srr, "height": height}), tmp_path / "s.zarr", workers=1, work=formula)
    ax = study_figures.heat_map(FigureStyle(), study, "fatigue_Fi_max").axes[0]
    assert [label.endswith(", not to scale") for label in (ax.get_xlabel(), ax.get_ylabel())] == ["x" in told, "y" in told]


def test_a_sweep_runs_its_cases(taichi_cpu, tmp_path):
    import tehl_taichi as tehl

    steps = GEAR.replace(**{"time.steps": 1, "fatigue.on": False})
    study = tehl.sweep(steps, {"srr": [-0.1, 0.1]}, tmp_path / "s.zarr", workers=1)
    first, second = study.results()
    assert first["converged"] and second["summary"]["steady"]["h_c_m"] == study.values["steady_h_c_m"][1]
    run = tehl.open(second["store"])
    assert run.scene.operation.srr == 0.1 and run.summary["transient"] == second["summary"]["transient"]
    alone = tehl.sweep(steps, {"srr": [-0.1]}, tmp_path / "alone.zarr", workers=1, keep="summary")
    assert alone.results()[0]["store"] is None and not list((alone.path / "cases").iterdir())
    assert alone.values["transient_p_max_Pa"][0] == study.values["transient_p_max_Pa"][0]


def test_a_case_that_does_not_converge_leaves_the_others(taichi_cpu, tmp_path, monkeypatch):
    import tehl_taichi as tehl
    from tehl_taichi.errors import NotConverged
    from tehl_taichi.runs import single_run

    whole = single_run.run_or_resume

    def stubborn(description, *args, **options):
        if description.operation.srr == 0.0:
            raise NotConverged("step 1 did not converge")
        return whole(description, *args, **options)

    monkeypatch.setattr(single_run, "run_or_resume", stubborn)
    over = {"srr": [0.0, 0.1]}
    study = tehl.sweep(GEAR.replace(**{"time.steps": 0, "fatigue.on": False}), over, tmp_path / "s.zarr", workers=1)
    assert [one["status"] for one in study.results()] == ["not converged", "converged"]
    assert study.results()[0]["reason"] == "step 1 did not converge" and study.results()[0]["store"] is None


def test_the_command_line_of_a_sweep(taichi_cpu, tmp_path, monkeypatch):
    words = ("sweep", "smooth-line", "--over", "srr=0,0.1", "--over", "speed=5,10", "--isothermal", "--set", "grid.nx=64",
             "--workers", 1)
    done = invoked(tmp_path, monkeypatch, *words, "--json")
    found = json.loads(done.stdout)
    assert done.exit_code == 0 and (found["cases"], found["converged"], found["failed"]) == (4, 4, 0), done.stderr
    assert found["results"][3]["changes"] == {"srr": 0.1, "speed": 10} and found["results"][3]["summary"]["steady"]["h_c_m"] > 0
    assert {"changes", "store", "converged", "summary"} <= found["results"][0].keys() and (tmp_path / found["table"]).exists()
    again = invoked(tmp_path, monkeypatch, "sweep", found["study"], "--workers", 1)
    assert again.exit_code == 0 and "4 of them already done" in again.stderr and "ok" in again.stdout
    assert again.stdout in invoked(tmp_path, monkeypatch, "show", found["study"]).stdout
    assert json.loads(invoked(tmp_path, monkeypatch, "show", found["study"], "--json").stdout) == found
    assert f"its table is {found['table']}" in str(invoked(tmp_path, monkeypatch, "export", found["study"]).exception)


@pytest.mark.parametrize("words, said", [
    (("--over", "sr=1"), "did you mean 'srr'"), (("--over", "srr=0,9"), "srr = 9"), ((), "--over"),
    (("--over", "srr=-1:1:1001"), "--yes"), (("--over", "srr=0:1"), "--samples"), (("--over", "srr=0", "--keep", "no"), "keep"),
    (("--over", "srr=0,0.1", "--workers", "2", "--scheduler", "tcp://127.0.0.1:1"), "contradict"),
])
def test_a_sweep_that_cannot_be_writes_nothing(words, said, tmp_path, monkeypatch):
    error = invoked(tmp_path, monkeypatch, "sweep", "gear", *words).exception
    assert error.exit_code == 2 and said in str(error) and list(tmp_path.iterdir()) == []


def test_answers_belong_to_their_jobs():
    jobs = range(-2, 30)
    found = dict(pool.results(square, iter(jobs), workers=3))
    assert [found.pop(n).reason for n in (0, 1)] == ["ValueError: -2 has no place here", "ValueError: -1 has no place here"]
    assert found == {n: job**2 for n, job in enumerate(jobs) if job >= 0}


def test_a_script_from_stdin_has_workers(tmp_path):
    """It is no file that they could import."""
    code = "from tehl_taichi.runs.sweep import pool; print(sorted(pool.results(str, range(3), workers=2)), __file__)"
    run = subprocess.run([sys.executable], input=code, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert run.stdout == "[(0, '0'), (1, '1'), (2, '2')] <stdin>\n"


def test_workers_open_no_port_and_end_with_their_sweep(tmp_path):
    """A worker hears of its jobs by a pipe; of a killed sweep it is not left."""
    code = ("import fake_cases, sys; from tehl_taichi.runs.sweep import pool\n"
            "if __name__ == '__main__': dict(pool.results(fake_cases.sockets, [sys.argv[1]] * 2, workers=2))")
    (tmp_path / "script.py").write_text(code)
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
    run = subprocess.Popen([sys.executable, "script.py", tmp_path], cwd=tmp_path, env=environment)
    _wait_for(lambda: len(list(tmp_path.glob("*.json"))) == 2)
    workers = [json.loads(path.read_text()) for path in tmp_path.glob("*.json")]
    assert all(found["listening"] == [] for found in workers)
    run.kill()
    run.wait()
    _wait_for(lambda: not any(Path(f"/proc/{found['pid']}/cmdline").exists() and _alive(found["pid"]) for found in workers))


def _alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def test_a_worker_that_takes_more_than_its_share_is_ended(monkeypatch):
    from tehl_taichi.disk import memory_limit

    monkeypatch.setattr(memory_limit, "available", lambda: 4e8)  # 190 MB each
    monkeypatch.setattr("tehl_taichi.runs.sweep.local_workers.PAUSE", 0.05)
    found = dict(pool.results(greedy, [10, 400], workers=2))
    assert found[0] == 10 and "out of memory" in found[1].reason


def test_a_job_over_which_workers_die_is_tried_once_more_then_told_of(tmp_path):
    jobs = [(number, str(tmp_path)) for number in range(20)]
    found = dict(pool.results(cubed, jobs, workers=2))
    assert isinstance(found.pop(13), pool.LostJob) and found == {n: n**3 for n in range(20) if n != 13}
    (tmp_path / "1").unlink()  # room for one death
    assert dict(pool.results(cubed, jobs, workers=2))[13] == 13**3


@pytest.mark.slow
def test_a_sweep_survives_the_death_of_a_worker_and_its_own(tmp_path):
    small = ("--isothermal", "--grid", "64x16", "--steps", "20")
    words = ("sweep", "gear", "--over", "srr=-0.1,0.1", "--over", "feature.height=0.5e-6,1e-6", *small, "--out", "s.zarr")
    nowhere = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    run = subprocess.Popen([*CALL, *words, "--workers", "2"], cwd=tmp_path, **nowhere)
    cases = tmp_path / "s.zarr" / "cases"
    os.kill(_writer(cases / "0001.zarr"), signal.SIGKILL)
    _wait_for(lambda: len(_lines(tmp_path)) >= 2)
    run.kill()
    assert run.wait() == -signal.SIGKILL
    before = _lines(tmp_path)
    assert 2 <= len(before) < 4 and "failed" not in "".join(before)
    done = tehl(*words, "--workers", 2, "--json", cwd=tmp_path)
    assert done.returncode == 0 and json.loads(done.stdout)["converged"] == 4, done.stderr
    assert _lines(tmp_path)[: len(before)] == before
    whole = here("run", "gear", *small, "--srr", -0.1, "--height", 1e-6, "--no-estimate-error", "--json", cwd=tmp_path)
    of_the_killed = json.loads(done.stdout)["results"][1]["summary"]
    assert of_the_killed["fatigue"]["Fi_max"] == pytest.approx(json.loads(whole.stdout)["fatigue"]["Fi_max"], rel=1e-10)


def _lines(folder):
    path = folder / "s.zarr" / records.FILE
    return path.read_text().splitlines() if path.exists() else []


def _wait_for(condition):
    until = time.monotonic() + 300
    while not condition():
        assert time.monotonic() < until
        time.sleep(0.02)


def _writer(store):
    """Process that writes a store, as soon as there is one."""
    found = []

    def there():
        try:
            found.append(json.loads((store / ".lock").read_text())["pid"])
        except (OSError, ValueError):
            pass
        return found

    _wait_for(there)
    return found[0]


@pytest.mark.parametrize("workers, threads, wanted", [(None, None, None), (3, None, None), (None, 1, 1), (1, None, None)])
def test_a_single_case_runs_in_this_process_as_it_was_started(tmp_path, workers, threads, wanted):
    """Its engine may have other threads than those of a worker among several; a given number is taken."""
    jobs = []

    def work(job):
        jobs.append(job)
        return formula(job)

    sweeping.run(plan(GEAR, {"srr": [0.1]}), tmp_path / "a.zarr", workers=workers, threads_per_worker=threads, work=work)
    assert [job.threads for job in jobs] == [wanted] and not jobs[0].shared
