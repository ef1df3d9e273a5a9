"""Run-in over passages made of formulas: rounds of the first passage, the end of it, residual fields, surfaces, refusals."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from rolling import Rolling

import tehl_taichi as tehl
from tehl_taichi.crack import symmetry_plane
from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.fatigue import local_strength
from tehl_taichi.fatigue.sought import Box
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.stress.residual_field import ResidualField
from tehl_taichi.fatigue.stress.row_histories import at_the_surface, histories_of
from tehl_taichi.plastic import elastic_loads, run_in, run_in_numbers, steel_body
from tehl_taichi.plastic.layers import Layers
from tehl_taichi.plastic.surface_change import SurfaceChange
from tehl_taichi.runs.summary import search_rows
from tehl_taichi.scene.strength.strength import Strength
from tehl_taichi.store import run_in_file
from tehl_taichi.store.integrity import CHECKPOINTS

GEAR = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False})
STEEL = GEAR.replace(**{"bodies.a.yield_stress": 1.5e9, "time.run_in": 3})


class Flattened(Rolling):
    """A passage whose bump of pressure falls with the surface, to nothing where that has sunk by `soft` (m)."""

    soft = 400e-9

    def __init__(self, scene, changes=()):
        super().__init__(scene)
        sunk = max((float(change.sinking.max()) for change in changes), default=0.0)
        self.left = 1 - sunk / self.soft
        self.items = list(range(len(self)))

    def fields(self, n, names):
        smooth, found = super().fields(0, names), super().fields(n, names)
        return {name: smooth[name] + self.left * (found[name] - smooth[name]) for name in found}


def repeated(scene, soft=400e-9):
    seen, kept = [], []

    def march(changes):
        seen.append(changes)
        return type("Reader", (Flattened,), {"soft": soft})(scene, changes)

    return *run_in.repeat_passages(scene, march, keep=kept.append), seen, kept


@pytest.fixture(scope="module", autouse=True)
def few_layers():
    """Six of them: most time goes into what each of them needs."""
    found = Layers(2.17e-4 * np.r_[np.full(6, 0.1), 0.1 * 1.7 ** np.arange(1, 10)], 6)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(run_in, "layers", lambda *_: found)
        yield


@pytest.fixture(scope="module")
def done(few_layers):
    return repeated(STEEL)


@pytest.fixture(scope="module")
def both(few_layers):
    """One passage, both bodies."""
    return repeated(STEEL.replace(**{"bodies.b.yield_stress": 1.5e9, "time.run_in": 1}))[1]


def test_the_first_passage_is_repeated_until_its_surface_is_the_one_that_it_leaves(done):
    _, state, seen, kept = done
    first = state.records[0]
    assert not seen[0] and 3 <= first["rounds"] <= run_in.ROUNDS and state.unsettled == 0.0
    before = seen[first["rounds"] - 1][0].sinking  # what the last round saw, and what it left
    left = kept[first["rounds"] - 1].bodies["a"].start.sinking
    assert np.abs(left - before).max() <= run_in.SAME * left.max() and left.max() > 10e-9
    frozen = kept[0].rest.max()  # of the pressures of the elastic passage: too much
    assert left.max() < 0.9 * frozen


def test_passages_end_when_no_cell_yields_and_the_last_one_is_judged(done):
    reader, state, seen, kept = done
    last = state.records[-1]
    assert state.done and kept[-1] is state and last["judged"] and last["new_plastic_strain"] == 0.0
    assert state.passages <= 3 and np.array_equal(seen[-1][0].sinking, state.bodies["a"].start.sinking)
    found = run_in_numbers.numbers(STEEL, state)
    assert found["shaken_down"] and found["passages"] == state.passages and found["contained"]
    assert found["height_before_m"] == pytest.approx(1.5e-6, rel=0.02)
    assert found["height_before_m"] - found["height_after_m"] == pytest.approx(found["surface_change_max_m"], rel=0.3)
    assert found["residual_min_Pa"] < 0 < found["residual_max_Pa"] < -found["residual_min_Pa"]
    assert [one["passage"] for one in found["history"]] == list(range(1, state.passages + 2))


def test_a_dent_has_a_depth(done):
    found = run_in_numbers.numbers(STEEL.replace(height=-1e-6), done[1])
    assert found["height_before_m"] == pytest.approx(-1e-6, rel=0.02) and found["height_after_m"] < found["height_before_m"]


def test_where_nothing_yields_it_is_one_look():
    reader, state, seen, kept = repeated(STEEL.replace(**{"bodies.a.yield_stress": 2.6e9}))
    assert len(seen) == 1 and kept == [state] and state.passages == 0 and not state.changes and not state.residual_fields
    assert run_in_numbers.numbers(STEEL, state)["shaken_down"]


def test_a_look_takes_some_layers_alone_where_nothing_comes_near(monkeypatch):
    scene, depths = STEEL.replace(**{"bodies.a.yield_stress": 2.9e9}), []
    stresses = StressHistories.stresses
    monkeypatch.setattr(StressHistories, "stresses", lambda self, depth: depths.append(depth) or stresses(self, depth))
    run_in.state_after_passage(scene, Flattened(scene), run_in.RunInState())
    assert len(depths) == -(-6 // elastic_loads.EVERY)


def test_a_look_misses_no_cell_that_yields(monkeypatch):
    """The first one takes some layers and moments; what flows is what flows with all of them."""
    reader = Flattened(STEEL)
    passage = elastic_loads.histories(STEEL, reader, STEEL.surfaces[0])
    cells = run_in._cells(passage)[1]
    start, states = steel_body.SteelState.virgin(cells), []
    for every, some in ((elastic_loads.EVERY, elastic_loads.SOME), (1, 1)):
        monkeypatch.setattr(elastic_loads, "EVERY", every)
        monkeypatch.setattr(elastic_loads, "SOME", some)
        states.append(steel_body.state_after(cells, start, elastic_loads.find(passage, cells, start).moments))
    assert states[0].hardened.any() and np.array_equal(states[0].hardened, states[1].hardened)


@pytest.mark.slow
def test_one_passage_does_not_take_over_what_the_judged_one_adds(both):
    assert both.passages == 1 and [one["judged"] for one in both.records] == [False, True]
    assert run_in_numbers.numbers(STEEL, both)["new_plastic_strain"] == both.records[1]["new_plastic_strain"]
    assert both.records[0]["plastic_strain"] == max(one.start.hardened.max() for one in both.bodies.values())


@pytest.mark.slow
def test_both_bodies_flow_where_both_have_a_yield_stress(both):
    assert set(both.bodies) == {"a", "b"} and all(one.start.hardened.any() for one in both.bodies.values())
    assert {change.surface for change in both.changes} == {"a", "b"} and set(both.residual_fields) == {"a", "b"}


def test_a_surface_change_is_exact_at_its_nodes_and_cubic_along_x():
    x, y = np.arange(12) * 2e-6, np.arange(5) * 3e-6
    heights = 1e-9 * (x[:, None] / 1e-6) ** 3 * (1 + y / 3e-6)
    change = SurfaceChange("a", x, y, heights, True)
    assert_allclose(change.at(x, -y), heights.T, rtol=1e-12)
    middle = x[2:-3] + 0.7e-6
    assert_allclose(change.at(middle, y[:2]), 1e-9 * (middle / 1e-6) ** 3 * np.array([[1], [2]]), rtol=1e-9)
    assert not change.at(np.array([-9e-6, 40e-6]), y).any() and not change.at(x, np.array([20e-6])).any()
    line = SurfaceChange("a", x, np.zeros(1), heights[:, :1], False)
    assert_allclose(line.at(x, np.linspace(-1, 1, 3)), np.tile(heights[:, 0], (3, 1)))


def test_half_of_a_mirrored_surface_is_the_whole():
    """Between its rows, too, on both sides of the axis."""
    x, y = np.arange(8) * 2e-6, np.arange(-5, 6) * 3e-6
    heights = 1e-9 * np.exp(-((x[:, None] - 6e-6) / 5e-6) ** 2 - (y / 6e-6) ** 2)
    whole, half = SurfaceChange("a", x, y, heights, False), SurfaceChange("a", x, y[5:], heights[:, 5:], True)
    places = np.linspace(-11.9e-6, 11.9e-6, 83)
    assert_allclose(half.at(x + 0.3e-6, places), whole.at(x + 0.3e-6, places), rtol=1e-9, atol=1e-16)
    assert_allclose(whole.at(x, places), np.interp(places, y, heights[3])[:, None] * heights[:, 5] / heights[3, 5], atol=4e-11)


def test_a_change_off_the_axis_is_on_its_side_alone():
    """Cubic along y between its rows; where y = 0 mirrors, it has an image."""
    x, y = np.arange(6) * 2e-6, np.arange(-5, 6) * 3e-6
    heights = np.ones((6, 1)) * np.where(y > 0, 1e-9 * (y / 3e-6) ** 3, 0.0)
    change, half = SurfaceChange("a", x, y, heights, False), SurfaceChange("a", x, y[5:], heights[:, 5:], True)
    assert_allclose(change.at(x, y), heights.T, rtol=1e-12)
    assert_allclose(half.at(x, y), change.at(x, np.abs(y)), rtol=1e-12)
    between = np.array([2.2, 3.6]) * 3e-6
    assert_allclose(change.at(x[:1], between)[:, 0], 1e-9 * (between / 3e-6) ** 3, rtol=1e-9)
    assert not change.at(x, -between).any() and not change.at(x, np.array([-25e-6, 25e-6])).any()


def field(x, y):
    """A field whose components are linear in x, y and depth."""
    depths = np.array([2e-6, 6e-6, 12e-6])
    part = np.arange(1, 7)[:, None, None]
    stress = np.stack([1e12 * part * (z + 0.1 * x[:, None] + 0.2 * y) for z in depths])
    return ResidualField(x, y, depths, stress)


def test_residual_fields_are_linear_between_points_and_free_at_the_surface():
    x, y = np.linspace(-1e-4, 1e-4, 9), np.linspace(0, 1e-4, 5)
    at_x, at_y, deep = np.array([1.1e-5, -7e-5]), np.array([3e-5]), np.array([0.0, 1e-6, 4e-6, 12e-6, 30e-6])
    found = field(x, y).at(at_x, at_y, deep)
    wanted = 1e12 * (deep + 0.1 * at_x[:, None, None] + 0.2 * at_y[:, None])[..., None] * np.arange(1, 7)
    wanted[..., [2, 4, 5]] *= np.minimum(deep / 2e-6, 1)[:, None]
    assert_allclose(found[:, :, :4], wanted[:, :, :4], rtol=1e-9, atol=1.0)
    assert not found[:, :, 4].any() and not field(x, y).at(np.array([2e-4]), at_y, deep).any()


@pytest.mark.parametrize("first", [0, 1])
def test_histories_hold_the_residual_field_of_their_reader(first):
    """Of all rows, or of those from the second one on."""
    reader = Rolling(GEAR)
    positions = np.array([reader.feature_x(n) for n in range(len(reader))])
    box = Box((-np.inf, np.inf), (reader.y[first], np.inf))
    plain = StressHistories(GEAR, reader, positions, box=box)
    reader.residual_fields = {"a": field(plain.x, plain.y), "b": field(plain.x, 2 * plain.y)}
    left = StressHistories(GEAR, reader, positions, box=box)
    assert left.rows.start == first
    depths, rows = [5e-6, 9e-6], slice(1 - first, 3 - first)
    wanted = reader.residual_fields["a"].at(plain.x, plain.y, np.array([0.0, *depths]))
    kinds = [(row, False) for row in range(plain.rows.start, plain.rows.stop)]
    more = [(one, two - one) for one, two in zip(*(np.stack(histories_of(one, depths, kinds)) for one in (plain, left)))]
    for row, (_, added) in enumerate(more):
        assert_allclose(added, np.broadcast_to(wanted[:, row, 1:].transpose(1, 0, 2)[:, :, None], added.shape), atol=1e3)
    for depth, one in ((0.0, 0), (5e-6, 1)):
        found = [p.history(rows, p.stresses(depth), depth=depth) if depth else at_the_surface(p)(rows) for p in (plain, left)]
        added = (found[1] - found[0]).reshape(plain.x.size, 2, -1, 6)
        assert_allclose(added, np.broadcast_to(wanted[:, rows, one, None], added.shape), atol=1e3)


@pytest.mark.parametrize("table", ["", "case-hardened"])
def test_the_critical_point_below_says_the_residual_stress_that_it_has(table):
    """The constant one and that of run-in."""
    scene = GEAR.replace(**{"fatigue.residual_xx": -1e8, "fatigue.table": table})
    left = field(np.linspace(-1e-4, 1e-4, 9), np.linspace(0, 1e-4, 5))
    strength, point = Strength(scene.fatigue, scene.surfaces[0]), SimpleNamespace(x=1e-5, y=3e-5, depth=4e-6, local=None)
    point.local = strength.at(point.depth)
    bare, found = (local_strength.of_point(SimpleNamespace(strength=strength, left=one), point) for one in (None, left))
    before = bare.get("residual_xx_Pa", -1e8)
    assert found["residual_xx_Pa"] - before == pytest.approx(1e12 * (4e-6 + 1e-6 + 6e-6))
    assert found["residual_yy_Pa"] == pytest.approx(2e12 * (4e-6 + 1e-6 + 6e-6))
    assert bool(bare) == bool(table) == ("sigma_eF_Pa" in found)
    rows = dict(row.text_pair for row in search_rows._local_rows(found))
    assert rows["residual stress along x / y"].startswith(f"{found['residual_xx_Pa'] / 1e6:.4g} / 22")


def test_a_crack_has_the_residual_field_too():
    """Also where the residual stress of the scene is replaced by another one."""
    reader = Rolling(GEAR)
    plain = symmetry_plane.plane_of(GEAR, reader)
    reader.residual_fields = {"a": field(plain.x, np.linspace(0, 1e-4, 5))}
    depths, xx = plain.skin * (symmetry_plane.GROWTH ** np.arange(plain.stress.shape[1]) - 1), plain.stress[..., 0]
    wanted = reader.residual_fields["a"].at(plain.x, np.zeros(1), depths)[:, 0, :, None, 0]
    for residual in (None, -1e8):
        added = symmetry_plane.plane_of(GEAR, reader, residual).stress[..., 0] - xx
        assert_allclose(added, np.broadcast_to(wanted, added.shape), atol=1e4)


@pytest.mark.parametrize("changes, words", [
    ({"time.run_in": 2}, "of a body that moves: set bodies.a.yield_stress or bodies.b.yield_stress, in Pa"),
    ({"time.run_in": 2, "bodies.b.yield_stress": 2e9, "operation.srr": 2.0}, "that moves: set bodies.a.yield_stress, in"),
    ({"time.run_in": 2, "bodies.a.yield_stress": 2e9, "time.steps": 9}, "needs whole passages"),
    ({"time.run_in": 2, "bodies.a.yield_stress": 2e9, "time.x_end": 0.0}, "needs whole passages"),
    ({"time.run_in": 2, "bodies.a.yield_stress": 1e9}, "whole track would flow"),
    ({"time.run_in": 2, "bodies.b.yield_stress": 1.8e9, "bodies.b.hardening": "swift-52100"}, "first flows at 1.03 GPa")])
def test_scenes_without_an_answer_are_refused(changes, words):
    with pytest.raises(SceneError, match=words):
        GEAR.replace(**changes)


def test_a_body_without_yield_stress_stays_elastic():
    assert [one.name for one in run_in.yielding_surfaces(STEEL)] == ["a"]
    assert "bodies.b.hardening" in tehl.scene("gear").replace(**{"bodies.b.hardening": "swift-52100"}).warnings()[0]
    assert not replace(STEEL, time=replace(STEEL.time, steady_only=True)).runs_in


def test_what_it_left_is_read_as_it_was_written_and_never_taken_for_nothing(done, tmp_path):
    (tmp_path / CHECKPOINTS).mkdir()
    for state in done[3]:
        run_in_file.write(tmp_path, state)
        again = run_in_file.read(tmp_path)
        for name in ("passages", "rounds", "part", "records", "done", "contained", "unsettled"):
            assert getattr(again, name) == getattr(state, name)
        assert (again.rest is None) == (state.rest is None) and np.all(again.rest == state.rest)
        one, two = again.bodies["a"], state.bodies["a"]
        assert one.mirrored == two.mirrored and np.array_equal(one.surface, two.surface)
        assert all(np.array_equal(getattr(one.start, part), value) for part, value in vars(two.start).items())
    file = tmp_path / CHECKPOINTS / "run_in.npz"
    file.write_bytes(file.read_bytes()[:-200])
    with pytest.raises(StoreError, match="damaged or missing"):
        run_in_file.read(tmp_path)
    file.unlink()
    assert run_in_file.read(tmp_path) == run_in.RunInState()
    with pytest.raises(StoreError, match="damaged or missing"):
        run_in_file.read(tmp_path, needed=True)


def test_the_start_of_all_passages_is_kept_once(tmp_path):
    """Later states of a passage do not take its place."""
    (tmp_path / CHECKPOINTS).mkdir()
    store = SimpleNamespace(path=tmp_path)
    run_in_file.start_of(store, {"step": np.array(0), "P": np.zeros(3)})
    found = run_in_file.start_of(store, {"step": np.array(7), "P": np.ones(3)})
    assert int(found["step"]) == 0 and not found["P"].any()
