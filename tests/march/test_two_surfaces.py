"""Features on either surface: mirrored, shared between both, counted from either, the passage is the same."""

import dataclasses

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.fatigue import assessment
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.timeline import step_cells, step_length

pytestmark = pytest.mark.usefixtures("taichi_cpu")
SWAPPED = {"pressure": "pressure", "film": "film", "traction_x_a": "traction_x_b", "traction_x_b": "traction_x_a"}


def line(srr=-0.12, surface="a", steps=24, **changes):
    """The gear with a ridge on that surface, in one dimension and isothermal."""
    return tehl.scene("gear").replace(**{"srr": srr, "grid.nx": 64, "feature.shape": "ridge", "feature.surface": surface,
                                         "thermal.on": False, "time.steps": steps, "fatigue.depths": [], **changes})


def marched(scene):
    return list(tehl.march(scene))


def test_a_feature_on_b_is_one_on_a_with_the_slip_turned_bit_for_bit():
    one, other = marched(line()), marched(line(0.12, "b"))
    for a, b in zip(one, other):
        for name, turned in SWAPPED.items():
            np.testing.assert_array_equal(a.fields[name], b.fields[turned], err_msg=name)
    found, turned = assessment.run(line(), one).summaries, assessment.run(line(0.12, "b"), other).summaries
    for name, mirror in (("a", "b"), ("b", "a")):
        for part, whose in ((found[name], name), (turned[mirror], mirror)):
            mises = part["von_mises"], part["contact_alone"]["von_mises"]
            assert {one.pop("surface") for one in (part, *mises)} == {whose}
        assert found[name] == turned[mirror]
    assert found["a"]["carries_feature"] and not found["b"]["carries_feature"]
    assert abs(found["a"]["Fi_max"] / found["b"]["Fi_max"] - 1) > 0.01  # it is not the same body twice
    first, mirrored = (tehl.crack(shots, scene, length=10e-6).summary for shots, scene in ((one, line()),
                                                                                         (other, line(0.12, "b"))))
    assert {first.pop("surface"), mirrored.pop("surface")} == {"a", "b"} and first.pop("srr") == -mirrored.pop("srr")
    assert first["sides"]["entry"]["opens"] and repr(first) == repr(mirrored)


def test_the_mirror_holds_with_temperatures_to_what_is_solved():
    """Rounds end by thermal.tolerance, with rounding errors that are no mirror images: 3e-6 with 0.1 K, 7e-8 with 1e-3 K."""
    changes = {"thermal.on": True, "thermal.tolerance": 1e-3, "steps": 12}
    for a, b in zip(marched(line(**changes)), marched(line(0.12, "b", **changes))):
        for name, turned in {**SWAPPED, "temperature_a": "temperature_b", "temperature_b": "temperature_a"}.items():
            assert np.abs(a.fields[name] - b.fields[turned]).max() < 1e-6 * np.abs(a.fields[name]).max(), name


def test_half_the_height_on_both_is_the_height_on_one_in_rolling():
    whole = line(0.0)
    half = dataclasses.replace(whole.features[0], height=0.5 * whole.features[0].height)
    both = dataclasses.replace(whole, features=(half, dataclasses.replace(half, surface="b")))
    for a, b in zip(marched(whole), marched(both)):  # h - s/2 - s/2 is rounded twice
        np.testing.assert_allclose(a.fields["pressure"], b.fields["pressure"], atol=1e-6 * a.fields["pressure"].max())


def two(first, second, **changes):
    """Ridges on both surfaces that meet at X = 0.1 a, with much slip; each (surface, x in a)."""
    scene = line(0.5, steps=16, **changes)
    a = Scales.of(scene).a
    ridges = [Feature(shape="ridge", height=5e-7, surface=surface, x=x * a) for surface, x in (first, second)]
    return dataclasses.replace(scene, features=tuple(ridges))


def test_it_does_not_matter_which_surface_is_the_clock():
    by_a = two(("a", 0.0), ("b", 0.1))
    pace = 0.75 / 1.25
    by_b = two(("b", 0.1), ("a", 0.0), **{"time.x_start": pace * by_a.path[0]})
    assert step_length(by_b) == pytest.approx(pace * step_length(by_a)) and step_cells(by_a) == by_a.time.courant
    for a, b in zip(marched(by_a), marched(by_b)):
        assert a.time == pytest.approx(b.time, rel=1e-12)
        np.testing.assert_allclose(a.fields["pressure"], b.fields["pressure"], atol=1e-5 * a.fields["pressure"].max())


def test_a_path_lasts_until_the_slower_feature_has_left():
    scene = two(("a", 0.0), ("b", 0.1))
    alone = dataclasses.replace(scene, features=scene.features[:1])
    pace = 0.75 / 1.25
    assert scene.path[0] == pytest.approx(alone.path[0] / pace, rel=0.15) and scene.path[1] > 1.3 * alone.path[1]


