"""First snapshot of a run: the steady smooth contact, on the rows of the passage."""

import math
import time

import numpy as np

from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march import snapshot
from tehl_taichi.march.accuracy import readings
from tehl_taichi.march.accuracy.domain_error import DomainError, domain_error, widened
from tehl_taichi.march.accuracy.error_bars import bars
from tehl_taichi.march.failure import not_converged
from tehl_taichi.march.solved_state import SolvedState
from tehl_taichi.march.steady import solve_steady
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_text import Reason


class StartReadings:
    """Readings of the grids of a start. newest: snapshot of the last grid that converged; by_columns: those of all grids, by
    their columns.
    """

    def __init__(self, scene):
        self.scene, self.started, self.newest, self.by_columns = scene, time.perf_counter(), None, {}

    def __call__(self, solver, heat, report):
        if not report.converged:
            return None
        self.newest = self.taken(solver, heat, report)
        self.by_columns[self.newest.x.size] = self.newest
        return readings.steady(self.newest, self.scene)

    def coarser(self, first):
        """Snapshots of the two next coarser grids than that of `first`, the coarser one first."""
        return [found for columns, found in sorted(self.by_columns.items()) if columns < first.x.size][-2:]

    def taken(self, solver, heat, report):
        """Snapshot of the state in the solver's table."""
        return snapshot.take(SolvedState(solver, heat, report, self.started), 0, 0.0, math.nan, None)


def steady_snapshot(scene):
    """Snapshot 0 with the error bars of its numbers.

    In a passage whose temperatures do not settle: a state in time, with the reason why its numbers are unknown. Raises
    NotConverged if neither is found.
    """
    scales, looks = Scales.of(scene), StartReadings(scene)
    rows, full = _across(scene, scales)
    result = solve_steady(scene, scene.grid.nx, rows, looks, full)
    unsettled = _unsettled(result, scene)
    first = looks.taken(result.solver, result.heat, result.report) if unsettled else looks.newest
    state = snapshot.first_state(result.solver, result.heat)
    first.make_state = lambda carried=False: state
    first.scalars["cycles"], first.unsettled = float(result.work), unsettled
    first.grids, first.domain = result.values, DomainError() if unsettled else domain_error(result.solver)
    first.error, first.unknown, first.parts = _bars(first, scene)
    first.coarser = looks.coarser(first)
    return _spread(first, scene, scales)


def _across(scene, scales):
    """(cells along y, whether they cover the whole domain): resting features that vary along y need the cells of the
    passage.
    """
    if all(f.transverse and scales.line or f.symmetric and not scales.line for f in scene.standing):
        return 0 if scales.line else scene.grid.ny, False
    return scene.rows, not scene.symmetric


def _unsettled(result, scene):
    """Reason why the finest state is only a state in time; "": it is steady. Raises NotConverged if it is neither."""
    if result.report.converged:
        return ""
    failure = not_converged(result.solver, result.heat, result.report, "the steady start")
    if not (result.moving and scene.transient):
        raise failure
    return str(failure)


def _bars(first, scene):
    """(bars, reasons of unknown ones, their parts by grid and domain)."""
    own = readings.steady(first, scene)
    found = _unknown(first, scene) if first.unsettled else bars(first.grids)
    return widened(*found, {name: reading.value for name, reading in own.items()}, first.domain,
                   scene.operation.temperature)


def _unknown(first, scene):
    """Bars of a state in time: all unknown, with the reason."""
    why = Reason(f"not converged: {first.unsettled}", "unsettled")
    return tuple(dict.fromkeys(readings.steady(first, scene), each) for each in (None, why))


def _spread(first, scene, scales):
    """Smooth start on the rows of the passage: a line copied to every row, a half domain mirrored to the whole."""
    if scene.transient:
        first.feature_x = scene.path[0] * scales.a
    rows = scene.rows + 1 if scene.transient else first.y.size
    if first.y.size == rows:
        return first
    first.y, across = _rows(first.y, rows, scene, scales)
    first.fields = {key: np.ascontiguousarray(value[:, across]) for key, value in first.fields.items()}
    for key in (key for key in first.fields if key.startswith("traction_y")):  # antisymmetric
        first.fields[key][:, first.y < 0] *= -1
    for key, value in first.state.items():
        if key == "P" or key in FilmHeat.FIELDS:
            first.state[key] = np.ascontiguousarray(value[..., across, :])
    return first


def _rows(y, rows, scene, scales):
    """(positions (m) of `rows` rows, the row of `y` that each copies)."""
    if y.size > 1:
        return np.concatenate([-y[:0:-1], y]), np.abs(np.arange(rows) - scene.grid.ny)
    extent = scene.grid.y_max * scales.b
    return np.linspace(0.0 if scene.symmetric else -extent, extent, rows), np.zeros(rows, int)
