"""Every option to its own argument, every number of a table from its own place: nothing swapped, shifted or left over."""

import inspect
import math
from pathlib import Path
from types import SimpleNamespace

import made_results
import numpy as np
import pytest
from commands import here
from small_stores import SMALL, shot, store

import tehl_taichi as tehl
from tehl_taichi.report import passage_plots, scene_text, study_plots, verdict
from tehl_taichi.runs import pace
from tehl_taichi.runs.progress import Lines
from tehl_taichi.scene import hertz
from tehl_taichi.scene.feature import Feature

# an option: what is typed for it, and what arrives (None: the same as text, a number)
ASKED = {"--kappa": 0.21, "--endurance": 411e6, "--criterion": "matake", "--depths": ("50e-6,1e-4", [50e-6, 1e-4]),
         "--from-x": -0.7, "--to-x": 0.6, "--length": 12e-6, "--residual-xx": -1.1e8, "--residual-yy": -1.2e8,
         "--bending-limit": 5.1e8, "--torsion-limit": 3.2e8, "--threads": 3, "--surfaces": "b",
         "--table": "case-hardened", "--table-b": "none", "--relation": "murakami", "--inclusion": 2e-5, "--exponent": 9.5,
         "--limit-cycles": 3e7, "--weibull": 24.5}


def typed(options):
    """(words, {argument: value}) of {option: value, or (what is typed, value)}."""
    words, wanted = [], {}
    for name, value in options.items():
        text, value = value if isinstance(value, tuple) else (value, value)
        words += [name, str(text)]
        wanted[name.strip("-").replace("-", "_")] = value
    return words, wanted


class Caught(Exception):
    """The call that a command makes."""


def caught(monkeypatch, place, words):
    """(positional arguments, named ones) of the call at `place` that a command makes."""
    calls = []

    def call(*args, **named):
        calls.append((args, named))
        raise tehl.SceneError("caught")

    monkeypatch.setattr(place, call)
    monkeypatch.setattr("tehl_taichi.engine.runtime.check", lambda *args, **named: None)
    found = here(*words)
    assert found.stderr.endswith("tehl: caught\n"), found.stderr
    return calls[0]


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    return store(tmp_path_factory.mktemp("each") / "small.zarr").path


def assert_own(named, wanted):
    assert {key: named[key] for key in wanted} == wanted
    others = {key for key, value in named.items() if value is not None and key not in wanted}
    assert not others & set(inspect.signature(tehl.Run.fatigue).parameters) - {"progress", "until"}


@pytest.mark.parametrize("option", ASKED)
def test_every_option_of_fatigue_and_of_report_arrives_alone(monkeypatch, small, option):
    words, wanted = typed({option: ASKED[option]})
    assert_own(caught(monkeypatch, "tehl_taichi.runs.stored_run.Run.fatigue", ["fatigue", small, *words])[1], wanted)
    assert_own(caught(monkeypatch, "tehl_taichi.report", ["report", small, *words])[1], wanted)


def test_a_search_with_other_constants_ends_with_its_answer(monkeypatch, small):
    found = made_results.result(made_results.fatigue(1.4, 0.9))
    monkeypatch.setattr("tehl_taichi.runs.stored_run.Run.fatigue", lambda *_, **__: found)
    *_, last = here("fatigue", small, "--endurance", "4e8").stdout.splitlines()
    assert last.startswith("Does a fatigue crack start here? Probably yes: the fatigue limit is exceeded at the surface; ")


@pytest.mark.parametrize("left_out", [("--bending-limit", "--torsion-limit"), ("--kappa", "--endurance")])
def test_all_options_of_fatigue_arrive_together(monkeypatch, small, left_out):
    """But those that contradict each other."""
    words, wanted = typed({name: value for name, value in ASKED.items() if name not in left_out})
    named = caught(monkeypatch, "tehl_taichi.runs.stored_run.Run.fatigue", ["fatigue", small, *words])[1]
    assert_own(named, wanted)


