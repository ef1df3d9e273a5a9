"""Plastic flow of a half-space under given loads: closed form, elastic limit, second passage, the ball of ISO 76, hardening."""

import functools

import numpy as np
import pytest
from numpy.testing import assert_allclose
from values.test_registry import hold

from tehl_taichi.laws.hardening import HARDENINGS
from tehl_taichi.plastic import flow, steel_body
from tehl_taichi.plastic.half_space import LayeredHalfSpace
from tehl_taichi.plastic.layers import Layers
from tehl_taichi.plastic.steel_body import Cells, SteelState
from tehl_taichi.scene.sections import Body

STEEL, Y = Body(), 1.8e9
PERFECT, SWIFT = HARDENINGS["perfect"], HARDENINGS["swift-52100"]


@pytest.mark.parametrize("name", HARDENINGS)
def test_every_law_holds_and_never_softens(name):
    law = HARDENINGS[name]
    hold(law)
    assert np.all(np.diff(law.flow_stress(2e9, np.geomspace(1e-7, 0.1, 50))) >= 0)


def test_points_return_to_the_flow_stress_along_the_stress():
    """Of ten trial stresses those beyond the flow stress end on it: 3 G of the strain takes what lies above."""
    rng, G = np.random.default_rng(1), 8e10
    trial, before = flow.deviator(2e9 * rng.normal(size=(10, 6))), 1e-3 * rng.random(10)
    strain, more = flow.return_mapping(trial, before, lambda eps: SWIFT.flow_stress(3e9, eps), G)
    left, limit = flow.equivalent(trial - 2 * G * strain), SWIFT.flow_stress(3e9, before + more)
    flows = more > 0
    assert 2 <= flows.sum() <= 9
    assert_allclose(left[flows], limit[flows], rtol=1e-9)
    assert np.all(flow.equivalent(trial[~flows]) <= limit[~flows]) and not strain[~flows].any()
    assert_allclose(np.sqrt(2 / 3 * (flow.WEIGHTS * strain**2).sum(axis=1)), more, rtol=1e-9)
    assert_allclose(strain[:, :3].sum(axis=1), 0, atol=1e-12)


def cells(law, yield_stress, layers, side, shape, mirrored=False):
    return Cells(STEEL, layers, (side, side), shape, mirrored, lambda layer, strain: law.flow_stress(yield_stress, strain))


def test_under_a_wide_pressure_it_is_the_closed_form(monkeypatch):
    """Confined sideways: flow from p = Y (1 - nu)/(1 - 2 nu) on; p falls to 0, and sigma_xx = Y - p (1 - 2 nu)/(1 - nu)."""
    monkeypatch.setattr(steel_body, "LayeredHalfSpace", functools.partial(LayeredHalfSpace, pad=1.0))
    layers = Layers(np.r_[np.full(6, 5e-6), 5e-6 * 1.5 ** np.arange(1, 8)], 6)
    wide, places = cells(PERFECT, Y, layers, 5e-6, (5, 5)), tuple(np.indices((6, 5, 5)).reshape(3, -1))
    top, nu = 4.5e9, STEEL.nu
    pressures = np.r_[np.linspace(0, top, 10), np.linspace(top, 0, 10)]
    sideways = np.array([nu / (1 - nu), nu / (1 - nu), 1, 0, 0, 0])
    moments = [(places, np.tile(-p * sideways, (150, 1))) for p in pressures]
    left = steel_body.state_after(wide, SteelState.virgin(wide), moments)
    share = (1 - 2 * nu) / (1 - nu)
    e = (top * share - Y) * (1 - nu) / STEEL.E
    assert_allclose(left.residual[:, 0], Y - top * share, rtol=1e-5)
    assert_allclose(left.residual[:, 2], 0, atol=1e3)
    assert_allclose(left.strain[:, 2], -2 * e, rtol=1e-5)
    assert_allclose(left.sinking, 2 * e * share * 30e-6, rtol=1e-5)


RADIUS, SIDE, COUNT = 60e-6, 8e-6, 31
LAYERS = Layers(np.r_[np.full(16, 5e-6), np.full(3, 10e-6), 10e-6 * 1.4 ** np.arange(1, 12)], 19)


