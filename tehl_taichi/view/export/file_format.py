"""Entry type of file formats, and names of their columns."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Format:
    """A file format. name: value of --format; says: description; ending: of the file or folder; parts: regular expression of
    the file names in a folder, "" for a single file; chosen: `at` and `point` select the written part of the run; write(reader,
    path, places): writes the file or fills the folder.
    """

    name: str
    says: str
    ending: str
    write: Callable
    parts: str = ""
    chosen: bool = False

    def default_path(self, store):
        """Default path, beside the store and named after it."""
        return store.with_name(store.name.removesuffix(".zarr") + self.ending)


def unit(reader, name):
    """Unit of an array of the store."""
    return reader.metadata[name]["attributes"]["units"]


def flat_fields(reader):
    """Names of the stored fields over x and y (fields across the film have one more dimension)."""
    return [name for name in reader.stored if reader.metadata[name]["dimension_names"] == ["time", "x", "y"]]