def test_every_option_of_flank_arrives(monkeypatch, tmp_path):
    words, wanted = typed({"--torque": 211.0, "--speed": 1500.0, "--on": "gear", "--positions": 5, "--workers": 3,
                           "--threads": 2})
    changed = typed({"--temperature": 71.0, "--height": 0.7e-6, "--width": 1.7e-4})[0]
    words = ["flank", "fzg-a", *words, *changed, "--isothermal", "--steady", "--out", tmp_path / "f"]
    args, named = caught(monkeypatch, "tehl_taichi.flank", words)
    wanted["folder"] = tmp_path / "f"
    assert args == ("fzg-a",) and {key: named[key] for key in wanted} == wanted and named["steady"] is True
    assert named["changes"] == {"operation.temperature": 71.0, "feature.0.height": 0.7e-6, "feature.0.width": 1.7e-4,
                                "thermal.on": False}


def test_every_option_of_animate_and_export_arrives(monkeypatch, small, tmp_path):
    words, wanted = typed({"--format": "mp4", "--frames": 31, "--fps": 7, "--dpi": 90, "--width": 12.0})
    args, named = caught(monkeypatch, "tehl_taichi.animate", ["animate", small, *words, "--map", "pressure", "--out", "a.mp4"])
    assert args == (small, Path("a.mp4")) and named["shown"] == "pressure" and named["force"] is False
    assert {key: named[key] for key in wanted} == wanted
    words = ["export", small, "--at", -0.5, "--at", 0.25, "--point=-3e-5,1e-5", "--out", tmp_path, "--force"]
    args, named = caught(monkeypatch, "tehl_taichi.export", words)
    assert args[1:] == ("csv", tmp_path) and named == {"at": [-0.5, 0.25], "point": [(-3e-5, 1e-5)], "force": True}


def test_every_option_of_crack_arrives(monkeypatch, small):
    words, wanted = typed({"--surface": "b", "--side": "exit", "--start": 1.5e-5, "--angle": 41.0, "--first": 4e-6,
                           "--step": 3e-6, "--length": 33e-6, "--distance": 7e-6, "--threshold": 2.1e6, "--face-friction": 0.12,
                           "--oil": 0.4, "--elements": 17, "--threads": 2})
    named = caught(monkeypatch, "tehl_taichi.runs.stored_run.Run.crack", ["crack", small, *words, "--residual", "-1.3e8"])[1]
    assert {key: named[key] for key in wanted} == wanted and named["residual"] == -1.3e8


def test_every_option_of_run_arrives_in_its_scene(monkeypatch):
    words, _ = typed({"--srr": -0.07, "--temperature": 71.0, "--height": 0.7e-6, "--width": 1.7e-4, "--steps": 5,
                      "--precision": "f64"})
    words = ["run", "gear", "--grid", "64x16", "--isothermal", "--threads", 2, *words]
    scene = caught(monkeypatch, "tehl_taichi.run", words)[0][0]
    feature = scene.features[0]
    assert (scene.operation.srr, scene.operation.temperature, feature.height, feature.width) == (-0.07, 71.0, 0.7e-6, 1.7e-4)
    assert (scene.time.steps, scene.numerics.precision, scene.grid.nx, scene.grid.ny) == (5, "f64", 64, 16) and scene.isothermal


@pytest.mark.parametrize("step, total, done, seconds, said", [
    (2.0, 30, 10, 40, "about 40 s left"), (2.0, 100, 10, 180, "about 3 min left"), (300.0, 30, 10, 6000, "about 1.7 h left"),
    (2.0, 10, 10, 0, ""), (2.0, 30, 3, 0, "")])
def test_the_time_left_is_that_of_the_steps_to_come(monkeypatch, step, total, done, seconds, said):
    clock = [0.0]
    monkeypatch.setattr(pace.time, "perf_counter", lambda: clock[0])
    found = pace.Pace()
    assert found.left(total) == ""
    for n in range(1, done + 1):
        clock[0] += step
        found.at(n)
    assert found.left(total) == said
    found.at(1)  # another passage
    assert found.left(total) == ""


