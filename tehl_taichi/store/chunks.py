"""Chunk files of arrays, compressed as the array declares (bytes and zstd with a checksum).

The declared size of a file is compared with its array before memory is allocated: a few bytes can declare terabytes.
"""

import contextlib
import math
import os

import numpy as np
from numcodecs import zstd

from tehl_taichi.disk import files, memory_limit
from tehl_taichi.disk.links import ROOT
from tehl_taichi.errors import StoreError

LEVEL = 1  # of zstd: the fields are a third smaller, more costs more time than it saves
SETTINGS = {"level": LEVEL, "checksum": True}  # of the chunks of a new array
CODECS = {"bytes", "zstd", "vlen-utf8"}
MAGIC, ID, SIZES = b"\x28\xb5\x2f\xfd", (0, 1, 2, 4), {1: 2, 2: 4, 3: 8}  # of a frame (RFC 8878)
SLACK = 1000  # bytes by which a chunk that does not shrink may grow, beside a hundredth


def read(path, dtype, count):
    """The `count` values of one chunk file. Raises StoreError with its name."""
    size = count * np.dtype(dtype).itemsize
    with _damage_errors(path):
        return np.frombuffer(_decompressed(files.content(path, 1.01 * size + SLACK), size), dtype)


def verify(path, frame, size):
    """Refuse the content `frame` of a chunk file with a wrong checksum or another size (bytes; None: any). Raises StoreError
    with its name.
    """
    with _damage_errors(path):
        _decompressed(frame, size)


def _decompressed(frame, size):
    if size is not None and (found := declared_bytes(frame)) != size:
        raise ValueError("it does not begin as a chunk" if found is None else
                         f"it declares {found} bytes, not the {size} of its array")
    try:
        return zstd.decompress(frame)
    except RuntimeError:  # of the codec, in its words
        raise ValueError("its content does not fit its checksum") from None


@contextlib.contextmanager
def _damage_errors(path):
    """Context manager: errors of the disk and of zstd become a StoreError."""
    try:
        yield
    except FileNotFoundError:
        raise StoreError(f"{path} is missing: the store is damaged") from None
    except (OSError, ValueError) as error:
        raise StoreError(f"{path} is damaged ({getattr(error, 'strerror', error)}); its data are lost") from None


def declared_bytes(frame):
    """Number of bytes that a zstd frame declares, None if it declares none."""
    if frame[:4] != MAGIC or len(frame) < 6:
        return None
    kind, alone = frame[4] >> 6, frame[4] >> 5 & 1
    begin, size = 5 + (1 - alone) + ID[frame[4] & 3], SIZES.get(kind, alone)
    return int.from_bytes(frame[begin : begin + size], "little") + 256 * (kind == 1) if size else None


def compressed(values, dtype):
    """Compressed content of a chunk file. Zarr itself needs 5 ms for it, times 24 arrays per step."""
    return zstd.compress(np.ascontiguousarray(values, dtype), LEVEL, True)


def check(folder):
    """Refuse an array whose files declare more than its size, or that does not fit in memory. Raises StoreError, OSError,
    ValueError, KeyError, TypeError.
    """
    array = files.json_of(folder / ROOT)
    chunk, kind = array["chunk_grid"]["configuration"]["chunk_shape"], array["data_type"]
    if {codec["name"] for codec in array["codecs"]} - CODECS:
        raise StoreError(f"{folder} is damaged: its codecs are not those of a store")
    if kind == "string":
        return
    each = np.dtype(kind).itemsize
    memory_limit.check(each * (math.prod(array["shape"]) + math.prod(chunk)), f"the array {folder}", StoreError)
    for file in (folder / "c").rglob("*"):
        if not os.path.isdir(file):
            _check_chunk(file, each * math.prod(chunk))


def _check_chunk(file, size):
    found = declared_bytes(files.content(file, 1.01 * size + SLACK))
    if found is not None and found > size:
        raise StoreError(f"{file} is damaged: it declares {found} bytes, and a chunk of its array has {size}")
