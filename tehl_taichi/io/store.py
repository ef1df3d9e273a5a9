"""The result store: one zarr v3 group that xarray opens as it is, written step by step.

Arrays are laid out for the whole run at once; what a reader sees is the consolidated metadata in the group's own
`zarr.json`, whose shapes end at the last complete step. That one file is replaced atomically after all chunks of a step
and its checkpoint are written, so a step becomes visible as a whole, and a killed run leaves a store that opens.
"""

import json
import os
import shutil
from pathlib import Path

import numpy as np
import zarr
from numcodecs import zstd

from tehl_taichi.errors import StoreError
from tehl_taichi.io import maps, scene_file

FIELDS = {
    "pressure": ("f4", "Pa", "film pressure"), "film": ("f4", "m", "film thickness"),
    "contact": ("u1", "1", "solid contact (1 where the surfaces touch)"),
    "traction_x_a": ("f4", "Pa", "shear traction on body a along x"),
    "traction_y_a": ("f4", "Pa", "shear traction on body a along y"),
    "traction_x_b": ("f4", "Pa", "shear traction on body b along x"),
    "traction_y_b": ("f4", "Pa", "shear traction on body b along y"),
}
THERMAL_FIELDS = {
    "temperature_mid": ("f4", "degC", "mid-film temperature"),
    "temperature_a": ("f4", "degC", "temperature of surface a"),
    "temperature_b": ("f4", "degC", "temperature of surface b"),
}
PROFILE = ("f4", "degC", "temperature across the film")  # with output.profiles
SCALARS = {
    "feature_x": ("m", "centre of the first feature"), "h0_m": ("m", "rigid approach"),
    "p_max_Pa": ("Pa", "largest pressure"), "h_min_m": ("m", "smallest film"), "h_c_m": ("m", "film at x = 0, far edge"),
    "load_error": ("1", "relative load error"), "mass_error": ("1", "net mass defect over the Couette flux"),
    "residual": ("1", "rms residual of the discrete equations"), "newton": ("1", "Newton steps"),
    "cycles": ("1", "Krylov iterations"), "rejected": ("1", "rejected attempts"), "dt_s": ("s", "time step"),
    "wall_s": ("s", "run time of the step"), "contact_load_fraction": ("1", "load carried by solid contact"),
    "friction_coefficient": ("1", "friction coefficient"),
}
THERMAL_SCALARS = {
    "film_max_C": ("degC", "largest film temperature"), "surface_a_max_C": ("degC", "largest temperature of surface a"),
    "surface_b_max_C": ("degC", "largest temperature of surface b"),
    "temperature_change_K": ("K", "largest change of temperature that another round of the step would make"),
    "clamped": ("1", "nodes held inside the allowed range of temperature"),
}


def fields_of(scene):
    """{name: (dtype, units, text)} of what a run of this scene stores per step on x, y."""
    return FIELDS if scene.isothermal else {**FIELDS, **THERMAL_FIELDS}


def scalars_of(scene):
    """{name: (units, text)} of its scalar series."""
    return SCALARS if scene.isothermal else {**SCALARS, **THERMAL_SCALARS}


