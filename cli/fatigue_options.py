"""The options of every command that asks a run about its fatigue again."""

import functools
import inspect
from typing import Annotated, Optional

import typer

from tehl_taichi.criteria import CRITERIA


def _asked(
    kappa: Annotated[Optional[float], typer.Option(help="sensitivity to normal stress")] = None,
    endurance: Annotated[Optional[float], typer.Option(help="sigma_eF, Pa")] = None,
    bending_limit: Annotated[Optional[float], typer.Option(help="fatigue limit in reversed bending, Pa, in "
                                                           "place of --endurance")] = None,
    torsion_limit: Annotated[Optional[float], typer.Option(help="the same in torsion; one limit and kappa give "
                                                           "sigma_eF, both kappa, too")] = None,
    criterion: Annotated[Optional[str], typer.Option(help=", ".join(CRITERIA))] = None,
    depths: Annotated[Optional[str], typer.Option(help="auto (the worst depth under the feature), none, or depths at which all "
                                                  "points are searched as well, m, as 50e-6,100e-6")] = None,
    from_x: Annotated[Optional[float], typer.Option(help="only moments with the feature beyond this position, a")] = None,
    to_x: Annotated[Optional[float], typer.Option(help="only moments with the feature before this position, a")] = None,
    thermal_stress: Annotated[Optional[bool], typer.Option("--thermal-stress/--no-thermal-stress", help="stress of the heat "
                                                           "(default: where there is heat)")] = None,
    residual_xx: Annotated[Optional[float], typer.Option(help="constant residual stress along x, Pa")] = None,
    residual_yy: Annotated[Optional[float], typer.Option(help="the same along y, Pa")] = None,
):
    """The options, as typer reads them."""


def asks(command):
    """The command with these options in place of its `**asked`: the constants that :func:`tehl_taichi.fatigue` takes, None
    where they are not given."""
    options = inspect.signature(_asked).parameters
    own = [one for one in inspect.signature(command).parameters.values() if one.kind != inspect.Parameter.VAR_KEYWORD]

    @functools.wraps(command)
    def asking(*first, **given):
        asked = {name: given.pop(name, None) for name in options}
        return command(*first, **given, **{**asked, "depths": _depths(asked["depths"])})

    named = [one.replace(kind=inspect.Parameter.KEYWORD_ONLY) for one in (own[0], *options.values(), *own[1:])]
    asking.__signature__ = inspect.Signature(named)
    asking.__annotations__ = {one.name: one.annotation for one in named}
    return asking


def _depths(text):
    from tehl_taichi.scene import SceneError

    if text in (None, "auto", "none"):
        return [] if text == "none" else text
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise SceneError(f"--depths {text!r} must be auto, none or numbers in m with commas between, as 50e-6,1e-4") from None
