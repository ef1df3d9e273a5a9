"""The energy equation against a manufactured solution: temperatures that solve it with a source made for them."""

import dataclasses

import numpy as np
import pytest

from tehl_taichi.heat import film_tables
from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.laws.conduction import conductivity, heat_capacity
from tehl_taichi.laws.density import expansivity, rho_film
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene import scene
from tehl_taichi.scene.sections import Rheology, Thermal

pytestmark = pytest.mark.usefixtures("taichi_cpu")

FILM = 0.3e-6  # m


def pressure(X, Y, t):
    """P/p_H, rising along x, even about both edges in y."""
    return 0.3 + 0.1 * np.sin(0.5 * X - 0.2 * t) + 0.02 * np.cos(np.pi * Y)


def thickness(X, Y, t):
    """h in m."""
    return FILM * (1 + 0.2 * np.sin(0.7 * X + 0.2 * t) + 0.1 * np.cos(np.pi * Y))


def warmth(X, Y, zeta, t):
    """deg C, rising along x."""
    return (90 + 8 * np.sin(0.4 * X - 0.2 * t) + 2 * np.cos(np.pi * Y) * (1 + 0.1 * X)
            + 20 * zeta * (1 - zeta) * (1 + 0.3 * np.sin(0.5 * X + 0.1 * t)) * (1 + 0.2 * np.cos(np.pi * Y)) + 3 * zeta)


class Exact:
    """The operator at X, Y of the manufactured state; derivatives by central differences with Richardson's extrapolation."""

    def __init__(self, heat, levels, X, Y):
        self.heat, self.levels, self.scene, self.s = heat, levels, levels.scene, levels.scales
        self.X, self.Y, self.zeta = X[None, None, :], Y[None, :, None], heat.across.zeta[:, None, None]
        self.time = self.s.a / self.s.u_m

    def derivative(self, f, axis, step=2e-3):
        """d/dX, d/dY or d/dt (axis 0, 1, 2) of f(X, Y, t) at t = 0."""
        def central(d):
            shift = [d if axis == k else 0.0 for k in range(3)]
            return (f(self.X + shift[0], self.Y + shift[1], shift[2])
                    - f(self.X - shift[0], self.Y - shift[1], -shift[2])) / (2 * d)

        return (4 * central(step / 2) - central(step)) / 3

    def column(self, X, Y, t):
        """(u, v, rho, 1/eta, int_0 rho (u, v, 1) h, stress of the Couette part, zeta_c, gradient) of Newtonian columns."""
        oil, o, s, C = self.scene.oil, self.scene.operation, self.s, self.heat.across.C
        p, h, T = pressure(X, Y, t) * s.p_H, thickness(X, Y, t), warmth(X, Y, self.zeta, t)
        slope = [s.p_H / s.a * d for d in (0.05 * np.cos(0.5 * X - 0.2 * t), -0.02 * np.pi * np.sin(np.pi * Y))]
        ie, rho = np.exp(-ln_eta(oil, p, T)), rho_film(oil, p, T)

        def below(values):
            return np.tensordot(C, values, axes=1)

        turn = below(ie)
        centre = below(self.zeta * ie)[-1] / turn[-1]
        flow = below((self.zeta - centre) * ie) * h**2
        u, v = o.u_a - o.u_s * turn / turn[-1] + flow * slope[0], flow * slope[1]
        fluxes = h * below(rho * u), h * below(rho * v), h * below(rho)
        return u, v, rho, ie, fluxes, -o.u_s / (h * turn[-1]), centre, slope

    def source(self):
        """What must be added to the energy equation, W/m3, (nz, ny+1, nx+1)."""
        oil, a, X, Y = self.scene.oil, self.s.a, self.X, self.Y
        u, v, rho, ie, fluxes, tau, centre, slope = self.column(X, Y, 0.0)
        P, h, T = pressure(X, Y, 0.0), thickness(X, Y, 0.0), warmth(X, Y, self.zeta, 0.0)
        rc, k = np.vectorize(lambda p, t: heat_capacity(oil, p, t))(P * self.s.p_H, T), conductivity(oil, P * self.s.p_H)
        scale = [1 / a, 1 / a, 1 / self.time]
        T_x, T_y, T_t = (self.derivative(lambda X, Y, t: warmth(X, Y, self.zeta, t), q) * scale[q] for q in range(3))
        p_x, p_y, p_t = (self.derivative(lambda X, Y, t: pressure(X, Y, t) * self.s.p_H, q) * scale[q] for q in range(3))
        leaving = -sum(self.derivative(lambda X, Y, t, q=q: self.column(X, Y, t)[4][q], q) * scale[q] for q in range(3))
        through = leaving - fluxes[2] / fluxes[2][-1] * leaving[-1]
        up, curved = np.tensordot(self.heat.across.D1, T, axes=1), np.tensordot(self.heat.across.D2, T, axes=1)
        lever = (self.zeta - centre) * h
        dissipated = ((tau + lever * slope[0]) ** 2 + (lever * slope[1]) ** 2) * ie
        squeezed = expansivity(oil, P * self.s.p_H, T) * (T + 273.15) * (p_t + u * p_x + v * p_y)
        fade = np.where(X > 0, P / (P + 1e-4), 1.0)
        return (rc * (T_t + u * T_x + v * T_y) + rc / rho * through / h * up - k / h**2 * curved
                - fade * (dissipated + squeezed)), rc


