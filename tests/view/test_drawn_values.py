"""Lines, maps and marks of the figures of a run have the values of the store and of the search, in the unit of their axis."""

import re
from types import SimpleNamespace

import numpy as np
import pytest
from made_figures import Made, drawn, made, searched, title

from tehl_taichi.fatigue.index_statistics import QUANTILES
from tehl_taichi.view.figures import distribution_figure, fatigue_figures, line_figures
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.moments import Moments

pytest.importorskip("matplotlib")
UNITS = {"GPa": 1e9, "MPa": 1e6, "µm": 1e-6, "°C": 1.0}  # in SI
PAGE = FigureStyle(dpi=40)


def unit_of(label):
    """Size of the unit at the end of an axis's label."""
    return UNITS[re.search(r"\(?([^\s(]+)\)?$", label)[1].rstrip(")")]


def test_lines_of_pressure_and_film_are_the_fields_in_the_units_of_their_axes():
    store = made()
    moments = Moments(store)
    for ax, name in zip(drawn("centreline", store).axes, ("pressure", "film")):
        lines = {line.get_label(): line for line in ax.lines}
        for n, (_, label) in moments.several().items():
            x, y = lines[label].get_data()
            np.testing.assert_allclose(x * store.a, store.x)
            np.testing.assert_allclose(y * unit_of(ax.get_ylabel()), store.fields(n, [name])[name][:, moments.line])


def test_maps_are_the_fields_of_their_titles_in_the_units_of_their_colours():
    store = made("ball-on-disc")
    axes = [ax for ax in drawn("maps", store).axes if ax.get_title()]
    for ax, name in zip(axes, ("pressure", "film")):
        image = ax.collections[0]
        places, field = image.get_coordinates(), store.fields(0, [name])[name]
        values = image.get_array().reshape(places.shape[:2]) * unit_of(image.colorbar.ax.get_xlabel() or
                                                                       image.colorbar.ax.get_ylabel())
        assert ax.get_title() == name
        for j, i in ((0, 3), (-1, 5), (20, 7)):
            x, y = places[j, i] * store.a
            m, n = np.argmin(np.abs(store.x - x)), np.argmin(np.abs(store.y - abs(y)))  # a half domain
            assert values[j, i] == pytest.approx(field[m, n]), (name, x, y)


def test_colours_that_are_cut_have_their_arrow_at_that_end():
    from matplotlib.figure import Figure

    from tehl_taichi.view.figures.map_panels import bar, shade

    x = np.linspace(0, 1, 5)
    for ends, said in (((0.2, 2.0), "min"), ((-1.0, 0.8), "max"), ((0.2, 0.8), "both"), ((0.0, 1.0), "neither")):
        figure = Figure()
        image = shade(figure.subplots(), x, x, np.tile(x[:, None], 5), vmin=ends[0], vmax=ends[1])
        assert bar(figure, image, figure.axes[0], "").extend == said


def test_an_ellipse_tells_its_half_axis_and_is_shown_whole():
    store = made("ball-bearing")
    figure = drawn("maps", store)
    whole = [ax for ax in figure.axes if ax.get_title()][1]
    assert whole.get_xlim() == pytest.approx((-1.25 * store.b / store.a, 1.25 * store.b / store.a), rel=0.01)
    assert f"(b = {store.b / store.a:.3g} a)" in whole.get_xlabel() and store.b > 2 * store.a


def test_profiles_across_the_film_are_those_of_their_places():
    """Temperatures that grow with x, and with z from surface a."""
    store, zeta = Made(made().scene), np.linspace(0, 1, 5)
    store.map = lambda name: zeta if name == "zeta" else None
    store.fields = lambda n, names: {"temperature": (store.x[:, None, None] / store.a) + 10 * zeta + 0 * store.y[None, :, None]}
    moments = SimpleNamespace(store=store, x=store.x / store.a, line=0, half=True, one=lambda: 2, says=lambda n: "there",
                              named="gear")
    ax = line_figures.profiles(PAGE, moments).axes[0]
    step = np.diff(moments.x[:2]).item()
    for line in ax.lines:
        X = float(re.search(r"x = (\S+) a", line.get_label())[1])
        assert line.get_xdata()[0] == pytest.approx(X, abs=step) and list(line.get_ydata()) == list(zeta)
    assert len(ax.lines) == len(line_figures.ACROSS) and ax.get_ylabel().startswith("z / h (0: surface a")


def worst(found):
    """Panels of the critical points."""
    return fatigue_figures.all_figures(PAGE, found)["fatigue_point"]().axes


def test_stresses_of_the_critical_point_are_over_the_position_in_half_widths():
    from tehl_taichi.fatigue.findley import shear_path

    found = searched()
    history, (left, right) = found.result.worst, worst(found)[:2]
    dip, strike, normal = shear_path(history["stress"], history["normal"])
    across = next(line for line in left.lines if "normal to" in line.get_label())
    np.testing.assert_allclose(across.get_xdata() * found.a, history["x_a"][:-1])
    np.testing.assert_allclose(across.get_ydata() * 1e6, normal[:-1], atol=1.0)
    np.testing.assert_allclose(np.array(right.lines[0].get_data()) * 1e6, [dip, strike], atol=1.0)
    assert right.get_title() == f"τ_amp = 100, σ_n,max = {normal.max() / 1e6:.3g} MPa" and normal.max() > -normal.min() / 2


def test_marks_and_the_smooth_contact_are_at_their_depths():
    """The hill lies at x = 20 µm; the worst point is moved aside of it."""
    def arrays(found):
        found.numbers["below"]["y_m"] = -3e-5
        return {"findley_stress_under_row": found.findley_stress_at_depth[:, :, 5],
                "findley_stress_contact_alone": np.array([1.0, 2.0, 3.0]) * 1e8}

    found = searched(arrays=arrays)
    section, over = fatigue_figures.all_figures(PAGE, found)["fatigue_depth"]().axes[:2]
    deep, = (line.get_xydata()[0] for line in section.lines if line.get_marker() == "+")
    assert deep == pytest.approx([20.0, 60.0])
    lines = {line.get_label(): line.get_xydata() for line in over.lines}
    np.testing.assert_allclose(lines["smooth contact"], [[0.25, 0.0], [0.5, 20.0], [0.75, 60.0]])
    assert next(at for label, at in lines.items() if label.startswith("largest"))[0] == pytest.approx([1.5, 60.0])
    assert "σ_eF = 400 MPa" in title(SimpleNamespace(get_suptitle=lambda: found.constants))


def test_percentiles_lie_where_that_share_of_the_surface_is_above_them(monkeypatch):
    values = np.linspace(0.1, 2.0, 400)
    numbers = {"statistics": {name: float(np.quantile(values, level)) for name, level in QUANTILES.items()}}
    monkeypatch.setattr(distribution_figure, "curves", lambda result: [("surface a", values, 1 - np.linspace(0, 1, 400))])
    found = SimpleNamespace(result=SimpleNamespace(by_surface={}, numbers=numbers), constants="")
    line, *dots = distribution_figure.distribution_figure(PAGE, found).axes[0].lines
    for dot in dots[:len(QUANTILES)]:
        (Fi,), (share,) = dot.get_data()
        assert share == pytest.approx(np.interp(Fi, *line.get_data()), abs=0.5)
