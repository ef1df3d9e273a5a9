"""Which error bars the coverage suite judges, and against what."""

from dataclasses import asdict

import numpy as np
import pytest
from tehl_taichi.profiles import coverage

from tehl_taichi.march.accuracy.error_bars import GridReading

OWN = {"p_max_Pa": 2.0, "friction_coefficient_mean": 0.0, "a:Fi_max": 0.9, "a:averaged_Fi_max": 0.8, "b:Fi_max": 0.7,
       "b:averaged_Fi_max": 0.7, "a:0 um.share_above_1": 0.1, "a:0 um.median": 0.6}


def row(kind, **finer):
    """A passage whose coarse-grid runs gave the same numbers."""
    own = {name: asdict(GridReading(value, positive=True)) for name, value in OWN.items()}
    return {"kind": kind, "own": own, "answers": [{"values": own}, {"values": own}], "finer": {**OWN, **finer}, "inlet": 90.0}


def names(kind):
    return {name for _, name, *_ in coverage.judged([row(kind)])}


def test_a_passage_is_judged_by_what_a_run_states():
    """No friction without slip, no average over less than a cell, and of percentiles those of rough surfaces."""
    assert names("asperity") == {"p_max_Pa", "a:Fi_max", "a:averaged_Fi_max", "b:Fi_max", "share_above_1, surface"}
    assert names("rough") == {"share_above_1, surface", "median, surface"}


def test_an_error_is_the_distance_from_the_finer_grid():
    found = {name: real for _, name, _, _, real in coverage.judged([row("asperity", p_max_Pa=2.25)])}
    assert found["p_max_Pa"] == pytest.approx(0.25) and found["a:Fi_max"] == 0


def test_numbers_that_one_grid_lacks_are_not_compared(monkeypatch):
    """Depths differ between grids."""
    monkeypatch.setattr(coverage, "on_finer", lambda scene: "finer")
    monkeypatch.setattr(coverage, "on_longer", lambda scene: "longer")
    given = {"finer": {"p": 2.0, "q": 1.0}, "longer": {"p": 1.5, "r": 1.0}}
    scene = coverage.scene("gear").replace(**{"grid.nx": 64})
    found = coverage.truth(scene, lambda one: given[one] if isinstance(one, str) else {"p": 1.25, "q": 1.0})
    assert found == {"p": pytest.approx(2.25)} and np.isfinite(found["p"])
