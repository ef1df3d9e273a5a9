"""Why a solve failed, in a sentence that says what to try."""

import numpy as np

from tehl_taichi.errors import NotConverged


def not_converged(solver, heat, report, where):
    """NotConverged for what is in the solver's table; heat: its FilmHeat or None; where: what was solved."""
    return NotConverged(f"{where} did not converge: {_reason(solver, heat, report)}")


def crossed(shot, a, border):
    """NotConverged for a snapshot with a negative film at nodes of the border (True in an array like its fields); a: m."""
    film = np.where(border, shot.fields["film"], np.inf)
    i, j = np.unravel_index(film.argmin(), film.shape)
    return NotConverged(f"step {shot.step}: the surfaces cross at the border of the grid, a film of {film[i, j]:.2g} m at "
                        f"X = {shot.x[i] / a:.2f}: a feature is higher than the gap there; a grid that reaches farther "
                        "(grid.x_min, grid.x_max, grid.y_max) gives it room")


def _reason(solver, heat, report):
    v, tolerance = solver.levels, solver.levels.scene.numerics.tolerance
    double = "" if v.precision == "f64" else ", --precision f64"
    if heat and report.residual < tolerance:
        return (f"the temperatures still change by {heat.report.change:.2g} K from round to round; "
                f"try a finer grid (--grid), a smaller time.courant{double} or --isothermal")
    i, j = solver.worst()
    return (f"residual {report.residual:.1e} (tolerance {tolerance:.0e}), largest at X = {v.X[i]:.2f}, Y = {v.Y[j]:.2f}; "
            f"try a finer grid (--grid){double} or a smaller time.courant")