def resting(srr, moving, **ridge):
    """A ridge on the surface that moves, and one at 0.2 a on the other, at rest; or another feature there."""
    scene = tehl.scene("smooth-line").replace(**{"srr": srr, "grid.nx": 64, "grid.ny": 16, "thermal.on": False,
                                                 "fatigue.on": False})
    at, still = 0.2 * Scales.of(scene).a, {"a": "b", "b": "a"}[moving]
    keys = {"shape": "ridge", "height": 5e-7, **ridge}
    features = Feature(shape="ridge", height=5e-7, surface=moving), Feature(surface=still, x=at, **keys)
    return dataclasses.replace(scene, features=features, time=dataclasses.replace(scene.time, steps=16))


def test_a_feature_at_rest_is_in_the_contact_from_the_start_on():
    """It makes a steady state of its own: nothing changes until the other ridge, here one of nothing, comes."""
    scene = resting(2.0, "a")
    alone = dataclasses.replace(scene, features=(dataclasses.replace(scene.features[0], height=1e-12), scene.features[1]))
    P = [shot.fields["pressure"] for shot in marched(dataclasses.replace(alone, time=dataclasses.replace(alone.time, steps=4)))]
    smooth = next(tehl.march(tehl.scene("smooth-line").replace(**{"srr": 2.0, "grid.nx": 64, "thermal.on": False})))
    assert np.abs(P[0] - smooth.fields["pressure"]).max() > 0.05 * P[0].max()
    assert max(np.abs(p - P[0]).max() for p in P[1:]) < 1e-4 * P[0].max()


def test_a_feature_at_rest_on_a_is_one_on_b_with_the_slip_turned():
    """But for the order in which heights are taken off the gap."""
    one, other = marched(resting(2.0, "a")), marched(resting(-2.0, "b"))
    for a, b in zip(one, other):
        for name, turned in SWAPPED.items():
            scale = np.abs(a.fields[name]).max()
            np.testing.assert_allclose(a.fields[name], b.fields[turned], atol=1e-9 * scale, err_msg=name)
    assert np.abs(one[-1].fields["pressure"] - one[0].fields["pressure"]).max() > 0.01 * one[0].fields["pressure"].max()


def test_one_that_varies_across_starts_on_the_rows_of_its_passage():
    scene = resting(2.0, "a", shape="cosine", width=400e-6)
    first = next(tehl.march(scene))
    p = first.fields["pressure"]
    assert p.shape == (65, 17) and np.ptp(p, axis=1).max() > 0.02 * p.max()


def test_a_clock_that_rests_is_refused_by_its_name():
    with pytest.raises(SceneError, match=r"leaves surface b, .* at 0 m/s, .* allowed: srr < 1.998, a feature of surface a"):
        line(2.0, "b")
    with pytest.raises(SceneError, match="leaves surface a"):
        line(-2.0, "a")


def test_bodies_that_rest_are_not_judged():
    assert [s.name for s in line(2.0).judged] == ["a"] and [s.name for s in line().judged] == ["a", "b"]
    resting = line(2.0, **{"fatigue.surfaces": "b"})
    assert not resting.has_fatigue and "surface b is at rest" in resting.without_fatigue


def test_a_store_keeps_how_far_each_surface_has_moved(tmp_path):
    scene = line(steps=3, **{"numerics.estimate_error": False, "output.every": 2})
    store = tehl.run(scene, tmp_path / "moved.zarr").store
    X, u_a, u_b = store.scalar("feature_x"), scene.operation.u_a, scene.operation.u_b
    moved = {name: store.scalar(f"displacement_{name}_m") for name in "ab"}
    np.testing.assert_allclose(moved["a"], X, rtol=1e-14)
    np.testing.assert_allclose(moved["b"], X * u_b / u_a, rtol=1e-14)
    np.testing.assert_allclose(np.diff(moved["b"]), u_b * np.diff(store.time), rtol=1e-9)
    assert len(X) == 3 and X[0] == pytest.approx(scene.path[0] * Scales.of(scene).a)


def test_a_fast_smooth_body_is_searched_in_steps_that_resolve_its_load():
    """A low ridge on the slow surface adds little: the other body has at least what the smooth contact does to it."""
    fast = line(-1.9, "a", -1, hertz_pressure=1.2e9, height=1e-7, **{"fatigue.surfaces": "b", "numerics.estimate_error": False})
    pace, a = (1 - -1.9 / 2) / (1 + -1.9 / 2), fast.grid.nx / (fast.grid.x_max - fast.grid.x_min)
    assert step_cells(fast) * pace <= a / 4 < step_cells(fast.replace(**{"fatigue.on": False})) * pace
    assert step_cells(line(-1.0)) == step_cells(line(-1.0, **{"fatigue.on": False})) == 1.0
    shots = marched(fast.replace(**{"srr": -1.8, "time.x_end": 1.1}))
    found = assessment.run(fast.replace(srr=-1.8), shots).summary
    assert found["Fi_max"] > found["contact_alone"]["surface_Fi_max"]
