"""The store as a Dataset: units and names of everything, damaged files by name. The stores are made up."""

import json

import made_results
import numpy as np
import pytest

import tehl_taichi as tehl

pytest.importorskip("xarray")
MOMENTS = ("moment", "resolved_moment", "other_moment", "other_resolved_moment")


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    stress, one = np.zeros((2, 6)), np.zeros(3)
    found = {f"{name}_stress": (stress, [name, "component"], "Pa", "stress") for name in MOMENTS}
    found |= {"normal": (one, ["direction"], "1", "normal"), "circle": (one, ["of_circle"], "Pa", "circle"),
              "mine": (one, ["nothing"], "1", "a dimension of later versions")}
    return made_results.run(tmp_path_factory.mktemp("dataset") / "a.zarr", search=made_results.fatigue(), found=found)


def test_every_variable_has_a_unit_and_a_long_name(path):
    data = tehl.open(path).to_xarray()
    assert [name for name, one in data.variables.items() if not {"units", "long_name"} <= one.attrs.keys()] == []
    assert not {*data.dims} - {*data.coords}
    assert data.component.long_name == "component of the stress" and list(data.component.values[:2]) == ["xx", "yy"]
    assert {data[name].long_name for name in MOMENTS} == {"number of the moment in a stress history; the last one is unloaded"}
    assert list(data.direction.values) == ["x", "y", "z"] and data.of_circle.units == "1"
    assert data.nothing.long_name == "number along nothing"


def test_a_store_that_was_damaged_after_it_was_opened(path):
    run, root = tehl.open(path), path / "zarr.json"
    before = root.read_text()
    content = json.loads(before)
    content["consolidated_metadata"]["metadata"]["film"]["shape"][0] += 1
    root.write_text(json.dumps(content))
    with pytest.raises(tehl.StoreError, match="film/c.5.0.0 is missing"):
        run.to_xarray()
    root.write_text(before[:-9])
    with pytest.raises(tehl.StoreError, match="is not a store of tehl run"):
        run.to_xarray()
    root.write_text(before)
