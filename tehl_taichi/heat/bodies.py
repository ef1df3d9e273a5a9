"""Surface temperatures of both bodies, T_s = A + B q: A from the heat of earlier steps, B q from that of the present step."""

import math

import numpy as np

from tehl_taichi.engine.records import Record
from tehl_taichi.engine.taichi_patches.prebound import bind
from tehl_taichi.heat import conduction_modes, film_tables, strips
from tehl_taichi.heat.heat_step import Drift
from tehl_taichi.scene.scales import Scales, peclet


class ConductingBody:
    """One body: its material, the motion of its surface, its memory of heat in a step."""

    def __init__(self, material, speed, rests, dt, scales):
        """material: a Body of the scene; speed: of its surface, m/s; rests: the surface is at rest; dt: time step for which the
        memory is made, s; scales: of the contact.
        """
        self.rests, self.speed, self.dt = rests, 0.0 if rests else speed, dt
        self.effusivity = math.sqrt(material.k * material.rho * material.c)
        diffusivity, slab = material.k / (material.rho * material.c), rests and scales.line
        self.depth = conduction_modes.REST * scales.a / math.sqrt(diffusivity * dt) if slab else math.inf
        pe = 0.0 if rests else peclet(material, speed, scales)
        sideways = not (scales.line or conduction_modes.is_fast(pe, scales.a, scales.b))
        wide = conduction_modes.widths(pe, scales.a, scales.b) if sideways else conduction_modes.NONE
        self.spread = tuple(w * w / (4 * diffusivity * dt) for w in wide)
        self.modes, self.drift = np.zeros((4, conduction_modes.MODES)), Record(Drift)

    def begin(self, dt, before, after, settled):
        """Prepare a step of dt s in which the surface moves from `before` to `after`, in cells. Returns B.

        settled: the body has the memory of a long time with the flux of this step.
        """
        known = conduction_modes.memory(dt, self.effusivity, self.dt, self.depth, self.spread)
        for row, values in ((strips.WEIGHT, known.weight), (strips.DECAY, known.decay), (strips.GAIN, known.gain),
                            (strips.GAIN_LAST, known.gain_last)):
            self.modes[row] = values
        whole, now = math.floor(before + 1e-9), math.floor(after + 1e-9)
        self.drift.set(shift=now - whole, rest=max(after - now, 0.0), B_last=known.B_last)
        if not settled:
            return known.B
        return known.B + (known.B_last + float((known.weight * known.decay) @ self.settled()))

    def like(self, other):
        """Whether another ConductingBody has the same temperatures under the same heat."""
        return all(getattr(self, name) == getattr(other, name) for name in ("speed", "rests", "effusivity", "depth", "spread"))

    def settled(self):
        """Modes after a long time, per unit flux."""
        return conduction_modes.steady_modes(self.dt, self.depth, self.spread)


class ConductingBodies:
    """Both bodies below the columns of a film.

    dt: time step (s) for which their memory is made; shorter steps are possible. steady: surfaces at rest conduct as after a
    long time, until :meth:`warm_resting`.
    """

    def __init__(self, levels, columns, dt):
        scene = levels.scene
        self.levels, self.columns, self.steady = levels, columns, False
        speeds = scene.operation.u_a, scene.operation.u_b
        self.each = [ConductingBody(*one, dt, Scales.of(scene))  # of the contact, also where the grid is a window of it
                     for one in zip((scene.body_a, scene.body_b), speeds, scene.at_rest)]
        self.table = film_tables.SlotTable(levels, strips.width(conduction_modes.MODES))
        self.offset = self.until = np.zeros(2)  # cells that each body has moved since the start, and will have
        self._bind(scene.operation.temperature)

    def _bind(self, inlet):
        F, C, G, count = self.table.field, self.columns.singles.field, self.levels.G, conduction_modes.MODES
        known, flux = (film_tables.AA, film_tables.AB), (film_tables.QA, film_tables.QB)
        self._surface = [bind(strips.surface, F, C, G, body.modes, body.drift.values, count, n, inlet, known[n])
                         for n, body in enumerate(self.each)]
        self._remember = [bind(strips.remember, F, C, G, body.modes, body.drift.values, count, n, flux[n])
                          for n, body in enumerate(self.each)]

    def begin(self, dt, moved=0):
        """Write A of both surfaces after a step of dt s, in which the grid moves by `moved` cells, into the columns. Returns B
        of both.
        """
        v = self.levels
        self.until = self.offset + np.array([body.speed for body in self.each]) * dt / (v.dx * v.scales.a) - moved
        B = [body.begin(dt, *way, self.steady and body.rests) for body, *way in zip(self.each, self.offset, self.until)]
        for surface in self._surface:
            surface()
        return B

    def accept(self):
        """Store the flux of this step as that of the last step."""
        for body, remember in zip(self.each, self._remember):
            if not (body.rests and self.steady):
                remember()
        self.offset = self.until

    def warm_resting(self):
        """Give bodies with a surface at rest the memory of a long time with the present heat."""
        self.steady, memory = False, self.memory()
        for n, (body, flux) in enumerate(zip(self.each, (film_tables.QA, film_tables.QB))):
            if body.rests:
                present = self.columns.single(flux)
                first, last_flux = strips.memory(conduction_modes.MODES, n)
                memory[first : first + conduction_modes.MODES] = body.settled()[:, None, None] * present
                memory[last_flux] = present
        self.restore(memory, self.offset)

    def cool(self):
        """Reset all heat to zero."""
        v = self.levels
        self.restore(np.zeros((strips.kept(conduction_modes.MODES), v.ny + 1, v.nx + 1)), np.zeros(2))

    def memory(self):
        """Modes of both bodies and the last flux into them, (slots, ny+1, nx+1)."""
        return self.table.get(0, strips.kept(conduction_modes.MODES))

    def restore(self, memory, offset):
        """Restore the result of :meth:`memory`; offset: cells that each body has moved since the start."""
        self.table.put(0, memory)
        self.offset = np.array(offset)
