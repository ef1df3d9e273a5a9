"""Yasutomi's viscosity by free volume."""

from tehl_taichi.engine.pointwise import log, pointwise
from tehl_taichi.laws.law import ViscosityLaw
from tehl_taichi.laws.viscosities import LN10
from tehl_taichi.values.quantity import quantity
from tehl_taichi.values.registry import Checked

SAMPLES = 20  # pressures up to that of Hertz at which the law must have a value


@pointwise
def glass(oil, p):
    """Glass transition Tg, deg C."""
    return oil.Tg0 + oil.A1 * log(1 + oil.A2 * p)


@pointwise
def free_volume(oil, p):
    """Expansivity F of the free volume at p, divided by its value at p = 0."""
    return 1 - oil.B1 * log(1 + oil.B2 * p)


@pointwise
def ln_eta(oil, p, Gamma):
    """log10(eta/eta_g) = -C1 (Gamma - Tg) F / (C2 + (Gamma - Tg) F)."""
    Tg = glass(oil, p)
    F = free_volume(oil, p)
    return log(oil.eta_g) - LN10 * oil.C1 * (Gamma - Tg) * F / (oil.C2 + (Gamma - Tg) * F)


def refused(oil, Gamma, p):
    """Reason if F or the denominator falls to 0."""
    for q in (p * n / SAMPLES for n in range(SAMPLES + 1)):
        F = free_volume(oil, q)
        volume = oil.C2 + (Gamma - glass(oil, q)) * F
        if F <= 0 or volume <= 0:
            return (f"oil: Yasutomi's law has no value at {q:.3g} Pa at the inlet temperature of {Gamma:g} deg C: F = 1 - B1 "
                    f"ln(1 + B2 p) = {F:.3g}, C2 + (T - Tg) F = {volume:.3g} K; allowed: both more than 0 up to the Hertz "
                    f"pressure of {p:.3g} Pa")
    return ""


def doubted(oil, Gamma, p):
    """Reason for doubt: the law does not hold below the glass transition."""
    return "" if glass(oil, p) <= Gamma else (
        f"oil.viscosity = yasutomi: at the Hertz pressure the glass transition lies at {glass(oil, p):.0f} deg C, above the "
        f"inlet temperature of {Gamma:g} deg C; the law is used beyond its range")


YASUTOMI = ViscosityLaw(
    name="yasutomi", says="log10(eta/eta_g) = -C1 (Gamma - Tg) F/(C2 + (Gamma - Tg) F), Tg rising and F falling with pressure",
    source="Yasutomi, Bair & Winer 1984", ln_eta=ln_eta, refused=refused, doubted=doubted,
    numbers={"eta_g": quantity(1e12, "Pa s", "viscosity at the glass transition", 1, 1e20),
             "Tg0": quantity(-80.0, "deg C", "glass transition at p = 0, Tg = Tg0 + A1 ln(1 + A2 p)", -250, 200),
             "A1": quantity(200.0, "K", "see Tg0", 0, 1e4), "A2": quantity(1e-9, "1/Pa", "see Tg0", 0, 1e-6),
             "B1": quantity(0.2, "", "F = 1 - B1 ln(1 + B2 p)", 0, 10), "B2": quantity(2e-8, "1/Pa", "see B1", 0, 1e-6),
             "C1": quantity(16.0, "", "log10(eta/eta_g) = -C1 (Gamma - Tg) F/(C2 + (Gamma - Tg) F)", 0.1, 100),
             "C2": quantity(26.0, "K", "see C1", 0.1, 1e3)},
    checked=(Checked("by hand at p = 0, 120 K above Tg0: -16 * 120/146 decades below eta_g", (12 - 16 * 120 / 146) * LN10,
                     lambda: ln_eta(YASUTOMI.having(), 0.0, 40.0)),
             Checked("by hand at 1 GPa, B2 = 3e-9: Tg = -80 + 200 ln 2 = 58.629 deg C, F = 1 - 0.2 ln 4 = 0.72274; 50 K above, "
                     "-16 * 36.137/62.137 = -9.30512", 12 - 9.305122,
                     lambda: ln_eta(YASUTOMI.having(B2=3e-9), 1e9, 108.6294361) / LN10, rel=1e-6)))
