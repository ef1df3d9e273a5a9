"""Moments that are left out near a plane: none that has the most there, and what is found counts them all."""

import dataclasses

import numpy as np
import pytest
from fatigue.test_thinning import passages

from tehl_taichi.engine.language import ti
from tehl_taichi.fatigue import critical_planes, deciding_moments, findley
from tehl_taichi.fatigue.enclosing_circle import vec3
from tehl_taichi.fatigue.plane_components import vec6
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.laws.criteria.criterion import Criterion

REACH = 0.05  # rad


def chosen(history, n, middle, reach):
    """Moments of one history (times, 6) that may decide around the plane n, and the others."""
    some, count = np.arange(len(history), dtype=np.int32)[None], np.zeros(1, np.int32)
    scratch = np.empty((1, len(history))), np.empty((1, len(history)))

    @ti.kernel
    def choose(reach: ti.f64, n: vec3, middle: vec6, S: ti.types.ndarray(dtype=ti.f64, ndim=3),
               some: ti.types.ndarray(dtype=ti.i32, ndim=2), a: ti.types.ndarray(dtype=ti.f64, ndim=2),
               b: ti.types.ndarray(dtype=ti.f64, ndim=2), count: ti.types.ndarray(dtype=ti.i32, ndim=1)):
        for row in range(1):
            count[row] = deciding_moments.deciding(S, some, a, b, row, S.shape[1], n, middle, reach)

    choose(reach, vec3(*n), vec6(*middle), history[None].copy(), some, *scratch, count)
    return some[0, : count[0]], some[0, count[0] :]


def of_plane(history, n):
    """Largest shear and largest normal stress on a plane of one history."""
    dip, strike, normal = findley.shear_path(history, n if n[2] >= 0 else -n)
    return np.hypot(dip, strike).max(), normal.max()


def planes_around(n, reach, count, rng):
    """Planes turned by `reach` from n, in all directions."""
    away = np.cross(n, rng.standard_normal((count, 3)))
    away /= np.linalg.norm(away, axis=1)[:, None]
    return np.cos(reach) * n + np.sin(reach) * away


def test_on_planes_around_one_the_others_have_less(taichi_cpu):
    rng = np.random.default_rng(2)
    for history in passages(6):
        n, middle = findley.planes()[rng.integers(200)], history[rng.integers(len(history))] * 0.3
        some, others = chosen(history, n, middle, REACH)
        np.testing.assert_array_equal(np.sort(np.append(some, others)), np.arange(len(history)))
        assert 0 < some.size < len(history)
        for plane in planes_around(n, REACH, 50, rng):
            most, less = of_plane(history[some] - middle, plane), of_plane(history[others] - middle, plane)
            assert less[0] <= most[0] and less[1] <= most[1]


def test_fewer_the_nearer_the_planes(taichi_cpu):
    history, n = passages(1)[0], np.array([0.6, 0.0, 0.8])
    sizes = [chosen(history, n, 0 * history[0], reach)[0].size for reach in (0.3, 0.03, 0.003)]
    assert sizes[0] > 2 * sizes[1] > 4 * sizes[2] > 0


def test_none_is_left_out_that_turns_to_the_front(taichi_cpu):
    """Pressure along z bears no shear on that plane, and more on planes around it than what has a little there."""
    history = np.array([[0, 0, 0, 0, 1.0, 0], [0, 0, -5.0, 0, 0, 0], [-2, -2, -2.2, 0, 0, 0]])
    some, others = chosen(history, np.array([0.0, 0.0, 1.0]), 0 * history[0], 0.3)
    assert set(some) == {0, 1} and list(others) == [2]


