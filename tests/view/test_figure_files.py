"""Figures as files: pages, formats and sizes, and what the commands refuse."""

import re

import pytest
from made_figures import Made, drawn, made
from small_stores import store

from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.scene import scene
from tehl_taichi.view.figures.figure_style import INCH, FigureStyle

matplotlib = pytest.importorskip("matplotlib")


@pytest.mark.parametrize("wrong, said", [(dict(format="jpg"), "format = 'jpg'.*allowed: png, pdf, svg"),
                                         (dict(dpi=5), "dpi = 5 is out of range; allowed: 40 to 1200"),
                                         (dict(width=3), "width = 3 cm is out of range; allowed: at least 5 cm and at most 60"),
                                         (dict(width=50, dpi=1200), "width = 50 cm with dpi = 1200 gives 23622 dots")])
def test_pages_that_nobody_can_print_are_refused(wrong, said):
    with pytest.raises(SceneError, match=said):
        FigureStyle(**wrong)


def test_files_are_of_the_format_and_size_as_asked_and_the_same_each_time(tmp_path):
    from tehl_taichi.view.figures.run_figures import write_all

    line = Made(scene("smooth-line").replace(**{"thermal.on": False}))
    first, again = ({path.name: path.read_bytes() for format in ("pdf", "svg")
                     for path in write_all(line, tmp_path / name, FigureStyle(format, 50, 10.0))} for name in "ab")
    assert first == again and set(first) == {"centreline.pdf", "centreline.svg"}
    box = re.search(rb"MediaBox \[ 0 0 ([\d.]+)", first["centreline.pdf"])
    assert float(box[1]) == pytest.approx(10 / INCH * 72, abs=0.01)
    assert first["centreline.pdf"].startswith(b"%PDF") and b"<svg" in first["centreline.svg"]


def test_the_suffix_of_a_file_tells_its_format(tmp_path):
    assert FigureStyle("pdf").of_file("a.svg") == (FigureStyle("svg"), tmp_path.__class__("a.svg"))
    assert FigureStyle("pdf").of_file("a")[1].name == "a.pdf"
    with pytest.raises(SceneError, match="format of a.doc = 'doc'"):
        FigureStyle().of_file("a.doc")
    (tmp_path / "none").touch()
    with pytest.raises(StoreError, match="cannot write"):
        FigureStyle().save(lambda: drawn("centreline", made()), tmp_path / "none" / "a.png")


def test_drawing_leaves_the_settings_of_others_alone(tmp_path):
    before = dict(matplotlib.rcParams), matplotlib.get_backend()
    FigureStyle().save(lambda: drawn("centreline", made()), tmp_path / "a.png")
    assert (dict(matplotlib.rcParams), matplotlib.get_backend()) == before


def test_options_of_the_command_are_checked(tmp_path):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    path = str(store(tmp_path / "a.zarr").path)
    for option, value, said in (("dpi", "5", "allowed: 40 to 1200"), ("quantity", "x", "--quantity x applies to a study"),
                                ("at", "9", "at = 9 a is out of range"), ("depth", "20", "depth = 20 µm needs a fatigue"),
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


@pytest.mark.rendered
@pytest.mark.parametrize("width", [5.0, 8.5, 17.0])
def test_a_long_y_label_stays_on_the_page(width):
    """In panels that are lower than it is long."""
    page = FigureStyle(width=width)

    def draw():
        figure, axes = page.figure(2, 2)
        axes[0, 0].set_ylabel("steady friction coefficient of a contact (without a unit)")
        return figure

    figure = page.drawn(draw)
    figure.draw_without_rendering()
    label = figure.axes[0].yaxis.label
    assert "\n" in label.get_text() and figure.axes[1].get_ylabel() == ""
    box = label.get_window_extent()
    assert 0 <= box.x0 and 0 <= box.y0 and box.y1 <= figure.bbox.height


@pytest.mark.parametrize("x, ticks", [([2.0, 4.0, 8.0], [2, 5]), ([0.1, 1.0, 10.0], [0.1, 1, 10]), ([1.0, 40.0], [1, 10]),
                                      ([1.0, 2.0, 3.0], None), ([0.0, 1.0, 10.0], None), ([-1.0, 10.0, 100.0], None)])
def test_axes_of_even_ratios_are_logarithmic_with_ticks(x, ticks):
    """Also within a decade."""
    from tehl_taichi.view.figures import logarithmic_axis

    ax = FigureStyle().figure()[1][0, 0]
    ax.plot(x, x)
    logarithmic_axis.choose_x(ax, x)
    assert (ax.get_xscale() == "log") == (ticks is not None)
    assert ticks is None or set(ticks) <= {round(tick, 6) for tick in ax.get_xticks()}


@pytest.mark.parametrize("width", [5.0, 17.0, 60.0])
def test_a_hollow_symbol_keeps_its_rim(width):
    """In figures of every width, of studies and of traction curves."""
    import numpy as np

    from tehl_taichi.view.figures import unknown_errors

    page, x = FigureStyle(width=width), np.array([0.0, 1.0])
    with page.style():
        ax = page.figure()[1][0, 0]
        symbol = ax.errorbar(x, x, [0.1, np.nan], fmt="o-").lines[0]
        unknown_errors.draw(ax, x, x, np.array([0.1, np.nan]))
    hole = ax.lines[-1]
    assert hole.get_xdata().tolist() == [1.0] and hole.get_marker() == symbol.get_marker() == "o"
    assert 0.3 * symbol.get_markersize() < hole.get_markersize() + hole.get_markeredgewidth() < 0.7 * symbol.get_markersize()
