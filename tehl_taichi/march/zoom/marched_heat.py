"""Temperatures of a run, computed again step by step: stores do not hold what a window needs of them."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.march.passage import march

KEPT = 12  # newest states; a window looks two steps ahead and three back


@dataclass(frozen=True)
class HeatState:
    """T (nodes across, ny+1, nx+1) deg C; memory (slots, ny+1, nx+1) of both bodies and the cells that each has moved."""

    T: np.ndarray
    memory: np.ndarray
    offset: np.ndarray


class MarchedHeat:
    """The HeatState of a step of the run of `scene`, in rising order; changes: of its surfaces by run-in."""

    def __init__(self, scene, changes=()):
        self.shots, self.states, self.newest = march(scene, changes=changes), {}, -1

    def at(self, step):
        """The HeatState of a step, of the newest ones. Raises NotConverged where the run does."""
        while self.newest < step:
            self._advance()
        return self.states[step]

    def _advance(self):
        state, self.newest = next(self.shots).state, self.newest + 1
        self.states[self.newest] = HeatState(*(np.array(state[f"heat_{name}"]) for name in ("T", "memory", "offset")))
        self.states.pop(self.newest - KEPT, None)
