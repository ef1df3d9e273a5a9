"""States of a march kept in memory, so that it can be followed again from near a step without the steps before."""

import numpy as np

MOST, BYTES = 8, 3e8  # of them, and of memory in all; a thermal one has 11 MB at 257x65x9


class KeptStates:
    """States of :func:`tehl_taichi.march.passage.march` in rising order; the first one stays, the others thin out."""

    def __init__(self, first):
        self.states = [first]

    def add(self, state):
        """One more."""
        self.states.append(state)
        size = sum(np.asarray(values).nbytes for values in state.values())
        if len(self.states) > min(MOST, max(1, int(BYTES / max(size, 1)))):
            del self.states[1::2]

    @property
    def start(self):
        """The state before the first step; None where the march was not followed from there."""
        return self.states[0] if int(self.states[0]["step"]) == 0 else None

    def before(self, step):
        """The newest state at or before a step, None where there is none."""
        return next((state for state in reversed(self.states) if int(state["step"]) <= step), None)
