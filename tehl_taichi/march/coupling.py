"""Coupling of pressure and temperatures in one time step: rounds of both until the temperatures no longer change."""

import math

from tehl_taichi.march.isothermal_start import put
from tehl_taichi.pressure.newton import SMALL_CHANGE

RETRY_KRYLOV = 3e-3  # of a solve that failed: ten times tighter
# Temperatures of a few columns may have no end: in a frozen film of 30 nm under 6 GPa the hot layer is at one wall in one round
# and at the other in the next, whatever share of the change is taken, until the step is shorter. So after the first SURELY
# rounds those are given up that have had no smaller change for WITHIN. A step in parts interpolates the film once more and
# changes what follows (gear, SRR -0.12, one such step in 192: largest pressure by 0.4 %), so 16 rather than 8: temperature
# solves and rejected attempts of that passage 494, 1 -> 489, 0, of two ground surfaces across (Ra 0.3 um, SRR 0.12, 256x64x9,
# 45 steps) 393, 6 -> 400, 3 (32: 426, 3), of five other passages the same
SURELY, WITHIN = 16, 4
# While temperatures change by more (K) a pressure is solved for to the residual ROUGH only: it belongs to none of them. And
# where the first Newton step is large (SMALL_CHANGE), Newton continues to this residual before the first temperature solve.
# Newton steps and rounds a step with 12 K and 3e-4, 5 K and 3e-4, 1 K and 2e-4: passage of the gear's asperity on 256x64x9 at
# SRR 0.12 3.22/2.63, 3.16/2.63, 3.12/2.67, at -0.12 3.08/2.38, 3.01/2.45, 2.96/2.58, of a ridge on 128x8 3.43/2.25, 3.40/2.33,
# 3.30/2.69; at the exit of a window four times as fine 7.9/4.4, 6.9/4.4, 6.7/4.2 (1e-4 7.2/4.2; 1e-3 and 3 K 8.1/5.5)
FAR = 1.0
ROUGH = 2e-4


def exchange(solver, heat, solve, most=math.inf, sparing=False):
    """Alternate pressure (solve() -> SolveReport) and temperatures until a further round would change them by less than
    thermal.tolerance.

    most: number of rounds, if less than thermal.rounds. Storage and heat must have begun the step. Returns a SolveReport with
    the work of all rounds, converged = False without success. The first round takes only one Newton step, because its
    temperatures are guesses. sparing: while temperatures are far off, later rounds solve roughly and reuse slowly changing
    data. Not for a start, where the state of cold oil, with eddies in its inlet, is only apparent from the remainders of blocks
    of steps: gear at 20 deg C, SRR -0.12, 64 columns, then settled with 1.6 K instead of 0.05.
    """
    thermal, work, changes = solver.levels.scene.thermal, [], [math.inf]
    alternates = thermal.rounds > 1
    for turn in range(min(most, thermal.rounds)):
        first, before = turn == 0 and alternates, changes[-1]
        reports, rough = _pressure(solver, solve, first, sparing, sparing and alternates and before > FAR)
        work += reports
        if not (rough or work[-1].converged):
            break
        step = heat.solve(again=sparing and turn > 0)
        changes.append(change := step.change)
        if alternates:  # they contract: the next one changes about as much less as this one did
            step.change *= min(change / before, 1.0)
        settled = step.change < thermal.tolerance and not (step.failed or rough)
        if not first and (settled or not alternates):
            break
        if not step.failed and _endless(changes[1:]):
            work[-1].converged = False
            break
        if not first:
            heat.relax()
    else:
        work[-1].converged = False
    return work[-1].after(work[:-1])


def _endless(changes):
    """Whether rounds of temperatures with these changes (K) do not converge."""
    return len(changes) >= SURELY and min(changes[-WITHIN:]) >= min(changes[:-WITHIN])


def _pressure(solver, solve, first, sparing, far):
    """Pressure of a round: reports of its solves, and whether it is a rough one because temperatures are still far off."""
    work = [solver.improve(sparing)] if first else []
    if far and not (first and (solver.change < SMALL_CHANGE or work[0].residual < ROUGH)):
        work.append(solver.solve(enough=ROUGH))
    if first or (work and work[-1].residual < ROUGH):
        return work, not work[-1].converged
    return [*work, solve()], False


def carefully(solver, P):
    """Solve the pressure of a step; if it does not converge, again from the last accepted P with a safer method. Returns a
    SolveReport with the work of both.
    """
    H0, report = solver.H0, solver.solve()
    if report.converged:
        return report
    put(solver, P, H0)
    again = solver.solve(RETRY_KRYLOV, newton_max=2 * solver.levels.scene.numerics.newton_max)
    return again.after([report])
