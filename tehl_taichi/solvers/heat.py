"""Temperatures of the film and of both bodies: the energy equation, a step at a time.

A step: velocities from the generalised Reynolds solution, where the oil of each node came from, then one implicit system
per column that holds conduction, both heat sources and both walls (T_s = A + B q of the bodies).
"""

import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi import runtime
from tehl_taichi.kernels import film, lanes
from tehl_taichi.kernels import solids as solid_kernels
from tehl_taichi.runtime import bind
from tehl_taichi.solvers import solids

COLUMN_ITERATIONS = 12  # Newton steps of a column; 2 are usual, 6 to 8 the most seen


@dataclass
class HeatReport:
    """change: largest difference from the last iterate (K); failed: columns that did not converge; clamped: nodes held
    inside the allowed range."""

    change: float
    failed: int
    clamped: int


def chebyshev(count):
    """(nodes on [0, 1], integrals from 0 to each node (n, n), first and second derivative matrices) of Chebyshev-Lobatto
    collocation with `count` nodes."""
    from numpy.polynomial import chebyshev as series

    x = -np.cos(np.pi * np.arange(count) / (count - 1))
    sign = (-1.0) ** np.arange(count) * np.where((np.arange(count) % (count - 1)) == 0, 2.0, 1.0)
    distance = x[:, None] - x[None, :] + np.eye(count)
    D = np.outer(sign, 1 / sign) / distance
    D -= np.diag(D.sum(axis=1))
    integral = np.stack([series.chebval(x, series.chebint(row, lbnd=-1)) for row in np.eye(count)], axis=1)
    C = 0.5 * integral @ np.linalg.inv(series.chebvander(x, count - 1))
    return 0.5 * (x + 1), C, 2 * D, 4 * D @ D


