"""Drafts of new files and folders: made beside the final name, hidden and locked, then renamed to it.

So a store, a figure or an export appears complete or not at all. Beside `NAME` there may be hidden folders, whose names begin
with a dot and end with:
  .part  an unfinished draft; the next draft in the folder cleans up those of killed processes
  .old   the folder that --force replaces, between two renames; restored if the second rename never happened
  .gone  a folder that is being removed
Each has a lock; one whose lock does not belong to this program is left alone.
"""

import contextlib
import errno
import fnmatch
import os
import shutil
from pathlib import Path
from typing import Any

from tehl_taichi.disk.files import reason, store_error
from tehl_taichi.disk.links import ROOT, is_folder
from tehl_taichi.disk.locks import LOCK, Busy, Lock, holder, is_abandoned, lock_content
from tehl_taichi.errors import StoreError

PART, OLD, GONE = "part", "old", "gone"


def staging_path(path, what):
    """Path of the hidden folder beside a name, see above."""
    return path.with_name(f".{path.name}.{what}")


class Draft:
    """Reserve the name `path` for the result that :meth:`publish` puts there; replace: also if it exists; reserve = False:
    only check it.

    Raises StoreError if nothing can be made there, or an existing result may not be replaced; Busy.
    """

    def __init__(self, path, replace=False, reserve=True):
        self.path, self.made, self.old, self.published = Path(path), [], None, False
        self.lock: Any = None
        if not self.path.name:
            raise StoreError(f"{path} is not a possible name of a store or file; choose another --out")
        self.folder, self.replaces = staging_path(self.path, PART), replace
        put_back(self.path)
        try:
            self.old = self.allowed(replace)
            if reserve:
                self._make()
        except BaseException as error:
            self.give_up()
            if isinstance(error, OSError):
                raise store_error(error, f"cannot write to {self.path}: {reason(error)}") from None
            raise

    def allowed(self, replace):
        """Lock of the folder that is to be replaced, None without one. Raises StoreError if `path` may not be made."""
        raise NotImplementedError

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.give_up()

    def _make(self):
        self.made = missing_above(self.path)
        _make_folders(self.path)
        clean(self.path.parent)
        self.lock = self._locked()
        for leftover in self.folder.iterdir():
            if leftover.name != LOCK:
                remove_whole(leftover)
        if os.path.lexists(self.path) and not self.replaces:  # it came while we looked
            raise Busy(exists(self.path))

    def _locked(self):
        """Lock of the hidden folder, which is new or left by a killed process. Raises Busy for anything else."""
        while True:
            try:
                self.folder.mkdir()
            except FileExistsError:
                _check_ours(self.folder)
            try:
                return Lock(self.folder, self.path)
            except FileNotFoundError:
                continue  # its last owner removed the folder between the two lines

    def publish(self, made=None):
        """Rename the hidden folder, or `made` in it, to the final name; removes the replaced result. Raises StoreError if
        something else has appeared there.
        """
        aside = staging_path(self.path, OLD)
        try:
            if self.old:
                os.rename(self.path, aside)
            _put(made or self.folder, self.path, self.replaces)
        except OSError as error:
            put_back(self.path)
            raise store_error(error, f"cannot write {self.path}: {reason(error)}") from None
        self.published = True
        if made:
            remove(self.folder, self.lock)
        else:
            self.lock.moved(self.path)
        if self.old:
            trash = staging_path(self.path, GONE)
            os.rename(aside, trash)
            remove(trash, self.old)

    def give_up(self):
        """Remove an unpublished draft; an existing result with the final name stays."""
        if self.published:
            return
        put_back(self.path)  # Ctrl-C came between the renames
        if self.lock:
            remove(self.folder, self.lock)
        remove_empty(self.made)
        if self.old:
            self.old.release()


def _put(made, path, replaces):
    """Rename; a file does not overwrite another one unless it replaces it."""
    if os.path.isdir(made) or replaces:
        os.rename(made, path)
        return
    try:
        os.link(made, path)  # refused where something has that name, which a rename would not be
    except FileExistsError:
        raise
    except OSError:  # a file system without hard links
        os.rename(made, path)


