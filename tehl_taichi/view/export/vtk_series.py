"""ParaView files of a stored run: passage.pvd, a time series of images over x and y, and the fatigue map around the feature.

The XML of VTK's image data is written here, which is shorter than the use of a library. Blocks are compressed by zlib and in
base64 inside their element, so the files are XML. Source: "VTK File Formats", docs.vtk.org.
"""

import base64
import struct
import zlib

import numpy as np

from tehl_taichi.view.export.file_format import Format, flat_fields, unit
from tehl_taichi.view.zoom_window import ZoomWindow

TYPES = {"f4": "Float32", "f8": "Float64", "u1": "UInt8"}
TOP = '<?xml version="1.0"?>\n<!-- tehl_taichi -->\n'  # by which --force knows the file
HEAD = 'byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor"'


def write(reader, folder, places):
    """Write an image for each entry, the .pvd with their times (s), fatigue.vti, and the files of zoom windows."""
    names = [f"step_{step:06d}.vti" for step in reader.scalar("step")]
    for n, name in enumerate(names):
        moment = {_named(reader, key): reader.scalar(key)[n] for key in ("feature_x", "p_max_Pa", "h_min_m")}
        fields = {_named(reader, key): values for key, values in reader.fields(n, flat_fields(reader)).items()}
        (folder / name).write_text(image(reader.x, reader.y, fields, {"TimeValue": reader.time[n], **moment}))
    found = "feature_frame_x", "feature_frame_y"
    if maps := [name for name, array in reader.metadata.items() if tuple(array["dimension_names"]) == found]:
        fields = {_named(reader, name): reader.map(name) for name in maps}
        (folder / "fatigue.vti").write_text(image(reader.map(found[0]), reader.map(found[1]), fields, {}))
    (folder / "passage.pvd").write_text(collection(zip(reader.time, names)))
    for window in ZoomWindow.all_of(reader):
        _write_window(reader, window, folder)


def _write_window(reader, window, folder):
    """Write an image of the zoom window for each of its entries, and zoom.pvd (zoom2 for the second window)."""
    names = [f"{window.first}{int(reader.scalar('step')[n]):06d}.vti" for n in window.entries]
    for n, name in zip(window.entries, names):
        fields = {_named(reader, window.first + key): values for key, values in window.fields(n).items()}
        (folder / name).write_text(image(window.columns(n), window.y, fields, {"TimeValue": reader.time[n]}))
    (folder / f"{window.first.removesuffix('_')}.pvd").write_text(collection(zip(reader.time[window.entries], names)))


def collection(times):
    """Text of a .pvd: (time, file) of every image."""
    parts = "\n".join(f'<DataSet timestep="{float(time)!r}" file="{file}"/>' for time, file in times)
    return f'{TOP}<VTKFile type="Collection" version="1.0" {HEAD}>\n<Collection>\n{parts}\n</Collection>\n</VTKFile>\n'


def image(x, y, fields, numbers):
    """Text of a .vti: {name: (nx, ny) array} on the even grid x, y (m) at z = 0, and {name: number}."""
    extent = f"0 {x.size - 1} 0 {y.size - 1} 0 0"
    steps = " ".join(repr(float(v[-1] - v[0]) / (v.size - 1) if v.size > 1 else 1.0) for v in (x, y))
    points = "\n".join(_array(name, values.T, "") for name, values in fields.items())  # x runs fastest
    alone = "\n".join(_array(name, np.array([float(value)]), 'NumberOfTuples="1"') for name, value in numbers.items())
    return (f'{TOP}<VTKFile type="ImageData" version="1.0" {HEAD}>\n'
            f'<ImageData WholeExtent="{extent}" Origin="{float(x[0])!r} {float(y[0])!r} 0" Spacing="{steps} 1">\n'
            f'<FieldData>\n{alone}\n</FieldData>\n<Piece Extent="{extent}">\n<PointData>\n{points}\n</PointData>\n</Piece>\n'
            "</ImageData>\n</VTKFile>\n")


def _array(name, values, more):
    kind = TYPES[values.dtype.str[1:]]
    raw = values.astype(values.dtype.newbyteorder("<")).tobytes()
    packed = zlib.compress(raw, 1)
    head = struct.pack("<4Q", 1, len(raw), 0, len(packed))  # one block of that size, no rest, packed size
    text = base64.b64encode(head).decode() + base64.b64encode(packed).decode()
    return f'<DataArray type="{kind}" Name="{name}" {more} format="binary">{text}</DataArray>'


def _named(reader, name):
    """Name with the unit at its end, because ParaView has no other place for it."""
    of = unit(reader, name)
    return name if of == "1" or name.endswith(f"_{of}") else f"{name}_{of}"


FORMAT = Format(name="vtk", says="a folder with passage.pvd, which ParaView opens as a time series", ending="-vtk",
                parts=r"(passage|zoom2?)\.pvd|((step|zoom2?)_\d+|fatigue)\.vti", write=write)
