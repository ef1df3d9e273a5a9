"""A loaded crack with a filling, and its passage if the oil pressures are unknowns.

Oil in a part of the crack (a cell) is a contact, too: its pressure is not negative, the volume of the cell is not smaller than
that of the oil, one of them fits (as Elrod 1981 has it for films that break). So pressures and contact forces are found
together, and the matrix stays symmetric and positive.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tehl_taichi.crack.closure import opened, shut
from tehl_taichi.crack.face_friction import OPEN, UP, some, with_friction
from tehl_taichi.crack.filling import Fluid


@dataclass(frozen=True)
class FluidState:
    """values (2 nodes, moments), contact forces held (contacts, moments), moments that did not settle; pressure (moments,) Pa
    at the tip, and what the oil's volume would be at p = 0, m^2 (moments,) or None."""

    values: np.ndarray
    held: np.ndarray
    missed: int
    pressure: np.ndarray
    content: np.ndarray | None = None


@dataclass(frozen=True)
class FluidFilledCrack:
    """faces: :class:`tehl_taichi.crack.compliance.CrackFaces`; forces (2 nodes, moments): of the body without oil; mouth
    (moments,): pressure of the film at the mouth, Pa; share: of it for fillings that take one; times (moments,): s; friction:
    of the faces; fluid: :class:`Fluid`; cells: along the crack, for pressures that differ there."""

    faces: Any
    forces: np.ndarray
    mouth: np.ndarray
    share: float
    times: np.ndarray
    friction: float
    fluid: Fluid
    cells: int

    def under(self, pressure):
        """:class:`FluidState` of one given pressure (moments,) everywhere in the crack."""
        forces = self.forces + self.faces.pushed()[:, None] * pressure
        if self.friction > 0:
            values, held, missed = with_friction(self.faces, forces, self.friction)
        else:
            (values, held), missed = opened(self.faces, forces), 0
        return FluidState(values, held, missed, pressure)

    def marched(self, count, first, step):
        """:class:`FluidState` of a march with `count` cells. first(march): (:class:`MomentState`, contents (cells,)) at the
        first moment; step(march, n, found, contents): the same at moment n. With friction it goes twice, as slip has a
        history."""
        march = CrackMarch(self, count)
        for _ in range(2 if self.friction > 0 else 1):
            kept = [march.took(*first(march))]
            for n in range(1, self.mouth.size):
                kept.append(march.took(*step(march, n, *kept[-1])))
        return march.inside(*zip(*kept))


@dataclass(frozen=True)
class MomentState:
    """One moment: forces and displacements of all rows of the march, nodal values (2 nodes,), pressures (cells,) Pa, state of
    the contacts and cells, whether it settled; pressed: contact force of the mouth, below zero: what would just shut it."""

    forces: np.ndarray
    moved: np.ndarray
    pressed: float
    values: np.ndarray
    pressure: np.ndarray
    state: np.ndarray
    settled: bool

    def unsettled(self):
        """This state, marked as not settled."""
        return replace(self, settled=False)


class CrackMarch:
    """Rows: contacts, cells, slips of those that rub. volume: (cells, 2 nodes) m^2 by nodal values; length: (cells,) m."""

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
        """:class:`MomentState` at moment n with one given pressure."""
        forces = np.zeros(len(self.G))
        forces[self.cells] = pressure * self.scale
        free, rows = self.free[:, n] + self.S @ forces, self.others
        forces[rows], state, settled = self._solved(self.S[np.ix_(rows, rows)], free[rows], self.state[: self.contacts])
        wet = np.full(self.cells.size, UP if pressure > 0 else OPEN)
        return self._found(n, forces, np.concatenate([state, wet]), settled)

    def holding(self, n, volume, D):
        """:class:`MomentState` at moment n; its cells have at least the `volume` (cells,) m^2, less D (cells, cells) times
        pressure.
        """
        S, free = self.S.copy(), self.free[:, n].copy()
        S[np.ix_(self.cells, self.cells)] += D / np.outer(self.scale, self.scale)
        free[self.cells] -= volume / self.scale
        return self._found(n, *self._solved(S, free, self.state))

    def _solved(self, S, free, state):
        r, state, _, settled, _ = some(S, free[:, None], self.wet.friction, state, self.slip)
        return r[:, 0], state, settled

    def _found(self, n, forces, state, settled):
        moved = self.free[:, n] + self.S @ forces
        values = self.wet.faces.compliance @ (self.wet.forces[:, n] + self.G.T @ forces)
        pressed = float(forces[0] - moved[0] / self.S[0, 0])
        return MomentState(forces, moved, pressed, values, forces[self.cells] / self.scale, state, settled)

    def took(self, found, content):
        """Both arguments, after their states and slips are kept for the next moment."""
        self.state, self.slip = found.state, found.moved[self.state.size :]
        return found, content

    def inside(self, founds, contents):
        """The :class:`FluidState` of all moments."""
        held = np.stack([found.forces[: self.contacts] for found in founds], axis=1)
        values = shut(self.wet.faces, np.stack([found.values for found in founds], axis=1), held)
        pressure, missed = np.array([found.pressure[-1] for found in founds]), sum(not found.settled for found in founds)
        return FluidState(values, held, missed, pressure, np.array([content.sum() for content in contents]))


def _cells(faces, count):
    """Lengths (cells,) of so many parts of a crack, and their volumes (cells, 2 nodes) by nodal values."""
    begin = np.searchsorted(faces.parts(count), np.arange(count))
    return tuple(np.add.reduceat(one, begin, axis=0) for one in (faces.length, faces.length[:, None] * faces.opening()))
