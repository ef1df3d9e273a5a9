"""A whole flank: its scenes, their runs and stores, tables, files and figure."""

import csv
import json
import math
from types import SimpleNamespace

import pytest
from fake_cases import position
from tehl_cli.main import app
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.errors import StoreError, interrupt
from tehl_taichi.runs import passages_left
from tehl_taichi.runs.flank import flank_columns, flank_figure, outcomes
from tehl_taichi.runs.flank.flank_source import flank_source
from tehl_taichi.runs.flank.line_contacts import scene_at
from tehl_taichi.runs.sweep import case
from tehl_taichi.scene import SceneError, hertz
from tehl_taichi.scene.gear_pair import gear_pair
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.digits import with_error
from tehl_taichi.view.figures.figure_style import FigureStyle

SMALL = {"grid.nx": 64, "grid.ny": 16}
NAMES = {"x_pl_m", "rho_a_m", "rho_b_m", "R_m", "u_a_m_s", "u_b_m_s", "srr", "load_N_m", "p_Hertz_Pa", "summary"}
TABLE = """x_pl_mm, load_N_per_mm, R_a_mm, R_b_mm, u_a_m_s, u_b_m_s, point, note
-3.0, 500, 11.0, 24.0, 2.5, 3.6, , low
2.0, 560.5, 16.0, 19.0, 3.6, 2.9, D-, high
"""


def test_the_store_of_a_run_does_not_become_a_flank(tmp_path):
    """`tehl show`, `resume` and `run --force` would take it for a flank."""
    (tmp_path / "zarr.json").write_text("{}")
    with pytest.raises(tehl.StoreError, match="exists and is the folder of a run; choose another path"):
        tehl.Flank.check_writable(tmp_path)


@pytest.fixture(scope="module")
def steady(taichi_cpu, tmp_path_factory):
    """The steady films of A and C, with temperatures."""
    folder = tmp_path_factory.mktemp("flank") / "pinion"
    return tehl.flank("fzg-c", at=("A", "C"), steady=True, changes=SMALL, folder=folder, workers=1)


def test_every_position_has_the_contact_of_the_geometry(steady):
    record = steady.to_dict()
    assert [one["point"] for one in record["positions"]] == ["A", "C"]
    assert all(NAMES <= one.keys() for one in record["positions"])
    for one in record["positions"]:
        scene = tehl.open(one["store"]).scene
        assert one["converged"] and one["summary"]["hertz"]["p_Pa"] == pytest.approx(one["p_Hertz_Pa"])
        assert scene.contact.radius_x == pytest.approx(one["R_m"]) and scene.operation.u_a == pytest.approx(one["u_a_m_s"])
        assert scene.operation.u_b == pytest.approx(one["u_b_m_s"]) and scene.load == one["load_N_m"]
        assert one["p_Hertz_Pa"] == pytest.approx(math.sqrt(one["load_N_m"] * 206e9 / 0.91 / (2 * math.pi * one["R_m"])))
    assert record["geometry"]["eps_alpha"] == pytest.approx(1.438, abs=5e-4) and "constant load" in record["assumption"]
    assert record["load_sharing"].startswith("trapezoid") and record["geometry"]["points_x_pl_m"]["C"] == 0


def test_the_pitch_point_rolls_cool_and_the_root_slides_hot(steady):
    root, pitch = (one["summary"]["steady"] for one in steady.to_dict()["positions"])
    assert pitch["friction_coefficient"] < 1e-6 < 0.02 < root["friction_coefficient"]
    assert 90 <= pitch["film_max_C"] < 95 < 120 < root["film_max_C"]
    assert root["h_c_m"] < pitch["h_c_m"]
    assert pitch["h_c_m"] == pytest.approx(pitch["film_formula_m"], rel=0.2)


def test_a_finished_flank_is_read_not_run(steady, monkeypatch):
    monkeypatch.setattr(case, "run_case", lambda *_, **__: pytest.fail("it ran again"))
    again = tehl.flank("fzg-c", at=("A", "C"), steady=True, changes=SMALL, folder=steady.folder)
    assert again.to_dict() == steady.to_dict()


