"""Runs side by side: what differs of their scenes, their summaries, one figure of all."""

from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.runs.stored_run import Run
from tehl_taichi.scene.strength.scene_tables import ROWS_OF
from tehl_taichi.values.coerce import plain
from tehl_taichi.values.path_arguments import folder_of

MOST = 8  # stores: more lines cannot be distinguished
TABLES = {f"fatigue.{rows}": key for key, rows in ROWS_OF.items()}  # contents of a table: its name
# of a summary: words, or what every run has of its own
OWN = ("store", "version", "scene", "left_out", "warnings", "warning_codes", "warning_data", "error_parts", "unknown",
       "unknown_codes")


@dataclass(frozen=True)
class Comparison:
    """Two or more runs side by side: :func:`tehl_taichi.compare` gives one.

    Attributes
    ----------
    stores : tuple of Store
        The stores of the runs, in the given order.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Comparison(())
    <tehl.Comparison of 0 runs>
    """

    stores: tuple

    def __repr__(self):
        return f"<tehl.Comparison of {len(self.stores)} runs{': ' * bool(self.stores)}{', '.join(self.labels())}>"

    @property
    def names(self):
        """Folder names, with as much of the path before as makes them differ."""
        paths = [Path(store.path).absolute() for store in self.stores]
        for parts in range(1, 20):
            names = ["/".join(path.parts[-parts:]) for path in paths]
            if len(set(names)) == len(names):
                break
        return [name.removesuffix(".zarr") for name in names]

    @property
    def differs(self):
        """{dotted key of the scene: its value in every run} of the keys that are not the same in all; None where a scene does
        not have it."""
        scenes = [flat(store.scene.to_dict()) for store in self.stores]
        return _side_by_side(scenes, lambda key, values: len(set(map(repr, values))) > 1 and not _of_no_matter(key))

    @property
    def summaries(self):
        """{dotted name, as in the JSON summary: its number in every run}; None where a run does not have it (yet)."""
        return _side_by_side([flat(store.summary) for store in self.stores], lambda key, values: _shown_values(key, values))

    @property
    def lines(self):
        """The rows of `tehl show` for the summaries, a :class:`tehl_taichi.runs.compare_rows.ComparisonRow` for each
        quantity."""
        from tehl_taichi.runs.compare_rows import lines

        return lines([store.summary for store in self.stores])

    def labels(self):
        """A name for each run that says what is special about it: up to two values that differ, or its folder."""
        differs = [(key, values) for key, values in self.differs.items() if key != "note" and not _follows(key, self.differs)]
        if not 1 <= len(differs) <= 2:
            return self.names
        return [", ".join(f"{key.removesuffix('.name').rpartition('.')[2]} = {_short(values[n])}" for key, values in differs)
                for n in range(len(self.stores))]

    def to_dict(self):
        """The JSON object of `tehl compare --json`."""
        return {"stores": [str(store.path) for store in self.stores], "finished": [store.finished for store in self.stores],
                "differs": self.differs, "summaries": self.summaries}

    def plot(self, path: str | PathLike, at: float = 0.0, dpi: int = 160, format: str = "png", width: float = 17.0,
             force: bool = False) -> Path:
        """The figure, with the feature at `at` half-widths where runs have one; returns its path.

        dpi, format (where the path has no suffix), width, force: as :meth:`Run.plot`. Raises SceneError,
        StoreError.
        """
        from tehl_taichi.runs import compare_figure
        from tehl_taichi.view.figures.figure_style import FigureStyle

        return compare_figure.write(self, path, at, FigureStyle(format, dpi, width, force))


def compare(*paths: str | PathLike | Run) -> Comparison:
    """As :func:`tehl_taichi.compare`."""
    from tehl_taichi.store.store import Store

    if not 2 <= len(paths) <= MOST:
        raise SceneError(f"{len(paths)} stores to compare; allowed: 2 to {MOST}")
    stores = tuple(Store.open(folder_of(path)) for path in paths)
    if len({store.path.resolve() for store in stores}) < len(stores):
        raise StoreError(f"{_twice([store.path for store in stores])} is given twice; give different runs")
    return Comparison(stores)


def _twice(paths):
    return next(path for n, path in enumerate(paths) if path.resolve() in [other.resolve() for other in paths[:n]])


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


def _side_by_side(rows, kept):
    keys = dict.fromkeys(key for row in rows for key in row)
    found = {key: [row.get(key) for row in rows] for key in keys}
    return {key: values for key, values in found.items() if kept(key, values)}


def _follows(key, differs):
    """Numbers of oils and steels that their names bring, contents of a table with another name."""
    if TABLES.get(key) in differs:
        return True
    named = f"{key.rpartition('.')[0]}.name", f"{key.rpartition('.')[0]}.material"
    return key not in named and any(name in differs for name in named)


def _of_no_matter(key):
    """Names, and files whose heights are identified by their checksum."""
    return key == "name" or key.endswith(".file")


def _shown_values(key, values):
    parts = key.split(".")
    numbers = [v for v in values if isinstance(v, (int, float)) and not isinstance(v, bool)]
    return bool(numbers) and not set(parts) & set(OWN) and " " not in key


def _short(value):
    return f"{value:g}" if isinstance(value, float) else str(value) or "none"
