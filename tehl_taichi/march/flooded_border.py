"""The border of a steady start: it follows the film within isothermal solves, and moves between blocks of temperatures."""

import itertools

from tehl_taichi.march.isothermal_start import again, put
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.inlet import Inlet

# Of a change between blocks of temperatures: beside a gap of two films the oil beyond answers with as large an opposite one
BETWEEN = 0.5
FIRST, LAST = 2, 10  # block from which on the border moves (temperatures are far off before), and rests so that they can settle


def border_of(levels):
    """The Inlet of a flooded scene; None of a starved one."""
    inlet = Inlet(levels)
    return inlet if inlet.flooded else None


def between_blocks(solver, border):
    """Function that solves the pressure after a block of temperatures, after some of them with another border."""
    blocks = itertools.count()

    def solve():
        if border is not None and FIRST <= next(blocks) < LAST:
            border.move(BETWEEN)
        return again(solver)

    return solve


def agreed(solver, border, report):
    """From a steady film to that whose border agrees, at the same temperatures. Returns the SolveReport of the last solve that
    converged, whose state is left in the table."""
    if border is None or not report.converged or border.agrees():
        return report
    kept, solver.border = (solver.levels.get(fields.P), solver.H0), border
    moved, solver.border = again(solver), None
    if moved.converged:
        return moved.after([report])
    put(solver, *kept)
    solver.residual()
    return report
