"""Temperatures of a run that a window needs, which stores do not hold: kept in memory, or computed again step by step."""

import functools

from tehl_taichi.march.passage import march
from tehl_taichi.march.zoom.kept_states import HeatState

KEPT = 12  # newest states that are kept: a window needs two steps ahead and three back


class MarchedHeat:
    """The HeatStates of the run of `scene`, to be read in rising order; changes: of its surfaces by run-in; kept: its
    KeptStates or None."""

    def __init__(self, scene, changes=(), kept=None):
        self.march, self.kept = functools.partial(march, scene, changes=changes), kept
        self.known = kept.heats if kept else {}
        self.shots, self.states, self.newest = self.march(), {}, -1
        if kept and kept.start:
            self._begin_at(kept.start)

    def skip_to(self, step):
        """Continue from the kept state closest before this step; earlier steps (except the start) are no longer available."""
        state = self.kept.before(step) if self.kept and self.kept.start else None
        if state and int(state["step"]) > self.newest:
            self._begin_at(state)

    def holds(self, step):
        """Whether all states from this step on are in memory."""
        return max(step, 1) in self.known and (step > 0 or 0 in self.states)

    def at(self, step):
        """The HeatState of a step. Raises NotConverged if the repeated run does not converge."""
        if step in self.known:
            return self.known[step]
        while self.newest < step:
            self._advance()
        return self.states[step]

    def _begin_at(self, state):
        self.shots = self.march(state)
        self._keep(state)

    def _advance(self):
        self._keep(next(self.shots).state)
        self.states.pop(self.newest - KEPT, None)

    def _keep(self, state):
        self.newest = int(state["step"])
        self.states[self.newest] = HeatState.of(state)
