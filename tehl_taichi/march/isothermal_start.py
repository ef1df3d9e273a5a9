"""Ways to a steady film: from the Hertz pressure, with growing slip, rising features, lower speeds or time steps.

Each leaves its result in the solver's table and returns the SolveReport of its last solve.
"""

import numpy as np

from tehl_taichi.pressure import fields
from tehl_taichi.values.arrays import nearest_index

CLOSE = 0.03  # Krylov tolerance between blocks of temperatures: with 0.2 they may never settle (4 GPa, 64 columns)
CAREFUL = 1e-2  # Krylov tolerance where that of the scene did not converge
FIRST_FILM = 0.05  # central film of the first guess, Hertz units: thick enough to flow, thin enough to be near
START_TRIES = (1.0, 0.3, 3.0)  # times FIRST_FILM
SLIPS = (1.0,), (1e-3, 1e-2, 0.1, 0.3, 1.0)  # parts of the slip that a start goes through, and again where it fails
# Times the speed of the scene, that a start comes from. Down from high ones, where films are thick: thin ones are near to those
# of three times their speed. Up from a low one a film touches on its grid, and may continue touching (lines of 15 and 50 nm on
# 512 and 1024 columns, which carry them): for grids that do not carry it
SPEEDS = 10.0, 100.0, 1000.0, 1 / 300
LARGEST_STEP, SMALLEST_STEP = 3.0, 1.05  # ratio of two speeds on the way
# Parts of the height by which features of a surface at rest rise. Bumps of 0.2 and 0.3 um in a film of 0.4 um (gear, SRR 2) do
# not start at once on 64 to 128 columns, and do with three steps
FIRST_RISE, SMALLEST_RISE = 1 / 4, 1 / 256
# Steps of time towards a steady state that Newton does not reach at once, in cells that the oil moves: films of a thousandth
# of a^2/R' on grids that hardly resolve them. Of 102 isothermal scenes (table and random) 8 did not start without, all do now
SHORTEST_TIME, LONGEST_TIME, TIME_STEPS, ROUGHLY = 1e-2, 1e4, 60, 1e-4


def from_nothing(solver):
    """Start from the Hertz pressure; where that fails, features of a surface at rest rise from the smooth contact."""
    report = _from_hertz(solver)
    return _with_rising_features(solver) if not report.converged and solver.levels.scene.standing else report


def _with_rising_features(solver):
    """Start without features, then let them rise to their heights."""
    v = solver.levels
    whole, smooth = v.get(fields.GAP0), v.smooth_gap()
    v.put(fields.GAP0, smooth)
    report = _from_hertz(solver)
    if report.converged:
        report = _risen(solver, lambda part: smooth + part * (whole - smooth))
    v.put(fields.GAP0, whole)
    return report


def _risen(solver, gap):
    """Solve for growing parts of the features' heights, in smaller steps after a failure; gap(part): undeformed gap."""
    v, step, part = solver.levels, FIRST_RISE, 0.0
    state = v.get(fields.P), solver.H0
    while part < 1.0 and step > SMALLEST_RISE:
        v.put(fields.GAP0, gap(min(part + step, 1.0)))
        put(solver, *state)
        report = solve_from_table(solver)
        if report.converged:
            part, step, state = min(part + step, 1.0), 1.5 * step, (v.get(fields.P), solver.H0)
        else:
            step *= 0.4
    return report


def _from_hertz(solver):
    """Start from the Hertz pressure without slip, then add the slip at once or in parts.

    If a film is sheared from the start and Newton makes it too thin for a moment, it flows off like water: the surfaces touch
    everywhere, which may also be a solution. The same happens if the first guess of the pressure gradients shears the film at
    the walls. So that shear is added with the slip, or before it if this fails (thick films of cold oil).
    """
    for walls in (0.0, 1.0) if solver.levels.scene.rheology.thins else (1.0,):
        report = _with_slip(solver, walls)
        if report.converged:
            break
    return report


