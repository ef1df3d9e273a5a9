"""Coordinates beside the heights of a map are no heights."""

import numpy as np
import pytest
from map_feature import feature

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface.maps import coordinates, height_map

ROWS, COLUMNS = 12, 17
HEIGHTS = np.round(0.1 * np.random.default_rng(4).standard_normal((ROWS, COLUMNS)).cumsum(0).cumsum(1) / 9, 4)


def framed(x, y, corner=np.nan, heights=HEIGHTS):
    """A table with these coordinates, None: without."""
    table = heights
    if y is not None:
        table = np.column_stack([y, table])
    if x is not None:
        table = np.vstack([np.r_[[corner] * (y is not None), x], table])
    return table


X, Y = 2.0 * np.arange(COLUMNS), 3.0 * np.arange(ROWS)
FRAMES = {"numbers": (np.arange(COLUMNS), np.arange(ROWS)), "from one": (np.arange(COLUMNS) + 1, np.arange(ROWS) + 1),
          "micrometres": (X, Y), "centred": (X - X.mean(), Y - Y.mean()), "falling": (X, Y[::-1]), "row": (X, None),
          "column": (None, Y), "rounded": (np.round(X / 3e3, 5), np.round(Y / 3e3, 5))}


@pytest.mark.parametrize("corner", [np.nan, 0.0, 117.0])
@pytest.mark.parametrize("name", FRAMES)
def test_a_row_and_a_column_of_coordinates_are_taken_off(name, corner):
    found = coordinates.separate(framed(*FRAMES[name], corner))
    assert np.array_equal(found.heights, HEIGHTS)
    x, y = FRAMES[name]
    assert len(found.found_lines) == (x is not None) + (y is not None)
    if name in ("numbers", "from one"):
        assert found.x is None and found.y is None
    else:
        assert (found.x or 0) == pytest.approx(0 if x is None else abs(x[1] - x[0]), rel=0.01)
        assert (found.y or 0) == pytest.approx(0 if y is None else abs(y[1] - y[0]), rel=0.01)


RAMP = 0.03 * np.arange(COLUMNS) + 0.01 * np.arange(ROWS)[:, None]
SURFACES = {"rough": HEIGHTS, "ramp": RAMP, "along x": RAMP[:1] + 0 * HEIGHTS, "along y": RAMP[:, :1] + 0 * HEIGHTS,
            "saddle": np.outer(np.arange(ROWS) - 5.0, np.arange(COLUMNS) - 8.0), "flat": 0 * HEIGHTS,
            "bowl": np.add.outer(np.arange(ROWS) ** 2.0, np.arange(COLUMNS) ** 2.0),
            "holes": np.where(HEIGHTS > 0.5, np.nan, HEIGHTS)}


@pytest.mark.parametrize("name", SURFACES)
def test_heights_alone_stay_as_they_are(name):
    found = coordinates.separate(SURFACES[name])
    assert found.found_lines == () and np.array_equal(found.heights, SURFACES[name], equal_nan=True)
    assert not coordinates.is_list(SURFACES[name])


@pytest.mark.parametrize("name", SURFACES)
def test_a_plane_between_coordinates_is_found(name):
    found = coordinates.separate(framed(X, Y, heights=SURFACES[name]))
    assert np.array_equal(found.heights, SURFACES[name], equal_nan=True)


PANDAS = "," + ",".join(map(str, range(COLUMNS)))


@pytest.mark.parametrize("head, index", [(PANDAS, True), (PANDAS[1:], False), ("," + ",".join(f"{x:g}" for x in X), True),
                                         (r"y\x," + ",".join(f"{x:g}" for x in X), True), ("", True),
                                         ("," + ",".join(f"x{n}" for n in range(COLUMNS)), True)])
