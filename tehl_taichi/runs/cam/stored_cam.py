"""A cam as its folder keeps it: the angles with their summaries, the table, the figure."""

import json
import os
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from tehl_taichi.disk import files, links, user_files
from tehl_taichi.errors import StoreError
from tehl_taichi.runs.cam import cam_columns
from tehl_taichi.runs.cam.cam_table import CamPosition

FILE, TABLE = "cam.json", "cam.csv"
# of an angle in cam.json; other keys came with the table
KEYS = {"angle_deg", "R_m", "load_N_m", "u_a_m_s", "u_b_m_s", "u_m_m_s", "srr", "p_Hertz_Pa", "store", "converged", "reason",
        "summary"}


@dataclass(frozen=True)
class Cam:
    """Results over the cycle of a cam: :func:`tehl_taichi.cam` and :func:`tehl_taichi.open` give one.

    Attributes
    ----------
    folder : pathlib.Path
        Its folder.
    record : dict
        The JSON object of `tehl cam --json`.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Cam("c", {"name": "mine", "positions": []})
    <tehl.Cam mine: 0 of 0 angles, c>
    """

    folder: Path
    record: dict

    @classmethod
    def open(cls, folder):
        """The cam in a folder. Raises StoreError."""
        file = Path(folder) / FILE
        try:
            record = files.json_of(file)
            found = cls(Path(folder), {**record, "name": str(record["name"])})
            cam_columns.csv_text(found.rows)
            return found
        except OSError as error:
            raise StoreError(f"cannot read {file}: {error.strerror or error}") from None
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
            raise StoreError(f"{file} is damaged ({type(error).__name__}: {error}); repeat the tehl cam command to write it "
                             "again") from None

    @property
    def name(self) -> str:
        return self.record["name"]

    @property
    def rows(self) -> list:
        """(position, Hertz pressure in Pa, summary or None) of every angle."""
        return [(_position(one), one["p_Hertz_Pa"], one["summary"]) for one in self.record["positions"]]

    @property
    def failed(self) -> list:
        """(position, reason) of the angles without a result."""
        return [(_position(one), one["reason"]) for one in self.record["positions"] if one["summary"] is None]

    @property
    def not_converged(self) -> list:
        """Entries of :attr:`failed` whose run did not converge."""
        return [(at, reason) for at, reason in self.failed if not at.without_film]

    @property
    def title(self) -> str:
        """The cam in a line."""
        return f"{self.name}: {len(self.rows)} angles, {self.record['oil']} at {self.record['temperature_C']:g} deg C"

    def with_position(self, number, outcome):
        """A copy with the outcome of an angle."""
        positions = list(self.record["positions"])
        positions[number] = {**positions[number], "converged": outcome.summary is not None, "reason": outcome.reason,
                             "summary": outcome.summary}
        return Cam(self.folder, {**self.record, "positions": positions})

    def to_dict(self) -> dict:
        """The JSON object of `tehl cam --json`, in SI units."""
        return self.record

    def write(self) -> list:
        """cam.json and cam.csv into the folder; returns their paths. Raises StoreError."""
        paths = self.folder / FILE, self.folder / TABLE
        texts = json.dumps(self.record, indent=1, allow_nan=False), cam_columns.csv_text(self.rows)
        with files.blamed(self.folder, "cannot write to"):
            self.folder.mkdir(parents=True, exist_ok=True)
            for path, text in zip(paths, texts):
                files.replace(path, text.encode())
        return list(paths)

    def plot(self, path: str | PathLike | None = None, dpi: int = 160, format: str = "png", width: float = 17.0,
             force: bool = False) -> Path:
        """The figure (default: cam.png in the folder, or cam.pdf, cam.svg); returns its path.

        dpi, format (where the path has no suffix), width, force: as :meth:`Run.plot`. Raises SceneError, or StoreError without
        matplotlib, or where something is in the way.
        """
        from tehl_taichi.runs.cam import cam_figure
        from tehl_taichi.view.figures.figure_style import FigureStyle

        return cam_figure.write(self, path or self.folder / "cam", FigureStyle(format, dpi, width, force))

    def __repr__(self):
        count = len(self.record["positions"])
        return f"<tehl.Cam {self.name}: {count - len(self.failed)} of {count} angles, {self.folder}>"


def check_writable(folder):
    """Raises StoreError where no cam can be made in `folder`, nor one in it be resumed."""
    user_files.check_outside(folder)
    if not os.path.lexists(folder):
        return
    links.refuse(folder)
    if is_cam(folder):
        Cam.open(folder)
        files.tidy(folder)
    elif any(Path(folder).iterdir()):
        raise StoreError(f"{folder} exists and is not the folder of a cam; choose another --out")


def is_cam(path):
    """Whether the results of a cam lie in the folder `path`."""
    return (Path(path) / FILE).is_file()


def _position(one):
    more = {key: value for key, value in one.items() if key not in KEYS}
    return CamPosition(one["angle_deg"], one["R_m"], one["load_N_m"], one["u_a_m_s"], one["u_b_m_s"], more)