def test_words_for_a_time():
    assert [pace.about(s) for s in (0.2, 49.4, 50, 89 * 60, 90 * 60, 7200)] == [
        "about 1 s", "about 49 s", "about 1 min", "about 89 min", "about 1.5 h", "about 2.0 h"]


def test_a_pressure_beyond_steel_is_said_once():
    import io

    for limit, onset in ((0.0, 4.62e9), (1.5e9, 3.15e9)):
        out = io.StringIO()
        lines = Lines(out)
        lines.begin(tehl.scene("gear").replace(**{"bodies.b.yield_stress": limit}))
        for p in (0.99 * onset, 1.01 * onset, 1.2 * onset):
            lines.beyond_steel(SimpleNamespace(step=4, scalars={"p_max_Pa": p}))
            assert len(out.getvalue().splitlines()) == (p > onset)


@pytest.mark.parametrize("total", [4, 100, 119])
def test_frames_are_told_by_quarters(monkeypatch, total):
    from tehl_cli import animate_command

    told = []
    monkeypatch.setattr(animate_command, "say", told.append)
    monkeypatch.setattr("sys.stderr.isatty", lambda: False, raising=False)
    bar = animate_command.FrameBar(False)
    for done in range(total + 1):
        bar.show(done, total)
    assert told == [f"frame {math.ceil(part * total / 4)} of {total}" for part in (1, 2, 3, 4)]
    animate_command.FrameBar(True).show(total, total)
    assert len(told) == 4


def test_room_for_a_run_is_fifty_megabytes(tmp_path, monkeypatch):
    from tehl_taichi.store import store_draft

    for free, enough in ((49e6, False), (51e6, True)):
        monkeypatch.setattr("shutil.disk_usage", lambda folder, free=free: SimpleNamespace(free=free))
        if enough:
            store_draft.check_room(tmp_path)
        else:
            with pytest.raises(tehl.Error, match="only 49 MB left; a run needs at least 50 MB"):
                store_draft.check_room(tmp_path)


def test_ends_that_a_domain_may_have_come_one_after_the_other():
    """The nearest that is far enough is taken, in this order: no step back, none much wider than the last."""
    from tehl_taichi.scene import domain

    for ends in (domain.INLETS, domain.SIDES):
        steps = np.array(ends[1:]) / np.array(ends[:-1])
        assert (steps > 1).all() and (steps < 1.9).all()
    film = np.geomspace(1e-3, 3.0, 40)
    found = [domain._first(domain.SIDES, lambda Y, f=f: hertz.point_gap(Y) / f, domain.GAPS) for f in film]
    assert found == sorted(found) and len(set(found)) >= 8
    for end, f in zip(found, film):
        nearer = [one for one in domain.SIDES if one < end]
        assert all(1 + hertz.point_gap(one) / f < domain.GAPS for one in nearer)


def test_a_flank_has_room_for_its_features(monkeypatch):
    """The gap where the domain ends is a given number of times as high as the feature, in metres; the side as far."""
    from tehl_taichi.runs.flank import line_contacts
    from tehl_taichi.runs.flank.flank_source import flank_source

    position = flank_source("fzg-c").positions(None, None, ["C"])[0]
    plain = tehl.scene("gear").replace(height=8e-6, width=4e-4)
    room = line_contacts.room(plain, position.load, position.R)
    a, _ = hertz.line(position.load, position.R, line_contacts.reduced_modulus(plain))
    gap = hertz.line_gap(room["grid.x_max"]) * a**2 / position.R
    assert gap == pytest.approx(line_contacts.SPARE * 8e-6, rel=1e-3) and room["grid.x_max"] > 1.5
    aside = plain.replace(**{"feature.y": 3e-4})
    assert line_contacts.room(aside, position.load, position.R)["grid.y_max"] == pytest.approx(
        line_contacts.AROUND * (3e-4 + plain.features[0].reach_y) / a)


