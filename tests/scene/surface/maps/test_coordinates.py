"""Coordinates beside the heights of a map are no heights."""

import numpy as np
import pytest
from map_feature import feature

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface.maps import coordinates, height_map, point_lists

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
        assert (found.x or 0) == pytest.approx(0 if x is None else x[1] - x[0], rel=0.01)
        assert (found.y or 0) == pytest.approx(0 if y is None else y[1] - y[0], rel=0.01)


LONG = np.round(np.random.default_rng(6).standard_normal((24, 40)).cumsum(0).cumsum(1) / 40, 4)


def printed(step, count, digits, start=0.0, form="f"):
    """Even coordinates as a file has them, with that many digits after the point."""
    return np.array([f"{start + step * n:.{digits}{form}}" for n in range(count)], float)


@pytest.mark.parametrize("corner", [np.nan, 0.0, 117.0])
@pytest.mark.parametrize("x, y", [
    (printed(1.6e-3, 40, 3), printed(2.4e-3, 24, 3)), (printed(-1.6e-3, 40, 3, 0.0312), printed(0.65e-3, 24, 3, -0.0075)),
    (printed(0.36, 40, 1), printed(0.36, 24, 1)), (printed(1.6384e-6, 40, 2, form="e"), printed(3.2768e-6, 24, 2, form="e")),
    (printed(1.6e-3, 40, 3), None), (None, printed(1.6e-3, 24, 3))], ids=["mm", "falling", "um", "m", "row", "column"])
def test_coordinates_with_few_digits_are_coordinates(corner, x, y):
    assert any(many is not None and np.ptp(np.diff(many)) > 0.05 * abs(many[1] - many[0]) for many in (x, y)), "uneven"
    found = coordinates.separate(framed(x, y, corner, LONG))
    assert np.array_equal(found.heights, LONG)
    for step, many in ((found.x, x), (found.y, y)):
        assert many is None and step is None or step == pytest.approx((many[-1] - many[0]) / (many.size - 1), rel=1e-9)


@pytest.mark.parametrize("texts, digits", [
    ("0.000 0.002 0.010 0.011", 1e-3), ("0 1.5 100 101.5", 0.1), ("100 200 -400", 1.0), ("0 0", 1.0),
    ("1.638e-06 1.147e-05 0", [1e-9, 1e-8, 1e-9])])
def test_the_last_digit_is_the_printed_one(texts, digits):
    np.testing.assert_allclose(coordinates.last_digits(np.array(texts.split(), float)), digits, rtol=1e-12)


def test_rounded_surfaces_stay_as_they_are():
    """Tilted and curved ones, rough by less than a digit or more: their rows are even within their digits, too."""
    rng, x, y = np.random.default_rng(11), np.arange(30.0), np.arange(20.0)[:, None]
    for rough in rng.choice([0, 0.1, 1, 5], 300):
        (tilt_x, tilt_y), bent = rng.uniform(-4, 4, 2), rng.choice([0, 0.05])
        heights = np.round(tilt_x * x + tilt_y * y + bent * (x - 14) ** 2 + rough * rng.standard_normal((20, 30)))
        heights[0, 0] = rng.choice([np.nan, heights[0, 0]])
        found = coordinates.separate(heights)
        assert found.found_lines == () and found.heights.shape == (20, 30) and coordinates.uneven(heights) == ""


@pytest.mark.parametrize("power", [0.7, 1.5, 2.0])
@pytest.mark.parametrize("name", ["row", "column"])
def test_uneven_coordinates_beside_an_empty_corner_are_refused(tmp_path, name, power):
    """They would be read as heights."""
    x, y = (np.round(2.0 * np.arange(n) ** (power if own == name else 1.0), 3) for own, n in (("row", 40), ("column", 24)))
    said = f"has a first {name} from 0 to [0-9.]+ beside an empty corner: coordinates at uneven distances. Export the heights"
    for corner in ("", "nan"):
        rows = [",".join(map(str, row)) for row in framed(x, y, 0.0, LONG)]
        (tmp_path / "a.csv").write_text("\n".join([corner + rows[0].removeprefix("0.0"), *rows[1:]]))
        with pytest.raises(SceneError, match=said):
            feature(tmp_path / "a.csv", pixel=2e-6)
    even = framed(2.0 * np.arange(40), None, heights=LONG)
    even[0, 0] = np.nan  # the first coordinate is missing: the others have their distance
    assert coordinates.separate(even).x == 2.0 and coordinates.separate(even).found_lines == ("a row of coordinates (2 to 78)",)


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
    assert np.array_equal(height_map.table_of(tmp_path / "scan.csv").values, HEIGHTS)
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
    found = height_map.table_of(tmp_path / "scan.xyz").values
    assert np.isnan(found).sum() == 3 and np.array_equal(found[~np.isnan(found)], HEIGHTS[~np.isnan(found)])


def test_a_list_with_few_digits_is_a_grid(tmp_path):
    x, y = printed(1.6e-3, 40, 3), printed(2.4e-3, 24, 3)
    columns = [each.ravel() for each in np.meshgrid(x, y)]
    np.save(tmp_path / "scan.npy", np.column_stack([*columns, LONG.ravel()]))
    found = height_map.table_of(tmp_path / "scan.npy")
    assert np.array_equal(found.values, LONG) and found.spacing == pytest.approx((x[-1] / 39, y[-1] / 23))


@pytest.mark.parametrize("points", [np.random.default_rng(1).random((400, 4)), np.repeat(listed("xyz"), 2, axis=0)])
def test_a_list_of_scattered_points_is_refused(tmp_path, points):
    np.save(tmp_path / "scan.npy", points)
    with pytest.raises(SceneError, match="is a list of points that lie on no regular grid; export the heights as a grid"):
        feature(tmp_path / "scan.npy")


def test_a_list_of_few_rounded_points_is_a_grid():
    """0, 0.17, 0.33, 0.5, ... along both axes; places on another grid, 0, 0.1, 0.3, ... are none."""
    z = np.random.default_rng(4).random((7, 7))
    for places, known in ((np.round(np.linspace(0, 1, 7), 2), True), (np.cumsum(np.arange(7) / 10), False)):
        x, y = (one.ravel() for one in np.meshgrid(places, places))
        found = point_lists.grid_of(np.column_stack([x, y, z.ravel()]))
        assert (found is not None) == known and (not known or np.array_equal(found[0], z))


def test_a_list_may_lack_nearly_half_of_its_grid():
    """Of 168 points 100 are listed, in any order; the others are holes."""
    y, x = np.mgrid[:12, :14]
    z, listed = np.random.default_rng(3).normal(size=(12, 14)), np.random.default_rng(4).permutation(168)[:100]
    points = np.column_stack([2.0 * x.ravel(), 3.0 * y.ravel(), z.ravel()])[listed]
    heights, step_x, step_y = point_lists.grid_of(points)
    assert (heights.shape, step_x, step_y) == ((12, 14), 2.0, 3.0) and np.isfinite(heights).sum() == 100
    np.testing.assert_array_equal(heights.ravel()[listed], z.ravel()[listed])
    assert point_lists.grid_of(points[:70]) is None
