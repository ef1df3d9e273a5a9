"""The surface that passes, in figures and in reports: all features together, a map on its own points."""

import base64
import dataclasses

import made_results
import numpy as np
import pytest
from made_figures import Made
from read_pages import page
from small_stores import SMALL

import tehl_taichi as tehl
from tehl_taichi.scene import scene
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.surface.maps.height_map import levelled
from tehl_taichi.view.figures import palette
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.height_profile import heights
from tehl_taichi.view.figures.moments import Moments

matplotlib = pytest.importorskip("matplotlib")
BUMP = {"height": 1e-6, "width": 200e-6}


def passing(*features):
    """The gear contact with these features."""
    return dataclasses.replace(scene("gear"), features=tuple(Feature(**keys) for keys in features))


def scanned(tmp_path, rows=30, columns=20, **keys):
    """(scene with a map, its feature): a bump beside the middle on random roughness."""
    x, y = np.arange(columns) - columns / 4, np.arange(rows)[:, None] - rows / 3
    np.save(tmp_path / "scan.npy", 800 * np.exp(-(x**2 + y**2) / 20) + np.random.default_rng(1).normal(0, 20, (rows, columns)))
    keys = {"shape": "map", "file": str(tmp_path / "scan.npy"), "unit": "nm", "pixel": 6e-6, "pixel_y": 5e-6, **keys}
    made = scene("gear").replace(**{f"feature.{key}": value for key, value in keys.items()})
    return made, made.features[0]


def drawn(description, page=None):
    from tehl_taichi.view.figures.surface_figure import surface

    return surface(page or FigureStyle(dpi=40), Moments(Made(description)))


def test_a_map_is_shown_on_its_own_points(tmp_path):
    made, f = scanned(tmp_path)
    found = heights(made)
    assert np.diff(found.x) == pytest.approx(f.steps[0]) and np.diff(found.y) == pytest.approx(f.steps[1])
    np.testing.assert_allclose(found.values.T, f.whole_heights, atol=1e-15)
    part = heights(made.replace(**{"feature.extent_x": 66e-6, "feature.extent_y": 51e-6}))
    cut = levelled(f.raw[9:21, 4:16], f.level)[1:-1]  # 9 x 5 and 11 x 6 um inside, a row more on each side belongs to it
    np.testing.assert_allclose(part.values.T, cut, atol=1e-15)
    faded = heights(made.replace(**{"feature.taper": 20e-6})).values
    assert max(np.abs(faded[0]).max(), np.abs(faded[:, -1]).max()) < 1e-15 < np.abs(f.whole_heights[:, 0]).max()


def test_all_features_pass_together():
    found = heights(passing(BUMP, {**BUMP, "height": -5e-7, "x": 150e-6, "y": 40e-6}))
    assert found.values.shape == (399, 399) and not found.line
    assert (found.x[0], found.x[-1]) == pytest.approx((-117.5e-6, 267.5e-6))  # of 350 um, 5 % more on each side
    at = np.argmin(np.abs(found.x - 150e-6)), np.argmin(np.abs(found.y - 40e-6))
    assert found.values[at] == pytest.approx(-5e-7, rel=1e-3) and found.values.max() == pytest.approx(1e-6, rel=1e-3)


@pytest.mark.parametrize("srr, slide", [(-0.12, True), (0.0, False)])
def test_the_sum_of_two_surfaces_is_that_of_one_moment(srr, slide):
    """Where they slide, another moment has another sum."""
    from tehl_taichi.report import surface_plots

    both = passing(BUMP, {**BUMP, "surface": "b", "x": 1e-4}).replace(srr=srr)
    one = passing(BUMP, {**BUMP, "x": 1e-4})
    for said in (drawn(both).get_suptitle(), surface_plots.picture(both).caption):
        assert ("surfaces a and b together, as they lie at X = 0" in said) == slide
    assert "X = 0" not in drawn(one).get_suptitle()
    np.testing.assert_allclose(heights(both).values, heights(one).values)