def put_back(path):
    """Undo half a replacement: rename the old folder back if the new one never appeared."""
    aside = staging_path(path, OLD) if path.name else None
    if aside and not os.path.lexists(path) and _ours(aside):
        with contextlib.suppress(OSError):  # a read-only folder, or another process was faster
            os.rename(aside, path)


def clean(folder):
    """Remove unfinished drafts of killed processes of this host in `folder`; an old store only if a new one exists."""
    names = _names(folder)
    for what in (PART, GONE, OLD):
        for leftover in (Path(folder) / name for name in fnmatch.filter(names, f".*.{what}")):
            new = folder / leftover.name[1 : -len(what) - 1]
            if _ours(leftover) and is_abandoned(leftover) and (what != OLD or _replaced(leftover, new)):
                with contextlib.suppress(Busy, OSError):  # another process takes it over, or cleans too
                    remove(leftover, Lock(leftover))


def _names(folder):
    """Names in a folder; [] if it cannot be read."""
    try:
        return os.listdir(folder)
    except OSError:
        return []


def _replaced(old, new):
    """Whether a folder of the same kind has replaced the old one."""
    return is_folder(new) and os.path.isfile(new / ROOT) >= os.path.isfile(old / ROOT)


def _ours(folder):
    """Whether a hidden folder (no link) was made by this program for this user, by its lock."""
    return is_folder(folder) and _own(folder) and bool(lock_content(folder))


def _own(folder):
    return not hasattr(os, "geteuid") or os.lstat(folder).st_uid == os.geteuid()


def _check_ours(folder):
    """Raise Busy for a hidden folder that no killed process of this program left."""
    with contextlib.suppress(FileNotFoundError):  # its owner removes it now
        left = set(os.listdir(folder)) if is_folder(folder) else None
        new = left == set() or left == {LOCK} and not os.path.getsize(folder / LOCK)
        if not _ours(folder) and not (new and _own(folder)):
            what = "a link" if os.path.islink(folder) else "not written by tehl"
            raise Busy(f"{folder} is in the way and is {what}: move it away, or choose another --out")


def unfinished_error(path):
    """Error about a store that has not appeared at `path` yet (Busy while it is being written), or None."""
    folder = staging_path(Path(path), PART)
    if not is_folder(folder):
        return None
    if who := holder(folder):
        return Busy(f"{path} is still being written by {who} and has no entry yet")
    return StoreError(f"{path} does not exist: its run ended before the first entry was stored; run it again")


def missing_above(path):
    """Missing folders above `path`, the innermost first."""
    return [folder for folder in path.absolute().parents if not os.path.exists(folder)]


def remove_empty(folders):
    """Remove folders in this order, so far as they are empty."""
    for folder in folders:
        with contextlib.suppress(OSError):  # others use it, or it was never made
            folder.rmdir()


def nearest(path):
    """The file or folder at this absolute path, or the nearest one above it; the root where there is none, as of a drive."""
    return next((place for place in (path, *path.parents) if os.path.lexists(place)), Path(path.anchor))


def _make_folders(path):
    """Make the folders above `path`. Raises OSError, with the name of a file in their place."""
    folder = nearest(path.absolute().parent)
    if not os.path.isdir(folder):
        raise NotADirectoryError(errno.ENOTDIR, f"{folder} is not a folder")
    path.parent.mkdir(parents=True, exist_ok=True)


def remove(folder, lock):
    """Remove a folder, its marker file and lock last, so that an unfinished removal can be recognised; links are removed, not
    their targets.
    """
    try:
        for child in sorted(folder.iterdir(), key=lambda one: one.name == ROOT):
            if child.name != LOCK:
                remove_whole(child)
        lock.moved(folder)
        lock.release()
        folder.rmdir()
    except OSError:  # what stays is cleaned up by a later draft
        lock.file.close()


def remove_whole(path):
    """Remove a file, a link, or a folder with all in it. Raises OSError."""
    shutil.rmtree(path) if is_folder(path) else path.unlink()


def exists(path):
    """Text: something exists at `path`."""
    return f"{path} exists already; choose another --out, or use --force to replace it"
