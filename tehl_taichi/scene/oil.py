"""Lubricants: a law and its numbers, and the small library of named oils, each with its source."""

import dataclasses
import math
from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.checks import build, choice, nearest, normalise, number, text
from tehl_taichi.scene.plain import shown

# the numbers of each viscosity law: those that a new oil must bring, and those whose default is good for most oils
LAW_NUMBERS = {"roelands-temperature": ("G0", "S0", "Dz", "Cz"), "roelands": ("eta0", "alpha", "Z"), "barus": ("eta0", "alpha"),
               "houpert": ("eta0", "alpha", "S0", "Gamma0"), "table": ("table",),
               "yasutomi": ("eta_g", "Tg0", "A1", "A2", "B1", "B2", "C1", "C2")}
MORE_NUMBERS = {"roelands": ("p_r",), "houpert": ("p_r",), "barus": ("beta_eta", "Gamma0")}
VISCOSITY_LAWS = tuple(LAW_NUMBERS)
OF_LAWS = {key for numbers in (*LAW_NUMBERS.values(), *MORE_NUMBERS.values()) for key in numbers}
RANGES = {"eta0": ("Pa s", 1e-6, 1e4), "alpha": ("1/Pa", 1e-10, 1e-6), "p_r": ("Pa", 1e6, 1e10), "Z": ("", 1e-3, 3.0),
          "G0": ("", 0, 20), "S0": ("", 0, 10), "Dz": ("", -5, 5), "Cz": ("", -5, 5), "Gamma0": ("deg C", -100, 300),
          "beta_eta": ("1/K", 0, 1), "eta_g": ("Pa s", 1, 1e20), "Tg0": ("deg C", -250, 200), "A1": ("K", 0, 1e4),
          "A2": ("1/Pa", 0, 1e-6), "B1": ("", 0, 10), "B2": ("1/Pa", 0, 1e-6), "C1": ("", 0.1, 100), "C2": ("K", 0.1, 1e3),
          "rho0": ("kg/m3", 100, 5000), "D1": ("1/Pa", 0, 1e-7), "D2": ("1/Pa", 0, 1e-7), "beta0": ("1/K", 0, 1e-2),
          "beta_c": ("1/Pa", 0, 1e-7), "k0": ("W/mK", 1e-3, 10), "k1": ("1/Pa", 0, 1e-7), "k2": ("1/Pa", 0, 1e-7),
          "c0": ("J/kgK", 100, 1e4), "c1": ("1/Pa", 0, 1e-7), "c2": ("1/Pa", 0, 1e-7), "b0": ("1/K", -1e-2, 1e-2),
          "b1": ("1/Pa", -1e-7, 1e-7), "b2": ("1/Pa2", -1e-15, 1e-15)}
MOST_PAIRS = 100  # of oil.table: each is a piece of the compiled law


@dataclass(frozen=True)
class Oil:
    """viscosity: the law, with its own numbers (tehl_taichi/physics/viscosity.py); density D1, D2 1/Pa, rho0 kg/m3.

    expansion: the thermal factor 1 - beta0 exp(-beta_c p)(Gamma - 40) of the density acts "always", "never", or
    "thermal": only where the energy equation is solved (an isothermal film has density(p) alone). k0 W/mK, k1, k2 1/Pa:
    conductivity; c0 J/kgK, c1, c2, b0, b1, b2: heat capacity (tehl_taichi/physics/heat.py).
    """

    name: str = "reference-pao"
    source: str = "PAO of Everitt, licentiate thesis 2018; density after Larsson et al. 2000"
    viscosity: str = "roelands-temperature"
    G0: float = 4.57
    S0: float = 1.25
    Dz: float = 0.5
    Cz: float = -0.071
    eta0: float = 0.04
    alpha: float = 2.2e-8
    p_r: float = 1.96e8
    Z: float = 0.668
    Gamma0: float = 40.0
    beta_eta: float = 0.0
    eta_g: float = 1e12
    Tg0: float = -80.0
    A1: float = 200.0
    A2: float = 1e-9
    B1: float = 0.2
    B2: float = 2e-8
    C1: float = 16.0
    C2: float = 26.0
    table: tuple = ()
    rho0: float = 853.0
    D1: float = 0.69e-9
    D2: float = 2.55e-9
    beta0: float = 6.8e-4
    beta_c: float = 1.5e-9
    expansion: str = "thermal"
    k0: float = 0.154
    k1: float = 1.40e-9
    k2: float = 0.34e-9
    c0: float = 2080.0
    c1: float = 0.41e-9
    c2: float = 1.05e-9
    b0: float = 6.5e-4
    b1: float = 2.7e-9
    b2: float = -1.5e-18

    def __post_init__(self):
        normalise(self)
        text("oil.name", self.name, 100, empty=False)
        text("oil.source", self.source, printable=False)
        choice("oil.viscosity", self.viscosity, VISCOSITY_LAWS)
        choice("oil.expansion", self.expansion, ("thermal", "always", "never"))
        for key, (unit, low, high) in RANGES.items():
            number(f"oil.{key}", getattr(self, key), unit, low, high)
        self._check_table()

    def _check_table(self):
        pairs = self.table
        if not isinstance(pairs, tuple) or not all(isinstance(pair, tuple) and len(pair) == 2 for pair in pairs):
            raise SceneError(f"oil.table = {shown(pairs)} must be a list of pairs [p in Pa, ln(eta/Pa s)]")
        for p, ln_eta in pairs:
            number("oil.table: a pressure", p, "Pa", 0.0, 1e11)
            number("oil.table: ln(eta/Pa s)", ln_eta, "", -20.0, 200.0)
        object.__setattr__(self, "table", tuple((float(p), float(ln_eta)) for p, ln_eta in pairs))
        rising = all(a[0] < b[0] for a, b in zip(pairs, pairs[1:]))
        if (pairs or self.viscosity == "table") and not (2 <= len(pairs) <= MOST_PAIRS and rising):
            raise SceneError(f"oil.table has {len(pairs)} pairs [p in Pa, ln(eta/Pa s)]; allowed: 2 to {MOST_PAIRS}, with "
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
    text("oil.name", name, 100, empty=False)
    law = given.get("viscosity")
    missing = [key for key in ("viscosity", *LAW_NUMBERS.get(law if isinstance(law, str) else None, ())) if key not in given]
    if missing:
        raise SceneError(f"oil.name = {name!r} is not known{nearest(name, OILS)}; known: {', '.join(OILS)}; a new oil brings "
                         f"its viscosity law and its numbers: oil.{', oil.'.join(missing)} missing")
