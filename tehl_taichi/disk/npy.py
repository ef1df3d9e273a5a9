"""Numpy files; their headers are trusted only up to the size of the file."""

import math
import os
import zipfile

import numpy as np

from tehl_taichi.disk import memory_limit

HEADERS = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}


def load(path):
    """Load the array of a .npy file. Raises ValueError if it is none or declares more than it holds; SceneError without enough
    memory; OSError.
    """
    with open(path, "rb") as file:
        memory_limit.check(3 * declared_bytes(file, os.fstat(file.fileno()).st_size), f"{path}, with its copies,")
        file.seek(0)
        return np.load(file, allow_pickle=False)


def load_all(path):
    """Load {name: array} of an uncompressed .npz file. Raises ValueError, OSError, zipfile.BadZipFile."""
    with zipfile.ZipFile(path) as archive:
        members, size = archive.infolist(), os.path.getsize(path)
        if any(member.compress_type != zipfile.ZIP_STORED for member in members) or sum(m.file_size for m in members) > size:
            raise ValueError("it declares more data than it holds")
        for member in members:
            with archive.open(member) as file:
                declared_bytes(file, member.file_size)
    with np.load(path, allow_pickle=False) as saved:
        return {key: saved[key] for key in saved.files}


def declared_bytes(file, size):
    """Number of bytes that the header of an open .npy file declares. Raises ValueError if the file, of `size` bytes, is too
    short for them.
    """
    version = np.lib.format.read_magic(file)
    if version not in HEADERS:
        raise ValueError(f"its format {version[0]}.{version[1]} is not known")
    shape, _, dtype = HEADERS[version](file)
    found = math.prod(shape) * dtype.itemsize
    if found > size - file.tell() and not dtype.hasobject:  # objects are refused by numpy
        raise ValueError(f"its header declares {'x'.join(map(str, shape))} numbers, {memory_limit.words(found)}, and the file "
                         f"holds {memory_limit.words(size - file.tell())}")
    return found