class Store:
    """One run on disk. Create with :meth:`create`, read or continue with :meth:`open`."""

    def __init__(self, path):
        self.path = Path(path)
        self.root = json.loads((self.path / "zarr.json").read_text())
        self.attrs = self.root["attributes"]
        self.steps = int(self.attrs["steps"])
        self.scene = maps.read_scene(self.path, self.attrs["scene"])
        self.group = zarr.open_group(str(self.path), mode="r+", use_consolidated=False)
        self.metadata = _metadata(self.path)
        self.stored = {name: kind[0] for name, kind in fields_of(self.scene).items()}
        if "temperature" in self.group:
            self.stored["temperature"] = PROFILE[0]
        self.series = {name: self.group[name][:] for name in [*scalars_of(self.scene), "step", "time"]}

    @classmethod
    def create(cls, path, scene, snapshot, capacity, attrs=None):
        """New store on the grid of `snapshot`, which becomes its first entry; room for `capacity` entries.

        Raises StoreError if `path` exists or cannot be written.
        """
        path = Path(path)
        check_free(path)
        group = zarr.open_group(str(path), mode="w", zarr_format=3)
        _coordinates(group, snapshot)
        _series(group, capacity, scene, snapshot)
        maps.write(group, scene)
        (path / CHECKPOINTS).mkdir()
        _publish(path, {"Conventions": "CF-1.10", "scene": json.dumps(scene.to_dict()),
                        "scene_toml": scene_file.dumps(scene), **(attrs or {}), "steps": 0, "finished": False}, _metadata(path))
        store = cls(path)
        store.append(snapshot, snapshot.state)
        return store

    @classmethod
    def open(cls, path):
        """Existing store. Raises StoreError if `path` is none."""
        path = Path(path)
        try:
            if "scene" not in json.loads((path / "zarr.json").read_text())["attributes"]:
                raise KeyError
        except (OSError, ValueError, KeyError):
            raise StoreError(f"{path} is not a store of tehl run") from None
        return cls(path)

    def __len__(self):
        return self.steps

    @property
    def finished(self):
        return bool(self.attrs["finished"])

    @property
    def summary(self):
        """The summary of a finished run, or {}."""
        return json.loads(self.attrs.get("summary", "{}"))

    @property
    def warnings(self):
        """What is doubtful, a sentence each: of the whole run where it is finished, else of its scene."""
        return json.loads(self.attrs.get("warnings", "[]"))

    @property
    def x(self):
        return self.group["x"][:]

    @property
    def y(self):
        return self.group["y"][:]

    @property
    def time(self):
        return self.series["time"][: self.steps]

    def scalar(self, name):
        """Values of one scalar series, one per stored entry."""
        return self.series[name][: self.steps]

    def feature_x(self, n):
        """Centre of the first feature (m) at entry n."""
        return float(self.series["feature_x"][n])

    def fields(self, n, names=tuple(FIELDS)):
        """{name: (nx+1, ny+1) array} of entry n."""
        return {name: self._values(name, n) for name in names}

    def _values(self, name, n):
        """One chunk, read as it was written: a tenth of the time of the general way, which a fatigue search feels."""
        shape = self.metadata[name]["shape"][1:]
        values = np.frombuffer(zstd.decompress(self._chunk(name, n).read_bytes()), "<" + self.stored[name])
        return values.reshape(shape)

    def _chunk(self, name, n):
        """File of entry n of a field."""
        return self.path / name / "c" / "/".join([str(n)] + ["0"] * (len(self.metadata[name]["shape"]) - 1))

    def map(self, name):
        """One of the maps that :meth:`finish` stored, or None."""
        return self.group[name][:] if name in self.group else None

    def append(self, snapshot, state=None):
        """Write one snapshot, and its `state` as the checkpoint to go on from, then make it visible."""
        n = self.steps
        for name, dtype in self.stored.items():
            values = np.ascontiguousarray(snapshot.fields[name], "<" + dtype)
            _write_file(self._chunk(name, n), zstd.compress(values.tobytes(), 1))
        values = {**snapshot.scalars, "feature_x": snapshot.feature_x, "step": snapshot.step, "time": snapshot.time}
        for name, series in self.series.items():
            series[n] = values[name]
            _write_file(self.path / name / "c" / "0", series.astype("<" + series.dtype.str[1:]).tobytes())
        before = self._checkpoints()
        if state:
            self._checkpoint(state, n + 1)
        self._commit(steps=n + 1)
        for number in before if state else ():
            (self.path / CHECKPOINTS / f"{number}.npz").unlink(missing_ok=True)

    def _checkpoints(self):
        return sorted(int(file.stem) for file in (self.path / CHECKPOINTS).glob("*.npz"))

    def _commit(self, **attrs):
        self.attrs.update(attrs)
        self.steps = int(self.attrs["steps"])
        _publish(self.path, self.attrs, self.metadata)

    def _checkpoint(self, state, number):
        target = self.path / CHECKPOINTS / f"{number}.npz"
        temporary = target.with_suffix(".tmp")
        with open(temporary, "wb") as file:
            np.savez(file, **{key: value for key, value in state.items() if value is not None})
        os.replace(temporary, target)

    def go_back(self):
        """The state of the last checkpoint, for :func:`tehl_taichi.simulation.march`. Entries after it are taken back: they
        come again, the same. Raises StoreError where there is none."""
        number = max((n for n in self._checkpoints() if n <= self.steps), default=0)
        if number == 0:
            raise StoreError(f"{self.path} holds nothing to go on from; run the scene again with --force")
        if number < self.steps:
            self._commit(steps=number)
        with np.load(self.path / CHECKPOINTS / f"{number}.npz") as saved:
            return {key: saved[key] for key in saved.files}

    def finish(self, summary, maps=None):
        """Store the summary (and maps {name: (values, dims, units, text)}) and mark the run as finished."""
        for name, (values, dims, units, text) in (maps or {}).items():
            if name in self.group:
                del self.group[name]
            values = np.asarray(values, "f8")
            _array(self.group, name, values.shape, values.shape, "f8", dims, units, text, float("nan"))[...] = values
        self.metadata = _metadata(self.path)
        self._commit(summary=json.dumps(summary), warnings=json.dumps(summary.get("warnings", self.warnings)), finished=True)