def test_csv_as_data_frames_write_it(tmp_path, head, index):
    lines = [",".join([*[str(n)] * index, *map(str, row)]) for n, row in enumerate(HEIGHTS)]
    (tmp_path / "scan.csv").write_text("\n".join([*[head] * bool(head), *lines]) + "\n")
    assert np.array_equal(height_map.read(tmp_path / "scan.csv"), HEIGHTS)
    f = feature(tmp_path / "scan.csv", pixel=2e-6, pixel_y=3e-6, taper=1e-6)
    assert f.heights.shape == HEIGHTS.shape and ("skipped" in height_map.facts(f).skipped)


def test_arrays_too_and_their_spacing_is_compared(tmp_path):
    np.save(tmp_path / "scan.npy", framed(X, Y))
    f = feature(tmp_path / "scan.npy", pixel=2e-6, pixel_y=3e-6, taper=1e-6)
    assert np.array_equal(f.heights, HEIGHTS)
    for wrong, said in (({"pixel": 3e-6, "pixel_y": 3e-6}, "feature.pixel = 3e-06 m does not match .* 2 apart"),
                        ({"pixel": 2e-6}, "feature.pixel = 2e-06 m does not match .* 3 apart"),
                        ({"pixel": 2e-6, "pixel_y": 4e-6}, "feature.pixel_y = 4e-06 m does not match .* 3 apart")):
        with pytest.raises(SceneError, match=said):
            feature(tmp_path / "scan.npy", taper=1e-6, **wrong)


def listed(order, more=0):
    """x, y, z and more columns, in that order."""
    y, x = (each.ravel() for each in np.meshgrid(Y, X, indexing="ij"))
    columns = {"x": x, "y": y, "z": HEIGHTS.ravel()}
    return np.column_stack([*(columns[name] for name in order), *(np.arange(x.size) % 7.0 for _ in range(more))])


@pytest.mark.parametrize("order", ["xyz", "yxz", "zxy", "xzy"])
@pytest.mark.parametrize("more", [0, 1, 3])
@pytest.mark.parametrize("turned", [False, True])
def test_lists_of_points_become_a_grid(tmp_path, order, more, turned):
    """x is the first column of coordinates, unless names say otherwise."""
    table = np.random.default_rng(2).permutation(listed(order, more))
    np.save(tmp_path / "scan.npy", table.T if turned else table)
    found = height_map.table_of(tmp_path / "scan.npy")
    swapped = order.index("y") < order.index("x")
    np.testing.assert_array_equal(found.values, HEIGHTS.T if swapped else HEIGHTS)
    assert found.spacing == ((3.0, 2.0) if swapped else (2.0, 3.0)) and "x and y of a list of points skipped" in found.skipped
    names = ",".join([*(f"{name.upper()} [um]" for name in order), *"more"[:more]])
    np.savetxt(tmp_path / "scan.csv", table, delimiter=",", header=names, comments="")
    named = height_map.table_of(tmp_path / "scan.csv")
    np.testing.assert_array_equal(named.values, HEIGHTS)
    assert (named.stated.unit, *named.stated.x, *named.stated.y) == ("um", pytest.approx(2e-6), pytest.approx(3e-6))


def test_points_that_a_list_lacks_were_not_measured(tmp_path):
    table = np.delete(listed("xyz"), [40, 41, 100], axis=0)
    (tmp_path / "scan.xyz").write_text("\n".join(" ".join(map(str, row)) for row in table))
    found = height_map.read(tmp_path / "scan.xyz")
    assert np.isnan(found).sum() == 3 and np.array_equal(found[~np.isnan(found)], HEIGHTS[~np.isnan(found)])


@pytest.mark.parametrize("points", [np.random.default_rng(1).random((400, 4)), np.repeat(listed("xyz"), 2, axis=0)])
def test_a_list_of_scattered_points_is_refused(tmp_path, points):
    np.save(tmp_path / "scan.npy", points)
    with pytest.raises(SceneError, match="is a list of points that lie on no regular grid; export the heights as a grid"):
        feature(tmp_path / "scan.npy")
