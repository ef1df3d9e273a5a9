"""Prediction of the next state: pressure, rigid approach and temperatures, extrapolated in time."""

import numpy as np

from tehl_taichi.heat.extrapolation import TemperatureExtrapolation
from tehl_taichi.march.extrapolation import StateExtrapolation, extrapolated

ORDER = 3  # of the extrapolation in time of the pressure


class Prediction:
    """Prediction for the tables of `solver` and `heat` (or None); at: cells that the features have moved; state: to continue
    from, with the result of :meth:`state`, or of a start.
    """

    def __init__(self, solver, heat, at, state):
        self.solver, self.heat = solver, heat
        self.pressure = StateExtrapolation(solver.levels, ORDER, at, state)
        self.heights = list(state.get("H0_history", [float(state["H0"])]))  # at the positions of the pressure
        self.temperature = TemperatureExtrapolation(heat, at, state) if heat else None

    def put(self, at):
        """Write the prediction for feature position `at` into the tables."""
        self.pressure.put(at)
        self.solver.H0 = extrapolated(self.heights[: ORDER + 1], self.pressure.at, at)
        if self.heat:
            self.temperature.put(at)

    def accept(self, at):
        """Take the state in the tables, with the features at `at`, as the newest; call it before `heat` accepts that state."""
        self.pressure.accept(at)
        self.heights = [self.solver.H0, *self.heights[:ORDER]]
        if self.heat:
            self.temperature.accept(at)

    def state(self):
        """Arrays to continue from."""
        return {**self.pressure.state(), "H0_history": np.array(self.heights),
                **(self.temperature.state() if self.heat else {})}
