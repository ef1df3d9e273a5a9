"""Steady contact: Hertz pressure on a coarse grid, then each finer grid from the last one.

The results of the coarser grids give the error of the finest (error_bars).
"""

import math
from dataclasses import dataclass, field
from typing import Optional

import numpy as np

from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march.alternating_start import find_steady, time_step
from tehl_taichi.march.feature_gap import smooth_with
from tehl_taichi.march.flooded_border import between_blocks, border_of, iterate_border, share_load, with_whole_load
from tehl_taichi.march.isothermal_start import first_converged, from_nothing, put, solve_from_table, solve_in_time
from tehl_taichi.march.pseudo_transient import check, march_to_rest
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.isothermal import OneTemperature
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.pressure.newton import PressureSolver, SolveReport, pressure_solver

FIRST_CELLS = 64  # along x of the first grid: fine enough for a film from Hertz, cheap enough not to matter
LEAST_CELLS = 32  # of the first grid where that makes one grid more, for the error of coarse runs
FINEST_THERMAL = 4  # temperatures on the grids up to four times as coarse as the finest: three grids for the error


@dataclass
class SteadyResult:
    """solver: holds the finest state; report: of its last solve; values: results of `look` on each grid that counts for its
    error, coarsest first; work: Krylov iterations; moving: the unconverged result is a state in time.
    """

    solver: PressureSolver
    report: SolveReport
    values: list = field(default_factory=list)
    work: int = 0
    heat: Optional[FilmHeat] = None
    moving: bool = False


def grid_sequence(nx, ny):
    """Sizes from the first grid up to (nx, ny), each twice as fine; three grids if FIRST_CELLS or more cells allow it."""
    sizes, first = [(nx, ny)], min(FIRST_CELLS, max(nx // 4, LEAST_CELLS))
    while nx % 2 == 0 and nx // 2 >= first and ny % 2 == 0 and (ny == 0 or ny // 2 >= 4):
        nx, ny = nx // 2, ny // 2
        sizes.append((nx, ny))
    return sizes[::-1]


def solve_steady(scene, nx, ny, look=None, full=False):
    """Steady contact on nx x ny cells (ny = 0: line; full: on the whole domain), smooth except for the features of a surface at
    rest.

    look(solver, heat, report): result to keep for each grid, by default its :func:`scalars`. Returns a SteadyResult; check
    `report.converged`.
    """
    look = look or (lambda solver, heat, report: scalars(solver.levels, *map(solver.levels.get, (fields.P, fields.H))))
    P, H0, load, T, values, work, moving = None, 0.0, 0.0, None, [], 0, False
    for size in grid_sequence(nx, ny):
        solver = heat = levels = None  # give their tables to the next grid
        finest, levels = size[0] == nx, Levels(scene, *size, full)
        levels.put(fields.GAP0, smooth_with(levels, scene.standing))
        solver = pressure_solver(levels, OneTemperature(levels))
        solver.border = border_of(levels)
        if P is not None:
            solver.load, solver.shares = load, True
        report = share_load(solver, from_nothing(solver) if P is None else _from_coarser(solver, P, H0))
        # a grid too coarse for the outlet of this film is no start for the next one, nor a step of its error
        P, H0, load = (levels.get(fields.P), solver.H0, solver.load) if report.converged else (None, 0.0, 0.0)
        before, T = T, None  # temperatures are a start for the next grid only
        if report.converged and not scene.isothermal and (finest or nx // size[0] <= FINEST_THERMAL and not _touches(solver)):
            heat = FilmHeat(levels, time_step(levels))
            solver.take(heat)  # density and viscosity follow the temperatures from here on
            report, moving = _with_temperatures(solver, heat, before, finest)
            if finest or report.converged and not _touches(solver):
                P, H0, T = levels.get(fields.P), solver.H0, np.stack([refine(layer) for layer in heat.T])
        report = with_whole_load(solver, report)
        if not report.converged:
            values = []
        if finest or report.converged and (scene.isothermal or heat):
            values.append(look(solver, heat, report))
        work += report.cycles
    return SteadyResult(solver, report, values, work, heat, moving)


def _with_temperatures(solver, heat, T, finest):
    """Alternate from the temperatures T of a coarser grid; march in time if that fails. Returns the SolveReport, and whether an
    unsettled result on the finest grid is a state in time.
    """
    P, H0, resolved = solver.levels.get(fields.P), solver.H0, finest and not _touches(solver)
    border, solver.border = solver.border, None
    report, trouble = find_steady(solver.levels, heat, between_blocks(solver, border), T)
    report = iterate_border(solver, border, report)
    if report.converged and trouble and resolved:
        report = check(solver, heat)
    if report.converged or _touches(solver):  # surfaces that touch flip from step to step: no time makes up for the grid
        return report, False
    report = iterate_border(solver, border, march_to_rest(solver, heat, P, H0, T, finest))
    return report, finest and not (report.converged or heat.held) and math.isfinite(heat.report.change)


def _touches(solver):
    return solver.levels.get(fields.TOUCH).any()


def _from_coarser(solver, P, H0):
    """Solve from the coarser grid's state; by time steps if Newton fails, as for a film too thin for the coarser grid."""
    P = refine(P)  # the border's, too
    put(solver, P, H0)
    return first_converged(solver, (solve_from_table, lambda each: solve_in_time(each, P, H0), from_nothing))


def refine(P):
    """Linear interpolation of (ny+1, nx+1) to twice the cells in each direction."""
    x = np.zeros((P.shape[0], 2 * P.shape[1] - 1))
    x[:, ::2], x[:, 1::2] = P, 0.5 * (P[:, 1:] + P[:, :-1])
    out = np.zeros((2 * P.shape[0] - 1, x.shape[1]))
    out[::2], out[1::2] = x, 0.5 * (x[1:] + x[:-1])
    return out


def scalars(levels, P, H):
    """h_c (X = 0, interpolated), h_min and p_max of pressure and film (ny+1, nx+1) on `levels`, dimensionless."""
    return {"h_c": float(np.interp(0.0, levels.X, H[levels.middle])), "h_min": float(H.min()), "p_max": float(P.max())}
