"""Names and labels of compared results, and the settings in which they differ."""

from pathlib import Path
from typing import Any

from tehl_taichi.scene.strength.scene_tables import ROWS_OF
from tehl_taichi.values.coerce import plain

TABLES = {f"fatigue.{rows}": key for key, rows in ROWS_OF.items()}  # contents of a table: its name


def names(paths):
    """Folder names, with as many parent folders as are needed to distinguish them."""
    found = [Path(path).absolute() for path in paths]
    for parts in range(1, 20):
        short = ["/".join(path.parts[-parts:]) for path in found]
        if len(set(short)) == len(short):
            break
    return [name.removesuffix(".zarr") for name in short]


def differs(settings):
    """{key: its value in every result} of the keys whose values differ; settings: a flat {key: value} per result."""
    return side_by_side(settings, lambda key, values: len(set(map(repr, values))) > 1 and not _of_no_matter(key))


def labels(differing, paths):
    """Label of each result: up to two values that differ, or its folder."""
    leading = [(key, values) for key, values in differing.items() if key != "note" and not follows(key, differing)]
    if not 1 <= len(leading) <= 2:
        return names(paths)
    return [", ".join(f"{key.removesuffix('.name').rpartition('.')[2]} = {_short(values[n])}" for key, values in leading)
            for n in range(len(paths))]


def flat(nested, above=""):
    """{dotted key: value} of nested tables; tables in a list are numbered, other lists are values."""
    out: dict[str, Any] = {}
    for key, value in nested.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            value = {str(n): item for n, item in enumerate(value)}
        if isinstance(value, dict):
            out |= flat(value, f"{above}{key}.")
        else:
            out[above + key] = plain(value)
    return out


def side_by_side(rows, kept):
    """{key: its value in every row, None where missing} of the keys for which kept(key, values) holds."""
    keys = dict.fromkeys(key for row in rows for key in row)
    found = {key: [row.get(key) for row in rows] for key in keys}
    return {key: values for key, values in found.items() if kept(key, values)}


def follows(key, differing):
    """Whether a key follows from another differing key: numbers of a named oil or steel, contents of a named table."""
    if TABLES.get(key) in differing:
        return True
    named = f"{key.rpartition('.')[0]}.name", f"{key.rpartition('.')[0]}.material"
    return key not in named and any(name in differing for name in named)


def _of_no_matter(key):
    """Whether a key has no influence: names, and files whose heights are identified by their checksum."""
    return key == "name" or key.endswith(".file")


def _short(value):
    return f"{value:g}" if isinstance(value, float) else str(value) or "none"
