"""Stresses of a run with a window, against those of the same loads and temperatures on the fine grid of the whole contact."""

import dataclasses
import itertools
from types import SimpleNamespace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.engine.fftw import SINGLE
from tehl_taichi.fatigue import depth_profile, depth_search, every_moment, findley
from tehl_taichi.fatigue.averaged_surface import AveragedSurface
from tehl_taichi.fatigue.layer import layer
from tehl_taichi.fatigue.sought import Box
from tehl_taichi.fatigue.stress import held_heat, windowed
from tehl_taichi.fatigue.stress.averaging import AveragedReader, averaged_reader
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.stress.row_histories import at_the_surface, histories_of
from tehl_taichi.march.zoom.window import windows_of
from tehl_taichi.march.zoom.zoomed_passage import ZoomedPassage
from tehl_taichi.march.zoom.zoomed_reader import ZoomedReader
from tehl_taichi.scene.scales import Scales

GEAR = tehl.scene("gear").replace(srr=-0.2, **{"grid.nx": 64, "grid.ny": 16, "time.x_end": 0.0})
LINE = GEAR.replace(**{"feature.length": float("inf")})
OFF_AXIS = GEAR.replace(**{"feature.y": 1e-4, "grid.nx": 64, "grid.ny": 24})
# with a second feature on body b, near the first or beside it: their windows overlap
NEAR, BESIDE = (dataclasses.replace(GEAR, features=(*GEAR.features, dataclasses.replace(GEAR.features[0], surface="b", x=x)))
                for x in (5e-5, 2.5e-4))
FACTOR, MOST = 2, 1.9e9  # Pa
NAMES = ("pressure", "traction_x_a", "traction_x_b", "traction_y_a", "traction_y_b", "temperature_a", "temperature_b")


class Loads:
    """Loads and temperatures of a passage at the nodes x, y (m), as a reader; sharp: what a grid of the run does not see."""

    def __init__(self, scene, x, y, sharp):
        self.scene, self.x, self.y, self.sharp = scene, x, y, sharp
        s = Scales.of(scene)
        way = (scene.path[1] - scene.path[0]) * s.a
        self.count = round(way / (scene.grid.x_max - scene.grid.x_min) * scene.grid.nx / s.a)
        self.time = np.arange(self.count + 1) * way / self.count / scene.reference.speed

    def __len__(self):
        return self.count + 1

    def feature_x(self, n):
        a = Scales.of(self.scene).a
        return (self.scene.path[0] + (self.scene.path[1] - self.scene.path[0]) * n / self.count) * a

    def scalar(self, name):
        return np.ones(len(self))

    def _of(self, n):
        a, feature = Scales.of(self.scene).a, self.scene.features[0]
        x, y = self.x[:, None], self.y[None, :] - (0.0 if feature.transverse else feature.y)
        ends = np.exp(-((self.y[None, :] / (0.9 * a)) ** 8)) if self.scene.symmetric else 1 + 0 * y  # off the axis: endless
        smooth = np.maximum(1 - (x / a) ** 2, 0.0) ** 2 * ends
        bumps = (self._bump(x - surface.pace * self.feature_x(n) - one.x, 0.0 if one.transverse else self.y - one.y)
                 for surface in self.scene.surfaces for one in surface.features)
        return smooth, sum(bumps), np.sign(y) * np.abs(y) / a if self.y.size > 1 else 0.0

    def _bump(self, x, y):
        """At places (m) from the middle of a feature."""
        a = Scales.of(self.scene).a
        across = np.exp(-((y / (0.15 * a)) ** 2))
        narrow = np.exp(-(((x - 0.02 * a) / (0.08 * a)) ** 2)) * across if self.sharp else 0.0
        return np.exp(-((x / (0.15 * a)) ** 2)) * across + narrow

    def fields(self, n, names):
        smooth, bump, side = self._of(n)
        found = {"pressure": MOST * (smooth + 0.7 * bump), "film": 1e-7 + 0 * bump,
                 "traction_x_a": 1e8 * (smooth - 0.5 * bump), "traction_x_b": -1e8 * (smooth - 0.5 * bump),
                 "traction_y_a": 3e8 * bump * side, "traction_y_b": -3e8 * bump * side,
                 "temperature_a": 90 + 50 * smooth + 40 * bump, "temperature_b": 90 + 70 * smooth + 30 * bump}
        return {name: found[name] + 0 * smooth for name in names}


class Whole:
    """A reader without what it knows of its window."""

    def __init__(self, reader):
        self.reader, self.x, self.y, self.time, self.feature_x = reader, reader.x, reader.y, reader.time, reader.feature_x

    def __len__(self):
        return len(self.reader)

    def fields(self, n, names):
        return self.reader.fields(n, names)


