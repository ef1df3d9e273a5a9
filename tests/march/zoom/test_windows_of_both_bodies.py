"""Windows around the features of both bodies."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.fatigue.assessment import Snapshots
from tehl_taichi.march.zoom import zoomed_passage
from tehl_taichi.march.zoom.window import Window, windows_of
from tehl_taichi.march.zoom.zoomed_passage import ZoomedPassage, passages
from tehl_taichi.march.zoom.zoomed_reader import ZoomedReader
from tehl_taichi.scene.scales import Scales

GEAR = tehl.scene("gear").replace(**{"thermal.on": False, "grid.nx": 128, "grid.ny": 32})
LINE = GEAR.replace(**{"feature.length": float("inf"), "fatigue.on": False, "time.x_end": -0.2})


def of_both(scene, x=0.0, surfaces="ab", **changes):
    """The scene with an asperity on one body and a dent on the other, x (m) ahead of it."""
    first = dataclasses.replace(scene.features[0], surface=surfaces[0])
    other = dataclasses.replace(first, surface=surfaces[1], height=-1e-6, x=x, **changes)
    return dataclasses.replace(scene, features=(first, other))


@pytest.mark.parametrize("scene, names", [
    (GEAR, "a"), (of_both(GEAR), "ab"), (of_both(GEAR, surfaces="ba"), "ba"), (of_both(GEAR, surfaces="aa"), "a"),
    (of_both(GEAR.replace(srr=0.0)), "a"), (of_both(GEAR.replace(srr=0.0), width=100e-6), "a"),
    (of_both(GEAR.replace(srr=0.0), x=1e-4), "ab"), (of_both(GEAR.replace(srr=0.0), width=300e-6), "ab"),
    (of_both(GEAR, width=2000e-6), "a"), (of_both(GEAR, length=float("inf")), "a"), (of_both(GEAR.replace(srr=2.0)), "a")],
    ids=["a", "both", "b first", "two on a", "rolling", "smaller", "beside", "larger", "too wide", "endless", "at rest"])
def test_which_surfaces_have_a_window(scene, names):
    scene = scene.replace(**{"zoom.factor": 4})
    found = windows_of(scene, 4)
    assert [w.pace for w in found] == [next(s.pace for s in scene.surfaces if s.name == name) for name in names]
    assert found[0] == Window.of(dataclasses.replace(scene, features=scene.reference.features), 4)


def test_the_second_window_moves_with_its_surface():
    scene, a = of_both(GEAR.replace(srr=0.4), x=-2e-4), Scales.of(GEAR).a
    _, w = windows_of(scene, 4)
    pace, other = scene.surfaces[1].pace, scene.features[1]
    for X in (-1.0, 0.0, 0.6):
        x = w.columns(w.origin(X))[[0, -1]]
        low, high = (pace * X + (other.x + side * other.reach) / a for side in (-1, 1))
        assert low - x[0] > 0.2 and x[1] - high > 0.2
        assert abs((x[0] + x[1] - low - high) / 2) < 0.3


def test_a_width_of_the_user_holds_the_features_of_both():
    with pytest.raises(tehl.SceneError, match="zoom.width_x = 0.7 a is less than the features of surface b"):
        of_both(GEAR, width=400e-6).replace(**{"zoom.factor": 4, "zoom.width_x": 0.7})
    with pytest.raises(tehl.SceneError, match="zoom.factor = 4: the features of surface b reach to"):
        of_both(GEAR, surfaces="ba").replace(**{"zoom.factor": 4, "feature.width": 2000e-6})


@pytest.fixture(scope="module")
def run():
    scene = of_both(LINE.replace(srr=0.3), x=-1.5e-4)
    return scene, Snapshots(tehl.march(scene))


def test_windows_as_coarse_as_the_run_give_its_pressures(run):
    scene, reader = run
    (first, second), = passages(scene, reader, [1])
    assert first.entries == second.entries and first.origins != second.origins
    for found in (first, second):
        for entry, origin, p in zip(found.entries, found.origins, found.fields["pressure"]):
            own = reader.items[entry].fields["pressure"][origin : origin + found.window.nx + 1]
            assert np.abs(p - own).max() < 3e-4 * 1.93e9


def test_bodies_that_change_places_have_equal_windows(run):
    scene, reader = run
    turned = of_both(LINE.replace(srr=-0.3, **{"feature.surface": "b"}), x=-1.5e-4, surfaces="ba")
    mirrored = Snapshots(tehl.march(turned))
    ones, others = (passages(of, one, [2])[0] for of, one in ((scene, reader), (turned, mirrored)))
    for one, other in zip(ones, others):
        assert one.origins == other.origins and one.numbers == other.numbers
        assert all(np.array_equal(*pair) for pair in zip(one.fields["pressure"], other.fields["pressure"]))
        assert all(np.array_equal(*pair) for pair in zip(one.fields["traction_x_a"], other.fields["traction_x_b"]))


def test_windows_end_together(run, monkeypatch):
    """At the step before which the first of them fails."""
    scene, reader = run
    advance = zoomed_passage._advance

    def failing(march, found, step):
        if march.window.pace != 1.0 and step == 7:
            found.ended = "it did not converge"
        else:
            advance(march, found, step)

    monkeypatch.setattr(zoomed_passage, "_advance", failing)
    for first, second in passages(scene, reader, [2]):
        assert first.entries == second.entries == list(range(1, 8)) and second.ended
        for found in (first, second):
            assert {len(values) for values in (*found.fields.values(), *found.numbers.values(), found.origins)} == {7}
            assert max(at for at, _, _ in found.between) < 7


class Flat:
    """Reader of a run whose pressure and film are 1 but for a peak at one place (m) with a thin film; two entries."""

    def __init__(self, scene, at):
        a, grid = Scales.of(scene).a, scene.grid
        self.x, self.y, self.time = np.linspace(grid.x_min, grid.x_max, grid.nx + 1) * a, np.zeros(1), np.arange(2.0)
        self.peak = np.abs(self.x - at) < 0.6 * (self.x[1] - self.x[0])

    def __len__(self):
        return 2

    def feature_x(self, n):
        return 0.0

    def scalar(self, name):
        return np.ones(2)

    def fields(self, n, names):
        values = {"pressure": 1.0 + 8.0 * self.peak, "film": 1.0 - 0.9 * self.peak}
        return {name: values[name][:, None] for name in names}


@pytest.mark.parametrize("at, inside", [(0.0, True), (-2.5e-4, True), (3.0e-4, False)])
def test_a_coarse_value_in_a_window_does_not_count(at, inside):
    scene = of_both(LINE.replace(srr=0.3), x=-2.5e-4)
    run = Flat(scene, at)
    found = [ZoomedPassage(w) for w in windows_of(scene, 2)]
    for n, one in enumerate(found):
        values = {"pressure": 2.0 + n, "film": 0.9 - n / 10}
        fields = {name: np.full((one.window.nx + 1, 1), value) for name, value in values.items()}
        one.add(1, one.window.origin(0.0), fields, {"p_max_Pa": 2.0 + n, "h_min_m": 0.9 - n / 10})
    reader = ZoomedReader(run, found, True)
    p, h = reader.scalar("p_max_Pa")[1], reader.scalar("h_min_m")[1]
    assert (p, h) == (pytest.approx(3.0), pytest.approx(0.8)) if inside else (p, h) == (9.0, pytest.approx(0.1))
    top = reader.fields(1, ("pressure",))["pressure"].max()
    assert top == pytest.approx(3.0) if inside else 8.0 < top <= 9.0


def test_no_pressure_is_negative_by_rounding():
    scene = of_both(LINE.replace(srr=0.3), x=-2.5e-4)
    run, found = Flat(scene, 0.0), [ZoomedPassage(w) for w in windows_of(scene, 2)]
    for one in found:
        one.add(1, one.window.origin(0.0), {"pressure": np.zeros((one.window.nx + 1, 1), "f4")}, {})
    p = ZoomedReader(run, found, True).fields(1, ("pressure",))["pressure"]
    assert p.min() == 0.0


def test_moments_that_only_one_window_has_are_left_out():
    scene = of_both(LINE.replace(srr=0.3), x=-1.5e-4)
    run, found = Flat(scene, 9.0), []
    for w, moments in zip(windows_of(scene, 4), ((0.25, 0.5, 0.75), (0.5,))):
        fields = {"pressure": np.ones((w.nx + 1, 1))}
        between = [(at, w.origin(0.0), fields) for at in moments]
        found.append(ZoomedPassage(w, [1], [w.origin(0.0)], {name: [values] for name, values in fields.items()}, {}, between))
    every = ZoomedReader(run, found, True).every
    assert every.base.moments.tolist() == [0.0, 0.5, 1.0]
    assert [sorted(one.place) for one in every.windows] == [[1, 2], [1, 2]]


def test_a_warning_names_the_surface_without_a_window():
    scene = of_both(GEAR, width=2000e-6).replace(**{"zoom.factor": 4})
    assert SimpleNamespace(**{one.code: one for one in scene.warnings()}).window.data == {"surface": "a"}


@pytest.mark.slow  # a passage on 256x64 cells
@pytest.mark.parametrize("y", [0.0, 1.3e-4], ids=["one behind the other", "beside each other"])
def test_an_asperity_on_the_other_body_has_what_a_fine_run_gives(y):
    """A dent on body a has the first window. Largest pressure of the passage: 3.999 GPa with that window alone."""
    places = ("a", -1.5e-6, 0.0, y), ("b", 1.5e-6, 0.0 if y else -2.5e-4, -y)
    dent, asperity = (dataclasses.replace(GEAR.features[0], surface=name, height=height, x=x, y=at)
                      for name, height, x, at in places)
    scene = dataclasses.replace(GEAR, features=(dent, asperity)).replace(srr=0.12, **{
        "grid.nx": 64, "grid.ny": 16, "fatigue.on": False})
    reader = Snapshots(tehl.march(scene))
    found, = passages(scene, reader, [4])
    fine = Snapshots(tehl.march(scene.replace(**{"grid.nx": 256, "grid.ny": 64})))
    p = fine.scalar("p_max_Pa")[1:].max()
    now, first = (ZoomedReader(reader, some, scene.symmetric).scalar("p_max_Pa")[1:].max() for some in (found, found[:1]))
    assert abs(now - p) < 0.001 * p < 0.3 * abs(first - p)
