"""Stressed volume: integrals in closed form, the smooth track, how it weighs a feature, probabilities."""

import math

import numpy as np
import pytest
from rolling import BothSides, Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment, stressed_volume
from tehl_taichi.runs.summary import summary_rows

WEIBULL = {"thermal.on": False, "fatigue.surfaces": "a", "fatigue.length": 0.0, "fatigue.weibull": 12.0}


def test_an_index_that_falls_with_depth_has_its_integral():
    """(1 - z/Z)^m over z gives Z/(m + 1), whatever the rungs; pressure alone gives nothing."""
    depths = np.append(0.0, np.geomspace(1e-6, 3e-4, 15))
    linear = np.stack([1 - depths / 3e-4, 1 - depths / 3e-4, -np.ones(16)], axis=1)
    found = stressed_volume.over_depth(linear, depths, 12.0)
    assert found == pytest.approx([3e-4 / 13, 3e-4 / 13, 0.0], rel=1e-3)


def test_areas_are_those_of_a_plane_and_of_a_row():
    x, y = np.linspace(0, 2, 21), np.linspace(0, 3, 7)
    assert stressed_volume.over_area(x[:, None] * y, 0.1, y) == pytest.approx(2 * 4.5)
    assert stressed_volume.over_area(x[:, None], 0.1, np.zeros(1)) == pytest.approx(2.0)


def test_half_of_the_specimens_survive_their_own_size():
    found = stressed_volume.probabilities({"volume_m3": 2e-9, "area_m2": 1e-6}, 2e-9, 0.0)
    assert found == {"failure_volume": pytest.approx(0.5)}
    twice = stressed_volume.probabilities({"volume_m3": 4e-9, "area_m2": 1e-9}, 2e-9, 1e-6)
    assert twice["failure_volume"] == pytest.approx(0.75)
    assert twice["failure_surface"] == pytest.approx(math.log(2) * 1e-3, rel=1e-3)


class Flat(Rolling):
    """The same without the bump."""

    def fields(self, n, names):
        return super().fields(0, names)


@pytest.mark.parametrize("rows", [1, 5])
def test_a_passage_without_a_peak_weighs_nothing(taichi_cpu, rows):
    """Every point of it has the index of the smooth contact."""
    scene = tehl.scene("furrow-line" if rows == 1 else "gear").replace(**WEIBULL)
    found = assessment.run(scene, Flat(scene, 12, rows)).summary["stressed"]
    width = 1.0 if rows == 1 else 2 * 0.6 * Rolling(scene, 12, rows).s.a
    length = found["volume_m3"] / found["track_depth_m"] / width
    assert found["track_equal_m2"] <= 0.05 * length * width and found["track_depth_m"] > 0
    assert found["area_m2"] == pytest.approx(found["track_share"] * length * width, rel=0.1)


@pytest.mark.parametrize("rows", [1, 5])
def test_sizes_of_a_scene_without_variation_across_are_per_metre(taichi_cpu, rows):
    """Where lengths and fatigue.length are twice as large they are twice squared then, not twice cubed: the words say so."""
    scene = tehl.scene("furrow-line" if rows == 1 else "gear").replace(**WEIBULL, **{"fatigue.reference_area": 1e-6})
    large = scene.replace(**{"contact.radius_x": 2 * scene.contact.radius_x, "contact.load": 2 * scene.contact.load,
                             **{f"feature.{key}": 2 * getattr(scene.features[0], key) for key in ("height", "width")}})
    one, two = (assessment.run(each, Rolling(each, 8, rows)).summary for each in (scene, large))
    power = 2 if rows == 1 else 3
    assert two["stressed"]["volume_m3"] == pytest.approx(2**power * one["stressed"]["volume_m3"], rel=1e-3)
    said = [what for what, _ in summary_rows.fatigue_rows(one) if "of smooth track" in what or "probability" in what]
    assert len(said) == 3 and all(("per metre across" in what) == (rows == 1) for what in said)


def test_a_peak_weighs_more_the_larger_the_exponent(taichi_cpu):
    """Its index is larger than that of the track, in less material."""
    equal = []
    for m in (6.0, 24.0):
        scene = tehl.scene("gear").replace(**{**WEIBULL, "fatigue.weibull": m, "fatigue.reference_volume": 1e-9})
        summary = assessment.run(scene, Rolling(scene, 12, 5)).summary
        found = summary["stressed"]
        equal.append(found["track_equal_m2"])
        assert found["volume_m3"] <= summary["below"]["Fi_max"] ** m * 1e-3**3 and 0 < found["failure_volume"] < 1
    assert 0 < equal[0] < equal[1]
    shown = [what for what, _ in summary_rows.fatigue_rows(summary)]
    assert "area of smooth track with the risk of the feature, below the surface" in shown


def test_none_without_an_exponent_or_the_smooth_contact(taichi_cpu):
    scene = tehl.scene("furrow-line").replace(**{**WEIBULL, "fatigue.weibull": 0.0})
    assert "stressed" not in assessment.run(scene, Rolling(scene, 12, 1)).summary
    scene = scene.replace(**{"fatigue.weibull": 9.0})
    assert "stressed" not in assessment.run(scene, Rolling(scene, 12, 1), alone=False).summary


def test_half_a_domain_stands_for_the_whole(taichi_cpu):
    """With the feature next to the axis everything is computed: the same sizes, to what rows differ in."""
    found = []
    for reader, y in ((Rolling, 0.0), (BothSides, 1e-9)):
        scene = tehl.scene("gear").replace(**{**WEIBULL, "feature.y": y})
        found.append(assessment.run(scene, reader(scene, 8, 5)).summary["stressed"])
    for key in ("volume_m3", "area_m2", "track_equal_m2", "track_equal_surface_m2"):
        assert found[1][key] == pytest.approx(found[0][key], rel=0.12), key


def test_both_areas_of_smooth_track_are_relative_to_one_searched_part(taichi_cpu):
    """The area that has the risk of the whole, less the searched one."""
    scene = tehl.scene("gear").replace(**WEIBULL)
    found = assessment.run(scene, Rolling(scene, 12, 7)).summary["stressed"]
    below = found["volume_m3"] / found["track_depth_m"] - found["track_equal_m2"]
    surface = found["area_m2"] / found["track_share"] - found["track_equal_surface_m2"]
    assert found["track_equal_m2"] > 0 and found["track_equal_surface_m2"] > 0 and below == pytest.approx(surface)


def test_steel_that_is_stronger_below_the_surface_has_less_stressed_volume(taichi_cpu, tmp_path):
    """1.5 times the limit under a thin skin: 1.5^-12 of the volume, all of the surface."""
    scene, found = tehl.scene("gear").replace(**WEIBULL), []
    for below in (4e8, 6e8):
        path = tmp_path / f"{below:g}.csv"
        path.write_text(f"depth_m,limit_Pa\n0,4e8\n1e-7,{below}\n1e-3,{below}\n")
        hard = scene.replace(**{"fatigue.table": str(path)})
        found.append(assessment.run(hard, Rolling(scene, 8, 5)).summary["stressed"])
    assert found[1]["volume_m3"] == pytest.approx(found[0]["volume_m3"] / 1.5**12, rel=0.05)
    assert found[1]["area_m2"] == pytest.approx(found[0]["area_m2"])
