"""Findley's constants of a case-hardened gear steel."""

from tehl_taichi.laws.hardness.relation import HardnessRelation
from tehl_taichi.values.registry import Checked


def findley(HV):
    """Findley constants, linear in the hardness."""
    return 0.017 + 8.27e-4 * HV, 1e6 * (197.75 + 0.56833 * HV)


SS2506 = HardnessRelation(
    name="ss2506", says="Findley, gear steel: kappa = 0.017 + 8.27e-4 HV, sigma_eF = 197.75 + 0.56833 HV MPa",
    source="E. Olsson, program fat_eval (github.com/erolsson), steel SS2506; the tests behind it could not be read",
    spread="not given with the formula; a Weibull exponent of 11.57e6/HV^2 is, 24 at 700 HV: about 5 % of scatter",
    low=350.0, high=800.0, findley=findley,
    checked=(Checked("by hand, 400 HV: 425.1 MPa", 425.1e6, lambda: findley(400.0)[1], 1e-4),
             Checked("by hand, 700 HV: 595.6 MPa", 595.6e6, lambda: findley(700.0)[1], 1e-4),
             Checked("by hand, 700 HV: kappa 0.596", 0.596, lambda: findley(700.0)[0], 1e-3)))