def case(job, progress=None):
    o, f = job.scene.operation, job.scene.features[0]
    return {"status": "converged", "reason": "", "seconds": 1.0, "summary": {"steady": {"h_c_m": 1e-7 * (2 + o.srr)},
            "fatigue": {"Fi_max": f.height * 1e6}}}


@pytest.mark.parametrize("count, lines", [(3, 3), (12, 12), (30, 12)])
def test_lines_of_a_study_begin_with_the_first_row_and_end_with_the_last(tmp_path, count, lines):
    pytest.importorskip("plotly")
    from tehl_taichi.runs.sweep import sweeping
    from tehl_taichi.runs.sweep.plan import plan

    over = {"srr": list(np.linspace(-0.1, 0.1, count + 1)), "feature.height": list(np.linspace(0.5e-6, 1.5e-6, count))}
    study = sweeping.run(plan(SMALL, over), tmp_path / "s.zarr", workers=1, work=case)
    figure = study_plots._lines(study, "fatigue_Fi_max")
    shown = [trace for trace in figure.traces if "y" in trace]
    assert len(shown) == lines
    for one, height in zip((shown[0], shown[-1]), (0.5, 1.5)):
        assert list(one["y"]) == pytest.approx([height] * (count + 1))


def test_a_case_forgets_the_numbers_of_its_first_try(tmp_path):
    from tehl_taichi.runs.sweep.plan import plan
    from tehl_taichi.runs.sweep.study_table import Study

    with Study.write(tmp_path / "s.zarr", plan(SMALL, {"srr": [0.0, 0.1]})) as study:
        for summary in ({"steady": {"h_c_m": 1e-7, "p_max_Pa": 1e9}}, {"steady": {"h_c_m": 2e-7}}):
            study.add({"case": 1, "status": "converged", "reason": "", "store": None, "seconds": 1.0, "summary": summary,
                       "changes": {}})
    for found in (study, Study.open(tmp_path / "s.zarr")):
        assert found.values["steady_h_c_m"][1] == 2e-7 and np.isnan(found.values["steady_h_c_m"][0])
        assert np.isnan(found.values.get("steady_p_max_Pa", np.full(2, np.nan))).all()


def test_a_run_goes_on_from_the_last_checkpoint_that_counts(tmp_path):
    """A later one belongs to entries that nobody sees."""
    from tehl_taichi.store import checkpoint

    for number in (2, 3, 5, 11):
        checkpoint.write(tmp_path, number, {"step": number - 1, "P": np.full((3, 4), number), "H0": 0.0})
    for steps, last in ((2, 2), (3, 3), (4, 3), (10, 5), (11, 11)):
        number, state = checkpoint.load_last(tmp_path / "s", tmp_path, steps, (3, 4))
        assert number == last == state["P"][0, 0] and state["step"] == last - 1
    with pytest.raises(tehl.StoreError, match="damaged or of another grid"):
        checkpoint.load_last(tmp_path / "s", tmp_path, 11, (4, 3))
    checkpoint.remove_others(tmp_path, 5)
    assert checkpoint.load_last(tmp_path / "s", tmp_path, 20, (3, 4))[0] == 5


def search(Fi, below, error=None, early=None):
    found = {"Fi_max": Fi, "surface_angle_deg": 57.0, "error": {"Fi_max": error},
             "below": {"Fi_max": below, "depth_m": 25e-6, "surface_angle_deg": 40.0, "error": {"Fi_max": error}}}
    return {**found, **({"resolved": {**search(*early, error), "to_x_a": 0.5}} if early else {})}


