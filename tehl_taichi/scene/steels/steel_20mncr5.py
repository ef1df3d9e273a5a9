"""A steel of larger case-hardened gears."""

from tehl_taichi.scene.steels import Steel
from tehl_taichi.values.registry import Checked

STEEL_20MNCR5: Steel = Steel(
    name="20MnCr5", says="case-hardening gear steel (1.7147)",
    source="data sheet 16MnCr5/20MnCr5 (EN 10084), round-steel.com: E, nu, rho, c (0 to 100 deg C), k (97 deg C), alpha",
    numbers=dict(E=209e9, nu=0.28, k=42.0, rho=7870.0, c=477.0, alpha=13.05e-6),
    checked=(Checked("its E in the data sheet of DIN 1652-3 20MnCr5 at 100 deg C, 207 GPa", 207e9,
                     lambda: STEEL_20MNCR5.numbers["E"], 0.012),
             Checked("its specific heat there, 479 J/kgK", 479.0, lambda: STEEL_20MNCR5.numbers["c"], 0.005),
             Checked("its density there, 7.85 g/cm3", 7850.0, lambda: STEEL_20MNCR5.numbers["rho"], 0.004),
             Checked("its conductivity there, 46.4 W/mK", 46.4, lambda: STEEL_20MNCR5.numbers["k"], 0.1),
             Checked("its expansion there, 12.1e-6 1/K", 12.1e-6, lambda: STEEL_20MNCR5.numbers["alpha"], 0.08)))
