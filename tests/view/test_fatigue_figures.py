"""Figures of a fatigue search, which is made up: depths, digits, lines and what explains them."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
from made_figures import legend, searched, title, titles

from tehl_taichi.errors import SceneError
from tehl_taichi.view.figures import distribution_figure, fatigue_figures, palette
from tehl_taichi.view.figures.figure_style import FigureStyle

matplotlib = pytest.importorskip("matplotlib")


def middle_row(found):
    """Stresses below the middle row of layers."""
    return {"findley_stress_under_row": found.findley_stress_at_depth[:, :, 5]}


def test_fatigue_is_shown_at_the_depth_that_is_wanted():
    def layers(**depth):
        page = FigureStyle(dpi=40)
        figure = fatigue_figures.all_figures(page, searched(**depth))["fatigue"]()
        images = [ax.collections[0] for ax in figure.axes if ax.get_title()]
        return [(image.get_array().max(), image.colorbar.ax.get_xlabel(), image.axes.get_title()) for image in images]

    top, worst = layers()
    assert top[0] == pytest.approx(1.0) and worst[0] == pytest.approx(1.5)
    assert worst[1:] == ("Fi, 60 µm below", "largest, Fi = 1.50, plane at 50° to the surface")
    assert layers(depth=25.0)[1] == (pytest.approx(0.5), "Fi, 20 µm below", "largest, Fi = 0.50")
    line = fatigue_figures.all_figures(FigureStyle(), searched(True, depth=60.0))["fatigue"]().axes[0].lines
    assert [one.get_ydata().max() for one in line] == pytest.approx([1.0, 1.0, 1.5, 1.5])


def test_an_index_has_the_digits_that_its_error_leaves_and_stresses_have_no_exponent():
    from tehl_taichi.view.figures.index_text import index_text, mpa

    assert [index_text(1.64529, error) for error in (None, 0.023, 0.3, 40.0, float("nan"))] == ["1.65", "1.645", "1.65", "2",
                                                                                             "1.65"]
    assert index_text(2.4988e11) == "2.5e+11"  # of a Newtonian film
    assert [mpa(stress) for stress in (1.254e9, 31.96e6, -730.9e6, 0.0)] == ["1250", "32", "-731", "0"]
    found = searched()
    found.summary["error"] = {"Fi_max": 0.004}
    figures = fatigue_figures.all_figures(FigureStyle(dpi=40), found)
    assert "largest, Fi = 1.0000, plane at 50° to the surface" in titles(figures["fatigue"]())
    found = dataclasses.replace(found, result=dataclasses.replace(found.result, **middle_row(found.result)))
    depth = fatigue_figures.all_figures(FigureStyle(dpi=40), found)["fatigue_depth"]()
    assert {"largest, Fi = 1.50 at 60 µm", "surface, Fi = 1.0000"} <= set(legend(depth))


def test_the_lines_on_maps_of_the_index_are_explained():
    from matplotlib.colors import to_hex

    def lines(Fi):
        found = searched(arrays=lambda found: {"Fi": Fi * found.Fi, "findley_stress_at_depth": None})
        figure = fatigue_figures.all_figures(FigureStyle(dpi=40), found)["fatigue"]()
        return figure, [one for one in figure.axes[0].collections if isinstance(one, matplotlib.contour.ContourSet)]

    below, none = lines(0.9)
    said = "findley, κ = 0.3, σ_eF = 400 MPa; blue line: trace of the critical plane (at 0° it lies in the surface)"
    assert not none and title(below) == f"made up: {said}"
    above, (limit,) = lines(3.0)
    assert title(above) == f"made up: {said}, white line: Fi = 1"
    radius = np.hypot(*(limit.get_paths()[0].vertices - [20.0, 0.0]).T)  # hill: 3 exp(-r^2 / 1e-9)
    assert radius == pytest.approx(1e6 * np.sqrt(1e-9 * np.log(3.0)), rel=0.08)
    assert to_hex(limit.get_edgecolor()[0]) == palette.LIMIT


@pytest.mark.parametrize("width", [8.5, 17.0])
def test_both_panels_of_the_depth_have_numbers_at_their_axis(width):
    found = searched(arrays=middle_row)
    page = FigureStyle(width=width)
    with page.style():
        figure = page.fitted(fatigue_figures.all_figures(page, found)["fatigue_depth"]())
        figure.get_layout_engine().execute(figure)
    for ax in figure.axes[:2]:
        assert ax.get_ylabel() == "below the surface (µm)" and ax.get_ylim() == (60.0, 0.0)
        assert any(label.get_text() and label.get_visible() for label in ax.get_yticklabels())
    over, bar = figure.axes[1], figure.axes[0].collections[0].colorbar.ax
    label = (bar.xaxis if width > 12 else bar.yaxis).label  # away from the other panel's axis
    assert label.get_text() == "Fi at y = 0 µm" and not label.get_window_extent().overlaps(over.get_tightbbox())
    assert "Fi = 1" in legend(figure)


def test_a_section_has_its_depths_from_the_surface_down():
    """The hill lies at x = 20 µm; it is highest at 60 µm and lowest at 20 µm."""
    found = searched(arrays=middle_row)
    mesh = fatigue_figures.all_figures(FigureStyle(), found)["fatigue_depth"]().axes[0].collections[0]
    places = mesh.get_coordinates()
    Fi, depth = mesh.get_array().reshape(places.shape[:2]), places[:, 0, 1]
    np.testing.assert_allclose(places[0, Fi.argmax(axis=1), 0], 20.0)
    over = Fi.max(axis=1)
    np.testing.assert_allclose(over, np.interp(depth, [0.0, 20.0, 60.0], [1.0, 0.5, 1.5]), rtol=1e-6)


def test_the_trace_of_a_plane_lies_in_it():
    """Normal to its normal, through the worst point."""
    normal = np.array([0.36, 0.48, 0.8])
    found = searched(arrays=lambda found: {"worst": {**found.worst, "normal": normal}})
    lines = fatigue_figures.all_figures(FigureStyle(dpi=40), found)["fatigue"]().axes[0].lines
    ends = next(line.get_xydata() for line in lines if len(line.get_xydata()) == 2)
    assert (ends[1] - ends[0]) @ normal[:2] == pytest.approx(0.0, abs=1e-9) and ends.mean(axis=0) == pytest.approx([20.0, 0.0])


def test_the_share_above_an_index_holds_up_to_the_next_one(monkeypatch):
    values, share = np.array([0.5, 1.0, 2.0]), np.array([0.6, 0.2, 0.0])
    monkeypatch.setattr(distribution_figure, "curves", lambda result: [("surface a", values, share)])
    numbers = {"statistics": dict.fromkeys(distribution_figure.QUANTILES, 1.0)}
    found = SimpleNamespace(result=SimpleNamespace(by_surface={}, numbers=numbers), constants="")
    line = distribution_figure.distribution_figure(FigureStyle(), found).axes[0].lines[0]
    assert np.interp([0.7, 1.5], *line.get_path().vertices.T) == pytest.approx([60.0, 20.0])


def test_a_worst_point_at_the_rim_leaves_no_white_around_the_map():
    maps = [ax for ax in fatigue_figures.all_figures(FigureStyle(), searched(y_worst=1e-4))["fatigue"]().axes if ax.get_title()]
    assert {ax.get_ylim() for ax in maps} == {(-100.0, 100.0)} == {ax.get_xlim() for ax in maps}


@pytest.mark.parametrize("depth", [70.0, -1.0])
def test_a_depth_that_was_not_searched_is_refused(depth):
    with pytest.raises(SceneError, match=f"depth = {depth:g} µm is out of range; allowed: at least 0 µm and at most 60 µm"):
        fatigue_figures.all_figures(FigureStyle(), searched(depth=depth))
    found = searched(depth=20.0, arrays=lambda found: {"findley_stress_at_depth": None})
    with pytest.raises(SceneError, match="tehl fatigue STORE --depths 2e-05"):
        fatigue_figures.all_figures(FigureStyle(), found)


def test_a_plane_that_is_not_at_the_worst_depth_has_its_own_mark():
    """The worst depth is looked for once more under the row of what is worst in the plane, which then lies beside it."""
    plane = np.roll(searched().result.findley_stress_at_depth[1], -4, axis=0)
    found = searched(arrays=lambda found: {"findley_stress_at_depth": None, "findley_stress_at_worst_depth": plane,
                                           "worst_depth": np.array([5e-5])})
    x = found.result.feature_frame_x
    ax = [ax for ax in fatigue_figures.all_figures(FigureStyle(dpi=40), found)["fatigue"]().axes if ax.get_title()][1]
    assert ax.get_title() == "largest, Fi = 0.50" and ax.collections[0].colorbar.ax.get_xlabel() == "Fi, 50 µm below"
    assert ax.lines[0].get_xdata() == pytest.approx([1e6 * x[np.unravel_index(plane.argmax(), plane.shape)[0]]])
