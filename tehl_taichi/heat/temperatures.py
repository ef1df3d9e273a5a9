"""Temperatures of the film and of both bodies: the energy equation, a step at a time.

A step: velocities from the generalised Reynolds solution, where the oil of each node came from, then one implicit system
per column that holds conduction, both heat sources and both walls (T_s = A + B q of the bodies).
"""

import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi.engine import lanes, tables
from tehl_taichi.engine.launches import Carriers, bind
from tehl_taichi.heat import bodies, energy, film, modes, paths, slots, step
from tehl_taichi.heat.across import chebyshev
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.storage import bdf

KEPT = 2 * modes.MODES + 2  # slots of the bodies that go on to the next step
COLUMN_TOLERANCE = 0.1  # of the tolerance of a round
COLUMN_ITERATIONS = 12  # Newton steps of a column; 2 are usual, 6 to 8 the most seen
LEAST_SHARE = 0.2  # of a round's change that is taken


@dataclass
class HeatReport:
    """change: largest difference from the last iterate (K), or the one that is expected of another round; failed: columns that
    did not converge; clamped: nodes held inside the allowed range."""

    change: float
    failed: int
    clamped: int


def _fill(table, numbers):
    """Set the entries of a table of one row by {name: number}."""
    table[0, list(numbers)] = list(numbers.values())


