"""A body with plastic strain in its cells, followed through the moments of passages."""

from dataclasses import dataclass, replace

import numpy as np

from tehl_taichi.fatigue.stress.unit_loads import ACROSS
from tehl_taichi.plastic import flow
from tehl_taichi.plastic.half_space import LayeredHalfSpace

CLOSE = 1e-3     # of the flow stress: what a stress may lie above it, and what the last round of a moment may change
RELAXED = 1.6    # cells yield into their surroundings: the strain that held surroundings would leave is too small
ROUNDS = 60      # of a moment, at most
ROOM, LEAST = 0.25, 2  # of the cells that flow by the load alone, on each side, and cells at least: others flow by these


@dataclass(frozen=True)
class Cells:
    """Cells (layers, x, y) of a region of steel.

    body: of the scene; layers: :class:`tehl_taichi.plastic.layers.Layers`; sides: dx, dy (m); mirrored: rows begin at y = 0,
    which is a plane of symmetry; flow_stress: Pa, function of the layer numbers and plastic strain of cells.
    """

    body: object
    layers: object
    sides: tuple
    shape: tuple
    mirrored: bool
    flow_stress: object

    def half_space(self, part=(slice(None), slice(None))):
        """The :class:`LayeredHalfSpace` of a part of the region."""
        nx, ny = (len(range(*one.indices(n))) for one, n in zip(part, self.shape))
        return LayeredHalfSpace(self.body, (nx, 2 * ny - 1 if self.mirrored else ny), self.sides, self.layers)


@dataclass(frozen=True)
class SteelState:
    """Result of passages: plastic strain (layers, 6, x, y), equivalent plastic strain (layers, x, y), residual stress (layers,
    6, x, y) Pa, sinking of the surface (x, y) m.
    """

    strain: np.ndarray
    hardened: np.ndarray
    residual: np.ndarray
    sinking: np.ndarray

    @classmethod
    def virgin(cls, cells):
        """State of a body before its first passage."""
        shape = cells.layers.count, 6, *cells.shape
        return cls(np.zeros(shape), np.zeros((shape[0], *cells.shape)), np.zeros(shape), np.zeros(cells.shape))


def state_after(cells, state, moments):
    """Return the SteelState after `moments`: [(cell numbers (layers, x, y), their elastic stress (n, 6) Pa)] of cells that may
    yield.
    """
    flowing = np.concatenate([_yielding(cells, state, *one) for one in moments], axis=1) if moments else np.zeros((3, 0), int)
    if not flowing.size:
        return state
    part = _slices_around(flowing, cells)
    zone = _Zone(cells, state, part)
    for places, stress in moments:
        inside = np.all([(one.start <= at) & (at < one.stop) for one, at in zip(part, places)], axis=0)
        zone.follow([at[inside] for at in places], stress[inside])
    return zone.left(state)


def _yielding(cells, state, places, stress):
    """Numbers (3, n) of the cells that yield, given the state that earlier passages left."""
    layer, x, y = places
    size = flow.equivalent(flow.deviator(stress + state.residual[layer, :, x, y]))
    return np.stack(places)[:, size > cells.flow_stress(layer, state.hardened[layer, x, y]) * (1 + CLOSE)]


def _slices_around(places, cells):
    """Slices of layers, x and y around cells, with a margin for further yielding; from the surface on, and from y = 0 on if
    mirrored.
    """
    ends = [(int(at.min()), int(at.max()) + 1) for at in places]
    if cells.mirrored:
        ends[2] = 1 - ends[2][1], ends[2][1]
    more = [max(LEAST, int(np.ceil(ROOM * (last - first)))) for first, last in ends]
    low = [max(0, first - room) for (first, _), room in zip(ends, more)]  # 0 of rows that mirror
    high = [min(size, last + room) for (_, last), room, size in zip(ends, more, (cells.layers.count, *cells.shape))]
    return slice(0, high[0]), slice(low[1], high[1]), slice(low[2], high[2])


class _Zone:
    """Part of a body in which cells may yield; stresses are computed only there. Cells that yielded earlier elsewhere
    contribute their residual stress.
    """

    def __init__(self, cells, state, part):
        layers, *sides = part
        self.cells, self.part, self.whole, self.space = cells, part, (layers, slice(None), *sides), cells.half_space(sides)
        self.strain, self.hardened = state.strain[self.whole].copy(), state.hardened[part].copy()
        self.before, self.kept = self.strain.copy(), state.residual[self.whole]
        self.residual, self.G = self.kept, self.space.G

    def follow(self, places, stress):
        """Apply one moment: elastic stress (n, 6) of cells (layers, x, y) that may yield."""
        layer, x, y = (at - one.start for at, one in zip(places, self.part))
        at, kinds = (layer, x, y), (layer[:, None], np.arange(6), x[:, None], y[:, None])
        limit = self.cells.flow_stress(layer, self.hardened[at])
        if (self._size(stress, kinds) > limit * (1 + CLOSE)).any():
            self._settle(stress, at, kinds, CLOSE * limit)

    def _settle(self, stress, at, kinds, close):
        """Find the plastic strain that returns these cells to the flow stress, with the residual stress it causes, to `close`
        (n,) Pa.
        """
        hardened, strain = self.hardened[at], self.strain[kinds]
        found = strain
        for _ in range(ROUNDS):
            trial = flow.deviator(stress + self.residual[kinds]) + 2 * self.G * (found - strain)
            more, grown = flow.return_mapping(trial, hardened, lambda eps: self.cells.flow_stress(at[0], eps), self.G)
            change = strain + more - found
            found = found + RELAXED * change
            self.strain[kinds], self.hardened[at] = found, hardened + grown
            self.residual = self.kept + self._answer()[0]
            if (2 * self.G * np.abs(change).max(axis=1, initial=0.0) < close).all():
                return

    def _size(self, stress, kinds):
        """Von Mises stress of elastic plus residual stress of cells."""
        return flow.equivalent(flow.deviator(stress + self.residual[kinds]))

    def _answer(self):
        """(residual stress, sinking) of the strain since the passage began."""
        return _answer(self.cells, self.space, self.strain - self.before)

    def left(self, state):
        """SteelState with the result of this part."""
        strain, hardened = state.strain.copy(), state.hardened.copy()
        strain[self.whole], hardened[self.part] = self.strain, self.hardened
        residual, sinking = _answer(self.cells, self.cells.half_space(), strain)
        return replace(state, strain=strain, hardened=hardened, residual=residual, sinking=sinking)


def _answer(cells, space, strain):
    """(residual stress, sinking) of plastic strain on the rows of the cells."""
    if not cells.mirrored:
        return space.answer(strain)
    image = strain[..., :0:-1] * ACROSS[:, None, None]
    stress, sinking = space.answer(np.concatenate([image, strain], axis=-1))
    rows = strain.shape[-1]
    return stress[..., rows - 1 :], sinking[:, rows - 1 :]
