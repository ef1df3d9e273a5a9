"""A search result as arrays of a store and back."""

from dataclasses import fields

import numpy as np
import pytest
from rolling import Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment
from tehl_taichi.fatigue.search_result import ARRAYS, HISTORIES, SearchResult

GEAR = tehl.scene("gear").replace(**{"thermal.on": False, "srr": 0.0})


def same(one, other):
    """Whether two results have equal numbers and arrays, also of their resolved parts and of the other body."""
    np.testing.assert_equal({name: getattr(one, name) for name in (*ARRAYS, *HISTORIES)},
                            {name: getattr(other, name) for name in (*ARRAYS, *HISTORIES)})
    return one.summary == other.summary and all(a is b is None or same(a, b) for a, b in
                                                ((one.resolved, other.resolved), (one.other, other.other)))


@pytest.mark.parametrize("changes, until", [({}, None), ({"fatigue.depths": [30e-6]}, -0.3)])
def test_arrays_give_the_result_back(taichi_cpu, changes, until):
    scene = GEAR.replace(**changes)
    found = assessment.run(scene, Rolling(scene), until=until)
    arrays = found.to_arrays()
    again = SearchResult.from_arrays(found.summaries, lambda name: arrays[name][0] if name in arrays else None)
    assert same(found, again) and (again.part is None) == (until is None)
    assert all(np.ndim(values) == len(dims) for values, dims, *_ in arrays.values())
    assert again.other.summary["surface"] != again.summary["surface"]
    if until:
        assert again.part.summary["sigma_eF_Pa"] == 400e6 and again.part.feature_frame_x is again.feature_frame_x
        assert arrays["resolved_worst_stress"][1] == ["resolved_moment", "component"]
        assert again.row_depths is again.under_row_depth and again.fatigue_depth[1] == 30e-6


def test_the_fields_are_the_arrays():
    assert {f.name for f in fields(SearchResult)} == {*ARRAYS, *HISTORIES, "summary", "resolved", "other"}


def test_the_old_name_warns():
    with pytest.warns(DeprecationWarning, match="tehl.SearchResult"):
        assert tehl.FatigueResult is SearchResult
