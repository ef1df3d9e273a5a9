"""Order of the linear solve: phases of jobs, as tables that the kernel of :mod:`solver` reads.

A job is (operation, number of a level or convolution, number of a block, pair of blocks or group of waves). A phase is a set of
jobs that can run in parallel, with a decision after the last one.
"""

import numpy as np

from tehl_taichi.engine.simd import W
from tehl_taichi.pressure.linear import red_black

# operations, see :mod:`operations`
(START, RESTRICT, LINES, ACROSS, DENSE, COLLECT, PROLONG, FINEST, FORWARD, BACK, ROWS, DOTS, UPDATE, FINISH, ONES, LIFT, GIVEN,
 COPY) = range(18)
# decisions, see :mod:`gmres`
ON, BEGIN, BORDER, PROJECT, EXTEND, EXTEND_AGAIN, LIFTED, END = range(8)
FIRST_JOB, JOBS, DECISION, LOOP, LEAVE = range(5)  # columns of the table of phases; LOOP, LEAVE: next phases after an
# iteration and at the end


class Program:
    """Tables of the phases and jobs; `solve`, `lift`, `apply`: first phases of the three programs.

    levels: :class:`tehl_taichi.pressure.levels.Levels`; shapes: list of the TransformSize of its convolutions, deflection
    first.
    """

    def __init__(self, levels, shapes):
        self.levels, self.shapes, self._jobs, self._phases = levels, shapes, [], []
        self.colours = levels.scene.numerics.sweep == red_black.SWEEP
        self.solve = self._solve()
        self.lift = self._lift()
        self.apply = self._apply()
        self.jobs, self.phases = np.array(self._jobs, np.int32), np.array(self._phases, np.int32)

    def _phase(self, jobs, decision=ON):
        """Add a phase; return its number."""
        first = len(self._jobs)
        self._jobs.extend(jobs)
        self._phases.append([first, len(self._jobs) - first, decision, 0, 0])
        return len(self._phases) - 1

    def _fine(self, operation, decision=ON):
        """Add a phase with a job for every block of the finest level; return its number."""
        return self._phase(self._blocks(operation, 0), decision)

    def _blocks(self, operation, l, name=None):
        """A job for every block of level l; name: number in the job in place of l."""
        return [(operation, l if name is None else name, s) for s in range(self.levels.sizes[l][1] // W + 1)]

    def _pairs(self, operation, *convolutions):
        """A job for every pair of blocks of the convolutions."""
        return [(operation, c, j) for c in convolutions for j in range(self.shapes[c].pairs)]

    def _groups(self, *convolutions):
        """A job for every group of waves of the convolutions."""
        return [(ACROSS, c, g) for c in convolutions for g in range(self.shapes[c].groups)]

    def _solve(self):
        """Add FGMRES, with a second projection if the first one cancels; return the first phase."""
        first = self._fine(START, BEGIN)
        loop = self._precondition(BORDER)
        self._deflected(FORWARD, PROJECT)
        again = [self._fine(UPDATE, EXTEND), self._fine(DOTS, PROJECT), self._fine(UPDATE, EXTEND_AGAIN)]
        leave = self._fine(FINISH, END)
        for n in again:
            self._phases[n][LOOP:] = loop, leave
        return first

    def _lift(self):
        """Add the preconditioner's answer to a change of H0; return the first phase."""
        first = self._fine(ONES)
        self._precondition(ON)
        self._fine(LIFT, LIFTED)
        return first

    def _apply(self):
        """Add the product of the Jacobian with a given change of the pressure; return the first phase."""
        first = self._deflected(GIVEN, ON)
        self._fine(COPY, END)
        return first

    def _precondition(self, decision):
        """Add the preconditioner, from RES of the finest level to COR; return the first phase."""
        first, sizes = len(self._phases), self.levels.sizes
        for l in range(len(sizes) - 1):
            self._phase([(RESTRICT, l, s) for _, _, s in self._blocks(RESTRICT, l + 1)])
        lines = range(1, len(self.shapes))
        finest = red_black.RED if self.colours else LINES
        self._phase(self._pairs(finest, 1) + self._pairs(LINES, *lines[1:]))
        self._phase([job for l in self.levels.dense for job in self._blocks(DENSE, l)] + self._groups(*lines))
        self._phase(self._pairs(COLLECT, *lines))
        for l in range(len(sizes) - 2, 0, -1):
            self._phase(self._blocks(PROLONG, l))
        self._phase(self._blocks(FINEST, 0, len(sizes) - 1), ON if self.colours else decision)
        if self.colours:
            self._second_colour(decision)
        return first

    def _second_colour(self, decision):
        """Add the lines of the second colour of the finest level, for the residual that the first colour leaves."""
        self._deflected(red_black.SPREAD, ON, red_black.BENT, red_black.LEFT)
        self._phase(self._pairs(red_black.BLACK, 1))
        self._phase(self._groups(1))
        self._phase(self._pairs(COLLECT, 1))
        self._fine(red_black.ADDED, decision)

    def _deflected(self, source, decision, back=BACK, rows=ROWS):
        """Add the product of the Jacobian with the change of pressure of `source`; return the first phase."""
        first = self._phase(self._pairs(source, 0))
        self._phase(self._groups(0))
        self._phase(self._pairs(back, 0))
        self._fine(rows, decision)
        return first
