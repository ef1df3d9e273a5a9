"""Figures of a store: what they name, how they are laid out and coloured. The store is made up: nothing is solved."""

import re

import numpy as np
import pytest
from small_stores import store

from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.figures import fatigue_figures, palette
from tehl_taichi.figures.moments import Moments
from tehl_taichi.figures.page import INCH, Page
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

matplotlib = pytest.importorskip("matplotlib")


class Made:
    """A store of made-up smooth fields, thermal: a steady start, and the feature at three places if the scene has one; on the
    whole domain the pressure is largest at y = -a/2, where the feature is at 0."""

    def __init__(self, description, whole=False):
        a = self.a = Scales.of(description).a
        self.scene, self.stored, self.path = description, {}, "made.zarr"
        self.x = np.linspace(description.grid.x_min, description.grid.x_max, 33) * a
        self.y = np.linspace(-whole, 1, 13) * description.grid.y_max * a if description.rows else np.zeros(1)
        self.at = np.array([-1.6, -0.8, 0.0, 0.8] if description.transient else [np.nan]) * a
        self.steps = len(self.at)

    def __len__(self):
        return self.steps

    def scalar(self, name):
        if name == "p_max_Pa":
            return np.array([self.fields(n, ["pressure"])["pressure"].max() for n in range(self.steps)])
        return self.at if name == "feature_x" else np.full(self.steps, 0.4e-6)

    def fields(self, n, names):
        X, Y = np.meshgrid(self.x / self.x[-1], self.y / (self.y[-1] or 1), indexing="ij")
        size = {"pressure": 1e9, "film": 0.2e-6}
        values = n + 2 + X**2 + Y**2
        if self.y[0] < 0:
            values = values + 9 * (n == 2) * np.exp(-100 * (self.x[:, None] ** 2 + (self.y + self.a / 2) ** 2) / self.a**2)
        return {name: values * size.get(name, 40.0 + len(name)) for name in names}

    def map(self, name):
        return None


def made(name="gear"):
    return Made(scene(name).replace(**{"thermal.on": True}))


def searched(one_row=False, y_worst=0.0, **depth):
    """What a search of the surface and of two depths found: a hill of Fi at each, highest at 60 um."""
    x, y = np.linspace(-1e-4, 1e-4, 21), np.zeros(1) if one_row else np.linspace(-1e-4, 1e-4, 11)
    hill = np.exp(-((x[:, None] - 2e-5) ** 2 + y**2) / 1e-9) * 4e8
    layers = np.stack([hill, 0.5 * hill, 1.5 * hill])
    numbers = {"x_m": 2e-5, "y_m": y_worst, "surface_angle_deg": 50.0}
    summary = {**numbers, "Fi_max": 1.0, "sigma_eF_Pa": 4e8, "kappa_F": 0.3, "criterion": "findley",
               "below": {**numbers, "Fi_max": 1.5, "depth_m": 6e-5}}
    turn = np.linspace(0, 2 * np.pi, 30)
    history = {"x_a": np.linspace(-5e-4, 5e-4, 30), "normal": np.array([0.6, 0.0, 0.8]), "circle": (0.0, 0.0, 1e8),
               "stress": np.outer(np.sin(turn), [1e8, 0, 2e8, 0, 5e7, 0])}
    maps = {"feature_frame_x": x, "feature_frame_y": y, "Fi": hill / 4e8, "fatigue_depth": np.array([0.0, 2e-5, 6e-5])}
    maps |= {"findley_stress_under_row": layers[:, :, 0]} if one_row else {"findley_stress_at_depth": layers}
    return fatigue_figures.Found("made up", maps, {"surface": history, "below": history}, summary, 3.6e-4, "x (µm)", **depth)


def drawn(name, store, page=None, at=None):
    """One of the figures of a run."""
    from tehl_taichi.figures import field_maps, line_figures, surface_figure

    draw = next(getattr(room, name) for room in (field_maps, line_figures, surface_figure) if hasattr(room, name))
    return draw(page or Page(), Moments(store, at))


def all_drawn(page, built_in):
    """Every figure of a run and of a search."""
    flat = scene(built_in).rows == 0
    names = ("surface", "centreline", "temperature") + (() if flat else ("maps", "temperature_maps"))
    with page.style():
        for name in names:
            yield page.fitted(drawn(name, made(built_in), page))
        for draw in fatigue_figures.all_figures(page, searched(flat)).values():
            yield page.fitted(draw())


def title(figure):
    """That of the whole, in one line."""
    return " ".join(figure.get_suptitle().split())


def titles(figure):
    return [figure.get_suptitle()] + [ax.get_title() for ax in figure.axes]


def legend(figure):
    """{label: line} of all legends."""
    found = figure.legends + [ax.get_legend() for ax in figure.axes if ax.get_legend()]
    return {line.get_label(): line for one in found for line in one.get_lines()}


