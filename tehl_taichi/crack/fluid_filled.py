"""A loaded crack with a filling, and its solution moment by moment where oil pressures are unknowns.

Oil in a part of the crack (a cell) is handled as a contact: its pressure is not negative, the volume of the cell is not smaller
than that of the oil, and one of the two is an equality (as in Elrod's 1981 cavitation model). So pressures and contact forces
are found together, and the matrix stays symmetric and positive.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tehl_taichi.crack.closure import close_tips, frictionless
from tehl_taichi.crack.face_friction import OPEN, UP, solve_some, with_friction
from tehl_taichi.crack.filling import Fluid


@dataclass(frozen=True)
class FluidState:
    """Solution of a filled crack: nodal values (2 nodes, moments), contact forces held (contacts, moments), unsettled moments,
    pressure (moments,) at the tip in Pa, and volume of the oil at p = 0, m^2 (moments,) or None.
    """

    values: np.ndarray
    held: np.ndarray
    missed: int
    pressure: np.ndarray
    content: np.ndarray | None = None


@dataclass(frozen=True)
class FluidFilledCrack:
    """A loaded crack with oil.

    faces: :class:`tehl_taichi.crack.compliance.CrackFaces`; forces (2 nodes, moments): of the body without oil; mouth
    (moments,): film pressure at the mouth, Pa; share: part of it that acts, for fillings that use a share; times (moments,): s;
    friction: coefficient of the faces; fluid: :class:`Fluid`; cells: number along the crack, for pressures that vary.
    """

    faces: Any
    forces: np.ndarray
    mouth: np.ndarray
    share: float
    times: np.ndarray
    friction: float
    fluid: Fluid
    cells: int

    def under(self, pressure):
        """The :class:`FluidState` under a given pressure (moments,) in the whole crack."""
        forces = self.forces + self.faces.pushed()[:, None] * pressure
        if self.friction > 0:
            values, held, missed = with_friction(self.faces, forces, self.friction)
        else:
            (values, held), missed = frictionless(self.faces, forces), 0
        return FluidState(values, held, missed, pressure)

    def marched(self, count, first, step):
        """The :class:`FluidState` of a march with `count` cells.

        first(march): (:class:`MomentState`, contents (cells,)) of the first moment; step(march, n, found, contents): that of
        moment n. With friction the march runs twice, because slip depends on its history.
        """
        march = CrackMarch(self, count)
        for _ in range(2 if self.friction > 0 else 1):
            kept = [march.took(*first(march))]
            for n in range(1, self.mouth.size):
                kept.append(march.took(*step(march, n, *kept[-1])))
        return march.inside(*zip(*kept))


@dataclass(frozen=True)
class MomentState:
    """Solution of one moment: forces and displacements of all rows of the march, nodal values (2 nodes,), pressures (cells,)
    Pa, states of the contacts and cells, whether it settled, and `pressed`: contact force of the mouth (negative: the force
    that would just shut it).
    """

    forces: np.ndarray
    moved: np.ndarray
    pressed: float
    values: np.ndarray
    pressure: np.ndarray
    state: np.ndarray
    settled: bool

    def unsettled(self):
        """Copy of this state, marked as not settled."""
        return replace(self, settled=False)


class CrackMarch:
    """Solver of consecutive moments. Its rows: contacts, cells, slips of contacts with friction.

    volume: (cells, 2 nodes) m^2 by nodal values; length: (cells,) m.
    """

    def __init__(self, wet, count):
        self.wet, faces = wet, wet.faces
        self.contacts = len(faces.contact) - faces.rough
        self.length, self.volume = _cells(faces, count)
        self.scale = self.length * np.sqrt(faces.a)  # as large as the other rows
        slips = faces.contact[self.contacts if wet.friction > 0 else len(faces.contact) :]
        self.G = np.concatenate([faces.contact[: self.contacts], self.volume / self.scale[:, None], slips])
        self.cells = np.arange(self.contacts, self.contacts + count)
        self.others = np.setdiff1d(np.arange(len(self.G)), self.cells)
        self.S, self.free = (self.G @ faces.compliance @ right for right in (self.G.T, wet.forces))
        self.state, self.slip = np.full(self.contacts + count, OPEN), np.zeros(len(slips))

    def under(self, n, pressure):
        """The :class:`MomentState` at moment n under a given pressure in the whole crack."""
        forces = np.zeros(len(self.G))
        forces[self.cells] = pressure * self.scale
        free, rows = self.free[:, n] + self.S @ forces, self.others
        forces[rows], state, settled = self._solved(self.S[np.ix_(rows, rows)], free[rows], self.state[: self.contacts])
        wet = np.full(self.cells.size, UP if pressure > 0 else OPEN)
        return self._found(n, forces, np.concatenate([state, wet]), settled)

    def holding(self, n, volume, D):
        """The :class:`MomentState` at moment n if the cells have at least `volume` (cells,), m^2, less D (cells, cells) times
        pressure.
        """
        S, free = self.S.copy(), self.free[:, n].copy()
        S[np.ix_(self.cells, self.cells)] += D / np.outer(self.scale, self.scale)
        free[self.cells] -= volume / self.scale
        return self._found(n, *self._solved(S, free, self.state))

    def _solved(self, S, free, state):
        r, state, _, settled, _ = solve_some(S, free[:, None], self.wet.friction, state, self.slip)
        return r[:, 0], state, settled

    def _found(self, n, forces, state, settled):
        moved = self.free[:, n] + self.S @ forces
        values = self.wet.faces.compliance @ (self.wet.forces[:, n] + self.G.T @ forces)
        pressed = float(forces[0] - moved[0] / self.S[0, 0])
        return MomentState(forces, moved, pressed, values, forces[self.cells] / self.scale, state, settled)

    def took(self, found, content):
        """Keep state and slip for the next moment; returns both arguments."""
        self.state, self.slip = found.state, found.moved[self.state.size :]
        return found, content

    def inside(self, founds, contents):
        """Join the solutions of all moments to one :class:`FluidState`."""
        held = np.stack([found.forces[: self.contacts] for found in founds], axis=1)
        values = close_tips(self.wet.faces, np.stack([found.values for found in founds], axis=1), held)
        pressure, missed = np.array([found.pressure[-1] for found in founds]), sum(not found.settled for found in founds)
        return FluidState(values, held, missed, pressure, np.array([content.sum() for content in contents]))


def _cells(faces, count):
    """Divide a crack into `count` cells. Returns their lengths (cells,) and volumes (cells, 2 nodes) by nodal values."""
    begin = np.searchsorted(faces.parts(count), np.arange(count))
    return tuple(np.add.reduceat(one, begin, axis=0) for one in (faces.length, faces.length[:, None] * faces.opening()))
