"""Swift's law with the numbers of a through-hardened bearing steel.

It hardens from the first yielding on, so its yield stress is a 0.2 % proof stress; yielding begins at 0.57 of it.
"""

from tehl_taichi.laws.hardening.hardening_law import HardeningLaw
from tehl_taichi.values.registry import Checked

FIRST, EXPONENT = 20e-6, 0.121  # strain that counts before any flow; exponent
PROOF = 2e-3  # plastic strain at which the flow stress is the yield stress


def flow_stress(yield_stress, strain):
    """Flow stress (Pa): yield_stress ((FIRST + strain)/(FIRST + 0.2 %))^EXPONENT."""
    return yield_stress * ((FIRST + strain) / (FIRST + PROOF)) ** EXPONENT


SWIFT_52100 = HardeningLaw(
    name="swift-52100", says="Swift: yield_stress ((20e-6 + eps)/(20e-6 + 0.002))^0.121; yield_stress is the 0.2 % proof "
                             "stress, 2.37 GPa for AISI 52100",
    source="numbers of AISI 52100, 945 MPa (20 + 1e6 eps)^0.121, as Jacq et al. 2002 (J. Tribol. 124, 653) and papers by "
           "Nelias and co-workers use them; quoted, the papers could not be read",
    flow_stress=flow_stress,
    checked=(Checked("945 MPa (20 + 1e6 eps)^0.121 after 1 %", 945e6 * (20 + 1e4) ** 0.121,
                     lambda: flow_stress(945e6 * (20 + 2e3) ** 0.121, 0.01)),
             Checked("first flow of AISI 52100, 1.36 GPa", 1.36e9, lambda: flow_stress(2.374e9, 0.0), 2e-3)))
