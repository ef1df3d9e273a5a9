"""The result store: one zarr v3 group that xarray opens as it is, written step by step.

Arrays are laid out for the whole run at once; what a reader sees is the consolidated metadata in the group's own
`zarr.json`, whose shapes end at the last complete step. That one file is replaced atomically after all chunks of a step
and its checkpoint are written, so a step becomes visible as a whole, and a killed run leaves a store that opens.
The store itself appears with its first entry (:mod:`tehl_taichi.io.place`) and has one writer at a time
(:mod:`tehl_taichi.io.lock`); every chunk and checkpoint carries a checksum.
"""

import contextlib
import json
from pathlib import Path

import numpy as np
import zarr
from numcodecs import zstd

from tehl_taichi import __version__
from tehl_taichi.errors import Error, Interrupted, StoreError
from tehl_taichi.io import checkpoint, intact, maps, scene_file
from tehl_taichi.io.atomic import replace
from tehl_taichi.io.intact import CHECKPOINTS, FORMAT, ROOT
from tehl_taichi.io.json_values import plain
from tehl_taichi.io.lock import Busy, Lock, holder
from tehl_taichi.io.place import Place, put_back, reason, unmade
from tehl_taichi.march.output import fields_of, names, scalars_of
from tehl_taichi.scene.route import cut_at

# series of the snapshot itself: (dtype, units, text, what is not written yet, how they tell of several steps)
OWN = {"step": ("i8", "1", "step number", -1, ""), "time": ("f8", "s", "time since the steady start", float("nan"), ""),
       "feature_x": ("f8", "m", "centre of the first feature", float("nan"), "point")}


