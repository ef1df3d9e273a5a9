"""The pressure solver: exact deflection, steady films, order, balances, effort, reproducibility."""

import numpy as np
import pytest

from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

pytestmark = pytest.mark.usefixtures("taichi_cpu")


def steady(description):
    from tehl_taichi.simulation import march

    return next(march(description))


def moes(M, nx, x_min=-2.5):
    return scene("smooth-line").replace(**{"oil.name": "moes-test-fluid", "contact.load": 0.0, "contact.moes_M": M,
                                           "contact.moes_L": 10.0, "grid.nx": nx, "grid.x_min": x_min})


def test_influence_coefficients_against_quadrature():
    from tehl_taichi.solvers import influence

    nodes, weights = np.polynomial.legendre.leggauss(40)
    dx, dy = 0.1, 0.07
    x, y = 3 * dx + dx / 2 * nodes, 2 * dy + dy / 2 * nodes
    integral = dx * dy / 4 * np.sum(weights[:, None] * weights / np.hypot(x[:, None], y))
    assert influence.rectangle(4, 4, dx, dy, "line")[3, 2] == pytest.approx(integral / (2 * np.pi), rel=1e-12)
    integral = dx / 2 * np.sum(weights * np.log(x))
    assert influence.strip(4, dx)[3] == pytest.approx(-integral / np.pi, rel=1e-12)


def test_fft_deflection_is_the_direct_sum():
    from tehl_taichi.solvers import influence
    from tehl_taichi.solvers.transforms import Deflection

    nx, ny, dx, dy = 16, 8, 0.2, 0.15
    P, W = np.random.default_rng(1).random((1, 17 * 9)), np.zeros((1, 17 * 9))
    Deflection(nx, ny, dx, dy, "line").bound(P, 0, W)(0.25)
    K, k = influence.rectangle(nx, 2 * ny, dx, dy, "line"), influence.strip(nx, dx)
    p = P.reshape(9, 17)
    extra = p - p[-1]
    i = np.arange(17)
    direct = np.zeros((9, 17))
    for j in range(9):
        for q in range(-ny, ny + 1):
            direct[j] += K[np.abs(i[:, None] - i), abs(j - q)] @ extra[abs(q)]
        direct[j] += k[np.abs(i[:, None] - i)] @ p[-1]
    assert W.reshape(9, 17) == pytest.approx(direct + 0.25, abs=1e-13)


def unevenness(cells):
    """Largest difference of the gap under a Hertz pressure, which should be flat."""
    from tehl_taichi.solvers.transforms import Deflection

    x = np.linspace(-2, 2, cells + 1)
    W = np.zeros((1, cells + 1))
    Deflection(cells, 0, x[1] - x[0], 1.0, "line").bound(np.sqrt(np.maximum(1 - x**2, 0))[None], 0, W)()
    return np.ptp((W[0] + x**2 / 2)[np.abs(x) < 0.9])


def test_hertz_pressure_deflects_to_a_parabola():
    errors = [unevenness(cells) for cells in (512, 1024, 2048)]
    assert errors[1] < 5e-5 and np.log2(errors[1] / errors[2]) > 1.3 and np.log2(errors[0] / errors[1]) > 1.3


@pytest.mark.parametrize("inlet, film", [(-2.5, 0.4390e-6), (-4.5, 0.4409e-6)])
def test_steady_gear_film(inlet, film):
    s = steady(scene("smooth-line").replace(**{"grid.nx": 1024, "grid.x_min": inlet}))
    assert s.scalars["h_c_m"] == pytest.approx(film, rel=0.002)
    assert abs(s.scalars["h_c_m"] - film) < 2 * s.error["h_c_m"] + 1e-10
    assert 0.374e-6 < s.scalars["h_min_m"] < 0.383e-6
    assert s.scalars["load_error"] < 1e-6 and s.scalars["mass_error"] < 1e-6


@pytest.mark.parametrize("M, nx, inlet, h_c, h_min", [(20, 512, -4.5, 4.359, 3.774), (50, 1024, -2.5, 3.793, 3.365),
                                                      (100, 1024, -2.5, 3.428, 3.087), (200, 2048, -2.5, 3.095, 2.821)])
