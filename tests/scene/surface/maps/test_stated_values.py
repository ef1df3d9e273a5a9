"""Unit and distances that files state: taken, printed, compared with the keys of the scene."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest
from commands import here as tehl
from map_feature import feature

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import scan_scene, scene, scene_file
from tehl_taichi.scene.surface.maps import height_map, stated_values

ROWS, COLUMNS = 30, 50
HEIGHTS = np.round(0.2 * np.sin(np.add.outer(np.arange(ROWS) / 4, np.arange(COLUMNS) / 3)), 4)
TABLE = ["\t".join(map(str, row)) for row in HEIGHTS]


def stated(*lines, shape=(ROWS, COLUMNS)):
    return stated_values.in_header(lines, shape)


@pytest.mark.parametrize("line, unit", [
    ("# Value units: m", "m"), ("Height units\t5\t4\t\u00b5m", "um"), ("Height units\t5\t4\t\ufffdm", "um"),
    ("z unit = nm", "nm"), ('"Unit","um"', "um"), ("Unit=mm", "mm"), ("Units: micrometers", "um"), ("Z-Unit;Nanometer", "nm"),
    ("x [mm];z [um]", "um"),
    ("Pixel_size\t0.5 um", ""), ("Value units: V", ""), ("Unit of time: s", ""), ("made in 2024, m", ""),
    ("Height: 10 um", "")])
def test_units_of_heights(line, unit):
    assert stated(line).unit == unit


@pytest.mark.parametrize("line, x, y", [
    ("Pixel size: 0.5 um", 0.5e-6, 0.5e-6), ("Pixel_size\t0.0016 mm", 1.6e-6, 1.6e-6),
    ('"XY calibration",277.8,"nm"', 277.8e-9, 277.8e-9),
    ("x-spacing = 2e-6 m", 2e-6, None), ("Spacing Y [um]; 1,8", None, 1.8e-6), ("dx: 3 nm", 3e-9, None),
    ("Width: 100 \u00b5m", 2e-6, None), ("# Height: 60.0 um", None, 2e-6), ("Y Length: 0.06 mm", None, 2e-6),
    ("X Size\t50", None, None), ("Pixel size: 0.5", None, None), ("Lateral resolution: 0.4 um", None, None),
    ("Working distance: 4 mm", None, None)])
def test_distances(line, x, y):
    found = stated(line)
    assert (found.x[:1], found.y[:1]) == tuple(() if each is None else (pytest.approx(each),) for each in (x, y))


@pytest.mark.parametrize("width, count, first", [
    ("236.0 um", 60, 4e-6), ("240.0 um", 60, 4e-6), ("10.00 um", 512, 10e-6 / 512), ("118 um", 60, 2e-6),
    ("100 um", 101, 1e-6)])
def test_a_length_is_that_of_all_intervals_or_of_those_between(width, count, first):
    found = stated(f"Width: {width}", shape=(9, count)).x
    length = float(width.split()[0]) * 1e-6
    assert found[0] == pytest.approx(first) and sorted(found) == pytest.approx([length / count, length / (count - 1)])


GWYDDION = ["# Channel: Height", "# Width: 98.00 \u00b5m", "# Height: 58.00 \u00b5m", "# Value units: um"]


@pytest.fixture
def scan(tmp_path):
    (tmp_path / "a.txt").write_text("\n".join([*GWYDDION, *TABLE]), encoding="utf-8")
    return tmp_path / "a.txt"


def test_they_are_taken_where_the_scene_gives_none(scan):
    f = feature(scan, unit="", pixel=0.0, taper=5e-6)
    assert (f.unit, f.pixel, f.steps) == ("um", 2e-6, (2e-6, 2e-6))
    assert f == feature(scan, unit="um", pixel=2e-6, pixel_y=2e-6 * 1.001, taper=5e-6) or f.pixel_y == 0
    first, _ = f.kind.preview(f, scene("gear"))
    assert "2 um apart (as the file says)" in first and "heights in um (as the file says)" in first
    np.testing.assert_array_equal(f.heights, HEIGHTS)


@pytest.mark.parametrize("keys, words", [
    ({"unit": "nm"}, "feature.unit = 'nm' contradicts feature.file = .*, which says 'um'"),
    ({"pixel": 2.2e-6}, "feature.pixel = 2.2e-06 m contradicts .*, which says 2e-06 m"),
    ({"pixel_y": 1e-6}, "feature.pixel_y = 1e-06 m contradicts .*, which says 2e-06 m")])
def test_a_contradiction_is_refused_with_both_values(scan, keys, words):
    with pytest.raises(SceneError, match=words):
        feature(scan, **{"taper": 5e-6, "pixel": 2e-6, **keys})
    assert feature(scan, pixel=1.96e-6, taper=5e-6).pixel == 1.96e-6  # 98 um over 50 points


def test_rows_farther_apart_than_points_are_taken_too(tmp_path):
    (tmp_path / "a.txt").write_text("\n".join(["x spacing: 2 um", "y spacing: 5 um", *TABLE]))
    assert feature(tmp_path / "a.txt", pixel=0.0, taper=5e-6).steps == (2e-6, 5e-6) == feature(
        tmp_path / "a.txt", pixel=2e-6, taper=5e-6).steps


def test_absurd_distances_are_refused_and_the_user_may_correct_them(tmp_path):
    (tmp_path / "a.txt").write_text("\n".join(["Pixel size: 2 mm", *TABLE]))
    with pytest.raises(SceneError, match="says that its points are 0.002 m apart; allowed: .* Set feature.pixel"):
        feature(tmp_path / "a.txt", pixel=0.0)
    assert feature(tmp_path / "a.txt", pixel=2e-6, taper=5e-6).steps == (2e-6, 2e-6)


def test_places_of_a_profile_in_the_unit_of_its_file(tmp_path):
    lines = ["[PROFILE_HEADER]", "Unit=mm", "[PROFILE_VALUES]",
             *(f"{n}={0.004 * n:.3f} {z / 1e3:.7f}" for n, z in enumerate(HEIGHTS[0]))]
    (tmp_path / "a.txt").write_text("\n".join(lines))
    f = feature(tmp_path / "a.txt", shape="profile", unit="", pixel=0.0, taper=5e-6)
    assert (f.unit, f.pixel) == ("mm", 4e-6)
    (tmp_path / "b.txt").write_text("\n".join(line.partition("=")[2] for line in lines[3:]))
    with pytest.raises(SceneError, match="feature.pixel is missing.*; its coordinates are 0.004 apart: .*4e-06 m if .* mm"):
        feature(tmp_path / "b.txt", shape="profile", unit="mm", pixel=0.0)


@pytest.mark.parametrize("unit, sizes, steps", [("\u00c5", (50.0, 60.0), (1e-6, 2e-6)), ("nm", (50.0, 60.0), (1e-9, 2e-9)),
                                               (None, (50.0, 60.0), ()), ("um", None, ())])
def test_the_reader_of_instruments(tmp_path, monkeypatch, unit, sizes, steps):
    def read(name, unit=unit):
        return SimpleNamespace(dim=2, unit=unit, heights=lambda: HEIGHTS.T, physical_sizes=sizes, nb_grid_pts=(COLUMNS, ROWS),
                               to_unit=lambda other: read(name, other))

    monkeypatch.setitem(sys.modules, "SurfaceTopography", SimpleNamespace(read_topography=read))
    (tmp_path / "a.sur").write_bytes(b"x")
    found = height_map.table_of(tmp_path / "a.sur").stated
    assert (*found.x, *found.y) == pytest.approx(steps) and found.unit == {"nm": "nm", None: ""}.get(unit, "um")


def test_a_line_whose_places_count_has_its_distance_too(tmp_path, monkeypatch):
    read = SimpleNamespace(dim=1, unit="um", heights=lambda: HEIGHTS[0], positions=lambda: 1.0 * np.arange(COLUMNS))
    monkeypatch.setitem(sys.modules, "SurfaceTopography", SimpleNamespace(read_topography=lambda name: read))
    (tmp_path / "a.sur").write_bytes(b"x")
    assert height_map.table_of(tmp_path / "a.sur").stated.x == pytest.approx((1e-6,))


def test_a_reader_that_wants_sizes_and_prints(tmp_path, monkeypatch, capsys):
    """Sizes of a file without any are nothing; the scene has to give the pixel."""
    def read(name, physical_sizes=None):
        print("could not reshape data")
        if physical_sizes is None:
            raise ValueError("`physical_sizes` could not be extracted")
        return SimpleNamespace(dim=2, unit="um", heights=lambda: HEIGHTS.T, physical_sizes=physical_sizes,
                               nb_grid_pts=(COLUMNS, ROWS))

    monkeypatch.setitem(sys.modules, "SurfaceTopography", SimpleNamespace(read_topography=read))
    (tmp_path / "a.sur").write_bytes(b"x")
    assert height_map.table_of(tmp_path / "a.sur").stated == stated_values.Stated("um")
    assert "".join(capsys.readouterr()) == ""


def test_a_new_scene_has_them(scan, tmp_path):
    done = tehl("new", "mine.toml", "--scan", "a.txt", cwd=tmp_path)
    assert "heights in um, points 2 um apart as the file says" in done.stdout and "fill in" not in done.stdout, done.stderr
    f, = scene_file.load(tmp_path / "mine.toml").features
    assert (f.unit, f.pixel) == ("um", 2e-6)
    with pytest.raises(SceneError, match="contradicts"):
        scan_scene.new(tmp_path / "b.toml", "gear", scan, "nm")
    assert not (tmp_path / "b.toml").exists()


@pytest.mark.parametrize("kind", ["surface", "profile"])
def test_x3p(tmp_path, kind):
    """As x3pio writes it, with a point that was not measured; m."""
    x3pio = pytest.importorskip("x3pio")
    heights = 1e-6 * (HEIGHTS if kind == "surface" else HEIGHTS[0])
    heights[..., 7] = np.where(np.arange(heights[..., 7].size).reshape(heights[..., 7].shape) == 0, np.nan, heights[..., 7])
    x3pio.write(tmp_path / "a.x3p", heights, x_scale=2e-6, **({"y_scale": 3e-6} if kind == "surface" else {}))
    f = feature(tmp_path / "a.x3p", shape="map" if kind == "surface" else "profile", unit="", pixel=0.0, taper=5e-6)
    np.testing.assert_allclose(f.heights, np.atleast_2d(heights), rtol=1e-12)
    assert (f.unit, f.pixel, f.pixel_y) == ("m", 2e-6, 3e-6 if kind == "surface" else 0.0)
    (tmp_path / "b.x3p").write_bytes(b"PK\x03\x04 nothing")
    with pytest.raises(SceneError, match="cannot read heights from .*b.x3p: ") as caught:
        feature(tmp_path / "b.x3p")
    assert len(str(caught.value)) < 300 and "\n" not in str(caught.value)


@pytest.mark.parametrize("off", [0.0, 0.9e-6])
@pytest.mark.parametrize("kind", ["surface", "profile"])
def test_an_x3p_with_the_coordinates_of_each_point(tmp_path, kind, off):
    """Even ones give the distances; of uneven ones a profile is interpolated, a map refused."""
    x3pio = pytest.importorskip("x3pio")
    y, x = np.mgrid[:10, :14] * np.reshape((3e-6, 2e-6), (2, 1, 1))
    x[:, 6] += off
    z = 0.01 * x + 0.005 * y
    z[0, 3] = z[0, 3] if kind == "profile" else np.nan
    points = np.stack([x, y, z], axis=-1)
    made = x3pio.Surface.from_points(points) if kind == "surface" else x3pio.Profile.from_points(points[0])
    made.save(tmp_path / "a.x3p")
    keys = {"shape": "map" if kind == "surface" else "profile", "unit": "", "pixel": 0.0, "level": "none", "taper": 0.0}
    if kind == "surface" and off:
        with pytest.raises(SceneError, match="lie on no regular grid"):
            feature(tmp_path / "a.x3p", **{**keys, "pixel": 2e-6})
        return
    f = feature(tmp_path / "a.x3p", **keys)
    at, middle = np.linspace(-9e-6, 9e-6, 23), 13.5e-6 if kind == "surface" else 0.0
    assert (f.unit, f.steps[0]) == ("m", pytest.approx(2e-6))
    assert f.height_at(at, 0 * at) == pytest.approx(0.01 * (at + 13e-6) + 0.005 * middle, abs=1e-13)
    assert f.holes.sum() == np.isnan(z).sum() * (kind == "surface")