class FilmHeat:
    """Temperatures on the finest grid of `levels`.

    laws: launches of its density and viscosity and of their slopes, for :meth:`Levels.use_film`. dt_s: the time step (s) that
    the memory of the bodies is made for; shorter ones may be taken too.
    """

    # of the state, (..., ny+1, nx+1)
    FIELDS = ("heat_T", "heat_T_before", "heat_below", "heat_below_before", "heat_p_before", "heat_memory")

    def __init__(self, levels, dt_s):
        scene, self.levels = levels.scene, levels
        self.nz, self.dt = scene.thermal.nodes, dt_s
        self.columns = levels.fine * (levels.nx + 1)
        self.Z = tables.lease(self, 0, lanes.W, self.columns, slots.KINDS * self.nz + slots.SINGLES)
        self.F = tables.lease(self, 0, lanes.W, self.columns, 4 * modes.MODES + 5)
        self.tiles = levels.fine * (levels.nx // lanes.TILE + 1)
        self.X = tables.lease(self, 0, lanes.W, self.tiles, self.nz * (self.nz + 2))
        self.zeta, self.C, self.D1, self.D2 = chebyshev(self.nz)
        self.weights = np.ascontiguousarray(self.C[-1])
        self.single = slots.KINDS * self.nz
        self._carriers = Carriers()
        self.offset = np.zeros(2)  # cells that each body has moved since the start
        self.dt_before = 0.0
        self.report = HeatReport(math.nan, 0, 0)
        self._bind(scene)
        self._bind_bodies()

    def _bind(self, scene):
        v, s, o = self.levels, self.levels.scales, scene.operation
        self.inlet, self.steady = o.temperature, False
        self.resting = scene.at_rest
        self.speeds = [0.0 if rest else u for rest, u in zip(self.resting, (o.u_a, o.u_b))]
        bodies = scene.body_a, scene.body_b
        self.effusivities = [math.sqrt(b.k * b.rho * b.c) for b in bodies]
        self.depths = [modes.REST * s.a / math.sqrt(b.k / (b.rho * b.c) * self.dt) if rest else math.inf
                       for rest, b in zip(self.resting, bodies)]
        table, laws = (v.S, self.Z, v.G), (self.nz, scene.oil, scene.rheology)
        nested = np.ascontiguousarray(self.weights[:, None] * self.C)
        args = (*table, nested, self.weights, self.zeta, *laws, s.p_H, s.h, v.ln_eta0, o.u_a, -o.u_s, o.u_m)
        self.laws = bind(film.laws, *args, 0), bind(film.laws, *args, 1)
        self._velocities = bind(film.velocities, *table, self.C, self.weights, self.zeta, *laws, s.p_H, s.h, s.a, v.ln_eta0,
                                o.u_a, -o.u_s)
        self.scale, self.step_numbers = np.zeros((1, step.SCENE_NUMBERS)), np.zeros((1, step.STEP_NUMBERS))
        _fill(self.scale, {step.P_HERTZ: s.p_H, step.H_HERTZ: s.h, step.A_HERTZ: s.a, step.LN_ETA0: v.ln_eta0,
                           step.SLIP: -o.u_s, step.INLET: self.inlet, step.CENTRE: np.searchsorted(v.X, 0.0)})
        self.partial = np.zeros((self.tiles, 3))
        self._energy = bind(energy.energy, v.S, self.Z, self.X, v.G, self.weights, self.zeta, self.D1, self.D2, *laws,
                            self.scale, self.step_numbers, self.partial)
        self._departures = bind(paths.departures, v.S, self.Z, v.G, self.nz, s.p_H, self.inlet, self.step_numbers)
        self._accept = bind(paths.accept, *table, self.nz, s.p_H)

    def _bind_bodies(self):
        G, count, inlet = self.levels.G, modes.MODES, self.inlet
        self.modes = [np.zeros((5, count)) for _ in (0, 1)]
        self._surface = [bind(bodies.surface, self.F, self.Z, G, self.modes[body], count, body, inlet,
                              self.single + (slots.AA, slots.AB)[body]) for body in (0, 1)]
        self._remember = [bind(bodies.remember, self.F, self.Z, G, self.modes[body], count, body,
                               self.single + (slots.QA, slots.QB)[body]) for body in (0, 1)]
        self._adopt = bind(bodies.adopt, self.F, G, count)

    def start(self, T=None):
        """Everything at the inlet temperature, or the film at T; the pressure and film in the table count as those of the last
        step. Until :meth:`warm_resting`, surfaces at rest conduct as after a long time."""
        v, self.steady = self.levels, True
        self.set_temperature(np.full((self.nz, v.ny + 1, v.nx + 1), self.inlet) if T is None else T)
        v.laws()
        self._velocities()
        self._accept()
        self.T = self.temperature()

    def begin(self, dt):
        """Prepare a step of dt s: what the bodies remember, A and B of both surfaces."""
        v, a, B, self.dt_now = self.levels, self.levels.scales.a, [0.0, 0.0], dt
        self.overshoot, self.share = None, 1.0
        self.until = self.offset + np.array(self.speeds) * dt / (v.dx * a)
        for body in (0, 1):
            depth = self.depths[body]
            self.modes[body][:4], B[body], last = modes.memory(dt, self.effusivities[body], self.dt, depth)
            self.modes[body][4, :3] = *self._position(body), last
            if self.steady and self.resting[body]:
                weight, decay = self.modes[body][:2]
                B[body] += last + float((weight * decay) @ modes.steady_modes(self.dt, depth))
            self._surface[body]()
        rate, (near, *far) = bdf([dt, self.dt_before] if self.dt_before else [dt])
        _fill(self.step_numbers, {
            step.RATE: rate, step.INV_X: 1 / (v.dx * a), step.INV_Y: 1 / (v.dy * a), step.B_A: B[0], step.B_B: B[1],
            step.TOLERANCE: COLUMN_TOLERANCE * v.scene.thermal.tolerance, step.ITERATIONS: COLUMN_ITERATIONS,
            step.BACK: dt, step.BACK_2: dt + self.dt_before, step.NEAR: near, step.FAR: sum(far)})

    def _position(self, body):
        """Whole cells that the grid overtakes material strips of the body by in this step, and where they lie then."""
        before, after = math.floor(self.offset[body] + 1e-9), math.floor(self.until[body] + 1e-9)
        return after - before, max(self.until[body] - after, 0.0)

    def solve(self):
        """Temperatures of this step for the pressure and film in the table. Returns a HeatReport."""
        self._velocities()
        self._departures()
        self._energy()
        changes = self.partial.max(axis=0)[0], *self.partial.sum(axis=0)[1:]
        self.report = HeatReport(float(changes[0]), int(changes[1]), int(changes[2]))
        return self.report

    def relax(self):
        """Take less of what the last round changed, where rounds overshoot each other (at the outlet): Aitken's relaxation,
        from the changes of the last two rounds."""
        before = self.slots(slots.LAST * self.nz, self.nz)
        change = self.temperature() - before
        if self.overshoot is not None:
            bend = change - self.overshoot
            share = -self.share * float(np.vdot(self.overshoot, bend) / np.vdot(bend, bend))
            self.share = min(max(share, LEAST_SHARE), 1.0)
        self.overshoot = change
        self.set_temperature(before + self.share * change)

    def accept(self):
        """Make this step the last one."""
        for remember, rest in zip(self._remember, self.resting):
            if not (rest and self.steady):
                remember()
        self._adopt()
        self.offset, self.dt_before = self.until, self.dt_now
        self._velocities()
        self._accept()
        self.T = self.temperature()

    def warm_resting(self):
        """Give the bodies whose surfaces rest the memory of a long time with the present heat."""
        self.steady, memory = False, self.memory()
        for body, flux in enumerate((slots.QA, slots.QB)):
            if self.resting[body]:
                memory[2 * modes.MODES + body] = self.single_slot(flux)
                settled = modes.steady_modes(self.dt, self.depths[body])[:, None, None]
                memory[body * modes.MODES : (body + 1) * modes.MODES] = settled * self.single_slot(flux)
        slots.put_slots(self.F, self.levels.G, 0, KEPT, memory)

    def state(self):
        """All that is needed to go on, as arrays."""
        return {"heat_T": self.T, "heat_T_before": self.slots(slots.TNN * self.nz, self.nz),
                "heat_below": self.slots(slots.MSN * self.nz, self.nz),
                "heat_below_before": self.slots(slots.MSNN * self.nz, self.nz),
                "heat_p_before": self.slots(self.single + slots.PNN, 1), "heat_memory": self.memory(),
                "heat_offset": self.offset, "heat_dt_before": self.dt_before}

    def restore(self, state):
        """Go on from a state; the pressure of the last step must be in the table."""
        G, v = self.levels.G, self.levels
        for first in (slots.T, slots.TN):
            slots.put_slots(self.Z, G, first * self.nz, self.nz, np.ascontiguousarray(state["heat_T"]))
        for first, name in ((slots.TNN, "heat_T_before"), (slots.MSN, "heat_below"), (slots.MSNN, "heat_below_before")):
            slots.put_slots(self.Z, G, first * self.nz, self.nz, np.ascontiguousarray(state[name]))
        slots.put_slots(self.Z, G, self.single + slots.PN, 1, v.get(fields.P)[None] * v.scales.p_H)
        slots.put_slots(self.Z, G, self.single + slots.PNN, 1, np.ascontiguousarray(state["heat_p_before"]))
        slots.put_slots(self.F, G, 0, KEPT, np.ascontiguousarray(state["heat_memory"]))
        self.offset, self.T = np.array(state["heat_offset"]), np.array(state["heat_T"])
        self.dt_before = float(state["heat_dt_before"])

    def memory(self):
        """Modes of both bodies and the last flux into them, (KEPT, ny+1, nx+1)."""
        return self._carry(slots.get_slots, self.F, 0, KEPT).copy()

    def slots(self, first, count):
        """Slots as an array (count, ny+1, nx+1)."""
        return self._carry(slots.get_slots, self.Z, first, count).copy()

    def _carry(self, kernel, table, first, count, values=None):
        """Launch a kernel between slots and an array. Returns the array."""
        v = self.levels
        return self._carriers.carry((kernel, table is self.Z, first, count), (count, v.ny + 1, v.nx + 1),
                                    lambda array: bind(kernel, table, v.G, first, count, array), values)

    def single_slot(self, slot):
        """One of the single slots, (ny+1, nx+1)."""
        return self.slots(self.single + slot, 1)[0]

    def temperature(self):
        """(nz, ny+1, nx+1) deg C, from body a to body b."""
        return self.slots(slots.T * self.nz, self.nz)

    def set_temperature(self, values):
        """Start value of the next solve, (nz, ny+1, nx+1)."""
        self._carry(slots.put_slots, self.Z, slots.T * self.nz, self.nz, values)

    def shear(self):
        """Shear stress (Pa) at z = 0 along x, y and at z = h along x, y: (4, ny+1, nx+1)."""
        return self.slots(self.single + slots.XA, 4)
