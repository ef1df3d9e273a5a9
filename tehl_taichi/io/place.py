"""Where a new store is made: beside its name, hidden and locked, renamed to it when the first entry is in.

So a store appears whole or not at all. Beside `NAME` there may be, with a dot before and one of these behind it:
  .part  a store that is being made, or what a killed process left of one: cleaned up by the next run in that folder
  .old   the store that --force replaces, for the moment between two renames: put back if the second never came
  .gone  one that is being removed
"""

import contextlib
import os
import shutil
from pathlib import Path

from tehl_taichi.errors import Error, StoreError
from tehl_taichi.io import intact
from tehl_taichi.io.lock import LOCK, Busy, Lock, abandoned, holder

PART, OLD, GONE = "part", "old", "gone"
ROOM = 50e6  # bytes


def beside(path, what):
    """The hidden folder beside a store, see above."""
    return path.with_name(f".{path.name}.{what}")


class Place:
    """The name `path`, reserved for a store that :meth:`publish` puts there; replace: also where one stands.

    Raises StoreError where no store can be made, or something that is no store would be replaced; Busy.
    """

    def __init__(self, path, replace=False):
        self.path, self.made, self.old, self.lock, self.published = Path(path), [], None, None, False
        if not self.path.name:
            raise StoreError(f"{path} has no name that a store could take; choose another --out")
        self.folder = beside(self.path, PART)
        put_back(self.path)
        try:
            if replace and os.path.lexists(self.path):
                self.old = _replaced(self.path)
            else:
                _check_free(self.path)
            self._make()
        except BaseException as error:
            self.give_up()
            if isinstance(error, OSError):
                raise StoreError(f"cannot write to {self.path.parent}: {reason(error)}") from None
            raise

    @classmethod
    def fresh(cls, folder, name):
        """The first of NAME-1.zarr, NAME-2.zarr ... in `folder` that nobody has or makes."""
        number = 1
        while True:
            try:
                if not os.path.lexists(path := Path(folder) / f"{name}-{number}.zarr"):
                    return cls(path)
            except Busy:
                pass
            number += 1

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.give_up()

    def _make(self):
        self.made = _parents(self.path)
        self.path.parent.mkdir(parents=True, exist_ok=True)
        clean(self.path.parent)
        self.lock = self._locked()
        for leftover in self.folder.iterdir():
            if leftover.name != LOCK:
                _remove(leftover)
        if os.path.lexists(self.path) and not self.old:  # it came while we looked
            raise Busy(exists(self.path))

    def _locked(self):
        while True:
            self.folder.mkdir(parents=True, exist_ok=True)
            try:
                return Lock(self.folder, self.path)
            except FileNotFoundError:
                continue  # its last owner removed the folder between the two lines

    def publish(self):
        """Give the folder its name; what stood there is removed. Raises StoreError where something else has come there."""
        aside = beside(self.path, OLD)
        try:
            if self.old:
                os.rename(self.path, aside)
            os.rename(self.folder, self.path)
        except OSError as error:
            put_back(self.path)
            raise StoreError(f"cannot put the store at {self.path}: {reason(error)}") from None
        self.published = True
        self.lock.moved(self.path)
        if self.old:
            gone = beside(self.path, GONE)
            os.rename(aside, gone)
            _remove_store(gone, self.old)

    def give_up(self):
        """Remove what was made so far, unless it is published; what stood at the name before stays."""
        if self.published:
            return
        put_back(self.path)  # Ctrl-C came between the renames
        if self.lock:
            _remove_store(self.folder, self.lock)
        for folder in self.made:
            with contextlib.suppress(OSError):  # others use it
                folder.rmdir()
        if self.old:
            self.old.release()


def put_back(path):
    """Undo half a replacement: the old store gets its name back where the new one never came."""
    if path.name and not os.path.lexists(path) and os.path.isdir(beside(path, OLD)):
        with contextlib.suppress(OSError):  # a read-only folder, or another process was faster
            os.rename(beside(path, OLD), path)


def clean(folder):
    """Remove what killed processes of this host left unfinished in `folder`; an old store only where a new one stands."""
    for what in (PART, GONE, OLD):
        for leftover in folder.glob(f".*.{what}"):
            replaced = intact.is_store(folder / leftover.name[1 : -len(what) - 1])
            if abandoned(leftover) and (replaced or what != OLD):
                with contextlib.suppress(Busy, OSError):  # somebody takes it over, or cleans too
                    _remove_store(leftover, Lock(leftover))


def unmade(path):
    """What there is of a store that has not appeared at `path` yet, a sentence, or None."""
    folder = beside(Path(path), PART)
    if not folder.is_dir():
        return None
    if who := holder(folder):
        return f"{path} is still being made by {who}: its first entry is not in yet"
    return f"{path} was never made: its run ended before the first entry was in; run it again"


def _check_free(path):
    if path.is_symlink() and not path.exists():
        raise StoreError(f"{path} is a link that leads nowhere; remove it or choose another --out")
    if path.exists():
        if intact.is_store(path):
            raise StoreError(exists(path))
        raise StoreError(f"{path} exists already and is no store; choose another --out")
    parent = path.absolute().parent
    while not os.path.lexists(parent):
        parent = parent.parent
    if not parent.is_dir() or not os.access(parent, os.W_OK):
        raise StoreError(f"cannot write to {parent}: no permission, read-only or not a folder")
    _check_room(parent)


def _check_room(folder):
    free = shutil.disk_usage(folder).free
    if free < ROOM:
        raise Error(f"{folder} has only {free / 1e6:.0f} MB left; a run needs at least {ROOM / 1e6:.0f} MB")


def _replaced(path):
    """The lock of the store at `path`, which may be replaced. Raises StoreError where it may not."""
    if path.is_symlink():
        raise StoreError(f"{path} is a link; --force replaces only a store itself: remove the link or choose another --out")
    if not intact.is_store(path):
        raise StoreError(f"{path} is not a store of tehl run, and --force replaces nothing else; choose another --out")
    if strangers := intact.strangers(path):
        raise StoreError(f"{path} holds {strangers[0]}, which is no part of a store; move it away, or choose another --out")
    _check_room(path)
    try:
        return Lock(path)
    except OSError as error:
        raise StoreError(f"cannot replace {path}: {reason(error)}") from None


def _parents(path):
    """Folders above `path` that do not exist yet, the innermost first."""
    return [folder for folder in path.absolute().parents if not folder.exists()]


def _remove_store(folder, lock):
    """Remove a folder with its lock last, so that half of it is still known for what it is."""
    try:
        for child in folder.iterdir():
            if child.name != LOCK:
                _remove(child)
        lock.moved(folder)
        lock.release()
        folder.rmdir()
    except OSError:  # what stays is cleaned up by a later run
        lock.file.close()


def _remove(path):
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink()


def reason(error):
    """An OSError in words."""
    return error.strerror or str(error)


def exists(path):
    """That something stands at `path`, in words."""
    return f"{path} exists already; choose another --out, or --force to replace it"
