"""The registry of fatigue criteria: each entry holds, and kernels find what a scan of its planes finds."""

import numpy as np
import pytest
from test_registry import hold

from tehl_taichi.criteria import CRITERIA, sensitivities
from tehl_taichi.fatigue import findley
from tehl_taichi.scene import SceneError

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
    from tehl_taichi.io import scene_file
    from tehl_taichi.scene import scene

    lines = {line.split(" = ")[0]: line for line in scene_file.dumps(scene("gear")).splitlines()}
    assert sensitivities() in lines["kappa"] and ", ".join(CRITERIA) in lines["criterion"]
