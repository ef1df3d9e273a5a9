"""The windows of both bodies in figures, films, exports and the report."""

from dataclasses import replace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.report import passage_plots, zoom_plots
from tehl_taichi.view.figures import field_maps, line_figures, zoom_maps
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.frames import Frames
from tehl_taichi.view.figures.moments import Moments
from tehl_taichi.view.zoom_window import ZoomWindow

pytest.importorskip("matplotlib")
FIRST = tehl.scene("gear").features[0]
SCENE = replace(tehl.scene("gear"), features=(FIRST, replace(FIRST, surface="b", height=-1e-6, x=-1e-4))).replace(
    **{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "fatigue.on": False, "zoom.factor": 2, "time.steps": 3})


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return tehl.run(SCENE, tmp_path_factory.mktemp("two") / "two.zarr")


def test_both_are_known(run):
    first, second = ZoomWindow.all_of(run.store)
    assert first.names == second.names and (first.number, second.number) == ("", " 2")
    assert (first.lefts != second.lefts).any() or first.x.size != second.x.size
    assert np.allclose(second.fields(3)["pressure"], run.store.map("zoom2_pressure")[2])


def test_figures_show_both(run):
    style, moments = FigureStyle(), Moments(run.store)
    figure = zoom_maps.zoom(style, moments)
    assert [ax.get_title() for ax in figure.axes if ax.get_title()] == ["pressure", "film"] * 2
    assert "zoom windows, cells 2 times finer" in figure.get_suptitle()
    assert len(field_maps.maps(style, moments).axes[0].lines) == 2
    lines = line_figures.centreline(style, Moments(run.store, -1.5)).axes[0].lines
    assert sum(line.get_marker() == "." for line in lines) == 2
    page = FigureStyle(dpi=40, width=8.5)
    with page.style():
        frames = Frames(page, moments, [1, 3], "pressure")
    frames.picture(3)
    left = [window.patch.get_extent()[0] for window in frames.windows]
    assert len(left) == 2 and left[0] != left[1]


def test_each_node_has_one_line(run):
    lines = line_figures.centreline(FigureStyle(), Moments(run.store, -1.5)).axes[0].lines
    first, second = (line.get_xdata()[np.isfinite(line.get_ydata())] for line in lines if line.get_marker() == ".")
    assert min(first.size, second.size) > 5 and not np.isclose(first[:, None], second).any()


def test_the_largest_pressure_of_a_window_is_that_of_its_own_nodes(run):
    """A peak at a node that belongs to the other window counts there."""
    windows, shared = ZoomWindow.all_of(run.store), 0
    for window in windows:
        before, real = window.extremes("p_max_Pa"), window.read["pressure"].copy()
        for n, entry in enumerate(window.entries):
            own = window.own(entry)
            for place, changed in ((own, 1), (~own, 0)):
                window.read["pressure"] = real.copy()
                window.read["pressure"][n][place] = 9e9
                assert np.flatnonzero(window.extremes("p_max_Pa") != before).tolist() == [n] * changed
            shared += (~own).sum()
    assert shared > 10


def test_the_report_shows_both(run):
    section, = zoom_plots.section(run.store)
    names = [figure.name for block in section.shown for figure in block.data["figures"]]
    assert section.title == "Zoom windows" and len(set(names)) == len(names) == 6 and "zoom2-pressure" in names
    found = {trace["name"] for trace in passage_plots.histories(run.store).traces}
    assert {"zoom window", "zoom window 2"} <= found


def test_exports_have_both(run, tmp_path):
    tables = tehl.export(run.path, "csv", tmp_path / "tables", at=float(run.store.feature_x(2)) / 3.62e-4)
    assert len([file for file in tables.iterdir() if "zoom" in file.name]) == 2
    files = {file.name for file in tehl.export(run.path, "vtk", tmp_path / "vtk").iterdir()}
    assert {"zoom.pvd", "zoom2.pvd", "zoom_000002.vti", "zoom2_000002.vti"} <= files
