"""Every law at one point at least, by its textbook form in logarithms to base 10 or by hand."""

import dataclasses
import math

import numpy as np
import pytest

from tehl_taichi.engine.elementary import exp, log
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import V
from tehl_taichi.laws.conduction import conductivity, heat_capacity
from tehl_taichi.laws.density import expansivity, rho_film, rho_ratio
from tehl_taichi.laws.rheology import LAWS, secant, shear_stress
from tehl_taichi.laws.shear import shear_limit
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.scene import scene
from tehl_taichi.scene.named_oils import OILS
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.sections import Rheology

PAO, TEST_FLUID = Oil(), OILS["moes-test-fluid"]


def near(value, rel=1e-9):
    return pytest.approx(value, rel=rel)


def test_roelands_with_temperature():
    """At 90 deg C, 1 + 90/135 = 5/3; at p = 1/5.1e-9 Pa the bracket is 2^Z - 1, with twice that pressure 3^Z - 1."""
    lg0 = -4.2 + 4.57 * (5 / 3) ** -1.25
    assert 10**lg0 == near(0.016340, 1e-4)  # Pa s, by hand: 4.57 * 0.52807 = 2.41326
    Z = 0.5 - 0.071 * math.log10(5 / 3)
    for n in (0, 1, 2):
        lg = lg0 + (lg0 + 9.67 * math.log10(math.e)) * ((1 + n) ** Z - 1)
        assert float(ln_eta(PAO, n / 5.1e-9, 90.0)) == near(lg * math.log(10))


def test_roelands_of_venner():
    """eta0 exp(alpha p_r/Z (2^Z - 1)) at p_r; with Z = 1 it is Barus."""
    assert float(ln_eta(TEST_FLUID, 1.96e8, 40.0)) == near(math.log(0.04) + 2.2e-8 * 1.96e8 * (2**0.668 - 1) / 0.668)
    straight = dataclasses.replace(TEST_FLUID, Z=1.0)
    assert float(ln_eta(straight, 0.7e9, 0.0)) == near(math.log(0.04) + 15.4)  # 2.2e-8 * 0.7e9


def test_barus_with_reynolds_temperature():
    oil = dataclasses.replace(PAO, viscosity="barus", eta0=0.1, alpha=2e-8, beta_eta=0.03, Gamma0=40.0)
    assert math.exp(float(ln_eta(oil, 1e8, 90.0))) == near(0.1 * math.exp(2 - 1.5))


def test_houpert():
    """At p_r and (Gamma + 135)/(Gamma0 + 135) = 262.5/175 = 1.5 with S0 = 1: ln eta = -9.67 + (ln eta0 + 9.67) 2^Z/1.5."""
    oil = dataclasses.replace(PAO, viscosity="houpert", eta0=0.04, alpha=2.2e-8, p_r=1.96e8, Gamma0=40.0, S0=1.0)
    ln0 = math.log(0.04) + 9.67
    assert float(ln_eta(oil, 1.96e8, 127.5)) == near(-9.67 + ln0 * 2 ** (2.2e-8 * 1.96e8 / ln0) / 1.5)
    steeper = dataclasses.replace(oil, S0=2.0)
    assert float(ln_eta(steeper, 0.0, 127.5)) == near(-9.67 + ln0 / 2.25)


YASUTOMI = dataclasses.replace(PAO, viscosity="yasutomi", eta_g=1e12, Tg0=-80.0, A1=200.0, A2=1e-9, B1=0.2, B2=3e-9, C1=16.0,
                               C2=26.0)


def test_yasutomi():
    """At 1 GPa Tg = -80 + 200 ln 2 = 58.629 deg C and F = 1 - 0.2 ln 4 = 0.72274; 50 K above Tg, 50 F = 36.137:
    log10(eta/eta_g) = -16 * 36.137/(26 + 36.137) = -9.30512."""
    Tg = -80 + 200 * math.log(2)
    for above, lg in ((50.0, -9.305122), (0.0, 0.0), (-10.0, 16 * 7.2274113 / (26 - 7.2274113))):
        assert float(ln_eta(YASUTOMI, 1e9, Tg + above)) / math.log(10) == pytest.approx(12 + lg, abs=1e-5)
    # without pressure: 120 K above Tg = -80, log10 = -16 * 120/146
    assert float(ln_eta(YASUTOMI, 0.0, 40.0)) / math.log(10) == near(12 - 16 * 120 / 146)


