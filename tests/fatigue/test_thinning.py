"""Moments that a search leaves out at first: none far from the chords of the others, and what is found counts them all."""

import numpy as np
import pytest

from tehl_taichi.engine.language import ti
from tehl_taichi.fatigue import findley, thinning
from tehl_taichi.laws.criteria import CRITERIA


def passages(points=20, steps=400, seed=4):
    """Smooth stress histories that begin and end nearly unloaded, (points, steps, 6)."""
    rng = np.random.default_rng(seed)
    t = np.linspace(-8, 8, steps)
    centre, width = rng.uniform(-0.5, 0.5, (points, 6, 1)), rng.uniform(0.3, 1, (points, 6, 1))
    size = rng.standard_normal((points, 6, 1)) * 1e8
    return np.ascontiguousarray((size / (1 + ((t - centre) / width) ** 4)).transpose(0, 2, 1))


def kept(history):
    """Moments of one history (times, 6) that are kept."""
    some, count = np.zeros((1, len(history)), np.int32), np.zeros(1, np.int32)

    @ti.kernel
    def choose(steps: ti.i32, S: ti.types.ndarray(dtype=ti.f64, ndim=3), some: ti.types.ndarray(dtype=ti.i32, ndim=2),
               count: ti.types.ndarray(dtype=ti.i32, ndim=1)):
        for row in range(1):
            low, high = thinning.extent(S, row, steps)
            count[row] = thinning.thin(S, some, row, steps, low, high)

    choose(len(history), history[None].copy(), some, count)
    return some[0, : count[0]]


def off_chords(history, some):
    """Distance of every moment from the chord between the kept ones around it, over the range of the stresses."""
    out = np.zeros(len(history))
    for first, last in zip(some[:-1], some[1:]):
        way, chord = history[first : last + 1] - history[first], history[last] - history[first]
        part = np.clip(way @ chord / max(chord @ chord, 1e-300), 0, 1)
        out[first : last + 1] = np.linalg.norm(way - part[:, None] * chord, axis=1)
    return out / np.linalg.norm(np.ptp(history, axis=0))


def test_moments_near_the_chords_of_others_are_left_out(taichi_cpu):
    for history in passages(4):
        some = kept(history)
        assert some[0] == 0 and some[-1] == len(history) - 1 and (np.diff(some) >= 1).all()
        assert np.diff(some).max() == thinning.LONGEST and some.size < 0.3 * len(history)
        assert 0.1 * thinning.OFF < off_chords(history, some).max() <= thinning.OFF


@pytest.mark.parametrize("steps", [1, 2, 3])
def test_short_histories_are_kept(taichi_cpu, steps):
    np.testing.assert_array_equal(kept(passages(1, 60)[0, 25 : 25 + steps]), np.arange(steps))


def test_what_stands_still_has_two_ends(taichi_cpu):
    np.testing.assert_array_equal(kept(np.ones((20, 6))), [0, 19])


def test_a_path_that_turns_back_on_its_line_keeps_where_it_turns(taichi_cpu):
    history = np.zeros((31, 6))
    history[:, 3] = 1e8 * np.minimum(np.arange(31), 40 - np.arange(31))  # to 20 and back to 10
    np.testing.assert_array_equal(kept(history), [0, 20, 30])


def test_a_moment_that_was_left_out_counts(taichi_cpu):
    """Torsion that rises to 100 MPa, and by a ten-thousandth of it for one moment."""
    history = np.zeros((1, 41, 6))
    history[0, :, 3] = 1e8 * np.minimum(np.arange(41) / 30, 1)
    exact = np.hypot(0.5, 0.3) * 1e8
    assert findley.search(history, 0.3)[0][0] == pytest.approx(exact, rel=1e-9)
    history[0, 35, 3] *= 1.0001
    assert 35 not in kept(history[0])
    assert findley.search(history, 0.3)[0][0] == pytest.approx(1.0001 * exact, rel=1e-9)


def test_no_plane_has_more_by_all_moments(taichi_cpu):
    """Neither around the one that is found, nor among those of a coarse scan."""
    rule, history = CRITERIA["findley"], passages(3)
    for stress, f, n in zip(history, *findley.search(history, 0.3)):
        near = n + 0.02 * np.random.default_rng(1).standard_normal((200, 3))
        for plane in np.concatenate([findley.planes(), near / np.linalg.norm(near, axis=1)[:, None]]):
            dip, strike, normal = findley.shear_path(stress, plane if plane[2] >= 0 else -plane)
            assert rule.value(findley.smallest_circle(dip, strike)[2], normal.max(), 0.0, 0.3) <= f * (1 + 1e-7)
