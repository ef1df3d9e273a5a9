"""Entries of the laws of the lubricant: a function, the numbers that it takes, and their range."""

import dataclasses
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import SimpleNamespace

from tehl_taichi.values.registry import Entry

SPARE = 0.3  # least factor of a density or a heat capacity that a law may leave


def _nothing(oil, Gamma, p):
    return ""


@dataclass(frozen=True, kw_only=True)
class Law(Entry):
    """numbers: {key: declaration} of the values that the law takes from a scene (see :mod:`tehl_taichi.values.quantity`);
    most_p (Pa), most_Gamma (deg C): up to where it was measured or is known to hold.

    refused, doubted(oil, Gamma, p): the reason (or "") why the law has no value, or is doubtful, in a contact of inlet
    temperature Gamma and Hertz pressure p.
    """

    numbers: Mapping
    most_p: float = math.inf
    most_Gamma: float = math.inf
    refused: Callable = _nothing
    doubted: Callable = _nothing

    def having(self, **changes):
        """Numbers of the law for its functions: the defaults with these changes."""
        return SimpleNamespace(**{**{key: declared.default for key, declared in self.numbers.items()}, **changes})


@dataclass(frozen=True, kw_only=True)
class ShearLaw(Law):
    """stress(rheology, newtonian, p): the stress (Pa) that a film carries for the Newtonian stress eta * (shear rate); odd in
    it, and equal to it where it is small. thins: whether it ever differs from the Newtonian stress.

    Flow of a film of one viscosity under a pressure gradient along the sliding; wall = h |grad p|/2 >= 0 is the stress of the
    gradient on both walls, newtonian >= 0 the Newtonian stress of the sliding:

    flow(rheology, wall, newtonian, p): flow over that of Newtonian oil, and its derivatives by ln wall, ln newtonian and p.
    beyond: stress and derivatives of the part on top, which is too steep in `wall` for Newton's method; power: of the wall that
    what is carried then grows with. mean_stress: in the middle of the film. slip: part of the sliding that the oil slips along
    a wall. limit(rheology, p): largest stress of a wall.

    None: derived from the stress alone, by the circular law with an equal tangent (:mod:`tehl_taichi.laws.tangent_circle`),
    or without effect.
    """

    stress: Callable
    flow: Callable | None = None
    beyond: Callable | None = None
    mean_stress: Callable | None = None
    slip: Callable | None = None
    limit: Callable | None = None
    power: float = 1.0
    thins: bool = True


@dataclass(frozen=True, kw_only=True)
class ViscosityLaw(Law):
    """ln_eta(oil, p, Gamma): ln of the viscosity (Pa s) at p (Pa) and Gamma (deg C).

    Where it takes long to find what of it depends on the temperature alone: parts, functions (oil, Gamma) of these, and
    of_parts(oil, p, *values) with the law from them; a film keeps them while its pressure changes.

    usual: numbers whose default is good for most oils; a new oil must bring the others. thinned_by: numbers without which (all
    0) the temperature does nothing, () where it never does, None where it always does.
    """

    ln_eta: Callable
    parts: tuple = ()
    of_parts: Callable | None = None
    usual: tuple = ()
    thinned_by: tuple | None = None

    @property
    def needed(self):
        """Names of the numbers that a new oil must bring."""
        return tuple(key for key in self.numbers if key not in self.usual)


@dataclass(frozen=True, kw_only=True)
class DensityLaw(Law):
    """Density over rho_0, that at p = 0 and 40 deg C: compression(oil, p) at 40 deg C, times expansion(oil, p, Gamma).

    expansivity(oil, p, Gamma): -(1/rho) d rho/d Gamma, 1/K.
    """

    compression: Callable
    expansion: Callable
    expansivity: Callable


def beyond(laws, p, Gamma):
    """{limit as text: its value} of the measured ranges that a film of p (Pa) and Gamma (deg C) exceeds."""
    found = {}
    for unit, reached, limit in (("Pa", p, "most_p"), ("degC", Gamma, "most_Gamma")):
        passed = {law.name: getattr(law, limit) for law in laws.values() if reached > getattr(law, limit)}
        if passed:
            found[f"{' and '.join(passed)} measured up to {unit}"] = min(passed.values())
    return found


def declared(laws):
    """{key: declaration} of the numbers of all laws of a registry, in front of the meaning the laws that take it.

    Raises ValueError when two laws declare one key differently.
    """
    out = {}
    for law in laws.values():
        for key, one in law.numbers.items():
            if out.setdefault(key, one) is not one:
                raise ValueError(f"{key} is declared twice, also by the law {law.name!r}; laws must share one declaration")
    return {key: _with_users(one, [law.name for law in laws.values() if key in law.numbers]) for key, one in out.items()}


def _with_users(one, names):
    kind = one.metadata["kind"]
    return dataclasses.field(default=one.default, metadata={"kind": dataclasses.replace(
        kind, about=f"{', '.join(names)}: {kind.about}")})


def section(name, /, **fields):
    """A frozen dataclass of these declarations, to derive a section of a scene from."""
    return dataclasses.make_dataclass(name, [(key, _type(one.default), one) for key, one in fields.items()], frozen=True)


def _type(default):
    return float if type(default) is int else type(default)