def test_moes_line_films(M, nx, inlet, h_c, h_min):
    description = moes(float(M), nx, inlet)
    s, units = steady(description), Scales.of(description)
    to_moes = 8 * M / np.pi / units.h
    assert s.scalars["h_c_m"] * to_moes == pytest.approx(h_c, rel=0.005)
    assert s.scalars["h_min_m"] * to_moes == pytest.approx(h_min, rel=0.015)


def test_second_order_in_space():
    films = [steady(scene("smooth-line").replace(**{"grid.nx": nx})).scalars["h_c_m"] for nx in (256, 512, 1024)]
    assert np.log2((films[1] - films[0]) / (films[2] - films[1])) > 1.9


def test_full_density_law():
    s = steady(scene("smooth-line").replace(**{"grid.nx": 1024, "grid.x_min": -2.0, "oil.expansion": "always"}))
    assert s.scalars["h_c_m"] == pytest.approx(0.4237e-6, rel=0.005)


def passage(**changes):
    from tehl_taichi.simulation import march

    return list(march(scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, **changes})))


def test_coarse_passage_conserves_and_leaves_the_steady_state_behind():
    steps = passage()
    assert min(s.scalars["h_min_m"] for s in steps) > 0
    for s in steps:
        assert s.scalars["load_error"] < 1e-6 and s.scalars["residual"] < 1e-6 and s.scalars["mass_error"] < 1e-6
    assert max(s.scalars["cycles"] for s in steps[1:]) < 80
    assert max(s.scalars["p_max_Pa"] for s in steps) > 1.5 * steps[0].scalars["p_max_Pa"]
    assert steps[-1].scalars["p_max_Pa"] == pytest.approx(steps[0].scalars["p_max_Pa"], rel=0.02)


def test_touching_asperity_never_goes_negative():
    steps = passage(height=3e-6)
    assert min(s.scalars["h_min_m"] for s in steps) > 0
    assert max(s.scalars["contact_load_fraction"] for s in steps) > 0
    assert all(s.scalars["residual"] < 1e-6 for s in steps)


def test_going_on_from_a_state_repeats_the_run():
    from tehl_taichi.simulation import march

    description = scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "time.steps": 12})
    whole = list(march(description))
    rest = list(march(description, whole[5].state))
    assert len(rest) == 7
    for name, values in rest[-1].fields.items():
        assert np.array_equal(values, whole[-1].fields[name])


def test_mirror_symmetry_of_friction():
    both = [passage(srr=srr, **{"time.steady_only": True})[0]
            for srr in (-0.12, 0.12)]
    assert np.allclose(both[0].fields["traction_x_a"], both[1].fields["traction_x_b"], rtol=1e-12, atol=1e-3)


@pytest.mark.slow
def test_isothermal_passage_at_the_default_grid():
    from tehl_taichi.simulation import march

    description = scene("gear")
    at = min(march(description), key=lambda s: abs(s.feature_x) if s.step else 1)
    assert at.scalars["p_max_Pa"] == pytest.approx(3.96e9, rel=0.015)
    assert at.scalars["h_min_m"] == pytest.approx(0.143e-6, rel=0.10)


@pytest.mark.slow
def test_second_order_in_time():
    from tehl_taichi.simulation import march

    ends = []
    for courant in (0.25, 0.125, 0.0625):
        description = scene("gear").replace(**{
            "grid.nx": 64, "grid.ny": 16, "time.courant": courant, "time.x_end": -0.6, "numerics.tolerance": 1e-9,
            "numerics.krylov_tolerance": 1e-3, "height": 0.5e-6, "width": 400e-6})
        ends.append(list(march(description))[-1].fields)
    for name in ("pressure", "film"):
        steps = [np.sqrt(np.mean((a[name] - b[name]) ** 2)) for a, b in zip(ends, ends[1:])]
        assert np.log2(steps[0] / steps[1]) > 1.9
