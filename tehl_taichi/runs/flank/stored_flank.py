"""A flank as its folder keeps it: the positions with their summaries, the table, the figure."""

import json
import os
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from tehl_taichi.disk import files, links, user_files
from tehl_taichi.errors import StoreError
from tehl_taichi.runs.flank import flank_columns
from tehl_taichi.runs.flank.positions import Position

FILE, TABLE = "flank.json", "flank.csv"
# of a position in flank.json; what else stands there came with a table of positions
KEYS = {"point", "x_pl_m", "arc_m", "rho_a_m", "rho_b_m", "R_m", "u_a_m_s", "u_b_m_s", "srr", "load_N_m", "p_Hertz_Pa", "store",
        "converged", "reason", "summary"}


@dataclass(frozen=True)
class Flank:
    """Results along a gear flank: :func:`tehl_taichi.flank` and :func:`tehl_taichi.open` give one.

    Attributes
    ----------
    folder : pathlib.Path
        Its folder.
    record : dict
        The JSON object of `tehl flank --json`.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Flank("f", {"name": "mine", "geometry": {}, "positions": []})
    <tehl.Flank mine: 0 of 0 positions, f>
    """

    folder: Path
    record: dict

    @classmethod
    def open(cls, folder):
        """The flank in a folder. Raises StoreError."""
        file = Path(folder) / FILE
        try:
            record = files.json_of(file)
            found = cls(Path(folder), {**record, "name": str(record["name"]), "geometry": dict(record["geometry"])})
            found.rows  # noqa: B018  whatever is missing is missing now
            return found
        except OSError as error:
            raise StoreError(f"cannot read {file}: {error.strerror or error}") from None
        except (ValueError, KeyError, TypeError, RecursionError) as error:
            raise StoreError(f"{file} is damaged ({type(error).__name__}: {error}); repeat the tehl flank command to write it "
                             "again") \
                from None

    @property
    def name(self) -> str:
        return self.record["name"]

    @property
    def positions(self) -> list:
        """The :class:`tehl_taichi.runs.flank.positions.Position` of each."""
        return [_position(one) for one in self.record["positions"]]

    @property
    def rows(self) -> list:
        """(position, Hertz pressure in Pa, summary or None) of every position."""
        return [(_position(one), one["p_Hertz_Pa"], one["summary"]) for one in self.record["positions"]]

    @property
    def failed(self) -> list:
        """(position, reason) of those without a result."""
        return [(_position(one), one["reason"]) for one in self.record["positions"] if one["summary"] is None]

    @property
    def points(self) -> dict:
        """{letter A to E: x_pl in m} on this flank; {} of a table."""
        return self.record["geometry"].get("points_x_pl_m", {})

    @property
    def title(self) -> str:
        """The flank in a line."""
        pair = self.record["geometry"]
        if "torque" not in pair:
            return f"{self.name}: flank of body a"
        return f"{self.name}: flank of the {pair['on']}, {pair['torque']:g} N m and {pair['n1']:g} 1/min at the pinion"

    def to_dict(self) -> dict:
        """The JSON object of `tehl flank --json`, in SI units."""
        return self.record

    def write(self) -> list:
        """flank.json and flank.csv into the folder; returns their paths. Raises StoreError."""
        paths = self.folder / FILE, self.folder / TABLE
        texts = json.dumps(self.record, indent=1, allow_nan=False), flank_columns.csv_text(self.rows)
        with files.blamed(self.folder, "cannot write to"):
            self.folder.mkdir(parents=True, exist_ok=True)  # where no position converged there are no stores
            for path, text in zip(paths, texts):
                files.replace(path, text.encode())
        return list(paths)

    def plot(self, path: str | PathLike | None = None, dpi: int = 160, format: str = "png", width: float = 17.0,
             force: bool = False) -> Path:
        """The figure (default: flank.png in the folder, or flank.pdf, flank.svg); returns its path.

        dpi, format (where the path has no suffix), width, force: as :meth:`Run.plot`. Raises SceneError, or
        StoreError without matplotlib, or where something is in the way.
        """
        from tehl_taichi.runs.flank import flank_figure
        from tehl_taichi.view.figures.figure_style import FigureStyle

        return flank_figure.write(self, path or self.folder / "flank", FigureStyle(format, dpi, width, force))

    def __repr__(self):
        done = len(self.record["positions"]) - len(self.failed)
        return f"<tehl.Flank {self.name}: {done} of {len(self.record['positions'])} positions, {self.folder}>"


def check_writable(folder):
    """Raises StoreError where no flank can be made in `folder`, nor one in it be resumed."""
    user_files.check_outside(folder)
    if not os.path.lexists(folder):
        return
    links.refuse(folder)
    if is_flank(folder):
        Flank.open(folder)
        files.tidy(folder)
    elif (table := folder / TABLE).exists():
        raise StoreError(f"{table} exists and is not a table of a flank; choose another --out")


def is_flank(path):
    """Whether the results of a flank lie in the folder `path`."""
    return (Path(path) / FILE).is_file()


def _position(one):
    u_m = 0.5 * (one["u_a_m_s"] + one["u_b_m_s"])
    more = {key: value for key, value in one.items() if key not in KEYS}
    return Position(one["x_pl_m"], one["rho_a_m"], one["rho_b_m"], one["u_a_m_s"], one["u_b_m_s"], one["load_N_m"],
                    one["srr"] * u_m, one["arc_m"], one["point"], more)
