"""Links and special files: a folder that contains one can be read, but not written."""

import os
import shlex
import stat
from pathlib import Path

from tehl_taichi.errors import StoreError

ROOT = "zarr.json"  # of a store or a study
MARKS = ROOT, "flank.json", "bearing.json", "cam.json"
SPECIAL = "a special file"  # such as /dev/null, which must stay


def refuse(folder):
    """Raise StoreError if `folder` or anything in it is a link, has a second name or is a special file; also if a link inside a
    study or flank leads to it.
    """
    folder = Path(folder)
    for path in (*_links_through(folder), folder, *_below(folder)):
        if what := special_kind(os.lstat(path)):
            where = f"{folder} holds {what}, {path}" if path.is_relative_to(folder) and path != folder else f"{path} is {what}"
            raise StoreError(f"{where}, and tehl does not write through links. `cp -rL {shlex.quote(str(folder))} NEW` makes a "
                             "copy without links that can be written")


def special_kind(status):
    """Kind of an entry (of os.lstat) that is never written to, as text; "" for folders and files."""
    if stat.S_ISDIR(status.st_mode):
        return ""
    if stat.S_ISLNK(status.st_mode):
        return "a link"
    if not stat.S_ISREG(status.st_mode):
        return SPECIAL
    return "a hard link" if status.st_nlink > 1 else ""


def is_folder(path):
    """Whether `path` itself is a folder, not a link to one."""
    return os.path.isdir(path) and not os.path.islink(path)


def refuse_itself(path):
    """Raise StoreError if a folder to write into is a link."""
    if os.path.islink(path):
        raise StoreError(f"{path} is a link, and tehl does not write through links; choose another --out")


def result_folders(path):
    """Result folders (studies, flanks ...) that contain a path, the innermost first, by its name and by the targets of its
    links.
    """
    ways = path.absolute().parent, Path(os.path.realpath(path.absolute().parent))
    return [folder for way in ways for folder in (way, *way.parents) if marks_of(folder)]


def marks_of(folder):
    """Names of the files by which a folder counts as one of results: beside its JSON file a set of contacts has its table,
    which output of --json that a user saved under that name has not.
    """
    files = {mark: (mark,) if mark == ROOT else (mark, f"{Path(mark).stem}.csv") for mark in MARKS}
    return [mark for mark, needed in files.items() if all(os.path.lexists(folder / name) for name in needed)]


def _links_through(folder):
    """Links inside a study or a flank through which the name of `folder` leads."""
    absolute = folder.absolute()
    found = [top for top in result_folders(folder) if absolute.is_relative_to(top)]
    return [way for way in absolute.parents if found and way.is_relative_to(found[-1]) and way != found[-1]
            and os.path.islink(way)]


def _below(folder):
    """Generator of the paths of all entries below a folder, without following links."""
    if is_folder(folder):
        with os.scandir(folder) as entries:
            for entry in sorted(entries, key=lambda one: one.name):
                yield Path(entry.path)
                if entry.is_dir(follow_symlinks=False):
                    yield from _below(entry.path)