@pytest.mark.parametrize("built_in, name, width", [("ball-on-disc", "maps", 17.0), ("ball-on-disc", "temperature_maps", 8.5),
                                                   ("gear", "temperature_maps", 17.0)])
def test_maps_leave_no_part_of_the_page_empty(tmp_path, name, built_in, width):
    import matplotlib.image

    page = Page(dpi=60, width=width)
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
    for figure in all_drawn(Page(width=width), built_in):
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
        assert drawn(name, made("ball-on-disc")).get_suptitle() == f"ball-on-disc: {what}, steady, p_max 5.78 GPa"
        said = f"feature at +0.00 a, p_max {middle:.2f} GPa ({last:.2f} at +0.80 a)"
        assert title(drawn(name, made())) == f"gear: {what}, {said}{whose}"
        assert title(drawn(name, made(), at=0.7)) == f"gear: {what}, feature at +0.80 a, p_max {last:.2f} GPa{whose}"
    assert drawn("centreline", made("ball-on-disc")).get_suptitle() == "ball-on-disc: along y = 0, steady"
    assert drawn("centreline", made("smooth-line")).get_suptitle() == "smooth-line: along x, steady"
    begun = made()
    begun.steps = 1
    assert "steady start" not in drawn("maps", begun).get_suptitle()


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
        page = Page(width=8.5)
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
    assert film.get_clim()[1] < film.get_array().max() and film.get_clim()[1] == pytest.approx(1.1 * 0.2 * 4.81, rel=0.1)
    temperature = [ax.collections[0] for ax in drawn("temperature_maps", made()).axes if ax.get_title()]
    assert len({image.get_clim() for image in temperature}) == 1 == len({image.cmap.name for image in temperature})


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


def test_fatigue_is_shown_at_the_depth_that_is_wanted():
    def layers(**depth):
        page = Page(dpi=40)
        figure = fatigue_figures.all_figures(page, searched(**depth))["fatigue"]()
        images = [ax.collections[0] for ax in figure.axes if ax.get_title()]
        return [(image.get_array().max(), image.colorbar.ax.get_xlabel(), image.axes.get_title()) for image in images]

    top, worst = layers()
    assert top[0] == pytest.approx(1.0) and worst[0] == pytest.approx(1.5)
    assert worst[1:] == ("Fi, 60 µm below", "worst, Fi = 1.50, plane at 50° to the surface")
    assert layers(depth=25.0)[1] == (pytest.approx(0.5), "Fi, 20 µm below", "worst, Fi = 0.50")
    line = fatigue_figures.all_figures(Page(), searched(True, depth=60.0))["fatigue"]().axes[0].lines
    assert [one.get_ydata().max() for one in line] == pytest.approx([1.0, 1.0, 1.5, 1.5])


def test_an_index_has_the_digits_that_its_error_leaves_and_stresses_have_no_exponent():
    from tehl_taichi.figures.index_words import mpa, told_index

    assert [told_index(1.64529, error) for error in (None, 0.023, 0.3, 40.0, float("nan"))] == ["1.65", "1.645", "1.65", "2",
                                                                                             "1.65"]
    assert told_index(2.4988e11) == "2.5e+11"  # of a Newtonian film
    assert [mpa(stress) for stress in (1.254e9, 31.96e6, -730.9e6, 0.0)] == ["1250", "32", "-731", "0"]
    found = searched()
    found.summary["error"] = {"Fi_max": 0.004}
    figures = fatigue_figures.all_figures(Page(dpi=40), found)
    assert "worst, Fi = 1.0000, plane at 50° to the surface" in titles(figures["fatigue"]())
    found.maps["findley_stress_under_row"] = found.maps["findley_stress_at_depth"][:, :, 5]
    depth = fatigue_figures.all_figures(Page(dpi=40), found)["fatigue_depth"]()
    assert {"worst, Fi = 1.50 at 60 µm", "surface, Fi = 1.0000"} <= set(legend(depth))


def test_the_lines_on_maps_of_the_index_are_explained():
    from matplotlib.colors import to_hex

    def lines(Fi):
        found = searched()
        found.maps["Fi"] = Fi * found.maps["Fi"]
        del found.maps["findley_stress_at_depth"]
        figure = fatigue_figures.all_figures(Page(dpi=40), found)["fatigue"]()
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
    found = searched()
    found.maps["findley_stress_under_row"] = found.maps["findley_stress_at_depth"][:, :, 5]
    page = Page(width=width)
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


def test_a_worst_point_at_the_rim_leaves_no_white_around_the_map():
    maps = [ax for ax in fatigue_figures.all_figures(Page(), searched(y_worst=1e-4))["fatigue"]().axes if ax.get_title()]
    assert {ax.get_ylim() for ax in maps} == {(-100.0, 100.0)} == {ax.get_xlim() for ax in maps}


