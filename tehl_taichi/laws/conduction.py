"""Conductivity and heat capacity of the film, p in Pa, Gamma in deg C; constant beyond the measured range."""

from itertools import product

from tehl_taichi.engine.pointwise import minimum, pointwise
from tehl_taichi.laws.densities import RHO0
from tehl_taichi.laws.law import SPARE, Law
from tehl_taichi.values.quantity import quantity
from tehl_taichi.values.registry import Checked

P_MEASURED, GAMMA_MEASURED = 1.1e9, 107.0  # Pa; deg C, of the heat capacity


@pointwise
def conductivity(oil, p):
    """Conductivity k0 (1 + k1 p/(1 + k2 p)), W/mK."""
    q = minimum(p, P_MEASURED)
    return oil.k0 * (1 + oil.k1 * q / (1 + oil.k2 * q))


@pointwise
def rise(oil, q, T):
    """Factor B = 1 + b0 (1 + b1 p + b2 p^2) (Gamma - 22)."""
    return 1 + oil.b0 * (1 + oil.b1 * q + oil.b2 * q * q) * (T - 22)


@pointwise
def heat_capacity(oil, p, Gamma):
    """rho c = rho_0 c0 (1 + c1 p/(1 + c2 p)) (1 + b0 (1 + b1 p + b2 p^2) (Gamma - 22)), J/m3K."""
    q, T = minimum(p, P_MEASURED), minimum(Gamma, GAMMA_MEASURED)
    return oil.rho0 * oil.c0 * (1 + oil.c1 * q / (1 + oil.c2 * q)) * rise(oil, q, T)


def refused(oil, Gamma, p):
    """Reason if the temperature factor falls too low somewhere in a possible film; "" otherwise."""
    for q, T in product((P_MEASURED * n / 10 for n in range(11)), (min(Gamma, GAMMA_MEASURED), GAMMA_MEASURED)):
        factor = rise(oil, q, T)
        if factor < SPARE:
            return (f"oil.b0, b1, b2: the heat capacity falls to {factor:.3g} of its value at 22 deg C at {T:g} deg C and "
                    f"{q:.3g} Pa, which the film reaches; allowed: at least {SPARE:g}")
    return ""


CONDUCTIVITY = Law(
    name="conductivity", says="W/mK: k0 (1 + k1 p/(1 + k2 p))", source="Larsson et al. 2000", most_p=P_MEASURED,
    numbers={"k0": quantity(0.154, "W/mK", "k0 (1 + k1 p/(1 + k2 p))", 1e-3, 10),
             "k1": quantity(1.40e-9, "1/Pa", "see k0", 0, 1e-7),
             "k2": quantity(0.34e-9, "1/Pa", "see k0", 0, 1e-7)},
    checked=(Checked("by hand at 1 GPa: 0.154 (1 + 1.4/1.34)", 0.154 * (1 + 1.4 / 1.34),
                     lambda: conductivity(CONDUCTIVITY.having(), 1e9)),
             Checked("by hand at 3 GPa as at 1.1: 0.154 (1 + 1.54/1.374)", 0.154 * (1 + 1.54 / 1.374),
                     lambda: conductivity(CONDUCTIVITY.having(), 3e9))))

HEAT_CAPACITY = Law(
    name="heat capacity", says="J/m3K: rho0 c0 (1 + c1 p/(1 + c2 p)) B, B = 1 + b0 (1 + b1 p + b2 p^2) (Gamma - 22)",
    source="Larsson et al. 2000", most_p=P_MEASURED, most_Gamma=GAMMA_MEASURED, refused=refused,
    numbers={"rho0": RHO0,
             "c0": quantity(2080.0, "J/kgK", "rho0 c0 (1 + c1 p/(1 + c2 p)) B, B as in b0", 100, 1e4),
             "c1": quantity(0.41e-9, "1/Pa", "see c0", 0, 1e-7),
             "c2": quantity(1.05e-9, "1/Pa", "see c0", 0, 1e-7),
             "b0": quantity(6.5e-4, "1/K", "B = 1 + b0 (1 + b1 p + b2 p^2) (Gamma - 22)", -0.01, 0.01),
             "b1": quantity(2.7e-9, "1/Pa", "see b0", -1e-7, 1e-7),
             "b2": quantity(-1.5e-18, "1/Pa^2", "see b0", -1e-15, 1e-15)},
    checked=(Checked("by hand at 1 GPa and 72 deg C: 1 + 0.41/2.05 = 1.2, 1 + 2.7 - 1.5 = 2.2, 50 K above 22",
                     853 * 2080 * 1.2 * (1 + 6.5e-4 * 2.2 * 50), lambda: heat_capacity(HEAT_CAPACITY.having(), 1e9, 72.0)),
             Checked("by hand at 1 GPa and 190 deg C as at 107: 85 K above 22", 853 * 2080 * 1.2 * (1 + 6.5e-4 * 2.2 * 85),
                     lambda: heat_capacity(HEAT_CAPACITY.having(), 1e9, 190.0))))

LAWS = {law.name: law for law in (CONDUCTIVITY, HEAT_CAPACITY)}

