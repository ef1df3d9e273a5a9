"""Pressure at the border during a steady start: it follows the film in isothermal solves, and changes between blocks of
temperatures.
"""

import itertools
from dataclasses import replace

from tehl_taichi.march.isothermal_start import put, solve_again, solve_from_table
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.inlet import Inlet

# Of a change between blocks of temperatures: beside a gap of two films the oil beyond answers with as large an opposite one
BETWEEN = 0.5
FIRST, LAST = 2, 10  # block from which on the border moves (temperatures are far off before), and rests so that they can settle
# Of the load, by which grid and oil beyond together may miss it, where that oil would carry more than half of it (beside an
# ellipse of 0.2 GPa at 10 m/s 7 times it), or a solve with the rest failed. Bars contain twice as much; a half leaves none
UNSHARED = 0.5


def border_of(levels):
    """The Inlet of a flooded scene; None for a starved one."""
    inlet = Inlet(levels)
    return inlet if inlet.flooded else None


def share_load(solver, report):
    """Solve again with the load that the oil beyond the border leaves to the grid. Returns the SolveReport of all solves.

    After a start, whose way from the Hertz pressure is delicate: of 15 starts with slip and a feature at rest 13 converged
    where that load followed each Newton step, 15 so.
    """
    kept, solver.shares = _state(solver), True
    if not (report.converged and solver.share_load()):
        return report
    return _kept_or_better(solver, report, kept, solve_from_table(solver))


def _state(solver):
    """(P, H0, load that the grid carries) of the state in the table."""
    return solver.levels.get(fields.P), solver.H0, solver.load


def _kept_or_better(solver, report, kept, again):
    """SolveReport of both solves if the second converged; else put the state of the first, `kept`, back, and return its
    report.
    """
    if again.converged:
        return again.after([report])
    *start, solver.load = kept
    put(solver, *start)
    solver.residual()
    return report


def with_whole_load(solver, report):
    """SolveReport whose load error counts all oil beyond the border; unconverged if that is more than UNSHARED."""
    if not report.converged:
        return report
    carried = solver.load * (1 + report.load_error) + Inlet(solver.levels).load()
    error = carried / solver.levels.scales.load - 1
    return replace(report, load_error=error, converged=abs(error) < UNSHARED)


def between_blocks(solver, border):
    """Function that solves the pressure after a block of temperatures; after some blocks it also updates the border."""
    blocks = itertools.count()

    def solve():
        if border is not None and FIRST <= next(blocks) < LAST:
            border.move(BETWEEN)
            solver.share_load()
        return solve_again(solver)

    return solve


def iterate_border(solver, border, report):
    """Iterate film and border to agreement at constant temperatures. Returns the SolveReport of the last converged solve, whose
    state is in the table.
    """
    if border is None or not report.converged:
        return report
    kept = _state(solver)
    if border.agrees() and not solver.share_load():
        return report
    solver.border = border
    moved, solver.border = solve_again(solver), None
    return _kept_or_better(solver, report, kept, moved)