class Store:
    """One run on disk: :meth:`create` and :meth:`write` give one that may be written, :meth:`open` one to read.

    A writer holds the lock of its folder until :meth:`close` (or the end of a `with`).
    """

    def __init__(self, path, lock=None):
        self.path, self.lock = Path(path), lock
        self.attrs, self.metadata = intact.root_of(self.path)
        self.scene = intact.scene_of(self.path, self.attrs)
        known = intact.optional(self.attrs, "outputs", names())  # to the program that began it
        self.stored = {name: field.dtype for name, field in fields_of(self.scene).items() if name in known}
        self.names = [*(name for name in scalars_of(self.scene) if name in known), *OWN]
        self.steps = self.attrs.get("steps")

    @classmethod
    def create(cls, path, scene, snapshot, capacity, attrs=None):
        """New store on the grid of `snapshot`, which becomes its first entry; room for `capacity` entries.

        path: a :class:`Place`, or a path that is reserved now. Raises StoreError if it exists or cannot be written.
        """
        place = path if isinstance(path, Place) else Place(path)
        try:
            with _told(place.folder, "nothing is stored", Error):
                store = cls._begun(place, scene, snapshot, capacity, attrs or {})
                store._append(snapshot, snapshot.state)
            place.publish()
        except BaseException:
            place.give_up()
            raise
        store.path = place.path
        return store

    @classmethod
    def _begun(cls, place, scene, snapshot, capacity, attrs):
        """A store without entries, which nobody sees yet."""
        group = zarr.open_group(str(place.folder), mode="a", zarr_format=3)
        _coordinates(group, snapshot)
        _series(group, capacity, scene, snapshot)
        maps.write(group, scene)
        (place.folder / CHECKPOINTS).mkdir()
        _publish(place.folder, {"Conventions": "CF-1.10", "format": FORMAT, "version": __version__,
                                "scene": json.dumps(scene.to_dict()), "scene_toml": scene_file.dumps(scene), **attrs,
                                "outputs": json.dumps(names()), "steps": 0,
                                "finished": False}, _metadata(place.folder))
        store = cls(place.folder, place.lock)
        store.series = {name: np.full(capacity, -1) if name == "step" else np.full(capacity, np.nan) for name in store.names}
        return store

    @classmethod
    def open(cls, path):
        """Existing store, to read. Raises StoreError if `path` is none, or a damaged one."""
        return cls._opened(Path(path), None)

    @classmethod
    def write(cls, path):
        """Existing store, to go on with. Raises StoreError as :meth:`open`, or where another version wrote it; Busy where
        somebody else writes."""
        path = Path(path)
        cls.open(path)  # nothing is locked that is no store
        try:
            lock = Lock(path)
        except OSError as error:
            raise StoreError(f"cannot write to {path}: {reason(error)}") from None
        try:
            store = cls._opened(path, lock)
            intact.check_version(path, store.attrs)
        except BaseException:
            lock.release()
            raise
        return store

    @classmethod
    def _opened(cls, path, lock):
        put_back(path)
        if not path.exists() and (said := unmade(path)):
            raise (Busy if "still" in said else StoreError)(said)
        store = cls(path, lock)
        needed = {name: ["x", "y"] for name in store.stored} | {name: [] for name in store.names}
        intact.check(path, store.attrs, store.metadata, store.scene, needed)
        store.series = {name: store._read_series(name) for name in store.names}
        return store

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Let others write; what is stored can still be read."""
        if self.lock:
            self.lock.release()

    def __len__(self):
        return self.steps

    @property
    def finished(self):
        return self.attrs["finished"]

    @property
    def writer(self):
        """Who writes to it at this moment, in words, or None."""
        return holder(self.path)

    @property
    def other_version(self):
        """Which version wrote it, in words, where that is not this one, else None."""
        return intact.written_by(self.attrs)

    @property
    def cut(self):
        """Position (a) where its passage was cut inside the contact, or None."""
        return cut_at(self.scene)

    @property
    def last_step(self):
        """Number of the last stored time step."""
        return int(self.series["step"][self.steps - 1])

    @property
    def summary(self):
        """The summary of a finished run, or {}."""
        found = intact.optional(self.attrs, "summary", {})
        return {**found, "store": str(self.path)} if found else {}

    @property
    def warnings(self):
        """What is doubtful, a sentence each: of the whole run where it is finished, else of its scene."""
        return intact.optional(self.attrs, "warnings", [])

    def needed(self, name):
        """The table among the attributes of that name, which going on needs. Raises StoreError."""
        return intact.attribute(self.path, self.attrs, name)

    @property
    def x(self):
        return self._whole("x")

    @property
    def y(self):
        return self._whole("y")

    @property
    def time(self):
        return self.series["time"][: self.steps]

    def scalar(self, name):
        """Values of one scalar series, one per stored entry (with output.every: see `cell_methods`)."""
        return self.series[name][: self.steps]

    def feature_x(self, n):
        """Centre of the first feature (m) at entry n."""
        return float(self.series["feature_x"][n])

    def fields(self, n, names=None):
        """{name: (nx+1, ny+1) array} of entry n, by default of every field that is stored."""
        return {name: self._values(name, n) for name in (self.stored if names is None else names)}

    def _values(self, name, n):
        """One chunk, read as it was written: a tenth of the time of the general way, which a fatigue search feels."""
        values = _read_file(self.path.joinpath(name, *self._key(name, n)), "<" + self.stored[name])
        return values.reshape(self.metadata[name]["shape"][1:])

    def _key(self, name, n):
        """Where entry n of a field lies in its array's folder."""
        return ["c", str(n)] + ["0"] * (len(self.metadata[name]["shape"]) - 1)

    def _read_series(self, name):
        """A scalar series with the room behind its last entry."""
        file, whole = self.path / name / "c" / "0", self.metadata[name]["chunk_grid"]["configuration"]["chunk_shape"][0]
        values = self._whole(name) if self.attrs.get("format", 1) == 1 else _read_file(file, "<i8" if name == "step" else "<f8")
        if values.size < self.steps or (name in ("step", "time") and not np.all(np.diff(values[: self.steps]) > 0)):
            raise StoreError(f"{file} is damaged: it has no {self.steps} entries")
        out = np.full(whole, np.nan if name != "step" else -1, values.dtype)
        out[: values.size] = values
        return out

    def _whole(self, name):
        try:
            return zarr.open_group(str(self.path), mode="r", use_consolidated=False)[name][:]
        except Exception as error:  # zarr and its codecs have no common one
            raise StoreError(f"{self.path / name} is damaged or missing ({' '.join(str(error).split())})") from None

    def map(self, name):
        """One of the maps that :meth:`finish` stored, or None."""
        return self._whole(name) if name in self.metadata else None

    def append(self, snapshot, state=None):
        """Write one snapshot, and its `state` as the checkpoint to go on from, then make it visible. Raises Interrupted where
        the disk does not take it: what was stored before stays."""
        with _told(self.path, f"{self.steps} entries are safe; then: tehl resume {self.path}"):
            self._append(snapshot, state)

    def _append(self, snapshot, state):
        n = self.steps
        for name, dtype in self.stored.items():
            _write_file(self.path / name, self._key(name, n), snapshot.fields[name], "<" + dtype)
        values = {**snapshot.scalars, **{name: getattr(snapshot, name) for name in OWN}}
        for name, series in self.series.items():
            series[n] = values[name]
            _write_file(self.path / name, ["c", "0"], series, "<" + series.dtype.str[1:])
        if state:
            checkpoint.write(self.path / CHECKPOINTS, n + 1, state)
        self._commit(steps=n + 1)
        if state:
            checkpoint.forget(self.path / CHECKPOINTS, n + 1)

    def _commit(self, **attrs):
        self.attrs.update(attrs)
        self.steps = self.attrs.get("steps")
        _publish(self.path, self.attrs, self.metadata)

    def go_back(self):
        """The state of the last checkpoint, for :func:`tehl_taichi.march.passage.march`. Entries after it are taken back: they
        come again, the same. Raises StoreError where there is none."""
        shape = self.scene.rows + 1, self.scene.grid.nx + 1
        number, state = checkpoint.last(self.path, self.path / CHECKPOINTS, self.steps, shape)
        if int(state["step"]) != self.series["step"][number - 1]:
            raise intact.damaged(self.path, "its checkpoint is of another step")
        if number < self.steps:
            with _told(self.path, f"then: tehl resume {self.path}"):
                self._commit(steps=number)
        return state

    def extend(self, scene):
        """Go on behind the end of a finished run, with a scene that differs in that end only; its results are taken back."""
        for name in intact.optional(self.attrs, "results", []):
            self.metadata.pop(name, None)
        self.scene = scene
        self.attrs.pop("summary", None)
        with _told(self.path, f"then: tehl resume {self.path}"):
            self._commit(scene=json.dumps(scene.to_dict()), scene_toml=scene_file.dumps(scene), results="[]", finished=False,
                         warnings=json.dumps(scene.warnings()))

    def finish(self, summary, maps=None):
        """Store the summary (and maps {name: (values, dims, units, text)}) and mark the run as finished."""
        with _told(self.path, f"every step is stored; then: tehl resume {self.path}"):
            group = zarr.open_group(str(self.path), mode="r+", use_consolidated=False)
            for name, (values, dims, units, text) in (maps or {}).items():
                if name in group:
                    del group[name]
                values = np.asarray(values, "f8")
                _array(group, name, values.shape, values.shape, "f8", dims, units, text, float("nan"))[...] = values
            written = _metadata(self.path)
            self.metadata |= {name: written[name] for name in maps or {}}
            self._commit(summary=json.dumps(plain(summary)), results=json.dumps(list(maps or {})), finished=True,
                         warnings=json.dumps(summary.get("warnings", self.warnings)))


