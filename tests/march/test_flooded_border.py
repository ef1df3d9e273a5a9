"""Solves of a start after the first one, for the oil beyond the border, and what a failed one leaves."""

from types import SimpleNamespace

import numpy as np
import pytest

from tehl_taichi.march import flooded_border
from tehl_taichi.march.accuracy.domain_error import domain_error
from tehl_taichi.march.failure import not_converged
from tehl_taichi.march.isothermal_start import from_nothing, put
from tehl_taichi.march.steady import solve_steady
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.grids import load_weights
from tehl_taichi.pressure.inlet import Inlet
from tehl_taichi.pressure.isothermal import OneTemperature
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.pressure.newton import PressureSolver
from tehl_taichi.scene import scene, thick_film

SETTLED = SimpleNamespace(agrees=lambda: True)


def with_whole_load():
    """(solver, report) of a thick film beside a short inlet, whose grid carries the load of the oil beyond it, too."""
    thick = scene("smooth-line").replace(**{"hertz_pressure": 5e8, "speed": 20.0, "temperature": 60.0, "thermal.on": False,
                                            "grid.nx": 64, "grid.x_min": -2.5})
    solver = PressureSolver(levels := Levels(thick, 64, 0), OneTemperature(levels))
    levels.put(fields.GAP0, levels.smooth_gap())
    solver.border = flooded_border.border_of(levels)
    report, solver.border = from_nothing(solver), None
    assert report.converged and solver.load == levels.scales.load
    return solver, report


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("name, again", [("solve_from_table", flooded_border.share_load),
                                         ("solve_again", lambda *one: flooded_border.iterate_border(one[0], SETTLED, one[1]))])
def test_a_failed_second_solve_leaves_the_first_state_with_its_load(monkeypatch, name, again):
    solver, report = with_whole_load()
    P, H0, load = solver.levels.get(fields.P), solver.H0, solver.load
    loads = []

    def fail(failing, *_):
        loads.append(failing.load)
        put(failing, 2 * P, H0 + 1)
        return SimpleNamespace(converged=False)

    monkeypatch.setattr(flooded_border, name, fail)
    assert again(solver, report) is report
    assert loads[0] < load  # the oil beyond the border carries the rest
    assert np.array_equal(solver.levels.get(fields.P), P) and (solver.H0, solver.load) == (H0, load) and solver.holds()


def starting(**changes):
    """SteadyResult of a thick line beside an inlet at -2.5 a."""
    thick = scene("smooth-line").replace(**{"hertz_pressure": 2e8, "temperature": 60.0, "srr": 0.0, "thermal.on": False,
                                            "grid.x_min": -2.5, "grid.x_max": 1.5, "grid.nx": 64, **changes})
    return solve_steady(thick, 64, 0)


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("speed, missed", [(5.0, 0.065), (20.0, 0.60)])
def test_a_load_error_counts_all_oil_beyond_the_border(speed, missed):
    """That oil would carry more than half of the load. Bars contain what grid and oil miss; half of the load leaves no film."""
    found = starting(speed=speed)
    v = found.solver.levels
    carried = np.sum(load_weights(v) * v.get(fields.P)) + Inlet(v).load()
    assert found.report.load_error == pytest.approx(carried / v.scales.load - 1, abs=1e-5) == pytest.approx(missed, rel=0.02)
    assert found.report.converged == (missed < flooded_border.UNSHARED)
    assert min(domain_error(found.solver).film, domain_error(found.solver).pressure) > 2 * missed
    if not found.report.converged:
        said = str(not_converged(found.solver, None, found.report, "the steady start"))
        assert f"the contact carries {1 + missed:.0%} of its load" in said and "grid.x_min=-20" in said
        assert thick_film.REMEDY in str(not_converged(found.solver, None, found.report, "a start", passing=True))


@pytest.mark.usefixtures("taichi_cpu")
def test_a_solve_that_fails_with_the_shared_load_leaves_a_load_error(monkeypatch):
    solver, report = with_whole_load()
    monkeypatch.setattr(flooded_border, "solve_from_table", lambda failing: SimpleNamespace(converged=False))
    found = flooded_border.with_whole_load(solver, flooded_border.share_load(solver, report))
    assert found.load_error == pytest.approx(Inlet(solver.levels).load() / solver.levels.scales.load, abs=1e-5)
    assert found.converged and 0.1 < 2 * found.load_error < domain_error(solver).film
