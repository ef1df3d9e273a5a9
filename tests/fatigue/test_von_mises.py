"""The largest von Mises stress: against closed forms, of every place that is searched, whether a body would yield."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from rolling import Dry, Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment, contact_alone
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.von_mises import VonMisesPeak, largest, share_of, summary, von_mises
from tehl_taichi.report import verdict
from tehl_taichi.runs.summary import search_rows
from tehl_taichi.runs.summary.result_warnings import yielding
from tehl_taichi.scene import yield_stress
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.strength.strength import Strength

GEAR = tehl.scene("gear")

NO_SHEAR = {"fatigue.shear": False, "thermal.on": False}
pytestmark = pytest.mark.usefixtures("taichi_cpu")


def turned(stress, seed):
    """Stress (6,) in other axes."""
    xx, yy, zz, xy, xz, yz = stress
    axes = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    s = axes @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ axes.T
    return np.array([s[0, 0], s[1, 1], s[2, 2], s[0, 1], s[0, 2], s[1, 2]])


def test_it_is_that_of_a_bar_and_of_a_shear_in_any_axes_and_under_any_pressure():
    for stress, wanted in (([3e8, 0, 0, 0, 0, 0], 3e8), ([0, 0, 0, 0, 2e8, 0], np.sqrt(3) * 2e8)):
        for seed in range(3):
            pressed = turned(np.array(stress), seed) - 5e8 * np.array([1, 1, 1, 0, 0, 0])
            assert_allclose(von_mises(pressed), wanted, rtol=1e-12)
    histories = np.random.default_rng(4).normal(size=(40, 7, 6))
    assert_allclose(largest(histories), von_mises(histories).max(axis=1))


def on_the_axis(s, nu, z):
    """Von Mises stress under the middle of a dry contact over p_H (Johnson 1985, equations 3.45 and 4.45)."""
    if s.line:
        x, down = -((1 + 2 * z**2) / np.sqrt(1 + z**2) - 2 * z), -1 / np.sqrt(1 + z**2)
        y = nu * (x + down)
    else:
        x = y = -(1 + nu) * (1 - z * np.arctan(1 / z)) + 0.5 / (1 + z**2)
        down = -1 / (1 + z**2)
    return von_mises(np.stack([x, y, down, *np.zeros((3, z.size))], axis=-1))


@pytest.mark.parametrize("name", ["smooth-line", "ball-on-disc"])
def test_of_the_smooth_dry_contact_it_is_that_under_its_middle(name):
    """0.558 p_H at 0.70 a of a line, 0.62 at 0.48 a of a ball."""
    scene = tehl.scene(name).replace(**NO_SHEAR)
    s, z = Scales.of(scene), np.linspace(0.05, 2, 4000)
    exact = on_the_axis(s, scene.body_a.nu, z)
    found = contact_alone.search(scene, Dry(scene), scene.surfaces[0]).summary["von_mises"]
    assert_allclose(found["max_Pa"], exact.max() * s.p_H, rtol=0.01)
    assert_allclose(found["depth_m"], z[exact.argmax()] * s.a, rtol=0.05)
    assert found["surface"] == "a" and found["surface_max_Pa"] < found["max_Pa"]


def search(**changes):
    scene = tehl.scene("gear").replace(**{"thermal.on": False, "srr": -0.12, "fatigue.surfaces": "a", **changes})
    reader = Rolling(scene, 12, 5)
    return scene, StressHistories(scene, reader, reader.centres), assessment.run(scene, reader, alone=False).summary


def test_it_is_no_less_than_at_any_point_searched_and_counts_residual_stress():
    scene, passage, summary = search(**{"fatigue.depths": (1e-4,), "fatigue.residual_xx": -3e8})
    at_depth = passage.history(slice(0, passage.y.size), passage.stresses(1e-4))
    found = summary["von_mises"]
    assert found["max_Pa"] >= largest(at_depth).max() and found["max_Pa"] >= found["surface_max_Pa"]
    resting = von_mises(passage.history(slice(0, 1), passage.stresses(1e-4))[:, -1])
    assert_allclose(resting, 3e8, rtol=1e-6)
    assert found["x_m"] in passage.x and found["y_m"] in passage.y and found["surface"] == "a"


def test_a_body_yields_above_its_own_yield_stress_or_that_of_hardened_steel():
    _, _, summary = search()
    found = summary["von_mises"]
    assert found["yield_stress_Pa"] == yield_stress.HARDENED == 2.2e9
    for share, yields in ((1.01, False), (0.99, True)):
        own = search(**{"bodies.a.yield_stress": share * found["max_Pa"]})[2]["von_mises"]
        assert own["yields"] is yields and own["max_Pa"] == found["max_Pa"]


def said(yields, limit=2.2e9):
    """A summary whose body has 2.5 GPa, and what it is warned of."""
    mises = {"max_Pa": 2.5e9, "depth_m": 3.8e-6, "surface": "b", "yield_stress_Pa": limit, "yields": yields}
    summary = {"von_mises": mises, "transient": {"p_max_Pa": 5.3e9}, "fatigue": {}}
    return summary, [str(sentence) for sentence in yielding(SimpleNamespace(scene=GEAR), summary)]


def test_warning_and_verdict_speak_by_it():
    summary, warned = said(True)
    assert "von Mises stress reaches 2.50 GPa 3.8 um below surface b, more than 2.2 GPa at which hardened" in warned[0]
    assert "3.8 µm below surface b" in verdict._yielding(summary, GEAR)[0]
    assert "1.5 GPa, its yield stress" in said(True, 1.5e9)[1][0]
    summary, warned = said(False)
    assert warned == [] and verdict._yielding(summary, GEAR) == ()


@pytest.mark.parametrize("own, limit, words", [
    ({"E": 310e9}, 2.2e9, "2.2 GPa at which hardened bearing steel yields"), ({"E": 210e9, "yield_stress": 2.2e9}, 2.2e9, None),
    ({"E": 310e9, "yield_stress": 2.2e9}, 2.2e9, None), ({"E": 310e9}, 1.5e9, None)])
def test_only_steel_yields_where_hardened_steel_does(own, limit, words):
    """A ceramic without a yield stress of its own (or of a table) is not known to yield."""
    scene = GEAR.replace(**{f"bodies.b.{key}": value for key, value in own.items()})
    summary = said(None if words else True, limit)[0]
    texts = [str(next(yielding(SimpleNamespace(scene=scene), summary))), *verdict._yielding(summary, scene)]
    doubt = "his body is no steel (E = 310 GPa): set bodies.b.yield_stress"
    assert [doubt in text for text in texts] == [bool(words)] * 2
    assert [(words or "its yield stress") in text for text in texts] == [True] * 2
    assert ["real ones would yield" in text for text in texts] == [not words] * 2


def part_of(name, value, E):
    """Part "von_mises" of a body with this largest stress (Pa) and Young's modulus (Pa), without a yield stress of its own."""
    surface = SimpleNamespace(name=name, body=replace(GEAR.body_a, E=E, yield_stress=0.0))
    return summary([VonMisesPeak(value, 0.0, 0.0, 0.0)], value, surface, Strength(GEAR.fatigue, surface))


