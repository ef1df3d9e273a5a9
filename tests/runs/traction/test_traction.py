"""Traction curves: their cases, rows and figure, and a curve that is computed."""

import json
import math
import re

import numpy as np
import pytest
import typer.main
from commands import here
from tehl_cli import traction_command
from tehl_cli.main import app

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.runs.traction import traction_figure
from tehl_taichi.runs.traction.traction_run import default_path, traction, traction_plan
from tehl_taichi.values.coded_warning import lists
from tehl_taichi.view.figures.figure_style import FigureStyle

KEYS = {"srr", "temperature_C", "friction_coefficient", "h_c_m", "film_max_C", "error"}


def made(job, progress=None):
    """A made-up result: friction from slip and temperature; no result at SRR 0.4."""
    o = job.scene.operation
    if o.srr == 0.4:
        return {"status": "not converged", "reason": "made up", "summary": None, "seconds": 0.1}
    steady = {"friction_coefficient": 0.05 * math.tanh(20 * o.srr) * 60 / o.temperature, "h_c_m": 3e-7 / o.temperature * o.u_m,
              "h_min_m": 2e-7, "film_max_C": o.temperature + 50 * o.srr, "error": {"h_c_m": 2e-8, "friction_coefficient": None}}
    warnings = {"warnings": [f"{o.srr} is doubtful"], "warning_codes": ["doubt"]}
    return {"status": "converged", "reason": "", "seconds": 0.1, "summary": {"steady": steady, **warnings}}


@pytest.fixture(scope="module")
def curves(tmp_path_factory):
    path = tmp_path_factory.mktemp("traction") / "t.zarr"
    return traction("gear", [0.0, 0.1, 0.2, 0.4], [60.0, 90.0], path=path, workers=1, work=made)


def test_the_object_has_the_rows_of_the_interface(curves):
    found = json.loads(json.dumps(curves.to_dict()))
    assert all(KEYS <= row.keys() for row in found["rows"])
    assert [row["srr"] for row in found["rows"]] == [0, 0.1, 0.2, 0.4] * 2
    assert [row["temperature_C"] for row in found["rows"]] == [60] * 4 + [90] * 4
    assert found["rows"][1]["friction_coefficient"] == pytest.approx(0.05 * math.tanh(2))
    assert found["rows"][1]["error"] == {"friction_coefficient": None, "h_c_m": 2e-8, "h_min_m": None, "film_max_C": None}
    assert found["rows"][1]["u_m_m_s"] == 8.5 and found["scene"] == "gear"


def test_cases_without_a_result_are_listed(curves):
    assert [(row["srr"], row["reason"], row["friction_coefficient"]) for row in curves.failed] == [(0.4, "made up", None)] * 2
    assert curves.warnings == ["0.0 is doubtful (6 of 8 cases, numbers of the first)"]


def test_each_idle_key_of_the_cases_is_a_warning(tmp_path):
    def work(job, progress=None):
        lists_of = lists([one for one in job.scene.warnings() if one.code == "idle"])
        return {"status": "converged", "reason": "", "seconds": 0.1, "summary": {"steady": {}, **lists_of}}

    changes = {"fatigue.length": 5e-6, "time.courant": 0.3}
    found = traction("gear", [0.1, 0.2], path=tmp_path / "t.zarr", changes=changes, workers=1,
                     work=work)
    assert [said.partition(" has no effect here: ")[0] for said in found.warnings] == ["fatigue.length", "time.courant"]


def test_features_are_left_out_and_temperatures_computed_in_all_cases():
    plan = traction_plan(tehl.scene("gear"), "0:0.2:3", changes={"oil.name": "mineral-vg100"})
    scenes = [plan.case(n) for n in range(plan.count)]
    assert all(not scene.features and not scene.isothermal and scene.oil.name == "mineral-vg100" for scene in scenes)
    assert [scene.operation.srr for scene in scenes] == [0.0, 0.1, 0.2]
    assert not traction_plan(tehl.scene("gear"), [0.1], changes={"thermal.on": False}).case(0).thermal.on
    assert default_path(plan).name.startswith("gear-traction-")


