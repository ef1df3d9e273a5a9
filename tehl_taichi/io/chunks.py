"""One chunk of an array: a file in the codecs that the array declares, bytes and zstd with a checksum."""

import contextlib

import numpy as np
import zarr
from numcodecs import zstd

from tehl_taichi.errors import StoreError
from tehl_taichi.io import atomic

LEVEL = 1  # of zstd: the fields are a third smaller, more costs more time than it saves


def codecs():
    """As a new array is told."""
    return zarr.codecs.ZstdCodec(level=LEVEL, checksum=True)


def read(path, dtype):
    """The values of one chunk file. Raises StoreError with its name."""
    try:
        return np.frombuffer(zstd.decompress(path.read_bytes()), dtype)
    except FileNotFoundError:
        raise StoreError(f"{path} is missing: the store is damaged") from None
    except (OSError, RuntimeError, ValueError) as error:
        raise StoreError(f"{path} is damaged ({error}); what it held is lost") from None


def write(array, key, values, dtype):
    """Write one chunk of the array in that folder. Raises OSError.

    The same write through the library costs 5 ms, times 24 arrays a step. The folder itself is never made: where it is gone,
    the store was moved.
    """
    folder = array
    for part in key[:-1]:
        folder = folder / part
        with contextlib.suppress(FileExistsError):
            folder.mkdir()
    atomic.replace(folder / key[-1], zstd.compress(np.ascontiguousarray(values, dtype).tobytes(), LEVEL, True))