def test_a_body_that_is_no_steel_hides_no_steel_that_yields():
    """A ceramic ball on a steel ring: the ball bears more than is known of it, the ring is the one that yields."""
    ring, ball = part_of("a", 2.3e9, 206e9), part_of("b", 2.6e9, 310e9)
    assert ring["yields"] is True and ball["yields"] is None
    assert search_rows.nearest_to_yield([{"von_mises": ball}, {"von_mises": ring}]) is ring
    assert search_rows.nearest_to_yield([{"von_mises": ball}]) is ball
    row, = search_rows._von_mises_rows([{"von_mises": ball}])
    assert row.note == ", yield stress not known"


@pytest.mark.parametrize("E_a, E_b, known", [(310e9, 310e9, False), (310e9, 208e9, True), (208e9, 75e9, True)])
def test_the_onset_under_asperities_is_that_of_the_bodies_whose_yield_stress_is_known(E_a, E_b, known):
    scene = GEAR.replace(**{"bodies.a.E": E_a, "bodies.b.E": E_b})
    assert yield_stress.pressure(scene) == (pytest.approx(2.1 * 2.2e9) if known else float("inf"))


@pytest.mark.parametrize("limit, warned", [(0.0, False), (2.0e9, True)])
def test_without_a_search_pressures_are_compared_with_the_onset_under_asperities(limit, warned):
    """2.1 times the lower yield stress: 4.62 GPa of hardened steel."""
    store = SimpleNamespace(scene=tehl.scene("gear").replace(**{"bodies.b.yield_stress": limit}))
    found = list(yielding(store, {"transient": {"p_max_Pa": 4.5e9}}))
    assert bool(found) == warned and all("4.2 GPa" in str(one) for one in found)


def test_it_is_printed_with_what_the_body_bears():
    fatigue = search()[2]
    row, = [row for row in search_rows.rows_of_fatigue(fatigue) if row.what == "largest von Mises stress"]
    assert row.number == fatigue["von_mises"]["max_Pa"] and row.note == ", yield stress 2.2 GPa" and "GPa" in row.value
    softer = {**fatigue["von_mises"], "surface": "other", "max_Pa": 0.9 * row.number, "yield_stress_Pa": 1e9}
    row, = [row for row in search_rows.rows_of_fatigue(fatigue, {"other": {**fatigue, "von_mises": softer}})
            if row.what == "largest von Mises stress"]
    assert row.number == softer["max_Pa"] and row.where.endswith("(other)")  # that body is nearer to its yield stress


def test_the_peak_that_is_closest_to_the_yield_stress_of_its_depth_counts():
    """A weak core at 100 um: 1.2 GPa of 1 GPa there, 1.5 of 2 GPa at the surface."""
    strength = SimpleNamespace(yield_stress=lambda depth: 1e9 if depth > 5e-5 else 2e9, knows_yield_stress=True)
    peaks = [VonMisesPeak(1.5e9, 0.0, 0.0, 0.0), VonMisesPeak(1.2e9, 1e-4, 0.0, 0.0)]
    found = summary(peaks, 1.5e9, SimpleNamespace(name="a"), strength)
    assert (found["max_Pa"], found["depth_m"], found["yield_stress_Pa"], found["yields"]) == (1.2e9, 1e-4, 1e9, True)
    assert share_of(strength)(1e-4) == 2.0
