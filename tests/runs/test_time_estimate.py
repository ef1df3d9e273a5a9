"""What is told of the time of a passage: before it, by a look at its steady start, and while it runs."""

import io
import re
from types import SimpleNamespace

import numpy as np
import pytest
from map_feature import feature

import tehl_taichi as tehl
from tehl_taichi.errors import NotConverged
from tehl_taichi.runs import pace, time_estimate
from tehl_taichi.runs.pace import Pace, about
from tehl_taichi.runs.progress import PASSAGE, Lines
from tehl_taichi.scene.timeline import total_steps

SMALL = {"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "fatigue.on": False}


@pytest.mark.parametrize("seconds, words", [(0.2, "about 1 s"), (12.4, "about 12 s"), (55, "about 1 min"),
                                            (18 * 60, "about 18 min"), (7200, "about 2.0 h")])
def test_times_are_told_as_well_as_one_knows_them(seconds, words):
    assert about(seconds) == words


@pytest.fixture
def clock(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(pace.time, "perf_counter", lambda: now[0])
    return now


def test_the_time_left_follows_the_last_steps(clock):
    """A second a step, then ten: with twenty of these nothing of the former counts any more."""
    told, total = Pace(), 100
    for done in range(41):
        told.at(done)
        if done in (2, 20, 40):
            assert told.left(total) == {2: "", 20: "about 1 min left", 40: "about 10 min left"}[done]
        clock[0] += 1.0 if done < 20 else 10.0
    told.at(10)
    assert told.left(total) == ""  # another passage


def snapshot(step, p=2e9):
    return SimpleNamespace(step=step, scalars={"p_max_Pa": p, "h_min_m": 4e-7, "residual": 1e-9, "cycles": 7})


def test_lines_tell_the_time_left_and_once_that_steel_yields(clock):
    stream = io.StringIO()
    lines = Lines(stream)
    lines.begin(tehl.scene("gear"))
    lines.stage(PASSAGE, 0, 100)
    for step in range(1, 11):
        clock[0] += 6.0
        lines.stage(PASSAGE, step, 100)
        lines.step(snapshot(step, 2e9 if step < 5 else 4.7e9))
    said = stream.getvalue().splitlines()
    assert re.fullmatch(r"step 1/100  p_max 2.000 GPa .* cycles 7", said[0])
    assert said[2].endswith("  about 10 min left") and said[-1].endswith("  about 9 min left")
    beyond, = (line for line in said if "yield" in line)
    assert beyond.startswith("step 5: p_max 4.70 GPa; bodies like these yield under asperities above about 4.6 GPa")
    assert "Ctrl-C" in beyond


def test_a_bar_tells_it_too():
    from tehl_cli.live_display import Live

    said, shows = [], Live()
    shows.bar, shows.say, shows._when_due = SimpleNamespace(), said.append, lambda draw, last: None
    shows.begin(tehl.scene("gear"))
    for step in (1, 2, 3):
        shows.step(snapshot(step, 4.5e9 + 0.1e9 * step))
    assert len(said) == 1 and said[0].startswith("step 2: p_max 4.70 GPa")


def looked(folder, scene):
    return tehl.run(scene.replace(**{"time.steps": 0}), folder / "look.zarr", force=True)


def test_a_look_tells_steps_and_minutes_of_the_whole_passage(taichi_cpu, tmp_path, monkeypatch):
    """The pace is that of real steps; the store keeps none of them."""
    scene = tehl.scene("gear").replace(**SMALL)
    run, total = looked(tmp_path, scene), total_steps(scene)
    seconds = time_estimate._pace(run.path, scene)
    assert 1e-3 < seconds < 2.0
    monkeypatch.setattr(time_estimate, "_pace", lambda path, scene: 2.5)
    said, = time_estimate.lines(run, (64, 16))
    assert f"{total} steps, {about(2.5 * total)} at the speed of the first steps (2.5 s each)" in said
    assert said.endswith(f"up to 3 times as long: {'up to ' + about(7.5 * total)}; stresses and error bars follow")
    assert tehl.open(run.path).store.last_step == 0 and tehl.open(run.path).finished


@pytest.mark.slow
def test_what_is_long_is_told_something_faster(taichi_cpu, tmp_path, monkeypatch):
    """A scan of 1.2 mm: half of the cells, or its middle; what is named is taken as it stands, and is as much faster."""
    np.save(tmp_path / "scan.npy", 0.05 * np.cos(np.arange(241) / 10) * np.ones((201, 1)))
    wide = {**SMALL, "grid.nx": 128, "grid.ny": 64, "grid.y_max": 1.6}
    rough = tehl.scene("gear").replace(feature=[{"shape": "map", "file": str(tmp_path / "scan.npy"), "unit": "um",
                                                 "pixel": 5e-6, "taper": 40e-6}], **wide)
    assert rough.features == (feature(tmp_path / "scan.npy", pixel=5e-6, taper=40e-6),)
    run = looked(tmp_path, rough)
    monkeypatch.setattr(time_estimate, "_pace", lambda path, scene: 1.0)
    first, faster = time_estimate.lines(run, (64, 32))
    most = 20 * total_steps(rough)
    assert f"up to {about(most)};" in first
    grid, middle = faster.removeprefix("faster: ").split("; ")
    assert grid == f"--grid 64x32 up to {about(most * time_estimate._share(rough, {'grid.nx': 64, 'grid.ny': 32}))}"
    assert 0.24 < time_estimate._share(rough, {"grid.nx": 64, "grid.ny": 32}) / 0.5 < 0.27
    changes = {key: float(value) if "." in value else int(value)
               for key, value in (pair.split("=") for pair in re.findall(r"--set (\S+?),?(?= |$)", middle))}
    part = rough.replace(**changes)
    assert part.features[0].patch == pytest.approx((720e-6, 720e-6)) and part.grid.y_max == 1.2
    assert middle.endswith(about(most * time_estimate._work(part) / time_estimate._work(rough)))
    monkeypatch.setattr(time_estimate, "_pace", lambda path, scene: 0.01)
    assert len(time_estimate.lines(run, (64, 32))) == 1


def test_steady_scenes_and_steps_that_fail_have_no_time(taichi_cpu, tmp_path, monkeypatch):
    run = looked(tmp_path, tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False}))
    assert time_estimate.lines(run, (64, 16)) == []

    def fails(scene, state):
        raise NotConverged("step 1")
        yield

    monkeypatch.setattr(time_estimate, "march", fails)
    assert time_estimate.lines(looked(tmp_path, tehl.scene("gear").replace(**SMALL)), (64, 16)) == []


def test_the_command_tells_it_after_the_look_alone(taichi_cpu, tmp_path, monkeypatch):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    words = ["run", "gear", "--grid", "64x16", "--isothermal", "--no-fatigue", "--threads", "2",
             "--force", "--out", str(tmp_path / "a.zarr"), "--steps"]
    told = {steps: CliRunner().invoke(app, [*words, *steps]).output for steps in (("0",), ("1",), ("0", "--quiet"))}
    assert ["the whole passage: 48 steps" in output for output in told.values()] == [True, False, False], told
