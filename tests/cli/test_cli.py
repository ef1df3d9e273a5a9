"""The command line and the store, end to end."""

import json
import os
import random
import shutil
import signal
import subprocess
import time

import numpy as np
import pytest
from commands import CALL
from commands import here as tehl

import tehl_taichi
from tehl_taichi.engine import cores

TINY = ("--grid", "64x16", "--threads", "2", "--isothermal")


def assert_same(one, other):
    """Every field of two stores agrees to 1e-10."""
    from tehl_taichi.store.store import Store

    a, b = Store.open(one), Store.open(other)
    assert len(a) == len(b) and a.finished and b.finished
    for n in range(len(a)):
        left, right = a.fields(n), b.fields(n)
        for name in left:
            assert np.allclose(left[name], right[name], rtol=1e-10, atol=0), (n, name)


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A short finished run."""
    path = tmp_path_factory.mktemp("runs") / "whole.zarr"
    done = tehl("run", "gear", *TINY, "--steps", 10, "--out", path, "--json")
    assert done.returncode == 0, done.stderr
    return path, json.loads(done.stdout)


def test_json_summary_has_the_keys_of_the_interface(finished):
    path, summary = finished
    assert {"scene", "version", "store", "converged", "wall_s", "compile_s", "steps", "grid", "hertz", "left_out", "steady",
            "transient", "fatigue", "work", "clamps"} <= summary.keys()
    assert summary["steps"] == 10 and summary["grid"] == {"nx": 65, "ny": 17, "nz": 1}
    assert summary["cells"] == {"nx": 64, "ny": 16}
    assert (summary["crowding"][0] > 0) == (cores.available() > 1)  # two threads, five blocks of rows
    assert set(summary["steady"]["error"]) == {"h_c_m", "h_min_m", "p_max_Pa", "friction_coefficient"}
    errors, nothing = dict(summary["transient"]["error"]), summary["transient"]["contact_load_fraction_max"] == 0.0
    for share in ("contact_load_fraction_max", "contact_area_share_max"):
        assert errors.pop(share) == (0.0 if nothing else None)  # where nothing touches, that is known
    assert set(errors.values()) == {None}  # so short a run has no companions, and nobody asked for them
    assert summary["steady"]["film_formula_m"] == pytest.approx(summary["steady"]["h_c_m"], rel=0.2)
    assert {"Fi_max", "findley_stress_max_Pa", "x_m", "y_m", "plane_theta_deg", "plane_phi_deg", "surface_angle_deg",
            "sigma1_max_Pa", "kappa_F", "sigma_eF_Pa"} <= set(summary["fatigue"])
    assert summary["transient"]["load_error_max"] < 1e-6 and summary["transient"]["mass_error_max"] < 1e-6


@pytest.mark.slow
def test_a_thermal_run_tells_its_temperatures_and_resumes(tmp_path):
    from tehl_taichi.store.store import Store

    done = tehl("run", "gear", *TINY[:4], "--thermal", "--steps", 4, "--set", "output.profiles=true", "--out", "warm.zarr",
                "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    summary = json.loads(done.stdout)
    assert 100 < summary["steady"]["surface_a_max_C"] < summary["transient"]["film_max_C"] < 200
    assert summary["grid"]["nz"] == 9 and summary["transient"]["temperature_change_K"] < 0.05
    store = Store.open(tmp_path / "warm.zarr")
    T = store.fields(3, ["temperature", "temperature_mid"])
    assert T["temperature"].shape == (65, 17, 9) and np.array_equal(T["temperature"][..., 4], T["temperature_mid"])
    drawn = tehl("plot", "warm.zarr", "--out", "figures", cwd=tmp_path)
    assert drawn.returncode == 0 and (tmp_path / "figures" / "temperature_maps.png").exists(), drawn.stderr


@pytest.mark.slow
def test_companion_runs_tell_the_error_of_a_passage(tmp_path):
    low = ("--set", "feature.height=2e-7")  # that this grid resolves
    done = tehl("run", "gear", *TINY, *low, "--steps", 8, "--estimate-error", "--out", "e.zarr", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    summary = json.loads(done.stdout)
    error = summary["transient"]["error"]
    assert set(error) == {"p_max_Pa", "h_min_m", "friction_coefficient_mean", "contact_load_fraction_max",
                          "contact_area_share_max"}
    assert summary["fatigue"]["error"]["Fi_max"] > 0 and error["p_max_Pa"] > 0
    assert 0 < error["friction_coefficient_mean"] < summary["transient"]["friction_coefficient_mean"]
    assert "±" in tehl("show", "e.zarr", cwd=tmp_path).stdout


@pytest.mark.slow
def test_companions_that_are_refused_leave_the_run_as_it_is(tmp_path):
    done = tehl("run", "gear", "--isothermal", "--grid", "48x16", "--steps", 4, "--estimate-error", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    summary = json.loads(done.stdout)
    assert summary["converged"] and set(summary["transient"]["error"].values()) == {None}
    assert any("not known: a coarse-grid run on 12 x 4 cells is refused" in said or
               "not known: a coarse-grid run on 24 x 8 cells is refused" in said for said in summary["warnings"])


def test_xarray_opens_the_store_as_it_is(finished):
    xarray = pytest.importorskip("xarray")
    data = xarray.open_zarr(finished[0])
    assert data.sizes["time"] == 11 and data.pressure.dims == ("time", "x", "y")
    assert data.pressure.attrs["units"] == "Pa" and data.x.attrs["units"] == "m"
    assert float(data.pressure.max()) == pytest.approx(finished[1]["transient"]["p_max_Pa"], rel=1e-6)


def test_show_and_plot(finished, tmp_path):
    """Figures as they are rendered: tests/view."""
    assert "finished" in tehl("show", finished[0]).stdout
    drawn = tehl("plot", finished[0], "--out", tmp_path / "figures", "--dpi", 40)
    assert drawn.returncode == 0 and (tmp_path / "figures" / "fatigue.png").exists()


def test_a_target_error_chooses_the_grid_of_the_run(tmp_path):
    done = tehl("run", "smooth-line", "--steady", "--isothermal", "--target-error", "0.2%", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["grid"]["nx"] > 200 and "error of 0.2%" in done.stderr


def test_an_interrupt_before_the_first_step_says_so(tmp_path):
    run = subprocess.Popen([*CALL, "run", "gear", "--threads", "2", "--out", str(tmp_path / "none.zarr")], text=True,
                           stderr=subprocess.PIPE)
    run.stderr.readline()  # the scene is read, what it leaves out is told; the steady start takes seconds
    os.kill(run.pid, signal.SIGINT)
    assert run.wait() == 4 and "interrupted before anything was stored" in run.stderr.read()
    assert not (tmp_path / "none.zarr").exists()


@pytest.mark.slow
def test_ctrl_c_in_a_suite_ends_in_a_sentence(tmp_path):
    run = subprocess.Popen([*CALL, "bench", "stability", "--random", "0", "--threads", "2"], text=True, cwd=tmp_path,
                           stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
    run.stderr.readline()  # the first case is through
    os.kill(run.pid, signal.SIGINT)
    assert run.wait() == 4 and "tehl: interrupted; all stored data are kept" in run.stderr.read()


@pytest.mark.slow  # kills while it is written: tests/store/test_store_draft.py; signals in a passage: test_store_runs.py
@pytest.mark.parametrize("stop, threads", [(signal.SIGKILL, 2), (signal.SIGKILL, 1), (signal.SIGINT, 1)])
def test_a_repeated_run_that_breaks_opens_and_resumes_to_the_same_result(finished, tmp_path, stop, threads):
    """Whatever the threads of its first steps; `.ci/run` runs the wheel on one."""
    from tehl_taichi.store.store import Store

    path = tmp_path / "broken.zarr"
    words = "run", str(finished[0]), "--threads", str(threads), "--out", str(path)
    run = subprocess.Popen([*CALL, *words], stderr=subprocess.DEVNULL)
    while not (path / ".checkpoints").exists() and run.poll() is None:
        time.sleep(0.02)
    time.sleep(random.uniform(0.0, 1.5))
    os.kill(run.pid, stop)
    code = run.wait()
    if (path / "zarr.json").exists() and "steps" in Store.open(path).attrs and len(Store.open(path)):
        assert code in (-signal.SIGKILL, 4, 0)
        if not Store.open(path).finished:  # the stop may have come too late; a finished one would go on behind its ten steps
            assert tehl("resume", path, "--threads", 2).returncode == 0
        assert_same(finished[0], path)


@pytest.mark.parametrize("words, said", [
    (("run", "--load", "-5"), "N/m"), (("run", "--load", "nan"), "not a number"), (("run", "geer"), "gear"),
    (("run", "no-such.toml"), "cannot read"), (("run", "--set", "feature.hight=1e-6"), "height"),
    (("run", "--set", "feature.height"), "key=value"), (("run", "--grid", "huge"), "NXxNY"),
    (("run", "--arch", "metal"), "cpu"), (("run", "--precision", "f16"), "f64"), (("run", "--threads", "0"), "1 to"),
    (("run", "--speed", "0"), "entrainment"), (("run", "--srr", "-2"), "never passes"), (("run", "--sr", "1"), "srr"),
    (("run", "--target-error", "fast"), "0.01% to 50%"), (("run", "--target-error", "1%", "--grid", "coarse"), "1%"),
    (("run", "--srr", "fast"), "'fast'"), (("bench", "sweep", "--workers", "-3"), "'-3'"),
    (("new", "gear"), "as in gear.toml"), (("new", "fzg-c", "--gears"), "as in fzg-c.toml"),
    (("new", "tab.csv", "--gears"), "as in tab.toml"), (("new", ""), "as in my.toml"),
    (("show", "nothing.zarr"), "not a store"), (("resume", "nothing.zarr"), "not a store"),
])
def test_bad_input_is_a_sentence_and_writes_nothing(words, said, tmp_path):
    done = tehl(*words, cwd=tmp_path)
    assert done.returncode == 2 and said in done.stderr.lower() + done.stderr
    assert "Traceback" not in done.stderr and list(tmp_path.iterdir()) == []


def test_one_number_is_a_grid_where_nothing_varies_across(tmp_path):
    done = tehl("run", "furrow-line", "--steady", "--isothermal", "--grid", 64, "--threads", 2, "--json", cwd=tmp_path)
    assert done.returncode == 0 and json.loads(done.stdout)["cells"] == {"nx": 64, "ny": 0}, done.stderr
    swept = tehl("sweep", "furrow-line", "--grid", 64, "--over", "srr=0.1,0.2", "--dry-run", cwd=tmp_path)
    assert swept.returncode == 0, swept.stderr
    for words in (("run", "gear"), ("sweep", "gear", "--over", "srr=0.1,0.2", "--dry-run"), ("flank", "fzg-c")):
        refused = tehl(*words, "--grid", 64, cwd=tmp_path)
        assert refused.returncode == 2 and "--grid 64" in refused.stderr
        assert "NXxNY, as in 64x16" in refused.stderr and len(refused.stderr.splitlines()) == 1


def test_a_flank_of_smooth_surfaces_has_one_row(tmp_path, monkeypatch):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    import tehl_taichi

    class Asked(Exception):
        pass

    def flank(gear, changes, **others):
        raise Asked(changes)

    monkeypatch.setattr(tehl_taichi, "flank", flank, raising=False)
    for words in (["fzg-c", "--steady"], ["fzg-c", "--scene", "furrow-line"]):
        asked = CliRunner().invoke(app, ["flank", *words, "--grid", "64"]).exception
        assert isinstance(asked, Asked) and asked.args == ({"grid.nx": 64},)


def test_parts_of_the_time_of_a_command_leave_nothing_out(tmp_path):
    began = time.perf_counter()
    words = "run", "pitch-line", "--grid", "64x16", "--steps", 3, "--timing", "--threads", 2
    done = tehl(*words, "--json", cwd=tmp_path)
    whole, parts = time.perf_counter() - began, json.loads(done.stdout)["timing_s"]
    assert {"imports and scene", "steady start", "passage: rest", "passage: pressure", "summary and writing"} <= set(parts)
    assert all(seconds >= 0 for seconds in parts.values()) and 0.8 * whole - 0.3 < sum(parts.values()) < whole
    shown = tehl(*words, "--quiet", cwd=tmp_path).stdout
    assert "where the time went" in shown and "passage: pressure" in shown and "100 %" in shown
    plain = tehl("run", "pitch-line", "--grid", "64x16", "--steps", 0, "--json", "--out", "plain.zarr", cwd=tmp_path).stdout
    assert "timing_s" not in json.loads(plain)
    parts = json.loads(tehl("resume", "plain.zarr", "--steps", 1, "--timing", "--json", cwd=tmp_path).stdout)["timing_s"]
    assert {"imports and scene", "passage: rest", "passage: pressure"} <= set(parts) and "steady start" not in parts


def test_an_existing_store_is_not_overwritten(finished):
    before = (finished[0] / "zarr.json").read_bytes()
    done = tehl("run", "smooth-line", "--out", finished[0])
    assert done.returncode == 2 and "exists" in done.stderr and (finished[0] / "zarr.json").read_bytes() == before


def test_new_scene_file_runs(tmp_path):
    assert tehl("new", "mine.toml", "--base", "smooth-line", cwd=tmp_path).returncode == 0
    done = tehl("run", "mine.toml", "--isothermal", "--json", "--threads", 2, cwd=tmp_path)
    summary = json.loads(done.stdout)
    base = next(tehl_taichi.march(tehl_taichi.scene("smooth-line").replace(**{"thermal.on": False})))
    assert done.returncode == 0 and summary["steady"]["h_c_m"] == pytest.approx(base.scalars["h_c_m"], rel=1e-6)
    assert summary["grid"] == {"nx": 257, "ny": 1, "nz": 1} and summary["cells"] == {"nx": 256, "ny": 0}
    assert tehl("new", "mine.toml", cwd=tmp_path).returncode == 2


def test_lists_and_doctor():
    assert "touching-asperity" in tehl("scenes").stdout and "reference-pao" in tehl("oils").stdout
    assert tehl("doctor").returncode == 0


def test_fatigue_again_with_other_constants(finished, tmp_path):
    shutil.copytree(finished[0], tmp_path / "run.zarr")
    first = finished[1]["fatigue"]
    again = tehl("fatigue", "run.zarr", "--endurance", 200e6, "--figures", "figures", "--dpi", 40, "--json", cwd=tmp_path)
    found = json.loads(again.stdout)
    assert found["findley_stress_max_Pa"] == pytest.approx(first["findley_stress_max_Pa"], rel=1e-9)
    assert found["Fi_max"] == pytest.approx(2 * first["Fi_max"], rel=1e-9)
    assert {path.name for path in (tmp_path / "figures").iterdir()} == {
        "fatigue.png", "fatigue_depth.png", "fatigue_depth_whole.png", "fatigue_point.png", "fatigue_point_whole.png"}
    part = json.loads(tehl("fatigue", "run.zarr", "--to-x", "-1.2", "--depths", "30e-6", "--json", cwd=tmp_path).stdout)
    assert part["by_depth"][0]["findley_stress_max_Pa"] < first["findley_stress_max_Pa"]
    limits = tehl("fatigue", "run.zarr", "--depths", "none", "--bending-limit", 500e6, "--torsion-limit", 320e6, cwd=tmp_path)
    assert limits.returncode == 0 and "0.2917, 333.3 MPa" in limits.stdout  # 0.28/0.96
    one = tehl("fatigue", "run.zarr", "--depths", "none", "--torsion-limit", 400e6, "--kappa", 0.3, cwd=tmp_path).stdout
    assert "0.3, 417.6 MPa" in one and "from the limit in reversed torsion" in one and "400 MPa" in one
    for words, what in ((("--criterion", "finley"), "findley"),
                        (("--torsion-limit", "4e8", "--endurance", "4e8"), "contradict"),
                        (("--from-x", "9"), "0 stored moments"), (("--depths", "a"), "50e-6"), (("--kappa", "-1"), "kappa")):
        bad = tehl("fatigue", "run.zarr", *words, cwd=tmp_path)
        assert bad.returncode == 2 and what in bad.stderr and len(bad.stderr.splitlines()) == 1, bad.stderr


@pytest.mark.parametrize("closed", [(1,), (2,), (0, 1, 2)])
def test_closed_streams_are_nowhere(tmp_path, closed):
    """As `>&-` and some services close them: a file of the store would get the number, and what is printed with it."""
    def close():
        for number in closed:
            os.close(number)

    words = "run", "smooth-line", "--isothermal", "--grid", "64", "--threads", "2", "--out", "a.zarr"
    done = subprocess.run([*CALL, *words], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=close)
    assert done.returncode == 0 and tehl_taichi.open(tmp_path / "a.zarr").finished
    refused = subprocess.run([*CALL, "show", "none.zarr"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                             preexec_fn=close)
    assert refused.returncode == 2 and not refused.stdout and bool(refused.stderr) == (2 not in closed)