@pytest.mark.parametrize("oil", [PAO, YASUTOMI, dataclasses.replace(PAO, viscosity="houpert"),
                                 dataclasses.replace(PAO, viscosity="barus", beta_eta=0.03)], ids=lambda oil: oil.viscosity)
def test_oil_is_thicker_under_pressure_and_thinner_when_hot(oil):
    for p in (0.0, 0.5e9, 2e9):
        assert ln_eta(oil, p + 1e7, 80.0) > ln_eta(oil, p, 80.0) > ln_eta(oil, p, 81.0)


def test_tables_of_viscosity_continue_at_both_ends():
    oil = Oil(viscosity="table", table=((1e8, -2.0), (2e8, -1.0), (4e8, 5.0)))  # slopes 1e-8 and 3e-8 per Pa
    assert [float(ln_eta(oil, p, 0.0)) for p in (0.0, 1.5e8, 3e8, 5e8)] == near([-3.0, -1.5, 2.0, 8.0])


def test_density_with_temperature():
    """1 GPa: 1 + 0.69/3.55 = 1.194366; 90 deg C: 1 - 6.8e-4 e^-1.5 50 = 0.992414."""
    compressed, expanded = 1.1943662, 1 - 0.034 * math.exp(-1.5)
    kinds = {kind: dataclasses.replace(PAO, expansion=kind) for kind in ("thermal", "always", "never")}
    assert float(rho_film(PAO, 1e9, 90.0)) == near(compressed * expanded, 1e-7)
    film = [float(rho_film(kinds[kind], 1e9, 90.0)) for kind in ("thermal", "always", "never")]
    assert film == near([compressed * expanded] * 2 + [compressed], 1e-7)
    alone = [float(rho_ratio(kinds[kind], 1e9, 90.0)) for kind in ("thermal", "always", "never")]
    assert alone == near([compressed, compressed * expanded, compressed], 1e-7)
    assert float(rho_film(PAO, 0.0, 40.0)) == 1.0 and float(rho_film(PAO, 0.0, 100.0)) == near(1 - 6.8e-4 * 60)


@pytest.mark.parametrize("p, Gamma", [(0.0, 20.0), (1e9, 90.0), (2e9, 190.0)])
def test_expansivity_is_the_slope_of_the_density(p, Gamma):
    slope = -(math.log(rho_film(PAO, p, Gamma + 0.1)) - math.log(rho_film(PAO, p, Gamma - 0.1))) / 0.2
    assert float(expansivity(PAO, p, Gamma)) == near(slope, 1e-7) and slope > 0
    assert float(expansivity(dataclasses.replace(PAO, expansion="never"), p, Gamma)) == 0.0


def test_conductivity_and_where_it_was_measured_up_to():
    """0.154 (1 + 1.4/1.34) at 1 GPa; from 1.1 GPa on 0.154 (1 + 1.54/1.374)."""
    at = [float(conductivity(PAO, p)) for p in (0.0, 1e9, 1.1e9, 3e9)]
    assert at == near([0.154, 0.31489552, 0.32660553, 0.32660553], 1e-6)


# GPa, deg C: value over rho0 c0; at 1 GPa 1 + 0.41/2.05 = 1.2 and 1 + 2.7 - 1.5 = 2.2, at 1.1 GPa 1 + 0.451/2.155 = 1.2092807
# and 1 + 2.97 - 1.815 = 2.155; the temperature counts from 22 deg C
HEAT_CAPACITY = {(0.0, 22.0): 1.0, (0.0, 72.0): 1 + 6.5e-4 * 50, (1.0, 72.0): 1.2 * (1 + 6.5e-4 * 2.2 * 50),
                 (1.1, 107.0): 1.2092807 * (1 + 6.5e-4 * 2.155 * 85), (1.0, 190.0): 1.2 * (1 + 6.5e-4 * 2.2 * 85),
                 (2.5, 72.0): 1.2092807 * (1 + 6.5e-4 * 2.155 * 50)}


@pytest.mark.parametrize("p, Gamma", HEAT_CAPACITY)
def test_heat_capacity_and_where_it_was_measured_up_to(p, Gamma):
    assert float(heat_capacity(PAO, p * 1e9, Gamma)) == near(853 * 2080 * HEAT_CAPACITY[p, Gamma], 1e-7)