@pytest.mark.parametrize("found, tone, begins", [
    (search(0.7, 0.8, 0.05), "no", "No: the index stays below 1."),
    (search(0.7, 0.8), "no", "Probably not: the index stays below 1;"),
    (search(0.7, 1.3, 0.05), "yes", "Yes: the fatigue limit is exceeded 25 µm below the surface."),
    (search(1.3, 0.7), "yes", "Probably yes: the fatigue limit is exceeded at the surface;"),
    (search(1.2, 1.3, 0.05), "yes", "Yes: the fatigue limit is exceeded at the surface and 25 µm below the surface."),
    (search(0.99, 0.7, 0.05), "open", "Not decided: the index is 1 within its error at the surface."),
    (search(0.8, 0.9, 0.05, (0.6, 0.7)), "no", "Probably not: the index stays below 1, but over the whole passage its error"),
    (search(1.4, 0.9, 0.05, (0.6, 0.7)), "open", "Not decided: the index stays below 1 while the grid resolves"),
    (search(1.4, 0.9, 0.05, (1.2, 0.7)), "yes", "Yes: the fatigue limit is exceeded at the surface, even without"),
    (search(1.4, 0.9, 0.05, (1.01, 0.7)), "open", "Not decided: the index is 1 within its error at the surface, without"),
])
def test_the_verdict_of_a_passage(found, tone, begins):
    _, headline, said, *_ = verdict.of_fatigue(found)
    assert said == tone and headline.startswith(begins), headline


def test_every_feature_has_its_own_numbers_in_the_words_of_its_scene():
    features = [{"height": 1.5e-6, "width": 200e-6}, {"height": -0.7e-6, "width": 111e-6, "x": 43e-6, "y": -87e-6}]
    finer = SMALL.replace(**{"grid.nx": 128, "grid.ny": 32}).to_dict()
    first, second = scene_text._features(tehl.Scene.from_dict({**finer, "feature": features}))
    for text in ("height −0.7 µm", "width 111 µm", "x 43 µm", "y −87 µm"):
        assert text.replace("−", "-") in second.replace("−", "-") and text.replace("−", "-") not in first.replace("−", "-")
    assert "1.5 µm" in first and "200 µm" in first and "y" not in first.rpartition(":")[2].replace("µm", "")


@pytest.mark.parametrize("changes, said", [({"thermal.on": False}, False), ({"thermal.on": True}, True),
                                           ({"thermal.on": True, "time.steady_only": True}, False)])
def test_surfaces_are_told_apart_where_their_temperatures_are_drawn(changes, said):
    assert bool(passage_plots._carries(SimpleNamespace(scene=SMALL.replace(**changes)))) == said


def test_sizes_of_waves_are_those_that_a_grid_must_carry():
    waves = Feature(shape="waviness", height=1e-7, width=60e-6, length=90e-6, extent_x=600e-6, extent_y=500e-6)
    assert waves.kind.sizes(waves) == ({"width": 60e-6, "extent_x": 600e-6}, {"extent_y": 500e-6, "length": 90e-6})
    transverse = Feature(shape="waviness", height=1e-7, width=60e-6, extent_x=600e-6, extent_y=500e-6)
    assert transverse.kind.sizes(transverse)[1] == {"extent_y": 500e-6}


def test_entries_of_a_store_come_back_as_they_were(tmp_path):
    """Each with its own field, number and place, at unequal steps."""
    from tehl_taichi.store.store import Store

    steps = (0, 1, 4, 9)
    with Store.create(tmp_path / "a.zarr", SMALL, shot(0), 50, {"runtime": "{}", "steady_error": "{}"}) as made:
        for step in steps[1:]:
            made.append(shot(step), shot(step).state)
    found = Store.open(tmp_path / "a.zarr")
    assert len(found) == 4 and found.scalar("step").tolist() == list(steps) and found.last_step == 9
    for n, step in enumerate(steps):
        assert all((values == step + 1.5).all() for name, values in found.fields(n).items() if name != "contact")
        assert found.feature_x(n) == 1e-5 * step and found.time[n] == 1e-6 * step


def commands(app, before=()):
    """((words), click command) of every command."""
    import typer

    group = typer.main.get_command(app)

    def each(command, words):
        for name, one in getattr(command, "commands", {}).items():
            yield from each(one, (*words, name))
        if not hasattr(command, "commands"):
            yield words, command

    return list(each(group, before))