def test_what_may_overtake_the_largest_as_it_falls_is_kept(taichi_cpu):
    """Turned by 0.3 rad about y: a shear of 1 falls to cos 0.6 = 0.825, pull along x and pressure along z of 1.55 then have a
    shear of 1.55 sin 0.6 = 0.875, which was 0; likewise the normal stresses of the one and the other, beside more shear."""
    shear, pull, other = np.eye(6)[4], np.array([1, 0, -1, 0, 0, 0]), 10 * np.eye(6)[5]
    for history, size in ((np.stack([shear, 1.55 * pull]), 2), (np.stack([-pull, 1.55 * shear, other]), 3)):
        some, _ = chosen(history, np.array([0.0, 0.0, 1.0]), 0 * shear, 0.3)
        assert some.size == size


def test_what_a_turn_changes_is_the_range_of_principal_stresses(taichi_cpu):
    @ti.kernel
    def turned(s: vec6, n: vec3) -> ti.f64:
        return deciding_moments.ends(s, n, 1.0)[2]

    for s in np.random.default_rng(5).standard_normal((50, 6)):
        xx, yy, zz, xy, xz, yz = s
        principal = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        assert 1 <= turned(vec6(*s), vec3(0, 0, 1)) / np.ptp(principal) <= 2 / np.sqrt(3) * (1 + 1e-12)


@pytest.mark.parametrize("criterion", ["findley", pytest.param("matake", marks=pytest.mark.slow)])
def test_the_same_planes_without_leaving_any_out(taichi_cpu, criterion):
    history = passages(5, 120)
    f, normals = findley.search(history, 0.3, criterion=criterion)
    exact, others = findley.search(history, 0.3, criterion=criterion, prune=False)
    np.testing.assert_allclose(f, exact, rtol=1e-9)
    np.testing.assert_allclose(np.abs((normals * others).sum(axis=1)), 1.0, atol=1e-6)


RULE = Criterion(name="mean", says="", source="", value=lambda tau, normal, mean, kappa: tau + kappa * mean, sensitivity="",
                 checked=())


@pytest.fixture
def mean(monkeypatch):
    """A law that asks for the mean stress, and too few moments: one kernel for both tests."""
    monkeypatch.setattr(critical_planes, "REACH", 0.0)
    monkeypatch.setitem(CRITERIA, "mean", RULE)


def round_about(seed=7):
    """Shear that turns in a circle, not quite round: which moments are farthest changes from plane to plane."""
    turn, history = 2 * np.pi * np.arange(90) / 90, np.zeros((20, 90, 6))
    history[:, :, 4], history[:, :, 5] = 1e8 * np.cos(turn), 1e8 * np.sin(turn)
    return history + 3e6 * np.random.default_rng(seed).standard_normal(history.shape)


def test_too_few_are_not_taken(taichi_cpu, mean):
    f, exact = (findley.search(round_about(), 0.3, criterion="mean", prune=prune)[0] for prune in (True, False))
    np.testing.assert_allclose(f, exact, rtol=1e-9)


@pytest.mark.slow  # a kernel of its own: with a reach of nothing, above
def test_a_few_are_enough(taichi_cpu, monkeypatch):
    monkeypatch.setattr(critical_planes, "REACH", 1e-3)
    monkeypatch.setitem(CRITERIA, "short", dataclasses.replace(CRITERIA["findley"], name="short"))
    f, exact = (findley.search(round_about(), 0.3, criterion="short", prune=prune)[0] for prune in (True, False))
    np.testing.assert_allclose(f, exact, rtol=1e-9)


def test_a_moment_that_counts_otherwise_is_not_lost(taichi_cpu, mean):
    """Its largest mean stress is in a moment without shear or pull on the plane that is found."""
    history = np.zeros((1, 60, 6))
    history[0, :30] = 1e8 * np.sin(np.arange(30))[:, None] * [0, 0, 0, 0, 1, 0] + [1e6, 0, 1e6, 0, 0, 0]
    history[0, 45, 1] = 6e7
    exact = np.ptp(history[..., 4]) / 2 + 0.3 * 2e7
    assert findley.search(history, 0.3, criterion="mean")[0][0] == pytest.approx(exact, rel=1e-9)
