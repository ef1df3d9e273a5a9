"""States of a march kept in memory: the newest ones of its temperatures, and some whole ones, so that it can be followed again
from near a step without the steps before."""

from dataclasses import dataclass

import numpy as np

# Of whole states, and of their memory (a thermal one has 11 MB at 257x65x9); of that of the temperatures. To march a run of
# 128x32x9 once more beside its windows takes 4.5 of their 50 s; its 193 states have 281 MB
MOST, BYTES, HEAT_BYTES = 8, 1e8, 3e8


@dataclass(frozen=True)
class HeatState:
    """T (nodes across, ny+1, nx+1) deg C; memory (slots, ny+1, nx+1) of both bodies and the cells that each has moved."""

    T: np.ndarray
    memory: np.ndarray
    offset: np.ndarray

    @classmethod
    def of(cls, state):
        """HeatState of a state, or of its part that :meth:`tehl_taichi.heat.temperatures.FilmHeat.carried` gives."""
        return cls(*(np.array(state[f"heat_{name}"]) for name in cls.__dataclass_fields__))

    @property
    def bytes(self):
        """Size of both arrays."""
        return self.T.nbytes + self.memory.nbytes


class KeptStates:
    """States of :func:`tehl_taichi.march.passage.march` in rising order; the first one stays, the others thin out. heats:
    {step: HeatState} of the newest steps."""

    def __init__(self, first):
        self.states, self.heats = [first], {}

    def add_heat(self, step, carried):
        """Temperatures of one more step, that are not kept for longer than there is room."""
        self.heats[step] = newest = HeatState.of(carried)
        if len(self.heats) > HEAT_BYTES / newest.bytes:
            del self.heats[min(self.heats)]

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
