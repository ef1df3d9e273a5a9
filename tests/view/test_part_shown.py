"""What pages and figures show where a grid does not resolve every pressure: first the part on which the answer rests."""

import made_results
import numpy as np
import pytest
from made_figures import searched, title, titles
from read_pages import numbers, page, values

from tehl_taichi.fatigue import search_result
from tehl_taichi.view.figures import fatigue_figures, search_data
from tehl_taichi.view.figures.figure_style import FigureStyle

ALONE = "findley_stress_contact_alone"
PART = {"to_x_a": 0.6, **made_results.fatigue(0.8, 0.9)}
PLACES = set(search_result.SHARED) - {ALONE}
SEARCH = {**made_results.fatigue(1.6, 1.7), "resolved": PART}


def maps(of_part=True):
    """Those of a search, and of its part 0.8 as much."""
    whole = made_results.maps()
    whole |= {"worst_depth": (np.array([25e-6]), ["d"], "m", "depth"),
              "findley_stress_at_worst_depth": (4e8 * whole["Fi"][0], ["x", "y"], "Pa", "stress")}
    part = {search_result.PART + name: (0.8 * values if "stress" in name or name == "Fi" else values, *rest)
            for name, (values, *rest) in whole.items() if name not in PLACES}
    return whole | part if of_part else whole


def test_figures_of_a_stored_run_know_the_part():
    found = search_data.DrawnSearch.of(made_results.THERMAL, made_results.result(SEARCH, maps()))
    part, whole = found.each
    assert whole is found and part.summary["Fi_max"] == 0.8 and part.summary["criterion"] == "findley"
    np.testing.assert_allclose(part.result.Fi, 0.8 * found.result.Fi)
    np.testing.assert_allclose(part.result.worst_below["stress"], 0.8 * found.result.worst_below["stress"])
    # of a part of the passage it would say nothing
    np.testing.assert_array_equal(getattr(part.result, ALONE), getattr(found.result, ALONE))
    assert "feature up to 0.60 a" in part.constants
    assert found.constants.endswith("whole passage, later pressures not resolved")
    older = search_data.DrawnSearch.of(made_results.THERMAL, made_results.result(SEARCH, maps(False)))
    assert older.each == [older] and older.when == ""


@pytest.mark.parametrize("width", [17.0, 8.5])
def test_the_map_of_the_part_comes_first(width):
    pytest.importorskip("matplotlib")
    part = searched(arrays=lambda found: {"Fi": 0.8 * found.Fi}, when="as long as it is (up to 0.6 a)")
    figures = fatigue_figures.all_figures(FigureStyle(dpi=40, width=width), searched(part=part, when="all"))
    figure = figures["fatigue"]()
    said = [text for text in titles(figure)[1:] if text]
    assert said[0].startswith("as long as it is\n(up to 0.6 a)\nlargest, Fi = 0.80")
    assert said[2].startswith("all\nlargest, Fi = 1.00")
    assert list(figures) == ["fatigue", "fatigue_point", "fatigue_point_whole"]
    assert title(figures["fatigue_point"]()).endswith("as long as it is (up to 0.6 a)")


def test_the_page_shows_the_part_before_the_whole(tmp_path):
    pytest.importorskip("plotly")
    seen = page(made_results.run(tmp_path / "a.zarr", search=SEARCH, found=maps()), tmp_path)
    first, last = seen.headings.index("Fatigue, resolved part"), seen.headings.index("Fatigue, whole passage")
    assert "The answer uses this part: while the grid resolves the pressure (feature up to 0.60 a)." in seen.text
    assert first < last
    names = [name for name in seen.places if "index-" in name]
    assert names == ["resolved-index-surface", "resolved-index-below", "index-surface", "index-below"]
    assert numbers(seen.figures[names[0]]["data"][0]).max() == pytest.approx(0.8)
    rows = seen.text[seen.text.index("Numbers and their errors") :]
    assert rows.index("largest, while the grid resolves") < rows.index("largest, whole passage")


def test_a_store_without_maps_of_the_part_says_so(tmp_path):
    pytest.importorskip("plotly")
    seen = page(made_results.run(tmp_path / "a.zarr", search=SEARCH, found=maps(False)), tmp_path)
    assert "has no maps of this part" in seen.text and "resolved-index-surface" not in seen.places
    assert "Fatigue, resolved part" in seen.headings


KNOWN = {"a:averaged_Fi_max": 0.05, "a:below_averaged_Fi_max": 0.04}


