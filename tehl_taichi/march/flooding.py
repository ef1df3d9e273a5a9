"""The border of a steady start takes the pressure of the oil beyond it, by turns with the film, until both agree."""

import numpy as np

from tehl_taichi.march.first_film import from_here, put
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.inlet import Inlet

# Of the reduced pressure at the border, which changes the film by its share of 1/alpha: far below what the formula is good for
AGREES = 1e-3
TURNS = 20  # at most; 2 to 5 are usual, the thickest films (M = 2, L = 20) take 8
LEAST, LARGEST = 0.2, 1.0  # of a turn's change
BETWEEN = 0.7  # of a change between blocks of temperatures
BLOCKS = 4  # of temperatures between which the border moves; 0.3^4 of a change are left
SHORTEST = 0.01  # part of a change that is tried where larger ones do not converge


def turns(solver, solve):
    """Function that solves with solve(solver), the first times after a turn without a check: between blocks of temperatures,
    which move the film more. Then the border rests, so that they can settle."""
    inlet, left = Inlet(solver.levels), iter(range(BLOCKS))

    def turn():
        if inlet.flooded and next(left, None) is not None:
            now = inlet.now()
            inlet.put(now + BETWEEN * (inlet.beyond() - now))
        return solve(solver)

    return turn


def flood(solver, report, solve=from_here):
    """From a steady film, whatever its border has, to that of a flooded inlet, by solve(solver) -> Report. Returns the Report
    of the last solve that converged, whose state is left in the table."""
    inlet = Inlet(solver.levels)
    if not (inlet.flooded and report.converged):
        return report
    part, before = LARGEST, None
    for _ in range(TURNS):
        now = inlet.now()
        miss = inlet.beyond() - now
        if np.abs(miss).max() <= AGREES * max(np.abs(now).max(), 1.0):
            break
        part = _part(part, before, miss)
        tried, part = _towards(solver, inlet, now, miss, part, solve)
        if not tried.converged:
            break
        report, before = tried.after([report]), miss
    return report


def _towards(solver, inlet, now, miss, part, solve):
    """The film of a border with `part` of the change, less where that does not converge. Returns the Report and the part."""
    kept = solver.levels.get(fields.P), solver.H0
    while True:
        inlet.put(now + part * miss)
        report = solve(solver)
        if report.converged or part < SHORTEST:
            break
        put(solver, *kept)
        part *= 0.3
    if not report.converged:
        put(solver, *kept)
        solver.residual()
    return report, part


def _part(part, before, miss):
    """Of the miss that the next turn takes away (Aitken)."""
    if before is None or not (step := miss - before).any():
        return part
    return float(np.clip(-part * (before @ step) / (step @ step), LEAST, LARGEST))
