"""Transforms by kept plans: the bits of new plans, from several threads too, and a bound on their memory."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from tehl_taichi.engine import fftw


@pytest.fixture(autouse=True)
def nothing_kept():
    fftw._idle.clear()
    yield
    fftw._idle.clear()


def fields(count, shape=(6, 40)):
    return list(np.random.default_rng(3).standard_normal((count, *shape)))


def both_ways(values, axis):
    """Half a transform, and the values from it."""
    spectrum = fftw.half(values, 48, axis, fftw.DOUBLE)
    return spectrum, fftw.half_back(spectrum, 48, axis, fftw.DOUBLE) / 48


@pytest.mark.parametrize("axis", [0, 1, -1])
def test_values_and_back_with_zeros_behind(axis):
    for values in fields(3):
        spectrum, found = both_ways(values, axis)
        np.testing.assert_allclose(spectrum, np.fft.rfft(values, 48, axis), atol=1e-12)
        size = values.shape[axis]
        np.testing.assert_allclose(np.take(found, range(size), axis), values, atol=1e-12)
        np.testing.assert_allclose(np.take(found, range(size, 48), axis), 0.0, atol=1e-12)


def test_a_kept_plan_gives_the_bits_of_a_new_one(monkeypatch):
    kept = [both_ways(values, -1) for values in fields(4)]
    assert len(fftw._idle) == 2 and all(len(plans) == 1 for plans in fftw._idle.values())
    monkeypatch.setattr(fftw, "KEPT_BYTES", 0)
    fftw._idle.clear()
    for values, before in zip(fields(4), kept):
        for one, other in zip(both_ways(values, -1), before):
            np.testing.assert_array_equal(one, other)
    assert not fftw._idle


def test_results_stay_when_their_plan_is_used_again():
    first, second = fields(2)
    spectrum = fftw.half(first, 48, -1)
    before = spectrum.copy()
    fftw.half(second, 48, -1)
    np.testing.assert_array_equal(spectrum, before)


def test_in_place_transforms_have_plans_of_their_own():
    values = fields(1)[0]
    for _ in range(2):
        found = fftw.transform(values, 48, fftw.DOUBLE)
        np.testing.assert_allclose(found, np.fft.fft(values, 48), atol=1e-12)
        np.testing.assert_allclose(fftw.transform_back(found)[:, :40].real, values, atol=1e-5)


def test_threads_never_share_a_plan():
    given = fields(200, (30, 400))
    alone = [fftw.half(values, 512, -1) for values in given]
    with ThreadPoolExecutor(4) as pool:
        for found, expected in zip(pool.map(lambda values: fftw.half(values, 512, -1), given), alone):
            np.testing.assert_array_equal(found, expected)


def test_few_plans_are_kept_and_none_of_large_arrays():
    for length in range(50, 50 + 3 * fftw.KEPT):
        fftw.half(np.zeros((2, 40)), length, -1)
    assert 0 < len(fftw._idle) <= fftw.KEPT
    fftw._idle.clear()
    fftw.half(np.zeros((1000, 400)), 512, -1)
    assert not fftw._idle
