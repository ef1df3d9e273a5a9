"""Test fluid of the scene of a ridge on a ball."""

import math

from tehl_taichi.scene.oils import NamedOil

LN_RISE = math.log(1.22) + 9.67  # ln(eta0/6.31e-5 Pa s), of Roelands

RIDGE_TEST_FLUID = NamedOil(
    name="ridge-test-fluid", says="thick, no temperature: for the transverse ridge on a ball",
    source="oil of the transverse ridge in a circular contact (Venner & Lubrecht 1994); Z from alpha, eta0, p_r",
    numbers=dict(viscosity="roelands", eta0=1.22, alpha=2.2e-8, p_r=1.96e8, Z=2.2e-8 * 1.96e8 / LN_RISE, D1=0.34 / 5.9e8,
                 D2=1 / 5.9e8, beta0=0.0, expansion="never"),
    known=((0.0, 40.0, 1.22, 1e-12, "its eta0"),
           (1.96e8, 20.0, 6.315e-5 * math.exp(LN_RISE * 2 ** (4.312 / LN_RISE)), 1e-3,
            "Roelands' first form, eta = 6.315e-5 (eta0/6.315e-5)^((1 + p/p_r)^Z), at p = p_r")))