def test_what_is_the_same_for_every_y_is_a_line_and_what_has_no_end_ends_with_the_domain():
    assert heights(scene("furrow-line")).line and heights(scene("ridge-on-ball")).line
    endless = passing({"shape": "rough", "height": 1e-7, "width": 80e-6, "extent_x": 300e-6})
    found = heights(endless)
    assert found.y[-1] == -found.y[0] == pytest.approx(endless.grid.y_max * Made(endless).a)


def test_the_figure_shows_heights_in_micrometres(tmp_path):
    made, f = scanned(tmp_path)
    ax, bar = drawn(made).axes
    image, = ax.images
    np.testing.assert_allclose(image.get_array(), f.whole_heights * 1e6, atol=1e-9)
    assert image.get_extent() == pytest.approx([-60, 60, -75, 75]) and ax.get_aspect() == 1.0  # a dot around every point
    assert image.origin == "lower", "the first row, of the smallest y, is the lowest"
    assert bar.get_ylabel() == "height (µm)" and image.cmap.name == palette.HEIGHT and ax.get_ylabel() == "y (µm)"
    low, high = f.measures.low * 1e6, f.measures.high * 1e6
    assert drawn(made).get_suptitle() == f"gear: heights of surface a, {low:.3g} to {high:.3g} µm"
    line, = drawn(scene("furrow-line")).axes[0].lines
    assert line.get_ydata().min() == pytest.approx(scene("furrow-line").features[0].height * 1e6, rel=1e-3)
    long = drawn(passing({**BUMP, "width": 60e-6, "length": 4e-3})).axes[0]
    assert long.get_aspect() == "auto"


def test_facts_of_a_map_and_rows_of_roughness_are_those_of_their_labels(tmp_path):
    from tehl_taichi.report import surface_plots
    from tehl_taichi.report.number_text import value_text
    from tehl_taichi.scene import surface_roughness

    made, f = scanned(tmp_path)
    facts = dict(surface_plots.map_facts(f, made))
    spread, low, high = (value_text(size, unit="m") for size in (f.measures.range, f.measures.low, f.measures.high))
    assert facts["range"] == f"{spread}: {low} to {high}".replace("-", "−") and f.measures.low < 0 < f.measures.high
    rough = scene("rough")
    block, film = surface_plots.roughness(rough, {"lambda": 1.52, "error": {"lambda": 0.034}})
    numbers = surface_roughness.to_dict(rough)["a"]
    rows = {what: own for what, own, *_ in block.data["rows"]}
    for what, key in (("mean height (Sa, Ra)", "Sa_m"), ("rms height (Sq, Rq)", "Sq_m"), ("range (Sz, Rz)", "Sz_m"),
                      ("autocorrelation length along x", "length_x_m"), ("along y", "length_y_m")):
        assert rows[what] == value_text(numbers[key], unit="m"), what
    assert film.data["rows"] == [("λ = h_c/Sq", "1.520 ± 0.034")]


def test_a_page_covers_the_points_that_were_not_measured(tmp_path):
    """Three beside the middle, in the file's rows 4 and columns 15 to 17."""
    from tehl_taichi.report import surface_plots

    values = np.random.default_rng(1).normal(0, 20, (30, 20))
    values[4, 15:18] = np.nan
    np.save(tmp_path / "holes.npy", values)
    made, f = scanned(tmp_path, file=str(tmp_path / "holes.npy"))
    heat, cover = surface_plots.picture(made).traces
    rows, columns = np.nonzero(np.array(cover["z"]) == 1)
    found = heights(made)
    assert len(rows) == 3 and list(heat["x"]) == list(cover["x"]) and list(heat["y"]) == list(cover["y"])
    for j, i in zip(rows, columns):
        assert found.filled[i, j] and (cover["x"][i], cover["y"][j]) == pytest.approx((found.x[i] * 1e6, found.y[j] * 1e6))


