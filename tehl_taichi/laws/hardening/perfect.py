"""Steel that does not harden."""

from tehl_taichi.laws.hardening.hardening_law import HardeningLaw
from tehl_taichi.values.registry import Checked


def flow_stress(yield_stress, strain):
    """The yield stress at any strain."""
    return yield_stress + 0.0 * strain


PERFECT = HardeningLaw(
    name="perfect", says="none: steel flows at its yield stress", source="J2 plasticity (Johnson, Contact Mechanics, 1985)",
    flow_stress=flow_stress, checked=(Checked("by hand: 2.2 GPa after 1 %", 2.2e9, lambda: flow_stress(2.2e9, 0.01)),))
