"""Steady contact from nothing: Hertz pressure on a coarse grid, then every finer grid from the one before.

What the coarser grids gave tells the error of the finest (error_bars).
"""

from dataclasses import dataclass, field
from typing import Optional

import numpy as np

from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march.settle import settle, time_step
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.pressure.newton import PressureSolver, Report
from tehl_taichi.pressure.one_temperature import OneTemperature

FIRST_CELLS = 64  # along x of the first grid: fine enough for a film from Hertz, cheap enough not to matter
LEAST_CELLS = 32  # of the first grid where that makes one grid more, for the error of coarse runs
CLOSE = 0.03  # Krylov tolerance between blocks of temperatures: with 0.2 they may never settle (4 GPa, 64 columns)
CAREFUL = 1e-2  # Krylov tolerance where that of the scene did not converge
FIRST_FILM = 0.05  # central film of the first guess, Hertz units: thick enough to flow, thin enough to be near
START_TRIES = (1.0, 0.3, 3.0)  # times FIRST_FILM
SLIPS = (1.0,), (1e-3, 1e-2, 0.1, 1.0)  # parts of the slip that a start goes through, and again where it fails
FINEST_THERMAL = 4  # temperatures on the grids up to four times as coarse as the finest: three grids for the error
SLOWER = (300.0, 100.0, 30.0, 10.0, 3.0, 1.0)  # factors of the speed below that of the scene
# Steps of time towards a steady state that Newton does not reach at once, in cells that the oil moves: films of a thousandth
# of a^2/R' on grids that hardly resolve them. Of 102 isothermal scenes (table and random) 8 did not start without, all do now
SHORTEST_TIME, LONGEST_TIME, TIME_STEPS, ROUGHLY = 1e-2, 1e4, 60, 1e-4


@dataclass
class SteadyResult:
    """solver: holds the finest state; report: its last solve; values: what `look` saw on each grid that counts for its error,
    coarsest first; work: Krylov iterations."""

    solver: PressureSolver
    report: Report
    values: list = field(default_factory=list)
    work: int = 0
    heat: Optional[FilmHeat] = None


