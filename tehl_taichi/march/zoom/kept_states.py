"""States of a march kept in memory: the temperatures of the newest steps, and a few whole states.

The march can be repeated from a kept state near a step, without the steps before it.
"""

from dataclasses import dataclass

import numpy as np

MOST, BYTES = 8, 1e8  # largest number and memory of the whole states (one thermal state of 257x65x9 nodes has 11 MB)
# largest memory of the temperatures. The window of the default exit (256x64x9 nodes) needs those of 69 steps, 199 MB; those of
# a whole passage have 560 MB. To march 69 steps again takes 6 of the 53 s of its windows
HEAT_BYTES = 1e9


@dataclass(frozen=True)
class HeatState:
    """Temperatures of one step: T (nodes across the film, ny+1, nx+1) deg C; memory (slots, ny+1, nx+1) of both bodies; offset
    (2,), distance that each body has moved, cells. T and memory have single precision, 1e-5 K."""

    T: np.ndarray
    memory: np.ndarray
    offset: np.ndarray

    @classmethod
    def of(cls, state):
        """The HeatState of a state (dict), or of its part that :meth:`tehl_taichi.heat.temperatures.FilmHeat.carried`
        returns."""
        T, memory, offset = (state[f"heat_{name}"] for name in cls.__dataclass_fields__)
        return cls(np.array(T, np.float32), np.array(memory, np.float32), np.array(offset))

    @property
    def bytes(self):
        """Memory of T and memory."""
        return self.T.nbytes + self.memory.nbytes


class KeptStates:
    """Whole states of :func:`tehl_taichi.march.passage.march` in rising order, at most MOST; the first one always stays.

    heats: {step: HeatState} of the newest steps.
    """

    def __init__(self, first):
        self.states, self.heats = [first], {}

    def add_heat(self, step, carried):
        """Keep the temperatures of a new step; drop the oldest ones beyond HEAT_BYTES."""
        self.heats[step] = newest = HeatState.of(carried)
        if len(self.heats) > HEAT_BYTES / newest.bytes:
            del self.heats[min(self.heats)]

    def add(self, state):
        """Keep a new state; drop every second one if there are too many."""
        self.states.append(state)
        size = sum(np.asarray(values).nbytes for values in state.values())
        if len(self.states) > min(MOST, max(1, int(BYTES / max(size, 1)))):
            del self.states[1::2]

    @property
    def start(self):
        """The state before the first step; None if the march did not begin there."""
        return self.states[0] if int(self.states[0]["step"]) == 0 else None

    def before(self, step):
        """The newest state at or before a step, or None."""
        return next((state for state in reversed(self.states) if int(state["step"]) <= step), None)
