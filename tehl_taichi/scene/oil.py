"""Lubricants: a law and its numbers, and the small library of named oils, each with its source."""

import dataclasses
import math
from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.checks import choice, nearest, number

VISCOSITY_LAWS = ("roelands-temperature", "roelands", "barus", "houpert", "yasutomi", "table")


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
        choice("oil.viscosity", self.viscosity, VISCOSITY_LAWS)
        choice("oil.expansion", self.expansion, ("thermal", "always", "never"))
        for key, unit, low, high in (("eta0", "Pa s", 1e-6, 1e4), ("alpha", "1/Pa", 1e-10, 1e-6),
                                     ("p_r", "Pa", 1e6, 1e10), ("Z", "", 1e-3, 3.0), ("rho0", "kg/m3", 100, 5000),
                                     ("D1", "1/Pa", 0, 1e-7), ("D2", "1/Pa", 0, 1e-7), ("beta0", "1/K", 0, 1e-2),
                                     ("beta_c", "1/Pa", 0, 1e-7), ("k0", "W/mK", 1e-3, 10), ("c0", "J/kgK", 100, 1e4),
                                     ("beta_eta", "1/K", 0, 1), ("G0", "", 0, 20), ("S0", "", 0, 10)):
            number(f"oil.{key}", getattr(self, key), unit, low, high)
        if self.viscosity == "table":
            self._check_table()

    def _check_table(self):
        pairs = self.table
        rising = all(len(q) == 2 for q in pairs) and all(a[0] < b[0] for a, b in zip(pairs, pairs[1:]))
        if len(pairs) < 2 or not rising:
            raise SceneError("oil.table needs at least two pairs [p in Pa, ln(eta/Pa s)] with rising p")


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
    """Oil from a table; `name` of a known oil gives the values that are not named."""
    from tehl_taichi.scene.checks import build

    base = dataclasses.asdict(OILS[values["name"]]) if values.get("name") in OILS else {}
    return build(Oil, {**base, **values}, "oil")
