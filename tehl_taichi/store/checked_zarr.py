"""Files of a store or study for xarray: a missing or damaged chunk raises a StoreError with its name, whenever it is read.

Zarr itself takes a missing chunk for its fill value, and its codecs do not know the file of a damaged one.
"""

import math
import os
from pathlib import Path

import numpy as np
import xarray
from zarr.storage import LocalStore

from tehl_taichi.disk.links import ROOT
from tehl_taichi.store import chunks, written_chunks


def opened(path, attrs, arrays, **options):
    """Open the group at `path` as an xarray.Dataset. attrs: its attributes; arrays: {name: metadata}; options: of
    xarray.open_zarr. Raises StoreError, also while data are loaded.
    """
    path = Path(path)
    written_chunks.check(path, arrays, attrs)
    data = xarray.open_zarr(CheckedFiles(path, attrs, arrays), **options)
    data.encoding["source"] = str(path)
    return data


class CheckedFiles(LocalStore):
    """Read-only files of the group at `root`; attrs, arrays: as for :func:`opened`."""

    def __init__(self, root, attrs, arrays):
        super().__init__(root, read_only=True)
        self.attrs, self.arrays = attrs, arrays

    def with_read_only(self, read_only=True):
        return type(self)(self.root, self.attrs, self.arrays)

    def __dask_tokenize__(self):  # else dask takes a rewritten store for the old one
        return type(self).__name__, str(self.root), os.stat(self.root / ROOT).st_mtime_ns

    async def get(self, key, prototype=None, byte_range=None):
        return self._checked(key, await super().get(key, prototype, byte_range), byte_range)

    def get_sync(self, key, *, prototype=None, byte_range=None):  # of later versions of zarr
        return self._checked(key, super().get_sync(key, prototype=prototype, byte_range=byte_range), byte_range)

    def _checked(self, key, found, part):
        """`found`, the content of a file; part: range of bytes, None: all. Raises StoreError."""
        name, _, file = key.partition("/")
        array = self.arrays.get(name)
        if array is None or not file.startswith("c"):
            return found
        if found is None:
            written_chunks.check(self.root, {name: array}, self.attrs)
        elif part is None and any(codec["name"] == "zstd" for codec in array["codecs"]):
            chunks.verify(self.root / key, found.to_bytes(), _bytes(array))
        return found


def _bytes(array):
    """Number of bytes of each chunk; None for text."""
    kind, shape = array["data_type"], array["chunk_grid"]["configuration"]["chunk_shape"]
    return None if kind == "string" else np.dtype(kind).itemsize * math.prod(shape)
