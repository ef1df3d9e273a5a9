"""Table columns of a cam: contact at each angle, and results as along a flank."""

from tehl_taichi.runs.flank import flank_columns
from tehl_taichi.runs.flank.flank_columns import CONTACT
from tehl_taichi.runs.table_column import TableColumn

COLUMNS = (
    TableColumn("angle_deg", "angle deg", 1, ".2f", lambda at, *_: at.angle, CONTACT),
    TableColumn("R_m", "R' mm", 1e3, ".3f", lambda at, *_: at.R, CONTACT),
    TableColumn("u_m_m_s", "u_m m/s", 1, ".3f", lambda at, *_: at.u_m, CONTACT),
    TableColumn("srr", "SRR", 1, ".3f", lambda at, p_H, _: at.srr if p_H else None, CONTACT),
    TableColumn("load_N_m", "N/mm", 1e-3, ".1f", lambda at, *_: at.load, CONTACT),
    TableColumn("p_Hertz_Pa", "p_H GPa", 1e-9, ".3f", lambda at, p_H, _: p_H, CONTACT),
    *(column for column in flank_columns.COLUMNS if column.table != CONTACT))


def tables(rows):
    """{title: (heads, lines)}: see :func:`tehl_taichi.runs.flank.flank_columns.tables`."""
    return flank_columns.tables(rows, COLUMNS, places=1)


def csv_text(rows):
    """Table as CSV: see :func:`tehl_taichi.runs.flank.flank_columns.csv_text`."""
    return flank_columns.csv_text(rows, COLUMNS)