CHECKPOINTS = ".checkpoints"


def check_free(path):
    """Raise StoreError unless a new store can be made at `path`."""
    path = Path(path)
    if path.exists():
        raise StoreError(f"{path} exists already; choose another --out, or --force to replace it")
    parent = path.absolute().parent
    while not parent.exists():
        parent = parent.parent
    if not parent.is_dir() or not os.access(parent, os.W_OK):
        raise StoreError(f"cannot write to {parent}: no permission, or not a folder")
    free = shutil.disk_usage(parent).free
    if free < ROOM:
        raise StoreError(f"{parent} has only {free / 1e6:.0f} MB left; a run needs at least {ROOM / 1e6:.0f} MB")


ROOM = 50e6  # bytes


def _write_file(path, content):
    """One chunk, replaced as a whole, in the codecs that its array declares (series: bytes; fields: bytes and zstd).

    The same write through the library costs 5 ms, times 24 arrays a step.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_suffix(".tmp")
    temporary.write_bytes(content)
    os.replace(temporary, path)


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
    temporary = path / "zarr.json.tmp"
    temporary.write_text(json.dumps(root))
    os.replace(temporary, path / "zarr.json")


def _array(group, name, shape, chunks, dtype, dims, units, long_name, fill, **options):
    array = group.create_array(name, shape=shape, chunks=chunks, dtype=dtype, dimension_names=dims, fill_value=fill,
                               **options)
    array.attrs.update({"units": units, "long_name": long_name})
    return array


def _coordinates(group, snapshot):
    for name, values, text in (("x", snapshot.x, "along rolling"), ("y", snapshot.y, "across")):
        array = _array(group, name, values.shape, values.shape, "f8", [name], "m", text, 0.0)
        array[:] = values
    if "temperature" in snapshot.fields:
        from tehl_taichi.solvers.heat import chebyshev

        zeta = chebyshev(snapshot.fields["temperature"].shape[2])[0]
        array = _array(group, "zeta", zeta.shape, zeta.shape, "f8", ["zeta"], "1", "z/h from surface a to surface b", 0.0)
        array[:] = zeta


def _series(group, capacity, scene, snapshot):
    nx, ny = snapshot.x.size, snapshot.y.size
    for name, (dtype, units, text) in fields_of(scene).items():
        fill = 0 if dtype == "u1" else float("nan")
        _array(group, name, (capacity, nx, ny), (1, nx, ny), dtype, ["time", "x", "y"], units, text, fill,
               compressors=zarr.codecs.ZstdCodec(level=1))
    if "temperature" in snapshot.fields:
        shape, (dtype, units, text) = snapshot.fields["temperature"].shape, PROFILE
        _array(group, "temperature", (capacity, *shape), (1, *shape), dtype, ["time", "x", "y", "zeta"], units, text,
               float("nan"), compressors=zarr.codecs.ZstdCodec(level=1))
    for name, (units, text) in scalars_of(scene).items():
        _array(group, name, (capacity,), (capacity,), "f8", ["time"], units, text, float("nan"), compressors=None)
    _array(group, "step", (capacity,), (capacity,), "i8", ["time"], "1", "step number", -1, compressors=None)
    _array(group, "time", (capacity,), (capacity,), "f8", ["time"], "s", "time since the steady start", float("nan"),
           compressors=None)
