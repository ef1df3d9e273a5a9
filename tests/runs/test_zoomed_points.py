"""Points that are searched again where a run has a fine window."""

from dataclasses import replace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.fatigue import sought
from tehl_taichi.runs import zoomed_points
from tehl_taichi.scene.scales import Scales

GEAR = tehl.scene("gear")
X, Y = np.linspace(-2e-4, 2e-4, 41), np.linspace(0, 1e-4, 11)
DEPTHS = np.append(0.0, 3e-6 * 1.5 ** np.arange(12))


def found(at, deep, rough=False, surface="a"):
    """A search whose stress is largest at this column and row, below it at that column."""
    stress, under = np.full((X.size, Y.size), 1e8), np.full((DEPTHS.size, X.size), 3e8)
    stress[at], under[2, deep] = 4e8, 6e8
    summary = {"surface": surface, "rough": rough, "sigma_eF_Pa": 4e8, "Fi_max": 1.0, "statistics": 1,
               "below": {"Fi_max": 1.5, "statistics": 2}}
    return tehl.SearchResult(summary, feature_frame_x=X, feature_frame_y=Y, findley_stress=stress, fatigue_depth=DEPTHS,
                             findley_stress_under_row=under)


def test_the_worst_points_of_the_run_are_inside():
    (left, right), (low, high), *_ = zoomed_points.ends(GEAR, found((20, 4), 28))["a"]
    side = zoomed_points.BESIDE * Scales.of(GEAR).a
    assert np.allclose((left, right, low, high), (X[20] - side, X[28] + side, Y[4] - side, Y[4] + side))
    assert zoomed_points.ends(GEAR, found((1, 1), 39))["a"][:2] == ((-np.inf, np.inf), (-np.inf, Y[1] + side))


@pytest.mark.parametrize("changes, cut", [({}, False), ({"x_m": -9.9e-5}, True), ({"x_m": 5.9e-5}, True), ({"y_m": 0.0}, False),
                                          ({"y_m": 2.9e-5}, True)])
@pytest.mark.parametrize("part", ["surface", "below"])
def test_a_worst_point_at_an_end_of_what_was_searched_is_seen(changes, cut, part):
    points = {"surface": {"x_m": 0.0, "y_m": 1e-5}, "below": {"x_m": 1e-5, "y_m": 1e-5}}
    points[part] |= changes
    deep = {"Fi_max": 1.0, **points["below"]}
    result = tehl.SearchResult({"surface": "b", "Fi_max": 1.0, **points["surface"], "below": deep})
    box = {"b": ((-1e-4, 6e-5), (-np.inf, 3e-5), (0.0, np.inf))}
    assert zoomed_points.at_an_end(result, box, 2e-6) is cut
    assert not zoomed_points.at_an_end(result, {}, 2e-6)


def test_depths_far_below_the_worst_ones_are_those_of_the_run():
    whole = found((20, 4), 28)
    assert zoomed_points.ends(GEAR, whole)["a"][2] == (0.0, pytest.approx(DEPTHS[zoomed_points.LEAST + 1]))
    whole.summary["von_mises"] = {"depth_m": 0.99 * DEPTHS[8]}
    assert zoomed_points.ends(GEAR, whole)["a"][2] == (0.0, pytest.approx(DEPTHS[9]))
    whole.findley_stress_under_row[11, 3] = 5.5e8
    assert zoomed_points.ends(GEAR, whole)["a"][2] == (0.0, pytest.approx(DEPTHS[12]))
    whole.findley_stress_under_row[12, 3] = 5.5e8
    assert zoomed_points.ends(GEAR, whole)["a"][2] == (0.0, np.inf)


@pytest.mark.parametrize("depth, cut", [(1e-5, False), (3.1e-5, True)])
@pytest.mark.parametrize("place", [("below",), ("averaged", "below"), ("von_mises",)])
def test_a_worst_depth_at_the_end_of_what_was_searched_is_seen(place, depth, cut):
    summary = {"surface": "a", "Fi_max": 1.0, "x_m": 0.0, "y_m": 0.0}
    part = summary
    for key in place:
        part = part.setdefault(key, {})
    part |= {"depth_m": depth, "x_m": 0.0, "y_m": 0.0, "Fi_max": 1.0}
    box = {"a": ((-1e-4, 1e-4), (-np.inf, 1e-4), (0.0, 4.5e-5))}
    assert zoomed_points.at_an_end(tehl.SearchResult(summary), box, 2e-6) is cut


