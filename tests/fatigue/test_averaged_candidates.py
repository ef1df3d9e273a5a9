"""Points that may be the worst of averaged stresses."""

from types import SimpleNamespace

import numpy as np
import pytest
from rolling import Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment, averaged_candidates, findley, material_length
from tehl_taichi.fatigue.sought import Box, Sought
from tehl_taichi.laws.criteria import CRITERIA

pytestmark = pytest.mark.usefixtures("taichi_cpu")
ISOTHERMAL = {"thermal.on": False, "srr": -0.12}


@pytest.mark.parametrize("name", [name for name, criterion in CRITERIA.items() if criterion.convex])
def test_the_value_of_an_average_is_at_most_the_average_of_the_values(name):
    histories = np.random.default_rng(5).normal(size=(40, 3, 30, 6)) * 1e8
    whole = findley.search(histories.mean(axis=1), 0.3, criterion=name)[0]
    each = findley.search(histories.reshape(120, 30, 6), 0.3, criterion=name)[0].reshape(40, 3)
    assert (whole <= each.mean(axis=1) * (1 + 1e-6)).all() and (whole > 0.5 * each.mean(axis=1)).any()


def test_criteria_that_choose_a_plane_by_its_shear_are_not_convex():
    assert {name for name, criterion in CRITERIA.items() if criterion.convex} == {"findley", "findley-chord"}


def searched(monkeypatch, first):
    """([({surface: part "averaged"}, numbers of searched points) with the points that may be the worst, with all])."""
    scene = tehl.scene("gear").replace(**ISOTHERMAL, **{"fatigue.length": 40e-6})
    monkeypatch.setattr(averaged_candidates, "FIRST", first)
    real, out, counts = material_length.StressHistories, [], []

    def counting(*given, **named):
        passage = real(*given, **named)
        counts.append(passage.x.size * passage.y.size)
        return passage

    monkeypatch.setattr(material_length, "StressHistories", counting)
    for convex in (True, False):
        counts = []
        rule = SimpleNamespace(convex=convex)
        monkeypatch.setattr(material_length, "CRITERIA", {"findley": rule})
        found = assessment.run(scene, Rolling(scene, 32, 5), alone=False).summaries
        out.append(({name: one["averaged"] for name, one in found.items()}, counts))
    return out


@pytest.mark.parametrize("first, times", [(averaged_candidates.FIRST, 1), (0.9999, 2)])
def test_the_worst_of_some_points_is_the_worst_of_all(monkeypatch, first, times):
    """Also where the points searched first lack it."""
    (some, few), (whole, many) = searched(monkeypatch, first)
    assert len(few) == (1 + times) * len(many)  # each body: those below the surface, and those at the surface
    assert all(points < 0.8 * whole for points, whole in zip(few[1 :: 1 + times], many)), (few, many)
    for name, one in whole.items():
        for own, other in ((some[name], one), (some[name]["below"], one["below"])):
            assert own.keys() == other.keys()
            assert all(own[key] == pytest.approx(other[key], rel=1e-9, abs=1e-12) for key in own if key != "below")


def test_low_values_of_first_planes_are_raised():
    f = np.zeros((9, 1))
    f[3], f[6] = 400e6, 395e6
    found = SimpleNamespace(feature_frame_x=np.arange(9.0), feature_frame_y=np.zeros(1), findley_stress=f,
                            numbers={"sigma_eF_Pa": 400e6})
    reader = SimpleNamespace(x=np.arange(9.0), along=np.ones(1), across=np.ones(1), mirrored=False)
    box = Box((2.5, 3.5), (-0.5, 0.5))
    boxes = [averaged_candidates.Candidates(found, reader, low).wider(box, 1.0) for low in (False, True)]
    assert boxes == [None, Box((2.5, 6.5), (-0.5, 0.5))]


@pytest.mark.parametrize("sought", Sought)
def test_searches_with_first_planes_have_raised_bounds(monkeypatch, sought):
    """Of windows for error bars, and of coarse-grid runs."""
    scene = tehl.scene("gear").replace(**ISOTHERMAL, **{"fatigue.length": 40e-6})
    lows, real, reader = [], averaged_candidates.Candidates, Rolling(scene, 32, 5)
    monkeypatch.setattr(material_length, "Candidates", lambda *given: lows.append(given[-1]) or real(*given))
    assessment.run(scene, reader, alone=False, sought=sought)
    assert lows == [sought is not Sought.ALL] * 2