def zoomed(scene, factor=FACTOR, since=1, between=False):
    """The ZoomedReader of these loads with a window from entry `since` on; between: also at moments between the entries."""
    s, grid = Scales.of(scene), scene.grid
    x = np.linspace(grid.x_min, grid.x_max, grid.nx + 1) * s.a
    half = np.linspace(0, grid.y_max, grid.ny + 1) * s.b
    y = np.zeros(1) if not scene.rows else half if scene.symmetric else np.concatenate([-half[:0:-1], half])
    run = Loads(scene, x, y, False)
    fine = Loads(scene, *(np.interp(np.arange((p.size - 1) * factor + 1) / factor, np.arange(p.size), p) for p in (x, y)), True)

    def inside(w, n):
        origin = w.origin(run.feature_x(n) / s.a)
        part = np.ix_(np.arange(origin, origin + w.nx + 1), np.arange(w.row, w.row + w.ny + 1))
        return origin, {name: field[part] for name, field in fine.fields(n, (*NAMES, "film")).items()}

    passages = [ZoomedPassage(w) for w in windows_of(scene, factor)]
    for found, n in itertools.product(passages, range(since, len(run))):
        if between and n > since:
            found.between += [(at, *inside(found.window, at)) for at in n - 1 + np.arange(1, factor) / factor]
        origin, values = inside(found.window, n)
        found.add(n, origin, values, {"p_max_Pa": values["pressure"].max(), "h_min_m": values["film"].min()})
    return ZoomedReader(run, passages, scene.symmetric)


def histories(scene, reader, surface, box=None):
    """(passage, stress at all points of the surface, (depths, x', moments, 6) under the row of the feature)."""
    centres = np.array([reader.feature_x(n) for n in range(len(reader))])
    passage = StressHistories(scene, reader, centres, surface=scene.surfaces["ab".index(surface)], box=box)
    y = 0.0 if not scene.rows else scene.features[0].y
    row = int(np.argmin(np.abs(passage.reader.y - y)))
    top = at_the_surface(passage)(slice(0, passage.y.size))
    return passage, top, histories_of(passage, [4e-6, 2e-5, 1e-4], [(row, False)])[0]


def pairs(scene, reader, whole, surface):
    """The histories of `reader` and those of `whole` (which has no window) at their common moments: [(surface), (depths)]; all
    moments but the first and the last, where the points are unloaded."""
    (passage, *found), (wider, *there) = (histories(scene, one, surface) for one in (reader, whole))
    away = np.abs(wider.centres - passage.centres[:, None])
    own = np.flatnonzero(away.min(axis=1) < 1e-6 * passage.dx)
    assert own.size >= passage.centres.size - 2
    same = away.argmin(axis=1)[own]
    return [(one[..., own, :], whole_one[..., same, :]) for one, whole_one in zip(found, there)]


@pytest.mark.parametrize("scene", [GEAR, LINE, OFF_AXIS, NEAR, BESIDE],
                         ids=["half domain", "line", "off the axis", "near", "beside"])
@pytest.mark.parametrize("surface", ["a", "b"])
def test_stresses_are_those_of_the_fine_grid_everywhere(scene, surface):
    reader = zoomed(scene)
    (top, whole_top), (deep, whole_deep) = pairs(scene, reader, Whole(reader), surface)
    assert np.abs(top - whole_top).max() < 0.012 * np.abs(whole_top).max()
    assert np.abs(deep - whole_deep).max() < 0.012 * np.abs(whole_deep).max()
    run = histories(scene, reader.base, surface)[2]  # without its window, at the same depths
    assert abs(run.min() - whole_deep.min()) > 10 * np.abs(deep - whole_deep).max()


def test_stresses_of_averaged_loads_are_those_of_the_fine_grid():
    scene, length = GEAR.replace(**{"grid.nx": 128, "fatigue.thermal_stress": False}), 4e-5
    reader = zoomed(scene, 2)
    whole = AveragedReader(Whole(reader), length)
    (top, whole_top), (deep, whole_deep) = pairs(scene, averaged_reader(reader, length), whole, "a")
    assert np.abs(top - whole_top).max() < 0.012 * np.abs(whole_top).max()
    assert np.abs(deep - whole_deep).max() < 0.012 * np.abs(whole_deep).max()


