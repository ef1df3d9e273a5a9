"""A scene that a Python call is given is used, or refused: never ignored."""

import dataclasses

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError

SCENE = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 3})


def bending(amplitude=200e6):
    stresses = np.zeros((1, 3, 6))
    stresses[0, :2, 0] = amplitude, -amplitude
    return stresses


@pytest.mark.parametrize("changes", [{"kappa": 0.9}, {"endurance": 300e6}, {"fatigue.criterion": "matake"},
                                     {"torsion_limit": 3e8, "bending_limit": 4e8}])
def test_stresses_take_the_constants_of_a_scene(changes):
    by_scene = tehl.fatigue(bending(), SCENE.replace(**changes))
    by_hand = tehl.fatigue(bending(), **{key.removeprefix("fatigue."): value for key, value in changes.items()})
    usual = tehl.fatigue(bending())
    assert by_scene.f == pytest.approx(by_hand.f, rel=1e-12) and by_scene.limit == by_hand.limit
    assert by_scene.Fi[0] != pytest.approx(usual.Fi[0], rel=1e-3)


def test_constants_beside_the_scene_come_before_its_own():
    found = tehl.fatigue(bending(), SCENE.replace(kappa=0.9, endurance=300e6), kappa=0.2)
    assert found.limit == 300e6 and found.f == pytest.approx(tehl.fatigue(bending(), kappa=0.2).f)


@pytest.mark.parametrize("changes, key", [({"fatigue.residual_xx": -2e8}, "residual_xx"), ({"fatigue.to_x": 0.5}, "to_x"),
                                          ({"fatigue.depths": [5e-5]}, "depths")])
def test_what_has_no_meaning_for_stresses_is_refused_in_a_scene_too(changes, key):
    with pytest.raises(SceneError, match=f"{key} has no effect on given stresses"):
        tehl.fatigue(bending(), SCENE.replace(**changes))


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return tehl.run(SCENE, tmp_path_factory.mktemp("given") / "a.zarr")


@pytest.fixture(scope="module")
def shots():
    return tehl.simulate(SCENE)


def test_a_run_takes_a_scene_of_another_fatigue_alone(run):
    by_scene, by_hand = tehl.fatigue(run, SCENE.replace(kappa=0.9)), tehl.fatigue(run, kappa=0.9)
    assert by_scene.summary["kappa_F"] == 0.9 == by_hand.summary["kappa_F"]
    assert by_scene.summary["findley_stress_max_Pa"] == by_hand.summary["findley_stress_max_Pa"]
    for call in (tehl.fatigue, tehl.crack):
        for changes, key in (({"load": 1e6}, "contact.load is another"), ({"srr": 0.1}, "operation.srr is another"),
                             ({"bodies.a.nu": 0.2}, "bodies.a.nu is another"),
                             ({"feature.height": 1e-6}, "feature.0.height is")):
            with pytest.raises(SceneError, match=f"differs from that of the run: {key}"):
                call(run, SCENE.replace(**changes))
        with pytest.raises(SceneError, match="differs from that of the run: thermal.on, grid.nx"):
            call(run, "gear")  # a name is the built-in scene
        with pytest.raises(SceneError, match="5 is not a scene"):
            call(run, 5)


def test_snapshots_and_states_of_another_grid_are_refused(shots):
    other = SCENE.replace(**{"grid.nx": 128})
    for call in (tehl.fatigue, tehl.crack):
        with pytest.raises(SceneError, match="65 x 17 nodes, the given scene 129 x 17"):
            call(shots, other)
    with pytest.raises(SceneError, match=r"shape \(17, 65\) for P, the scene needs \(17, 129\)"):
        tehl.march(other, shots[-1].state)


@pytest.mark.parametrize("changes, key", [({"srr": 0.2}, "operation.srr = -0.12 there, 0.2 here"), ({"speed": 3.0}, "u_m"),
                                          ({"load": 9e5}, "contact.load"), ({"height": 1e-6}, "feature.0.height"),
                                          ({"oil.name": "mineral-vg220"}, "oil.nu_40"), ({"bodies.a.E": 1.9e11}, "bodies.a.E"),
                                          ({"grid.x_min": -4.0}, "grid.x_min"), ({"time.courant": 2.0}, "time.courant")])
def test_states_of_another_scene_on_these_nodes_are_refused(shots, changes, key):
    with pytest.raises(SceneError, match=f"the state belongs to another scene: .*{key}"):
        tehl.march(SCENE.replace(**changes), shots[-1].state)


@pytest.mark.parametrize("changes", [{}, {"kappa": 0.2}, {"output.every": 2}, {"numerics.precision": "f64"},
                                     {"bodies.a.k": 30.0}])
def test_a_march_continues_where_the_state_does_not_depend_on_a_change(shots, changes, tmp_path):
    scene, path = SCENE.replace(**{"time.steps": 4, **changes}), tmp_path / "state.npz"
    np.savez(path, **shots[-1].state)
    for state in (shots[-1].state, dict(np.load(path))):
        assert [shot.step for shot in tehl.march(scene, state)] == [4]


def test_a_ramp_continues_without_the_scene_of_its_state(shots):
    state = {key: value for key, value in shots[-1].state.items() if key != "scene"}
    assert [shot.step for shot in tehl.march(SCENE.replace(srr=-0.13, **{"time.steps": 4}), state)] == [4]


def test_snapshots_take_the_fatigue_of_the_scene(shots):
    of_a = SCENE.replace(**{"fatigue.surfaces": "a"})
    scenes = [dataclasses.replace(SCENE, fatigue=of_a.replace(kappa=kappa).fatigue) for kappa in (0.2, 0.9)]
    found = [tehl.fatigue(shots, scene) for scene in scenes]
    assert found[0].summary["findley_stress_max_Pa"] < found[1].summary["findley_stress_max_Pa"]
