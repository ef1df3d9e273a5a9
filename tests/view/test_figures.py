"""Figures of a store: what they name, how they are laid out and coloured. The store is made up: nothing is solved."""

import base64
import re

import numpy as np
import pytest
from made_figures import Made, drawn, legend, made, searched, title

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures import fatigue_figures, palette
from tehl_taichi.view.figures.field_maps import film_ends
from tehl_taichi.view.figures.figure_style import INCH, FigureStyle
from tehl_taichi.view.figures.line_figures import SURFACES
from tehl_taichi.view.figures.moments import Moments

matplotlib = pytest.importorskip("matplotlib")


def all_drawn(page, built_in):
    """Every figure of a run and of a search."""
    flat = scene(built_in).rows == 0
    names = ("surface", "centreline", "temperature") + (() if flat else ("centreline_y", "maps", "temperature_maps"))
    with page.style():
        for name in names:
            yield page.fitted(drawn(name, made(built_in), page))
        for draw in fatigue_figures.all_figures(page, searched(flat)).values():
            yield page.fitted(draw())


@pytest.mark.parametrize("built_in, name, width", [("ball-on-disc", "maps", 17.0), ("ball-on-disc", "temperature_maps", 8.5),
                                                   ("gear", "temperature_maps", 17.0)])
def test_maps_leave_no_part_of_the_page_empty(tmp_path, name, built_in, width):
    import matplotlib.image

    page = FigureStyle(dpi=60, width=width)
    path = page.save(lambda: drawn(name, made(built_in), page), tmp_path / "map.png")
    shown = matplotlib.image.imread(path)[..., :3].min(axis=2)
    assert shown.shape[1] == int(width / INCH * 60)
    for direction, most in ((0, 0.13), (1, 0.09)):
        used = np.flatnonzero(shown.min(axis=direction) < 0.95)
        gaps = np.diff(np.concatenate([[0], used, [shown.shape[1 - direction] - 1]]))
        assert gaps.max() <= most * shown.shape[1 - direction], (direction, gaps.max(), shown.shape)


@pytest.mark.parametrize("built_in, width", [("gear", 8.5), pytest.param("gear", 17.0, marks=pytest.mark.slow),
                                             pytest.param("furrow-line", 8.5, marks=pytest.mark.slow)])
def test_text_can_be_read_and_stays_on_the_page(built_in, width):
    for figure in all_drawn(FigureStyle(width=width), built_in):
        figure.get_layout_engine().execute(figure)
        for text in figure.findobj(matplotlib.text.Text):
            if text.get_visible() and text.get_text():
                assert 6 <= text.get_fontsize() <= 10
        inside = figure.get_tightbbox()
        assert inside.x0 > -0.05 and inside.x1 < width / INCH + 0.05, figure.get_suptitle()
        assert inside.y0 > -0.05 and inside.y1 < figure.get_size_inches()[1] + 0.05, figure.get_suptitle()


def test_a_steady_run_is_no_start_and_figures_name_scene_and_moment():
    for name, what in (("maps", "pressure and film"), ("temperature_maps", "temperatures")):
        (*_, middle, last), whose = made().scalar("p_max_Pa") / 1e9, "; surface a carries the feature" * (name != "maps")
        assert title(drawn(name, made("ball-on-disc"))) == f"ball-on-disc: {what}, steady, p_max 5.78 GPa"
        said = f"feature at +0.00 a, p_max {middle:.2f} GPa ({last:.2f} at +0.80 a)"
        assert title(drawn(name, made())) == f"gear: {what}, {said}{whose}"
        assert title(drawn(name, made(), at=0.7)) == f"gear: {what}, feature at +0.80 a, p_max {last:.2f} GPa{whose}"
    assert title(drawn("centreline", made("ball-on-disc"))) == "ball-on-disc: along y = 0, steady"
    assert title(drawn("centreline", made("smooth-line"))) == "smooth-line: along x, steady"
    begun = made()
    begun.steps = 1
    assert "steady start" not in drawn("maps", begun).get_suptitle()


