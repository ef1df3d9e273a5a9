"""Which way round a scan lies: a file that is turned by keys is the file that was turned by hand."""

import dataclasses
import re

import numpy as np
import pytest
from map_feature import feature

from tehl_taichi.errors import SceneError
from tehl_taichi.report import scene_text, surface_plots
from tehl_taichi.scene import scene
from tehl_taichi.scene.feature import Feature

STEPS = {"pixel": 2e-6, "pixel_y": 3e-6}  # of a file: along a row, from row to row


@pytest.fixture
def scan(tmp_path):
    """A file without any symmetry, with a hole."""
    values = 0.05 * np.random.default_rng(2).normal(size=(20, 31)).cumsum(axis=1)
    values[4, 7:9] = np.nan
    np.save(tmp_path / "scan.npy", values)
    return tmp_path / "scan.npy"


def turned(keys, values):
    """By hand."""
    values = values.T if "transpose" in keys else values
    values = np.fliplr(values) if "mirror_x" in keys else values
    return np.flipud(values) if "mirror_y" in keys else values


@pytest.mark.parametrize("keys", [("transpose",), ("mirror_x",), ("mirror_y",), ("mirror_x", "mirror_y"),
                                  ("transpose", "mirror_x"), ("transpose", "mirror_x", "mirror_y")])
def test_a_turned_file_is_the_file_turned_by_hand(scan, keys):
    np.save(scan.with_name("hand.npy"), turned(keys, np.load(scan)))
    steps = dict(zip(STEPS, reversed(STEPS.values()))) if "transpose" in keys else STEPS
    one, hand = feature(scan, **STEPS, **dict.fromkeys(keys, True)), feature(scan.with_name("hand.npy"), **steps)
    np.testing.assert_array_equal(one.whole_heights, hand.whole_heights)
    assert (one.steps, one.size, one.patch, one.measures) == (hand.steps, hand.size, hand.patch, hand.measures)
    x, y = np.linspace(-40e-6, 40e-6, 33)[:, None], np.linspace(-40e-6, 40e-6, 27)
    np.testing.assert_array_equal(one.height_at(x, y), hand.height_at(x, y))
    assert one.sha256 == feature(scan, **STEPS).sha256  # the heights of the file


def warned(f):
    """Keys that warnings about falling coordinates name."""
    said = " ".join(one for one in f.kind.doubts(f, scene("gear")) if "coordinates fall" in one)
    return dict.fromkeys(re.findall(r"set feature\.(mirror_[xy]) = true", said), True)


@pytest.mark.parametrize("rows", [1, -1])
@pytest.mark.parametrize("columns", [1, -1])
@pytest.mark.parametrize("transpose", [False, True])
def test_coordinates_that_fall_are_reported_and_turned_on_request(tmp_path, rows, columns, transpose):
    """With the keys of the warnings the table is the surface that its list of points gives."""
    x, y = 2.0 * np.arange(14), 3.0 * np.arange(12)
    z = np.round(np.random.default_rng(7).normal(0, 0.05, (12, 14)).cumsum(1), 4)
    points = [(a, b, z[j, i]) for j, b in enumerate(y) for i, a in enumerate(x)]
    np.savetxt(tmp_path / "list.csv", points, delimiter=",", fmt="%.9g")
    table = np.block([[np.array([[np.nan]]), x[None, ::columns]], [y[::rows, None], z[::rows, ::columns]]])
    np.savetxt(tmp_path / "table.csv", table.T if transpose else table, delimiter=",", fmt="%.9g")
    steps = dict(zip(STEPS, reversed(STEPS.values()))) if transpose else STEPS
    listed, own = feature(tmp_path / "list.csv", **STEPS, taper=4e-6), {**steps, "taper": 4e-6, "transpose": transpose}
    keys = warned(feature(tmp_path / "table.csv", **own))
    assert set(keys) == {*["mirror_x"] * (columns < 0), *["mirror_y"] * (rows < 0)}
    f = feature(tmp_path / "table.csv", **own, **keys)
    np.testing.assert_array_equal(f.whole_heights, listed.whole_heights)
    assert not warned(f) and not warned(listed) and f.steps == listed.steps


