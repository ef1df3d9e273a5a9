"""Comparison of flanks, bearings, cams and studies: differing settings, a table by position, one figure over one axis."""

import math
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path

from tehl_taichi.runs import compare_labels, compare_places_figure, place_table
from tehl_taichi.runs.compare_change import are_separated, change
from tehl_taichi.runs.compare_rows import NONE, merged_order
from tehl_taichi.runs.open_results import kind
from tehl_taichi.runs.open_results import open as opened
from tehl_taichi.values.digits import with_bar, with_error
from tehl_taichi.values.summary_units import nothing_of, unit_of
from tehl_taichi.view.figures.figure_style import FigureStyle

UNKNOWN = " (error unknown)"  # behind a change of two numbers, one of them at least without a bar


@dataclass(frozen=True)
class PlaceRow:
    """A quantity at a place. name: as in tables and JSON; numbers: (value, error bar or None) of each result, None where
    missing.
    """

    name: str
    quantity: place_table.PlaceQuantity
    place: place_table.Place
    numbers: tuple

    @property
    def texts(self):
        """Printed texts of the numbers."""
        return tuple(NONE if one is None else self._text(*one) for one in self.numbers)

    def _text(self, value, error):
        value *= self.quantity.factor
        text = format(value, self.quantity.form) if error is None else with_error(value, error * self.quantity.factor)
        return with_bar(text, error) if self.quantity.barred else text

    @property
    def change(self):
        """Text of the change between two numbers, "" if it has no meaning."""
        if len(self.numbers) != 2 or None in self.numbers:
            return ""
        words = change(*self.numbers, nothing_of(self.name), unit_of(self.name))
        return words + UNKNOWN * bool(words and self.quantity.barred and are_separated(*self.numbers) is None)

    def to_dict(self):
        """Entry in the JSON object."""
        pair = len(self.numbers) == 2 and None not in self.numbers
        values, errors = zip(*(one or (None, None) for one in self.numbers))
        return {"quantity": self.name, "at": self.place.words, "values": list(values), "errors": list(errors),
                **({"separated": are_separated(*self.numbers), "change": self.change} if pair else {})}


@dataclass(frozen=True)
class PlaceComparison:
    """Comparison of flanks, bearings, cams or studies; :func:`tehl_taichi.compare` makes one.

    Attributes
    ----------
    kind : str
          "flank", "bearing", "cam" or "study".
    tables : tuple
          The numbers of each by position, in the given order.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.PlaceComparison("flank", ())
    <tehl.PlaceComparison flank: >
    """

    kind: str
    tables: tuple

    @classmethod
    def of(cls, folders: list) -> "PlaceComparison":
        """Comparison of results of one kind. Raises SceneError, StoreError."""
        which = kind(folders[0])
        tables = tuple(place_table.place_table(which, opened(folder)) for folder in folders)
        place_table.check_alike(tables)
        return cls(which, tables)

    def __repr__(self):
        return f"<tehl.PlaceComparison {self.kind}: {', '.join(self.names)}>"

    @property
    def names(self) -> list:
        """Folder names, with as many parent folders as are needed to distinguish them."""
        return compare_labels.names([table.folder for table in self.tables])

    @cached_property
    def differs(self) -> dict:
        """{dotted key: its value in each} of the settings that differ; contacts and speeds of single positions are in
        :attr:`rows`.
        """
        return compare_labels.differs(place_table.settings(self.tables))

    @property
    def without_settings(self) -> list:
        """Names of the folders without a stored contact, whose scenes are not known, if others have some."""
        known = [bool(table.scene) for table in self.tables]
        return [name for name, one in zip(self.names, known) if not one] if any(known) else []

    def labels(self) -> list:
        """Label of each result: up to two values that differ, or its folder."""
        return compare_labels.labels(self.differs, [table.folder for table in self.tables])

    @cached_property
    def places(self) -> list:
        """All places, sorted along their axis."""
        known = {place.key: place for table in reversed(self.tables) for place in table.places}
        found = [known[key] for key in merged_order([[place.key for place in table.places] for table in self.tables])]
        return found if self.tables[0].ticks else sorted(found, key=lambda place: place.x)

    def x_of(self, place):
        """Coordinate of a place on the axis."""
        return float([one.key for one in self.places].index(place.key)) if self.tables[0].ticks else place.x

    @cached_property
    def quantities(self) -> dict:
        """{name: quantity} of all quantities with numbers."""
        known = {name: one for table in reversed(self.tables) for name, one in table.quantities.items()}
        order = merged_order([list(table.quantities) for table in self.tables])
        numbered = {name for table in self.tables for name, _ in table.numbers}
        return {name: known[name] for name in order if name in numbered}

    @cached_property
    def rows(self) -> list:
        """One :class:`PlaceRow` for each quantity at each place where any result has it."""
        rows = (PlaceRow(name, quantity, place, tuple(table.numbers.get((name, place.key)) for table in self.tables))
                for name, quantity in self.quantities.items() for place in self.places)
        return [row for row in rows if any(row.numbers)]

    def unequal(self) -> list:
        """Names of the quantities that differ somewhere, that one of the results lacks, or that have no place in common."""
        met = {row.name for row in self.rows if len(row.numbers) - row.numbers.count(None) > 1}
        missing = {name for name in self.quantities for table in self.tables if name not in {one for one, _ in table.numbers}}
        missing |= self.quantities.keys() - met
        return list(dict.fromkeys(row.name for row in self.rows if row.name in missing or len(set(row.texts) - {NONE}) > 1))

    def common_places(self) -> int:
        """Number of places that all results have."""
        each = [{place.key for place in table.places} for table in self.tables]
        return len(set.intersection(*each)) if each else 0

    def without_result(self) -> dict:
        """{name of a result: texts of its places without a result}, for results with such places."""
        return {name: list(table.failed) for name, table in zip(self.names, self.tables) if table.failed}

    def line(self, table, name):
        """(x, values, error bars or None) of a quantity along a table, in the printed unit; nan between both sides of a
        jump.
        """
        out: list[tuple[float, float, float]] = []
        factor = self.quantities[name].factor
        for place in table.places:
            x, (value, error) = self.x_of(place), table.numbers.get((name, place.key)) or (math.nan, None)
            if out and out[-1][0] == x:
                out.append((x, math.nan, math.nan))
            out.append((x, value * factor, math.nan if error is None else error * factor))
        return tuple(map(list, zip(*out)))

    def to_dict(self) -> dict:
        """The JSON object of `tehl compare --json`, in SI units."""
        return {"kind": self.kind, "folders": [str(table.folder) for table in self.tables], "differs": self.differs,
                "without_result": self.without_result(), "rows": [row.to_dict() for row in self.rows]}

    def plot(self, path: str | PathLike, dpi: int = 160, format: str = "png", width: float = 17.0,
             force: bool = False) -> Path:
        """Write the figure; returns its path. dpi, format (if the path has no suffix), width, force: as :meth:`Run.plot`.

        Raises SceneError, StoreError.
        """
        return compare_places_figure.write(self, path, FigureStyle(format, dpi, width, force))
