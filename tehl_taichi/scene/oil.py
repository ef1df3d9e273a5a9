"""Lubricants: a law and its numbers, and the small library of named oils, each with its source."""

import dataclasses
import math
from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import checks
from tehl_taichi.scene.checks import build, nearest
from tehl_taichi.scene.quantity import check, choice, pairs, quantity, text

# the numbers of each viscosity law: those that a new oil must bring, and those whose default is good for most oils
LAW_NUMBERS = {"roelands-temperature": ("G0", "S0", "Dz", "Cz"), "roelands": ("eta0", "alpha", "Z"), "barus": ("eta0", "alpha"),
               "houpert": ("eta0", "alpha", "S0", "Gamma0"), "table": ("table",),
               "yasutomi": ("eta_g", "Tg0", "A1", "A2", "B1", "B2", "C1", "C2")}
MORE_NUMBERS = {"roelands": ("p_r",), "houpert": ("p_r",), "barus": ("beta_eta", "Gamma0")}
VISCOSITY_LAWS = tuple(LAW_NUMBERS)
OF_LAWS = {key for numbers in (*LAW_NUMBERS.values(), *MORE_NUMBERS.values()) for key in numbers}
MOST_PAIRS = 100  # of oil.table: each is a piece of the compiled law


@dataclass(frozen=True)
class Oil:
    """A lubricant; each law of the viscosity has its own numbers, those of the other laws are not used.

    The laws stand in tehl_taichi/physics: viscosity.py, density.py and heat.py.
    """

    name: str = text("reference-pao", "`tehl oils` lists the named ones")
    source: str = text("PAO of Everitt, licentiate thesis 2018; density after Larsson et al. 2000", "origin of its numbers",
                       one_line=False)
    viscosity: str = choice("roelands-temperature", "law of the viscosity", VISCOSITY_LAWS)
    G0: float = quantity(4.57, "", "roelands-temperature: log10 eta0 = -4.2 + G0 (1 + Gamma/135)^-S0, eta0 in Pa s", 0, 20)
    S0: float = quantity(1.25, "", "roelands-temperature, houpert: exponent of the temperature", 0, 10)
    Dz: float = quantity(0.5, "", "roelands-temperature: pressure exponent Z = Dz + Cz log10(1 + Gamma/135)", -5, 5)
    Cz: float = quantity(-0.071, "", "roelands-temperature: see Dz", -5, 5)
    eta0: float = quantity(0.04, "Pa s", "roelands, barus, houpert: viscosity at p = 0", 1e-6, 1e4)
    alpha: float = quantity(2.2e-8, "1/Pa", "roelands, barus, houpert: rise of the viscosity with pressure", 1e-10, 1e-6)
    p_r: float = quantity(1.96e8, "Pa", "roelands, houpert: pressure scale", 1e6, 1e10)
    Z: float = quantity(0.668, "", "roelands: pressure exponent", 1e-3, 3.0)
    Gamma0: float = quantity(40.0, "deg C", "barus, houpert: temperature of eta0", -100, 300)
    beta_eta: float = quantity(0.0, "1/K", "barus: fall of ln(viscosity) with temperature", 0, 1)
    eta_g: float = quantity(1e12, "Pa s", "yasutomi: viscosity at the glass transition", 1, 1e20)
    Tg0: float = quantity(-80.0, "deg C", "yasutomi: glass transition at p = 0, Tg = Tg0 + A1 ln(1 + A2 p)", -250, 200)
    A1: float = quantity(200.0, "K", "yasutomi: see Tg0", 0, 1e4)
    A2: float = quantity(1e-9, "1/Pa", "yasutomi: see Tg0", 0, 1e-6)
    B1: float = quantity(0.2, "", "yasutomi: F = 1 - B1 ln(1 + B2 p)", 0, 10)
    B2: float = quantity(2e-8, "1/Pa", "yasutomi: see B1", 0, 1e-6)
    C1: float = quantity(16.0, "", "yasutomi: log10(eta/eta_g) = -C1 (Gamma - Tg) F/(C2 + (Gamma - Tg) F)", 0.1, 100)
    C2: float = quantity(26.0, "K", "yasutomi: see C1", 0.1, 1e3)
    table: tuple = pairs((), "table: [p in Pa, ln(eta/Pa s)] with rising p")
    rho0: float = quantity(853.0, "kg/m3", "density at p = 0 and 40 deg C", 100, 5000)
    D1: float = quantity(0.69e-9, "1/Pa", "density: 1 + D1 p/(1 + D2 p)", 0, 1e-7)
    D2: float = quantity(2.55e-9, "1/Pa", "density: see D1", 0, 1e-7)
    beta0: float = quantity(6.8e-4, "1/K", "density: thermal factor 1 - beta0 exp(-beta_c p) (Gamma - 40)", 0, 1e-2)
    beta_c: float = quantity(1.5e-9, "1/Pa", "density: see beta0", 0, 1e-7)
    expansion: str = choice("thermal", "where the thermal factor of the density acts; thermal: only with the energy equation",
                            ("thermal", "always", "never"))
    k0: float = quantity(0.154, "W/mK", "conductivity k0 (1 + k1 p/(1 + k2 p))", 1e-3, 10)
    k1: float = quantity(1.40e-9, "1/Pa", "conductivity: see k0", 0, 1e-7)
    k2: float = quantity(0.34e-9, "1/Pa", "conductivity: see k0", 0, 1e-7)
    c0: float = quantity(2080.0, "J/kgK", "heat capacity rho0 c0 (1 + c1 p/(1 + c2 p)) B, B as in b0", 100, 1e4)
    c1: float = quantity(0.41e-9, "1/Pa", "heat capacity: see c0", 0, 1e-7)
    c2: float = quantity(1.05e-9, "1/Pa", "heat capacity: see c0", 0, 1e-7)
    b0: float = quantity(6.5e-4, "1/K", "heat capacity: B = 1 + b0 (1 + b1 p + b2 p^2) (Gamma - 22)", -0.01, 0.01)
    b1: float = quantity(2.7e-9, "1/Pa", "heat capacity: see b0", -1e-7, 1e-7)
    b2: float = quantity(-1.5e-18, "1/Pa^2", "heat capacity: see b0", -1e-15, 1e-15)

    def __post_init__(self):
        check(self, "oil")
        self._check_table()

    def _check_table(self):
        rising = all(a[0] < b[0] for a, b in zip(self.table, self.table[1:]))
        if (self.table or self.viscosity == "table") and not (2 <= len(self.table) <= MOST_PAIRS and rising):
            raise SceneError(f"oil.table has {len(self.table)} pairs [p in Pa, ln(eta/Pa s)]; allowed: 2 to {MOST_PAIRS}, with "
                             "rising p")

    @property
    def law_numbers(self):
        """Names of the numbers that its viscosity law takes."""
        return (*LAW_NUMBERS[self.viscosity], *MORE_NUMBERS.get(self.viscosity, ()))


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
    missing = [key for key in ("viscosity", *LAW_NUMBERS.get(law if isinstance(law, str) else None, ())) if key not in given]
    if missing:
        raise SceneError(f"oil.name = {name!r} is not known{nearest(name, OILS)}; known: {', '.join(OILS)}; a new oil brings "
                         f"its viscosity law and its numbers: oil.{', oil.'.join(missing)} missing")