@pytest.mark.parametrize("name", ["centreline", "centreline_y", "maps", "temperature", "temperature_maps"])
@pytest.mark.parametrize("built_in", ["gear", "ball-on-disc"])
def test_axes_in_half_widths_come_with_their_length(name, built_in):
    """Which is the stored length over the drawn number."""
    store = made(built_in)
    figure = drawn(name, store)
    (said,) = re.findall(r"\(a = ([\d.]+) mm\)", " ".join(figure.get_suptitle().split()))
    ax = figure.axes[0]
    drawn_x = np.asarray(ax.lines[0].get_xdata() if ax.lines else ax.collections[0].get_coordinates()[0, :, 0])
    along = store.y if name == "centreline_y" else store.x
    assert np.isclose(np.abs(drawn_x).max() * float(said) * 1e-3, np.abs(along).max(), rtol=5e-3) or np.isclose(
        np.diff(drawn_x).mean() * float(said) * 1e-3, np.diff(along).mean(), rtol=5e-3)


def test_figures_in_a_notebook_have_their_size():
    """Of the picture, so that a page keeps room for it."""
    from io import BytesIO

    import matplotlib.image

    from tehl_taichi.view.figures.notebook_figures import Figures

    figures = Figures({"maps": drawn("maps", made())}, 50)
    ((wide, high, packed),) = re.findall(r'width="(\d+)" height="(\d+)".*base64,([^"]+)"', figures._repr_html_())
    shape = matplotlib.image.imread(BytesIO(base64.b64decode(packed))).shape
    assert abs(int(high) - shape[0]) <= 1 and abs(int(wide) - shape[1]) <= 1


def test_lines_along_y_pass_through_the_largest_pressure_of_each_moment():
    """Of a half domain with its mirror image; of a steady one at x = 0."""
    store = made()
    figure = drawn("centreline_y", store)
    top, low = figure.axes
    shown = Moments(store).several()
    for (n, _), line, film in zip(shown.items(), top.lines, low.lines):
        fields = store.fields(n, ["pressure", "film"])
        column = int(np.argmax(fields["pressure"].max(axis=1))) if n else int(np.argmin(np.abs(store.x)))
        half = store.y.size - 1
        assert line.get_ydata()[half:] == pytest.approx(fields["pressure"][column] / 1e9)
        assert film.get_ydata()[half::-1] == pytest.approx(fields["film"][column] * 1e6)
        assert f"x = {store.x[column] / Moments(store).a:+.2f} a" in line.get_label()
    assert title(figure) == "gear: along y, through the largest pressure of each moment"
    assert title(drawn("centreline_y", made("ball-on-disc"))) == "ball-on-disc: along y"


def test_a_larger_pressure_elsewhere_is_told_where_it_reads_as_another():
    store, nearly = made(), made()
    assert Moments(store).peak(2).endswith(" at +0.80 a)")
    grown = store.fields(2, ["pressure"])["pressure"]
    nearly.fields = lambda n, names: {"pressure": grown * (1 + 1e-6 * (n == 3))}
    assert Moments(nearly).worst == 3 and "(" not in Moments(nearly).peak(2)


def test_lines_on_the_whole_domain_go_through_the_largest_pressure():
    store = Made(made().scene, whole=True)
    n, row = 2, 3  # the feature at 0, y = -a/2
    assert store.y[row] == pytest.approx(-store.a / 2) and Moments(store).worst == n and Moments(store).row == 6
    figure, said = drawn("centreline", store), f"along y = {-store.a / 2 * 1e6:.0f} µm, through the largest pressure"
    shown = figure.axes[0].lines[2].get_ydata()
    assert title(figure) == f"gear: {said}"
    assert shown == pytest.approx(store.fields(n, ["pressure"])["pressure"][:, row] / 1e9) and shown.max() > 13
    assert title(drawn("temperature", store)) == f"gear: temperatures {said}; surface a carries the feature"
    store.steps = 1  # smooth surfaces: the middle
    assert Moments(store).line == 6 and Moments(store).along == "along y = 0"


def test_one_moment_is_shown_where_it_is_wanted():
    for name in ("centreline", "temperature"):
        found = [text for text in legend(drawn(name, made(), at=-0.7)) if "surface" not in text and "film" not in text]
        assert found == ["steady start", "feature at -0.80 a"]
    top = drawn("centreline", made(), at=0.8).axes[0].lines
    assert top[1].get_ydata().min() == pytest.approx(made().fields(3, ["pressure"])["pressure"][:, 0].min() / 1e9)


