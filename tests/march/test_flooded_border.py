"""Solves of a start after the first one, for the oil beyond the border, and what a failed one leaves."""

from types import SimpleNamespace

import numpy as np
import pytest

from tehl_taichi.march import flooded_border
from tehl_taichi.march.isothermal_start import from_nothing, put
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.isothermal import OneTemperature
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.pressure.newton import PressureSolver
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

SETTLED = SimpleNamespace(agrees=lambda: True)


def with_whole_load():
    """(solver, report) of a thick film beside a short inlet, whose grid carries the load of the oil beyond it, too."""
    thick = scene("smooth-line").replace(**{"hertz_pressure": 5e8, "speed": 20.0, "temperature": 60.0, "thermal.on": False,
                                            "grid.nx": 64, "grid.x_min": -2.5})
    solver = PressureSolver(levels := Levels(thick, Scales.of(thick), 64, 0), OneTemperature(levels))
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
