"""A stored zoom window in figures, films, exports and the report. The stores are made up: nothing is solved."""

from xml.etree import ElementTree

import numpy as np
import pytest
from made_figures import Made, made, title
from small_stores import SMALL, shot

import tehl_taichi as tehl
from tehl_taichi.report import passage_plots, zoom_plots
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures import field_maps, line_figures, zoom_maps
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.frames import Frames
from tehl_taichi.view.figures.moments import Moments
from tehl_taichi.view.zoom_window import ZoomWindow

pytest.importorskip("matplotlib")
ALONG = "zoom_moment", "zoom_x", "zoom_y"
ENTRIES, COLUMNS, ROWS, CELL = (2, 3), 9, 5, 5e-6
LEFTS, X, Y = np.array([1e-4, 2e-4]), np.arange(COLUMNS) * CELL, np.arange(ROWS) * CELL
PLACES = {"zoom_entry": (np.array(ENTRIES, float), [ALONG[0]], "1", "entry"), "zoom_left": (LEFTS, [ALONG[0]], "m", "left"),
          "zoom_x": (X, [ALONG[1]], "m", "along"), "zoom_y": (Y, [ALONG[2]], "m", "across")}

SUMMARY = {"scene": "gear", "version": tehl.__version__, "wall_s": 2.0, "compile_s": 1.0, "steps": 3,
           "grid": {"nx": 33, "ny": 9, "nz": 1}, "hertz": {"a_m": Scales.of(SMALL).a}, "left_out": [], "work": {}, "clamps": {},
           "domain": {}, "warnings": [], "warning_codes": [],
           "steady": {"h_c_m": 4e-7, "h_min_m": 3e-7, "p_max_Pa": 2e9, "error": {}, "unknown": {}}}


def values(entry, factor):
    """A field that is known by entry, column and row."""
    return factor * (entry + X[:, None] / CELL / 10 + Y / CELL / 100).astype("f4")


FACTORS = {"pressure": (1e9, "Pa"), "film": (1e-7, "m"), "temperature_mid": (50.0, "degC")}
FIELDS = {f"zoom_{name}": (np.stack([values(n, factor) for n in ENTRIES]), list(ALONG), unit, name)
          for name, (factor, unit) in FACTORS.items()}


class WithWindow(Made):
    """The made-up store with a window at two of its entries."""

    metadata = {name: {"dimension_names": dims, "attributes": {"units": unit}}
                for name, (_, dims, unit, _) in {**PLACES, **FIELDS}.items()}

    def map(self, name):
        return {**PLACES, **FIELDS}[name][0] if name in self.metadata else None


@pytest.fixture
def store():
    return WithWindow(made().scene)


def test_a_window_is_known_by_entry_place_and_field(store):
    window = ZoomWindow.of(store)
    assert ZoomWindow.of(made()) is None and set(window.names) == set(FACTORS)
    assert 2 in window and 1 not in window and window.worst == 3
    assert np.allclose(window.columns(3), 2e-4 + X) and np.allclose(window.fields(2)["film"], values(2, 1e-7))
    assert window.row(2 * CELL) == 2 and window.row(2.5 * CELL) is None
    assert np.allclose(window.extremes("p_max_Pa"), [values(n, 1e9).max() for n in ENTRIES])
    assert np.allclose(window.extremes("h_min_m"), [2e-7, 3e-7])


def test_its_figure_shows_its_largest_pressure_or_the_moment_that_is_asked_for(store):
    figure = zoom_maps.zoom(FigureStyle(), Moments(store))
    factor = store.scene.zoom.factor
    assert title(figure) == f"gear: zoom window, cells {factor} times finer, feature at +0.80 a, p_max 3.84 GPa"
    maps = [ax for ax in figure.axes if ax.get_title()]
    assert [ax.get_title() for ax in maps] == ["pressure", "film", "film temperature"]
    image = maps[0].collections[0]
    assert np.allclose(image.get_array()[ROWS - 1 :], values(3, 1.0).T)  # the other half is its mirror image
    assert np.allclose(maps[0].get_xlim(), (2e-4 + X[[0, -1]]) / store.a)
    assert "feature at +0.00 a, p_max 2.84 GPa" in title(zoom_maps.zoom(FigureStyle(), Moments(store, 0.0)))


@pytest.mark.parametrize("at, there", [(0.0, True), (-0.8, False)])
def test_maps_of_the_run_show_where_it_is(store, at, there):
    figure = field_maps.maps(FigureStyle(), Moments(store, at))
    assert title(figure).endswith("; dashed: zoom window") is there
    lines = figure.axes[0].lines
    assert len(lines) == there
    if there:
        assert np.allclose(np.ptp(lines[0].get_xdata()), np.ptp(X) / store.a)
        assert np.allclose((min(lines[0].get_ydata()), max(lines[0].get_ydata())), (-Y[-1] / store.a, Y[-1] / store.a))


