"""The registry of fatigue criteria: each entry holds, and kernels find what a scan of its planes finds."""

import numpy as np
import pytest
from values.test_registry import hold

from tehl_taichi.fatigue import findley
from tehl_taichi.laws.criteria import CRITERIA, sensitivities
from tehl_taichi.scene import SceneError, scene, scene_file

S, KAPPA = 100.0, 0.4
TURN = 2 * np.pi * np.arange(90) / 90


def history(component):
    """One point under S cos(t) in this component of (xx, yy, zz, xy, xz, yz)."""
    out = np.zeros((1, TURN.size, 6))
    out[0, :, component] = S * np.cos(TURN)
    return out


@pytest.mark.parametrize("name", CRITERIA)
def test_every_criterion_holds(name):
    hold(CRITERIA[name])


@pytest.mark.parametrize("name", CRITERIA)
def test_kernels_find_what_a_scan_of_planes_finds(taichi_cpu, name):
    rule = CRITERIA[name]
    for component, exact in ((0, rule.in_bending), (3, rule.in_torsion)):
        f, _ = findley.search(history(component), KAPPA, criterion=name)
        assert f[0] == pytest.approx(exact(S, KAPPA), rel=1e-6)  # of the plane of the largest shear: its angle, 1e-7


def test_dang_van_adds_shear_and_mean_stress_of_one_moment(taichi_cpu):
    """Shear S sin t on a mean stress p cos t: sqrt(S^2 + (kappa p)^2) at the worst moment; on Matake's plane S + kappa p."""
    p, both = 150.0, history(3)
    both[0, :, 3] = S * np.sin(TURN)
    both[0, :, :3] = p * np.cos(TURN)[:, None]
    found = {name: findley.search(both, KAPPA, criterion=name)[0][0] for name in ("dang-van", "matake")}
    assert found["dang-van"] == pytest.approx(np.hypot(S, KAPPA * p), rel=1e-3)  # the moments are 4 degrees apart
    assert found["matake"] == pytest.approx(S + KAPPA * p, rel=1e-3)


@pytest.mark.parametrize("name", CRITERIA)
def test_fatigue_limits_give_constants_that_give_the_limits(name):
    bending, torsion = 500e6, 320e6
    kappa, limit = CRITERIA[name].from_limits(bending, torsion)
    assert 0 < kappa < 1
    assert CRITERIA[name].in_bending(bending, kappa) == pytest.approx(limit, rel=1e-8)
    assert CRITERIA[name].in_torsion(torsion, kappa) == pytest.approx(limit, rel=1e-8)
    with pytest.raises(SceneError, match=f"{name} needs a ratio.*between 0.5 and 1, not 0.4"):
        CRITERIA[name].from_limits(500e6, 200e6)


def test_the_template_says_what_kappa_is_the_sensitivity_to():
    lines = {line.split(" = ")[0]: line for line in scene_file.dumps(scene("gear")).splitlines()}
    assert sensitivities() in lines["kappa"] and ", ".join(CRITERIA) in lines["criterion"]


TIES = {  # in which two planes, or a whole ring of them, have the same shear amplitude: by hand
    "torsion of a pulled bar": ({3: np.cos(TURN), 0: 0 * TURN + 0.4}, lambda kappa: 1 + kappa * 0.4),
    "torsion, pulled along x, pressed along z": ({3: np.cos(TURN), 0: 0 * TURN + 0.4, 2: 0 * TURN - 0.7},
                                                 lambda kappa: 1 + kappa * 0.4),
    "bending and half of it in torsion, a quarter late": ({0: np.cos(TURN), 3: 0.5 * np.sin(TURN)}, lambda kappa: 0.5 + kappa),
    "bending of a bar pulled across": ({0: np.cos(TURN), 1: 0 * TURN + 0.6}, lambda kappa: 0.5 + kappa * (0.5 + 0.3))}


def of(components):
    """(times, 6) Pa of components in S."""
    out = np.zeros((TURN.size, 6))
    for n, values in components.items():
        out[:, n] = S * values
    return out


@pytest.mark.parametrize("case", TIES)
def test_of_planes_with_the_same_shear_the_one_with_the_larger_normal_stress_counts(taichi_cpu, case):
    components, exact = TIES[case]
    f, n = findley.search(of(components)[None], KAPPA, criterion="matake")
    assert f[0] == pytest.approx(S * exact(KAPPA), rel=2e-4 if "late" in case else 1e-6)  # the moments are 4 degrees apart
    every, _ = findley.search(of(components)[None], KAPPA, criterion="matake", prune=False)
    assert f[0] == pytest.approx(every[0], rel=1e-6)


def turned(history, seed, count):
    """The history (times, 6) in so many axes drawn at random, (count, times, 6)."""
    rng, pairs = np.random.default_rng(seed), ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    tensor = np.zeros((len(history), 3, 3))
    for n, (i, j) in enumerate(pairs):
        tensor[:, i, j] = tensor[:, j, i] = history[:, n]
    axes = [np.linalg.qr(rng.normal(size=(3, 3)))[0] for _ in range(count)]
    return np.stack([np.stack([(R @ tensor @ R.T)[:, i, j] for i, j in pairs], axis=1) for R in axes])


def drawn(seed):
    """A proportional history of random components on a random mean, and one of two frequencies."""
    rng = np.random.default_rng(seed)
    a, b, mean = rng.normal(size=(3, 6))
    return {f"proportional {seed}": np.outer(np.cos(TURN), a) + mean,
            f"two frequencies {seed}": np.outer(np.cos(TURN), a) + np.outer(np.sin(2 * TURN), b) + mean}


HISTORIES = {name: of(case[0]) / S for name, case in TIES.items()} | drawn(1) | drawn(2)


@pytest.mark.parametrize("name", [name for name in CRITERIA if not CRITERIA[name].chord])
def test_turned_axes_change_nothing(taichi_cpu, name):
    for seed, (case, one) in enumerate(HISTORIES.items()):
        f, _ = findley.search(S * turned(one, seed, 12), KAPPA, criterion=name)
        assert np.ptp(f) < 1e-6 * f.max(), case
