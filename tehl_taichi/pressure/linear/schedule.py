"""Order of the linear solve: phases of jobs, as tables that the kernel of :mod:`solver` reads.

A job is (operation, level or convolution, block, pair of blocks or group of waves); a phase is a number of jobs that may be
done at once, and what is decided when all are done.
"""

import numpy as np

from tehl_taichi.engine.simd import W
from tehl_taichi.pressure.linear import red_black

# operations, see :mod:`operations`
(START, RESTRICT, LINES, ACROSS, DENSE, COLLECT, PROLONG, FINEST, FORWARD, BACK, ROWS, DOTS, UPDATE, FINISH, ONES, LIFT, GIVEN,
 COPY) = range(18)
# decisions, see :mod:`gmres`
ON, BEGIN, BORDER, PROJECT, EXTEND, EXTEND_AGAIN, LIFTED, END = range(8)
FIRST_JOB, JOBS, DECISION, LOOP, LEAVE = range(5)  # columns of a phase; LOOP, LEAVE: the phases of a next iteration, of the end


class Program:
    """`phases` and `jobs`; `solve`, `lift`, `apply`: first phases of the three things that can be done.

    levels: see :class:`Levels`; shapes: of its convolutions, the deflection first.
    """

    def __init__(self, levels, shapes):
        self.levels, self.shapes, self._jobs, self._phases = levels, shapes, [], []
        self.colours = levels.scene.numerics.sweep == red_black.SWEEP
        self.solve = self._solve()
        self.lift = self._lift()
        self.apply = self._apply()
        self.jobs, self.phases = np.array(self._jobs, np.int32), np.array(self._phases, np.int32)

    def _phase(self, jobs, decision=ON):
        """Number of a new phase."""
        first = len(self._jobs)
        self._jobs.extend(jobs)
        self._phases.append([first, len(self._jobs) - first, decision, 0, 0])
        return len(self._phases) - 1

    def _fine(self, operation, decision=ON):
        return self._phase(self._blocks(operation, 0), decision)

    def _blocks(self, operation, l, name=None):
        """A job for every block of level l, called by that or by `name`."""
        return [(operation, l if name is None else name, s) for s in range(self.levels.sizes[l][1] // W + 1)]

    def _pairs(self, operation, *convolutions):
        """A job for every pair of blocks of the convolutions."""
        return [(operation, c, j) for c in convolutions for j in range(self.shapes[c].pairs)]

    def _groups(self, *convolutions):
        return [(ACROSS, c, g) for c in convolutions for g in range(self.shapes[c].groups)]

    def _solve(self):
        """FGMRES; the projection is repeated where it cancels."""
        first = self._fine(START, BEGIN)
        loop = self._precondition(BORDER)
        self._deflected(FORWARD, PROJECT)
        again = [self._fine(UPDATE, EXTEND), self._fine(DOTS, PROJECT), self._fine(UPDATE, EXTEND_AGAIN)]
        leave = self._fine(FINISH, END)
        for n in again:
            self._phases[n][LOOP:] = loop, leave
        return first

    def _lift(self):
        """Answer of the preconditioner to a change of H0."""
        first = self._fine(ONES)
        self._precondition(ON)
        self._fine(LIFT, LIFTED)
        return first

    def _apply(self):
        """Jacobian times a change of the pressure."""
        first = self._deflected(GIVEN, ON)
        self._fine(COPY, END)
        return first

    def _precondition(self, decision):
        """RES of the finest level -> COR. Returns the first phase."""
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
            red_black.second_colour(self, COLLECT, ON, decision)
        return first

    def _deflected(self, source, decision, back=BACK, rows=ROWS):
        """Change of the pressure -> rows of the Jacobian. Returns the first phase."""
        first = self._phase(self._pairs(source, 0))
        self._phase(self._groups(0))
        self._phase(self._pairs(back, 0))
        self._fine(rows, decision)
        return first
