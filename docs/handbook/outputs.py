"""Outputs of every step in a store, from the entries of `march/outputs`."""

from handbook.tables import code, plain, table
from tehl_taichi.march.step_output import Field, Scalar, always, entries


def text():
    """Fields, then numbers."""
    return f"## Fields of a step\n\n{fields()}\n\n## Numbers of a step\n\n{scalars()}"


def fields():
    rows = ((code(one.name), one.unit, plain(one.says), ", ".join(("time", *one.dims)), _where(one), plain(one.source))
            for one in entries(Field).values())
    return table(("name", "unit", "meaning", "dimensions", "scenes", "from"), rows)


def scalars():
    rows = ((code(one.name), one.unit, plain(one.says), one.over, _where(one), plain(one.source))
            for one in entries(Scalar).values())
    return table(("name", "unit", "meaning", "of several steps", "scenes", "from"), rows)


def _where(one):
    """Which scenes have it, as the function that decides says it."""
    return "all" if one.exists is always else plain((one.exists.__doc__ or "").strip().rstrip("."))
