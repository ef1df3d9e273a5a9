"""A bearing as its folder keeps it: loads, both contacts with their summaries, the table, the figure."""

import json
import os
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from tehl_taichi.disk import files, links, user_files
from tehl_taichi.errors import StoreError
from tehl_taichi.runs.bearing import bearing_table
from tehl_taichi.runs.bearing.ring_contacts import RINGS

FILE, TABLE = "bearing.json", "bearing.csv"


@dataclass(frozen=True)
class Bearing:
    """Results of a rolling bearing: :func:`tehl_taichi.bearing` and :func:`tehl_taichi.open` give one.

    Attributes
    ----------
    folder : pathlib.Path
        Its folder.
    record : dict
        The JSON object of `tehl bearing --json`.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> ring = {"p_Hertz_Pa": 2e9, "summary": None}
    >>> tehl.Bearing("b", {"name": "6206", "inner": ring, "outer": ring})
    <tehl.Bearing 6206: p_H 2.00 GPa inner, 2.00 GPa outer, b>
    """

    folder: Path
    record: dict

    @classmethod
    def open(cls, folder):
        """The bearing in a folder. Raises StoreError."""
        file = Path(folder) / FILE
        try:
            record = files.json_of(file)
            found = cls(Path(folder), {**record, "name": str(record["name"]), "geometry": dict(record["geometry"])})
            bearing_table.csv_text(found)
            return found
        except OSError as error:
            raise StoreError(f"cannot read {file}: {error.strerror or error}") from None
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
            raise StoreError(f"{file} is damaged ({type(error).__name__}: {error}); repeat the tehl bearing command to write "
                             "it again") from None

    @property
    def name(self) -> str:
        return self.record["name"]

    @property
    def rings(self) -> dict:
        """{"inner", "outer": record of its contact, with its summary}."""
        return {ring: self.record[ring] for ring in RINGS}

    @property
    def failed(self) -> dict:
        """{ring: reason} of those that ran and have no result."""
        return {ring: one["reason"] for ring, one in self.rings.items() if one["summary"] is None and one["reason"]}

    @property
    def title(self) -> str:
        """The bearing in a line."""
        one = self.record["geometry"]
        axial = f", {one['axial']:g} N axial" if one["axial"] else ""
        return f"{self.name}: {one['load']:g} N radial{axial}, {one['speed']:g} 1/min, {self.record['oil']} at " \
               f"{self.record['temperature_C']:g} deg C"

    def with_ring(self, ring, outcome):
        """A copy with the outcome of the run of a ring."""
        done = {**self.record[ring], "converged": outcome.summary is not None, "reason": outcome.reason,
                "summary": outcome.summary}
        return Bearing(self.folder, {**self.record, ring: done})

    def to_dict(self) -> dict:
        """The JSON object of `tehl bearing --json`, in SI units."""
        return self.record

    def write(self) -> list:
        """bearing.json and bearing.csv into the folder; returns their paths. Raises StoreError."""
        paths = self.folder / FILE, self.folder / TABLE
        texts = json.dumps(self.record, indent=1, allow_nan=False), bearing_table.csv_text(self)
        with files.blamed(self.folder, "cannot write to"):
            self.folder.mkdir(parents=True, exist_ok=True)
            for path, text in zip(paths, texts):
                files.replace(path, text.encode())
        return list(paths)

    def plot(self, path: str | PathLike | None = None, dpi: int = 160, format: str = "png", width: float = 17.0,
             force: bool = False) -> Path:
        """The figure (default: bearing.png in the folder, or bearing.pdf, bearing.svg); returns its path.

        dpi, format (where the path has no suffix), width, force: as :meth:`Run.plot`. Raises SceneError, or StoreError without
        matplotlib, or where something is in the way.
        """
        from tehl_taichi.runs.bearing import bearing_figure
        from tehl_taichi.view.figures.figure_style import FigureStyle

        return bearing_figure.write(self, path or self.folder / "bearing", FigureStyle(format, dpi, width, force))

    def __repr__(self):
        pressures = ", ".join(f"{one['p_Hertz_Pa'] / 1e9:.2f} GPa {ring}" for ring, one in self.rings.items())
        return f"<tehl.Bearing {self.name}: p_H {pressures}, {self.folder}>"


def check_writable(folder):
    """Raises StoreError where no bearing can be made in `folder`, nor one in it be resumed."""
    user_files.check_outside(folder)
    if not os.path.lexists(folder):
        return
    links.refuse(folder)
    if is_bearing(folder):
        Bearing.open(folder)
        files.tidy(folder)
    elif any(Path(folder).iterdir()):
        raise StoreError(f"{folder} exists and is not the folder of a bearing; choose another --out")


def is_bearing(path):
    """Whether the results of a bearing lie in the folder `path`."""
    return (Path(path) / FILE).is_file()