def averaged(**more):
    """A search whose averaged stresses decide: no pointwise error is known, while the whole passage has more."""
    def part(found, Fi, **place):
        return {**found, "Fi_max": Fi, "findley_stress_max_Pa": Fi * 4e8, "error": {"Fi_max": 0.05}, **place}

    whole = made_results.fatigue(1.6, 1.7)
    point = {key: whole[key] for key in ("x_m", "y_m", "surface_angle_deg", "tau_amp_Pa", "sigma_n_max_Pa", "sigma1_worst_Pa")}
    return {**whole, "averaged": part(point, 1.1, length_m=1e-5, below=part(point, 1.25, depth_m=9e-6)), **more}


def lines_of(figure):
    return {one.get_label(): one for one in figure.axes[1].lines}


def test_a_figure_over_depth_marks_the_index_of_the_answer_and_says_that_its_line_is_of_points():
    pytest.importorskip("matplotlib")
    found = search_data.DrawnSearch.of(made_results.THERMAL, made_results.result(averaged(), maps(False)))
    shown = lines_of(fatigue_figures.all_figures(FigureStyle(dpi=40), found)["fatigue_depth"]())
    for said, Fi, depth in (("judged, Fi = 1.250 (stresses averaged over 10 µm) at 9 µm", 1.25, 9.0),
                            ("surface, Fi = 1.100 (stresses averaged over 10 µm)", 1.1, 0.0)):
        assert (shown[said].get_xdata(), shown[said].get_ydata()) == (pytest.approx([Fi]), pytest.approx([depth]))
    assert "under the feature, stresses at points" in shown
    rough = {**made_results.fatigue(1.6, 1.7), "rough": True, "statistics": {"p99": 1.2, "error": {"p99": 0.1}}}
    rough["below"] = {**rough["below"], "statistics": {"p99": 1.3, "depth_m": 5e-6, "error": {"p99": 0.1}}}
    found = search_data.DrawnSearch.of(made_results.THERMAL, made_results.result(rough, maps(False)))
    shown = lines_of(fatigue_figures.all_figures(FigureStyle(dpi=40), found)["fatigue_depth"]())
    assert "judged, Fi = 1.30 (99th percentile) at 5 µm" in shown and "surface, Fi = 1.20 (99th percentile)" in shown


@pytest.mark.parametrize("search, first, second", [(SEARCH, "part", "whole"), (averaged(resolved=PART), "search", "resolved")])
def test_the_search_that_decides_comes_first(search, first, second, tmp_path, monkeypatch):
    """The resolved part, unless averaged stresses of the whole passage settle the answer."""
    pytest.importorskip("matplotlib")
    pytest.importorskip("plotly")
    found = search_data.DrawnSearch.of(made_results.THERMAL, made_results.result(search, maps()))
    assert (found.each[0] is found) == (first == "search")
    names = list(fatigue_figures.all_figures(FigureStyle(dpi=40), found))
    monkeypatch.setitem(made_results.EXTRA, "passage_error", KNOWN)
    assert f"fatigue_depth_{second}" in names and set(names) <= set(fatigue_figures.NAMES)
    seen = page(made_results.run(tmp_path / "a.zarr", search=search, found=maps()), tmp_path)
    headings = [one for one in seen.headings if one.startswith("Fatigue")]
    assert headings == ["Fatigue, resolved part", "Fatigue, whole passage"][:: 1 if first == "part" else -1]
    assert f"The answer uses this {first}: " in seen.text and seen.text.count("The answer uses") == 1


def test_a_page_marks_and_lists_the_averaged_index_that_decides(tmp_path, monkeypatch):
    pytest.importorskip("plotly")
    monkeypatch.setitem(made_results.EXTRA, "passage_error", KNOWN)
    seen = page(made_results.run(tmp_path / "a.zarr", search=averaged(), found=maps(False)), tmp_path)
    for figure, axis in (("chain", "x4"), ("over-depth", "x")):
        shown = {one["name"]: one for one in seen.figures[figure]["data"] if one.get("xaxis", "x") == axis and "name" in one}
        mark = shown["below: 1.250 (stresses averaged over 10 µm)"]
        assert (values(mark["x"]), values(mark["y"])) == (pytest.approx([1.25]), pytest.approx([9.0]))
    assert "Lines are of stresses at points; the marks of the index are those of the answer." in seen.text
    marks = [one["name"] for one in seen.figures["index-surface"]["data"] if "Fi = " in one.get("name", "")]
    assert marks == ["largest at points, Fi = 1.60"]
    rows = seen.text[seen.text.index("Numbers and their errors") :]
    assert "9 µm below the surface, largest (stresses averaged over 10 µm)\n1.250\n0.040" in rows
    assert "below it (stresses averaged over 10 µm)" in seen.text[seen.text.index("Critical points") :]
