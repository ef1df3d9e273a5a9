"""An export is made under a hidden name beside its place and appears whole or not at all."""

import contextlib
import os
import re
import shutil
from pathlib import Path

from tehl_taichi.errors import StoreError
from tehl_taichi.io.lock import Lock
from tehl_taichi.io.place import PART, beside, clean, exists, reason


def default(store, format):
    """Path beside the store at `store`, named after it."""
    return store.with_name(store.name.removesuffix(".zarr") + format.ending)


def written(format, reader, places, path, force):
    """Write a run in a :class:`Format` to `path`; returns it. Raises StoreError, and then leaves nothing behind."""
    path = Path(path) if path is not None else default(Path(reader.path), format)
    _check_free(path, format, force)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        clean(path.parent)
        _write(format, reader, places, path)
    except OSError as error:
        raise StoreError(f"cannot write {path}: {reason(error)}") from None
    return path


def _write(format, reader, places, path):
    folder = beside(path, PART)
    made, before = folder / "made", folder / "before"
    folder.mkdir(exist_ok=True)
    lock = Lock(folder, path)
    try:
        _remove(made)
        if format.parts:
            made.mkdir()
        format.write(reader, made, places)
        _publish(made, path, before)
    finally:
        _remove(made)
        _remove(before)
        lock.release()
        with contextlib.suppress(OSError):  # the next one has taken it
            folder.rmdir()


def _publish(made, path, before):
    """Give what was made its name; what stood there goes, or stays where that fails."""
    if not path.is_dir():
        os.replace(made, path)
        return
    os.rename(path, before)
    try:
        os.rename(made, path)
    except BaseException:
        os.rename(before, path)
        raise


def _remove(path):
    """Remove a file or a folder, if there is one."""
    shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)


def _check_free(path, format, force):
    """Raises StoreError where something stands at `path` that may not be replaced."""
    if not path.name:
        raise StoreError(f"{path} has no name that an export could take; choose another --out")
    if not os.path.lexists(path):
        return
    wanted, fits = ("folder", path.is_dir()) if format.parts else ("file", path.is_file())
    if path.is_symlink() or not fits:  # devices are no files
        raise StoreError(f"{path} is there and is no {wanted}, which {format.name} needs; choose another --out")
    if not force:
        raise StoreError(exists(path))
    for part in sorted(path.iterdir()) if format.parts else ():
        if not re.fullmatch(format.parts, part.name):
            raise StoreError(f"{path} holds {part.name}, which is no part of an export; move it away, or choose another --out")
