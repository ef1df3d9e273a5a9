"""Every reader of a store with a missing or truncated file: the numbers of the sound store, or an error that names the file."""

import shutil

import made_results
import pytest
from commands import here

import tehl_taichi as tehl

LINE = tehl.scene("furrow-line").replace(**{"grid.nx": 64, "thermal.on": False})
FILES = ("x/c/0", "y/c/0", "contact/c.3.0.0", "pressure/c.2.0.0", "p_max_Pa/c/0", "Fi/c/0/0", "feature_frame_x/c/0",
         "worst_stress/c/0/0", "x/zarr.json", "Fi/zarr.json", "zarr.json", ".checkpoints/5.npz")
DRAWN = ("x/c/0", "pressure/c.2.0.0", "Fi/c/0/0")  # for the readers that take half a second


def maps():
    """Results of a search with the dimensions that they really have."""
    found = made_results.maps(9, 1)
    dims = {"Fi": ["feature_frame_x", "feature_frame_y"], "findley_stress_under_row": ["fatigue_depth", "feature_frame_x"]}
    for name, (values, own, *rest) in found.items():
        last = name.rpartition("_")[2]
        of_point = {"a": ["moment"], "stress": ["moment", "component"], "normal": ["direction"], "circle": ["of_circle"]}
        usual = of_point.get(last, own) if name.startswith("worst") else [name]
        found[name] = (values, dims.get(name, ["fatigue_depth"] if name.endswith("alone") else usual), *rest)
    return found


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return made_results.run(tmp_path_factory.mktemp("damaged") / "a.zarr", LINE, search=made_results.fatigue(), found=maps())


def loaded(path, out):
    data = tehl.open(path).to_xarray().load()
    return {name: (array.dims, array.values.tobytes()) for name, array in data.variables.items()}


def shown(path, out):
    done = here("show", path)
    if done.returncode:
        raise tehl.StoreError(done.stderr)
    return done.stdout


def tables(path, out):
    return texts(tehl.export(path, "csv", out, point=(0.0, 0.0)))


def images(path, out):
    return texts(tehl.export(path, "vtk", out))


def texts(folder):
    return {file.name: file.read_bytes() for file in folder.iterdir()}


def netcdf(path, out):
    import xarray

    with xarray.open_dataset(tehl.export(path, "netcdf", out), decode_times=False) as data:
        return {name: (array.dims, array.values.tobytes()) for name, array in data.variables.items()}


def drawn(path, out):
    figures = tehl.open(path).plot().values()
    return [line.get_xydata().tobytes() for figure in figures for ax in figure.axes for line in ax.lines]


def page(path, out):
    return tehl.report(path, out).read_bytes()


QUICK, SLOW = (loaded, shown, tables, images), (netcdf, drawn, page)


@pytest.fixture(scope="module")
def sound(path, tmp_path_factory):
    """{reader: its output of the sound store}."""
    return {read: read(path, tmp_path_factory.mktemp(read.__name__) / "out") for read in (*QUICK, *SLOW)}


def output(read, path, out):
    """(output or None, text of the error)."""
    try:
        return read(path, out), ""
    except tehl.Error as error:
        return None, str(error)
    finally:
        shutil.rmtree(out, ignore_errors=True)
        out.unlink(missing_ok=True)


@pytest.fixture
def damaged(request, path):
    """The store without a file, or with half of it."""
    name, half = request.param
    file, content = path / name, (path / name).read_bytes()
    file.unlink()
    if half:
        file.write_bytes(content[: len(content) // 2])
    yield name
    file.write_bytes(content)


@pytest.mark.parametrize("damaged", [(name, half) for name in FILES for half in (False, True)], indirect=True)
def test_no_reader_returns_other_numbers(path, sound, damaged, tmp_path):
    refused = set()
    for read in QUICK + SLOW * (damaged in DRAWN):
        found, said = output(read, path, tmp_path / "out")
        assert said or found == sound[read], read.__name__
        assert not said or str((path / damaged).parent) in said, said
        refused |= {read} if said else set()
    assert loaded in refused or "/c" not in damaged  # it reads every chunk
