"""Angles of a cycle from a CSV table: load per length, radii, and speeds of both surfaces relative to the contact."""

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.flank import table_text
from tehl_taichi.values.quantity import Number

RADIUS, SPEED = Number("", "mm", 0.1, 1e6, infinite=True, usual=20.0), Number("", "m/s", -1e3, 1e3, usual=5.0)
# column: (factor to SI, its declaration)
ALWAYS = {"angle_deg": (1.0, Number("", "deg", -720.0, 720.0)),
          "load_N_per_mm": (1e3, Number("", "N/mm", 0.0, 1e5, usual=100.0)), "u_a_m_s": (1.0, SPEED), "u_b_m_s": (1.0, SPEED)}
REDUCED, BOTH = {"R_mm": (1e-3, RADIUS)}, {"R_a_mm": (1e-3, RADIUS), "R_b_mm": (1e-3, RADIUS)}
KNOWN = (*ALWAYS, *REDUCED, *BOTH)
MOST = 1000  # rows
SLOWEST = 1e-6  # m/s, of an entrainment speed
OPPOSED = 2.0  # slide-roll ratio beyond which the surfaces move against each other


@dataclass(frozen=True)
class CamPosition:
    """One angle in SI. angle (deg); R: reduced radius (m); load (N/m); u_a, u_b: surface speeds of cam and follower relative to
    the contact (m/s); more: further columns of the table.
    """

    angle: float
    R: float
    load: float
    u_a: float
    u_b: float
    more: dict = field(default_factory=dict)

    point, bulk = "", None
    film_ratios: ClassVar[dict] = {}

    @property
    def words(self):
        """Text with the angle."""
        return f"{self.angle:g} deg"

    short = full = words

    @property
    def u_m(self):
        """Entrainment speed; a contact that moves in the opposite direction is a mirror image."""
        return 0.5 * abs(self.u_a + self.u_b)

    @property
    def srr(self):
        total = 0.5 * (self.u_a + self.u_b)
        return (self.u_a - self.u_b) / total if total else math.inf

    @property
    def without_film(self):
        """Reason why there is no steady film at this angle; "" if there is one."""
        if self.load == 0:
            return "no load"
        if self.u_m < SLOWEST:
            return f"entrainment speed {self.u_m:.2g} m/s: only squeezing keeps a film here, which is not computed"
        if abs(self.srr) > OPPOSED:
            return f"the surfaces move against each other (SRR {self.srr:.3g}); allowed: -{OPPOSED:g} to {OPPOSED:g}"
        return ""


def load(path):
    """Read the :class:`CamPosition` of every row of a CSV file, sorted by angle. Raises SceneError."""
    path = Path(path)
    names, rows = table_text.rows(path)
    columns = _columns(path, names)
    found = [_position(path, n, row, columns) for n, row in enumerate(rows, 2)]
    if not 1 <= len(found) <= MOST:
        raise SceneError(f"table {path} has {len(found)} rows; allowed: 1 to {MOST}")
    _check_angles(path, [at.angle for at in found])
    return sorted(found, key=lambda at: at.angle)


def _check_angles(path, angles):
    """Refuse an angle with two rows: a cycle has one contact at each angle. Raises SceneError."""
    rows = {angle: n for n, angle in reversed([*enumerate(angles, 2)])}  # the first row of each
    for n, angle in enumerate(angles, 2):
        if rows[angle] != n:
            raise SceneError(f"table {path}, rows {rows[angle]} and {n}: both have the angle {angle:g} deg; allowed: one row "
                             "for each angle")


def _columns(path, names):
    """{column: (factor, declaration)} of the table; it has either reduced radii or those of both surfaces. Raises
    SceneError.
    """
    if (own := [name for name in BOTH if name in names]) and "R_mm" in names:
        raise SceneError(f"table {path} has the columns R_mm and {own[0]}; allowed: the reduced radius R_mm, or R_a_mm and "
                         "R_b_mm")
    radii = REDUCED if "R_mm" in names else BOTH
    table_text.check_names(path, names, (*ALWAYS, *radii), f"{', '.join(ALWAYS)}, and R_mm or R_a_mm and R_b_mm", "`tehl cam`")
    return {**ALWAYS, **radii}


def _position(path, n, row, columns):
    SI = {name: declared.read(f"table {path}, row {n}: {name}", row.get(name)) * factor
          for name, (factor, declared) in columns.items()}
    R = SI.get("R_mm") or 1 / (1 / SI["R_a_mm"] + 1 / SI["R_b_mm"] or math.inf)
    if not 0 < R < math.inf:
        raise SceneError(f"table {path}, row {n}: a reduced radius of {R:g} m makes no contact; allowed: one curved surface at "
                         "least")
    more = {name: value for name, value in row.items() if name and name not in KNOWN}
    return CamPosition(SI["angle_deg"], R, SI["load_N_per_mm"], SI["u_a_m_s"], SI["u_b_m_s"], more)