@pytest.mark.parametrize("at, p, added", [
    (0.4, 1.01, True),    # between the positions
    (0.75, 1.2, True),    # beside one of them, which has much less
    (0.75, 1.02, False),  # the same peak
    (0.8, 1.2, False)])   # one of them
def test_the_moment_of_the_largest_pressure_is_never_missed(at, p, added):
    store = made()
    store.at, store.steps = np.array([-1.6, -0.8, 0.0, 0.8] + [at] * (at != 0.8)) * store.a, 4 + (at != 0.8)
    plain = store.fields
    most = plain(3, ["pressure"])["pressure"]
    store.fields = lambda n, names: plain(min(n, 3), names) | ({"pressure": most * p} if n == store.steps - 1 else {})
    for name in ("centreline", "temperature"):
        lines = {text: line.get_color() for text, line in legend(drawn(name, store)).items()}
        said = f"largest pressure: feature at {at:+.2f} a"
        assert (said in lines) is added and "feature at +0.80 a" in lines
        assert not added or lines[said] == palette.LINES[3]
    assert not any("largest" in text for text in legend(drawn("centreline", store, at=0.8)))


def test_a_long_legend_takes_no_height_from_the_panel():
    from matplotlib.lines import Line2D

    def panel(labels):
        page = FigureStyle(width=8.5)
        with page.style():
            figure, ((ax,),) = page.figure()
            page.legend(figure, [Line2D([], [], label=f"{'a long label' * 4} {n}") for n in range(labels)])
            figure.get_layout_engine().execute(figure)
        return ax.get_position().height * figure.get_figheight()

    assert panel(8) == pytest.approx(panel(4), rel=0.05)


def test_the_film_colours_that_are_cut_end_in_an_arrow():
    images = [ax.collections[0] for ax in drawn("maps", made()).axes if ax.get_title()]
    assert [image.colorbar.extend for image in images] == ["neither", "max"]
    film = images[1]
    assert film.get_clim()[1] < film.get_array().max() and film.get_clim()[1] == pytest.approx(0.2 * 5.34, rel=0.01)


def test_the_film_has_the_colours_of_its_own_range_inside_the_contact():
    """From the smallest film to the largest inside 0.9 of the ellipse: the gap outside does not take the colours."""
    store = made("ball-on-disc")
    film, s = store.fields(0, ["film"])["film"] * 1e6, Scales.of(store.scene)
    inside = np.hypot(store.x[:, None] / s.a, store.y / s.b) < 0.9
    shown = [ax.collections[0] for ax in drawn("maps", store).axes if ax.get_title() == "film"][0]
    assert shown.get_clim() == pytest.approx((film.min(), film[inside].max())) and film[inside].max() < 0.8 * film.max()


def test_the_film_inside_an_ellipse_reaches_as_far_as_its_half_axes():
    """A film that grows from the middle along y alone."""
    ball = scene("ball-on-disc")
    wide = Made(ball.replace(**{"contact.kind": "elliptic", "contact.radius_y": 4 * ball.contact.radius_x}))
    assert wide.b > 2 * wide.a
    film = np.abs(wide.y) / wide.b + 0 * wide.x[:, None]
    step = np.diff(wide.y[:2]) / wide.b
    assert film_ends(Moments(wide), film) == (0.0, pytest.approx(0.9, abs=step.item()))


def test_temperatures_of_a_surface_bear_its_name():
    assert {text[-1]: name[-1] for name, text, _ in SURFACES[1:]} == {"a": "a", "b": "b"}
    store = made("gear")
    ax, lines = drawn("temperature", store, at=0.0).axes[0], {}
    for name, _, style in SURFACES:
        lines[style] = store.fields(Moments(store, 0.0).one(), [name])[name][:, Moments(store).line]
    for line in ax.lines[-3:]:
        np.testing.assert_allclose(line.get_ydata(), lines[line.get_linestyle()])


