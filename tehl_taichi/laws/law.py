"""Entry types of the lubricant's laws: a function, its numbers, and their range."""

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
    """A law. numbers: {key: declaration} of its values in a scene (see :mod:`tehl_taichi.values.quantity`); most_p (Pa),
    most_Gamma (deg C): limits of the measured or known range.

    refused, doubted(oil, Gamma, p): reason (or "") why the law has no value, or is doubtful, in a contact with inlet
    temperature Gamma and Hertz pressure p.
    """

    numbers: Mapping
    most_p: float = math.inf
    most_Gamma: float = math.inf
    refused: Callable = _nothing
    doubted: Callable = _nothing

    def having(self, **changes):
        """Numbers of the law for its functions: defaults with these changes."""
        return SimpleNamespace(**{**{key: declared.default for key, declared in self.numbers.items()}, **changes})


@dataclass(frozen=True, kw_only=True)
class ShearLaw(Law):
    """A shear law. stress(rheology, newtonian, p): stress (Pa) of a film for the Newtonian stress eta * (shear rate); odd in
    it, and equal to it for small stresses. thins: whether it ever differs from it.

    Flow of a film with one viscosity under a pressure gradient along the sliding; wall = h |grad p|/2 >= 0 is the wall stress
    by the gradient, newtonian >= 0 the Newtonian stress of the sliding:

    flow(rheology, wall, newtonian, p): flow relative to Newtonian oil, and its derivatives by ln wall, ln newtonian and p.
    beyond: an additional part and its derivatives, too steep in `wall` for Newton's method; power: exponent of `wall` in it.
    mean_stress: in the middle of the film. slip: part of the sliding that is slip along a wall. limit(rheology, p): largest
    wall stress.

    None: derived from the stress alone, by the circular law with an equal tangent (:mod:`tehl_taichi.laws.tangent_circle`), or
    without effect.
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
    """A viscosity law. ln_eta(oil, p, Gamma): ln of the viscosity (Pa s) at p (Pa) and Gamma (deg C).

    Optional, if terms of the temperature alone are expensive: parts, functions (oil, Gamma) of these terms, and of_parts(oil,
    p, *values), the law from their values; a film keeps the values while its pressure changes.

    usual: numbers whose default suits most oils; a new oil must give the others. thinned_by: numbers without which (all 0) the
    temperature has no effect; () if it never has, None if it always has.
    """

    ln_eta: Callable
    parts: tuple = ()
    of_parts: Callable | None = None
    usual: tuple = ()
    thinned_by: tuple | None = None

    @property
    def needed(self):
        """Names of the numbers that a new oil must give."""
        return tuple(key for key in self.numbers if key not in self.usual)


@dataclass(frozen=True, kw_only=True)
class DensityLaw(Law):
    """A density law. Density over rho_0 (at p = 0 and 40 deg C): compression(oil, p) at 40 deg C times expansion(oil, p,
    Gamma).

    expansivity(oil, p, Gamma): -(1/rho) d rho/d Gamma, 1/K.
    """

    compression: Callable
    expansion: Callable
    expansivity: Callable


def beyond(laws, p, Gamma):
    """{limit as text: its value} of the measured ranges that a film at p (Pa) and Gamma (deg C) exceeds."""
    found = {}
    for unit, reached, limit in (("Pa", p, "most_p"), ("degC", Gamma, "most_Gamma")):
        passed = {law.name: getattr(law, limit) for law in laws.values() if reached > getattr(law, limit)}
        if passed:
            found[f"{' and '.join(passed)} measured up to {unit}"] = min(passed.values())
    return found


def declared(laws):
    """{key: declaration} of the numbers of all laws of a registry; each meaning begins with the names of its laws.

    Raises ValueError if two laws declare one key differently.
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
    """A frozen dataclass of these declarations, as the base of a section of a scene."""
    return dataclasses.make_dataclass(name, [(key, _type(one.default), one) for key, one in fields.items()], frozen=True)


def _type(default):
    return float if type(default) is int else type(default)
