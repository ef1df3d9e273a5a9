"""Flanks, bearings, cams and studies side by side: what differs, a table by position, one figure over one axis."""

import math
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path

from tehl_taichi.runs import compare_labels, place_table
from tehl_taichi.runs.compare_change import change, separated
from tehl_taichi.runs.compare_rows import NONE, in_order
from tehl_taichi.runs.open_results import kind
from tehl_taichi.runs.open_results import open as opened
from tehl_taichi.values.digits import with_error
from tehl_taichi.values.summary_units import nothing_of, unit_of

UNKNOWN = " (error unknown)"  # behind a change of two numbers, one of them at least without a bar


@dataclass(frozen=True)
class PlaceRow:
    """A quantity at a place. name: as in tables and JSON; numbers: (value, error bar or None) of each, None where it has
    none."""

    name: str
    quantity: place_table.PlaceQuantity
    place: place_table.Place
    numbers: tuple

    @property
    def texts(self):
        """The numbers as they are printed."""
        return tuple(NONE if one is None else self._text(*one) for one in self.numbers)

    def _text(self, value, error):
        value *= self.quantity.factor
        return format(value, self.quantity.form) if error is None else with_error(value, error * self.quantity.factor)

    @property
    def change(self):
        """The change of two numbers in words, "" where it means nothing."""
        if len(self.numbers) != 2 or None in self.numbers:
            return ""
        words = change(*self.numbers, nothing_of(self.name), unit_of(self.name))
        return words + UNKNOWN * bool(words and self.quantity.barred and separated(*self.numbers) is None)

    def to_dict(self):
        """Its entry in the JSON object."""
        pair = len(self.numbers) == 2 and None not in self.numbers
        values, errors = zip(*(one or (None, None) for one in self.numbers))
        return {"quantity": self.name, "at": self.place.words, "values": list(values), "errors": list(errors),
                **({"separated": separated(*self.numbers), "change": self.change} if pair else {})}


@dataclass(frozen=True)
class PlaceComparison:
    """Flanks, bearings, cams or studies side by side: :func:`tehl_taichi.compare` gives one.

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
        """Folder names, with as much of the path before as makes them differ."""
        return compare_labels.names([table.folder for table in self.tables])

    @cached_property
    def differs(self) -> dict:
        """{dotted key: its value in each} of the settings that differ; contacts and speeds of single positions are in
        :attr:`rows`."""
        return compare_labels.differs(place_table.settings(self.tables))

    def labels(self) -> list:
        """A name for each that says what is special about it: up to two values that differ, or its folder."""
        return compare_labels.labels(self.differs, [table.folder for table in self.tables])

    @cached_property
    def places(self) -> list:
        """The places of all, along their axis."""
        known = {place.key: place for table in reversed(self.tables) for place in table.places}
        found = [known[key] for key in in_order([[place.key for place in table.places] for table in self.tables])]
        return found if self.tables[0].ticks else sorted(found, key=lambda place: place.x)

    def x_of(self, place):
        """Where a place is on the axis."""
        return float([one.key for one in self.places].index(place.key)) if self.tables[0].ticks else place.x

    @cached_property
    def quantities(self) -> dict:
        """{name: quantity} of all that have numbers."""
        known = {name: one for table in reversed(self.tables) for name, one in table.quantities.items()}
        order = in_order([list(table.quantities) for table in self.tables])
        numbered = {name for table in self.tables for name, _ in table.numbers}
        return {name: known[name] for name in order if name in numbered}

    @cached_property
    def rows(self) -> list:
        """A :class:`PlaceRow` for each quantity at each place that has it somewhere."""
        rows = (PlaceRow(name, quantity, place, tuple(table.numbers.get((name, place.key)) for table in self.tables))
                for name, quantity in self.quantities.items() for place in self.places)
        return [row for row in rows if any(row.numbers)]

    def unequal(self) -> list:
        """Names of the quantities that differ somewhere, as they are printed, or that one of the results does not have."""
        missing = {name for name in self.quantities for table in self.tables if name not in {one for one, _ in table.numbers}}
        return list(dict.fromkeys(row.name for row in self.rows
                                  if row.name in missing or len(set(row.texts) - {NONE}) > 1))

    def without_result(self) -> dict:
        """{name of a result: words of its places without one} where there are any."""
        return {name: list(table.failed) for name, table in zip(self.names, self.tables) if table.failed}

    def line(self, table, name):
        """(x, values, error bars or None), in the printed unit, of a quantity along a table; nan between both sides of a
        jump."""
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
        """The figure; returns its path. dpi, format (where the path has no suffix), width, force: as :meth:`Run.plot`.

        Raises SceneError, StoreError.
        """
        from tehl_taichi.runs import compare_places_figure
        from tehl_taichi.view.figures.figure_style import FigureStyle

        return compare_places_figure.write(self, path, FigureStyle(format, dpi, width, force))
