"""Residual stress of plastic strain: closed forms of a layer and a sphere, balance, reciprocity; the stress under a ball."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tehl_taichi.plastic.flow import WEIGHTS, deviator, equivalent
from tehl_taichi.plastic.half_space import LayeredHalfSpace, odd_length
from tehl_taichi.plastic.layers import Layers, layers
from tehl_taichi.scene.sections import Body

STEEL = Body()
LAYERS = Layers(np.r_[np.full(12, 5e-6), 5e-6 * 1.4 ** np.arange(1, 14)], 12)


def small(pad=2.0, n=15):
    return LayeredHalfSpace(STEEL, (n, n), (5e-6, 5e-6), LAYERS, pad)


def test_lengths_are_odd_and_quick():
    assert [odd_length(n) for n in (1, 8, 11, 22, 60)] == [1, 9, 15, 25, 63]


def test_layers_reach_where_a_smooth_contact_is_worst_and_a_bottom_far_below():
    for spacing in (2e-6, 2e-5):
        found = layers(2e-4, spacing, 2e-4)
        assert found.thickness[0] == min(spacing, 5e-6) and found.depths[-1] > 1.7e-4
        assert found.thickness.sum() > 5e-3 and np.all(np.diff(found.thickness) > -1e-20)


def test_depths_are_the_middles_of_the_layers_of_which_eight_at_least_are_even():
    for spacing in (1e-7, 2e-6, 2e-5):
        found = layers(2e-4, spacing, 1e-4)
        ends = np.concatenate([[0.0], np.cumsum(found.thickness)])
        assert_allclose(found.depths, (ends[1:] + ends[:-1])[: found.count] / 2, rtol=1e-12)
        even = np.isclose(found.thickness, found.thickness[0]).sum()
        assert even >= 8 and even * found.thickness[0] == pytest.approx(0.2 * 1e-4, rel=0.03)


def test_layers_under_a_narrow_feature_are_those_of_a_contact_as_narrow():
    """As far down as its stress changes fast; below, they reach as deep as under the contact alone."""
    narrow, alone, small = layers(2e-4, 1e-5, 5e-5), layers(2e-4, 1e-5, 2e-4), layers(5e-5, 1e-5, 5e-5)
    near = int(np.searchsorted(small.depths, 0.2 * 5e-5))
    assert near > 4 and np.array_equal(narrow.depths[:near], small.depths[:near])
    assert narrow.depths[-1] > 0.8 * alone.depths[-1] and narrow.thickness.sum() > 0.9 * alone.thickness.sum()


def test_a_layer_strained_along_the_surface_has_its_own_stress_alone():
    """-E e/(1 - nu) in it, nothing elsewhere; it grows by 2 nu e/(1 - nu) of its thickness, which lifts the surface."""
    space, strain, e = small(pad=1.0), np.zeros((12, 6, 15, 15)), 1e-3
    strain[4, :2] = e
    stress, sinking = space.answer(strain)
    wanted = np.zeros_like(stress)
    wanted[4, :2] = -STEEL.E * e / (1 - STEEL.nu)
    assert_allclose(stress, wanted, atol=1.0)
    assert_allclose(sinking, -2 * STEEL.nu / (1 - STEEL.nu) * e * 5e-6, rtol=1e-6)


def test_a_swollen_sphere_is_under_the_pressure_of_that_in_infinite_steel_and_lifts_the_surface():
    """-(4/3) G e (1 + nu)/(1 - nu) at three radii below the surface; above it -(1 + nu) e V/(pi c^2) (Mindlin & Cheng 1950)."""
    below = Layers(np.r_[np.full(36, 4e-6), 4e-6 * 1.4 ** np.arange(1, 15)], 36)
    n, c, e = 31, 74e-6, 1e-3
    space = LayeredHalfSpace(STEEL, (n, n), (4e-6, 4e-6), below, 3.0)
    x = (np.arange(n) - n // 2) * 4e-6
    inside = np.sqrt(x[:, None] ** 2 + x**2 + (below.depths[:, None, None] - c) ** 2) < 24e-6
    strain = np.zeros((36, 6, n, n))
    strain[:, :3] = e * inside[:, None]
    stress, sinking = space.answer(strain)
    wanted = -4 / 3 * space.G * e * (1 + STEEL.nu) / (1 - STEEL.nu)
    assert_allclose(stress[18, :3, n // 2, n // 2], wanted, rtol=0.02)
    assert_allclose(sinking[n // 2, n // 2], -(1 + STEEL.nu) * e * inside.sum() * 64e-18 / np.pi / c**2, rtol=0.02)


def test_residual_stress_carries_no_load_through_any_section():
    """No force on a plane along y and z, and none on the surface; over a whole period."""
    rng = np.random.default_rng(1)
    strain = np.zeros((12, 6, 15, 15))
    strain[:, :, 4:9, 5:11] = 1e-3 * rng.normal(size=(12, 6, 5, 6))
    space = small(pad=1.0)
    stress, _ = space.answer(strain)
    size = np.abs(stress).max()
    assert np.abs(stress[:, [2, 4, 5]].sum(axis=(2, 3))).max() < 1e-9 * size * 225  # zz, xz and yz on every plane
    assert np.abs(stress.sum(axis=(2, 3))[:, 2]).max() < 1e-9 * size * 225


def test_two_strains_do_equal_work_on_each_other():
    """Reciprocity: stress of the one times strain of the other, either way; and none gains energy by itself."""
    rng, space = np.random.default_rng(2), small()
    volume = LAYERS.thickness[:12, None, None, None] * WEIGHTS[:, None, None]
    one, two = (1e-3 * rng.normal(size=(12, 6, 15, 15)) for _ in range(2))
    of_one, of_two = space.answer(one)[0], space.answer(two)[0]
    work = [float((volume * stress * strain).sum()) for stress, strain in ((of_one, two), (of_two, one))]
    assert_allclose(*work, rtol=1e-9)
    assert (volume * of_one * one).sum() < 0


def test_the_sinking_of_a_strain_is_the_work_of_a_pressure_on_it():
    """Betti: a pressure p sinks through what the strain does to the surface as its stress works on the strain."""
    rng, space = np.random.default_rng(3), small(pad=1.0)
    strain, p = 1e-3 * rng.normal(size=(12, 6, 15, 15)), 1e9 * rng.random((15, 15))
    volume = LAYERS.thickness[:12, None, None, None] * WEIGHTS[:, None, None]
    assert_allclose((p * space.answer(strain)[1]).sum(), (volume * space.pressed(p) * strain).sum(), rtol=1e-9)


def test_under_a_ball_it_has_the_elastic_stress():
    """0.62 p0 at 0.48 a (Johnson 1985)."""
    x = (np.arange(41) - 20) * 6e-6
    below = Layers(np.r_[np.full(14, 4.5e-6), 4.5e-6 * 1.4 ** np.arange(1, 14)], 14)
    space = LayeredHalfSpace(STEEL, (41, 41), (6e-6, 6e-6), below)
    p = 1e9 * np.sqrt(np.maximum(1 - (x[:, None] ** 2 + x**2) / 6e-5**2, 0))
    mises = equivalent(deviator(np.moveaxis(space.pressed(p), 1, -1)))[:, 20, 20]
    assert mises.max() == pytest.approx(0.62e9, rel=0.02)
    assert below.depths[mises.argmax()] == pytest.approx(0.48 * 6e-5, abs=4.5e-6)


def test_a_body_turned_by_a_right_angle_has_the_turned_stress():
    """With cells and sides that differ along x and y: xx becomes yy, yz becomes xz."""
    strain, turned = 1e-3 * np.random.default_rng(4).normal(size=(12, 6, 9, 15)), [1, 0, 2, 3, 5, 4]
    one = LayeredHalfSpace(STEEL, (9, 15), (4e-6, 7e-6), LAYERS, 1.0)
    two = LayeredHalfSpace(STEEL, (15, 9), (7e-6, 4e-6), LAYERS, 1.0)
    stress, sinking = one.answer(strain)
    other, sunk = two.answer(strain[:, turned].swapaxes(2, 3))
    assert_allclose(other[:, turned].swapaxes(2, 3), stress, atol=1e-8 * np.abs(stress).max())
    assert_allclose(sunk.T, sinking, atol=1e-8 * np.abs(sinking).max())
