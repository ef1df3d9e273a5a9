"""Places that a report numbers on its maps."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.report import numbered_points, run_tables
from tehl_taichi.scene.scales import Scales


def test_the_worst_place_is_that_of_the_larger_index_at_either_depth():
    """One at the surface and a worse one below; a peak beside that, too near for a place of its own, too far for its value."""
    scene = tehl.scene("rough")
    side = np.linspace(-1, 1, 81) * Scales.of(scene).a
    top, deep = np.full((81, 81), 0.1), np.full((81, 81), 0.1)
    top[20, 20], deep[60, 60], top[60, 67] = 0.8, 1.5, 0.6
    assert numbered_points.APART / 2 < 7 / 40 < numbered_points.APART
    result = SimpleNamespace(Fi=top, feature_frame_x=side, feature_frame_y=side, worst_depth=[1e-5], index=lambda name: deep,
                             numbers={})
    first, second = numbered_points.places(SimpleNamespace(result=result, scene=scene))[:2]
    assert (first.x, first.y) == pytest.approx((side[60], side[60]))
    assert (first.Fi, first.below) == (0.1, 1.5) and (second.Fi, second.below) == (0.8, 0.1)


def searched(scene, surface, at):
    """A search of that surface with its largest index at x = at (m)."""
    side = at + np.linspace(-1, 1, 81) * Scales.of(scene).a
    Fi = np.exp(-np.add.outer((side - at) ** 2, (side - at) ** 2) / 1e-9)
    numbers = {"surface": surface, "carries_feature": any(f.surface == surface for f in scene.features)}
    result = SimpleNamespace(Fi=Fi, feature_frame_x=side, feature_frame_y=side - at, index=lambda name: None, numbers=numbers)
    made = SimpleNamespace(scene=scene, result=result)
    made.places = numbered_points.places(made)
    return made


def scanned(tmp_path, srr, *others):
    """A scan on surface a that rises along x, and other features."""
    np.save(tmp_path / "scan.npy", np.tile(np.linspace(-0.5, 0.5, 101), (101, 1)))
    keys = {"shape": "map", "file": str(tmp_path / "scan.npy"), "unit": "um", "pixel": 4e-6, "level": "none"}
    made = tehl.scene("gear").replace(**{**{f"feature.{key}": value for key, value in keys.items()}, "srr": srr})
    return dataclasses.replace(made, features=(*made.features, *others))


def test_the_height_of_a_place_is_that_of_its_own_surface(tmp_path):
    """Of a smooth body, that of the scan which it meets there at X = 0; of a body with features their own, wherever it is."""
    bump = tehl.Feature(height=1e-6, width=2e-4, x=1e-4, surface="b")
    both, alone = scanned(tmp_path, -0.3, bump), scanned(tmp_path, -0.3)
    heights = {(name, len(scene.features)): searched(scene, name, 1e-4).places[0].height for scene in (both, alone)
               for name in "ab"}
    slope = pytest.approx(1e-4 * 1e-6 / 4e-4)
    assert heights == {("a", 2): slope, ("b", 2): pytest.approx(1e-6), ("a", 1): slope, ("b", 1): slope}


@pytest.mark.parametrize("srr, surface, met", [(-0.3, "b", True), (-0.3, "a", False), (0.0, "b", False)])
def test_a_place_on_a_sliding_body_says_when_it_meets_the_point_of_the_file(tmp_path, srr, surface, met):
    """With slip the scan moves on from there; the row and column are those at X = 0."""
    search = searched(scanned(tmp_path, srr), surface, 1e-4)
    table = numbered_points.rows(search)
    point = {"x_m": 1e-4, "y_m": 0.0, "depth_m": 0.0, "Fi_max": 1.0, **search.result.numbers}
    label, place = run_tables.worst_points(point, search.scene).data["rows"][-1]
    assert place == "row 51, column 76" and ("that it meets at X = 0" in label) == met
    assert ("meets at X = 0" in table.data["head"][-1], "from the point that meets its centre at X = 0" in str(table.data)) == (
        met, met)
