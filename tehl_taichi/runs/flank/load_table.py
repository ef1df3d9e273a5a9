"""Positions from a CSV table of a loaded tooth contact analysis."""

from pathlib import Path

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.flank import table_text
from tehl_taichi.runs.flank.positions import Position
from tehl_taichi.values.quantity import Number
from tehl_taichi.values.unit_hints import hint

RADIUS, SPEED = Number("", "mm", 0.1, 1e6, usual=20.0), Number("", "m/s", 0.0, 1e3, usual=10.0)
# column: (factor to SI, its declaration)
NEEDED = {"x_pl_mm": (1e-3, Number("", "mm", -1e3, 1e3, usual=5.0)), "R_a_mm": (1e-3, RADIUS), "R_b_mm": (1e-3, RADIUS),
          "load_N_per_mm": (1e3, Number("", "N/mm", 1e-3, 1e5, usual=300.0)), "u_a_m_s": (1.0, SPEED), "u_b_m_s": (1.0, SPEED)}
SHORTEST = 0.02  # mm, of the farthest way of a flank
POINT = "point"  # column with A to E, where there is one
BULK = "bulk_C"  # column with the bulk temperature of the teeth
TEMPERATURE = Number("", "deg C", -50.0, 300.0, usual=90.0)
MOST = 1000  # rows


def load(path):
    """Read positions from a CSV file with the columns of NEEDED; dedendum of body a (x_pl < 0) first. Raises SceneError.

    A column `point` names positions, `bulk_C` is the bulk temperature; further columns are kept in `more`.
    """
    path = Path(path)
    names, rows = table_text.rows(path)
    _check_names(path, names)
    found = [_position(path, n, row) for n, row in enumerate(rows, 2)]
    if not 1 <= len(found) <= MOST:
        raise SceneError(f"table {path} has {len(found)} rows; allowed: 1 to {MOST}")
    _check_ways(path, found)
    return sorted(found, key=lambda p: p.x_pl)


def _check_ways(path, found):
    """Refuse distances that are tiny relative to any tooth: they were meant in another unit. Raises SceneError."""
    way = max(found, key=lambda p: abs(p.x_pl)).x_pl * 1e3
    if 0 < abs(way) < SHORTEST:
        raise SceneError(f"table {path}: x_pl_mm = {way:g} mm is the largest distance from the pitch point, too small for a "
                         f"tooth{hint(way, 'mm', lambda other: SHORTEST <= abs(other) <= 1e3, NEEDED['x_pl_mm'][1].usual)}")


def _check_names(path, names):
    """Refuse a table without a needed column, and a bulk temperature that would be kept as a further column. Raises
    SceneError.
    """
    if BULK not in names and (like := [name for name in names if name.lower().startswith("bulk")]):
        raise SceneError(f"table {path} has the column {like[0]!r}, which is no temperature with its unit; allowed: {BULK}, or "
                         "another unit as in bulk_K")
    table_text.check_names(path, names, NEEDED, ", ".join(NEEDED), "`tehl flank`")


def _position(path, n, row):
    SI = {name: declared.read(f"table {path}, row {n}: {name}", row.get(name)) * factor
          for name, (factor, declared) in NEEDED.items()}
    if SI["u_a_m_s"] + SI["u_b_m_s"] == 0:
        raise SceneError(f"table {path}, row {n}: u_a_m_s and u_b_m_s are both 0 m/s: without entrainment there is no film")
    more = {name: value for name, value in row.items() if name and name not in (*NEEDED, POINT, BULK)}
    bulk = TEMPERATURE.read(f"table {path}, row {n}: {BULK}", row[BULK]) if row.get(BULK) else None
    return Position(x_pl=SI["x_pl_mm"], rho_a=SI["R_a_mm"], rho_b=SI["R_b_mm"], u_a=SI["u_a_m_s"], u_b=SI["u_b_m_s"],
                    load=SI["load_N_per_mm"], slip=SI["u_a_m_s"] - SI["u_b_m_s"], point=(row.get(POINT) or "").strip(),
                    more=more, bulk=bulk)
