"""The section of a report on a run-in."""

import itertools

import made_results
import made_run_in
import numpy as np
import pytest
from made_results import THERMAL
from read_pages import numbers, page, values

from tehl_taichi.plastic import run_in_numbers
from tehl_taichi.store import run_in_file

pytest.importorskip("plotly")
pytest.importorskip("jinja2")
pytestmark = pytest.mark.usefixtures("without_library")
STEEL = THERMAL.replace(**{"time.run_in": 1, "bodies.a.yield_stress": 2.2e9, "bodies.b.yield_stress": 2.2e9})


def report(tmp_path, monkeypatch, state):
    monkeypatch.setitem(made_results.EXTRA, "run_in", run_in_numbers.numbers(STEEL, state))
    path = made_results.run(tmp_path / "a.zarr", STEEL, search=made_results.fatigue())
    run_in_file.write(path, state)
    return page(path, tmp_path)


def test_it_has_heights_passages_and_residual_stress_as_the_arrays_of_the_run(tmp_path, monkeypatch):
    state = made_run_in.flowed()
    seen = report(tmp_path, monkeypatch, state)
    assert "Run-in" in seen.headings
    for body, sunk in (("a", 0.3), ("b", 0.01)):
        before, after = (numbers(trace) for trace in seen.figures[f"run-in-height-{body}"]["data"])
        assert (before - after).max() == pytest.approx(sunk, rel=0.02)
    assert values(seen.figures["run-in-passages"]["data"][0]["y"]) == pytest.approx([300, 0])
    arrays = run_in_numbers.arrays(state)
    for body, component in itertools.product("ab", ("xx", "yy")):
        figure = seen.figures[f"run-in-{component}-{body}"]
        stress = next(one[0] for name, one in arrays.items() if name == f"residual_{component}_{body}")
        least = np.min(stress) / 1e6
        assert numbers(figure["data"][0]).min() == pytest.approx(least, rel=1e-4) and figure["data"][0]["zmax"] > 300
        assert f"of body {body}: {least:.0f} to 0 MPa" in seen.text.replace("-0 MPa", "0 MPa")
        assert figure["layout"]["yaxis"]["autorange"] == "reversed"
    assert "After one passage of run-in the height is 1.2 µm (1.5 µm before)" in seen.text


def test_the_chain_has_the_residual_stress_that_was_left_under_the_critical_point(tmp_path, monkeypatch):
    state = made_run_in.flowed()
    seen = report(tmp_path, monkeypatch, state)
    names = {trace["name"]: trace for trace in seen.figures["chain"]["data"]}
    along, depths = (values(names["residual stress along x"][key]) for key in "xy")
    left = state.residual_fields["a"].at(8e-6, 0.0, depths * 1e-6)[0, 0, :, 0]  # the point of made_results
    assert along == pytest.approx(left / 1e6, rel=1e-4, abs=0.1) and along.min() < -100
    assert "with that of run-in is that under the critical point" in seen.text


def test_a_run_whose_steel_stays_elastic_has_no_section(tmp_path, monkeypatch):
    seen = report(tmp_path, monkeypatch, made_run_in.elastic())
    assert "Run-in" not in seen.headings and "Run-in: no steel yields" in seen.text
    assert "residual stress along x" not in {trace.get("name") for trace in seen.figures["chain"]["data"]}