def test_keys_without_effect_are_said_but_not_those_of_the_passage_that_a_file_describes(tmp_path, capsys):
    (tmp_path / "a.toml").write_text('base = "gear"\n[time]\nsteps = 5\n[fatigue]\nexponent = 9.0\n[rheology]\ntau_0 = 9e6\n')
    idle = {"time.courant": 0.5, "thermal.on": False, "thermal.nodes": 9}
    found = traction(tmp_path / "a.toml", [0.1], changes=idle, path=tmp_path / "t.zarr", workers=1, work=made)
    assert [said.split()[0] for said in found.warnings] == ["rheology.tau_0", "thermal.nodes", "time.courant", "0.1"]
    traction_command._print(found)
    assert "0.1 is doubtful" in (printed := capsys.readouterr().out) and "no effect" not in printed
    said = here("traction", "smooth-line", "--no-figure", "--set", "fatigue.length=5e-6", "--set", "rheology.tau_0=9e6",
                "--workers", 0).stderr  # refused before the runs
    assert "warning: fatigue.length has no effect" in said and "warning: rheology.tau_0 has no effect" in said


def test_the_curves_are_over_slip_or_over_speed(tmp_path, curves):
    assert curves.across == "srr" and {name: len(rows) for name, rows in curves.curves.items()} == {"60 °C": 4, "90 °C": 4}
    stribeck = traction("gear", [0.1], speed="0.1:10:3:log", path=tmp_path / "s.zarr", workers=1, work=made)
    assert stribeck.across == "speed" and list(stribeck.curves) == ["SRR 0.1"]
    assert [row["u_m_m_s"] for row in stribeck.rows] == pytest.approx([0.1, 1.0, 10.0])
    both = traction("gear", [0.1, 0.2], speed=[1.0, 2.0], path=tmp_path / "b.zarr", workers=1, work=made)
    assert both.across == "srr" and list(both.curves) == ["1 m/s", "2 m/s"]


def test_the_title_has_the_oil_and_what_all_cases_have_in_common(tmp_path, curves):
    assert traction_figure.title(curves) == "gear: traction, reference-pao, mean speed 8.5 m/s"
    speeds = traction("gear", [0.1], speed=[1.0, 2.0], changes={"oil.name": "mineral-vg100"}, path=tmp_path / "s.zarr",
                      workers=1, work=made)
    assert traction_figure.title(speeds) == "gear: traction, mineral-vg100, slide-roll ratio SRR 0.1, inlet temperature 90 °C"


@pytest.mark.parametrize("option", ["srr", "temperature", "speed", "load", "hertz_pressure"])
def test_the_example_in_the_help_of_an_option_is_one_of_its_quantity(option):
    command = typer.main.get_command(app).commands["traction"]
    said, = (parameter.help for parameter in command.params if parameter.name == option)
    example = re.search(r"units allowed: (.*?)(?:;| \(|$)", said)[1]
    assert traction_plan(tehl.scene("mtm"), **{option: example}).count in (3, 9, 11, 33, 99)


def test_loads_and_pressures_make_curves_too(tmp_path):
    """Several of them are swept, one is that of all curves and of the study's name."""
    pressures = traction("mtm", "0:50%:3", hertz_pressure="0.75GPa,1GPa", path=tmp_path / "p.zarr", workers=1, work=made)
    assert pressures.across == "srr" and list(pressures.curves) == ["750 MPa", "1 GPa"]
    assert [row["p_Hertz_Pa"] for row in pressures.rows] == [0.75e9] * 3 + [1e9] * 3
    loads = traction("smooth-line", [0.1], load="0.5:1.5kN/mm:3", path=tmp_path / "l.zarr", workers=1, work=made)
    assert loads.across == "load" and [row["load_N_m"] for row in loads.rows] == [5e5, 1e6, 1.5e6]
    one = traction_plan(tehl.scene("mtm"), [0.1], load="30N")
    assert one.keys == ("srr",) and one.scene.contact.load == 30.0
    assert default_path(one) == default_path(traction_plan(tehl.scene("mtm"), [0.1], changes={"load": 30.0}))


