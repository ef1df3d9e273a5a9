"""Numeric options, with or without a unit."""

import math
from typing import Any

import typer

from tehl_taichi.errors import SceneError

NONE_AT_0 = ("bending_limit", "torsion_limit", "inclusion")  # 0 in a scene: not given
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


def metres(option, value, low=-math.inf):
    """Length in m, more than `low`, of an option without a scene key; 0 if the option is not used. Raises SceneError."""
    from tehl_taichi.values import checks, units

    if value is None:
        return 0.0
    found = units.in_unit(option, value, "m")
    checks.number(option, found, "m", low, strict=True)
    return found


def refuse_zeros(options):
    """Refuse options {name: value} with 0 that could mean "not given" only. Raises SceneError."""
    from tehl_taichi.values import units

    for name in NONE_AT_0:
        digits = units.split(str(options.get(name)))
        if digits and float(digits[0]) == 0:
            raise SceneError(f"--{name.replace('_', '-')} {f'0 {digits[1]}'.strip()} is out of range; allowed: more than 0")


def number(about, default=None) -> Any:
    """Option for a number, with or without a unit; about: its help; default: value without the option."""
    return typer.Option(default, parser=amount, metavar="NUMBER", help=about)


def also_number(about) -> Any:
    """Such an option without a default here: the function's default applies."""
    return typer.Option(parser=amount, metavar="NUMBER", help=about)
