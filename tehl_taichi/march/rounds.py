"""Pressure and temperatures of one time step: rounds of both, until another one would not move the temperatures."""

import math

from tehl_taichi.march.first_film import put

RETRY_KRYLOV = 3e-3  # of a solve that failed: ten times tighter
SLUGGISH = 0.2  # rounds that leave more of the last change are relaxed; usual is 0.01 to 0.1


def exchange(solver, heat, solve, most=None, sparing=False):
    """Rounds until another one would change the temperatures by less than thermal.tolerance; solve() -> Report of the pressure;
    at most `most` of them (thermal.rounds).
    Storage and heat have begun the step. Returns a Report with the work of all rounds, converged = False without success.

    The first round takes one Newton step only: its pressure belongs to guessed temperatures anyway. sparing: later rounds take
    over what hardly changes. Not for a start, where a state of cold oil, with eddies in its inlet, is told from none by what is
    left over after blocks of steps: gear at 20 deg C, SRR -0.12, 64 columns, rested with 1.6 K instead of 0.05.
    """
    thermal, newton, cycles, change = solver.levels.scene.thermal, 0, 0, math.inf
    for turn in range(most or thermal.rounds):
        first = turn == 0 and thermal.rounds > 1
        report = solver.improve(sparing) if first else solve()
        newton, cycles = newton + report.newton, cycles + report.cycles
        if not (first or report.converged):
            break
        told, before = heat.solve(again=sparing and turn > 0), change
        change = told.change
        if thermal.rounds > 1:  # they contract: the next one changes about as much less as this one did
            told.change *= min(change / before, 1.0)
        settled = told.change < thermal.tolerance and not told.failed
        if not first and (settled or thermal.rounds == 1):
            break
        if change > SLUGGISH * before:
            heat.relax()
    else:
        report.converged = False
    report.newton, report.cycles = newton, cycles
    return report


def carefully(solver, P):
    """The pressure of a step; where it does not converge at once, again from P, the last one accepted, with more care.
    Returns a Report with the work of both."""
    H0, report = solver.H0, solver.solve()
    if not report.converged:
        put(solver, P, H0)
        failed, report = report, solver.solve(RETRY_KRYLOV, newton_max=2 * solver.levels.scene.numerics.newton_max)
        report.newton, report.cycles = report.newton + failed.newton, report.cycles + failed.cycles
    return report
