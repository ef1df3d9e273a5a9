"""Arrays of a store, and the file that lists the entries visible to a reader."""

import json

from tehl_taichi.disk import files
from tehl_taichi.march.step_output import fields_of, scalars_of
from tehl_taichi.store import chunks
from tehl_taichi.store.integrity import ROOT

# series of the snapshot itself: (dtype, units, text, what is not written yet, how they stand for several steps)
OWN = {"step": ("i8", "1", "step number", -1, ""), "time": ("f8", "s", "time since the steady start", float("nan"), ""),
       "feature_x": ("f8", "m", "centre of the first feature", float("nan"), "point")}


def lay_out(group, capacity, scene, snapshot):
    """Create the arrays for `capacity` entries: coordinates, every output of the scene, series of the snapshot."""
    _coordinates(group, snapshot)
    _fields(group, capacity, scene, snapshot)
    _series(group, capacity, scene)


def metadata(path):
    """Metadata of every array of the group, by name."""
    return {file.parent.name: files.json_of(file) for file in sorted(path.glob("*/zarr.json"))}


def publish(path, attrs, arrays):
    """Replace the group's metadata: attributes, and every array with its time axis cut at attrs['steps']. Raises OSError."""
    for array in arrays.values():
        if array["dimension_names"][0] == "time":
            array["shape"][0] = attrs["steps"]
    root = {"zarr_format": 3, "node_type": "group", "attributes": attrs,
            "consolidated_metadata": {"kind": "inline", "must_understand": False, "metadata": arrays}}
    files.replace(path / ROOT, json.dumps(root).encode())


def array(group, name, shape, chunk, dtype, dims, units, long_name, fill, between="/", **attrs):
    """Create an array in the group; between: separator of the numbers of a chunk in its file name."""
    return group.create_array(name, shape=shape, chunks=chunk, dtype=dtype, dimension_names=dims, fill_value=fill,
                              compressors=chunks.codecs(), chunk_key_encoding={"name": "default", "separator": between},
                              attributes={"units": units, "long_name": long_name, **attrs})


def _coordinates(group, snapshot):
    for name, values, text in (("x", snapshot.x, "along rolling"), ("y", snapshot.y, "across")):
        made = array(group, name, values.shape, values.shape, "f8", [name], "m", text, 0.0)
        made[:] = values
    if "temperature" in snapshot.fields:
        from tehl_taichi.heat.chebyshev import chebyshev

        zeta = chebyshev(snapshot.fields["temperature"].shape[2])[0]
        made = array(group, "zeta", zeta.shape, zeta.shape, "f8", ["zeta"], "1", "z/h from surface a to surface b", 0.0)
        made[:] = zeta


def _fields(group, capacity, scene, snapshot):
    for name, field in fields_of(scene).items():
        shape, fill = snapshot.fields[name].shape, 0 if field.dtype == "u1" else float("nan")
        # files without folders: three a field would be made at every step
        array(group, name, (capacity, *shape), (1, *shape), field.dtype, ["time", *field.dims], field.unit, field.says, fill,
              between=".")


def _series(group, capacity, scene):
    numbers = {name: ("f8", scalar.unit, scalar.says, float("nan"), scalar.over) for name, scalar in scalars_of(scene).items()}
    for name, (dtype, units, text, fill, over) in {**numbers, **OWN}.items():
        folded = {"cell_methods": f"time: {over}"} if over and scene.output.every > 1 else {}
        array(group, name, (capacity,), (capacity,), dtype, ["time"], units, text, fill, **folded)
