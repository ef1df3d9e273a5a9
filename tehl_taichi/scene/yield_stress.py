"""Stress at which a body yields, while the simulated bodies stay elastic."""

HARDENED = 2.2e9  # Pa: a half-space that yields there keeps the 1e-4 of a ball's diameter that ISO 76 allows at 4.2 GPa
UNDER_A_PEAK = 2.1  # p_max over the von Mises stress under an asperity (docs/decisions/11-yield.md); a ball has 1.6


def of(body):
    """Yield stress (Pa) of a body: its own, or that of hardened bearing steel."""
    return body.yield_stress or HARDENED


def words(limit):
    """Text of a yield stress (Pa)."""
    steel = " at which hardened bearing steel yields" if limit == HARDENED else ", its yield stress"
    return f"{limit / 1e9:.3g} GPa{steel}"


def pressure(scene):
    """Pressure (Pa) at which the softer body begins to yield under an asperity, roughly."""
    return UNDER_A_PEAK * min(of(scene.body_a), of(scene.body_b))
