"""Tables of a stored run as CSV files: a header `name [unit]`, numbers with points; numpy, pandas, Excel read them."""

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.values.escape import cell
from tehl_taichi.view.export.file_format import Format, flat_fields, unit
from tehl_taichi.view.zoom_window import ZoomWindow

DIGITS = "%.10g"  # single precision has nine
FRAME_X, FRAME_Y, DEPTH, ROW_DEPTH = "feature_frame_x", "feature_frame_y", "fatigue_depth", "under_row_depth"
FOUND = {(FRAME_X, FRAME_Y): "fatigue", (DEPTH, FRAME_X): "fatigue_under_row", (DEPTH,): "fatigue_contact_alone",
         (ROW_DEPTH, FRAME_X): "fatigue_under_row", (ROW_DEPTH,): "fatigue_contact_alone",
         (DEPTH, FRAME_X, FRAME_Y): "fatigue_at_depths"}  # {dimensions of a fatigue result: its table}
COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")


def write(reader, folder, places):
    """Write every table of the run, and those of `places`, into the folder."""
    for name, table in _tables(reader, places):
        rows = np.column_stack(list(table.values()))
        np.savetxt(folder / f"{name}.csv", rows, DIGITS, ",", header=",".join(map(_cell, table)), comments="", encoding="utf-8")


def _tables(reader, places):
    """Generator of (name, {title: column}) of every table."""
    yield "series", series(reader)
    yield "centreline_steady", centreline(reader, 0)
    windows = ZoomWindow.all_of(reader)
    for at, entry in places.at.items():
        yield f"centreline_at_{at:g}a", centreline(reader, entry)
        for window in windows:
            if entry in window and window.row(0.0) is not None:
                yield f"centreline_{window.first}at_{at:g}a", window_centreline(window, entry)
    for x, y in places.points:
        yield f"point_{x * 1e6:g}um_{y * 1e6:g}um", history(reader, x, y)
    for dims, name in FOUND.items():
        if table := result(reader, dims):
            yield name, table
    for name in ("worst", "worst_below"):
        if reader.map(f"{name}_stress") is not None:
            yield f"{name}_point", worst(reader, name)


def _cell(title):
    """Cell of the title line; the title of another program's store may contain any text."""
    text = cell(title)
    return '"' + text.replace('"', '""') + '"' if set(text) & set(',"\n') else text


def _title(reader, name):
    return f"{name} [{unit(reader, name)}]"


def series(reader):
    """Table of every scalar over time."""
    names = ["time", *(name for name in reader.names if name != "time")]
    return {_title(reader, name): reader.scalar(name) for name in names}


def centreline(reader, n):
    """Table of every field along y = 0 at entry n, and its moment."""
    row = nearest_index(reader.y, 0.0)
    moment = {_title(reader, name): np.full(reader.x.size, reader.scalar(name)[n]) for name in ("time", "feature_x")}
    return {"x [m]": reader.x, **_of(reader, {name: values[:, row] for name, values in _flat(reader, n).items()}), **moment}


def window_centreline(window, n):
    """Table of every field of the zoom window along y = 0 at entry n of the run, and its moment."""
    reader, row, x = window.store, window.row(0.0), window.columns(n)
    moment = {_title(reader, name): np.full(x.size, reader.scalar(name)[n]) for name in ("time", "feature_x")}
    fields = {f"{name} [{unit(reader, window.first + name)}]": values[:, row] for name, values in window.fields(n).items()}
    return {"x [m]": x, **fields, **moment}


def history(reader, x, y):
    """Table of every field at a point (m, measured as feature.x and feature.y) of the surface with the first feature, while it
    is on the grid. Raises SceneError if it never is.
    """
    centres = np.nan_to_num(reader.scalar("feature_x"))
    entries = np.flatnonzero((centres + x >= reader.x[0]) & (centres + x <= reader.x[-1]))
    if not entries.size:
        raise SceneError(f"the point at x = {x:g} m of the surface is never on the grid, which extends from "
                         f"{reader.x[0]:g} to {reader.x[-1]:g} m")
    at = {name: reader.scalar(name)[entries] for name in ("time", "feature_x")}
    fields = [_at(reader, _flat(reader, n), centres[n] + x, y) for n in entries]
    return {**_of(reader, at), "x [m]": centres[entries] + x,
            **_of(reader, {name: np.array([values[name] for values in fields]) for name in fields[0]})}


def _at(reader, fields, x, y):
    """{name: value} at (x, y), m, by linear interpolation."""
    row = np.interp(y, reader.y, np.arange(reader.y.size))
    low = min(int(row), reader.y.size - 1)
    high, part = min(low + 1, reader.y.size - 1), row - low
    return {name: np.interp(x, reader.x, (1 - part) * values[:, low] + part * values[:, high])
            for name, values in fields.items()}


def result(reader, dims):
    """Table of the fatigue results with these dimensions, a row per point; {} without any."""
    names = [name for name, array in reader.metadata.items() if tuple(array["dimension_names"]) == dims and name != dims[0]]
    if not names:
        return {}
    places = np.meshgrid(*(reader.map(dim) for dim in dims), indexing="ij")
    return _of(reader, {**dict(zip(dims, places)), **{name: reader.map(name) for name in names}})


def worst(reader, name):
    """Table of the stress history of a worst point over the position of the feature, without the last, unloaded moment."""
    stress, pa = reader.map(f"{name}_stress")[:-1], unit(reader, f"{name}_stress")
    return {f"feature_x [{unit(reader, f'{name}_x_a')}]": reader.map(f"{name}_x_a")[:-1],
            **{f"sigma_{of} [{pa}]": stress[:, n] for n, of in enumerate(COMPONENTS)}}


def _flat(reader, n):
    return reader.fields(n, flat_fields(reader))


def _of(reader, columns):
    return {_title(reader, name): np.ravel(values) for name, values in columns.items()}


FORMAT = Format(name="csv", says="a folder of tables: series, centrelines, points, fatigue", ending="-csv", chosen=True,
                parts=r"(series|centreline_.*|point_.*|fatigue.*|worst_.*point)\.csv", write=write)
