"""The steel of rolling bearings."""

from tehl_taichi.scene.steels import Steel
from tehl_taichi.values.registry import Checked

STEEL_100CR6: Steel = Steel(
    name="100Cr6", says="through-hardening bearing steel (1.3505, AISI 52100, SUJ2, EN31)",
    source="NSK catalogue Rolling Bearings, appendix, SUJ2 hardened and tempered: E, k, rho, c, alpha; nu as in ISO/TS 16281",
    numbers=dict(E=208e9, nu=0.3, k=46.0, rho=7830.0, c=470.0, alpha=12.5e-6),
    checked=(Checked("its density in the data sheet of AISI 52100, 7.81 g/cm3", 7810.0,
                     lambda: STEEL_100CR6.numbers["rho"], 0.005),
             Checked("its conductivity there, 46.6 W/mK", 46.6, lambda: STEEL_100CR6.numbers["k"], 0.02),
             Checked("its expansion there, 11.9e-6 1/K (annealed)", 11.9e-6, lambda: STEEL_100CR6.numbers["alpha"], 0.06)))
