"""Exports of a stored run, read back by other means: tables, NetCDF, VTK, JSON. The store is made up: nothing is solved."""

import base64
import json
import socket
import struct
import sys
import zlib
from xml.etree import ElementTree

import numpy as np
import pytest
from small_stores import SMALL, shot

import tehl_taichi as tehl
from tehl_taichi.scene.scales import Scales

A = Scales.of(SMALL).a
STEPS, FIRST = 4, -2e-5  # the feature goes 1e-5 m a step
FRAME = np.array([-1e-5, 0.0, 1e-5]), np.array([0.0, 2e-5])
SUMMARY = {"scene": "gear", "version": tehl.__version__, "wall_s": 2.0, "compile_s": 1.0, "steps": STEPS - 1,
           "grid": {"nx": 33, "ny": 9, "nz": 1}, "hertz": {"a_m": A}, "left_out": [], "work": {}, "clamps": {},
           "domain": {}, "warnings": [], "warning_codes": [],
           "steady": {"h_c_m": 4e-7, "h_min_m": 3e-7, "p_max_Pa": 2e9, "error": {}, "unknown": {}}, "fatigue": {"Fi_max": 0.7}}


def field(step, x, y):
    """A pressure that is linear in x, y and time, Pa."""
    return 1e8 * (1 + step) + 1e12 * x + 3e12 * y


def moment(step):
    """A snapshot whose fields are linear functions of the place, none of them the same."""
    found = shot(step)
    found.feature_x = FIRST + 1e-5 * step
    X, Y = np.meshgrid(found.x, found.y, indexing="ij")
    found.fields = {name: field(step, X, Y) * (n + 1) for n, name in enumerate(found.fields)}
    found.fields["pressure"], found.fields["contact"] = field(step, X, Y), (X > Y).astype("u1")
    return found


def fatigue_maps():
    """Results as a fatigue search stores them, Fi = 1 + x/m 1e5 + y/m 1e4."""
    x, y = FRAME
    stress = np.arange(18.0).reshape(3, 6)
    return {"feature_frame_x": (x, ["feature_frame_x"], "m", "x"), "feature_frame_y": (y, ["feature_frame_y"], "m", "y"),
            "Fi": (1 + 1e5 * x[:, None] + 1e4 * y, ["feature_frame_x", "feature_frame_y"], "1", "index"),
            "fatigue_depth": ([0.0, 1e-5], ["fatigue_depth"], "m", "below"),
            "findley_stress_under_row": (np.arange(6.0).reshape(2, 3), ["fatigue_depth", "feature_frame_x"], "Pa", "stress"),
            "worst_x_a": ([0.0, 1e-5, np.nan], ["moment"], "m", "feature"),
            "worst_stress": (stress, ["moment", "component"], "Pa", "stress")}


def run(path, finished=True, maps=None):
    from tehl_taichi.store.store import Store

    with Store.create(path, SMALL, moment(0), 50, {"steady_error": "{}"}) as made:
        for step in range(1, STEPS):
            made.append(moment(step))
        if finished:
            made.finish(SUMMARY, maps or fatigue_maps())
    return path


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    return run(tmp_path_factory.mktemp("export") / "gear-1.zarr")


def table(path):
    """{title: column} of a CSV file, by numpy alone."""
    titles = path.read_text().splitlines()[0].split(",")
    return dict(zip(titles, np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2).T))


def test_tables_have_units_in_their_header_and_the_numbers_of_the_store(stored, tmp_path):
    made = tehl.export(stored, "csv", tmp_path / "tables", at=(-1.1e-5 / A, 1e-5 / A))
    assert {file.name for file in made.iterdir()} == {
        "series.csv", "centreline_steady.csv", "fatigue.csv", "fatigue_under_row.csv", "worst_point.csv",
        *(f"centreline_at_{at / A:g}a.csv" for at in (-1.1e-5, 1e-5))}
    steps = np.arange(STEPS)
    series = table(made / "series.csv")
    assert np.allclose(series["time [s]"], 1e-6 * steps) and np.allclose(series["p_max_Pa [Pa]"], steps + 0.25)
    for name, step in (("steady", 0), (f"at_{-1.1e-5 / A:g}a", 1), (f"at_{1e-5 / A:g}a", 3)):
        line = table(made / f"centreline_{name}.csv")
        assert np.allclose(line["pressure [Pa]"], field(step, line["x [m]"], 0), rtol=1e-6), name
        assert line["x [m]"].size == 33 and np.allclose(line["time [s]"], 1e-6 * step, atol=0)
        assert np.allclose(line["feature_x [m]"], FIRST + 1e-5 * step)
        assert line["film [m]"][0] == pytest.approx(2e8 * (1 + step))


