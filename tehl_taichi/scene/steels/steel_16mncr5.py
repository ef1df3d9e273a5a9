"""A steel of small case-hardened gears."""

from tehl_taichi.scene.steels import Steel
from tehl_taichi.values.registry import Checked

STEEL_16MNCR5: Steel = Steel(
    name="16MnCr5", says="case-hardening gear steel (1.7131)",
    source="data sheet 16MnCr5/20MnCr5 (EN 10084), round-steel.com: E, nu, rho, c (0 to 100 deg C), k (101 deg C), alpha",
    numbers=dict(E=211e9, nu=0.28, k=41.0, rho=7890.0, c=481.0, alpha=12.59e-6),
    checked=(Checked("the shear modulus E/2/(1 + nu) of the same sheet, 82.6 GPa", 82.6e9,
                     lambda: STEEL_16MNCR5.numbers["E"] / 2 / (1 + STEEL_16MNCR5.numbers["nu"]), 0.003),))