def test_a_wide_ellipse_lies_on_its_side_with_its_middle_below():
    """Its long axis to the right, x downwards, as seen from above; the middle within 1.5 a, in the colours of the whole."""
    store, b = made("ball-bearing"), 9.37
    for name, count in (("maps", 2), ("temperature_maps", 3)):
        axes = [ax for ax in drawn(name, store).axes if ax.get_title()]
        whole, middle = axes[:count], axes[count:]
        assert [ax.get_title() for ax in middle] == [f"{ax.get_title()}, middle" for ax in whole] and len(middle) == count
        for ax, side in ((whole[0], 1.25 * b), (middle[0], 1.5)):
            assert ax.get_xlim() == pytest.approx((-side, side), rel=0.01) and ax.get_ylim()[0] > 0 > ax.get_ylim()[1]
        assert all(a.collections[0].get_clim() == m.collections[0].get_clim() for a, m in zip(whole, middle))
        values = middle[0].collections[0].get_array()
        first = store.fields(0, ["pressure" if name == "maps" else "temperature_mid"])
        at_inlet = next(iter(first.values()))[np.searchsorted(store.x / store.a, -1.6), 0] * (1e-9 if name == "maps" else 1.0)
        assert values.reshape(-1)[values.size // 2 % values.shape[-1]] == pytest.approx(at_inlet, rel=0.1)
    assert len([ax for ax in drawn("maps", made("ball-on-disc")).axes if ax.get_title()]) == 2


def test_both_surfaces_have_one_scale_of_colours_and_the_film_its_own():
    hot = made()
    fields = hot.fields
    hot.fields = lambda n, names: {name: (9 if "mid" in name else 1) * values for name, values in fields(n, names).items()}
    film, *bodies = [ax.collections[0] for ax in drawn("temperature_maps", hot).axes if ax.get_title()]
    assert len({image.cmap.name for image in (film, *bodies)}) == 1
    a, b = (image.get_clim() for image in bodies)
    assert a == b and all(a[0] <= image.get_array().min() and image.get_array().max() <= a[1] for image in bodies)
    assert film.get_clim()[1] > 5 * a[1] and film.get_array().max() <= film.get_clim()[1]


def test_one_moment_has_one_colour_in_every_figure():
    def colour_of(figure):
        return {name: line.get_color() for name, line in legend(figure).items() if line.get_color() != palette.BLACK}

    first, second = (colour_of(drawn(name, made())) for name in ("centreline", "temperature"))
    assert first == second and len(set(first.values())) == 4 and first["steady start"] == palette.GREY


# Machado, Oliveira & Fernandes 2009: linear RGB as seen with deuteranopia and with protanopia
BLIND = ([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
         [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]])


def lab(rgb, seen=None):
    """CIE L*a*b* of colours, (..., 3), as somebody sees them."""
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    linear = linear if seen is None else np.clip(linear @ np.transpose(seen), 0, 1)
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    t = linear @ np.transpose(to_xyz) / [0.9505, 1.0, 1.089]
    f = np.where(t > 0.008856, np.cbrt(t), 7.787 * t + 16 / 116)
    return np.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], axis=-1)


def test_colour_blind_readers_tell_the_lines_apart_and_everybody_reads_the_maps_in_grey():
    from matplotlib.colors import to_rgb

    lines = np.array([to_rgb(colour) for colour in palette.LINES])
    for seen in (None, *BLIND):
        apart = np.linalg.norm(lab(lines, seen)[:, None] - lab(lines, seen)[None], axis=2)
        assert apart[~np.eye(len(lines), dtype=bool)].min() > 10
    for name in (palette.PRESSURE, palette.FILM, palette.TEMPERATURE, palette.INDEX, palette.RESULT, palette.TENSION,
                 palette.HEIGHT):
        light = np.diff(lab(matplotlib.colormaps[name](np.linspace(0, 1, 64))[:, :3])[:, 0])
        assert (light > 0).all() or (light < 0).all(), name


@pytest.mark.parametrize("built_in, at, said", [("gear", 1.2, "at = 1.2 a is out of range; allowed: at least -0.85 a"),
                                                ("ball-on-disc", 0.0, "made.zarr has only a steady state")])
def test_moments_that_never_were_are_refused(built_in, at, said):
    with pytest.raises(SceneError, match=said):
        Moments(made(built_in), at)