def test_the_fatigue_tables_name_the_place_of_every_value(stored, tmp_path):
    made = tehl.open(stored).export(path=tmp_path / "tables")
    found = table(made / "fatigue.csv")
    x, y = found["feature_frame_x [m]"], found["feature_frame_y [m]"]
    assert x.size == 6 and np.allclose(found["Fi [1]"], 1 + 1e5 * x + 1e4 * y, rtol=1e-8)
    under = table(made / "fatigue_under_row.csv")
    assert np.array_equal(under["findley_stress_under_row [Pa]"], np.arange(6.0))
    assert np.allclose(under["fatigue_depth [m]"], np.repeat([0, 1e-5], 3))
    worst = table(made / "worst_point.csv")
    assert np.array_equal(worst["sigma_xz [Pa]"], [4, 10]) and np.allclose(worst["feature_x [m]"], [0, 1e-5])


def test_what_lies_under_a_row_has_depths_of_its_own_where_others_were_listed(tmp_path):
    """Listed: two, at all points; under the row three."""
    maps, rungs = fatigue_maps(), [0.0, 2e-5, 4e-5]
    maps |= {"under_row_depth": (rungs, ["under_row_depth"], "m", "below"),
             "findley_stress_under_row": (np.arange(9.0).reshape(3, 3), ["under_row_depth", "feature_frame_x"], "Pa", "stress"),
             "findley_stress_contact_alone": (np.arange(3.0), ["under_row_depth"], "Pa", "stress"),
             "findley_stress_at_depth": (np.ones((2, 3, 2)), ["fatigue_depth", *maps["Fi"][1]], "Pa", "stress")}
    made = tehl.export(run(tmp_path / "a.zarr", maps=maps), "csv", tmp_path / "tables")
    for name, column, times in (("under_row", "under_row_depth [m]", 3), ("contact_alone", "under_row_depth [m]", 1)):
        assert np.allclose(table(made / f"fatigue_{name}.csv")[column], np.repeat(rungs, times))
    assert np.allclose(table(made / "fatigue_at_depths.csv")["fatigue_depth [m]"], np.repeat([0, 1e-5], 6))


def test_a_point_of_the_surface_goes_with_the_feature(stored, tmp_path):
    """Between the nodes too; only while it is on the grid, which begins at x = 0."""
    x, y = 1.5e-5, 0.7e-5
    made = tehl.export(stored, "csv", tmp_path / "tables", point=(x, y))
    found = table(made / "point_15um_7um.csv")
    steps = np.array([1, 2, 3])
    assert np.allclose(found["feature_x [m]"], FIRST + 1e-5 * steps) and np.allclose(found["time [s]"], 1e-6 * steps)
    at = FIRST + 1e-5 * steps + x
    assert np.allclose(found["x [m]"], at) and np.allclose(found["pressure [Pa]"], field(steps, at, y), rtol=1e-6)
    two = tehl.export(stored, "csv", tmp_path / "two", point=[(x, y), (0.0, 8e-5)])
    assert table(two / "point_0um_80um.csv")["pressure [Pa]"][-1] == pytest.approx(field(3, 1e-5, 8e-5), rel=1e-6)


def test_a_point_leaves_the_grid_at_its_end(stored, tmp_path):
    """Two and a half steps after the first moment."""
    x = tehl.open(stored).store.x[-1] - FIRST - 2.5e-5
    found = table(tehl.export(stored, "csv", tmp_path / "tables", point=(x, 0.0)) / f"point_{x * 1e6:g}um_0um.csv")
    assert np.allclose(found["time [s]"], 1e-6 * np.arange(3), atol=0)
    assert np.allclose(found["pressure [Pa]"], field(np.arange(3), found["x [m]"], 0.0), rtol=1e-6)


