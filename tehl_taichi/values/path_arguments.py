"""Path arguments of Python callers."""

from os import PathLike
from pathlib import Path

from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.values.coerce import shown


def path_of(name, value):
    """Path of an argument. Raises SceneError if it is neither text nor path, or has a character that no path has."""
    if not isinstance(value, (str, PathLike)) or value == "" or "\0" in str(value):
        raise SceneError(f"{name} = {shown(value)} is not a path; allowed: text or a pathlib.Path")
    return Path(value)


def folder_of(of):
    """Path of a Run, a Study or a Flank, or the path itself. Raises StoreError for anything else."""
    for found in (of, getattr(of, "path", None), getattr(of, "folder", None)):
        if isinstance(found, (str, PathLike)):
            return Path(found)
    raise StoreError(f"{shown(of)} is not a run, study or flank; allowed: its path, or the result of tehl_taichi.open")
