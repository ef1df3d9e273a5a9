"""Pseudo-transient start, if alternating pressure and temperature finds no steady state: both are marched in time together.

It starts from the temperatures of a coarser grid if they exist, else from cold oil. In the alternation, oil and bodies warm for
a sixth of the domain under a constant film: a thick one with a cold inlet overshoots by 30 to 80 K, alternating, or collapses.
In time it responds within a step. Stages (see :func:`march_to_rest`): the slip grows (at once it would heat cold oil by 200 K
in a step); blocks of steps until the temperatures settle, first without wall shear by pressure gradients, then with it; then
the steady equations. If the temperatures do not settle, the steps become shorter; if a step fails finally, everything is
repeated with a slower growth of the slip.
"""

import math

import numpy as np

from tehl_taichi.heat.energy import LIGHT
from tehl_taichi.march.alternating_start import FLUTTER, LONGEST_RUN, SETTLED, remaining_change
from tehl_taichi.march.coupling import carefully, exchange
from tehl_taichi.march.isothermal_start import put, solve_again
from tehl_taichi.march.substeps import Substeps
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.storage_term import Storage

# Transits of the domain by the slower surface: of the growing slip, and of the second attempt, in which the film thins in step
# with it (gear at 20 deg C, SRR -0.12, 256 columns: within half a transit cold thick oil is heated by 180 K, and no step
# converges any more; within two it rests, after 1000 steps); of a block
ONSETS, BLOCK = (0.5, 2.0), 0.25
BLOCKS, MOST_STEPS = 40, 4000  # at most; scenes that rest do so after 4 to 18 blocks, the gear at 50 m/s after more than 24
# Of a step, which is then taken in parts: with 32, flank C, B+, mineral-vg320, 40 deg C does not come to rest on 32 columns
ROUNDS = 8
ON_THE_WAY = 8  # blocks at most with walls that carry all: by those, thick films of cold oil flutter at the outlet for ever
# K, and blocks after which that is at rest: the outlet of cold thick films flutters without an end (gear, 20 deg C, SRR -0.12,
# 192 columns: runs of the last fifteen blocks differ by 0.07 to 2 K; by the last one alone, 1.1, it was no state)
STILL, PATIENT = 0.3, 30
# Of a step. Frozen oil that slips along one wall moves with the other one: by whole cells a step if that is the faster surface.
# Strips of molten and frozen oil, a cell wide, then pass on for ever (flank C, mineral-vg320, B+, 256 columns: 20 K from node
# to node and from step to step, blocks differ by 1.4 K). Between nodes they are interpolated, and end within three blocks
SHORTER = 0.7


def march_to_rest(solver, heat, P, H0, T=None, finest=True):
    """March to steady state from the isothermal P and H0 and the temperatures T of a coarser grid; without those, or if that
    fails on the finest grid, from a cold film and cold bodies.

    Returns the SolveReport of the steady pressure. converged = False if the temperatures do not settle: then the newest state
    in time is left, and heat.report.change (K) is the difference of its last two blocks, inf without any.
    """
    for onset in _ways(T is not None, finest):
        put(solver, P, H0)
        heat.start(None if onset else T)
        together = PseudoTransient(solver, heat)
        if onset:
            together.slip_in(onset)
            together.rest(walls=0.0, most=ON_THE_WAY)
        change, most = together.settled()
        if not (change < most or together.lost):
            together.shorten()
            change, most = together.settled()
        if not together.lost:
            break
    return _judged(together, change, most)


def _ways(warm, finest):
    """Growth times of the slip to try in order, in transits; 0: from the temperatures of a coarser grid. A coarser grid, needed
    only for an error and a start, has one.
    """
    cold = ONSETS if finest else ONSETS[: 1 - warm]
    return (0.0, *cold) if warm else cold


def check(solver, heat):
    """March one block from a settled state. Returns the SolveReport of the steady pressure; converged = False if the block
    changes the temperatures by more than FLUTTER.
    """
    heat.bodies.steady = True
    together = PseudoTransient(solver, heat)
    together.mean = heat.T
    return _judged(together, together.checked(), FLUTTER)


def _judged(together, change, most):
    heat, report = together.heat, together.report
    if not (change < most and heat.sound):
        report.converged, heat.report.change = False, change
    heat.bodies.warm_resting()
    together.levels.numbers.strain(1.0)
    return report