def solved(cells, courant=0.8):
    """Largest error (K) of one step from exact earlier states, with the exact walls."""
    base = scene("smooth-line").replace(**{"contact.hertz_pressure": 0.5e9, "speed": 2.0, "srr": -0.3, "grid.y_max": 1.0,
                                           "grid.x_min": -2.5})  # the cells of the waves, however thick the film
    description = dataclasses.replace(base, rheology=Rheology(law="newtonian"), thermal=Thermal(on=True))
    levels = Levels(description, 4 * cells, cells)
    s = levels.scales
    dt = courant * levels.dx
    heat = FilmHeat(levels, dt * s.a / s.u_m)
    exact = Exact(heat, levels, levels.X, levels.Y)
    heat.start()
    for past, (T, p, below) in ((1, (film_tables.TN, film_tables.PN, film_tables.MSN)),
                                (2, (film_tables.TNN, film_tables.PNN, film_tables.MSNN))):
        t = -past * dt
        heat.columns.put_nodes(T, warmth(exact.X, exact.Y, exact.zeta, t))
        heat.columns.put_single(p, pressure(exact.X, exact.Y, t)[0] * s.p_H)
        heat.columns.put_nodes(below, exact.column(exact.X, exact.Y, t)[4][2])
    levels.put(fields.P, pressure(exact.X, exact.Y, 0.0)[0])
    levels.put(fields.H, thickness(exact.X, exact.Y, 0.0)[0] / s.h)
    truth = warmth(exact.X, exact.Y, exact.zeta, 0.0)
    heat.set_temperature(truth)
    heat.values()  # what the pressure drives is the flow of these temperatures
    heat.dt_before = heat.dt
    heat.begin(heat.dt)
    heat.step.set(B_a=0.0, B_b=0.0, tolerance=1e-9)
    for slot, wall in ((film_tables.AA, 0), (film_tables.AB, -1)):
        heat.columns.put_single(slot, truth[wall])
    heat._velocities()
    heat._departures()
    source, rc = exact.source()
    heat.columns.put_nodes(film_tables.TS, heat.columns.nodes(film_tables.TS) + source / (rc * heat.step["rate"]))
    heat._energy()
    error = (heat.temperature() - truth)[:, :-2, 8:-8]
    return float(np.sqrt(np.mean(error**2)))


def test_second_order_in_space_and_time():
    errors = [solved(cells) for cells in (8, 16, 32)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[-1] < 2e-6 and (orders > 1.9).all(), (errors, orders)
