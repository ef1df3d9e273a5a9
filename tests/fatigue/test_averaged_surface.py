"""Averages of the stress histories of the surface."""

from types import SimpleNamespace

import numpy as np
import pytest
from rolling import Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import averaged_surface, findley
from tehl_taichi.fatigue.layer import layer
from tehl_taichi.fatigue.sought import Sought
from tehl_taichi.fatigue.stress.averaging import AveragedReader
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.laws.criteria import CRITERIA

pytestmark = pytest.mark.usefixtures("taichi_cpu")
ISOTHERMAL = {"thermal.on": False, "srr": -0.12}
LENGTH = 60e-6  # of averages, m


@pytest.mark.parametrize("name", [name for name, criterion in CRITERIA.items() if criterion.convex])
def test_the_value_of_an_average_is_at_most_the_average_of_the_values(name):
    histories = np.random.default_rng(5).normal(size=(40, 3, 30, 6)) * 1e8
    whole = findley.search(histories.mean(axis=1), 0.3, criterion=name)[0]
    each = findley.search(histories.reshape(120, 30, 6), 0.3, criterion=name)[0].reshape(40, 3)
    assert (whole <= each.mean(axis=1) * (1 + 1e-6)).all() and (whole > 0.5 * each.mean(axis=1)).any()


def test_criteria_that_choose_a_plane_by_its_shear_are_not_convex():
    assert {name for name, criterion in CRITERIA.items() if criterion.convex} == {"findley", "findley-chord"}


def surface(scene, length=LENGTH, sought=Sought.ALL):
    """(passage, AveragedSurface) of body a."""
    reader = Rolling(scene, 16, 33)
    passage = StressHistories(scene, reader, reader.centres, sought=sought)
    averages = averaged_surface.AveragedSurface(passage, length)
    layer(scene, passage, 0.0, lambda done, total: None, None, averages)
    return passage, averages


def inner(averages):
    """Mask of the points around which all points of an average are searched."""
    out, reach = np.zeros(averages.f.shape, bool), len(averages.parts[0]) // 2
    out[reach:-reach, : -averages.reach] = True
    return out


def of_loads(scene, passage, length=LENGTH):
    """Layer of the averaged loads at the same points."""
    averages = AveragedReader(passage.reader, length)
    return layer(scene, StressHistories(scene, averages, passage.reader.centres), 0.0, lambda done, total: None, None)


def test_the_worst_one_is_that_of_averaged_loads(monkeypatch):
    """In one block and in blocks of a few rows, of which the averages need neighbours."""
    scene = tehl.scene("gear").replace(**ISOTHERMAL)
    passage, found = surface(scene)
    whole = of_loads(scene, passage)
    assert found.worst.f == pytest.approx(whole.worst.f, rel=1e-5) and 0 < found.reach
    assert (found.worst.x, found.worst.y) == (whole.worst.x, whole.worst.y)
    searched = np.isfinite(found.f)
    assert 0 < searched.sum() < 0.5 * searched.size
    assert np.allclose(found.f[searched & inner(found)], whole.f[searched & inner(found)], rtol=1e-4)
    for rows in (1, 2, 3, 7):
        blocks = [slice(n, min(n + rows, passage.y.size)) for n in range(0, passage.y.size, rows)]
        monkeypatch.setattr(StressHistories, "row_blocks", lambda self, blocks=blocks: blocks)
        parts = surface(scene)[1]
        assert parts.worst.f == pytest.approx(found.worst.f, rel=1e-6) and parts.worst.x == found.worst.x, rows


def test_all_points_whose_bound_reaches_the_worst_are_searched(monkeypatch):
    """One by one; without such a bound only points that cannot be the worst."""
    scene = tehl.scene("gear").replace(**ISOTHERMAL)
    monkeypatch.setattr(averaged_surface, "AT_ONCE", 1)
    passage, found = surface(scene)
    whole, some = of_loads(scene, passage), np.isfinite(found.f)
    assert found.worst.f == pytest.approx(whole.f[some].max(), rel=1e-5) and whole.f[~some & inner(found)].max() < found.worst.f
    bound = bounds(scene, passage, found)
    assert some[bound > found.worst.f].all() and 0 < some.sum() < 0.2 * some.size


def bounds(scene, passage, averages):
    """Averages of the values at points, of the points around which all are searched, else 0."""
    f, out = layer(scene, passage, 0.0, lambda done, total: None, None).f, np.zeros(averages.f.shape)
    for i, along in averages.parts[0]:
        for j, across in averages.parts[1]:
            rows = np.abs(np.arange(f.shape[1]) + j).clip(max=f.shape[1] - 1)
            out += along * across * np.roll(f, -i, axis=0)[:, rows]
    return np.where(inner(averages), out, 0.0)


def test_all_points_are_searched_where_nothing_bounds_the_value(monkeypatch):
    scene = tehl.scene("gear").replace(**ISOTHERMAL)
    monkeypatch.setattr(averaged_surface, "CRITERIA", {"findley": SimpleNamespace(convex=False)})
    passage, found = surface(scene)
    some, whole = inner(found), of_loads(scene, passage)
    assert np.isfinite(found.f).all() and np.allclose(found.f[some], whole.f[some], rtol=1e-4)


@pytest.mark.parametrize("sought", Sought)
def test_bounds_by_first_planes_are_raised(sought):
    """Of windows for error bars, and of coarse-grid runs."""
    passage, found = surface(tehl.scene("gear").replace(**ISOTHERMAL), sought=sought)
    part = averaged_surface.Rows(0, None, np.ones(found.f.shape))
    raised = averaged_surface.LOW if sought.brief else 1.0
    assert found._bounds(part, np.array([0, 5]), np.array([0, 1])) == pytest.approx([raised] * 2)