def _with_slip(solver, walls):
    """Add the slip; walls: part of the wall shear by pressure gradients before the slip."""
    v = solver.levels
    v.numbers.slip(0.0)
    v.numbers.strain(walls)
    report = _without_slip(solver)
    P, H0 = v.get(fields.P), solver.H0
    v.numbers.strain(1.0)
    for parts in SLIPS if report.converged and (v.thins or walls < 1.0 and not solver.holds()) else ():
        put(solver, P, H0)
        report = _through_slips(solver, parts)
        if report.converged:
            break
    v.numbers.slip(1.0)
    return report


def _through_slips(solver, parts):
    """Solve for these parts of the slip, one after the other; if there are several, by time steps where that fails."""
    for part in parts:
        P, H0 = solver.levels.get(fields.P), solver.H0
        solver.levels.numbers.slip(part)
        report = solve_from_table(solver)
        if not report.converged and len(parts) > 1:
            report = solve_in_time(solver, P, H0)
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
    return _through_speeds(solver)


def solve_again(solver):
    """Solve the pressure for other temperatures, independent of data from earlier linear solves.

    Where Newton fails, time steps from the last pressure come first: a start from the Hertz pressure takes ten times as long.
    """
    P, H0 = solver.levels.get(fields.P), solver.H0
    return first_converged(solver, (lambda each: solve_from_table(each, CLOSE), lambda each: solve_in_time(each, P, H0),
                                    _through_speeds))


def first_converged(solver, ways):
    """SolveReport of the first of these functions of the solver that converges, or of the last one."""
    for way in ways:
        report = way(solver)
        if report.converged:
            break
    return report


def solve_from_table(solver, krylov_tolerance=None):
    """Solve from the pressure in the table, with a smaller Krylov tolerance if the first solve fails."""
    P, H0 = solver.levels.get(fields.P), solver.H0
    report = solver.solve(krylov_tolerance)
    if not report.converged:
        put(solver, P, H0)
        report = solver.solve(CAREFUL)
    return report


def put(solver, P, H0):
    """Continue from this pressure and rigid approach."""
    solver.levels.put(fields.P, P)
    solver.H0 = H0


def _through_speeds(solver):
    """Start from the Hertz pressure at another speed, and change it to that of the scene; tries SPEEDS until one converges."""
    for speed in SPEEDS:
        _hertz(solver, FIRST_FILM * min(1.0, START_TRIES[-1] * speed**0.7))
        report = _from_speed(solver, speed)
        if report.converged:
            break
    solver.levels.numbers.slow_down(1.0)
    return report


def _from_speed(solver, speed):
    """Go from the state in the table at `speed` times the scene's speed to that speed, in smaller steps after a failure.

    Surfaces that touch on the way to lower speeds would remain in contact.
    """
    v, step, down, known = solver.levels, LARGEST_STEP, speed > 1.0, None  # known: speed of the last film
    state = v.get(fields.P), solver.H0
    while True:
        report = _at_speed(solver, speed, *state)
        if down and v.get(fields.TOUCH).any():
            report.converged = False
        if report.converged:
            known, state = speed, (v.get(fields.P), solver.H0)
        else:
            put(solver, *state)
            step = np.sqrt(step)
        if known is None or speed == known == 1.0 or step < SMALLEST_STEP:
            return report
        speed = max(known / step, 1.0) if down else min(known * step, 1.0)


def _at_speed(solver, speed, P, H0):
    """Solve from P and H0 at `speed` times that of the scene; by time steps if that does not converge."""
    solver.levels.numbers.slow_down(1 / speed)
    report = solver.solve(CAREFUL)
    return report if report.converged else solve_in_time(solver, P, H0)


def solve_in_time(solver, P, H0):
    """March from P and H0 to the steady state in implicit time steps of growing length; then solve the steady equations."""
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
    unknown = v.get(fields.MASK) > 0  # the border keeps its pressure
    v.put(fields.P, np.where(unknown, np.sqrt(np.maximum(1 - r2, 0.0)), v.get(fields.P)))
    v.set_film(0.0)
    gap = v.get(fields.H)
    centre = float(gap[0, nearest_index(v.X, 0.0)])
    if solver.border is not None:
        solver.border.begin(gap - centre)
    solver.H0 = film - centre
