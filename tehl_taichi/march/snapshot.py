"""A snapshot: one accepted state of a run in SI units; while it is the newest, all that is needed to go on from it."""

import functools
from dataclasses import dataclass, field
from typing import Any, Callable

import numpy as np

from tehl_taichi.march.output import fields_of, scalars_of
from tehl_taichi.pressure import fields


@dataclass
class Snapshot:
    """One accepted state.

    step: 0 = steady start; time s; feature_x m, centre of the first feature (nan without one); x (nx+1,), y (ny+1,) m;
    fields: (nx+1, ny+1) arrays in SI; scalars: numbers in SI; make_state: called for
    :attr:`state`. Of a steady start, grids: {name: Reading} of every grid that it visited, error: bars of its numbers (None
    where they are not known), unknown: why they are not, parts: {name: {"grid", "domain"}} of them, domain: the
    :class:`tehl_taichi.march.domain_error.Share`; unsettled: why it is none, but a state in time ("": it is one).
    """

    step: int
    time: float
    feature_x: float
    x: np.ndarray
    y: np.ndarray
    fields: dict
    scalars: dict
    make_state: Callable[[], dict]
    grids: list = field(default_factory=list)
    error: dict = field(default_factory=dict)
    unknown: dict = field(default_factory=dict)
    parts: dict = field(default_factory=dict)
    domain: Any = None
    unsettled: str = ""

    @functools.cached_property
    def state(self):
        """All that is needed to go on (f64, large). Ask for it before the next snapshot is computed: RuntimeError later."""
        return self.make_state()


def take(solved, step, time_s, feature_x, make_state):
    """Snapshot of a :class:`tehl_taichi.march.solved.Solved`: every output that its scene has (`march/outputs/`); feature_x in
    m; make_state: see :class:`Snapshot`."""
    v, a = solved.solver.levels, solved.scales.a
    nodes = {name: np.ascontiguousarray(field.of(solved).swapaxes(0, 1)) for name, field in fields_of(solved.scene).items()}
    numbers = {name: float(scalar.of(solved)) for name, scalar in scalars_of(solved.scene).items()}
    return Snapshot(step, time_s, feature_x, v.X * a, v.Y * a, nodes, numbers, make_state)


def state_of(solver, heat, step):
    """What is in the solver's table, as arrays to go on from."""
    return {"step": step, "P": solver.levels.get(fields.P), "H0": solver.H0, **(heat.state() if heat else {})}
