"""Numeric options, with or without a unit."""

from typing import Any

import typer

AUTO = "auto"  # as in tehl_taichi.values.quantity, which takes longer to import


def amount(text) -> Any:
    """Number of an option; a text with a unit, such as "3.8 mm", stays text and is converted where the quantity is known."""
    try:
        return float(text)
    except ValueError:
        return text.strip()


def whole_or_auto(text) -> Any:
    """Factor of a zoom window: a whole number or "auto"; the scene refuses other texts."""
    return int(text) if text.strip().isdigit() else text.strip()


def metres(option, value):
    """Length in m of an option without a scene key; 0 if the option is not used. Raises SceneError."""
    from tehl_taichi.values import checks, units

    found = 0.0 if value is None else units.in_unit(option, value, "m")
    checks.number(option, found, "m")
    return found


def number(about, default=None) -> Any:
    """Option for a number, with or without a unit; about: its help; default: value without the option."""
    return typer.Option(default, parser=amount, metavar="NUMBER", help=about)


def also_number(about) -> Any:
    """Such an option without a default here: the function's default applies."""
    return typer.Option(parser=amount, metavar="NUMBER", help=about)
