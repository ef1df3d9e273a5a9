"""Test fluid of the film formulas."""

from tehl_taichi.scene.oils import NamedOil

MOES_TEST_FLUID = NamedOil(
    name="moes-test-fluid", says="no temperature: for comparisons with published films, given by Moes' M and L",
    source="test fluid of the multigrid literature (Venner & Lubrecht); Dowson-Higginson density",
    numbers=dict(viscosity="roelands", eta0=0.04, alpha=2.2e-8, p_r=1.96e8, Z=0.668, D1=0.34 / 5.9e8, D2=1 / 5.9e8, beta0=0.0,
                 expansion="never"),
    known=((0.0, 40.0, 0.04, 1e-12, "its eta0"),
           (1e6, 40.0, 0.04 * (1 + 2.2e-2), 5e-4, "by hand at 1 MPa: alpha p = 0.022, curvature below 0.03 %")))
