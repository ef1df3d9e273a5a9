"""Start values of the next state: pressure, rigid approach and temperatures, extrapolated in time."""

import numpy as np

from tehl_taichi.heat.extrapolation import TemperatureExtrapolation
from tehl_taichi.march.extrapolation import StateExtrapolation, extrapolated

ORDER = 3  # of the extrapolation in time of the pressure


class Prediction:
    """Prediction of the state in the tables of `solver` and `heat` (or None), with the features moved by `at` cells; state:
    that a run continues from, with what :meth:`state` gave in it, or of a start."""

    def __init__(self, solver, heat, at, state):
        self.solver, self.heat = solver, heat
        self.pressure = StateExtrapolation(solver.levels, ORDER, at, state)
        self.heights = list(state.get("H0_history", [float(state["H0"])]))  # at the positions of the pressure
        self.temperature = TemperatureExtrapolation(heat, at, state) if heat else None

    def put(self, at):
        """The guess for the state with the features at `at` into the tables."""
        self.pressure.put(at)
        self.solver.H0 = extrapolated(self.heights[: ORDER + 1], self.pressure.at, at)
        if self.heat:
            self.temperature.put(at)

    def accept(self, at):
        """The state in the tables, with the features at `at`, is the newest; call it before `heat` accepts that."""
        self.pressure.accept(at)
        self.heights = [self.solver.H0, *self.heights[:ORDER]]
        if self.heat:
            self.temperature.accept(at)

    def state(self):
        """Arrays to continue from."""
        return {**self.pressure.state(), "H0_history": np.array(self.heights),
                **(self.temperature.state() if self.heat else {})}
