"""Links and special files: a folder that holds one is read, but not written."""

import os
import stat
from pathlib import Path

from tehl_taichi.errors import StoreError


def refuse(folder):
    """Raises StoreError where `folder`, or anything in it, is a link, a file with a second name, or no plain file."""
    for path in (Path(folder), *_below(folder)):
        if what := strange(os.lstat(path)):
            where = f"{path} is {what}" if path == Path(folder) else f"{folder} holds {what}, {path}"
            raise StoreError(f"{where}, and nothing is written through one; what it leads to stays as it is. "
                             f"`cp -rL {folder} NEW` makes a copy without links, which can be written")


def strange(status):
    """What makes an entry of this status (of os.lstat) one that nothing is written to, in words; "" for folders and files."""
    if stat.S_ISDIR(status.st_mode):
        return ""
    if stat.S_ISLNK(status.st_mode):
        return "a link"
    if not stat.S_ISREG(status.st_mode):
        return "a special file"
    return "a hard link" if status.st_nlink > 1 else ""


def is_folder(path):
    """Whether there is a folder at `path` itself, not where a link leads."""
    return os.path.isdir(path) and not os.path.islink(path)


def _below(folder):
    """Generator of the paths of all that is in a folder, which is not left through a link."""
    if is_folder(folder):
        with os.scandir(folder) as entries:
            for entry in sorted(entries, key=lambda one: one.name):
                yield Path(entry.path)
                if entry.is_dir(follow_symlinks=False):
                    yield from _below(entry.path)
