"""Estimate of the memory of a run-in, against what its arrays take."""

import tracemalloc

import numpy as np
import pytest
from rolling import Rolling

import tehl_taichi as tehl
from tehl_taichi.disk import memory_limit
from tehl_taichi.errors import SceneError
from tehl_taichi.plastic import elastic_loads, memory, run_in, steel_body
from tehl_taichi.plastic.steel_body import SteelState

GEAR = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.run_in": 1,
                                     "bodies.a.yield_stress": 2.2e9})


class OnGrid(Rolling):
    """The passage on the nodes of the scene."""

    def __init__(self, scene):
        super().__init__(scene)
        grid, a = scene.grid, self.s.a
        self.x = np.linspace(grid.x_min, grid.x_max, grid.nx + 1) * a
        self.y = np.linspace(0, grid.y_max, scene.rows + 1) * a if scene.rows else np.zeros(1)


def taken(scene):
    """Bytes at most while a body answers plastic strain in all of its cells."""
    _, cells = run_in._cells(elastic_loads.histories(scene, OnGrid(scene), scene.surfaces[0]))
    tracemalloc.start()
    state = SteelState.virgin(cells)
    state.strain[:] = np.random.default_rng(1).random(state.strain.shape)
    steel_body._answer(cells, cells.half_space(), state.strain)
    found = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return found


@pytest.mark.parametrize("changes", [{}, {"grid.nx": 128, "grid.ny": 32}, {"feature.width": 6e-4},
                                     {"feature.height": 1e-6, "feature.length": float("inf"), "grid.nx": 512}])
def test_it_is_within_a_quarter(changes):
    scene = GEAR.replace(**changes)
    assert memory.needed_bytes(scene) == pytest.approx(taken(scene), rel=0.25)


def test_a_run_without_it_needs_none():
    assert memory.needed_bytes(GEAR.replace(**{"time.run_in": 0})) == 0.0


def test_a_run_in_that_finds_no_room_is_refused_where_the_passage_has_it(tmp_path, monkeypatch):
    large = GEAR.replace(**{"grid.nx": 1024, "grid.ny": 256})
    monkeypatch.setattr(memory_limit, "available", lambda: 4e9)
    with pytest.raises(SceneError, match=r"a run on 1024 x 256 cells with run-in \(7\.\d+ GB\) needs 8\.\d+ GB"):
        tehl.run(large, tmp_path / "a.zarr")
    assert list(tmp_path.iterdir()) == []
