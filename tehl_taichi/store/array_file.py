"""Files of one array in the format of zarr (version 3, one folder an array): its description, and whole arrays of one chunk.

They are written without zarr, which takes 2 ms to describe an array and 5 ms to write a chunk: a run has 70 arrays, and a study
writes its table again and again.
"""

import contextlib
import functools
import json
import math
import os
from pathlib import Path

import numpy as np

from tehl_taichi.disk import files
from tehl_taichi.disk.links import ROOT
from tehl_taichi.errors import StoreError
from tehl_taichi.store import chunks

SEPARATOR = "/"  # of the numbers of a chunk in its file name


def described(shape, chunk, dtype, dims, fill, attributes, between=SEPARATOR):
    """Description (a dictionary, as in its metadata file) of an array.

    shape, chunk: numbers of values; dtype: of numbers; dims: names; fill: value of what is not written; attributes: {name:
    value}; between: separator of the numbers of a chunk in its file name.
    """
    kind = np.dtype(dtype)
    order = {"configuration": {"endian": "little"}} if kind.itemsize > 1 else {}
    return {"shape": list(shape), "data_type": kind.name,
            "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": list(chunk)}},
            "chunk_key_encoding": {"name": "default", "configuration": {"separator": between}},
            "fill_value": _fill(kind, fill),
            "codecs": [{"name": "bytes", **order}, {"name": "zstd", "configuration": dict(chunks.SETTINGS)}],
            "attributes": attributes, "dimension_names": list(dims), "zarr_format": 3, "node_type": "array",
            "storage_transformers": []}


def _fill(kind, fill):
    """A fill value as the format writes it; float: finite or nan."""
    if kind.kind != "f":
        return int(fill)
    return "NaN" if math.isnan(fill) else float(fill)


def content(description):
    """Bytes of the metadata file of an array."""
    return _indented(json.dumps(description))


@functools.lru_cache(maxsize=1000)
def _indented(text):
    """JSON text as zarr writes it. Kept: it takes 0.1 ms, and the stores of a study have the same ones."""
    return json.dumps(json.loads(text), indent=2).encode()


def publish(folder, attrs, arrays):
    """Replace the metadata of the group in `folder`, with those of its arrays {name: metadata}, as a whole. Raises OSError."""
    root = {"zarr_format": 3, "node_type": "group", "attributes": attrs,
            "consolidated_metadata": {"kind": "inline", "must_understand": False, "metadata": arrays}}
    files.replace(folder / ROOT, json.dumps(root).encode())


def chunk_file(folder, dimensions):
    """File of the only chunk of the array in `folder`."""
    return folder / "/".join(["c", *("0" * dimensions)])


def write(folder, values, dims, fill, attributes):
    """Write an array of one chunk, of numbers or of text, into its `folder`, in place of an existing one; arguments as for
    :func:`described`. Returns its description. Raises OSError.
    """
    if values.dtype == object:
        return _written_by_zarr(folder, values, dims, attributes)
    found = described(values.shape, values.shape, values.dtype, dims, fill, attributes)
    folder.mkdir(exist_ok=True)
    files.replace(folder / ROOT, content(found))
    write_values(folder, values)
    return found


def _written_by_zarr(folder, values, dims, attributes):
    """As :func:`write`, of text."""
    import zarr

    zarr.create_array(str(folder), shape=values.shape, chunks=values.shape, dtype=str, dimension_names=list(dims),
                      fill_value="", attributes=attributes, overwrite=True)[...] = values
    return files.json_of(folder / ROOT)


def write_values(folder, values):
    """Replace the values of an array of one chunk in `folder`. Raises OSError."""
    values = np.asarray(values)
    file = chunk_file(Path(folder), values.ndim)
    file.parent.mkdir(parents=True, exist_ok=True)
    files.replace(file, chunks.compressed(values, values.dtype.newbyteorder("<")))


def read_whole(folder):
    """The values of the array in `folder`. Raises StoreError."""
    check(folder)
    with _damage_errors(folder):
        found = _of_one_chunk(folder)
        return _by_zarr(folder) if found is None else found


def check(folder):
    """Refuse an array whose files declare more than its size, or that does not fit in memory. Raises StoreError."""
    with _damage_errors(folder):
        chunks.check(folder)


@contextlib.contextmanager
def _damage_errors(folder):
    """Context manager: every error while an array is read becomes a StoreError."""
    try:
        yield
    except StoreError:
        raise
    except Exception as error:  # zarr and its codecs have no common one
        why = (f"its {ROOT} has no {error}" if isinstance(error, KeyError) else
               getattr(error, "strerror", None) or " ".join(str(error).split()))
        raise StoreError(f"{folder} is damaged or missing ({why})") from None


def _of_one_chunk(folder):
    """Values of an array like those of :func:`described` in one chunk; None for another one, and without a file of values."""
    array = files.json_of(folder / ROOT)
    shape, kind = array["shape"], array["data_type"]
    if kind == "string" or not _as_ours(array, described(shape, shape, kind, (), 0, {})):
        return None
    file = chunk_file(folder, len(shape))
    if not os.path.exists(file):
        return None
    return chunks.read(file, np.dtype(kind).newbyteorder("<"), math.prod(shape)).reshape(shape).astype(kind)


def _as_ours(array, ours):
    return all(array[key] == ours[key] for key in ("chunk_grid", "chunk_key_encoding", "codecs"))


def _by_zarr(folder):
    """Values of an array of several chunks, of text, or of another writer."""
    import zarr

    return zarr.open_array(str(folder), mode="r")[...]
