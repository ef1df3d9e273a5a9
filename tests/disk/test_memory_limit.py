"""What files declare and grids need is compared with what there is, before memory is asked for."""

import io
import json
import os
import resource
import subprocess
import sys
import zipfile

import made_results
import numpy as np
import pytest
from commands import CALL, here
from numcodecs import zstd
from small_stores import SMALL, store

import tehl_taichi as tehl
from tehl_taichi.disk import files, memory_limit, npy
from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.scene import memory_demand, scene
from tehl_taichi.scene.surface.maps import height_map
from tehl_taichi.store import array_file, chunks
from tehl_taichi.store.store import Store

BOMB = zstd.compress(bytes(3 * 10**7), 19, True)  # 30 MB in a kB


@pytest.fixture(autouse=True)
def watched():
    """No test takes 25 MB: what is refused is never in memory."""
    import tracemalloc

    tracemalloc.start()
    yield
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 2.5e7, peak


@pytest.mark.parametrize("count", [0, 1, 100, 255, 256, 300, 65791, 65792, 70000])
def test_the_size_of_a_frame_is_read_as_it_was_written(count):
    assert chunks.declared_bytes(chunks.compressed(np.zeros(count, "u1"), "u1")) == count or count == 0
    assert chunks.declared_bytes(zstd.compress(bytes(range(256)) * (count // 256 + 1), 3)) == 256 * (count // 256 + 1)
    assert chunks.declared_bytes(b"no frame of zstd at all") is None


@pytest.mark.parametrize("kind, alone, size", [(0, 1, 200), (0, 0, None), (1, 0, 256), (1, 1, 65791), (2, 0, 70000),
                                               (3, 1, 2**40 + 5)])
@pytest.mark.parametrize("dictionary", [0, 1, 2, 3])
def test_the_size_that_a_frame_declares_is_read_behind_its_window_and_dictionary(kind, alone, size, dictionary):
    """Headers by RFC 8878: a descriptor, a window unless the frame is one segment, 0, 1, 2 or 4 bytes of a dictionary, the size
    (of kind 1 less 256); the bits of both other flags do not matter."""
    length = {0: 1 if alone else 0, 1: 2, 2: 4, 3: 8}[kind]
    written = (size - 256 * (kind == 1)).to_bytes(length, "little") if size else b""
    for flags in (0, 4, 16):
        descriptor = bytes([kind << 6 | alone << 5 | flags | dictionary])
        head = b"\x28\xb5\x2f\xfd" + descriptor + b"\x58" * (1 - alone) + b"\x77" * (0, 1, 2, 4)[dictionary]
        assert chunks.declared_bytes(head + written + b"\x99" * 9) == size
    assert chunks.declared_bytes(b"\x29" + head[1:] + written + b"\x99" * 9) is None and chunks.declared_bytes(head[:5]) is None


@pytest.mark.parametrize("name", ["pressure/c.0.0.0", "h_min_m/c/0", "step/c/0", "x/c/0"])
def test_a_chunk_that_declares_more_than_its_array(tmp_path, name):
    path = store(tmp_path / "a.zarr").path
    (path / name).write_bytes(BOMB)
    with pytest.raises(StoreError, match=rf"{name}.*it declares 30000000 bytes"):
        found = Store.open(path)
        assert found.fields(0) and found.x.size


def test_a_frame_that_does_not_say_its_size(tmp_path):
    """A stream, of any size."""
    path = store(tmp_path / "a.zarr").path
    (path / "pressure" / "c.0.0.0").write_bytes(b"\x28\xb5\x2f\xfd\x00\x58" + BOMB[10:])
    with pytest.raises(StoreError, match="is damaged"):
        Store.open(path).fields(0)


def edit(path, change):
    data = json.loads(path.read_text())
    change(data)
    path.write_text(json.dumps(data))


@pytest.mark.parametrize("shape", [[10**12], [10**7, 10**7]])
def test_a_huge_shape_in_the_metadata_of_an_array(tmp_path, shape):
    path = made_results.run(tmp_path / "a.zarr", SMALL, 3, made_results.fatigue())

    def grow(data):
        data["shape"] = data["chunk_grid"]["configuration"]["chunk_shape"] = shape

    edit(path / "Fi" / "zarr.json", grow)
    with pytest.raises(StoreError, match=r"the array .*Fi needs .* of memory; .* are available|Fi is damaged"):
        Store.open(path).map("Fi")
    for name in ("pressure", "h_min_m"):
        grid = {"name": "regular", "configuration": {"chunk_shape": shape}}
        found = json.loads((path / "zarr.json").read_text())
        found["consolidated_metadata"]["metadata"][name].update(shape=[3, *shape], chunk_grid=grid)
        (path / "zarr.json").write_text(json.dumps(found))
        with pytest.raises(StoreError):
            Store.open(path).fields(0)


def test_codecs_that_are_not_ours(tmp_path):
    path = made_results.run(tmp_path / "a.zarr", SMALL, 3, made_results.fatigue())
    edit(path / "Fi" / "zarr.json", lambda data: data["codecs"].append({"name": "gzip", "configuration": {"level": 1}}))
    with pytest.raises(StoreError, match="Fi is damaged: its codecs are not those of a store"):
        Store.open(path).map("Fi")


@pytest.mark.parametrize("name", ["zarr.json", "pressure/c.0.0.0", "x/zarr.json", "flank.json", "cases.jsonl", "a.toml"])
def test_files_without_end(tmp_path, name):
    """Holes of a terabyte cost nothing on a disk."""
    path = store(tmp_path / "a.zarr").path
    for left in ("zarr.json",) if name == "flank.json" else ():
        (path / left).unlink()
    with open(path / name, "w") as file:
        file.truncate(10**12)
    if name == "cases.jsonl":
        from tehl_taichi.runs.sweep import case_records

        with pytest.raises(StoreError, match="it has 1000000000000 bytes"):
            list(case_records.read(path))
        return
    with pytest.raises((StoreError, SceneError), match="1000000000000 bytes"):
        if name == "a.toml":
            tehl.scene(path / name)
        else:
            tehl.open(path).store.fields(0), tehl.open(path).store.x
            array_file.read_whole(path / "x")


def test_a_device_is_no_file():
    for path in ("/dev/zero", "/dev/null"):
        with pytest.raises(OSError, match="not a regular file"):
            files.content(path)
    found = here("run", "/dev/zero")
    assert found.returncode == 2 and "not a regular file" in found.stderr


def header(shape, dtype="<f8"):
    out = io.BytesIO()
    np.lib.format.write_array_header_1_0(out, {"descr": dtype, "fortran_order": False, "shape": shape})
    return out.getvalue()


@pytest.mark.parametrize("shape", [(10**6, 10**6), (10**12,), (2**62, 4)])
def test_heights_that_a_header_only_declares(tmp_path, shape):
    path = tmp_path / "scan.npy"
    path.write_bytes(header(shape) + bytes(800))
    with pytest.raises(SceneError, match=r"its header declares .* numbers, .* TB, and the file holds 0.8 kB"):
        height_map.table_of(path)


@pytest.mark.parametrize("name", ["scan.npy", "scan.csv", "scan.txt"])
def test_heights_that_find_no_room(tmp_path, monkeypatch, name):
    path = tmp_path / name
    values = np.arange(400.0).reshape(20, 20)
    np.save(path, values) if name.endswith("npy") else np.savetxt(path, values, delimiter=",")
    assert height_map.table_of(path).values.shape == (20, 20)
    monkeypatch.setattr(memory_limit, "available", lambda: 5000.0)
    with pytest.raises(SceneError, match=rf"{name}, .* needs .* kB of memory; 5 kB are available"):
        height_map.table_of(path)


def test_checkpoints_that_declare_too_much(tmp_path):
    path = store(tmp_path / "a.zarr").path
    point = next((path / ".checkpoints").glob("*.npz"))

    def written(content, compression=zipfile.ZIP_STORED):
        with zipfile.ZipFile(point, "w", compression) as archive:
            for name in ("P", "H0", "step"):
                archive.writestr(f"{name}.npy", content)

    packed = header((10**7,)) + bytes(8 * 10**5)
    for content, compression in ((header((10**10,)) + bytes(80), zipfile.ZIP_STORED), (packed, zipfile.ZIP_DEFLATED)):
        written(content, compression)
        with pytest.raises(ValueError):
            npy.load_all(point)
        with Store.write(path) as saved, pytest.raises(StoreError, match="is damaged or of another grid"):
            saved.go_back()


def test_a_grid_that_finds_no_room(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(memory_limit, "available", lambda: 8e9)
    for attempt in (lambda large: tehl.run(large, "a.zarr"), lambda large: next(tehl.march(large))):
        with pytest.raises(SceneError, match=r"a run on 8192 x 4096 cells needs 1\d\d GB of memory; 8 GB are available"):
            attempt(scene("gear").replace(**{"grid.nx": 8192, "grid.ny": 4096}))
    assert list(tmp_path.iterdir()) == []
    isothermal = [scene("gear").replace(**{"grid.nx": nx, "grid.ny": 256, "thermal.on": False}) for nx in (1024, 2048)]
    small, large = map(memory_demand.needed_bytes, isothermal)
    assert large == pytest.approx(2 * small - memory_demand.BASE, rel=0.01)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits of Linux")
def test_the_limits_of_a_shell_count(tmp_path):
    done = subprocess.run([*CALL, "run", "gear", "--grid", "8192x4096", "--steps", "0", "--isothermal"], cwd=tmp_path,
                          capture_output=True, text=True,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (3 * 10**9, 3 * 10**9)))
    assert done.returncode == 2 and "needs 67.2 GB of memory; 2." in done.stderr and list(tmp_path.iterdir()) == []


def test_what_is_available_is_the_least_of_all_limits(tmp_path, monkeypatch):
    """A made-up machine: memory, two control groups in each other, the second with files that can be given back."""
    (tmp_path / "info").write_text("MemTotal: 9000000 kB\nMemAvailable: 8000000 kB\n")
    (tmp_path / "own").write_text("0::/outer/inner\n")
    groups = ("", "max", 0, 0), ("outer", 6 * 10**9, 10**9, 0), ("outer/inner", 4 * 10**9, 2 * 10**9, 10**9)
    for name, most, used, idle in groups:
        folder = tmp_path / "groups" / name
        folder.mkdir(parents=True)
        (folder / "memory.max").write_text(f"{most}\n")
        (folder / "memory.current").write_text(f"{used}\n")
        (folder / "memory.stat").write_text(f"anon 5\ninactive_file {idle}\n")
    for name, path in (("INFO", "info"), ("OWN", "own"), ("GROUPS", "groups")):
        monkeypatch.setattr(memory_limit, name, tmp_path / path)
    monkeypatch.setattr(memory_limit, "_of_process", lambda: [float("inf")])
    assert memory_limit.available() == 3e9
    (tmp_path / "groups/outer/inner/memory.max").write_text("max\n")
    assert memory_limit.available() == 5e9
    (tmp_path / "groups/outer/memory.max").write_text("max\n")
    assert memory_limit.available() == 8000000 * 1024
    monkeypatch.setattr(memory_limit, "_of_process", lambda: [1e9, 2e9])
    assert memory_limit.available() == 1e9 and memory_limit.words(1.5e12) == "1.5 TB" and os.getpid()
