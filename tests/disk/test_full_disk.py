"""A disk that fills up while a file is written: a sentence, nothing half is left, what was there stays."""

import errno
import os
import re
import shutil
import subprocess

import made_results
import numpy as np
import pytest
from commands import process
from small_stores import SMALL

import tehl_taichi as tehl
from tehl_taichi.errors import StoreError


@pytest.fixture(scope="module")
def noise(tmp_path_factory):
    """A store of numbers that no codec packs."""
    from small_stores import shot

    from tehl_taichi.store.store import Store

    path, draw = tmp_path_factory.mktemp("runs") / "a.zarr", np.random.default_rng(0)

    def noisy(step):
        made = shot(step, SMALL)
        made.fields = {name: draw.random(field.shape) * (name != "contact") for name, field in made.fields.items()}
        return made

    with Store.create(path, SMALL, noisy(0), 50, {"runtime": "{}"}) as made:
        for step in range(1, 6):
            made.append(noisy(step), noisy(step).state)
    return path


@pytest.fixture(params=[0, 40_000, 60_000, 90_000])
def disk(request, monkeypatch):
    """A disk with room for so many bytes, so far as Python's own files go."""
    from tehl_taichi.view.export.netcdf_file import _Patient

    left, some = [request.param], _Patient.some

    def full(self, data):
        if not left[0]:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        taken = data[: left[0]]
        left[0] -= len(taken)
        return some(self, taken)

    monkeypatch.setattr(_Patient, "some", full)


def test_netcdf_on_a_full_disk(noise, tmp_path, disk):
    pytest.importorskip("h5netcdf")
    with pytest.raises(StoreError, match=r"cannot write .*a\.nc: No space left on device"):
        tehl.export(noise, "netcdf", tmp_path / "a.nc")
    assert list(tmp_path.iterdir()) == []


@pytest.fixture
def small_disk(tmp_path):
    """A file system of 40 kB, where one may be mounted."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mounted = shutil.which("mount") and subprocess.run(["mount", "-t", "tmpfs", "-o", "size=40k", "none", folder],
                                                       capture_output=True).returncode == 0
    if not mounted:
        pytest.skip("no file system can be mounted here")
    yield folder
    subprocess.run(["umount", folder], check=True)


SLOW = [pytest.param(words, marks=pytest.mark.slow)
        for words in (("plot", "--dpi", 600), ("report",), ("animate", "--dpi", 300))]


@pytest.mark.parametrize("command", [("export", "--format", "netcdf"), ("export", "--format", "vtk"), *SLOW])
def test_commands_on_a_full_disk(noise, small_disk, command):
    for module in ("h5netcdf", "matplotlib", "plotly"):
        pytest.importorskip(module)
    name, *more = command
    out = small_disk / ("a" if name in ("export", "plot") else "a.html" if name == "report" else "a.gif")
    done = process(name, noise, "--out", out, *more)
    assert done.returncode == 1 and "No space left on device" in done.stderr and "Traceback" not in done.stderr
    assert not out.exists() and not [path for path in small_disk.rglob("*") if path.name.startswith(".")]


@pytest.mark.parametrize("number, code", [(errno.ENOSPC, 1), (errno.EDQUOT, 1), (errno.EFBIG, 1), (errno.EIO, 1),
                                          (errno.EACCES, 2), (errno.EROFS, 2), (errno.ENOTDIR, 2), (errno.ENAMETOOLONG, 2)])
def test_a_full_disk_is_no_invalid_input(tmp_path, monkeypatch, number, code):
    """One exit code wherever the disk refuses: of a single file, of a draft and of figures."""
    from tehl_taichi.disk import files, user_files
    from tehl_taichi.view.figures import figure_style

    def refuse(*_, **__):
        raise OSError(number, os.strerror(number))

    def figures_in(folder):
        with figure_style.folder_of_figures(folder):
            pytest.fail("it was made")

    monkeypatch.setattr("pathlib.Path.mkdir", refuse)
    for write in (lambda: user_files.text(tmp_path / "a.md", "text"), lambda: figures_in(tmp_path / "a")):
        with pytest.raises(StoreError, match=re.escape(os.strerror(number))) as found:
            write()
        assert found.value.exit_code == code
    with pytest.raises(StoreError) as found, files.disk_errors(tmp_path):
        refuse()
    assert found.value.exit_code == code


@pytest.mark.parametrize("error, seen", [(OSError(errno.ENOSPC, "No space left on device"), StoreError),
                                         (KeyboardInterrupt(), KeyboardInterrupt)])
@pytest.mark.parametrize("made", [(), ("new",), ("new", "pics")])
def test_figures_that_are_not_written_leave_no_new_folder(noise, tmp_path, monkeypatch, error, seen, made):
    """Folders that were there stay."""
    pytest.importorskip("matplotlib")
    from matplotlib.figure import Figure

    def full(*_, **__):
        raise error

    tmp_path.joinpath(*made).mkdir(parents=True, exist_ok=True)
    before = sorted(tmp_path.rglob("*"))
    monkeypatch.setattr(Figure, "savefig", full)
    with pytest.raises(seen):
        tehl.open(noise).save_figures(tmp_path / "new" / "pics", dpi=40)
    assert sorted(tmp_path.rglob("*")) == before


def test_a_result_that_is_there_stays(tmp_path, monkeypatch):
    pytest.importorskip("matplotlib")
    from matplotlib.figure import Figure

    path = made_results.run(tmp_path / "a.zarr", SMALL, 3)
    before = {file: file.read_bytes() for file in tehl.open(path).save_figures(dpi=40)}

    def full(self, target, **_):
        target.write_bytes(b"half")
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Figure, "savefig", full)
    with pytest.raises(StoreError, match="No space left on device"):
        tehl.open(path).save_figures(dpi=40, force=True)
    assert {file: file.read_bytes() for file in before} == before and len(list((tmp_path / "a").iterdir())) == len(before)
