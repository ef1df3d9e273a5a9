"""Numbers with names: what a launch reads after they were set anew, and names that there are not."""

import numpy as np
import pytest

from tehl_taichi.engine.records import Record
from tehl_taichi.engine.taichi_patches.prebound import bind
from tehl_taichi.heat import departure_points, film_tables
from tehl_taichi.heat.heat_step import Drift, HeatStep
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene import scene

pytestmark = pytest.mark.usefixtures("taichi_cpu")


def test_a_bound_launch_reads_each_number_by_its_name():
    """The launch is bound before the numbers are set: it must see the new ones, each in its own place."""
    description = scene("smooth-line").replace(**{"thermal.on": True, "grid.nx": 64})
    levels = Levels(description, 64, 0)
    columns, step = film_tables.FilmTables(levels, 5), Record(HeatStep)
    x = np.arange(65.0)[None, None, :] + np.zeros((5, 1, 1))
    departures = bind(departure_points.departures, levels.S, columns.field, columns.singles.field, levels.G, 5,
                      levels.conditions.values, step.values, np.zeros((2 * levels.fine, film_tables.TOLD)))
    columns.put_nodes(film_tables.TN, x)
    columns.put_nodes(film_tables.TNN, 100 + x)
    columns.put_nodes(film_tables.U, np.full_like(x, 2.0))
    step.set(inv_x=0.5, back=3.0, back_2=5.0, near=0.75, far=0.25)
    departures()
    inner = slice(8, -8)
    np.testing.assert_allclose(columns.nodes(film_tables.TS)[2, 0, inner], (x - 3.0 + 0.25 * (100 - 2.0))[2, 0, inner])
    step.set(near=1.0, far=0.0)
    departures()
    np.testing.assert_allclose(columns.nodes(film_tables.TS)[2, 0, inner], (x - 3.0)[2, 0, inner])


def test_a_number_that_a_struct_does_not_have_is_refused():
    drift = Record(Drift, shift=2)
    drift.set(rest=0.25)
    assert (drift["shift"], drift["rest"], drift["B_last"]) == (2.0, 0.25, 0.0)
    with pytest.raises(KeyError, match="speed"):
        drift.set(speed=1.0)