def test_a_coarser_window_is_searched_below_the_worst_points_of_the_finer_one():
    whole, box = found((20, 4), 28), sought.Box((-1e-5, 1e-5), (0.0, 3e-5), (0.0, 1e-5))
    whole.summary["below"]["y_m"] = 1e-5
    whole.summary.update(resolved={"below": {"y_m": 2e-5}}, averaged={"below": {"y_m": 1e-5}})
    assert zoomed_points.under_worst({"a": box}, whole) == {"a": (*box[:3], (1e-5, 2e-5))}
    del whole.summary["below"], whole.summary["resolved"], whole.summary["averaged"]
    assert zoomed_points.under_worst({"a": box}, whole) == {"a": box} and zoomed_points.under_worst({}, whole) == {}


def test_stresses_far_below_are_those_of_the_run():
    whole, x = found((20, 4), 28), np.linspace(-1e-4, 1e-4, 41)
    part = tehl.SearchResult({"surface": "a"}, feature_frame_x=x, fatigue_depth=np.array([0.0, 1e-6, 3e-6, 4.5e-6]),
                             findley_stress_under_row=np.full((4, x.size), 7e8))
    whole.findley_stress_under_row[5] = 1e12 * X
    joined = zoomed_points.deeper(part, whole)
    assert np.allclose(joined.fatigue_depth, [0.0, 1e-6, *DEPTHS[1:]]) and joined.findley_stress_under_row.shape == (14, x.size)
    assert (joined.findley_stress_under_row[:4] == 7e8).all() and np.allclose(joined.findley_stress_under_row[6], 1e12 * x)


def test_of_rough_surfaces_all_points_are_searched():
    assert zoomed_points.ends(GEAR, found((20, 4), 28, rough=True)) == {}


def test_bars_of_a_late_window_have_those_of_the_moments_before_it():
    from tehl_taichi.runs.zoomed_run import _with_early

    sizes = {"a:Fi_max": 3.0, "a:averaged_Fi_max": 5.0, "b:Fi_max": None, "a:below_Fi_max": 1.0, "p_max_Pa": 2.0,
             "h_min_m": 1.0}
    parts = {"middle_h_min_m": {"grid": 2.0}, "a:resolved_Fi_max": {"grid": 4.0}, "b:resolved_Fi_max": {"grid": 1.0},
             "a:resolved_below_Fi_max": {"grid": None}}
    assert _with_early(sizes, parts) == {"a:Fi_max": 5.0, "a:averaged_Fi_max": np.hypot(5, 4), "b:Fi_max": None,
                                         "a:below_Fi_max": 1.0, "p_max_Pa": 2.0, "h_min_m": np.hypot(1, 2)}


def test_numbers_of_all_points_are_those_of_the_run():
    run = {"a": {"statistics": 1, "stressed": 5, "below": {"statistics": 2}}}
    part = {"a": {"Fi_max": 1.2, "statistics": 8, "below": {"Fi_max": 1.6, "statistics": 9}}}
    whole = zoomed_points.completed(part, run)["a"]
    assert whole == {"Fi_max": 1.2, "statistics": 1, "stressed": 5, "below": {"Fi_max": 1.6, "statistics": 2}}
    assert part["a"]["statistics"] == 8


@pytest.mark.parametrize("y, cut", [(-2.9e-5, True), (-1e-5, False)])
def test_the_lower_end_across_is_an_end_too(y, cut):
    """Of a window that is not mirrored."""
    result = tehl.SearchResult({"surface": "b", "Fi_max": 1.0, "x_m": 0.0, "y_m": y})
    box = {"b": ((-1e-4, 6e-5), (-3e-5, 3e-5), (0.0, np.inf))}
    assert zoomed_points.at_an_end(result, box, 2e-6) is cut


def test_the_smooth_contact_has_its_stress_at_the_joined_depths():
    """Linear between those of the run."""
    whole = replace(found((20, 4), 28), findley_stress_contact_alone=1e12 * DEPTHS)
    part = tehl.SearchResult({"surface": "a"}, feature_frame_x=X, fatigue_depth=np.array([0.0, 1e-6, 3e-6, 4.5e-6]),
                             findley_stress_under_row=np.full((4, X.size), 7e8))
    joined = zoomed_points.deeper(part, whole)
    assert joined.fatigue_depth.size > DEPTHS.size
    assert np.allclose(joined.findley_stress_contact_alone, 1e12 * joined.fatigue_depth)


def test_both_searches_together_reach_from_the_smallest_depth_to_the_largest():
    run, part = ({"a": {"below": {"searched_m": ends}}} for ends in ([4e-6, 3e-4], [1e-6, 2e-5]))
    assert zoomed_points.completed(part, run)["a"]["below"]["searched_m"] == [1e-6, 3e-4]