def test_it_is_drawn_where_something_passes(tmp_path):
    from tehl_taichi.view.figures.run_figures import write_all

    for description, there in ((scene("furrow-line"), True), (scene("smooth-line"), False)):
        found = write_all(Made(description), tmp_path / description.name, FigureStyle(dpi=40))
        assert ("surface.png" in {path.name for path in found}) == there


def test_the_report_shows_the_map_and_what_was_read(tmp_path):
    pytest.importorskip("plotly")
    made, f = scanned(tmp_path, taper=2e-5)
    small = made.replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False})
    seen = page(made_results.run(tmp_path / "a.zarr", small), tmp_path)
    assert seen.headings.index("The surface") == seen.headings.index("Scene") + 1
    for text in ("file\nscan.npy\n", "20 × 30", "6 µm × 5 µm", "nm", "plane", f"{f.measures.rms * 1e6:.4g} µm",
                 f"{f.measures.slope:.2g}°", "114 µm × 145 µm, fading out over 20 µm at its rim",
                 "features, on surface a"):
        assert text in seen.text, text
    assert "file scan.npy, " in seen.text  # in words: without its folders
    trace, = seen.figures["surface"]["data"]
    shown = np.frombuffer(base64.b64decode(trace["z"]["bdata"]), "<f4").reshape(30, 20)
    assert shown == pytest.approx(heights(made).values.T * 1e6, abs=f.measures.range * 1e6 / 2000)


def test_the_report_thins_large_maps_and_leaves_out_what_does_not_pass(tmp_path):
    from tehl_taichi.report import surface_plots

    picture = surface_plots.picture(scanned(tmp_path, 401, 900, pixel=1e-6, pixel_y=1e-6)[0])
    assert picture.traces[0]["z"].shape == (400, 400) and "400 × 400 of 900 × 401 points" in picture.caption
    assert surface_plots.section(scene("smooth-line"), {}) == ()
    seen = page(made_results.run(tmp_path / "a.zarr", SMALL), tmp_path)
    assert "The surface" in seen.headings and "largest slope" not in seen.text and tehl.open(tmp_path / "a.zarr")


def holed(tmp_path, hole=np.s_[4:6, 10:13], rows=30, columns=20, **keys):
    """The same scan with a hole, its rows turned round."""
    scanned(tmp_path, rows, columns)
    values = np.load(tmp_path / "scan.npy")
    values[hole] = np.nan
    np.save(tmp_path / "holed.npy", values)
    return scanned(tmp_path, rows, columns, file=str(tmp_path / "holed.npy"), mirror_y=True, **keys)[0]


def test_holes_of_a_scan_lie_where_the_scan_has_them(tmp_path):
    made = holed(tmp_path)
    filled = heights(made).filled
    assert filled.shape == (20, 30) and filled.sum() == 6 and filled[10:13, 24:26].all()  # row 4 of 30 is row 25 now
    assert not heights(holed(tmp_path, extent_y=50e-6)).filled.any()  # beyond the patch
    x, y = heights(made).x[11], heights(made).y[24]
    both = heights(dataclasses.replace(made, features=(Feature(**BUMP), dataclasses.replace(made.features[0], x=1e-4))))
    i, j = (np.argmin(np.abs(axis - at)) for axis, at in ((both.x, x + 1e-4), (both.y, y)))
    assert both.filled[i, j] and 0 < both.filled.mean() < 6 / 600
    rim = holed(tmp_path, np.s_[:2, 8:10])
    both = heights(dataclasses.replace(rim, features=(Feature(**BUMP), *rim.features)))
    i, j = np.nonzero(both.filled)
    assert i.size and both.y[j].max() <= rim.features[0].size[1] / 2  # its holes do not go on beyond it
    assert not heights(passing(BUMP)).filled.any() and not heights(scene("furrow-line")).filled.any()