@contextlib.contextmanager
def _told(path, what_is_left, kind=Interrupted):
    """What a disk refuses (full, read-only, moved away), as a sentence and an error of that kind."""
    try:
        yield
    except OSError as error:
        why = reason(error) if Path(path).exists() else "it was moved or removed"
        raise kind(f"cannot write to {path}: {why}; {what_is_left}") from None


def _read_file(path, dtype):
    """The values of one chunk file. Raises StoreError with its name."""
    try:
        return np.frombuffer(zstd.decompress(path.read_bytes()), dtype)
    except FileNotFoundError:
        raise StoreError(f"{path} is missing: the store is damaged") from None
    except (OSError, RuntimeError, ValueError) as error:
        raise StoreError(f"{path} is damaged ({error}); what it held is lost") from None


def _write_file(array, key, values, dtype):
    """One chunk of the array in that folder, in the codecs that it declares: bytes, and zstd with a checksum.

    The same write through the library costs 5 ms, times 24 arrays a step. The folder itself is never made: where it is gone,
    the store was moved.
    """
    folder = array
    for part in key[:-1]:
        folder = folder / part
        with contextlib.suppress(FileExistsError):
            folder.mkdir()
    replace(folder / key[-1], zstd.compress(np.ascontiguousarray(values, dtype).tobytes(), LEVEL, True))