def test_a_position_half_a_step_beyond_the_passage_is_its_end(stored, tmp_path):
    first, last = FIRST + 1e-5, FIRST + 1e-5 * (STEPS - 1)
    for end, out, step in ((first, -1, 1), (last, 1, STEPS - 1)):
        at = (end + 0.4e-5 * out) / A
        line = table(tehl.export(stored, "csv", tmp_path / f"near{out}", at=at) / f"centreline_at_{at:g}a.csv")
        assert np.allclose(line["time [s]"], 1e-6 * step, atol=0)
        with pytest.raises(tehl.SceneError, match="the feature moves from"):
            tehl.export(stored, "csv", tmp_path / f"far{out}", at=(end + 0.6e-5 * out) / A)


def test_netcdf_is_the_whole_store(stored, tmp_path):
    xarray = pytest.importorskip("xarray")
    made = tehl.export(stored, "netcdf", tmp_path / "gear.nc")
    with xarray.open_dataset(made) as data, xarray.open_zarr(stored, chunks=None) as whole:
        assert data.equals(whole) and data.pressure.dims == ("time", "x", "y") and data.contact.dtype == np.uint8
        assert data.pressure.attrs == {"units": "Pa", "long_name": "film pressure"} and data.time.attrs["units"] == "s"
        assert float(data.pressure.isel(time=2, x=3, y=5)) == pytest.approx(field(2, 3e-5, 5e-5))
        assert json.loads(data.attrs["summary"]) == SUMMARY and data.attrs["finished"] == 1


def test_netcdf_says_what_it_needs(stored, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "h5netcdf", None)
    with pytest.raises(tehl.StoreError, match=r"NetCDF needs h5netcdf: pip install 'tehl_taichi\[xarray\]'"):
        tehl.export(stored, "netcdf", tmp_path / "gear.nc")
    assert list(tmp_path.iterdir()) == []


def arrays(element):
    """{name: array} below an element of a VTK file, by its rules: sizes of the block, then the block, each in base64."""
    out = {}
    for array in element.iter("DataArray"):
        blocks, size, _, packed = struct.unpack("<4Q", base64.b64decode(array.text[:44]))
        raw = zlib.decompress(base64.b64decode(array.text[44:]))
        assert blocks == 1 and len(raw) == size and len(base64.b64decode(array.text[44:])) == packed
        out[array.get("Name")] = np.frombuffer(raw, {"Float32": "<f4", "Float64": "<f8", "UInt8": "u1"}[array.get("type")])
    return out


def test_vtk_is_a_series_of_images_with_their_times(stored, tmp_path):
    made = tehl.export(stored, "vtk", tmp_path / "vtk")
    entries = ElementTree.parse(made / "passage.pvd").getroot().findall("Collection/DataSet")
    assert [float(entry.get("timestep")) for entry in entries] == pytest.approx([1e-6 * step for step in range(STEPS)])
    for step, entry in enumerate(entries):
        image = ElementTree.parse(made / entry.get("file")).getroot().find("ImageData")
        assert image.get("WholeExtent") == image.find("Piece").get("Extent") == "0 32 0 8 0 0"
        assert [float(v) for v in image.get("Spacing").split()] == pytest.approx([1e-5, 1e-5, 1])
        found = arrays(image.find("Piece/PointData"))
        assert found["pressure_Pa"].reshape(9, 33)[5, 3] == pytest.approx(field(step, 3e-5, 5e-5))
        assert {"film_m", "traction_x_a_Pa"} < set(found) and found["contact"].reshape(9, 33)[5, 6] == 1
        numbers = arrays(image.find("FieldData"))
        assert numbers["TimeValue"] == pytest.approx(1e-6 * step) and numbers["p_max_Pa"] == pytest.approx(step + 0.25)
    fatigue = ElementTree.parse(made / "fatigue.vti").getroot().find("ImageData")
    assert [float(v) for v in fatigue.get("Origin").split()] == pytest.approx([-1e-5, 0, 0])
    assert arrays(fatigue.find("Piece"))["Fi"] == pytest.approx((1 + 1e5 * FRAME[0] + 1e4 * FRAME[1][:, None]).ravel())