def test_holes_are_marked_in_the_figure(tmp_path):
    figure = drawn(holed(tmp_path))
    cover, image = figure.axes[0].images
    assert np.isfinite(cover.get_array().filled(np.nan)).sum() == 6 and cover.get_zorder() > image.get_zorder()
    assert cover.get_extent() == image.get_extent() and "light: not measured" in figure.get_suptitle()
    assert "light" not in drawn(scanned(tmp_path)[0]).get_suptitle()


@pytest.mark.parametrize("columns, marked", [(20, 6), (900, 4)])
def test_holes_are_marked_in_the_report(tmp_path, columns, marked):
    """Also where only some of the points are kept: of these columns 9 and 11."""
    from tehl_taichi.report import surface_plots

    picture = surface_plots.picture(holed(tmp_path, columns=columns, pixel=2e-6))
    heat, cover = picture.traces
    assert cover["z"].shape == heat["z"].shape and np.argwhere(np.isfinite(cover["z"])).min(axis=0)[0] == 24
    assert ("not measured", "6, filled in") in surface_plots.map_facts(holed(tmp_path).features[0], scene("gear"))
    assert np.isfinite(cover["z"]).sum() == marked and "Light: points that were not measured" in picture.caption
    assert "Light" not in surface_plots.picture(scanned(tmp_path)[0]).caption


def test_words_of_a_scan_in_figures_and_report(tmp_path):
    """His scan is no feature to its user; other scenes keep their word."""
    pytest.importorskip("plotly")
    made, f = scanned(tmp_path, rows=31, columns=41, mirror_x=True)
    scan = made.replace(**{"grid.nx": 64, "grid.ny": 16})
    assert Moments(Made(scan)).says(2) == "scan centre at +0.00 a" and Moments(Made(SMALL)).says(2) == "feature at +0.00 a"
    assert drawn(scan).axes[0].get_xlabel() == "x from the scan's centre (µm), flow to the right"
    search = made_results.fatigue()
    search["below"] |= {"x_m": 1e-3}
    of_scan, of_bump = (page(made_results.run(tmp_path / f"{name}.zarr", one, search=search), tmp_path)
                        for name, one in (("scan", scan), ("bump", made_results.THERMAL)))
    for seen, what, where in ((of_scan, "scan", "scan centre"), (of_bump, "feature", "feature")):
        for said in (f"Position of the {where}", f"x of the {what}", f"dotted: the centre of the {what}",
                     f"Surface a carries the {what}", f"which carries the {what}", f"while the {what} passes",
                     f"the {what} is on the slower surface"):
            assert said in seen.text, said
    assert of_scan.figures["index-surface"]["layout"]["xaxis"]["title"]["text"] == "x from the scan's centre (µm)"
    assert of_scan.figures["stress-surface"]["layout"]["xaxis"]["title"]["text"] == "position of the scan centre x / a"
    assert "nearest point in the file of the scan\nrow 16, column 20\n" in of_scan.text  # 8 um ahead of column 21, turned round
    assert "file of the scan" not in of_bump.text


@pytest.mark.parametrize("keys, y, said", [
    ({"taper": 0.0}, -0.5, "through the largest pressure"),
    ({"taper": 60e-6}, None, "through the largest pressure away from the scan's rim"),
    ({"taper": 60e-6, "y": 1e-4}, -0.5, "through the largest pressure")])
def test_no_line_runs_along_the_rim_of_a_scan(tmp_path, keys, y, said):
    """The largest pressure lies at y = -a/2, in the third case where nothing of the scan is."""
    a = Made(scene("gear")).a
    made = scanned(tmp_path, rows=int(1.2 * a / 5e-6), columns=100, **keys)[0]
    moments, f = Moments(Made(made, whole=True)), made.features[0]
    at, rim = moments.store.y[moments.line], f.to_rim(0.0, moments.store.y[moments.line] - f.y)[1]
    assert moments.along.endswith(said)
    assert at == pytest.approx(y * a) if y else rim > f.taper or rim < 0
