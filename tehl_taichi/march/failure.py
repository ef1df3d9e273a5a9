"""Reason of a failed solve, as a sentence with a remedy."""

import numpy as np

from tehl_taichi.errors import NotConverged
from tehl_taichi.heat.energy import HOT
from tehl_taichi.march.flooded_border import UNSHARED
from tehl_taichi.pressure import fields
from tehl_taichi.scene import domain, domain_warnings, overlap, refinement, thick_film, thin_film
from tehl_taichi.scene.film_formula import heated_film
from tehl_taichi.values.digits import number_of

AT_FLOOR = 1e-3  # relative, that a film on its floor may lie above
HIGH = 5.0  # central films, more than a usual asperity (1.5 um over 0.4): features that rise so far are named


def not_converged(solver, heat, report, where, passing=False):
    """NotConverged for the state in the solver's table.

    heat: its FilmHeat or None; where: text of the moment; passing: the features are in the contact.
    """
    return NotConverged(f"{where} did not converge: {_reason(solver, heat, report, passing)}")


def crossed_surfaces(shot, a, border):
    """NotConverged for a snapshot with a negative film at nodes of the border (True in an array like its fields); a: m."""
    film = np.where(border, shot.fields["film"], np.inf)
    i, j = np.unravel_index(film.argmin(), film.shape)
    return NotConverged(f"step {shot.step}: the surfaces cross at the border of the grid, a film of {film[i, j]:.2g} m at X = "
                        f"{shot.x[i] / a:.2f}: features are higher than the gap there; use a larger domain (grid.x_min, "
                        "grid.x_max, grid.y_max)")


def _reason(solver, heat, report, passing):
    scene = solver.levels.scene
    others = [", a smaller time.courant"] * scene.transient + [", --precision f64"] * (solver.levels.precision != "f64")
    remedy = (next(thick_film.warnings(scene), "") or not passing and domain.too_short(scene) or _overloaded(solver, report)
              or _on_its_floor(solver, passing) or f"try a finer grid (--grid){''.join(others)}")
    return f"{_what_failed(solver, heat, report)}; {remedy}"


def _what_failed(solver, heat, report):
    """Text of the first failed part: pressure, mass, temperatures."""
    numerics = solver.levels.scene.numerics
    if not report.residual < numerics.tolerance:
        return (f"residual {report.residual:.1e} (tolerance {numerics.tolerance:.0e}), largest at {_worst(solver)}"
                f"{_heated(heat)}")
    if not report.mass_error < numerics.mass_tolerance:
        return f"mass error {report.mass_error:.1e} (tolerance {numerics.mass_tolerance:.0e}){_heated(heat)}"
    if _overloaded(solver, report):
        return f"with the oil beyond the domain the contact carries {1 + report.load_error:.0%} of its load"
    if not heat:
        return "film and oil pressure at the border of the grid do not agree"
    if not heat.sound:
        return _heated(heat)[2:]
    if not np.isfinite(heat.report.change):
        return "no further time step converges"
    return f"the temperatures still change by {heat.report.change:.2g} K"


def _overloaded(solver, report):
    """Advice where a solution on the grid and the oil beyond it do not carry the load of the scene together, "" otherwise."""
    numerics = solver.levels.scene.numerics
    solved = report.residual < numerics.tolerance and report.mass_error < numerics.mass_tolerance
    return thick_film.REMEDY if solved and abs(report.load_error) > UNSHARED else ""


def _worst(solver):
    i, j = solver.worst()
    return f"X = {solver.levels.X[i]:.2f}, Y = {solver.levels.Y[j]:.2f}"


def _heated(heat):
    """Reason in the temperatures, "" if there is none."""
    if not heat or heat.sound:
        return ""
    found = [f"limited to their range (up to {HOT:g} deg C) at {number_of(heat.held, 'node')}"] * bool(heat.held)
    found += [f"without a solution in {number_of(heat.report.failed, 'column')}"] * bool(heat.report.failed)
    return f", temperatures {' and '.join(found)}" if found else ""


def _on_its_floor(solver, passing):
    """Advice for a film at the lower limit of the equations, "" otherwise."""
    v = solver.levels
    floor, nodes = v.G[0, fields.FLOOR], int((v.get(fields.H) < (1 + AT_FLOOR) * v.G[0, fields.FLOOR]).sum())
    if not nodes:
        return ""
    return (f"the film is on its floor ({floor * v.scales.h:.1e} m, rheology.film_floor) at {number_of(nodes, 'node')}: "
            f"{passing and _too_high(v.scene) or f'too thin for this grid, {_finer(v.scene)}'}")


def _too_high(scene):
    """Text about features that no film carries, "" without any; a map may contain the form of its body, or have another
    unit.
    """
    film = heated_film(scene)
    if (top := overlap.highest_at(scene, 0.0, HIGH * film)) <= HIGH * film:
        return ""
    measured = any(f.kind.measured for f in scene.features)
    remedy = " (check feature.unit, and remove the form with feature.level)" if measured else ""
    who = domain_warnings.higher(scene, top, ("a feature rises", "overlapping features rise"))
    return (f"{who} {top:.2g} m{remedy} where the film formula has {film:.2g} m; use a lower feature, or try "
            f"{refinement.finer_grid_option(scene)}")


def _finer(scene):
    """Advice: the next finer grid, or the grid that the film formula needs."""
    return (thin_film.remedy(scene) if thin_film.resolved_ratio(scene) < 1
            else f"use a finer one, {refinement.finer_grid_option(scene)}")
