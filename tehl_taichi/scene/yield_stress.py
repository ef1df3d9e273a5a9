"""Stress at which a body yields, and pressure at which every steel does, while the simulated bodies stay elastic."""

import math

YIELDS = 4e9  # Pa: under it hardened bearing steel keeps a dent of 1e-4 of a roller's diameter (ISO 76; balls: 4.2 GPa)
STEEL = (f"hardened steel yields above about {YIELDS / 1e9:g} GPa (static limit of roller bearings, ISO 76), softer steel "
         "earlier")
HARDENED = 2.2e9  # Pa: a half-space that yields there keeps the 1e-4 of a ball's diameter that ISO 76 allows at 4.2 GPa
STEELS = 185e9, 230e9  # Pa: Young's moduli of steels (hot work steels 190, 100Cr6 208, maraging and cold work steels to 225)
UNDER_A_PEAK = 2.1  # p_max over the von Mises stress under an asperity (docs/decisions/11-yield.md); a ball has 1.6


def of(body):
    """Yield stress (Pa) of a body: its own, or that of hardened bearing steel."""
    return body.yield_stress or HARDENED


def is_known(body):
    """Whether the yield stress of a body is given, or may be that of steel."""
    return bool(body.yield_stress) or STEELS[0] <= body.E <= STEELS[1]


def words(limit, body):
    """Text of the yield stress (Pa) that a body is compared with."""
    own = body.yield_stress or limit != HARDENED  # of a table
    return f"{limit / 1e9:.3g} GPa{', its yield stress' if own else ' at which hardened bearing steel yields'}"


def doubt(body, name):
    """Text why a body is not known to yield where hardened steel does."""
    return f"this body is no steel (E = {body.E / 1e9:.3g} GPa): set bodies.{name}.yield_stress"


def pressure(scene):
    """Pressure (Pa) at which the softer body begins to yield under an asperity, roughly; inf where no yield stress is known."""
    return UNDER_A_PEAK * min((of(body) for body in (scene.body_a, scene.body_b) if is_known(body)), default=math.inf)
