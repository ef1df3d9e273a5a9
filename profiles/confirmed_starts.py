"""Starts with temperatures against half the time step and twice the columns: which of them hold."""

from dataclasses import dataclass
from typing import Optional

import numpy as np
from tehl_taichi.profiles import measure

from tehl_taichi.errors import NotConverged
from tehl_taichi.march.passage import march
from tehl_taichi.runs.sweep import pool
from tehl_taichi.scene import Scene, SceneError
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures import palette

MOST = {True: 2048, False: 512}  # columns of lines, of points, that are made finer
CONFIRMED = {True: 2048, False: 512}  # the same, of those that are made finer until twice the columns confirm them
FILM_HOLDS, HOLDS_K = 0.01, 1.0  # what half a step and a finer grid may change of a start that they confirm


@dataclass(frozen=True)
class Confirmed:
    """Changes of a start with half the time step and twice the columns: central film (part of it), largest temperature (K);
    None where that start stops. moving: whether one of the three is a state in time, none at rest; reason: why a case is lost
    altogether."""

    name: str
    columns: int
    half_film: Optional[float]
    half_K: Optional[float]
    finer_film: Optional[float]
    finer_K: Optional[float]
    moving: bool = False
    reason: str = ""

    @property
    def holds(self):
        """Whether neither changes the film by more than 1 %, nor the temperature by more than 1 K."""
        return _small(self.half_film, self.half_K) and _small(self.finer_film, self.finer_K)


def confirm(chosen, workers=1, threads=None, again=0):
    """Generator of a Confirmed for each of `chosen`, {name: scene}, in the order in which they end.

    again: doublings, at most, of a grid on which a start does not hold, up to CONFIRMED columns.
    """
    jobs = [(name, description, again) for name, description in chosen.items()]
    for number, found in measure.side_by_side(confirmed, jobs, workers, threads):
        lost = isinstance(found, pool.LostJob)
        name, description, _ = jobs[number]
        yield Confirmed(name, description.grid.nx, None, None, None, None, reason=found.reason) if lost else found


def confirmed(name, description, again=0):
    """The start of a scene three times: as it is, on twice the columns, and with half the time step; where it does not hold the
    same on twice the columns, `again` times at most. Returns the last Confirmed."""
    own, most = _start(description), CONFIRMED[Scales.of(description).line]
    while True:
        twice = doubled(description)
        finer, last = _start(twice), again == 0 or twice.grid.nx > most
        half = _start(_halved(description)) if last or _small(*_change(own, finer)) else None  # else the grid has decided
        found = Confirmed(name, description.grid.nx, *_change(own, half), *_change(own, finer),
                          any(state[2] for state in (own, half, finer) if state))
        if last or found.holds:
            return found
        description, own, again = twice, finer, again - 1


def _halved(description):
    return description.replace(**{"time.courant": 0.5 * description.time.courant})


def _change(own, other):
    """(part of the film, K) between two starts, (None, None) where one stops."""
    return (abs(other[0] / own[0] - 1), abs(other[1] - own[1])) if own and other else (None, None)


def _small(film, kelvin):
    """Whether a start that changes by so much holds."""
    return film is not None and film <= FILM_HOLDS and kelvin <= HOLDS_K


def doubled(description, times=1):
    """The scene on a grid doubled so many times; of lines, whose starts have one row, the rows stay."""
    g, line = description.grid, Scales.of(description).line
    return description.replace(**{"grid.nx": g.nx << times, "grid.ny": g.ny << (0 if line else times)})


def finer(chosen, times):
    """`chosen`, {name: scene or SceneError}, on grids doubled so many times, as long as they have no more than MOST columns."""
    return {name: _doubled_up_to(one, times, MOST[Scales.of(one).line]) if isinstance(one, Scene) else one
            for name, one in chosen.items()}


def _doubled_up_to(description, times, most):
    for _ in range(times):
        if 2 * description.grid.nx <= most:
            description = doubled(description)
    return description


def _start(description):
    """(central film, m, largest temperature, deg C, whether it is a state in time) of a start, or None where it stops."""
    try:
        shot = next(march(description))
    except (NotConverged, SceneError):
        return None
    return shot.scalars["h_c_m"], shot.scalars["film_max_C"], bool(shot.unsettled)


def changes_chart(plt, found):
    """Changes of every start with half the time step and twice the columns, and the allowed changes."""
    figure, ax = plt.subplots(figsize=(5.4, 4.6), constrained_layout=True)
    for which, label in (("half", "half the time step"), ("finer", "twice the columns")):
        pairs = [(100 * one[f"{which}_film"], one[f"{which}_K"]) for one in found if one[f"{which}_film"] is not None]
        ax.scatter(*(np.maximum(values, 1e-6) for values in (zip(*pairs) if pairs else ((), ()))), s=16, label=label)
    ax.axvline(100 * FILM_HOLDS, color=palette.RULE)
    ax.axhline(HOLDS_K, color=palette.RULE)
    ax.set(xlabel="change of the central film, %", ylabel="change of the largest temperature, K", xscale="log", yscale="log")
    ax.legend(fontsize=8)
    return figure
