"""Rows of the research prototype (decision 14) on grids that a test can afford: elastic stress, flow under frozen pressures.

The prototype had the flow of version 0.8, whose pressures were 1.5 % higher and whose von Mises stress was 2 to 3 % higher.
"""

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.fatigue.assessment import Snapshots
from tehl_taichi.fatigue.von_mises import von_mises
from tehl_taichi.plastic import elastic_loads, layers, run_in, steel_body
from tehl_taichi.plastic.steel_body import SteelState

GEAR = tehl.scene("gear").replace(**{"grid.nx": 128, "grid.ny": 32, "thermal.on": False, "fatigue.surfaces": "a",
                                     "time.run_in": 1, "bodies.a.yield_stress": 2.2e9})
MISES = {7.5: 1.59, 12.5: 1.77, 22.5: 1.893, 32.5: 1.85, 47.5: 1.70, 72.5: 1.46, 140: 1.20}  # GPa by depth (um), on 256x64


@pytest.fixture(scope="module")
def passage():
    """The elastic passage."""
    return Snapshots(tehl.march(GEAR))


@pytest.mark.slow
def test_the_elastic_stress_is_that_of_the_prototype(passage):
    found = elastic_loads.histories(GEAR, passage, GEAR.surfaces[0])
    rows = slice(0, found.rows.stop - found.rows.start)
    moments = [t for t in range(found.centres.size) if found.entries[t] and abs(found.centres[t]) < 0.3 * found.a]
    for depth, stress in MISES.items():
        operators = found.stresses(depth * 1e-6)
        largest = max(_mises(found, t, rows, operators) for t in moments)
        assert 0.94 * stress < largest / 1e9 < 1.01 * stress, depth


def _mises(found, t, rows, operators):
    stress = found.under(found.stress_field(int(found.entries[t]), rows, *operators), t)
    return float(von_mises(np.moveaxis(stress, 0, -1)).max())


@pytest.mark.slow
@pytest.mark.parametrize("steel, limit, sinking, strain, stress", [
    ("swift-52100", 2.374e9, 5.8e-9, 2.6e-4, (-18e6, 6e6)), ("perfect", 1.67e9, 31e-9, 2.6e-3, (-148e6, 72e6)),
    ("perfect", 1.5e9, 124e-9, 6.0e-3, (-301e6, 137e6))])
def test_flow_under_frozen_pressures_at_equal_stress_over_yield_stress(passage, steel, limit, sinking, strain, stress):
    """The yield stress is lower by the ratio of the elastic stresses; the prototype had 256x64 cells.

    The prototype sinks by 6 to 13 % more: its images sink the rim by a tenth, and layers half as thick change nothing here (the
    next test).
    """
    ratio = _first(GEAR.replace(**{"bodies.a.yield_stress": 1.5e9}), passage)[2].largest * 1.5e9 / 1.893e9
    scene = GEAR.replace(**{"bodies.a.yield_stress": limit * ratio, "bodies.a.hardening": steel})
    histories, cells, loads = _first(scene, passage)
    left = steel_body.state_after(cells, SteelState.virgin(cells), loads.moments)
    again = run_in._steel_after(histories, cells, left)
    assert 0.95 < ratio < 0.99
    assert left.sinking.max() == pytest.approx(sinking, rel=0.14) and left.hardened.max() == pytest.approx(strain, rel=0.06)
    along = left.residual[:, :2]
    assert along.min() == pytest.approx(stress[0], rel=0.07) and 0.6 * stress[1] < along.max() < 1.2 * stress[1]
    assert again.sinking.max() - left.sinking.max() < 0.03 * sinking  # prototype: 0.3 % at 1.5 GPa


@pytest.mark.slow
@pytest.mark.parametrize("limit", [1.65e9, 1.45e9])
def test_layers_half_as_thick_give_the_same_flow(passage, limit, monkeypatch):
    """With layers of 0.025 a the surface sank by 18 and 5 % more."""
    found = []
    for thinnest in (layers.THINNEST, layers.THINNEST / 2):
        monkeypatch.setattr(layers, "THINNEST", thinnest)
        _, cells, loads = _first(GEAR.replace(**{"bodies.a.yield_stress": limit}), passage)
        found.append(steel_body.state_after(cells, SteelState.virgin(cells), loads.moments))
    coarse, fine = found
    assert coarse.sinking.max() == pytest.approx(fine.sinking.max(), rel=0.04)
    assert coarse.hardened.max() == pytest.approx(fine.hardened.max(), rel=0.03)


def _first(scene, passage):
    histories, cells = run_in._cells(elastic_loads.histories(scene, passage, scene.surfaces[0]))
    return histories, cells, elastic_loads.find(histories, cells, SteelState.virgin(cells))
