"""Entry of a file format, and names of its columns."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Format:
    """name: as --format takes it; says: what it is; ending: of the file or folder that is made; parts: which names the files in
    that folder have (a regular expression), "" for a single file; chosen: whether `at` and `point` choose what of the run is
    written; write(reader, path, places): makes the file, or fills the folder."""

    name: str
    says: str
    ending: str
    write: Callable
    parts: str = ""
    chosen: bool = False

    def default_path(self, store):
        """Path beside the store at `store`, named after it."""
        return store.with_name(store.name.removesuffix(".zarr") + self.ending)


def unit(reader, name):
    """Unit of an array of the store."""
    return reader.metadata[name]["attributes"]["units"]


def flat_fields(reader):
    """Names of the stored fields over x and y (those across the film have a dimension more)."""
    return [name for name in reader.stored if reader.metadata[name]["dimension_names"] == ["time", "x", "y"]]
