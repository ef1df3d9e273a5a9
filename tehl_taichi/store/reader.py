"""Reader of a store: scene, series, fields, maps and summary. It writes nothing, except to undo half a replacement."""

import math
import os
from collections.abc import Iterable
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from tehl_taichi.disk.drafts import put_back, unfinished_error
from tehl_taichi.disk.locks import holder
from tehl_taichi.errors import StoreError, UnknownName
from tehl_taichi.march.step_output import fields_of, names, scalars_of
from tehl_taichi.scene.timeline import cut_at
from tehl_taichi.store import array_file, chunks, integrity, written_chunks
from tehl_taichi.store import stand_in as stand_in_scene
from tehl_taichi.store.layout import OWN
from tehl_taichi.values import checks
from tehl_taichi.values.coded_warning import warnings_of_lists
from tehl_taichi.values.coerce import shown


class Reader:
    """One stored run, read only; entry 0 is the steady start."""

    series: dict[str, np.ndarray]
    lacks: str

    def __init__(self, path, lock=None, stand_in=False):
        self.path, self.lock = Path(path), lock
        self.attrs, self.metadata = integrity.root_of(self.path)
        integrity.check_layout(self.path, self.attrs)
        with integrity.newer_version_errors(self.path, self.attrs):
            self.scene, self.lacks = (stand_in_scene.scene_of(self.path, self.attrs) if stand_in else
                                      (integrity.scene_of(self.path, self.attrs), ""))
        known = integrity.optional_value(self.attrs, "outputs", names())  # to the program that began it
        self.stored = {name: field.dtype for name, field in fields_of(self.scene).items() if name in known}
        self.names = [*(name for name in scalars_of(self.scene) if name in known), *OWN]
        self.steps = self.attrs.get("steps")

    @classmethod
    def open(cls, path, stand_in=False):
        """Open an existing store for reading. Raises StoreError if `path` is no store or a damaged one.

        stand_in: also open a store whose law is not installed here (`lacks` says which), to show and plot it.
        """
        return cls._opened(Path(path), None, stand_in)

    @classmethod
    def _opened(cls, path, lock, stand_in=False):
        put_back(path)
        if not os.path.exists(path) and (why := unfinished_error(path)):
            raise why
        store = cls(path, lock, stand_in)
        needed = {name: ["x", "y"] for name in store.stored} | {name: [] for name in store.names}
        with integrity.newer_version_errors(path, store.attrs):
            integrity.check(path, store.attrs, store.metadata, store.scene, needed)
            store.series = {name: store._read_series(name) for name in store.names}
        return store

    def __len__(self):
        return self.steps

    @property
    def finished(self):
        return self.attrs["finished"]

    @property
    def seeks_window(self):
        """Whether the run still has to find the window that it needs (`tehl run --zoom auto`)."""
        return self.window_search is True

    @property
    def window_search(self):
        """State of the search for the window that the run needs: True until it is found, EXTENDED if it begins again with a
        longer passage, None without one.
        """
        return self.attrs.get(integrity.SEEKS)

    @property
    def writer(self):
        """Description of the process that is writing to the store, or None."""
        return holder(self.path)

    @property
    def other_version(self):
        """Description of the version that wrote the store, None if it is this one."""
        return integrity.written_by(self.attrs)

    @property
    def cut(self):
        """Position (a) at which the passage is cut inside the contact, or None."""
        return cut_at(self.scene)

    @property
    def last_step(self):
        """Number of the last stored time step."""
        return int(self.series["step"][self.steps - 1])

    @property
    def summary(self):
        """Summary of a finished run, or {}."""
        found = integrity.optional_value(self.attrs, "summary", {})
        return {**found, "store": str(self.path)} if found else {}

    @property
    def warnings(self):
        """Each :class:`tehl_taichi.values.coded_warning.CodedWarning` of the run if it is finished, else of its scene."""
        names = "warnings", "warning_codes", "warning_data"
        return warnings_of_lists(*(integrity.optional_value(self.attrs, name, []) for name in names))

    def needed(self, name):
        """Table of an attribute that resuming needs. Raises StoreError."""
        return integrity.attribute(self.path, self.attrs, name)

    def known(self, name):
        """Table of an attribute, {} in stores of versions that have none."""
        return integrity.optional_value(self.attrs, name, {})

    @cached_property
    def x(self):  # opening the group takes 2 ms, and a fatigue search needs every entry
        return self._whole("x")

    @cached_property
    def y(self):
        return self._whole("y")

    @property
    def time(self):
        return self.series["time"][: self.steps]

    def scalar(self, name: str) -> np.ndarray:
        """Values of a scalar series, one per stored entry (with output.every: see `cell_methods`). Raises UnknownName."""
        self._check_name(name, self.series)
        return self.series[name][: self.steps]

    def feature_x(self, n: int) -> float:
        """Position (m) of feature.x = 0, the centre of a first feature there, at entry n. Raises SceneError as
        :meth:`fields`."""
        self._check_entry(n)
        return float(self.series["feature_x"][n])

    def fields(self, n: int, names: Iterable[str] | None = None) -> dict[str, np.ndarray]:
        """{name: (nx+1, ny+1) array} of entry n; names: a name or several, default all stored fields. Raises SceneError if the
        store has no such entry, UnknownName if it has no such field, StoreError for a damaged file.
        """
        self._check_entry(n)
        listed = self.stored if names is None else [names] if isinstance(names, str) else list(names)
        for name in listed:
            self._check_name(name, self.stored)
        return {name: self._values(name, n) for name in listed}

    def _check_name(self, name, known):
        if not (isinstance(name, str) and name in known):
            raise UnknownName(f"{self.path} has no array {shown(name)}{checks.nearest(name, known)}; known: {', '.join(known)}")

    def _check_entry(self, n):
        checks.integer("entry", n, 0, self.steps - 1)

    def _values(self, name, n):
        """Values of one chunk, read directly: ten times faster than through zarr, which matters in a fatigue search."""
        shape = self.metadata[name]["shape"][1:]
        return chunks.read(self._file(name, n), "<" + self.stored[name], math.prod(shape)).reshape(shape)

    def _file(self, name, n):
        """File of entry n of a field."""
        array = self.metadata[name]
        return self.path / name / written_chunks.name(array, [n] + [0] * (len(array["shape"]) - 1))

    def _read_series(self, name):
        """Scalar series, with free space after its last entry."""
        file, whole = self.path / name / "c" / "0", self.metadata[name]["chunk_grid"]["configuration"]["chunk_shape"][0]
        dtype, old = "<i8" if name == "step" else "<f8", self.attrs.get("format", 1) == 1
        values = self._whole(name) if old else chunks.read(file, dtype, whole)
        if values.size < self.steps or (name in ("step", "time") and not np.all(np.diff(values[: self.steps]) > 0)):
            raise StoreError(f"{file} is damaged: it has no {self.steps} entries")
        out = np.full(whole, np.nan if name != "step" else -1, values.dtype)
        out[: values.size] = values
        return out

    def _whole(self, name):
        written_chunks.check(self.path, {name: self.metadata.get(name, {})}, self.attrs)
        return array_file.read_whole(self.path / name)

    @property
    def run_in(self):
        """State of the run-in so far (:class:`tehl_taichi.plastic.run_in.RunInState`); None without run-in."""
        if not self.scene.runs_in:
            return None
        from tehl_taichi.store import run_in_file

        return run_in_file.read(self.path, "run_in" in self.summary)

    @property
    def residual_fields(self):
        """{surface: :class:`tehl_taichi.fatigue.stress.residual_field.ResidualField`} of the passage."""
        found = self.run_in
        return found.residual_fields if found else {}

    @property
    def surface_changes(self):
        """Each :class:`tehl_taichi.plastic.surface_change.SurfaceChange` of the passage."""
        found = self.run_in
        return found.changes if found else ()

    def map(self, name: str) -> Any:
        """A map that :meth:`finish` stored, or None."""
        return self._whole(name) if name in self.metadata else None