@pytest.mark.parametrize("scene", [GEAR, BESIDE], ids=["of one body", "of both"])
def test_the_heat_of_a_window_is_that_of_the_fine_grid(scene):
    """Temperatures alone: with the slip of two surfaces, late windows and steps that are no whole number of cells."""
    scene = scene.replace(**{"fatigue.shear": False, "time.x_end": 0.01, "grid.nx": 128})
    reader = zoomed(scene, 2, since=8)
    for field, one in itertools.product(("pressure", "traction_x_a"), reader.zoomed):
        for values in one.fields[field]:
            values *= 0
    for surface in "ab":
        without = scene.replace(**{"fatigue.thermal_stress": False})
        warm, cold = (pairs(one, reader, Whole(reader), surface) for one in (scene, without))
        for n in (0, 1):
            heat, whole = (one - other for one, other in zip(warm[n], cold[n]))
            assert np.abs(heat - whole).max() < 0.015 * np.abs(whole).max(), (surface, n)


def test_moments_before_and_after_the_steps_are_those_of_the_run():
    reader = zoomed(GEAR, 4)
    passage, run = (histories(GEAR, one, "b")[0] for one in (reader, reader.base))
    steps = len(reader)
    for side in (slice(None, passage.centres.size - steps), slice(passage.centres.size, None)):
        assert np.allclose(np.diff(passage.centres[side]), passage.run_dx)
    assert abs(passage.centres.size - run.centres.size) <= 2


@pytest.mark.parametrize("factor", [2, 4, 8])
def test_depths_are_those_of_the_run_and_down_to_half_a_cell_of_the_window(factor):
    reader = zoomed(GEAR, factor)
    centres = np.array([reader.feature_x(n) for n in range(len(reader))])
    own, run = (depth_profile.ladder(StressHistories(GEAR, one, centres)) for one in (reader, reader.base))
    half = run[0] / factor
    assert np.allclose(own[-run.size :], run) and half * (1 - 1e-9) <= own[0] < half * depth_profile.RATIO


def test_only_the_points_that_are_wanted_are_searched():
    passage, top, deep = histories(GEAR, zoomed(GEAR), "a", Box((-2e-5, 6e-5), (0.0, 3e-5), (0.0, 2e-5)))
    assert -2e-5 <= passage.x.min() and passage.x.max() <= 6e-5 and passage.y.max() <= 3e-5
    assert depth_profile.ladder(passage)[-1] <= 2e-5 < depth_profile.RATIO * depth_profile.ladder(passage)[-1] * 1.01
    whole, all_top, _ = histories(GEAR, zoomed(GEAR), "a")
    x, y = (np.flatnonzero(np.isin(*pair)) for pair in ((whole.x, passage.x), (whole.y, passage.y)))
    top, own = top.reshape(x.size, y.size, -1, 6), all_top.reshape(whole.x.size, whole.y.size, -1, 6)[np.ix_(x, y)]
    assert top.shape == own.shape and np.abs(top - own).max() < 1e-6 * MOST  # followed as far as where all are searched


@pytest.mark.parametrize("surface, share", [("a", 0.8), ("b", 0.3)])  # points of a move with the feature, so they feel little
def test_critical_points_are_followed_between_the_steps_of_the_run(surface, share):
    scene = GEAR.replace(srr=-1.2)
    reader = zoomed(scene, 4, since=3, between=True)
    whole = Whole(reader.every)
    centres = np.array([reader.feature_x(n) for n in range(len(reader))])
    body = scene.surfaces["ab".index(surface)]
    passage = StressHistories(scene, reader, centres, surface=body)
    layers = [layer(scene, passage, 0.0, lambda done, total: None, None)]
    deep = depth_search.DepthResult(depth_profile.profiles(passage, [0]))
    (top,), below = every_moment.followed(scene, passage, layers, deep)
    for old, new in ((layers[0].worst, top.worst), (deep.profiles[0].worst, below.profiles[0].worst)):
        fine = np.array([whole.feature_x(n) for n in range(len(whole))])
        there = StressHistories(scene, whole, fine, surface=body, box=every_moment._box(passage, [new]))
        row = int(np.argmin(np.abs(there.reader.y - new.y)))
        stress = histories_of(there, [new.depth], [(row, False)])[0][0, 0]
        same = np.abs(there.positions[:, None] - new.positions).argmin(axis=0)
        steps = slice(1, None)  # the first moment, of an unloaded point, lies a little further out
        assert np.abs(there.positions[same] - new.positions)[steps].max() < 1e-9
        error = np.abs(stress[same] - new.stress[:-1])[steps].max()
        between = every_moment.between(passage.positions, old.stress[:-1], new.positions)  # as if nothing were computed there
        assert error < 0.02 * np.abs(stress).max() and error < share * np.abs(stress[same] - between)[steps].max()
        f = float(findley.search(stress[None], new.local.kappa)[0][0])
        assert new.f >= old.f and abs(new.f - f) < 0.01 * f
    assert top.f.max() == top.worst.f > layers[0].worst.f


