"""Draft of a new store: a :class:`tehl_taichi.disk.drafts.Draft` that replaces only stores."""

import os
import shutil
from pathlib import Path

from tehl_taichi.disk import links, user_files
from tehl_taichi.disk.drafts import Draft, exists, nearest, remove
from tehl_taichi.disk.files import reason, store_error
from tehl_taichi.disk.locks import Busy, Lock
from tehl_taichi.errors import DiskError, StoreError
from tehl_taichi.store import integrity

ROOM = 50e6  # bytes
LONGEST = 249  # bytes of a name: its hidden folder has six more, and file systems take 255


class StoreDraft(Draft):
    """Reserve the name `path` for a store; replace: also if a store exists there. Raises StoreError, Busy."""

    @classmethod
    def fresh(cls, folder, name):
        """Reserve the first free name of NAME-1.zarr, NAME-2.zarr ... in `folder`."""
        number = 1
        while True:
            try:
                if not os.path.lexists(path := Path(folder) / f"{name}-{number}.zarr"):
                    return cls(path)
            except Busy:
                pass
            number += 1

    @classmethod
    def check(cls, path, replace=False):
        """Raise the errors of a new draft, without making it."""
        cls(path, replace, reserve=False).give_up()

    def allowed(self, replace):
        self.check_outside()
        if replace and os.path.lexists(self.path):
            return lock_to_replace(self.path)
        _check_free(self.path)
        return None

    def check_outside(self):
        user_files.check_outside(self.path)


class CaseDraft(StoreDraft):
    """Draft of the store of a case, a part of its study or flank."""

    def check_outside(self):
        pass


def removed(path):
    """Remove the store at `path`. Raises StoreError if it is no store or contains other files; Busy."""
    remove(path, lock_to_replace(path))


def _check_free(path):
    if path.is_symlink() and not os.path.exists(path):
        raise StoreError(f"{path} is a broken link; remove it or choose another --out")
    if os.path.exists(path):
        if integrity.is_store(path):
            raise StoreError(exists(path))
        raise StoreError(f"{path} exists already and is not a store; choose another --out")
    check_room(writable_folder(path))


def writable_folder(path):
    """The folder at `path`, or the nearest existing one above it. Raises StoreError if it cannot be written."""
    folder = path.absolute()
    if (size := len(os.fsencode(folder.name))) > LONGEST:
        raise StoreError(f"cannot write to {path}: File name too long ({size} bytes; allowed: {LONGEST})")
    folder = nearest(folder)
    if not os.path.isdir(folder) or not os.access(folder, os.W_OK):
        raise StoreError(f"cannot write to {folder}: no permission, read-only or not a folder")
    return folder


def check_room(folder):
    """Raise DiskError if the disk of an existing folder has no room for a run."""
    free = shutil.disk_usage(folder).free
    if free < ROOM:
        raise DiskError(f"{folder} has only {free / 1e6:.0f} MB left; a run needs at least {ROOM / 1e6:.0f} MB")


def lock_to_replace(path):
    """Lock the store at `path`, which is to be replaced. Raises StoreError if it may not be replaced."""
    if path.is_symlink():
        raise StoreError(f"{path} is a link, and --force replaces only stores; remove the link or choose another --out")
    if not integrity.is_store(path):
        raise StoreError(f"{path} is not a store of tehl run, and --force replaces only stores; choose another --out")
    if strangers := integrity.foreign_names(path):
        raise StoreError(f"{path} holds {strangers[0]}, which is not part of a store; move it away, or choose another --out")
    links.refuse(path)
    check_room(path)
    try:
        return Lock(path)
    except OSError as error:
        raise store_error(error, f"cannot replace {path}: {reason(error)}") from None