@pytest.mark.parametrize("depth", [70.0, -1.0])
def test_a_depth_that_was_not_searched_is_refused(depth):
    with pytest.raises(SceneError, match=f"depth = {depth:g} µm is out of range; allowed: at least 0 µm and at most 60 µm"):
        fatigue_figures.all_figures(Page(), searched(depth=depth))
    found = searched(depth=20.0)
    del found.maps["findley_stress_at_depth"]
    with pytest.raises(SceneError, match="tehl fatigue STORE --depths 2e-05"):
        fatigue_figures.all_figures(Page(), found)


@pytest.mark.parametrize("wrong, said", [(dict(format="jpg"), "format = 'jpg'.*allowed: png, pdf, svg"),
                                         (dict(dpi=5), "dpi = 5 is out of range; allowed: 40 to 1200"),
                                         (dict(width=3), "width = 3 cm is out of range; allowed: at least 5 cm and at most 60"),
                                         (dict(width=50, dpi=1200), "width = 50 cm with dpi = 1200 is 23622 dots")])
def test_pages_that_nobody_can_print_are_refused(wrong, said):
    with pytest.raises(SceneError, match=said):
        Page(**wrong)


@pytest.mark.parametrize("built_in, at, said", [("gear", 1.2, "at = 1.2 a is out of range; allowed: at least -0.85 a"),
                                                ("ball-on-disc", 0.0, "made.zarr has a steady state only")])
def test_moments_that_never_were_are_refused(built_in, at, said):
    with pytest.raises(SceneError, match=said):
        Moments(made(built_in), at)


def test_files_are_of_the_format_and_size_as_asked_and_the_same_each_time(tmp_path):
    from tehl_taichi.figures.run_figures import write_all

    line = Made(scene("smooth-line").replace(**{"thermal.on": False}))
    first, again = ({path.name: path.read_bytes() for format in ("pdf", "svg")
                     for path in write_all(line, tmp_path / name, Page(format, 50, 10.0))} for name in "ab")
    assert first == again and set(first) == {"centreline.pdf", "centreline.svg"}
    box = re.search(rb"MediaBox \[ 0 0 ([\d.]+)", first["centreline.pdf"])
    assert float(box[1]) == pytest.approx(10 / INCH * 72, abs=0.01)
    assert first["centreline.pdf"].startswith(b"%PDF") and b"<svg" in first["centreline.svg"]


def test_the_suffix_of_a_file_tells_its_format(tmp_path):
    assert Page("pdf").of_file("a.svg") == (Page("svg"), tmp_path.__class__("a.svg"))
    assert Page("pdf").of_file("a")[1].name == "a.pdf"
    with pytest.raises(SceneError, match="format of a.doc = 'doc'"):
        Page().of_file("a.doc")
    with pytest.raises(StoreError, match="cannot write"):
        Page().save(lambda: drawn("centreline", made()), tmp_path / "none" / "a.png")


def test_drawing_leaves_the_settings_of_others_alone(tmp_path):
    before = dict(matplotlib.rcParams), matplotlib.get_backend()
    Page().save(lambda: drawn("centreline", made()), tmp_path / "a.png")
    assert (dict(matplotlib.rcParams), matplotlib.get_backend()) == before


def test_options_of_the_command_are_checked(tmp_path):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    path = str(store(tmp_path / "a.zarr").path)
    for option, value, said in (("dpi", "5", "allowed: 40 to 1200"), ("quantity", "x", "--quantity x is of a study"),
                                ("at", "9", "at = 9 a is out of range"), ("depth", "20", "depth = 20 µm is of a fatigue"),
                                ("format", "gif", "format = 'gif'"), ("width", "1", "width = 1")):
        found = CliRunner().invoke(app, ["plot", path, f"--{option}", value]).exception
        assert isinstance(found, SceneError) and said in str(found)


def test_comparisons_are_drawn_as_asked(tmp_path):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    pair = [str(store(tmp_path / name).path) for name in ("a.zarr", "b.zarr")]
    assert CliRunner().invoke(app, ["compare", *pair, "--format", "svg", "--width", "8.5"]).exit_code == 0
    size = re.search(r'width="([\d.]+)pt"', (tmp_path / "compare.svg").read_text())
    assert float(size[1]) == pytest.approx(8.5 / INCH * 72, abs=0.01)


@pytest.mark.parametrize("command", ["fatigue", "crack", "flank"])
def test_pages_are_refused_before_anything_is_searched(command):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    found = CliRunner().invoke(app, [command, "nothing.zarr", "--dpi", "5"]).exception
    assert isinstance(found, SceneError) and "dpi = 5 is out of range" in str(found)
