"""A number that an option takes, bare or with a unit."""

from typing import Any

import typer

AUTO = "auto"  # as in tehl_taichi.values.quantity, which takes longer to import


def amount(text) -> Any:
    """The number of an option; text with a unit, as in "3.8 mm", stays text, which is read where the quantity is known."""
    try:
        return float(text)
    except ValueError:
        return text.strip()


def whole_or_auto(text) -> Any:
    """The factor of a zoom window: a whole number or "auto"; other text stays, which the scene refuses."""
    return int(text) if text.strip().isdigit() else text.strip()


def metres(option, value):
    """A length in m that no quantity of a scene declares; 0 where the option is not used. Raises SceneError."""
    from tehl_taichi.values import checks, units

    found = 0.0 if value is None else units.in_unit(option, value, "m")
    checks.number(option, found, "m")
    return found


def number(about, default=None) -> Any:
    """The option of a number, bare or with a unit; about: its help; default: where it is not used."""
    return typer.Option(default, parser=amount, metavar="NUMBER", help=about)


def also_number(about) -> Any:
    """Such an option whose function has the default."""
    return typer.Option(parser=amount, metavar="NUMBER", help=about)
