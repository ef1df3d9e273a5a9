"""Properties of a run-in: loads against brute force, residual stress, the rim, numbers of both bodies, features off the
axis."""

from dataclasses import replace
from types import SimpleNamespace

import made_run_in
import numpy as np
import pytest
from numpy.testing import assert_allclose
from rolling import Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue.von_mises import von_mises
from tehl_taichi.plastic import elastic_loads, memory, run_in, run_in_numbers
from tehl_taichi.plastic.steel_body import SteelState

STEEL = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "bodies.a.yield_stress": 1.5e9,
                                      "time.run_in": 3})


def passage_and_cells(scene):
    return run_in._cells(elastic_loads.histories(scene, Rolling(scene), scene.surfaces[0]))


def virgin_loads(scene):
    passage, cells = passage_and_cells(scene)
    return elastic_loads.find(passage, cells, SteelState.virgin(cells))


def test_cells_have_the_sides_of_the_grid():
    reader, (_, cells) = Rolling(STEEL), passage_and_cells(STEEL)
    assert cells.sides == pytest.approx((reader.x[1] - reader.x[0], reader.y[1] - reader.y[0]))


def test_the_residual_stress_of_the_scene_is_part_of_the_loads():
    """At one moment and layer the loads of cells that are followed with it and without it differ by it."""
    found, residual = [], {"fatigue.residual_xx": -2e8, "fatigue.residual_yy": 1e8}
    for scene in (STEEL, STEEL.replace(**residual)):
        passage, cells = passage_and_cells(scene)
        look = elastic_loads._Look(passage, cells, SteelState.virgin(cells))
        moment, layer = look.times[len(look.times) // 2], cells.layers.count // 2
        seen = look.at(layer, [moment])[moment]
        found.append(dict(zip(zip(*seen.places), seen.stress)))
    both = found[0].keys() & found[1].keys()
    assert both
    for cell in both:
        assert_allclose(found[1][cell] - found[0][cell], [-2e8, 1e8, 0, 0, 0, 0], atol=1e4)


def test_steel_flows_by_shear_also_where_fatigue_leaves_it_out():
    with_shear, without = (virgin_loads(STEEL.replace(**{"fatigue.shear": on})).largest for on in (True, False))
    assert with_shear == without


def test_cells_that_residual_stress_brings_near_yielding_are_followed():
    """Against all cells of every layer, at two moments: none of those near the flow stress is left out, with residual stress
    or, because flow changes it, without."""
    passage, cells = passage_and_cells(STEEL)
    state, left = SteelState.virgin(cells), np.array([-6e8, 0, 0, 0, 0, 0])
    state.residual[:, 0] = left[0]
    look = elastic_loads._Look(passage, cells, state)
    middle = len(look.times) // 2
    for layer, depth in enumerate(cells.layers.depths):
        operators = passage.stresses(depth)
        for moment, seen in look.at(layer, look.times[middle : middle + 2]).items():
            field = passage.stress_field(int(passage.entries[moment]), look.rows, *operators)
            stress = np.moveaxis(np.array(passage.under(field, moment)), 0, -1)
            followed = np.zeros(stress.shape[:-1], bool)
            followed[seen.places[1], seen.places[2]] = True
            for each in (stress + left, stress):
                assert followed[von_mises(each) > elastic_loads.NEAR * look.limits[layer]].all()


def test_a_layer_has_the_ratios_of_the_layers_of_the_first_look_around_it():
    found = {layer: {0: SimpleNamespace(largest=0.1 * layer), 1: SimpleNamespace(largest=0.0)}
             for layer in range(0, 9, elastic_loads.EVERY)}
    assert [sorted(elastic_loads._neighbouring_ratios(found, layer)) for layer in (0, 1, 4, 7, 9)] == [
        [0.0], [0.0, 0.4], [0.4], [0.4, 0.8], [0.8]]


@pytest.mark.parametrize("sinking, change, settled", [(1e-6, 1.9e-8, True), (1e-6, 2.1e-8, False), (1e-8, 0.9e-9, True),
                                                      (1e-8, 1.1e-9, False)])
def test_a_surface_settles_within_its_share_or_a_nanometre(sinking, change, settled):
    zero, left = np.zeros((1, 6, 2, 1)), np.array([[sinking], [0.0]])
    steel = SteelState(zero, zero[:, 0], zero, left)
    body = run_in.BodyRunIn(np.arange(2.0), np.zeros(1), np.ones(1), False, steel, left - change)
    state = run_in._next_round(run_in.RunInState({"a": body}), {"a": steel})
    assert (state.passages, state.rounds) == ((1, 0) if settled else (0, 1)) and state.unsettled == 0.0


def test_the_range_of_residual_stress_is_that_of_the_components_in_the_store():
    """Those along x and y: others may be larger."""
    state = made_run_in.flowed()
    for one in state.bodies.values():
        one.start.residual[:, 2] *= 5
        one.start.residual[:, 3] = 9e9
    numbers, arrays = run_in_numbers.numbers(STEEL, state), run_in_numbers.arrays(state)
    for name in "ab":
        stored = np.stack([arrays[f"residual_{component}_{name}"][0] for component in ("xx", "yy")])
        own = numbers["by_surface"][name]
        assert (own["residual_min_Pa"], own["residual_max_Pa"]) == pytest.approx((stored.min(), stored.max()), rel=1e-6)


@pytest.mark.parametrize("more", ["a", "b"])
def test_numbers_of_both_bodies_are_the_extremes_of_each(more):
    """Whichever body has flowed more."""
    state = made_run_in.flowed()
    if more == "b":
        state = replace(state, bodies={"a": state.bodies["b"], "b": state.bodies["a"]})
    numbers = run_in_numbers.numbers(STEEL, state)
    each = {name: one.start for name, one in state.bodies.items()}
    assert numbers["surface_change_max_m"] == pytest.approx(max(np.abs(one.sinking).max() for one in each.values()))
    assert numbers["plastic_strain_max"] == pytest.approx(each[more].hardened.max())
    assert numbers["residual_min_Pa"] == pytest.approx(each[more].residual[:, :2].min())
    assert numbers["residual_max_Pa"] == pytest.approx(max(one.residual[:, :2].max() for one in each.values()), abs=1.0)
    assert each[more].hardened.max() > 1.5 * min(one.hardened.max() for one in each.values())


@pytest.mark.parametrize("at, contained", [((-1, 5, 2), False), ((1, 0, 2), False), ((1, -1, 2), False), ((1, 5, -1), False),
                                           ((1, 5, 2), True), ((0, 5, 0), True)])
def test_flow_at_any_rim_of_the_region_is_not_contained(at, contained):
    """Layer, x, y of the cell that flowed: the surface and a plane of symmetry are no rims."""
    body = made_run_in.body(0.0)
    body.start.hardened[at] = 1e-4
    assert run_in._contained(body) == contained


def test_the_new_strain_of_a_passage_is_that_of_the_body_that_flows_more():
    state = made_run_in.flowed()
    added = {"a": 1e-4, "b": 3e-4}
    starts = {name: body.start for name, body in state.bodies.items()}
    after = {name: replace(start, hardened=start.hardened + added[name]) for name, start in starts.items()}
    record = run_in._record(state, after)
    assert record["new_plastic_strain"] == pytest.approx(3e-4) and record["new_by_surface"] == pytest.approx(added)


@pytest.mark.parametrize("y", [5e-5, 2e-4])
def test_the_height_before_is_that_of_the_feature_off_the_axis(y):
    """The second one lies partly beyond the region, whose highest point is at its rim."""
    scene, state = STEEL.replace(**{"feature.y": y}), made_run_in.flowed()
    feature, body = scene.features[0], state.bodies["a"]
    top = max(feature.height_at(along - feature.x, across - feature.y) for along in body.x for across in body.y)
    assert run_in_numbers.numbers(scene, state)["height_before_m"] == pytest.approx(top)
    assert (top == pytest.approx(feature.height, rel=0.02)) == (y < made_run_in.Y[-1])


def test_the_height_after_is_that_of_what_did_not_sink():
    scene, state = STEEL.replace(**{"feature.y": 5e-5}), made_run_in.flowed()
    feature, body = scene.features[0], state.bodies["a"]
    left = max(feature.height_at(along - feature.x, across - feature.y) - body.start.sinking[i, j]
               for i, along in enumerate(body.x) for j, across in enumerate(body.y))
    found = run_in_numbers.numbers(scene, state)
    assert found["height_after_m"] == pytest.approx(left) and left < found["height_before_m"]


def test_twice_the_rows_need_twice_the_memory():
    narrow, wide = (memory.needed_bytes(STEEL.replace(**{"grid.nx": 128, "grid.ny": rows})) for rows in (16, 32))
    assert wide == pytest.approx(2 * narrow, rel=0.25)


@pytest.mark.slow
def test_steel_that_has_shaken_down_under_a_narrow_asperity_holds_its_yield_stress(tmp_path):
    """Elastic and perfectly plastic: between the layers the stress exceeds it by no more than 1 %."""
    scene = tehl.scene("gear").replace(**{
        "hertz_pressure": 1.45e9, "feature.height": 0.8e-6, "feature.width": 120e-6, "thermal.on": False, "grid.nx": 64,
        "grid.ny": 16, "numerics.estimate_error": False, "time.run_in": 3, "bodies.a.yield_stress": 9e8,
        "bodies.b.yield_stress": 9e8})
    summary = tehl.run(scene, tmp_path / "narrow.zarr").summary
    assert summary["run_in"]["shaken_down"] and summary["run_in"]["plastic_strain_max"] > 1e-4
    for found in summary["fatigue_by_surface"].values():
        assert found["von_mises"]["max_Pa"] < 1.01 * 9e8
