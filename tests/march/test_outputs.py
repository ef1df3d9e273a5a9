"""Fields and numbers of a step: entries that make snapshots, and that a store keeps."""

import json

import numpy as np
import pytest
from small_stores import SMALL, shot, store
from values.test_registry import hold

from tehl_taichi.march import quantities, step_output
from tehl_taichi.march.step_output import Field, Scalar, entries, fields_of, scalars_of
from tehl_taichi.store.store import Store

EVERY = {**entries(Field), **entries(Scalar)}


@pytest.mark.parametrize("name", EVERY)
def test_every_output_holds(name):
    hold(EVERY[name])
    assert EVERY[name].unit


def test_temperatures_are_outputs_of_scenes_that_have_them():
    warm = SMALL.replace(**{"thermal.on": True, "output.profiles": True})
    assert set(fields_of(warm)) - set(fields_of(SMALL)) == {"temperature_a", "temperature_b", "temperature_mid", "temperature"}
    assert "temperature" not in fields_of(warm.replace(**{"output.profiles": False}))
    assert set(scalars_of(warm)) - set(scalars_of(SMALL)) == {"film_max_C", "surface_a_max_C", "surface_b_max_C",
                                                              "temperature_change_K", "clamped"}


def without(monkeypatch, name):
    """As a program that has no such output."""
    fewer = {key: field for key, field in entries(Field).items() if key != name}
    monkeypatch.setattr(step_output, "entries", lambda kind: fewer if kind is Field else entries(kind))


def test_a_store_from_before_an_output_opens_and_goes_on_without_it(tmp_path, monkeypatch):
    with monkeypatch.context() as patch:
        without(patch, "contact")
        store(tmp_path / "s.zarr")
    with Store.write(tmp_path / "s.zarr") as saved:
        saved.append(shot(3), shot(3).state)
    again = Store.open(tmp_path / "s.zarr")
    assert len(again) == 4 and "contact" not in again.fields(3) and np.all(again.fields(3)["film"] == 4.5)


def test_a_store_that_lost_an_output_is_damaged(tmp_path):
    store(tmp_path / "s.zarr")
    root = tmp_path / "s.zarr" / "zarr.json"
    data = json.loads(root.read_text())
    del data["consolidated_metadata"]["metadata"]["contact"]
    root.write_text(json.dumps(data))
    with pytest.raises(Exception, match="it has no array 'contact'"):
        Store.open(tmp_path / "s.zarr")


def test_a_mean_of_a_passage_is_that_of_its_steps():
    """Entries after 1, 3 and 4 steps; the steady start is no step."""
    mean = quantities.of_key("friction_coefficient_mean")
    assert mean.of(np.array([9.0, 0.01, 0.04, 0.03]), np.array([1, 2, 1])) == pytest.approx((0.01 + 2 * 0.04 + 0.03) / 4)


def test_a_new_number_of_the_summary_is_one_entry(taichi_cpu, tmp_path, monkeypatch):
    """With its error bar, its row in `tehl show`, its name and unit in reports."""
    import tehl_taichi as tehl
    from tehl_taichi.report.run_tables import _meaning
    from tehl_taichi.runs.summary.summary_rows import summary_rows

    entry = quantities.Entry(part="transient", key="h_c_mean_m", series="h_c_m", over="mean", error="plain",
                             label="passage h_c, mean", factor=1e6, shown="um")
    monkeypatch.setattr(quantities, "ENTRIES", (*quantities.ENTRIES, entry))
    scene = tehl.scene("furrow-line").replace(**{"grid.nx": 128, "time.steps": 8, "fatigue.on": False,
                                                 "numerics.estimate_error": True})
    run = tehl.run(scene, tmp_path / "a.zarr")
    found = run["h_c_mean"]
    assert found.value == pytest.approx(run.store.scalar("h_c_m")[1:].mean(), rel=1e-12) and found.unit == "m"
    assert found.error and "passage h_c, mean" in dict(summary_rows(run.summary))
    assert _meaning("h_c_mean_m") == ("film at x = 0, far edge, mean", "m")
