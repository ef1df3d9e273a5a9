"""Names of the tables of a scene, and tables of values as changes of single keys."""

from tehl_taichi.scene import data_sheet
from tehl_taichi.scene.sections import SECTIONS

TABLES = (*SECTIONS, "bodies", "oil")
BODIES = ("bodies.a", "bodies.b")
NESTED = (*TABLES, *BODIES)


def as_changes(tables, above=""):
    """Generator of (full key, value) of the values in tables {key: value or table}; other keys of these tables keep their
    values. An oil or a body with its own name or data sheet is one value: it inherits no numbers.
    """
    for key, value in tables.items():
        if isinstance(value, dict) and above + key in NESTED and not _brings_its_numbers(above + key, value):
            yield from as_changes(value, f"{above}{key}.")
        else:
            yield above + key, value


def _brings_its_numbers(key, table):
    if key == "oil":
        return "name" in table or data_sheet.has_sheet(table)
    return key in BODIES and isinstance(table.get("material"), str) and table["material"] != ""
