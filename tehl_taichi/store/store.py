"""Result store: one zarr v3 group that xarray opens, written step by step.

The arrays are created for the whole run at once. Readers see the consolidated metadata in the group's own `zarr.json`, whose
shapes end at the last complete step that was published. This file is replaced atomically after all chunks of these steps and a
checkpoint are written. So steps become visible as a whole, and a killed run leaves a store that opens. The store itself appears
with its first entry (:mod:`tehl_taichi.store.store_draft`) and has one writer at a time (:mod:`tehl_taichi.disk.locks`); every
chunk and checkpoint has a checksum.
"""

import contextlib
import json
import math
import os
from pathlib import Path

import numpy as np

from tehl_taichi import __version__
from tehl_taichi.disk import files
from tehl_taichi.disk.drafts import remove_whole
from tehl_taichi.disk.files import reason, store_error
from tehl_taichi.disk.locked_folder import LockedFolder, locked_folder
from tehl_taichi.errors import Interrupted
from tehl_taichi.march.step_output import names
from tehl_taichi.scene import scene_file
from tehl_taichi.store import checkpoint, chunks, integrity, layout, stored_maps, written_chunks
from tehl_taichi.store.integrity import CHECKPOINTS, FORMAT
from tehl_taichi.store.json_values import plain
from tehl_taichi.store.layout import OWN
from tehl_taichi.store.reader import Reader
from tehl_taichi.store.store_draft import CaseDraft, StoreDraft
from tehl_taichi.values.coded_warning import texts
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.escape import typed