class FilmHeat:
    """Temperatures on the finest grid of `levels`, whose laws it takes over.

    dt_s: the time step (s) that the memory of the bodies is made for; shorter ones may be taken too.
    """

    def __init__(self, levels, dt_s):
        scene, self.levels = levels.scene, levels
        self.nz, self.dt = scene.thermal.nodes, dt_s
        self.columns = levels.fine * (levels.nx + 1)
        slots = 12 * self.nz + film.SINGLES
        self.Z = runtime.lease(self, 0, lanes.W, self.columns, slots)
        self.F = runtime.lease(self, 0, lanes.W, self.columns, 4 * solids.MODES + 1)
        self.X = runtime.lease(self, 0, lanes.W, levels.fine, self.nz * (self.nz + 1))
        self.zeta, self.C, self.D1, self.D2 = chebyshev(self.nz)
        self.single = 12 * self.nz
        self.offset = np.zeros(2)  # cells that each body has moved since the start
        self.still = False
        self._bind(scene)

    def _bind(self, scene):
        v, s, o = self.levels, self.levels.scales, scene.operation
        self.inlet, self.speeds = o.temperature, (o.u_a, o.u_b)
        self.effusivities = [math.sqrt(b.k * b.rho * b.c) for b in (scene.body_a, scene.body_b)]
        table, nodes = (v.S, self.Z, v.G), (self.C, self.zeta, self.nz, scene.oil, scene.rheology)
        args = (*table, *nodes, s.p_H, s.h, v.ln_eta0, v.inv_lambda, o.u_a, -o.u_s, o.u_m)
        v.use_film(bind(film.laws, *args), bind(film.slopes, *args))
        self._velocities = bind(film.velocities, *table, *nodes, s.p_H, s.h, s.a, v.ln_eta0, o.u_a, -o.u_s)
        centre = float(np.searchsorted(v.X, 0.0))
        self.scale = np.array([[s.p_H, s.h, s.a, v.ln_eta0, -o.u_s, self.inlet, centre]])
        self.step_numbers, self.partial = np.zeros((1, 7)), np.zeros((v.fine, 3))
        self._energy = bind(film.energy, v.S, self.Z, self.X, v.G, self.C, self.zeta, self.D1, self.D2, self.nz, scene.oil,
                            scene.rheology, self.scale, self.step_numbers, self.partial)
        self._accept = bind(film.accept, *table, self.nz, s.p_H)

    def start(self):
        """Everything at the inlet temperature; the pressure and film in the table count as those of the last step."""
        v = self.levels
        self.set_temperature(np.full((self.nz, v.ny + 1, v.nx + 1), self.inlet))
        for body in (0, 1):
            film.put_slots(self.Z, v.G, self.single + (film.AA, film.AB)[body], 1,
                           np.full((1, v.ny + 1, v.nx + 1), self.inlet))
        v.laws()
        self._velocities()
        self._accept()

    def begin(self, dt, part=1.0):
        """Prepare a step of dt s: what the bodies remember, A and B of both surfaces."""
        v, cells = self.levels, np.array(self.speeds) * dt / (v_dx(self.levels))
        self.until = self.offset + cells
        self.dt_now, B = dt, []
        for body in (0, 1):
            modes, b = solids.memory(dt, self.effusivities[body], self.dt)
            shift, rest = self._position(body)
            solid_kernels.surface(self.F, self.Z, v.G, modes, solids.MODES, body, shift, rest, self.inlet,
                                  self.single + (film.AA, film.AB)[body])
            B.append(b)
        a = v.scales.a
        rate = 0.0 if self.still else 1 / dt
        self.step_numbers[0] = [1 / dt, 1 / (v.dx * a), 1 / (v.dy * a), *B, 0.0, COLUMN_ITERATIONS]
        self.step_numbers[0, 5] = 0.1 * v.scene.thermal.tolerance
        del rate

    def _position(self, body):
        """Whole cells that the grid overtakes material strips of the body by in this step, and where they lie then."""
        before, after = math.floor(self.offset[body] + 1e-9), math.floor(self.until[body] + 1e-9)
        return after - before, max(self.until[body] - after, 0.0)

    def solve(self):
        """Temperatures of this step for the pressure and film in the table. Returns a HeatReport."""
        v, s = self.levels, self.levels.scales
        self._velocities()
        film.departures(v.S, self.Z, v.G, self.nz, s.p_H, self.dt_now / (v.dx * s.a), self.dt_now / (v.dy * s.a), self.inlet)
        self._energy()
        return HeatReport(float(self.partial[:, 0].max()), int(self.partial[:, 1].sum()), int(self.partial[:, 2].sum()))

    def accept(self):
        """Make this step the last one."""
        v = self.levels
        for body in (0, 1):
            modes, _ = solids.memory(self.dt_now, self.effusivities[body], self.dt)
            shift, rest = self._position(body)
            solid_kernels.remember(self.F, self.Z, v.G, modes, solids.MODES, body, shift, rest,
                                   self.single + (film.QA, film.QB)[body])
        solid_kernels.adopt(self.F, v.G, solids.MODES)
        self.offset = self.until
        self._velocities()
        self._accept()

    def slots(self, first, count):
        """Slots as an array (count, ny+1, nx+1)."""
        v = self.levels
        out = np.zeros((count, v.ny + 1, v.nx + 1))
        film.get_slots(self.Z, v.G, first, count, out)
        return out

    def single_slot(self, slot):
        """One of the single slots, (ny+1, nx+1)."""
        return self.slots(self.single + slot, 1)[0]

    def temperature(self):
        """(nz, ny+1, nx+1) deg C, from body a to body b."""
        return self.slots(film.T * self.nz, self.nz)

    def set_temperature(self, values):
        """Start value of the next solve, (nz, ny+1, nx+1)."""
        film.put_slots(self.Z, self.levels.G, film.T * self.nz, self.nz, np.ascontiguousarray(values))

    def shear(self):
        """Shear stress (Pa) at z = 0 along x, y and at z = h along x, y: (4, ny+1, nx+1)."""
        return self.slots(self.single + film.XA, 4)


def v_dx(levels):
    return levels.dx * levels.scales.a