def test_points_with_an_unknown_error_are_hollow(curves):
    """No friction in pure rolling needs no error."""
    pytest.importorskip("matplotlib")
    figure = traction_figure.drawn(FigureStyle(), curves)
    hollow = [[line.get_xdata().tolist() for line in ax.lines if str(line.get_color()) == "white"] for ax in figure.axes]
    assert hollow == [[[0.1, 0.2]] * 2, [[]] * 2, [[0.0, 0.1, 0.2]] * 2]
    curve, *_, hole = figure.axes[0].lines
    assert curve.get_marker() == "o" and hole.get_markersize() < 0.7 * curve.get_markersize()  # a rim is left
    assert [len(legend.get_texts()) for legend in figure.legends] == [2] and not any(ax.get_legend() for ax in figure.axes)
    assert figure.get_suptitle() == f"{traction_figure.title(curves)} (hollow: error unknown)"


def test_the_figure_has_error_bars_and_a_logarithmic_axis_for_decades(tmp_path, curves):
    pytest.importorskip("matplotlib")
    axes = traction_figure.drawn(FigureStyle(), curves).axes
    assert [ax.get_ylabel() for ax in axes] == ["friction coefficient", "central film (µm)", "largest film temperature (°C)"]
    film = axes[1].containers[0]
    assert list(film.lines[0].get_xdata()) == [0.0, 0.1, 0.2]
    first = next(iter(curves.curves.values()))
    assert film.lines[0].get_ydata() * 1e-6 == pytest.approx([row["h_c_m"] for row in first if row["h_c_m"]])
    low, high = film.lines[2][0].get_segments()[0]
    assert high[1] - low[1] == pytest.approx(2 * 0.02) and axes[2].get_xscale() == "linear"
    wide = traction("gear", [0.1], speed="0.1:10:3:log", path=tmp_path / "w.zarr", workers=1, work=made)
    assert traction_figure.drawn(FigureStyle(), wide).axes[-1].get_xscale() == "log"
    near = traction("gear", [0.1], speed="1:9:3:log", path=tmp_path / "n.zarr", workers=1, work=made)
    even = traction("gear", [0.1], speed="1:9:3", path=tmp_path / "e.zarr", workers=1, work=made)
    assert [traction_figure.drawn(FigureStyle(), one).axes[-1].get_xscale() for one in (near, even)] == ["log", "linear"]


@pytest.mark.parametrize("options, said", [
    (dict(srr="0:0.5"), "srr = 0:0.5 has no number of values"), (dict(srr=[3.0]), "operation.srr = 3 is out of range"),
    (dict(temperature="x"), "operation.temperature = 'x' is not a number"),
    (dict(srr=[0.1], changes={"srr": 0.2}), "srr is swept and operation.srr = 0.2 sets it"),
    (dict(srr=[0.1], load="1,2 kN/m", hertz_pressure=1e9), "contradict"),
    (dict(srr=[0.1], load="1 kN/m", hertz_pressure=1e9), "contact.load = .* and contact.hertz_pressure = .* contradict"),
    (dict(srr=[0.1], load="1,2 kN/m", changes={"hertz_pressure": 1e9}), "contradict"),
    (dict(srr=[0.1, 0.1]), "srr = 0.1 is given twice"), (dict(srr=[]), "srr has no values")])
def test_wrong_axes_are_refused_before_anything_is_written(tmp_path, options, said):
    with pytest.raises(SceneError, match=said):
        tehl.traction("gear", **options, path=tmp_path / "t.zarr")
    assert not (tmp_path / "t.zarr").exists()


@pytest.mark.slow
@pytest.mark.rendered
def test_friction_rises_with_slip_and_falls_with_temperature(taichi_cpu, tmp_path):
    """The command on a small line: none in pure rolling, less once heat thins the oil, less in warmer oil."""
    found = here("traction", "smooth-line", "--srr", "0,0.02,0.3", "--temperature", "60,110", "--grid", 64, "--workers", 1,
                 "--json", "--quiet", "--out", "t.zarr", cwd=tmp_path)
    assert found.returncode == 0, found.stderr
    rows = json.loads(found.stdout)["rows"]
    friction = np.array([row["friction_coefficient"] for row in rows]).reshape(2, 3)
    assert np.all(friction[:, 0] < 1e-12) and np.all(friction[:, 1] > friction[:, 2]) and friction[0, 1] > friction[1, 1]
    assert all(row["film_max_C"] > row["temperature_C"] and row["error"]["h_c_m"] > 0 for row in rows)
    assert (tmp_path / "t" / "traction.png").stat().st_size > 10_000
