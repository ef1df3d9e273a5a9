"""Arrays of a store, and the file that lists the entries visible to a reader."""

import math
from typing import Any

import numpy as np

from tehl_taichi.disk import files
from tehl_taichi.march.step_output import fields_of, scalars_of
from tehl_taichi.store import array_file, chunks
from tehl_taichi.store.integrity import ROOT

# series of the snapshot itself: (dtype, units, text, what is not written yet, how they stand for several steps)
OWN = {"step": ("i8", "1", "step number", -1, ""), "time": ("f8", "s", "time since the steady start", math.nan, ""),
       "feature_x": ("f8", "m", "position of feature.x = 0", math.nan, "point")}


def lay_out(folder, capacity, scene, snapshot):
    """Create the arrays for `capacity` entries: coordinates, every output of the scene, series of the snapshot. Returns the
    metadata of each, {name: metadata}."""
    return {**_coordinates(folder, snapshot), **_fields(folder, capacity, scene, snapshot), **_series(folder, capacity, scene)}


def publish(path, attrs, arrays):
    """Replace the group's metadata: attributes, and those of the `arrays` {name: metadata}, whose time axes are cut at
    attrs['steps']. Raises OSError."""
    for array in arrays.values():
        if array["dimension_names"][0] == "time":
            array["shape"][0] = attrs["steps"]
    array_file.publish(path, attrs, arrays)


def array(folder, name, shape, chunk, dtype, dims, units, long_name, fill, between=array_file.SEPARATOR, **attrs):
    """Create an array of the group in `folder`; between: separator of the numbers of a chunk in its file name. Returns {name:
    its metadata}."""
    found = array_file.described(shape, chunk, dtype, dims, fill, {"units": units, "long_name": long_name, **attrs}, between)
    (folder / name).mkdir()
    files.write(folder / name / ROOT, array_file.content(found))
    return {name: found}


def whole(folder, name, values, dims, units, long_name, fill=0.0, **attrs):
    """Create an array of one chunk with its values, f4 or else f8. Returns {name: its metadata}."""
    kind = "f4" if np.asarray(values).dtype == np.float32 else "f8"
    values = np.asarray(values, kind)
    found = array(folder, name, values.shape, values.shape, kind, dims, units, long_name, fill, **attrs)
    chunk = array_file.chunk_file(folder / name, values.ndim)
    chunk.parent.mkdir(parents=True)
    files.write(chunk, chunks.compressed(values, "<" + kind))
    return found


def _coordinates(folder, snapshot):
    made: dict[str, Any] = {}
    for name, values, text in (("x", snapshot.x, "along rolling"), ("y", snapshot.y, "across")):
        made |= whole(folder, name, values, [name], "m", text)
    if "temperature" in snapshot.fields:
        from tehl_taichi.heat.chebyshev import chebyshev

        zeta = chebyshev(snapshot.fields["temperature"].shape[2])[0]
        made |= whole(folder, "zeta", zeta, ["zeta"], "1", "z/h from surface a to surface b")
    return made


def _fields(folder, capacity, scene, snapshot):
    made: dict[str, Any] = {}
    for name, field in fields_of(scene).items():
        shape, fill = snapshot.fields[name].shape, 0 if field.dtype == "u1" else math.nan
        # files without folders: three a field would be made at every step
        made |= array(folder, name, (capacity, *shape), (1, *shape), field.dtype, ["time", *field.dims], field.unit,
                      field.says, fill, between=".")
    return made


def _series(folder, capacity, scene):
    made: dict[str, Any] = {}
    numbers = {name: ("f8", scalar.unit, scalar.says, math.nan, scalar.over) for name, scalar in scalars_of(scene).items()}
    for name, (dtype, units, text, fill, over) in {**numbers, **OWN}.items():
        folded = {"cell_methods": f"time: {over}"} if over and scene.output.every > 1 else {}
        made |= array(folder, name, (capacity,), (capacity,), dtype, ["time"], units, text, fill, **folded)
    return made