def test_limiting_shear_stress():
    """tau_L = 10 MPa + 0.075 * 1 GPa = 85 MPa; eta times the shear rate is tau/sqrt(1 - (tau/tau_L)^2)."""
    law = Rheology()
    assert float(shear_limit(law, 1e9)) == near(85e6) and float(shear_limit(law, 0.0)) == near(10e6)
    for share in (0.1, 0.6, -0.8):  # 0.6: 51 MPa take 51/0.8 = 63.75 MPa of a Newtonian oil
        newtonian = share * 85e6 / math.sqrt(1 - share**2)
        assert float(shear_stress(law, newtonian, 1e9)) == near(share * 85e6)


def test_eyring():
    """eta times the shear rate is tau_0 sinh(tau/tau_0)."""
    law = Rheology(law="eyring", tau_0=5e6)
    for tau in (0.01e6, 5e6, -20e6):
        assert float(shear_stress(law, 5e6 * math.sinh(tau / 5e6), 0.0)) == near(tau)


def test_carreau():
    """newtonian (1 + r^2)^((n-1)/2): at r^2 = 3 and n = 0.6 it is 2^-0.4 of the Newtonian one; n = 1: Newtonian."""
    law, newtonian = Rheology(law="carreau", tau_0=6e6, carreau_n=0.6), math.sqrt(3) * 6e6
    assert float(shear_stress(law, newtonian, 1e9)) == near(newtonian * 2**-0.4)
    assert float(shear_stress(law, -newtonian, 1e9)) == near(-newtonian * 2**-0.4)
    power = math.log(shear_stress(law, 1e12, 0.0) / shear_stress(law, 1e11, 0.0)) / math.log(10)
    assert power == near(0.6, 1e-6)  # a power law far beyond tau_0
    assert float(shear_stress(dataclasses.replace(law, carreau_n=1.0), newtonian, 1e9)) == near(newtonian)


@pytest.mark.parametrize("law", LAWS)
def test_what_the_law_leaves_of_the_viscosity(law):
    rheology = Rheology(law=law)
    for newtonian in (5e7, -5e7):
        assert float(secant(rheology, newtonian, 1e9)) == near(float(shear_stress(rheology, newtonian, 1e9)) / newtonian)
    assert float(secant(rheology, 0.0, 1e9)) == 1.0 and float(secant(rheology, 1.0, 1e9)) == near(1.0, 1e-8)
    assert (float(secant(rheology, 1e9, 1e9)) < 0.999) == rheology.thins


def test_exp_and_log_of_lanes(taichi_cpu):
    """The laws' own exp and log of four rows at once against numpy's, over the whole range of the laws."""
    @ti.kernel
    def both(x: ti.types.ndarray(dtype=ti.f64, ndim=1), out: ti.types.ndarray(dtype=ti.f64, ndim=2)):
        for i in range(x.shape[0] // 4):
            v = V(0.0)
            for u in ti.static(range(4)):
                v[u] = x[4 * i + u]
            e = exp(v)
            l = log(e)
            for u in ti.static(range(4)):
                out[0, 4 * i + u], out[1, 4 * i + u] = e[u], l[u]

    x = np.concatenate([np.linspace(-60, 60, 240), [-0.347, 0.0, 1e-9, 0.347]])
    out = np.zeros((2, x.size))
    both(x, out)
    np.testing.assert_allclose(out[0], np.exp(x), rtol=3e-15)
    np.testing.assert_allclose(out[1], np.log(out[0]), rtol=3e-15, atol=3e-16)


def test_scales_of_the_reference_gear():
    """E' = 206e9/0.91, a = sqrt(8 f R'/(pi E')) = 0.3622 mm, p_H = 2 f/(pi a) = 1.934 GPa; the unit of film a^2/R'."""
    s = Scales.of(scene("gear"))
    assert (s.a, s.p_H, s.h, s.t) == near((0.36216e-3, 1.93361e9, 12.3736e-6, 42.607e-6), 1e-4)
    ball = Scales.of(scene("ball-on-disc"))
    # E' = 2/(0.91/206e9 + (1 - 0.22^2)/75.06e9) = 117.0 GPa; a^3 = 1.5 F R/E'
    assert ball.E == near(116.991e9, 1e-5) and ball.a == near((1.5 * 38.35 * 12.7e-3 / 116.991e9) ** (1 / 3), 1e-5)
    assert ball.p_H == near(1.5 * 38.35 / math.pi / ball.a**2)
