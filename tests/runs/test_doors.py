"""What cannot be computed after a passage is refused before it."""

import math

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.crack import symmetry_plane
from tehl_taichi.errors import SceneError
from tehl_taichi.fatigue.stress import histories
from tehl_taichi.scene.timeline import moments, step_length, total_steps

GEAR = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False})


@pytest.mark.parametrize("changes", [{"fatigue.from_x": 10.0}, {"fatigue.to_x": -10.0},
                                     {"fatigue.from_x": 5, "fatigue.to_x": 6},
                                     {"fatigue.from_x": 0.1, "fatigue.to_x": 0.11}, {"time.x_end": -1.0, "fatigue.from_x": 0.0},
                                     {"time.steps": 4, "fatigue.from_x": 0.0}])
def test_a_window_that_no_step_reaches(changes):
    with pytest.raises(SceneError, match=r"fatigue.from_x = .* leaves [01] stored moments of .* from -\d"):
        GEAR.replace(**changes)
    GEAR.replace(**changes, **{"fatigue.on": False})
    GEAR.replace(**{**changes, "time.steps": 0, "fatigue.on": True})  # the steady start alone


@pytest.mark.parametrize("every", [1, 3, 7])
@pytest.mark.parametrize("window", [(-math.inf, math.inf), (-0.3, 0.4), (0.0, math.inf), (-math.inf, -1.2), (0.9, 1.0)])
def test_moments_are_counted_as_a_store_has_them(every, window):
    whole = GEAR.replace(**{"output.every": every, "fatigue.on": False})
    scene = whole.replace(**{"fatigue.from_x": window[0], "fatigue.to_x": window[1]})
    steps = sorted({*range(0, total_steps(scene) + 1, every), total_steps(scene)})
    places = scene.path[0] + np.array(steps) * step_length(scene)
    count, start, end = moments(scene)
    assert count == ((places >= window[0] - 1e-9) & (places <= window[1] + 1e-9)).sum()
    assert (start, end) == pytest.approx((places[0], places[-1]))


def test_a_stored_run_is_asked_about_such_a_window_before_it_is_searched(tmp_path, monkeypatch):
    run = tehl.run(GEAR.replace(**{"time.steps": 3}), tmp_path / "a.zarr")
    monkeypatch.setattr(histories.StressHistories, "__init__", lambda *_: pytest.fail("stresses were asked for"))
    with pytest.raises(SceneError, match="leaves 0 stored moments"):
        run.fatigue(from_x=10.0)


@pytest.mark.parametrize("changes, said", [({"start": 0.01, "side": "exit"}, "start = 0.01 m is outside"),
                                           ({"first": 9e-4, "length": 1e-3}, "first = 0.0009 m leads out"),
                                           ({"start": 5e-5, "first": 9e-4, "length": 1e-3}, "from start = 5e-05 m leads out")])
def test_a_crack_outside_the_stresses_is_refused_before_they_are_computed(tmp_path, monkeypatch, changes, said):
    shots = tehl.simulate(GEAR.replace(**{"time.steps": 3}))
    monkeypatch.setattr(symmetry_plane, "histories_of", lambda *_: pytest.fail("stresses were asked for"))
    with pytest.raises(SceneError, match=said):
        tehl.crack(shots, GEAR.replace(**{"time.steps": 3}), **changes)