def test_a_profile_whose_places_fall_is_reported(tmp_path):
    x = 2e-3 * np.arange(30)[::-1]
    np.savetxt(tmp_path / "a.txt", np.column_stack([x, np.sin(np.arange(30.0))]))
    for lay, key in (("transverse", "mirror_x"), ("longitudinal", "mirror_y")):
        keys = {"shape": "profile", "unit": "nm", "pixel": 2e-6, "lay": lay, "taper": 5e-6}
        assert set(warned(feature(tmp_path / "a.txt", **keys))) == {key}
        assert not warned(feature(tmp_path / "a.txt", **keys, **{key: True}))


def test_ends_change_places_along_the_axis_that_is_named(scan):
    for key, there in (("mirror_x", (12e-6, 5e-6)), ("mirror_y", (-12e-6, -5e-6)), ("transpose", (5e-6, -12e-6))):
        plain, other = feature(scan, pixel=2e-6), feature(scan, pixel=2e-6, **{key: True})
        at, to = ([np.array([each]) for each in place] for place in ((-12e-6, 5e-6), there))
        assert other.height_at(*to) == pytest.approx(plain.height_at(*at), rel=1e-9)


def test_what_was_done_is_told(scan):
    f = feature(scan, **STEPS, transpose=True, mirror_x=True)
    first, _ = f.kind.preview(f, scene("gear"))
    assert first.startswith("map scan.npy: 20 x 31 points 3 x 2 um apart, 57 x 60 um of them used, "
                            "fading out over 10 um at the rim, transposed, mirrored along x, heights in um")
    assert ("turned", "transposed, mirrored along x") in surface_plots.map_facts(f, scene("gear"))
    assert ("points", "20 × 31") in surface_plots.map_facts(f, scene("gear"))
    assert "transpose, mirror_x" in ", ".join(scene_text._sizes(f))
    thin = {"taper": 5e-6}
    both = feature(scan, mirror_x=True, mirror_y=True, **thin)
    assert both.orientation.says == "mirrored along x and y" and feature(scan, **thin).orientation.says == ""
    assert not any(what == "turned" for what, _ in surface_plots.map_facts(feature(scan, **thin), scene("gear")))


def test_a_store_has_the_heights_as_they_are_in_the_file(scan, tmp_path):
    import zarr

    from tehl_taichi.store import stored_maps

    f = feature(scan, **STEPS, transpose=True)
    described = dataclasses.replace(scene("gear"), features=(f,))
    group = zarr.create_group(tmp_path / "a.zarr")
    stored_maps.write(tmp_path / "a.zarr", described)
    (_, kept), = group.arrays()
    np.testing.assert_array_equal(kept[...], np.load(scan))
    assert kept.attrs["pixel_m"] == [2e-6, 3e-6] and kept.metadata.dimension_names[0].endswith("_row")


def test_only_a_map_is_turned():
    with pytest.raises(SceneError, match="feature.mirror_x = True needs shape = 'map' or .*, not 'cosine'"):
        Feature(mirror_x=True)
    with pytest.raises(SceneError, match="must be true or false"):
        Feature(shape="map", transpose=1)


@pytest.mark.parametrize("keys", [{}, {"transpose": True}, {"mirror_x": True}, {"transpose": True, "mirror_y": True}])
def test_the_file_s_row_and_column_of_a_place_are_told(tmp_path, keys):
    """Of the peak, wherever it lies; points farther away than the patch have none."""
    values = np.zeros((20, 31))
    values[2, 25] = 0.1
    values[10, 4] = np.nan
    np.save(tmp_path / "peak.npy", values)
    f = feature(tmp_path / "peak.npy", **STEPS, level="none", **keys)
    j, i = np.unravel_index(f.whole_heights.argmax(), f.whole_heights.shape)
    x, y = ((at - (count - 1) / 2) * step for at, count, step in zip((i, j), f.points, f.steps))
    assert f.position_in_file(x + 0.4 * f.steps[0], y - 0.4 * f.steps[1]) == "row 3, column 26"
    assert f.position_in_file(f.size[0] / 2 + 1e-9, 0.0) == "" == f.position_in_file(0.0, -f.size[1] / 2 - 1e-9)
    (j,), (i,) = np.nonzero(f.holes)
    x, y = ((at - (count - 1) / 2) * step for at, count, step in zip((i, j), f.points, f.steps))
    assert f.position_in_file(x, y) == "row 11, column 5, not measured"