@pytest.mark.parametrize("length", [0.0, 6e-5])
def test_loads_between_steps_are_those_of_the_steps_around(length):
    """So their stresses follow from those of the steps."""
    reader = zoomed(GEAR, 2, since=3, between=True).every
    reader = averaged_reader(reader, length) if length else reader
    passage = StressHistories(GEAR, reader, np.array([reader.feature_x(n) for n in range(len(reader))]))
    base, block = windowed.BasePart(passage, [0.0, 2e-5], [0, 3], SINGLE), passage.blocks[1]
    found, own = base._stresses(block), base._of_loads(block, np.arange(len(block)))
    assert len(base.known) < 0.7 * len(reader) and np.abs(found - own).max() < 1e-5 * np.abs(own).max()


@pytest.mark.parametrize("scene", [GEAR, OFF_AXIS], ids=["half domain", "off the axis"])
def test_averages_of_histories_are_those_of_averaged_loads(scene):
    """Beside the window the run's cells are longer than those of the average, so its averaged loads are not as exact."""
    length, reader = 6e-5, zoomed(scene)
    centres = np.array([reader.feature_x(n) for n in range(len(reader))])
    for body in scene.surfaces:
        passage = StressHistories(scene, reader, centres, surface=body)
        found = AveragedSurface(passage, length)
        layer(scene, passage, 0.0, lambda done, total: None, None, found)
        loads = StressHistories(scene, averaged_reader(reader, length), centres, surface=body)
        whole = layer(scene, loads, 0.0, lambda done, total: None, None)
        assert found.worst.f == pytest.approx(whole.worst.f, rel=0.01)
        searched = np.isfinite(found.f)
        assert searched.sum() < 0.5 * searched.size
        assert np.abs(found.f - whole.f)[searched].max() < 0.03 * whole.worst.f


@pytest.mark.parametrize("srr, x_end", [(-0.6, 0.2), (0.4, 0.0), (1.0, 0.2)])
def test_neighbours_of_the_worst_point_are_followed(srr, x_end):
    """By all moments another point is the worst than by those of the run."""
    scene = GEAR.replace(srr=srr, **{"time.x_end": x_end, "fatigue.thermal_stress": False})
    reader = zoomed(scene, 4, since=3, between=True)

    def searched(one):
        centres = np.array([one.feature_x(n) for n in range(len(one))])
        passage = StressHistories(scene, one, centres, surface=scene.surfaces[1])
        return passage, layer(scene, passage, 0.0, lambda done, total: None, None)

    (passage, steps), (_, whole) = searched(reader), searched(Whole(reader.every))
    (found,), _ = every_moment.followed(scene, passage, [steps], depth_search.DepthResult())
    assert abs(steps.worst.x - whole.worst.x) > passage.dx
    assert abs(found.worst.x - whole.worst.x) < 0.1 * passage.dx and found.worst.y == whole.worst.y
    assert abs(found.worst.f - whole.worst.f) < 0.006 * whole.worst.f
    at = np.unravel_index(np.argmax(found.f), found.f.shape)
    assert found.f[at] == found.worst.f and passage.x[at[0]] == found.worst.x and passage.y[at[1]] == found.worst.y


@pytest.mark.parametrize("surface", ["a", "b"])
@pytest.mark.parametrize("scene", [GEAR, LINE, OFF_AXIS], ids=["half domain", "line", "off the axis"])
def test_the_stress_of_a_hot_layer_follows_its_temperature(scene, surface):
    """At points in the window; its temperatures are those of Loads."""
    reader = zoomed(scene, 4, since=3, between=True).every
    centres = np.array([reader.feature_x(n) for n in range(len(reader))])
    passage = StressHistories(scene, reader, centres, surface=scene.surfaces["ab".index(surface)])
    sides = (-2e-5, 3e-5) if reader.y[0] < 0 else (0.0, 3e-5) if scene.rows else (0.0,)
    rows = sorted({int(np.argmin(np.abs(reader.y - scene.features[0].y - side))) for side in sides})
    found, body, counted = held_heat.histories(passage, rows), passage.surface.body, 0
    for row in rows:
        assert found[row].shape == (passage.x.size, passage.centres.size + 1, 6)
        assert not found[row][..., 2:].any() and not found[row][:, -1].any()
        for moment in np.flatnonzero(passage.entries > 12):
            at, entry = passage.centres[moment] + passage.x, int(passage.entries[moment])
            inside = np.abs(at - reader.feature_x(entry)) < 0.12 * passage.a
            there = Loads(scene, at[inside], np.array([reader.y[row]]), True)
            there.feature_x = lambda n, at=reader.feature_x(entry): at
            name = f"temperature_{surface}"
            rise = there.fields(entry, (name,))[name][:, 0] - scene.operation.temperature
            counted += rise.size
            for component in (0, 1):
                stress = found[row][inside, moment, component]
                assert np.allclose(stress, -body.E * body.alpha / (1 - body.nu) * rise, rtol=0.002)
    assert counted > 1000


