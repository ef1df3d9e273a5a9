"""Temperatures of a window: solved inside, those of the run along its border.

The bodies move through the window. Where they enter it, their memory of heat is that of the run.
"""

import numpy as np

from tehl_taichi.heat import conduction_modes, strips
from tehl_taichi.heat.chebyshev import largest
from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march.zoom.two_frames import TwoFrames

WHOLE = 1e-9  # cells: smaller differences from a whole number count as zero
HOTTER = 20.0  # K: largest rise above the last state in a guess
ORDER = 3  # order of the extrapolation in time


class WindowHeat:
    """Temperatures of a window; its attribute `film` is a :class:`tehl_taichi.heat.temperatures.FilmHeat`.

    base: :class:`tehl_taichi.march.zoom.base_states.BaseStates` of the run. levels: the WindowLevels. refining(first, columns):
    the Refining from the run to the window's rows and these fine columns. given: mask (ny+1, nx+1) of the nodes of the border.
    dt: step of the run, s.
    """

    def __init__(self, base, levels, refining, given, dt):
        self.base, self.window, self.refining, self.given = base, levels.window, refining, given
        self.film, self.origin = FilmHeat(levels, dt, given=True), 0
        self.run = None  # temperatures of the run at the nodes of the window
        walls_and_middle = [0, self.film.nz // 2, -1]
        self.guess = TwoFrames(ORDER, refining(0, self.window.all_nx + 1).smooth(base.at(0).T, 4), walls_and_middle)

    def take_over(self, step, origin, at):
        """Take the temperatures of the run at a step; origin: first fine column; at: place of the feature, fine columns."""
        state, self.origin = self.base.heat.at(step), origin
        offset = self.window.factor * state.offset
        T = self._fine(state.T, origin)
        self.film.continue_from(T, self._memory(state, origin), offset - np.floor(offset + WHOLE))
        self.guess.accept(self.film.T.astype(np.float32), T, origin, at)

    def begin(self, T, origin, at, dt):
        """Prepare a step of dt (s) to a moment with the run's temperatures T, the first column `origin` and the feature
        `at`."""
        self.film.begin(dt, origin - self.origin)
        self.run = self._fine(T, origin)
        lowest, highest = float(self.film.T.min()), float(self.film.T.max()) + HOTTER
        guess = np.clip(self.guess.next(self.run, origin, at), lowest, highest)
        self.film.set_temperature(np.where(self.given, self.run, guess))

    def accept(self, origin, at):
        """Accept the step: it becomes the last one."""
        self.film.accept()
        self.guess.accept(self.film.T.astype(np.float32), self.run, origin, at)
        self.origin = origin

    def refresh(self, step):
        """Set the memory of the bodies along the border to that of the run at this step."""
        bodies = self.film.bodies
        memory = bodies.memory()
        np.copyto(memory, self._memory(self.base.heat.at(step), self.origin), where=self.given)
        bodies.restore(memory, bodies.offset)

    def fields(self):
        """{name: (ny+1, nx+1) deg C} of the newest state."""
        T = self.film.T
        return {"temperature_mid": T[len(T) // 2], "temperature_a": T[0], "temperature_b": T[-1]}

    def _fine(self, T, origin):
        return self.refining(origin, self.window.nx + 1).smooth(T, 4)

    def _memory(self, state, origin):
        """Memory (slots, ny+1, nx+1) of the bodies of a HeatState at the strips of the window.

        Strip i of the run is strip factor i + `ahead` of the fine grid.
        """
        factor, count = self.window.factor, conduction_modes.MODES
        whole = np.floor(factor * state.offset + WHOLE) - factor * np.floor(state.offset + WHOLE)
        out = np.empty((len(state.memory), *self.given.shape), state.memory.dtype)
        for body, ahead in enumerate(whole.astype(int)):
            first, flux = strips.memory(count, body)
            fine = self.refining(origin - ahead, self.window.nx + 1)
            for slots in (slice(first, first + count), slice(flux, flux + 1)):
                out[slots] = fine.smooth(state.memory[slots], 4)
        return out


def highest(T):
    """{name: highest temperature} of T (nodes across the film, ...), deg C."""
    return {"film_max_C": largest(T), "surface_a_max_C": T[0].max(), "surface_b_max_C": T[-1].max()}