def test_a_folder_of_something_else_is_kept(tmp_path, monkeypatch):
    monkeypatch.setattr(case, "run_case", lambda job, progress: position(job))
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(StoreError, match="is not the folder of a flank"):
        tehl.flank("fzg-c", at=("C",), steady=True, folder=tmp_path, workers=1)
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]


def test_a_folder_of_another_flank_is_refused_before_anything_runs(steady):
    keys = dict(at=("A", "C"), steady=True, folder=steady.folder)
    for others, said in ((dict(torque=200.0), "holds flank fzg-c with the result of a contact .*x_pl = -9.502 mm, .* N/m"),
                         (dict(at=("C",)), "holds flank fzg-c with the result of a contact"),
                         (dict(gear="fzg-a"), "holds flank fzg-c; choose another path"),
                         (dict(changes={**SMALL, "temperature": 70.0}), "holds another scene .*; choose another folder")):
        with pytest.raises(tehl.Error, match=said):
            tehl.flank(**{"gear": "fzg-c", "changes": SMALL, **keys, **others})


@pytest.mark.rendered
def test_files_and_figure_tell_the_same(steady):
    record = json.loads((steady.folder / "flank.json").read_text())
    assert record["positions"][0]["summary"]["steady"] == steady.rows[0][2]["steady"]
    with (steady.folder / "flank.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [float(row["x_pl_m"]) for row in rows] == [at.x_pl for at in steady.positions]
    assert float(rows[0]["steady_h_c_m"]) == steady.rows[0][2]["steady"]["h_c_m"] and "Fi_max" not in rows[0]
    assert float(rows[0]["error_steady_h_c_m"]) == steady.rows[0][2]["steady"]["error"]["h_c_m"] > 0
    assert steady.plot().stat().st_size > 20_000


def test_table_and_figure_carry_the_errors(steady):
    pytest.importorskip("matplotlib")
    (column,) = [c for c in flank_columns.COLUMNS if c.name == "steady_h_c_m"]
    film = steady.rows[0][2]["steady"]
    assert column.shown(*steady.rows[0]) == with_error(film["h_c_m"] * 1e6, film["error"]["h_c_m"] * 1e6)
    bars = flank_figure.drawn(FigureStyle(), steady).axes[0].containers[0].lines[2][0].get_segments()
    assert bars[0][1, 1] - bars[0][0, 1] == pytest.approx(2e6 * film["error"]["h_c_m"])


@pytest.mark.slow
def test_a_feature_passes_at_every_position(taichi_cpu, tmp_path):
    whole = tehl.flank("fzg-c", at=("B+",), on="gear", folder=tmp_path / "gear", changes={**SMALL, "thermal.on": False})
    (_, _, summary), = whole.rows
    assert summary["transient"]["h_min_m"] < summary["steady"]["h_min_m"] and summary["fatigue"]["Fi_max"] > 0
    assert whole.positions[0].srr > 0 < whole.positions[0].x_pl
    (column,) = [c for c in flank_columns.COLUMNS if c.name == "Fi_max"]
    assert column.shown(*whole.rows[0]) == f"{summary['fatigue']['Fi_max']:.3f} ± ?"


class Heard(tehl.Progress):
    def __init__(self):
        self.lines = []

    def say(self, text):
        self.lines.append(text)


def test_positions_run_side_by_side_and_those_without_a_result_are_listed(tmp_path, monkeypatch):
    """In two processes, without a solver."""
    heard = Heard()
    monkeypatch.setattr(case, "run_case", position)
    found = tehl.flank("fzg-c", positions=7, steady=True, folder=tmp_path / "f", workers=2, progress=heard)
    assert [at.point for at in found.positions] == ["A", "B-", "B+", "C", "D-", "D+", "E"]
    assert [summary and summary["steady"]["h_c_m"] for *_, summary in found.rows] == \
        [None, *(pytest.approx(at.R) for at in found.positions[1:6]), None]
    assert [(at.point, reason) for at, reason in found.failed] == [("A", "made up"), ("E", "MemoryError: no room")]
    assert heard.lines[0] == "7 positions on 2 workers" and heard.lines[7].startswith("7 of 7: fzg-c-")
    assert any(line.endswith("of 7: fzg-c-01-A: made up") for line in heard.lines)
    assert tehl.open(found.folder).record == found.record


def test_passages_side_by_side_are_announced_and_show_their_steps(tmp_path, monkeypatch):
    heard = Heard()
    monkeypatch.setattr(case, "run_case", position)
    monkeypatch.setattr(passages_left, "EVERY", 0.0)
    monkeypatch.setattr(passages_left, "_last_step", lambda path: 5 if "-02-" in path.name else 0)
    tehl.flank("fzg-c", positions=7, changes=SMALL, folder=tmp_path / "f", workers=2, progress=heard)
    assert heard.lines[0] == "7 positions on 2 workers" and heard.lines[1].startswith("7 passages of ")
    assert any(line.startswith("fzg-c-02-B- step 5 of ") for line in heard.lines)


@pytest.mark.parametrize("name, by", [("", "interrupted"), ("SIGTERM", "stopped by SIGTERM")])
def test_an_interrupted_flank_says_how_far_it_is(tmp_path, monkeypatch, name, by):
    def until_c(job, progress):
        if job.scene.name.endswith("-C"):
            raise interrupt(SimpleNamespace(signal=name), " after 2 steps")
        return position(job)

    monkeypatch.setattr(case, "run_case", until_c)
    with pytest.raises(KeyboardInterrupt, match=f"{by} after 3 of 7 contacts; repeat the call with folder='.*/f' to resume"):
        tehl.flank("fzg-c", positions=7, steady=True, folder=tmp_path / "f", workers=1)
    waiting = [(at.point, reason) for at, reason in tehl.open(tmp_path / "f").failed]
    assert [point for point, _ in waiting] == ["A", "C", "D-", "D+", "E"] and "has not run yet" in waiting[1][1]


@pytest.mark.slow
def test_two_workers_of_one_thread_compute_the_same_bits_as_this_process_on_two(taichi_cpu, tmp_path):
    small = dict(at=("A", "B+"), changes={**SMALL, "thermal.on": False, "time.steps": 3})
    one, two = (tehl.flank("fzg-c", folder=tmp_path / str(n), workers=n, threads=3 - n, **small) for n in (1, 2))
    for (*_, here), (*_, there) in zip(one.rows, two.rows):
        assert [here[part] for part in ("steady", "transient", "fatigue")] == [there[part] for part in
                                                                              ("steady", "transient", "fatigue")]


@pytest.mark.slow
def test_dedendum_and_addendum_of_type_c_at_stage_10(taichi_cpu, tmp_path):
    """The whole flank with temperatures and the asperity: every position converges, films stay films."""
    whole = tehl.flank("fzg-c", torque=265.1, positions=7, folder=tmp_path / "c", changes=SMALL)
    assert not whole.failed and [at.point for at in whole.positions] == ["A", "B-", "B+", "C", "D-", "D+", "E"]
    for one in whole.record["positions"]:
        scene, summary = tehl.open(one["store"]).scene, one["summary"]
        assert summary["transient"]["h_min_m"] > 0.9 * scene.rheology.film_floor * Scales.of(scene).h
        assert 0.3 < summary["fatigue"]["Fi_max"] < 1.5
    assert whole.plot().exists()


def test_features_fit_into_the_domain_of_the_smallest_contact():
    base = tehl.scene("gear")
    for name in ("fzg-c", "fzg-a"):
        for n, at in enumerate(flank_source(name).positions(count=9)):
            scene = scene_at(base, {}, name, n, at)
            s, feature = Scales.of(scene), base.features[0]
            for end in (scene.grid.x_min, scene.grid.x_max):
                assert hertz.line_gap(abs(end)) * s.h > 1.1 * feature.height
            assert scene.grid.y_max * s.b >= 1.9 * feature.reach_y


@pytest.mark.parametrize("y", [2e-4, -2e-4])
def test_the_domain_reaches_beyond_a_feature_beside_the_middle(y):
    base = tehl.scene("gear").replace(**{"feature.y": y})
    feature, = base.features
    for n, at in enumerate(flank_source("fzg-c").positions(count=7)):
        scene = scene_at(base, {}, "fzg-c", n, at)
        assert scene.grid.y_max * Scales.of(scene).b >= 1.9 * (abs(feature.y) + feature.reach_y)


def test_the_gap_beside_a_dry_line_contact():
    assert hertz.line_gap(1.0) == 0.0
    step = 1e-6  # its slope is sqrt(X^2 - 1), the tangent that Hertz leaves (Johnson 4.2)
    for X in (1.2, 2.0, 5.0):
        assert (hertz.line_gap(X + step) - hertz.line_gap(X - step)) / (2 * step) == pytest.approx(math.sqrt(X * X - 1))


def test_a_position_that_does_not_converge_leaves_the_others(taichi_cpu, tmp_path):
    """One Newton step is enough nowhere: listed with its reason, exit code 3, nothing else lost."""
    folder = tmp_path / "short"
    done = CliRunner().invoke(app, ["flank", "fzg-c", "--at", "C", "--steady", "--isothermal", "--set", "numerics.newton_max=1",
                                    "--grid", "64x16", "--out", str(folder), "--quiet", "--no-figure"])
    assert done.exception.exit_code == 3 and "1 of 1 position has no result" in str(done.exception)
    record, = json.loads((folder / "flank.json").read_text())["positions"]
    assert not record["converged"] and record["summary"] is None and "did not converge" in record["reason"]


def test_the_command_prints_tables_and_the_assumption(steady):
    words = ["flank", "fzg-c", "--at", "A", "--at", "C", "--steady", "--grid", "64x16", "--out",
             str(steady.folder), "--quiet", "--no-figure"]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 0 and "steady film" in done.stdout
    assert "while the feature passes" not in done.stdout.split("assumed")[0]  # a table that has nothing is left out
    assert "assumed: each position is a separate contact" in done.stdout and "load: trapezoid" in done.stdout
    assert json.loads(CliRunner().invoke(app, [*words, "--json"]).stdout)["geometry"]["on"] == "pinion"


def test_a_table_of_positions(tmp_path):
    (tmp_path / "ltca.csv").write_text(TABLE)
    found = flank_source(tmp_path / "ltca.csv")
    low, high = found.positions()
    assert (low.x_pl, low.load, low.rho_a, low.rho_b, low.u_a, low.u_b) == (-3e-3, 500e3, 11e-3, 24e-3, 2.5, 3.6)
    assert low.srr == pytest.approx(-1.1 / 3.05) and low.R == pytest.approx(11e-3 * 24 / 35) and low.more == {"note": "low"}
    assert high.point == "D-" and high.arc is None
    with pytest.raises(SceneError, match="on = 'gear' has no effect: the rows of a table"):
        found.positions(on="gear")
    with pytest.raises(SceneError, match="torque and speed apply to gear pairs"):
        found.changed(torque=100.0)


@pytest.mark.parametrize("old, new, why", [
    ("load_N_per_mm", "load_N_mm", r"has no column load_N_per_mm \(did you mean 'load_N_mm'\?\); needed: x_pl_mm,"),
    ("560.5", "much", "row 3: load_N_per_mm = 'much' is not a number; allowed: 0.001 to 100000 N/mm"),
    ("560.5", "-5", "row 3: load_N_per_mm = -5 N/mm is out of range"),
    ("16.0", "nan", "row 3: R_a_mm = nan is not a number"),
    ("3.6, 2.9", "0, 0", "row 3: u_a_m_s and u_b_m_s are both 0 m/s"),
    (TABLE[TABLE.index("-3.0"):], "", "has 0 rows; allowed: 1 to 1000"),
])
def test_tables_that_say_nothing_are_refused(tmp_path, old, new, why):
    (tmp_path / "bad.csv").write_text(TABLE.replace(old, new))
    with pytest.raises(SceneError, match=why):
        flank_source(tmp_path / "bad.csv")


def test_a_flank_file_names_gears_and_scene(tmp_path):
    (tmp_path / "my.toml").write_text('base = "gear"\n[operation]\ntemperature = 60.0\n')
    (tmp_path / "pair.toml").write_text('name = "mine"\nbase = "fzg-a"\nscene = "my.toml"\n[gear]\ntorque = 100.0\nb = 30e-3\n')
    found = flank_source(tmp_path / "pair.toml")
    assert found.name == "mine" and found.scene.operation.temperature == 60.0
    assert (found.pair.torque, found.pair.b, found.pair.d_a1) == (100.0, 30e-3, gear_pair("fzg-a").d_a1)
    (tmp_path / "ltca.csv").write_text(TABLE)
    (tmp_path / "table.toml").write_text('table = "ltca.csv"\n')
    assert len(flank_source(tmp_path / "table.toml").positions()) == 2


@pytest.mark.parametrize("text, why", [
    ("[gears]\nz1 = 3", "unknown key 'gears' in .*did you mean 'gear'"),
    ("[gear]\nz3 = 3", "unknown key gear.z3.*did you mean"),
    ("name = 'empty'", "needs either a gear pair"),
    ("base = 'fzg-c'\ntable = 'a.csv'", "needs either a gear pair .* or a table"),
    ("base = 'fzg-d'", "unknown gear pair 'fzg-d'"),
    ("base = 3", "base = 3 must be text"),
    ("gear = 3", r"\[gear\] must be a table"),
    ("[gear", "is not valid TOML"),
])
def test_flank_files_that_say_nothing_are_refused(tmp_path, text, why):
    (tmp_path / "bad.toml").write_text(text)
    with pytest.raises(SceneError, match=why):
        flank_source(tmp_path / "bad.toml")


def test_a_scene_that_no_position_can_have_is_refused_with_the_place(tmp_path):
    with pytest.raises(SceneError, match=r"position A \(x_pl = -9.502 mm\): feature.width = 2e-06 m is"):
        tehl.flank("fzg-c", changes={**SMALL, "feature.width": 2e-6}, folder=tmp_path / "no")
    assert not (tmp_path / "no").exists()


@pytest.mark.parametrize("key", ["load", "contact.hertz_pressure", "srr", "speed", "operation.u_a"])
def test_what_the_gears_say_cannot_be_changed(key):
    with pytest.raises(SceneError, match="position A .* has no effect: the gears or the table set"):
        tehl.flank("fzg-c", changes={key: 1.0})


def test_every_idle_key_is_reported_once():
    """With the first position that has it; other numbers of a kind are no other kind."""
    said = []
    listener = tehl.Progress()
    listener.warn = said.append
    keys, once = {"fatigue.weibull": 24.0, "time.courant": 0.3, "bodies.a.k": 30.0}, outcomes._KindsOnce(listener)
    for name, changes in (("1", keys), ("2", keys), ("3", {**keys, "thermal.nodes": 17})):
        for sentence in tehl.scene("smooth-line").replace(**changes, **{"thermal.on": False}).warnings():
            once.warn_at(name, sentence)
    assert [text.partition(" has no effect")[0] for text in said if "has no effect" in text] == [
        "1: bodies.a.k", "1: fatigue.weibull", "1: time.courant", "3: thermal.nodes"]


def test_wrong_numbers_of_threads_are_refused_by_the_name_of_their_option():
    for words, said in ((dict(threads=0), "threads = 0 is out of range"), (dict(workers=0), "workers = 0 is out of range")):
        with pytest.raises(SceneError, match=f"^{said}"):
            next(outcomes.summaries([], "none", **words))


@pytest.mark.parametrize("name", ["srr", "rho_a_m", "film_ratios", "p_Hertz_Pa", "load_N_m", "reason", "steady_h_c_m"])
def test_further_columns_with_names_of_results_are_refused(tmp_path, name):
    (tmp_path / "ltca.csv").write_text(TABLE.replace("note", name))
    (tmp_path / "mine.toml").write_text('table = "ltca.csv"\n')
    for file in ("ltca.csv", "mine.toml"):
        with pytest.raises(SceneError, match=f"ltca.csv: {name} is a name of the results; rename or remove"):
            flank_source(tmp_path / file)
