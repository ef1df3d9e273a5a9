"""What pages and figures show where a grid does not resolve every pressure: first the part on which the answer rests."""

import made_results
import numpy as np
import pytest
from made_figures import searched, title, titles
from read_pages import numbers, page

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