@pytest.mark.parametrize("format", ["csv", "netcdf", "vtk"])
def test_nothing_is_overwritten_unasked(stored, tmp_path, format):
    made = tehl.export(stored, format, tmp_path / "out")
    before = made.stat().st_ino
    with pytest.raises(tehl.StoreError, match="exists already"):
        tehl.export(stored, format, made)
    assert made.stat().st_ino == before
    assert tehl.export(stored, format, made, force=True) == made and list(tmp_path.iterdir()) == [made]
    if made.is_dir():
        (made / "scan.csv").write_text("mine")
        with pytest.raises(tehl.StoreError, match="holds scan.csv, which is not part of an export"):
            tehl.export(stored, format, made, force=True)
    with pytest.raises(tehl.StoreError, match="exists and is"):
        tehl.export(stored, "csv" if made.is_file() else "netcdf", made, force=True)


@pytest.mark.parametrize("stop", [OSError(28, "No space left on device"), KeyboardInterrupt()], ids=["full", "Ctrl-C"])
def test_half_an_export_is_left_nowhere(stored, tmp_path, monkeypatch, stop):
    from tehl_taichi.view.export import csv_tables

    made = tehl.export(stored, "csv", tmp_path / "out")
    before = {file.name: file.read_bytes() for file in made.iterdir()}

    def broken(reader, n):
        raise stop

    monkeypatch.setattr(csv_tables, "centreline", broken)
    for path in (made, tmp_path / "new"):
        with pytest.raises((tehl.StoreError, KeyboardInterrupt), match="No space left|^$"):
            tehl.export(stored, "csv", path, force=True)
    assert list(tmp_path.iterdir()) == [made] and {file.name: file.read_bytes() for file in made.iterdir()} == before


def test_what_a_killed_export_left_is_cleaned_up_by_the_next(stored, tmp_path):
    for name in ("out", "other"):
        (tmp_path / f".{name}.part" / "made").mkdir(parents=True)
        (tmp_path / f".{name}.part" / "made" / "series.csv").write_text("half")
        dead = {"program": "tehl_taichi", "pid": 2**22 + 1, "host": socket.gethostname(), "since": 0.0}
        (tmp_path / f".{name}.part" / ".lock").write_text(json.dumps(dead))
    made = tehl.export(stored, "csv", tmp_path / "out")
    assert list(tmp_path.iterdir()) == [made] and "half" not in (made / "series.csv").read_text()


def test_what_a_run_does_not_have_is_refused(stored, tmp_path):
    out = tmp_path / "out"
    for options, said in (({"at": 2.0}, "at = 2 a: the feature moves from -0.03 to 0.03 a"), ({"at": "0"}, "is not a number"),
                          ({"point": (1e-5, 0.01)}, "y of a point = 0.01 m is out of range; allowed: at least 0 m and"),
                          ({"point": (1.0, 0.01)}, "x of a point = 1 m is out of range; .* did you mean 1e-3 m"),
                          ({"point": (0.05, 0.0)}, "is never on the grid"), ({"point": 0.0}, "point = 0.0 must be two numbers"),
                          ({"format": "vtk", "at": np.zeros(1)}, "at and point apply to csv only"),
                          ({"format": "hdf"}, "format = 'hdf' is not known; allowed: csv, netcdf, vtk")):
        with pytest.raises(tehl.SceneError, match=said.replace("(", r"\(")):
            tehl.export(stored, path=out, **options)
    with pytest.raises(tehl.StoreError, match="is not a possible name"):
        tehl.export(stored, path="/")
    assert list(tmp_path.iterdir()) == []


def cli(*words):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    return CliRunner().invoke(app, [*map(str, words)])


def test_the_command_exports_beside_the_store_and_shows_json(stored, tmp_path):
    path = run(tmp_path / "broken.zarr", finished=False)
    done = cli("export", path, "--at", 0, "--point=1.5e-5,0")
    assert done.exit_code == 0 and done.stdout.strip() == str(tmp_path / "broken-csv")
    assert {"centreline_at_0a.csv", "point_15um_0um.csv"} < {file.name for file in (tmp_path / "broken-csv").iterdir()}
    assert "two numbers in m" in str(cli("export", path, "--point", "1").exception)
    shown = json.loads(cli("show", stored, "--json").stdout)
    assert shown == {**SUMMARY, "store": str(stored)}
    shown = json.loads(cli("show", path, "--json").stdout)
    assert shown["finished"] is False and shown["steps"] == STEPS - 1 and shown["grid"] == {"nx": 33, "ny": 9, "nz": 1}