def _metadata(path):
    """Metadata of every array of the group, by name."""
    return {file.parent.name: json.loads(file.read_text()) for file in sorted(path.glob("*/zarr.json"))}


def _publish(path, attrs, arrays):
    """Replace the group's metadata: attributes, and every array with its time axis cut at attrs['steps']."""
    for array in arrays.values():
        if array["dimension_names"][0] == "time":
            array["shape"][0] = attrs["steps"]
    root = {"zarr_format": 3, "node_type": "group", "attributes": attrs,
            "consolidated_metadata": {"kind": "inline", "must_understand": False, "metadata": arrays}}
    replace(path / ROOT, json.dumps(root).encode())


LEVEL = 1  # of zstd: the fields are a third smaller, more costs more time than it saves


def _array(group, name, shape, chunks, dtype, dims, units, long_name, fill, **attrs):
    array = group.create_array(name, shape=shape, chunks=chunks, dtype=dtype, dimension_names=dims, fill_value=fill,
                               compressors=zarr.codecs.ZstdCodec(level=LEVEL, checksum=True))
    array.attrs.update({"units": units, "long_name": long_name, **attrs})
    return array


def _coordinates(group, snapshot):
    for name, values, text in (("x", snapshot.x, "along rolling"), ("y", snapshot.y, "across")):
        array = _array(group, name, values.shape, values.shape, "f8", [name], "m", text, 0.0)
        array[:] = values
    if "temperature" in snapshot.fields:
        from tehl_taichi.heat.across import chebyshev

        zeta = chebyshev(snapshot.fields["temperature"].shape[2])[0]
        array = _array(group, "zeta", zeta.shape, zeta.shape, "f8", ["zeta"], "1", "z/h from surface a to surface b", 0.0)
        array[:] = zeta


def _series(group, capacity, scene, snapshot):
    """Arrays of every output of the scene, and of the snapshot's own."""
    for name, field in fields_of(scene).items():
        shape, fill = snapshot.fields[name].shape, 0 if field.dtype == "u1" else float("nan")
        _array(group, name, (capacity, *shape), (1, *shape), field.dtype, ["time", *field.dims], field.unit, field.says, fill)
    numbers = {name: ("f8", scalar.unit, scalar.says, float("nan"), scalar.over) for name, scalar in scalars_of(scene).items()}
    for name, (dtype, units, text, fill, over) in {**numbers, **OWN}.items():
        folded = {"cell_methods": f"time: {over}"} if over and scene.output.every > 1 else {}
        _array(group, name, (capacity,), (capacity,), dtype, ["time"], units, text, fill, **folded)