def test_a_switch_that_is_not_given_is_off():
    """All switches with one name (--force, --json, --quick, --confirm ...): what a command does is what is typed."""
    from tehl_cli.main import app

    switches = [(words, option.name, option.default) for words, command in commands(app) for option in command.params
                if getattr(option, "is_flag", False) and not option.secondary_opts]
    assert len(switches) > 40
    assert [one for one in switches if one[2]] == []


def test_a_resumed_run_prints_its_summary_as_one_object(monkeypatch, small):
    import json

    from tehl_taichi.runs import open_results

    summary = {"scene": "gear", "steps": 3}
    run = SimpleNamespace(rest=lambda steps: SMALL, store=[], summary=summary)
    monkeypatch.setattr(open_results, "open_run", lambda path: run)
    monkeypatch.setattr(tehl, "resume", lambda *path, **options: run)
    assert json.loads(here("resume", small, "--json").stdout) == summary


@pytest.mark.parametrize("formula", [True, False])
def test_the_row_of_the_film_formula_stands_where_there_is_one(formula):
    from tehl_taichi.runs.summary.summary_rows import rows_of

    steady = {"h_c_m": 1e-7, "h_min_m": 9e-8, "p_max_Pa": 1e9, "friction_coefficient": 0.05}
    steady |= {"film_formula_m": 1.2e-7, "film_formula": "Moes, line"} if formula else {}
    rows = rows_of({"steady": steady, "hertz": {"a_m": 1e-4, "p_Pa": 1e9}, "wall_s": 1.0, "compile_s": 0.1})
    found = [row.text_pair for row in rows if "formula" in row.what]
    assert found == ([("h_c by formula (Moes, line)", "0.1200 um")] if formula else [])


SEEKING = "finished without the window that it needs; continue with: tehl resume 'my run.zarr'"


@pytest.mark.parametrize("cut, seeks, said", [
    (None, False, "finished"), (0.42, False, "finished, cut at 0.42 a; extend with: tehl resume 'my run.zarr'"),
    (None, True, SEEKING), (0.42, True, SEEKING)])
def test_the_state_of_a_finished_run_says_what_it_lacks(cut, seeks, said):
    """Where it was cut, or the window that --zoom auto was looking for."""
    from tehl_cli.show_commands import _state

    run = SimpleNamespace(writer=None, finished=True, cut=cut, path="my run.zarr", steps=7, seeks_window=seeks)
    assert _state(run) == said


@pytest.mark.parametrize("good, right", [(True, True), (False, True), (True, False)])
def test_the_doctor_is_content_only_with_all_values(monkeypatch, capsys, good, right):
    import typer
    from tehl_cli.show_commands import doctor

    from tehl_taichi.runs import self_test

    for name, found in (("self_test", (4.3e-7, good, 1.0)), ("plugins_checked", [("f.py", "mine", "1", "2", right)]),
                        ("installation", {"what": "value"})):
        monkeypatch.setattr(self_test, name, lambda found=found: found)
    with pytest.raises(typer.Exit) as end:
        doctor()
    out, err = capsys.readouterr()
    assert end.value.exit_code == (not (good and right)) and "smooth-line 0.4300 um" in " ".join(err.split())
    assert ("WRONG" in out, "WRONG" in err) == (not right, not good)


def test_profiles_lie_on_the_nodes_across_the_film(tmp_path):
    description = SMALL.replace(**{"thermal.on": True, "thermal.nodes": 7, "output.profiles": True})
    first = shot(0, description)
    first.fields["temperature"] = np.full((*first.fields["pressure"].shape, 7), 90.0)
    import zarr

    from tehl_taichi.store.store import Store

    with Store.create(tmp_path / "z.zarr", description, first, 5, {"runtime": "{}", "steady_error": "{}"}):
        pass
    zeta = np.asarray(zarr.open(tmp_path / "z.zarr", mode="r")["zeta"])
    assert zeta.size == 7 and zeta[0] == 0 and zeta[-1] == 1 and (np.diff(zeta) > 0).all()
