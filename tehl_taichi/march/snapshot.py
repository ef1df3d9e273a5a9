"""Snapshot: one accepted state of a run in SI units; while it is the newest, a march can continue from it."""

import functools
from dataclasses import dataclass, field
from typing import Any, Callable

import numpy as np

from tehl_taichi.errors import Error
from tehl_taichi.march.step_output import fields_of, scalars_of
from tehl_taichi.pressure import fields


@dataclass(eq=False)  # arrays have no single answer to ==
class Snapshot:
    """One accepted state of a run: the steady start or a time step, in SI units.

    Attributes
    ----------
    step : int
        0 is the steady start.
    time : float
        s, since the steady start.
    feature_x : float
        Position of feature.x = 0, the centre of a first feature there, m; nan without a feature.
    x, y : array (nx+1,), (ny+1,)
        Nodes, m.
    fields : dict
        {name: array (nx+1, ny+1)}: pressure, film, contact, tractions, temperatures.
    scalars : dict
        {name: number}: p_max_Pa, h_min_m, friction_coefficient, residual ...
    state : dict
        All that :func:`tehl_taichi.march` needs to continue (f64, large). Available while the snapshot is the newest;
        RuntimeError later. Copies and pickled snapshots have it if it was read before.
    error, unknown, parts : dict
        Of a steady start: error bars of its numbers (None where unknown), why they are unknown, and {"grid", "domain"} of each.
    grids : list
        Of a steady start: {name: GridReading} of every grid that it visited.
    domain : DomainError
        Of a steady start: the share of the inlet, :class:`tehl_taichi.march.accuracy.domain_error.DomainError`.
    coarser : list
        Of a steady start: snapshots of the two coarser grids that it went over, for error bars.
    unsettled : str
        Why a steady start is only a state in time; "": it is steady.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> next(tehl.march(tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})))
    <tehl.Snapshot steady start: 33 x 1 nodes, p_max 1.93 GPa, h_min 0.33 um>
    """

    step: int
    time: float
    feature_x: float
    x: np.ndarray
    y: np.ndarray
    fields: dict
    scalars: dict
    make_state: Callable[..., dict]
    grids: list = field(default_factory=list)
    error: dict = field(default_factory=dict)
    unknown: dict = field(default_factory=dict)
    parts: dict = field(default_factory=dict)
    domain: Any = None
    coarser: list = field(default_factory=list)
    unsettled: str = ""

    def __repr__(self):
        when, s = f"step {self.step}" if self.step else "steady start", self.scalars
        return (f"<tehl.Snapshot {when}: {self.x.size} x {self.y.size} nodes, p_max {s['p_max_Pa'] / 1e9:.2f} GPa, "
                f"h_min {s['h_min_m'] * 1e6:.2g} um>")

    def __getstate__(self):
        """Contents for copies and other processes, without the solvers behind them."""
        return {**vars(self), "make_state": functools.partial(gone, self.step)}

    @functools.cached_property
    def state(self) -> dict:
        """State from which a march continues."""
        return self.make_state()

    @property
    def carried(self):
        """What a window takes over of the temperatures while this is the newest snapshot, see
        :meth:`tehl_taichi.heat.temperatures.FilmHeat.carried`."""
        return self.make_state(carried=True)

    def let_go(self, keep):
        """Release all solvers; keep: whether the state is kept."""
        if keep:
            self.state  # noqa: B018 - it is cached
        self.make_state = functools.partial(gone, self.step)


class StateGone(Error, RuntimeError):
    """The state of an earlier step is requested."""


def gone(step, **options):
    raise StateGone(f"the state of step {step} is no longer available; read it before the next step")


def take(solved, step, time_s, feature_x, make_state):
    """Snapshot of a :class:`tehl_taichi.march.solved_state.SolvedState`, with every output of its scene (`march/outputs/`).

    feature_x in m; make_state: see :class:`Snapshot`.
    """
    v, a = solved.solver.levels, solved.scales.a
    nodes = {name: np.ascontiguousarray(field.of(solved).swapaxes(0, 1)) for name, field in fields_of(solved.scene).items()}
    numbers = {name: float(scalar.of(solved)) for name, scalar in scalars_of(solved.scene).items()}
    return Snapshot(step, time_s, feature_x, v.X * a, v.Y * a, nodes, numbers, make_state)


def first_state(solver, heat):
    """State in the solver's table after a steady start, as arrays from which a march continues."""
    return {"step": 0, "P": solver.levels.get(fields.P), "H0": solver.H0, "load": solver.load,
            **(heat.state() if heat else {})}