@functools.cache
def ball(p0):
    """Elastic stress (layers, x, y >= 0, 6) under a ball whose contact of RADIUS at 4.2 GPa grows with its pressure p0."""
    x, radius = (np.arange(COUNT) - COUNT // 2) * SIDE, RADIUS * p0 / 4.2e9
    p = p0 * np.sqrt(np.maximum(1 - (x[:, None] ** 2 + x**2) / radius**2, 0))
    return np.moveaxis(LayeredHalfSpace(STEEL, p.shape, (SIDE, SIDE), LAYERS).pressed(p)[..., COUNT // 2 :], 1, -1)


def pressed(law, yield_stress, pressures, start=None, mirrored=True):
    """(cells, SteelState) after a ball with these pressures."""
    rows = COUNT // 2 + 1 if mirrored else COUNT
    body, moments = cells(law, yield_stress, LAYERS, SIDE, (COUNT, rows), mirrored), []
    for p0 in pressures:
        stress = ball(p0)
        if not mirrored:
            image = stress[:, :, :0:-1] * np.array([1, 1, 1, -1, 1, -1])
            stress = np.concatenate([image, stress], axis=2)
        near = np.nonzero(flow.equivalent(flow.deviator(stress)) > 0.75 * law.flow_stress(yield_stress, 0.0))
        moments.append((near, stress[near]))
    return body, steel_body.state_after(body, start or SteelState.virgin(body), moments)


def test_a_ball_flows_from_1_6_yield_stresses_on():
    assert not pressed(PERFECT, 2e9, [1.56 * 2e9])[1].hardened.any()
    flowed = pressed(PERFECT, 2e9, [1.66 * 2e9])[1].hardened
    assert flowed.max() > 0 and LAYERS.depths[flowed.max(axis=(1, 2)).argmax()] == pytest.approx(0.48 * RADIUS * 0.79, abs=5e-6)


STEPS = tuple(4.2e9 * np.array([0.5, 0.7, 0.85, 1.0]))


@pytest.mark.parametrize("law, yield_stress", [(SWIFT, 2.374e9), (PERFECT, 2.2e9)], ids=["swift-52100", "perfect"])
def test_a_ball_at_4_2_gpa_leaves_what_iso_76_allows_within_a_factor_of_two(law, yield_stress):
    """1e-4 of its diameter, of both bodies together. The stress is compressive where it flowed most, tension lies around."""
    body, left = pressed(law, yield_stress, STEPS)
    diameter = RADIUS * 4 * (STEEL.E / (1 - STEEL.nu**2) / 2) / (np.pi * 4.2e9)
    assert 0.5e-4 < 2 * left.sinking.max() / diameter < 2e-4
    along = left.residual[:, 0, :, 0]
    layer, x = np.unravel_index(along.argmin(), along.shape)
    assert abs(x - COUNT // 2) <= 1 and LAYERS.depths[layer] == pytest.approx(0.55 * RADIUS, rel=0.3)
    assert 0 < along.max() < -along.min()
    size = flow.equivalent(flow.deviator(ball(STEPS[-1]) + np.moveaxis(left.residual, 1, -1)))
    assert np.all(size <= 1.01 * law.flow_stress(yield_stress, left.hardened))


def test_hardened_steel_does_not_flow_again_under_the_load_that_it_had():
    body, left = pressed(SWIFT, 2.374e9, STEPS)
    again = pressed(SWIFT, 2.374e9, STEPS, left)[1]
    assert left.hardened.any() and np.array_equal(again.hardened, left.hardened)
    assert np.array_equal(again.sinking, left.sinking)


def test_a_load_after_another_is_one_passage_with_both():
    """The residual stress of the first passage stays where the second one flows further."""
    first, one = (pressed(PERFECT, 2.2e9, loads)[1] for loads in ([3.9e9], [3.9e9, 4.2e9]))
    other = pressed(PERFECT, 2.2e9, [4.2e9], first)[1]
    assert 0.2 * one.sinking.max() < first.sinking.max() < 0.8 * one.sinking.max()
    assert_allclose(other.sinking, one.sinking, atol=0.01 * one.sinking.max())
    assert_allclose(other.residual, one.residual, atol=0.01 * np.abs(one.residual).max())


def test_mirrored_rows_are_half_of_the_whole():
    half, whole = (pressed(SWIFT, 2.374e9, STEPS, mirrored=one)[1] for one in (True, False))
    assert_allclose(whole.sinking[:, COUNT // 2 :], half.sinking, atol=1e-14)
    assert_allclose(whole.residual[..., COUNT // 2 :], half.residual, atol=1e3)
    assert_allclose(whole.sinking, whole.sinking[:, ::-1], atol=1e-14)


def test_it_scales_with_size_and_with_strength():
    """Sinking over size and Y/E depends on the pressure over Y alone: here half of all lengths."""
    body, left = pressed(PERFECT, 2.2e9, STEPS)
    half = Cells(STEEL, Layers(LAYERS.thickness / 2, LAYERS.count), (SIDE / 2, SIDE / 2), body.shape, True, body.flow_stress)
    moments = []
    for p0 in STEPS:
        near = np.nonzero(flow.equivalent(flow.deviator(ball(p0))) > 0.75 * 2.2e9)
        moments.append((near, ball(p0)[near]))
    own = steel_body.state_after(half, SteelState.virgin(half), moments)
    assert_allclose(own.sinking, left.sinking / 2, rtol=1e-6, atol=1e-15)
