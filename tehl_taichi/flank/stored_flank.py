"""A flank as its folder keeps it, read again from flank.json: nothing is run, nothing is checked against the gears."""

import json
from dataclasses import dataclass
from pathlib import Path

from tehl_taichi.errors import StoreError
from tehl_taichi.flank.positions import Position

FILE = "flank.json"


@dataclass(frozen=True)
class StoredFlank:
    """folder: where it lies; told: the JSON object of `tehl flank --json`."""

    folder: Path
    told: dict

    @property
    def rows(self):
        """(position, Hertz pressure in Pa, summary or None) of every position, as :attr:`whole_flank.Flank.rows`."""
        return [(_position(one), one["p_Hertz_Pa"], one["summary"]) for one in self.told["positions"]]

    @property
    def failed(self):
        """(position, reason) of those that did not converge."""
        return [(_position(one), one["reason"]) for one in self.told["positions"] if one["summary"] is None]

    @property
    def points(self):
        """{letter A to E: x_pl in m}; {} of a table."""
        return self.told["geometry"].get("points_x_pl_m", {})


def is_flank(path):
    """Whether the results of a flank lie in the folder `path`."""
    return (Path(path) / FILE).is_file()


def open_flank(path):
    """The :class:`StoredFlank` in the folder `path`. Raises StoreError."""
    file = Path(path) / FILE
    try:
        told = json.loads(file.read_text(encoding="utf-8"))
        found = StoredFlank(Path(path), {**told, "name": str(told["name"]), "geometry": dict(told["geometry"])})
        found.rows  # noqa: B018  whatever is missing is missing now
        return found
    except OSError as error:
        raise StoreError(f"cannot read {file}: {error.strerror or error}") from None
    except (ValueError, KeyError, TypeError) as error:
        raise StoreError(f"{file} is damaged ({type(error).__name__}: {error}); the same tehl flank writes it again") from None


def _position(one):
    u_m = 0.5 * (one["u_a_m_s"] + one["u_b_m_s"])
    return Position(one["x_pl_m"], one["rho_a_m"], one["rho_b_m"], one["u_a_m_s"], one["u_b_m_s"], one["load_N_m"],
                    one["srr"] * u_m, one["arc_m"], one["point"])
