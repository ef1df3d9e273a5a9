"""Links and special files: a folder that holds one is read, but not written."""

import os
import stat
from pathlib import Path

from tehl_taichi.errors import StoreError

MARKS = ROOT, FLANK, *_ = "zarr.json", "flank.json", "bearing.json", "cam.json"  # of a store or a study, a flank ...


def refuse(folder):
    """Raises StoreError where `folder`, or anything in it, is a link, a file with a second name, or no plain file; also where
    a link leads to it inside a study or a flank."""
    folder = Path(folder)
    for path in (*_ways(folder), folder, *_below(folder)):
        if what := strange(os.lstat(path)):
            where = f"{folder} holds {what}, {path}" if path.is_relative_to(folder) and path != folder else f"{path} is {what}"
            raise StoreError(f"{where}, and tehl does not write through links. `cp -rL {folder} NEW` makes a copy without "
                             "links that can be written")


def strange(status):
    """Kind of an entry (os.lstat) that is never written to, as text; "" for folders and files."""
    if stat.S_ISDIR(status.st_mode):
        return ""
    if stat.S_ISLNK(status.st_mode):
        return "a link"
    if not stat.S_ISREG(status.st_mode):
        return "a special file"
    return "a hard link" if status.st_nlink > 1 else ""


def is_folder(path):
    """Whether `path` itself is a folder, not a link to one."""
    return os.path.isdir(path) and not os.path.islink(path)


def refuse_itself(path):
    """Raises StoreError where a folder to write into is a link."""
    if os.path.islink(path):
        raise StoreError(f"{path} is a link, and tehl does not write through links; choose another --out")


def around(path):
    """Folders of results around a path (studies, flanks ...), the innermost first, by its name and by where its links lead."""
    ways = path.absolute().parent, Path(os.path.realpath(path.absolute().parent))
    return [folder for way in ways for folder in (way, *way.parents)
            if any(os.path.lexists(folder / mark) for mark in MARKS)]


def _ways(folder):
    """The links inside a study or a flank that the name of `folder` leads through."""
    absolute = folder.absolute()
    found = [top for top in around(folder) if absolute.is_relative_to(top)]
    return [way for way in absolute.parents if found and way.is_relative_to(found[-1]) and way != found[-1]
            and os.path.islink(way)]


def _below(folder):
    """Generator of the paths of all that is in a folder, which is not left through a link."""
    if is_folder(folder):
        with os.scandir(folder) as entries:
            for entry in sorted(entries, key=lambda one: one.name):
                yield Path(entry.path)
                if entry.is_dir(follow_symlinks=False):
                    yield from _below(entry.path)