def test_heat_is_followed_between_the_steps_of_the_run(monkeypatch):
    """A hot spot passes a point of a body that conducts no heat: only its surface layer is hot. Stress history of the point
    against that of a search of all moments, also if all heat were interpolated."""
    scene = LINE.replace(srr=-1.0, **{"bodies.b.k": 0.01, "bodies.b.rho": 1e5})
    reader = zoomed(scene, 4, since=3, between=True)
    whole, body = Whole(reader.every), scene.surfaces[1]

    def passage_of(one):
        return StressHistories(scene, one, np.array([one.feature_x(n) for n in range(len(one))]), surface=body)

    def error():
        steps = passage_of(reader)
        (found,), _ = every_moment.followed(scene, steps, [layer(scene, steps, 0.0, lambda done, total: None, None)],
                                            depth_search.DepthResult())
        point, there = found.worst, passage_of(whole)
        stress = histories_of(there, [0.0], [(0, False)])[0][0, int(np.argmin(np.abs(there.x - point.x)))]
        same = np.abs(there.positions[:, None] - point.positions).argmin(axis=0)
        new = np.abs(point.positions[:, None] - steps.positions).min(axis=1) > 1e-9
        return np.abs(stress[same] - point.stress[:-1])[new].max()

    followed = error()
    monkeypatch.setattr(held_heat, "histories", lambda passage, rows: dict.fromkeys(rows, 0.0))
    assert followed < 0.3 * error()


def test_moments_that_do_not_count_are_not_followed():
    """The search ends before the window begins, or in it."""
    reader = zoomed(GEAR, 2, since=20, between=True)
    centres = np.array([reader.feature_x(n) for n in range(len(reader))])
    for last, more in ((15, 0), (25, 5)):
        scene = GEAR.replace(**{"fatigue.to_x": float(centres[last] / Scales.of(GEAR).a) + 1e-6})
        passage = StressHistories(scene, reader, centres, surface=scene.surfaces[0])
        layers = [layer(scene, passage, 0.0, lambda done, total: None, None)]
        worst = every_moment.followed(scene, passage, layers, depth_search.DepthResult())[0][0].worst
        assert len(worst.stress) == len(layers[0].worst.stress) + more


def test_without_moments_between_the_steps_a_search_stays_as_it_is():
    reader = zoomed(GEAR)
    assert reader.every is None
    passage = SimpleNamespace(reader=reader)
    assert every_moment.followed(GEAR, passage, [1], 2) == ([1], 2)


def test_values_between_known_ones_are_those_of_a_cubic():
    known, at = np.array([0.0, 1.0, 3.0, 4.0, 6.0, 6.5]), np.linspace(-0.5, 7.0, 40)

    def cubic(x):
        return np.stack([x**3 - 2 * x, 1 + 0.5 * x**2], axis=-1)

    assert np.allclose(every_moment.between(known, cubic(known), at), cubic(at), rtol=1e-12, atol=1e-11)
    assert np.allclose(every_moment.between(known[:2], known[:2, None], at)[:, 0], at)


def test_heat_of_a_window_and_of_the_fine_grid_are_kept_apart(taichi_cpu):
    """A whole domain is searched below rows first, then at all points of a depth; each has a heat of its own."""
    def heats(*order):
        reader = zoomed(OFF_AXIS)
        passage = StressHistories(OFF_AXIS, reader, np.array([reader.feature_x(n) for n in range(len(reader))]))
        row = [(reader.y.size // 2, False)]
        ways = {"rows": lambda: histories_of(passage, [4e-6], row)[0], "points": lambda: passage.stresses(4e-6)[1](3)}
        return {name: np.asarray(ways[name]()) for name in order}

    first, last = heats("rows", "points"), heats("points", "rows")
    for name, values in first.items():
        assert values == pytest.approx(last[name], rel=1e-6, abs=1e-6 * float(np.abs(values).max()))
