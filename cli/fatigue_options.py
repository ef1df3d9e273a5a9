"""Options of every command that searches the fatigue of a run again."""

import functools
from typing import Annotated, Optional

import typer
from tehl_cli import usual_options as usual
from tehl_cli.amount import also_number, amount, metres, refuse_zeros
from tehl_cli.shared_options import sharing

from tehl_taichi.errors import SceneError
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.laws.hardness import RELATIONS


def _options(
    kappa: usual.Kappa = None, endurance: usual.Endurance = None,
    bending_limit: usual.BendingLimit = None, torsion_limit: usual.TorsionLimit = None,
    criterion: Annotated[Optional[str], typer.Option(help="criterion: " + ", ".join(CRITERIA))] = None,
    table: Annotated[Optional[str], typer.Option(help="strength over depth: a CSV file or a built-in table such as "
                                                      "case-hardened ('': none)")] = None,
    table_b: Annotated[Optional[str], typer.Option(help="table of body b, if different; none: no table")] = None,
    relation: Annotated[Optional[str], typer.Option(help="fatigue limit by the hardness of a table: "
                                                         + ", ".join(RELATIONS))] = None,
    inclusion: Annotated[Optional[float], also_number("root of the area of the largest inclusion, m, for the relation "
                                                      "murakami")] = None,
    exponent: Annotated[Optional[float], typer.Option(help="exponent of the S-N curve, for the number of passages to "
                                                           "initiation (0: none)")] = None,
    limit_cycles: Annotated[Optional[float], typer.Option(help="number of passages at the fatigue limit")] = None,
    weibull: Annotated[Optional[float], typer.Option(help="Weibull exponent of the strength, for the stressed volume (0: "
                                                          "none)")] = None,
    depths: Annotated[Optional[str], typer.Option(help="depths to search: auto (critical depth under the feature), none, or a "
                                                       "list in m for all points, for example 50e-6,100um")] = None,
    surfaces: Annotated[Optional[str], typer.Option(help="bodies to search: both, a or b")] = None,
    from_x: Annotated[Optional[float], also_number("use only moments with the feature after this position, in half-widths "
                                                   "a")] = None,
    to_x: Annotated[Optional[float], also_number("use only moments with the feature before this position, in half-widths "
                                                 "a")] = None,
    thermal_stress: Annotated[Optional[bool], typer.Option("--thermal-stress/--no-thermal-stress", help="include thermal "
                                                                                                        "stress (default: if "
                                                                                                        "temperatures were "
                                                                                                        "computed)")] = None,
    length: Annotated[Optional[float], also_number("length over which stresses are averaged for a second index, m (0: "
                                                   "none)")] = None,
    residual_xx: Annotated[Optional[float], also_number("constant residual stress along x, Pa")] = None,
    residual_yy: Annotated[Optional[float], also_number("constant residual stress along y, Pa")] = None,
):
    """Options as parameters for typer."""


def with_fatigue_options(command):
    """Decorator: the command gets these options in place of its `**constants`, as :func:`tehl_taichi.fatigue` takes them; None
    if not given.
    """
    @functools.wraps(command)
    def with_depths(*first, depths, **given):
        refuse_zeros(given)
        return command(*first, **given, depths=_depths(depths))

    return sharing(1, _options)(with_depths)


def _depths(text):
    if text in (None, "auto", "none"):
        return [] if text == "none" else text
    try:
        return [metres("--depths", amount(part)) for part in text.split(",")]
    except SceneError as error:
        raise SceneError(f"{error}; allowed: auto, none, or depths such as 50e-6,100um") from None
