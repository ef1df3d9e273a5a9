"""Heights of features together, and the room that they need at the ends of the domain."""

import math
from dataclasses import replace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.runs.flank import line_contacts
from tehl_taichi.scene import overlap
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.scales import Scales

GEAR = tehl.scene("gear").replace(**{"thermal.on": False, "grid.x_min": -4.5, "grid.x_max": 1.5})
BUMP = Feature(height=1e-6, width=200e-6)
PLACES = {"at one place": [{}, {}], "half over another": [{}, {"x": 80e-6}], "beside another": [{}, {"x": 300e-6}],
          "across": [{}, {"y": 60e-6}], "on a ridge": [{}, {"shape": "ridge", "x": -30e-6}],
          "over a furrow": [{}, {"height": -0.5e-6}], "met in rolling": [{}, {"surface": "b"}],
          "missed in rolling": [{}, {"surface": "b", "x": 150e-6}], "a third": [{}, {"x": 50e-6}, {"x": -50e-6, "y": 20e-6}]}


def scene_of(places, **changes):
    return replace(GEAR, features=tuple(replace(BUMP, **one) for one in places)).replace(**changes)


def brute(scene, X):
    """Largest height at X (a) over even positions and rows of both surfaces, and at least that of the highest feature."""
    a, at = Scales.of(scene).a, np.linspace(-4, 4, 8001)[:, None]
    y = np.linspace(-3e-4, 3e-4, 121)
    total = sum(f.height_at((X - s.pace * at) * a - f.x, y - f.y) for s in scene.surfaces for f in s.features)
    return max(float(total.max()), *(f.top for f in scene.features))


@pytest.mark.parametrize("srr", [0.0, -0.4])
@pytest.mark.parametrize("name", PLACES)
def test_heights_together_are_the_largest_sum_while_they_pass(name, srr):
    scene = scene_of(PLACES[name], srr=srr)
    for X in (scene.grid.x_max, 0.0):
        assert overlap.highest_at(scene, X, 0.0) == pytest.approx(brute(scene, X), rel=0.02)


def test_many_features_together_are_looked_at_a_few_at_a_time(monkeypatch):
    """The middles of all at once, then the rectangles of MOST of them: 256 bumps over each other took seconds."""
    called, own, draw = [], Feature.height_at, np.random.default_rng(1)
    bumps = [replace(BUMP, x=x, y=y) for x, y in draw.uniform(-5e-5, 5e-5, (60, 2))]
    monkeypatch.setattr(Feature, "height_at", lambda *one: called.append(1) or own(*one))
    found = overlap.highest_on(bumps, 1e-4)
    assert len(called) <= (overlap.MOST + 1) * len(bumps)
    at, y = np.linspace(-1e-4, 1e-4, 401)[:, None], np.linspace(-1e-4, 1e-4, 401)
    assert found == pytest.approx(overlap.height_at(bumps, at, y).max(), rel=1e-3)


def test_with_slip_features_of_two_bodies_meet_at_one_place_only():
    """Both are at X = 0 together; at the end of the domain one is 0.5 a behind."""
    both = scene_of(PLACES["met in rolling"], srr=-0.4)
    assert overlap.highest_at(both, 0.0, 0.0) == pytest.approx(2e-6) and overlap.highest_at(both, 1.5, 0.0) == 1e-6


def test_a_single_feature_has_its_own_height():
    one = scene_of([{}])
    assert overlap.highest_at(one, 1.5, 0.0) == 1e-6 == overlap.highest_on(one.features, 1e-4)
    assert overlap.highest_at(replace(GEAR, features=()), 1.5, 0.0) == 0.0 == overlap.highest_on((), 1e-4)


def doubts(scene):
    return [text for text in scene.typed_warnings if text.code == "room"]


def test_room_at_an_end_is_that_of_features_together():
    """Two halves of a bump at one place need the room of the whole one; beside each other that of a half."""
    tight = {"contact.load": 200e3}
    whole, = doubts(scene_of([{"height": 2.2e-6}], **tight))
    halves, = doubts(scene_of([{"height": 1.1e-6}] * 2, **tight))
    assert str(halves) == str(whole).replace("a feature of 2.2e-06 m passes", "overlapping features of 2.2e-06 m pass")
    assert doubts(scene_of([{"height": 1.1e-6}, {"height": 1.1e-6, "x": 300e-6}], **tight)) == doubts(
        scene_of([{"height": 1.1e-6}], **tight))
    with pytest.raises(SceneError, match="smaller than the height of a feature, 4e-06 m"):
        scene_of([{"height": 4e-6}], **tight)
    with pytest.raises(SceneError, match="smaller than the height of overlapping features, 4e-06 m"):
        scene_of([{"height": 2e-6}] * 2, **tight)


def test_the_domain_of_a_flank_has_room_for_features_together():
    one, two = (scene_of([{"height": height}] * count) for height, count in ((4e-6, 1), (2e-6, 2)))
    assert line_contacts.room(two, 100e3, 0.01) == line_contacts.room(one, 100e3, 0.01)
    assert line_contacts.room(one, 100e3, 0.01)["grid.x_max"] > 1.5 and math.isfinite(Scales.of(one).a)
