"""Ways to a steady film of a solver: from Hertz' pressure, through parts of the slip, lower speeds or steps of time.

Each leaves what it found in the solver's table and returns the Report of its last solve.
"""

import numpy as np

from tehl_taichi.pressure import fields

CLOSE = 0.03  # Krylov tolerance between blocks of temperatures: with 0.2 they may never settle (4 GPa, 64 columns)
CAREFUL = 1e-2  # Krylov tolerance where that of the scene did not converge
FIRST_FILM = 0.05  # central film of the first guess, Hertz units: thick enough to flow, thin enough to be near
START_TRIES = (1.0, 0.3, 3.0)  # times FIRST_FILM
SLIPS = (1.0,), (1e-3, 1e-2, 0.1, 1.0)  # parts of the slip that a start goes through, and again where it fails
# Times the speed of the scene, that a start comes down from: its films are thick, and thin ones are near to those of three
# times their speed. Up from low speeds a film touches on its grid, and may go on touching: lines of 15 and 50 nm on 512 and
# 1024 columns, which carry them
FASTER = (10.0, 100.0, 1000.0)
LARGEST_FALL, SMALLEST_FALL = 3.0, 1.05
SLOWER = (300.0, 100.0, 30.0, 10.0, 3.0, 1.0)  # factors of the speed below that of the scene
# Steps of time towards a steady state that Newton does not reach at once, in cells that the oil moves: films of a thousandth
# of a^2/R' on grids that hardly resolve them. Of 102 isothermal scenes (table and random) 8 did not start without, all do now
SHORTEST_TIME, LONGEST_TIME, TIME_STEPS, ROUGHLY = 1e-2, 1e4, 60, 1e-4


def from_nothing(solver):
    """From Hertz without slip, which then comes in parts where it does not at once. Sheared from the start, a film that Newton
    makes too thin for a moment flows off like water: the surfaces touch all over, which may be a solution too."""
    v = solver.levels
    v.numbers.slip(0.0)
    report = _without_slip(solver)
    P, H0 = v.get(fields.P), solver.H0
    for parts in SLIPS if v.thins and report.converged else ():
        put(solver, P, H0)
        report = _through_slips(solver, parts)
        if report.converged:
            break
    v.numbers.slip(1.0)
    return report


def _through_slips(solver, parts):
    for part in parts:
        solver.levels.numbers.slip(part)
        report = from_here(solver)
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
    report = _through_faster_ones(solver)
    return report if report.converged else _through_slower_ones(solver)


def again(solver):
    """The pressure for other temperatures, which must not see what is left of earlier linear solves."""
    report = from_here(solver, CLOSE)
    return report if report.converged else _through_slower_ones(solver)


def from_here(solver, krylov_tolerance=None):
    """From the pressure in the table, carefully if need be."""
    P, H0 = solver.levels.get(fields.P), solver.H0
    report = solver.solve(krylov_tolerance)
    if not report.converged:
        put(solver, P, H0)
        report = solver.solve(CAREFUL)
    return report


def put(solver, P, H0):
    """Go on from this pressure and rigid approach."""
    solver.levels.put(fields.P, P)
    solver.H0 = H0


def _through_faster_ones(solver):
    """From Hertz at a high speed, where films are thick, down to the speed of the scene."""
    for speed in FASTER:
        _hertz(solver, FIRST_FILM)
        report = _down_from(solver, speed)
        if report.converged:
            break
    solver.levels.numbers.slow_down(1.0)
    return report


def _down_from(solver, speed):
    """From the state in the table at `speed` times that of the scene down to it, in smaller steps where one fails; surfaces
    that touch on the way would go on touching."""
    v, step, known = solver.levels, LARGEST_FALL, None  # known: speed, P and H0 of the last film
    while True:
        v.numbers.slow_down(1 / speed)
        report = solver.solve(CAREFUL)
        if known and not report.converged:
            report = _in_time(solver, *known[1:])
        report.converged = report.converged and not v.get(fields.TOUCH).any()
        if report.converged:
            known = speed, v.get(fields.P), solver.H0
        elif known:
            put(solver, *known[1:])
            step = np.sqrt(step)
        if speed == 1.0 and report.converged or not known or step < SMALLEST_FALL:
            return report
        speed = max(known[0] / step, 1.0)


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
        put(solver, P, H0)
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
