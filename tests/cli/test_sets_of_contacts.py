"""Flanks, bearings, cams and studies on the screen: exit codes, columns under their heads, errors and times in their units."""

import math
import time
from types import SimpleNamespace

import made_results
import pytest
from commands import here
from fake_cases import position

import tehl_taichi as tehl
from tehl_taichi.runs.sweep import case

CAM = "angle_deg,load_N_per_mm,R_mm,u_a_m_s,u_b_m_s\n0,100,20,3,1\n10,0,20,3,1\n20,100,20,3,1\n"
QUICK = ("--workers", 1, "--no-figure", "--quiet")


def failing(monkeypatch, end=None):
    """Runs without a solver; that of the scene with this ending does not converge."""
    steady = {"h_c_m": 4e-7, "h_min_m": 3e-7, "p_max_Pa": 1e9, "friction_coefficient": 0.05}

    def work(job, *_):
        if end and job.scene.name.endswith(end):
            return {**position(job), "status": "not converged", "reason": "made up", "summary": None}
        return {**position(job), "summary": {"steady": steady, "version": "0.9", "wall_s": 2.0}}

    monkeypatch.setattr(case, "run_case", work)


@pytest.mark.parametrize("end, code, said", [(None, 0, ""), ("-03", 3, "1 of 3 angles has no result")])
def test_an_angle_without_a_film_is_no_failure_of_a_cam(tmp_path, monkeypatch, end, code, said):
    failing(monkeypatch, end)
    (tmp_path / "cam.csv").write_text(CAM)
    found = here("cam", "cam.csv", *QUICK, "--out", "c", cwd=tmp_path)
    assert found.returncode == code and said in found.stderr and "no result: 10 deg: no load" in found.stdout


@pytest.mark.parametrize("end, code, said", [(None, 0, ""), ("-outer", 3, "1 of 2 contacts has no result")])
def test_a_ring_that_does_not_converge_is_a_failure(tmp_path, monkeypatch, end, code, said):
    failing(monkeypatch, end)
    found = here("bearing", "6206", *QUICK, "--out", "b", cwd=tmp_path)
    assert found.returncode == code and said in found.stderr


def test_rings_stand_under_their_heads(tmp_path):
    """Under an inner ring that turns, the inner contact is the smaller and more pressed one."""
    found = here("bearing", "6206", "--no-run", "--no-figure", "--out", "b", cwd=tmp_path).stdout.splitlines()
    record = tehl.open(tmp_path / "b").rings
    head = next(line for line in found if "inner ring" in line and "outer ring" in line)
    row = next(line for line in found if "Hertz pressure, GPa" in line)
    for ring, one in record.items():
        at = head.index(f"{ring} ring")
        assert row[at:].split()[0] == f"{one['p_Hertz_Pa'] / 1e9:.3f}"


def test_a_position_without_a_result_is_named_in_millimetres(tmp_path):
    found = here("show", made_results.flank(tmp_path / "f"))
    at, _ = tehl.open(tmp_path / "f").failed[0]
    assert at.x_pl > 5e-3 and f"no result: E, x_pl = {at.x_pl * 1e3:.3f} mm: step 7 failed" in found.stdout


def test_errors_of_traction_and_studies_are_in_the_unit_of_their_number():
    """Two digits of an error of 2.3 %."""
    from tehl_cli import sweep_display, traction_command

    assert traction_command._shown({"h_c_m": 1.008e-6, "error": {"h_c_m": 0.023e-6}}, "h_c_m", 1e6) == "1.008 ± 0.023"
    study = SimpleNamespace(plan=SimpleNamespace(keys=("srr",)))
    name, head, factor = next(one for one in sweep_display.SHOWN if one[0] == "steady_h_c_m")
    row = {"case": 3, "srr": 0.1, "status": "converged", name: 1.008e-6, sweep_display.error_of(name): 0.023e-6}
    assert sweep_display._cells(study, row, [(name, head, factor)]) == ["3", "0.1", "ok", "1.008 ± 0.023"]


