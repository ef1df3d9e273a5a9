"""Shear on both surfaces: equilibrium of the film, Couette and Poiseuille parts, with temperatures, solid friction."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import V
from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march.passage import march
from tehl_taichi.march.solved_state import SolvedState
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.pressure.tractions import walls
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

NAMES = ("traction_x_a", "traction_y_a", "traction_x_b", "traction_y_b")


def touching(**changes):
    """The passage of a high asperity until it touches; what is kept of it holds no tables."""
    description = scene("touching-asperity").replace(**{"thermal.on": False, "rheology.law": "newtonian", "grid.nx": 64,
                                                        "grid.ny": 16, "grid.y_max": 1.25, "time.steps": 9, **changes})
    shots = [SimpleNamespace(x=s.x, y=s.y, fields=s.fields, scalars=s.scalars) for s in march(description)]
    return SimpleNamespace(scene=description, shots=shots)


@pytest.fixture(scope="module")
def slower(taichi_cpu):
    """Surface a is the slower one; friction of solid contact below the shear limit."""
    return touching(srr=-0.12, **{"rheology.mu_boundary": 0.05})


@pytest.fixture(scope="module")
def faster(taichi_cpu):
    """Surface a is the faster one; friction of solid contact at the shear limit."""
    return touching(srr=0.12, **{"rheology.mu_boundary": 0.3})


def parts(run, shot):
    """x, y slopes of the pressure (Pa/m) at the inner nodes by central differences, and the inner fields."""
    p, (dx, dy) = shot.fields["pressure"].astype(float), (np.diff(v)[0] for v in (shot.x, shot.y))
    inner = {key: value[1:-1, 1:-1].astype(float) for key, value in shot.fields.items()}
    return (p[2:, 1:-1] - p[:-2, 1:-1]) / (2 * dx), (p[1:-1, 2:] - p[1:-1, :-2]) / (2 * dy), inner


def viscosity(description, p, Gamma=90.0):
    """Roelands with temperature, by powers of ten."""
    oil = description.oil
    lg0 = -4.2 + oil.G0 * (1 + Gamma / 135) ** -oil.S0
    Z = oil.Dz + oil.Cz * np.log10(1 + Gamma / 135)
    return 10 ** (lg0 + (lg0 + 9.67 / math.log(10)) * ((1 + 5.1e-9 * p) ** Z - 1))


def test_the_film_is_in_equilibrium(slower):
    """What both surfaces feel together is what the pressure does to the film between them: -h dp/dx and -h dp/dy."""
    for shot in (slower.shots[0], slower.shots[3], slower.shots[-1]):
        p_x, p_y, f = parts(slower, shot)
        film = f["contact"] == 0
        for axis, slope in (("x", p_x), ("y", p_y)):
            both, needed = f[f"traction_{axis}_a"] + f[f"traction_{axis}_b"], -f["film"] * slope
            np.testing.assert_allclose(both[film], needed[film], rtol=1e-9, atol=1e-9 * np.abs(f["traction_x_a"]).max())
    assert np.abs(needed[film]).max() > 1e5  # 0.1 MPa: the shear of the asperity's own flow along y


def test_newtonian_shear_is_viscosity_times_slip_over_film(slower, faster):
    """Body a is dragged along by the faster surface, b held back: (tau_a - tau_b)/2 = -eta u_s/h wherever oil carries."""
    for run in (slower, faster):
        shot = run.shots[3]
        _, _, f = parts(run, shot)
        wet = (f["pressure"] > 0) & (f["contact"] == 0)
        mean = 0.5 * (f["traction_x_a"] - f["traction_x_b"])
        couette = -viscosity(run.scene, f["pressure"]) * run.scene.operation.u_s / f["film"]
        np.testing.assert_allclose(mean[wet], couette[wet], rtol=1e-9)
        assert mean[wet].min() > 0 if run is slower else mean[wet].max() < 0
        assert 0 < f["pressure"][wet].min() and wet.sum() > 200


def test_poiseuille_shear_is_the_same_on_both_surfaces(slower):
    """The flow that pressure drives leaves -(h/2) dp/dx on each surface; across, there is nothing else."""
    shot = slower.shots[3]
    p_x, p_y, f = parts(slower, shot)
    film = (f["pressure"] > 0) & (f["contact"] == 0)
    couette = -viscosity(slower.scene, f["pressure"]) * slower.scene.operation.u_s / f["film"]
    bulk = film & (couette < 1e6)  # elsewhere the difference of large numbers says little
    assert np.abs(p_x[bulk]).max() * f["film"].min() > 1e3
    for name, sign in (("traction_x_a", 1), ("traction_x_b", -1)):
        np.testing.assert_allclose((f[name] - sign * couette)[bulk], (-0.5 * f["film"] * p_x)[bulk], rtol=1e-6, atol=1e-3)
    for name in ("traction_y_a", "traction_y_b"):
        np.testing.assert_allclose(f[name][film], (-0.5 * f["film"] * p_y)[film], rtol=1e-9, atol=1e-6)
    assert np.abs(f["traction_y_a"][film]).max() > 1e5


def test_no_shear_across_on_the_plane_of_symmetry(slower):
    for shot in slower.shots:
        assert np.abs(shot.fields["traction_y_a"][:, 0]).max() == 0.0


def without_pressure_around(p):
    """Inner nodes without pressure at them and at their four neighbours."""
    out = np.zeros_like(p, bool)
    out[1:-1, 1:-1] = (p[2:, 1:-1] + p[:-2, 1:-1] + p[1:-1, 1:-1] + p[1:-1, 2:] + p[1:-1, :-2]) == 0
    return out


def test_a_ruptured_film_drags_nothing(slower):
    shot = slower.shots[3]
    dry = without_pressure_around(shot.fields["pressure"])
    assert dry.sum() > 50 and all(np.abs(shot.fields[name][dry]).max() == 0.0 for name in NAMES)


def test_solid_friction_is_the_boundary_coefficient_times_pressure(slower):
    """0.05 p, along the motion of the faster body b on a, against it on b."""
    f = slower.shots[-1].fields
    solid = f["contact"] > 0
    assert solid.sum() >= 1
    friction = 0.5 * (f["traction_x_a"] - f["traction_x_b"])[solid]
    np.testing.assert_allclose(friction, 0.05 * f["pressure"][solid], rtol=1e-9)


def test_solid_friction_stops_at_the_shear_limit(faster):
    """min(0.3 p, 10 MPa + 0.075 p), against the motion of the faster body a."""
    f = faster.shots[-1].fields
    solid = f["contact"] > 0
    assert solid.sum() >= 1 and f["pressure"][solid].min() > 45e6
    friction = 0.5 * (f["traction_x_a"] - f["traction_x_b"])[solid]
    np.testing.assert_allclose(friction, -(10e6 + 0.075 * f["pressure"][solid]), rtol=1e-9)


def test_friction_coefficient_is_the_mean_shear_force_over_the_load(slower):
    """int (tau_a - tau_b)/2 dx dy over f times the width: whole cells along x as the load counts them (the border's, too, which
    has a pressure), the trapezoid rule along y."""
    for shot in slower.shots:
        mean = 0.5 * (shot.fields["traction_x_a"] - shot.fields["traction_x_b"])
        per_width = np.trapezoid(mean, shot.y, axis=1).sum() * (shot.x[1] - shot.x[0]) / shot.y[-1]
        assert shot.scalars["friction_coefficient"] == pytest.approx(abs(per_width) / slower.scene.load, rel=1e-9)


def test_load_carried_by_solid_contact(slower):
    """int p over touching nodes over the whole load: the row y = 0 stands for half a cell."""
    shot = slower.shots[-1]
    carried = np.where(shot.fields["contact"] > 0, shot.fields["pressure"], 0.0)
    share = np.trapezoid(np.trapezoid(carried, shot.y, axis=1), shot.x) / shot.y[-1] / slower.scene.load
    assert shot.scalars["contact_load_fraction"] == pytest.approx(share, rel=1e-9) and share > 0
    area = np.trapezoid(np.trapezoid(shot.fields["contact"].astype(float), shot.y, axis=1), shot.x) / shot.y[-1]
    assert shot.scalars["contact_area_share"] == pytest.approx(area / (2 * Scales.of(slower.scene).a), rel=1e-9)
    assert shot.scalars["h_min_m"] == pytest.approx(5e-6 * Scales.of(slower.scene).h, rel=1e-6)  # the floor


def warm_film(srr, upside_down=False):
    """A pressure hill, a gap and a temperature profile, made, with solid contact at some nodes of high and of low pressure, on
    64 x 8 cells, and the tractions (4, ny+1, nx+1) of it."""
    description = scene("gear").replace(**{"thermal.on": True, "srr": srr, "grid.nx": 64, "grid.ny": 8})
    s = Scales.of(description)
    levels = Levels(description, 64, 8)
    X, Y = levels.X[None, :] + 0 * levels.Y[:, None], levels.Y[:, None] + 0 * levels.X[None, :]
    P, h = np.maximum(0.25 - 0.08 * (X + 0.3) ** 2 - 0.06 * Y**2, 0.0), 0.3e-6 * (1 + 0.2 * X**2 + 0.1 * Y**2)
    touch = ((np.abs(X) < 0.1) & (Y < 0.3)) | ((P > 0) & (P < 0.01))
    heat = FilmHeat(levels, 1e-6)
    z = heat.across.zeta[:, None, None]
    T = 90 + 60 * z**2 + 10 * z * (1 - z) * X
    for row, values in ((fields.P, P), (fields.H, h / s.h), (fields.TOUCH, touch.astype(float))):
        levels.put(row, values)
    heat.start(np.ascontiguousarray(T[::-1] if upside_down else T))
    stress = SolvedState(SimpleNamespace(levels=levels), heat, None, 0.0).stress
    wet, unit = P > 0, s.p_H / s.a
    return SimpleNamespace(scene=description, p=P * s.p_H, h=h, z=z, T=T, touch=touch, stress=stress,
                           slope=(-0.16 * (X + 0.3) * unit * wet, -0.12 * Y * unit * wet))


@pytest.fixture(scope="module")
def warm(taichi_cpu):
    return {srr: warm_film(srr) for srr in (-1e-5, -0.02, 0.3)}


def integral(z, values):
    """int_0^1 dz of values at Chebyshev-Lobatto nodes, by a polynomial through them."""
    series = np.polynomial.chebyshev
    rows = series.chebfit(2 * z.ravel() - 1, values.reshape(z.size, -1), z.size - 1)
    return (0.5 * series.chebval(1.0, series.chebint(rows, lbnd=-1, axis=0))).reshape(values.shape[1:])


@pytest.mark.parametrize("srr", [-1e-5, -0.02, 0.3])
def test_shear_of_a_film_with_temperatures(warm, srr):
    """tau(z) = tau_m + (z - z_c) dp/dx: tau_m by the limit of 10 MPa + 0.075 p from slip/int dz/eta, z_c the mean of z by
    1/eta, so -z_c h dp/dx on a and -(1 - z_c) h dp/dx on b, where the oil is hot."""
    f = warm[srr]
    fluidity = 1 / viscosity(f.scene, f.p, f.T)
    whole = integral(f.z, fluidity)
    centre = integral(f.z, f.z * fluidity) / whole
    tau = -f.scene.operation.u_s / (f.h * whole)
    tau = tau / np.sqrt(1 + (tau / (10e6 + 0.075 * f.p)) ** 2)
    (p_x, p_y), inner = f.slope, (f.p > 30e6) & ~f.touch
    inner[[0, -1]] = inner[:, [0, -1]] = False
    inner &= np.abs(p_x) > 0.06 * np.abs(p_x).max()  # at the top of the hill the slope is limited
    assert inner.sum() > 100 and centre[inner].min() > 0.6
    expected = (tau - centre * f.h * p_x, -centre * f.h * p_y, -tau - (1 - centre) * f.h * p_x, -(1 - centre) * f.h * p_y)
    for name, found, exact in zip(NAMES, f.stress, expected):
        np.testing.assert_allclose(found[inner], exact[inner], rtol=1e-4, atol=1e-4 * np.abs(exact[inner]).max(), err_msg=name)


@pytest.mark.parametrize("srr, sign", [(-0.02, 1), (0.3, -1)])
def test_solid_contact_keeps_its_friction_between_warm_films(warm, srr, sign):
    """0.3 p up to 10 MPa + 0.075 p, which it is from 44 MPa on; the shear of the film would be another."""
    f = warm[srr]
    solid = f.touch & (np.arange(f.p.shape[0]) < f.p.shape[0] - 1)[:, None]
    friction = 0.5 * (f.stress[0] - f.stress[2])[solid]
    np.testing.assert_allclose(friction, sign * np.minimum(0.3 * f.p, 10e6 + 0.075 * f.p)[solid], rtol=1e-9)
    assert (f.p[solid] < 40e6).any() and (f.p[solid] > 50e6).any()


def test_a_ruptured_warm_film_drags_nothing(warm):
    f = warm[0.3]
    dry = without_pressure_around(f.p)
    assert dry.sum() > 10 and np.abs(f.stress[:, dry]).max() == 0.0


def test_swapping_the_surfaces_turns_the_shear_round(warm):
    """The same film seen from body b: temperatures upside down and the other slip give the tractions of the other body."""
    one, other = warm[-0.02], warm_film(0.02, upside_down=True)
    film = ~one.touch
    np.testing.assert_allclose(other.stress[:2, film], one.stress[2:, film], rtol=1e-9, atol=1e-3)


@pytest.mark.parametrize("mean, half", [(0.3, 0.9), (-2.0, 0.4), (2.0, -0.7), (0.1, 0.2)])
def test_walls_at_their_limit_balance_the_pressure(taichi_cpu, mean, half):
    """What both carry together is the difference of the pressure, as long as one wall could carry its half."""
    found = np.zeros(4)

    @ti.kernel
    def put(out: ti.types.ndarray(dtype=ti.f64, ndim=1), mean: ti.f64, half: ti.f64):
        a_x, a_y, b_x, b_y = walls(V(mean), V(half), V(0.0), V(0.0), V(1.0))
        out[0], out[1], out[2], out[3] = a_x[0], a_y[0], b_x[0], b_y[0]

    put(found, mean, half)
    assert found[0] + found[2] == pytest.approx(-2 * half) and np.abs(found).max() <= 1 + 1e-12
    assert not found[[1, 3]].any()