class Store(LockedFolder, Reader):
    """One run on disk. :meth:`create` and :meth:`write` return one for writing, :meth:`open` one for reading.

    A writer holds the lock of its folder until :meth:`close` (or the end of a `with`).
    """

    kept_states = None  # KeptStates of the march that writes it, where a window follows that again

    @classmethod
    def create(cls, path, scene, snapshot, capacity, attrs=None):
        """Create a store on the grid of `snapshot`, its first entry, for up to `capacity` entries.

        path: a :class:`StoreDraft`, or a path that is reserved now. Raises StoreError if it exists or cannot be written.
        """
        place = path if isinstance(path, StoreDraft) else CaseDraft(path)
        try:
            with _disk_errors(place.folder, "nothing is stored", store_error):
                store = cls._create(place, scene, snapshot, capacity, attrs or {})
                store._append(snapshot, snapshot.state, put=files.write)  # it has no reader yet
            place.publish()
        except BaseException:
            place.give_up()
            raise
        store.path = place.path
        return store

    @classmethod
    def _create(cls, place, scene, snapshot, capacity, attrs):
        """A store without entries, which readers do not see yet."""
        arrays = {**layout.lay_out(place.folder, capacity, scene, snapshot), **stored_maps.write(place.folder, scene)}
        (place.folder / CHECKPOINTS).mkdir()
        attrs = {"Conventions": "CF-1.10", "format": FORMAT, "version": __version__, "scene": json.dumps(scene.to_dict()),
                 "scene_toml": scene_file.dumps(scene), **attrs, "outputs": json.dumps(names()), written_chunks.EVERY: True,
                 "steps": 0, "finished": False}
        layout.publish(place.folder, attrs, dict(sorted(arrays.items())))
        store = cls(place.folder, place.lock)
        store.x, store.y = (np.array(values, float) for values in (snapshot.x, snapshot.y))  # reading them takes 2 ms
        store.series = {name: np.full(capacity, -1) if name == "step" else np.full(capacity, np.nan) for name in store.names}
        for name in store.series:
            (place.folder / name / "c").mkdir()
        return store

    @classmethod
    def write(cls, path):
        """Open an existing store for writing. Raises StoreError as :meth:`open`, or if another version wrote it; Busy if
        another process writes.
        """
        path = Path(path)
        cls.open(path)  # nothing is locked that is no store
        return locked_folder(path, lambda lock: cls._to_resume(path, lock))

    @classmethod
    def _to_resume(cls, path, lock):
        store = cls._opened(path, lock)
        integrity.check_version(path, store.attrs)
        integrity.check_folders(path, store.stored)
        return store

    def append(self, snapshot, state=None, shown=True):
        """Write a snapshot, and `state` as a checkpoint, then make them visible (shown=False: only if there is a `state`).

        Raises Interrupted if the disk refuses it; visible entries stay.
        """
        with self.safely():
            self._append(snapshot, state, shown)

    def show(self):
        """Make the appended entries visible. Raises as :meth:`append`."""
        with self.safely():
            if self.steps > self.attrs["steps"]:
                self._show()

    def rewind(self, state):
        """Remove every entry after the steady start, and start the passage from its `state`. Raises as :meth:`append`."""
        with self.safely():
            checkpoint.write(self.path / CHECKPOINTS, 1, state)
            self._commit(steps=1)
            checkpoint.remove_others(self.path / CHECKPOINTS, 1)

    def _append(self, snapshot, state, shown=True, put=files.replace):
        n = self.steps
        for name, dtype in self.stored.items():  # what readers do not see yet needs no care
            files.write(self._file(name, n), chunks.compressed(snapshot.fields[name], "<" + dtype))
        values = {**snapshot.scalars, **{name: getattr(snapshot, name) for name in OWN}}
        for name, series in self.series.items():
            series[n] = values[name]
        self.steps = n + 1
        if state:
            checkpoint.write(self.path / CHECKPOINTS, n + 1, state)
        if state or shown:
            self._show(put)
        if state:
            checkpoint.remove_others(self.path / CHECKPOINTS, n + 1)

    def _show(self, put=files.replace):
        for name, series in self.series.items():
            put(self.path / name / "c" / "0", chunks.compressed(series, "<" + series.dtype.str[1:]))
        self._commit(steps=self.steps)

    def safely(self):
        """Context manager for disk errors while a passage is written."""
        count = self.attrs["steps"]
        stored = number_of(count, "entry is", "entries are")
        return _disk_errors(self.path, f"{stored} stored; then use: tehl resume {typed(self.path)}")

    def _commit(self, **attrs):
        attrs = {**self.attrs, **attrs}
        layout.publish(self.path, attrs, self.metadata)
        self.attrs, self.steps = attrs, attrs["steps"]

    def go_back(self):
        """Load the last checkpoint for :func:`tehl_taichi.march.passage.march`, and remove later entries (the march computes
        equal ones). Raises StoreError without a checkpoint.
        """
        shape = self.scene.rows + 1, self.scene.grid.nx + 1
        number, state = checkpoint.load_last(self.path, self.path / CHECKPOINTS, self.steps, shape)
        if int(state["step"]) != self.series["step"][number - 1]:
            raise integrity.damage_error(self.path, "its checkpoint is of another step")
        if number < self.steps:
            with _disk_errors(self.path, f"then use: tehl resume {typed(self.path)}"):
                self._commit(steps=number)
        return state

    @contextlib.contextmanager
    def extended(self, scene):
        """Context manager: :meth:`extend`. After an error (no interruption) inside it the run is finished as it was, if no step
        was added.
        """
        before = self.scene, self.attrs, dict(self.metadata)
        self.extend(scene)
        try:
            yield
        except Interrupted:
            raise
        except Exception:
            if self.steps == before[1]["steps"] and not self.attrs["finished"]:
                self.scene, self.attrs, self.metadata = before
                self._commit()
            raise

    def extend(self, scene):
        """Extend a finished run: `scene` differs only in its end or its window; the results are removed."""
        for name in integrity.optional_value(self.attrs, "results", []):
            self.metadata.pop(name, None)
        search = {integrity.SEEKS: True} if self.window_search and scene.time != self.scene.time else {}
        self.scene, self.attrs = scene, {name: value for name, value in self.attrs.items() if name != "summary"} | search
        with _disk_errors(self.path, f"then use: tehl resume {typed(self.path)}"):
            self._commit(scene=json.dumps(scene.to_dict()), scene_toml=scene_file.dumps(scene), results="[]", finished=False,
                         **texts(scene.typed_warnings))

    def note_search(self, state):
        """Note the state of the search for the window that the run needs, see :attr:`window_search`. Raises Interrupted."""
        with _disk_errors(self.path, f"then use: tehl resume {typed(self.path)}"):
            self.attrs = {name: value for name, value in self.attrs.items() if name != integrity.SEEKS}
            self._commit(**{integrity.SEEKS: state} if state else {})

    def finish(self, summary, maps=None):
        """Store the summary (and maps {name: (values, dims, units, text)}) and mark the run as finished."""
        with _disk_errors(self.path, f"every step is stored; then use: tehl resume {typed(self.path)}"):
            for name, (values, dims, units, text) in (maps or {}).items():
                if os.path.lexists(self.path / name):
                    remove_whole(self.path / name)
                self.metadata |= layout.whole(self.path, name, values, dims, units, text, math.nan)
            self._commit(summary=json.dumps(plain(summary)), results=json.dumps(list(maps or {})), finished=True,
                         **texts(summary.get("warnings", self.warnings)))


@contextlib.contextmanager
def _disk_errors(path, what_is_left, error_of=lambda error, message: Interrupted(message)):
    """Context manager: disk errors (full, read-only, moved) become what error_of(error, message) makes of them."""
    try:
        yield
    except OSError as error:
        why = reason(error) if os.path.exists(path) else "it was moved or removed"
        raise error_of(error, f"cannot write to {path}: {why}; {what_is_left}") from None