def grid_sequence(nx, ny):
    """Sizes from the first grid up to (nx, ny), each twice as fine: three where FIRST_CELLS or more allow it."""
    sizes, first = [(nx, ny)], min(FIRST_CELLS, max(nx // 4, LEAST_CELLS))
    while nx % 2 == 0 and nx // 2 >= first and ny % 2 == 0 and (ny == 0 or ny // 2 >= 4):
        nx, ny = nx // 2, ny // 2
        sizes.append((nx, ny))
    return sizes[::-1]


def solve_steady(scene, scales, nx, ny, look=None):
    """Steady smooth contact on nx x ny cells (ny = 0: line). look(solver, heat, report): what to keep of each grid, by default
    its :func:`scalars`. Returns a SteadyResult; check `report.converged`."""
    look = look or (lambda solver, heat, report: scalars(solver))
    P, H0, T, values, work = None, 0.0, None, [], 0
    for size in grid_sequence(nx, ny):
        solver = heat = levels = None  # give their tables to the next grid
        levels = Levels(scene, scales, *size)
        solver = PressureSolver(levels, OneTemperature(levels))
        solver.levels.put(fields.GAP0, solver.levels.smooth_gap())
        report = _first(solver) if P is None else _next(solver, P, H0)
        if report.converged and not scene.isothermal and nx // size[0] <= FINEST_THERMAL:
            heat = FilmHeat(levels, time_step(scene, scales, levels.dx))
            solver.take(heat)  # density and viscosity follow the temperatures now
            report = settle(levels, heat, lambda solver=solver: _again(solver), T)
            T = np.stack([refine(layer) for layer in heat.T])
        # a grid too coarse for the outlet of this film is no start for the next one, nor a step of its error
        P, H0 = (solver.levels.get(fields.P), solver.H0) if report.converged else (None, 0.0)
        if not report.converged:
            values = []
        if size[0] == nx or report.converged and (scene.isothermal or heat):
            values.append(look(solver, heat, report))
        work += report.cycles
    return SteadyResult(solver, report, values, work, heat)


def _first(solver):
    """From Hertz without slip, which then comes in parts where it does not at once. Sheared from the start, a film that Newton
    makes too thin for a moment flows off like water: the surfaces touch all over, which may be a solution too."""
    v = solver.levels
    v.numbers.slip(0.0)
    report = _without_slip(solver)
    P, H0 = v.get(fields.P), solver.H0
    for parts in SLIPS if v.thins and report.converged else ():
        _put(solver, P, H0)
        report = _through_slips(solver, parts)
        if report.converged:
            break
    v.numbers.slip(1.0)
    return report


def _through_slips(solver, parts):
    for part in parts:
        solver.levels.numbers.slip(part)
        report = _from_here(solver)
        if not report.converged:
            break
    return report


def _without_slip(solver):
    for factor in START_TRIES:
        for krylov_tolerance in (None, CAREFUL):
            _hertz(solver, FIRST_FILM * factor)
            report = solver.solve(krylov_tolerance)
            if report.converged:
                return report
    return _through_slower_ones(solver)


def _again(solver):
    """The pressure for other temperatures, which must not see what is left of earlier linear solves."""
    report = _from_here(solver, CLOSE)
    return report if report.converged else _through_slower_ones(solver)


def _from_here(solver, krylov_tolerance=None):
    """From the pressure in the table, carefully if need be."""
    P, H0 = solver.levels.get(fields.P), solver.H0
    report = solver.solve(krylov_tolerance)
    if not report.converged:
        _put(solver, P, H0)
        report = solver.solve(CAREFUL)
    return report


def _put(solver, P, H0):
    solver.levels.put(fields.P, P)
    solver.H0 = H0


def _through_slower_ones(solver):
    """From Hertz at a low speed, where it is near, up to the speed of the scene; in time where a speed does not converge."""
    _hertz(solver, FIRST_FILM * START_TRIES[-1] / SLOWER[0] ** 0.7)
    for factor in SLOWER:
        solver.levels.numbers.slow_down(factor)
        P, H0 = solver.levels.get(fields.P), solver.H0
        report = solver.solve(CAREFUL)
        if not report.converged:
            report = _in_time(solver, P, H0)
        if not report.converged:
            break
    solver.levels.numbers.slow_down(1.0)
    return report


def _in_time(solver, P, H0):
    """From P and H0 towards the steady state in implicit steps of time, longer and longer; then the steady equations."""
    v, step = solver.levels, 1.0
    for _ in range(TIME_STEPS):
        _put(solver, P, H0)
        solver.residual()
        if not SHORTEST_TIME < step < LONGEST_TIME:
            break
        v.numbers.set_rate(1 / (step * v.dx))
        v.put(fields.QOLD, -v.get(fields.RHO) * v.get(fields.H) / step)
        report = solver.solve(CAREFUL, ROUGHLY)
        if report.residual < ROUGHLY:
            P, H0, step = v.get(fields.P), solver.H0, 2 * step
        else:
            step *= 0.3
    v.numbers.set_rate(0.0)
    v.put(fields.QOLD, 0.0)
    return solver.solve(CAREFUL)


def _hertz(solver, film):
    v = solver.levels
    r2 = v.X[None, :] ** 2 + (0.0 if v.line else (v.Y[:, None] * v.scales.a / v.scales.b) ** 2)
    v.put(fields.P, np.sqrt(np.maximum(1 - r2, 0.0)))
    v.set_film(0.0)
    centre = v.get(fields.H)[0, int(np.argmin(np.abs(v.X)))]
    solver.H0 = film - float(centre)


def _next(solver, P, H0):
    _put(solver, refine(P) * solver.levels.get(fields.MASK), H0)
    report = _from_here(solver)
    return report if report.converged else _first(solver)


def refine(P):
    """Linear interpolation of (ny+1, nx+1) to twice the cells in each direction."""
    x = np.zeros((P.shape[0], 2 * P.shape[1] - 1))
    x[:, ::2], x[:, 1::2] = P, 0.5 * (P[:, 1:] + P[:, :-1])
    out = np.zeros((2 * P.shape[0] - 1, x.shape[1]))
    out[::2], out[1::2] = x, 0.5 * (x[1:] + x[:-1])
    return out


def scalars(solver):
    """h_c (X = 0, interpolated), h_min and p_max of the state in the table, dimensionless."""
    v = solver.levels
    H, P = v.get(fields.H), v.get(fields.P)
    return {"h_c": float(np.interp(0.0, v.X, H[v.middle])), "h_min": float(H.min()), "p_max": float(P.max())}
