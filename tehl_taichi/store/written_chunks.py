"""Chunk files that must exist: a zarr reader takes a missing one for its fill value (zeros, NaN)."""

import itertools
import os

from tehl_taichi.errors import StoreError
from tehl_taichi.store.chunks import SETTINGS

EVERY = "every_chunk"  # attribute of stores with all chunks; version 0.9.0 left out those that hold only the fill value
OURS = {"name": "zstd", "configuration": SETTINGS}  # codec of layouts 2 and 3, and of no default of other writers


def name(array, numbers):
    """File of the chunk with these numbers in the folder of its array (metadata); before layout 3 in folders of its own."""
    between = array["chunk_key_encoding"].get("configuration", {}).get("separator", "/")
    return between.join(["c", *map(str, numbers)])


def check(store, arrays, attrs):
    """Refuse the store at this path if a chunk of its arrays {name: metadata} is missing. Raises StoreError."""
    every = attrs.get(EVERY) is True
    for folder, array in ((store / name, array) for name, array in arrays.items()):
        try:
            missing = _missing(folder, array, every)
        except (KeyError, TypeError, ValueError, AttributeError):
            raise StoreError(f"{folder} is damaged: its metadata do not describe its chunks") from None
        if missing:
            raise StoreError(f"{folder / missing} is missing: the store is damaged")


def _missing(folder, array, every):
    """Name of the first missing one of the chunks that the writer of the array has written; None if there is none."""
    if OURS not in array["codecs"]:
        return None
    if not (every or array["dimension_names"][:1] == ["time"] or os.path.isdir(folder / "c")):  # made with the first chunk
        return None
    files, needed = _files(folder), itertools.product(*map(range, _counts(array)))
    names = (name(array, numbers) for numbers in needed)
    return next((one for one in names if one not in files and not os.path.isfile(f"{folder}/{one}")), None)


def _files(folder):
    """Names of the files in a folder: a tenth of the time of a look at each."""
    try:
        return {entry.name for entry in os.scandir(folder) if entry.is_file()}
    except OSError:
        return set()


def _counts(array):
    """Number of chunks along each dimension."""
    sizes, chunk = array["shape"], array["chunk_grid"]["configuration"]["chunk_shape"]
    return [-(-size // max(one, 1)) for size, one in zip(sizes, chunk, strict=True)]
