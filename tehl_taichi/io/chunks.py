"""One chunk of an array: a file in the codecs that the array declares, bytes and zstd with a checksum."""

import numpy as np
import zarr
from numcodecs import zstd

from tehl_taichi.errors import StoreError

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


def packed(values, dtype):
    """The content of such a file. To write it through the library costs 5 ms, times 24 arrays a step."""
    return zstd.compress(np.ascontiguousarray(values, dtype), LEVEL, True)