class PseudoTransient:
    """Time march of a smooth contact, from the pressure in the solver's table and the state of `heat`.

    On the way its walls carry any shear by pressure gradients: a smooth contact has little of it, but the oil that accumulates
    in a start at 20 deg C yields under pressure differences of GPa per cell. report: of the last solve; lost: a step failed
    finally; held: columns without a solution kept the temperatures of the oil that came in, in a step of the last block; mean:
    temperatures of that block.
    """

    def __init__(self, solver, heat):
        self.solver, self.heat, self.levels = solver, heat, solver.levels
        self.parts, self.lost, self.held, self.P = Substeps(), False, False, solver.levels.get(fields.P)
        speeds = [body.speed for body in heat.bodies.each if body.speed]
        self.dt = self.levels.dx * self.levels.scales.a / max(speeds)  # s: a cell of the faster surface
        self.transit = self.levels.nx * max(speeds) / min(speeds)  # steps
        self.levels.set_film(solver.H0)
        heat.values()
        self.storage = Storage(self.levels)

    def slip_in(self, onset):
        """Let the slip grow from zero within `onset` transits."""
        self.levels.numbers.strain(0.0)
        whole, steps = self.levels.conditions["u_s"], min(math.ceil(onset * self.transit), MOST_STEPS // 4)
        for n in range(steps):
            self._slip(whole, (n + 1) / steps)
            self._step()
        self._slip(whole, 1.0)
        self.storage.centre()

    def _slip(self, whole, part):
        self.levels.conditions.set(u_s=part * whole)
        self.levels.numbers.slip(part)

    def rest(self, walls=1.0, most=None):
        """March blocks of steps with this part of the wall shear by pressure gradients, until series of them differ by less
        than SETTLED, after PATIENT blocks by less than STILL, or until `most` blocks. Returns the last difference (K), see
        :func:`tehl_taichi.march.alternating_start.remaining_change`.
        """
        self.mean, change = self.heat.T, math.inf
        means = [self.mean]
        for n in range(min(most or BLOCKS, MOST_STEPS // self._block_steps)):
            self.block(walls)
            if self.lost:  # what it reached before is a state in time
                break
            means = [self.mean, *means[: 2 * LONGEST_RUN - 1]]
            change = remaining_change(means, self.P > LIGHT)
            if change < (SETTLED if n < PATIENT else STILL) and self.heat.sound and not self.held:
                break
        return change

    def settled(self):
        """March blocks until they settle, then check. Returns (last difference in K, its limit)."""
        change = self.rest()
        if change < STILL and not self.lost:
            return self.checked(), FLUTTER
        return change, 0.0

    def shorten(self):
        """Use shorter steps from now on, in which no surface moves whole cells."""
        self.dt, self.transit = SHORTER * self.dt, self.transit / SHORTER

    def checked(self):
        """Solve the steady pressure, march a block of steps, solve the steady pressure again. Returns the change by the block,
        K.
        """
        self.at_rest()
        change = self.block() if self.report.converged else math.inf
        if not self.lost:
            self.at_rest()
        return change

    @property
    def _block_steps(self):
        return math.ceil(BLOCK * self.transit)

    def block(self, walls=1.0):
        """March a block of steps with this part of the wall shear by pressure gradients. Returns the change of the mean
        temperatures under load, K; inf if a step failed finally or has held columns.
        """
        self.levels.numbers.strain(walls)
        before, total, self.held = self.mean, 0.0, False
        for _ in range(self._block_steps):
            self._step()
            total = total + self.heat.T
        self.storage.centre()
        self.mean = total / self._block_steps
        return math.inf if self.lost or self.held else float(np.abs(self.mean - before).max(axis=0)[self.P > LIGHT].max())

    def at_rest(self):
        """Solve the steady equations at the temperatures of the film."""
        self.levels.numbers.strain(1.0)
        self.levels.numbers.set_rate(0.0)
        self.levels.put(fields.QOLD, 0.0)
        self.report = solve_again(self.solver)

    def _step(self):
        """Compute one step, in parts if it does not converge, and at last with a few columns held.

        Cold oil at the outlet, heated by the growing slip, has some without a solution (gear at 20 deg C, SRR -0.12, on 160 and
        192 columns).
        """
        done = 0.0
        while done < 1.0 and not self.lost:
            part = self.parts.next(done)
            if self._try(part * self.dt):
                done += part
                self.parts.accept(part)
            else:
                self.lost = not (self.parts.reject(part) or self.parts.hold(self.heat))

    def _try(self, dt):
        """Accept the state dt s later if it converged, else keep the last one. Returns whether it converged."""
        v, dT, H0 = self.levels, dt / self.levels.scales.t, self.solver.H0
        self.storage.begin(dT)
        self.heat.begin(dt)
        self.report = exchange(self.solver, self.heat, lambda: carefully(self.solver, self.P), ROUNDS)
        if self.report.converged:
            self.storage.accept(dT)
            self.held |= self.heat.holding
            self.heat.accept()
            self.P = v.get(fields.P)
        else:
            put(self.solver, self.P, H0)
            self.heat.set_temperature(self.heat.T)
        return self.report.converged