@pytest.mark.parametrize("ended, left", [(4, "20 s left"), (3, "25 s left")])
def test_a_sweep_at_an_even_pace_knows_when_it_ends(monkeypatch, ended, left):
    """A case every 5 s after the first one, which started the workers."""
    from tehl_cli.sweep_display import SweepLive

    now = [0.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    live, study = SweepLive(quiet=True), SimpleNamespace(counts={}, open_cases=range(8))
    study = type("Study", (SimpleNamespace,), {"__len__": lambda self: 8})(**vars(study))
    for n in range(ended):
        now[0], study.open_cases = 60.0 + 5 * n, range(8 - n - 1)
        live(study, {"status": "converged", "case": n})
    assert live._headline().endswith(left)


def test_a_plan_names_film_and_bodies_of_its_scene(tmp_path):
    from tehl_taichi.scene.film_formula import central_film

    words = ("smooth-line", "--set", "bodies.a.E=310e9", "--set", "bodies.b.nu=0.25")
    found = here("run", *words, "--dry-run", cwd=tmp_path).stdout
    scene = tehl.scene("smooth-line").replace(**{"bodies.a.E": 310e9, "bodies.b.nu": 0.25})
    assert f"bodies: a E = 310 GPa, nu = 0.3; b E = {scene.body_b.E / 1e9:g} GPa, nu = 0.25" in found
    film, unit = found.partition("h_c by formula: ")[2].split()[:2]
    assert unit == "um" and float(film) * 1e-6 == pytest.approx(central_film(scene), rel=1e-3)


@pytest.mark.parametrize("text, share", [("1%", 0.01), ("0.01", 0.01), ("50%", 0.5)])
def test_a_target_error_is_a_share_or_a_percentage(text, share):
    from tehl_cli.run_commands import _share

    assert math.isclose(_share(text), share)


def test_parts_of_the_time_are_shares_in_per_cent(capsys):
    from tehl_cli.timing import print_budget

    print_budget(SimpleNamespace(rows=lambda: [("passage", 7.5, 0.75), ("fatigue", 2.5, 0.25)]))
    shown = capsys.readouterr().out
    assert "75 %" in shown and "25 %" in shown and "7.50" in shown


@pytest.mark.parametrize("words, count", [(("flank", "fzg-c", "--steady", "--at", "C"), "1 contact"),
                                          (("cam", "cam.csv"), "2 contacts"), (("bearing", "6206"), "2 contacts")])
def test_a_command_that_is_interrupted_before_its_first_result_is_resumed_with_its_option(tmp_path, monkeypatch, words, count):
    """Its folder, named in the message, opens and says what has not run; the same command then finishes it."""
    def stopped(job, *_):
        raise KeyboardInterrupt

    (tmp_path / "cam.csv").write_text(CAM)
    command = *words, *QUICK, "--out", "f"
    with monkeypatch.context() as stops:
        stops.setattr(case, "run_case", stopped)
        found = here(*command, cwd=tmp_path)
    assert found.returncode == 4 and f"after 0 of {count}; repeat the command with --out f to resume" in found.stderr
    assert here("show", "f", cwd=tmp_path).returncode == 0 and tehl.open(tmp_path / "f").KIND == words[0]
    failing(monkeypatch)
    assert here(*command, cwd=tmp_path).returncode == 0


def test_a_row_without_a_name_is_called_by_its_place(tmp_path):
    from tehl_taichi.runs.flank.positions import Position

    named, bare = (Position(-1.2345e-3, 1e-2, 1e-2, 5.0, 4.0, 1e5, 1.0, point=point) for point in ("B", ""))
    assert (named.short, named.full) == ("B", "B, x_pl = -1.234 mm")
    assert (bare.short, bare.full) == ("-1.23 mm", "x_pl = -1.234 mm")
