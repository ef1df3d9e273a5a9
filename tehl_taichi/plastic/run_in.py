"""Run-in: the passage is repeated, each time on the surface and steel that the last one left, until no cell yields.

During the first passage the steel flows under load, so its pressures belong to a surface between the old and the new one. This
passage is repeated on better surfaces until it reproduces the surface it ran on. Later passages change little and run once.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from tehl_taichi.fatigue.stress.residual_field import ResidualField
from tehl_taichi.laws.hardening import HARDENINGS
from tehl_taichi.plastic import elastic_loads, steel_body
from tehl_taichi.plastic.layers import layers
from tehl_taichi.plastic.steel_body import Cells, SteelState
from tehl_taichi.plastic.surface_change import SurfaceChange
from tehl_taichi.scene.resolution import shortest_length
from tehl_taichi.scene.run_in import yielding_surfaces

SAME = 0.02    # of the largest sinking: surfaces of two rounds of the first passage that are one
SMALL = 1e-9   # m: less is no change of a surface
ROUNDS = 8     # of the first passage, at most; it takes 3 where a fifth of the height is lost
HALF = 0.5     # of the way to the new surface, in the second round; then by what the last round did


@dataclass(frozen=True)
class BodyRunIn:
    """Plastic state of a body before the current passage: start (left by earlier passages) and surface (sinking that this
    passage sees, m), on x (m), y (m) of its frame and depths (m).
    """

    x: np.ndarray
    y: np.ndarray
    depths: np.ndarray
    mirrored: bool
    start: SteelState
    surface: np.ndarray


@dataclass(frozen=True)
class RunInState:
    """State of a run-in.

    bodies: by name, {} before the first passage; passages: completed ones; rounds: completed rounds of the current passage;
    rest: change of sinking beyond its own surface that the last round left (m); part: share of it that was taken over; records:
    numbers of passages; done: run-in is complete; contained: see :func:`_contained`; unsettled: change beyond its own surface
    that the first passage left (m), if more than SAME of it.
    """

    bodies: dict = field(default_factory=dict)
    passages: int = 0
    rounds: int = 0
    rest: np.ndarray | None = None
    part: float = HALF
    records: tuple = ()
    done: bool = False
    contained: bool = True
    unsettled: float = 0.0

    @property
    def changes(self):
        """The :class:`SurfaceChange` of each body in the current passage; empty before steel yields."""
        return tuple(SurfaceChange(name, one.x, one.y, one.surface, one.mirrored) for name, one in self.bodies.items()
                     if one.surface.any())

    @property
    def residual_fields(self):
        """{surface: :class:`ResidualField`} that earlier passages left."""
        return {name: ResidualField(one.x, one.y, one.depths, one.start.residual) for name, one in self.bodies.items()
                if one.start.hardened.any()}


def repeat_passages(scene, march, state=RunInState(), keep=lambda state: None):
    """Repeat passages of a scene with run-in. Returns (reader of the assessed passage, RunInState).

    march(changes): runs the passage on these surfaces, returns a reader for
    :class:`tehl_taichi.fatigue.stress.histories.StressHistories`. keep(state): called before each further passage, and at the
    end.
    """
    reader = march(state.changes)
    while not (state := state_after_passage(scene, reader, state)).done:
        keep(state)
        reader = march(state.changes)
    keep(state)
    return reader, state


def state_after_passage(scene, reader, state):
    """RunInState after the passage of `reader`, which ran on the surfaces of `state`."""
    cells = {s.name: _cells(elastic_loads.histories(scene, reader, s)) for s in yielding_surfaces(scene)}
    if not state.bodies:
        state = replace(state, bodies={name: _virgin(*one) for name, one in cells.items()})
    found = {name: _steel_after(*one, state.bodies[name].start) for name, one in cells.items()}
    new = max(float((found[name].hardened - one.start.hardened).max()) for name, one in state.bodies.items())
    settled = all(np.array_equal(one.surface, one.start.sinking) for one in state.bodies.values())
    if state.passages == scene.time.run_in or settled and new == 0.0:
        return replace(state, done=True, records=(*state.records, _record(state, found, judged=True)))
    if state.passages == 0:
        return _next_round(state, found)
    return _next_passage(state, found)


def _cells(passage):
    """(passage, its :class:`Cells`) of a surface."""
    law = HARDENINGS[passage.surface.body.hardening]
    below = layers(passage.a, passage.dx, shortest_length(passage.scene))
    limits = np.array([passage.strength.yield_stress(depth) for depth in below.depths])

    def flow_stress(layer, strain):
        return law.flow_stress(limits[layer], strain)

    dy = float(passage.y[1] - passage.y[0]) if passage.y.size > 1 else 1.0
    shape = passage.x.size, passage.y.size
    return passage, Cells(passage.surface.body, below, (passage.dx, dy), shape, passage.y.size > 1 and passage.y[0] == 0,
                          flow_stress)


def _virgin(passage, cells):
    start = SteelState.virgin(cells)
    return BodyRunIn(passage.x, passage.y, cells.layers.depths, cells.mirrored, start, start.sinking)


def _steel_after(passage, cells, start):
    """SteelState that a passage leaves."""
    return steel_body.state_after(cells, start, elastic_loads.find(passage, cells, start).moments)


def _next_round(state, found):
    """State for the next round of the first passage, or for the next passage once the surface is reproduced or after ROUNDS."""
    rest = np.concatenate([(found[name].sinking - one.surface).ravel() for name, one in state.bodies.items()])
    largest = max(np.abs(one.sinking).max() for one in found.values())
    settled = np.abs(rest).max() <= max(SAME * largest, SMALL)
    if settled or state.rounds + 1 == ROUNDS:
        return _next_passage(replace(state, unsettled=0.0 if settled else float(np.abs(rest).max())), found)
    part = HALF if state.rest is None else _relaxed_share(state, rest)
    bodies = {name: replace(one, surface=one.surface + part * (found[name].sinking - one.surface))
              for name, one in state.bodies.items()}
    return replace(state, bodies=bodies, rounds=state.rounds + 1, rest=rest, part=part)


def _relaxed_share(state, rest):
    """Share of the way to the new surface for the next round, from the effect of the last share (Irons & Tuck 1969)."""
    less = state.rest - rest
    part = state.part * float(state.rest @ less) / max(float(less @ less), 1e-300)
    return float(np.clip(part, 0.1, 1.0))


def _next_passage(state, found):
    """State before the next passage, which runs on the result of this one."""
    bodies = {name: replace(one, start=found[name], surface=found[name].sinking) for name, one in state.bodies.items()}
    return replace(state, bodies=bodies, passages=state.passages + 1, rounds=0, rest=None, part=HALF,
                   records=(*state.records, _record(state, found)), contained=all(map(_contained, bodies.values())))


def _contained(body):
    """Whether no cell at the rim of the region or in its deepest layer yielded."""
    flowed = body.start.hardened > 0
    sides = [flowed[-1], flowed[:, [0, -1]], *([flowed[:, :, -1]] if body.y.size > 1 else []),
             *([flowed[:, :, 0]] if body.y.size > 1 and not body.mirrored else [])]
    return not any(side.any() for side in sides)


def _record(state, found, judged=False):
    """Numbers of a passage; judged: it is the assessed passage, so its result is not taken over."""
    pairs = [(one.start, found[name]) for name, one in state.bodies.items()]
    new = {name: float((found[name].hardened - one.start.hardened).max()) for name, one in state.bodies.items()}
    return {"passage": state.passages + 1, "judged": judged, "rounds": state.rounds + 1,
            "surface_change_m": max(float(np.abs(new.sinking - old.sinking).max()) for old, new in pairs),
            "new_plastic_strain": max(new.values()), "new_by_surface": new,
            "plastic_strain": max(float(new.hardened.max()) for _, new in pairs)}
