"""Lubricants: a law and its numbers, and the small library of named oils, each with its source."""

import dataclasses
import math
from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.physics import conduction, density, viscosity
from tehl_taichi.physics.law import declared, section
from tehl_taichi.values import checks
from tehl_taichi.values.checks import build, nearest
from tehl_taichi.values.quantity import check, choice, kinds, text

_OIL = section(
    "_OIL", name=text("reference-pao", "`tehl oils` lists the named ones"),
    source=text("PAO of Everitt, licentiate thesis 2018; density after Larsson et al. 2000", "origin of its numbers",
                one_line=False),
    viscosity=choice("roelands-temperature", "law of the viscosity", tuple(viscosity.LAWS)), **declared(viscosity.LAWS),
    density=choice("dowson-higginson", "law of the density", tuple(density.LAWS)),
    expansion=choice("thermal", "where the thermal factor of the density acts; thermal: only with the energy equation",
                     ("thermal", "always", "never")),
    **declared({**density.LAWS, **conduction.LAWS}))


@dataclass(frozen=True)
class Oil(_OIL):
    """A lubricant; each law has its own numbers, those of laws that it did not choose are not used.

    The laws and their numbers stand in tehl_taichi/physics: viscosities, densities and conduction.py.
    """

    def __post_init__(self):
        check(self, "oil")
        for key in self.law_numbers:
            if getattr(self, key) == ():
                raise kinds(Oil)[key].refusal(f"oil.{key}", ())

    @property
    def law_numbers(self):
        """Names of the numbers that its viscosity law takes."""
        return tuple(viscosity.LAWS[self.viscosity].numbers)

    @property
    def laws(self):
        """All laws that it obeys."""
        return viscosity.LAWS[self.viscosity], density.LAWS[self.density], *conduction.LAWS.values()

    @property
    def unused(self):
        """Names of the numbers that only laws take which it did not choose."""
        return set(declared({**viscosity.LAWS, **density.LAWS})) - {key for law in self.laws for key in law.numbers}


OILS = {
    "reference-pao": Oil(),
    "moes-test-fluid": Oil(
        name="moes-test-fluid", viscosity="roelands", eta0=0.04, alpha=2.2e-8, p_r=1.96e8, Z=0.668,
        source="test fluid of the multigrid literature (Venner & Lubrecht); Dowson-Higginson density",
        D1=0.34 / 5.9e8, D2=1 / 5.9e8, beta0=0.0, expansion="never"),
    "ridge-test-fluid": Oil(
        name="ridge-test-fluid", viscosity="roelands", eta0=1.22, alpha=2.2e-8, p_r=1.96e8,
        Z=2.2e-8 * 1.96e8 / (math.log(1.22) + 9.67),
        source="oil of the transverse ridge in a circular contact (Venner & Lubrecht 1994); Z from alpha, eta0, p_r",
        D1=0.34 / 5.9e8, D2=1 / 5.9e8, beta0=0.0, expansion="never"),
}


def oil(name):
    """The named oil; SceneError with the nearest name otherwise."""
    if name not in OILS:
        raise SceneError(f"unknown oil {name!r}{nearest(name, OILS)}; known: {', '.join(OILS)}")
    return OILS[name]


def from_values(values):
    """Oil from a table. The name of a known oil gives the values that are not named; a new name must bring the numbers of its
    viscosity law (see :func:`check_new`), the others are those of the reference oil."""
    if not isinstance(values, dict):
        return build(Oil, values, "oil")
    name = values.get("name", Oil.name)
    if isinstance(name, str) and name in OILS:
        return build(Oil, {**dataclasses.asdict(OILS[name]), **values}, "oil")
    check_new(name, values)
    return build(Oil, {"source": NO_SOURCE, **values}, "oil")


NO_SOURCE = "not given"


def check_new(name, given):
    """Refuse a name that no known oil has unless its viscosity law and the numbers of that law are given with it."""
    checks.text("oil.name", name, 100, empty=False)
    law = given.get("viscosity")
    needed = viscosity.LAWS[law].needed if isinstance(law, str) and law in viscosity.LAWS else ()
    missing = [key for key in ("viscosity", *needed) if key not in given]
    if missing:
        raise SceneError(f"oil.name = {name!r} is not known{nearest(name, OILS)}; known: {', '.join(OILS)}; a new oil brings "
                         f"its viscosity law and its numbers: oil.{', oil.'.join(missing)} missing")