def test_centrelines_have_both_grids(store):
    figure = line_figures.centreline(FigureStyle(), Moments(store))
    fine = [line for line in figure.axes[0].lines if line.get_marker() == "."]
    assert [len(line.get_xdata()) for line in fine] == [COLUMNS] * 2 and "thick: zoom window" in title(figure)
    assert np.allclose(fine[1].get_ydata(), values(3, 1.0)[:, 0])


def test_frames_of_a_film_have_it_and_room_for_its_values(store):
    page = FigureStyle(dpi=40, width=8.5)
    with page.style():
        frames = Frames(page, Moments(store), [1, 3], "pressure")
    first, last = frames.picture(1), frames.picture(3)
    line = next(line for line, field, _ in frames.windows[0].lines if field == "pressure")
    assert (first != last).any() and np.allclose(line.get_ydata(), values(3, 1.0)[:, 0])
    left, right, low, high = frames.windows[0].patch.get_extent()
    assert np.allclose((left, right), (2e-4 + X[[0, -1]]) / store.a)
    assert np.allclose((low, high), (-Y[-1] / store.a, Y[-1] / store.a))
    whole = max(store.fields(3, ["pressure"])["pressure"].max(), values(3, 1e9).max()) / 1e9
    assert frames.map[0].get_clim()[1] == pytest.approx(whole)
    assert frames.axes["map"].get_xlim() == pytest.approx(frames.moments.window)


def test_the_report_has_a_section_with_both_grids(store):
    assert zoom_plots.section(made()) == ()
    section, = zoom_plots.section(store)
    lines, maps = (block.data["figures"] for block in section.shown)
    run, fine = lines[0].traces[:2]
    assert np.allclose(np.array(fine["x"]) * store.a, 2e-4 + X) and np.allclose(fine["y"], values(3, 1.0)[:, 0])
    assert run["x"][0] >= fine["x"][0] and run["x"][-1] <= fine["x"][-1]
    assert [figure.name for figure in maps] == ["zoom-pressure", "zoom-film"]
    assert maps[0].traces[0]["z"].shape == (2 * ROWS - 1, COLUMNS)
    assert np.allclose(np.array(maps[0].traces[0]["x"]) * store.a, 2e-4 + X)


def test_histories_of_the_report_have_the_numbers_of_the_window(store):
    store.series = ("p_max_Pa",)
    found = [trace for trace in passage_plots.histories(store).traces if trace["name"] == "zoom window"]
    assert len(found) == 1 and np.allclose(found[0]["y"], [values(n, 1.0).max() for n in ENTRIES])
    assert np.allclose(found[0]["x"], store.at[list(ENTRIES)] / store.a)


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    from tehl_taichi.store.store import Store

    path = tmp_path_factory.mktemp("window") / "gear-1.zarr"
    with Store.create(path, SMALL, shot(0), 50, {"steady_error": "{}"}) as saved:
        for step in range(1, 4):
            saved.append(shot(step))
        saved.finish(SUMMARY, {**PLACES, **FIELDS})
    return path


def test_tables_have_its_centreline_where_it_is(stored, tmp_path):
    a = Scales.of(SMALL).a
    made = tehl.export(stored, "csv", tmp_path / "tables", at=(1e-5 / a, 3e-5 / a))
    names = {file.name for file in made.iterdir() if "zoom" in file.name}
    assert names == {f"centreline_zoom_at_{3e-5 / a:g}a.csv"}
    titles, *rows = (made / names.pop()).read_text().splitlines()
    columns = dict(zip(titles.split(","), np.array([[float(cell) for cell in row.split(",")] for row in rows]).T))
    assert np.allclose(columns["x [m]"], 2e-4 + X) and np.allclose(columns["pressure [Pa]"], values(3, 1e9)[:, 0])
    assert (columns["film [m]"] == columns["film [m]"][0]).sum() == 1


def test_paraview_gets_a_series_of_it(stored, tmp_path):
    folder = tehl.export(stored, "vtk", tmp_path / "vtk")
    series = ElementTree.parse(folder / "zoom.pvd").getroot()
    files = [one.get("file") for one in series.iter("DataSet")]
    assert len(files) == 2 and all((folder / file).exists() for file in files)
    times = tehl.open(stored).store.time[list(ENTRIES)]
    assert [float(one.get("timestep")) for one in series.iter("DataSet")] == list(times) and len(set(times)) == 2
    image = ElementTree.parse(folder / files[1]).getroot().find("ImageData")
    assert image.get("WholeExtent") == f"0 {COLUMNS - 1} 0 {ROWS - 1} 0 0"
    assert float(image.get("Origin").split()[0]) == pytest.approx(2e-4)
    assert {one.get("Name") for one in image.iter("DataArray")} >= {"zoom_pressure_Pa", "zoom_film_m"}
    assert tehl.export(stored, "vtk", folder, force=True) == folder
