"""Names and labels of compared results, and the settings in which they differ."""

from pathlib import Path
from typing import Any

from tehl_taichi.scene.strength.scene_tables import ROWS_OF
from tehl_taichi.values.coerce import plain

TABLES = {f"fatigue.{rows}": key for key, rows in ROWS_OF.items()}  # contents of a table: its name


def names(paths):
    """Folder names, with as much of the path before as makes them differ."""
    found = [Path(path).absolute() for path in paths]
    for parts in range(1, 20):
        short = ["/".join(path.parts[-parts:]) for path in found]
        if len(set(short)) == len(short):
            break
    return [name.removesuffix(".zarr") for name in short]


def differs(settings):
    """{key: its value in every one} of the keys whose values differ; settings: a flat {key: value} of each."""
    return side_by_side(settings, lambda key, values: len(set(map(repr, values))) > 1 and not _of_no_matter(key))


def labels(differing, paths):
    """A name for each that says what is special about it: up to two values that differ, or its folder."""
    leading = [(key, values) for key, values in differing.items() if key != "note" and not follows(key, differing)]
    if not 1 <= len(leading) <= 2:
        return names(paths)
    return [", ".join(f"{key.removesuffix('.name').rpartition('.')[2]} = {_short(values[n])}" for key, values in leading)
            for n in range(len(paths))]


def flat(nested, above=""):
    """{dotted key: value} of tables in tables; the tables of a list are numbered, other lists are values."""
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
    """{key: its value in every row, None where it has none} of the keys that kept(key, values) chooses."""
    keys = dict.fromkeys(key for row in rows for key in row)
    found = {key: [row.get(key) for row in rows] for key in keys}
    return {key: values for key, values in found.items() if kept(key, values)}


def follows(key, differing):
    """Numbers of oils and steels that their names bring, contents of a table with another name."""
    if TABLES.get(key) in differing:
        return True
    named = f"{key.rpartition('.')[0]}.name", f"{key.rpartition('.')[0]}.material"
    return key not in named and any(name in differing for name in named)


def _of_no_matter(key):
    """Names, and files whose heights are identified by their checksum."""
    return key == "name" or key.endswith(".file")


def _short(value):
    return f"{value:g}" if isinstance(value, float) else str(value) or "none"
