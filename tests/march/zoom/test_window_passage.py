"""The march of a window through the states of a run."""

import dataclasses
import itertools

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.fatigue.assessment import Snapshots
from tehl_taichi.march.passage import march
from tehl_taichi.march.zoom import window_passage
from tehl_taichi.march.zoom.base_states import BaseStates
from tehl_taichi.march.zoom.window import Window
from tehl_taichi.march.zoom.window_passage import WindowPassage
from tehl_taichi.march.zoom.zoomed_passage import passages
from tehl_taichi.march.zoom.zoomed_reader import ZoomedReader
from tehl_taichi.plastic.surface_change import SurfaceChange
from tehl_taichi.pressure import fields
from tehl_taichi.scene.scales import Scales

LINE = tehl.scene("pitch-line").replace(**{"feature.length": float("inf"), "grid.nx": 128, "fatigue.on": False})
PART = {"time.x_end": 0.2}  # of the path


@pytest.fixture(scope="module")
def runs():
    """{(SRR, surface, columns): run of the line} as they are needed."""
    kept = {}

    def of(srr, surface="a", columns=128):
        if (srr, surface, columns) not in kept:
            scene = LINE.replace(**PART, **{"operation.srr": srr, "feature.surface": surface, "grid.nx": columns,
                                              "thermal.on": False})
            kept[srr, surface, columns] = scene, Snapshots(tehl.march(scene))
        return kept[srr, surface, columns]

    return of


def passage(scene, reader, factor, *notify):
    """Of one window."""
    return passages(scene, reader, [factor], *notify)[0][0]


@pytest.mark.parametrize("factor, within", [(1, 1e-12), (2, 3e-9)])
def test_the_film_under_the_pressure_of_the_run_is_that_of_the_run(runs, factor, within):
    """Twice as fine, the pressure between the nodes bends the bodies by a part of 130 nm more or less."""
    scene, reader = runs(0.0)
    march = WindowPassage(BaseStates(scene, reader), Window.of(scene, factor))
    for entry in (1, 30, 50):
        march.begin(entry)
        origin = march.window.origin(march.base.position(entry))
        film = march.levels.get(fields.H)[0, origin % factor :: factor] * march.base.scales.h
        first = -(-origin // factor)
        assert np.abs(film - reader.items[entry].fields["film"][first : first + film.size, 0]).max() < within


@pytest.mark.parametrize("srr", [0.0, -0.12])
def test_a_window_as_coarse_as_the_run_gives_its_pressures(runs, srr):
    scene, reader = runs(srr)
    found = passage(scene, reader, 1)
    width = found.window.nx + 1
    for entry, origin, p in zip(found.entries, found.origins, found.fields["pressure"]):
        own = reader.items[entry].fields["pressure"][origin : origin + width]
        assert np.abs(p - own).max() < 1e-4 * 1.93e9
    assert not found.ended and found.newton < 2 * found.attempts


@pytest.mark.parametrize("srr, within", [(0.0, 0.003), (-0.12, 0.003)])
def test_a_window_twice_as_fine_gives_what_a_run_twice_as_fine_does(runs, srr, within):
    (scene, reader), (_, fine) = runs(srr), runs(srr, columns=256)
    zoomed = ZoomedReader(reader, [passage(scene, reader, 2)], True)
    now, there, before = (one.scalar("p_max_Pa")[1:].max() for one in (zoomed, fine, reader))
    assert abs(now - there) < within * there and abs(now - there) < 0.4 * abs(before - there) + 1e-4 * there
    entry = int(np.argmax(zoomed.scalar("p_max_Pa")))
    p, shot = zoomed.fields(entry, ("pressure",))["pressure"], fine.items[2 * entry]
    near = np.abs(shot.x - shot.feature_x) < 0.2 * Scales.of(scene).a
    assert np.abs(p - shot.fields["pressure"])[near].max() < 0.005 * there


def test_a_feature_of_b_at_the_opposite_slip_has_the_same_window(runs):
    first, other = (passage(*runs(srr, name), 2) for srr, name in ((-0.12, "a"), (0.12, "b")))
    assert first.origins == other.origins
    assert np.array_equal(first.fields["pressure"], other.fields["pressure"])
    assert np.array_equal(first.fields["traction_x_a"], other.fields["traction_x_b"])


def test_a_window_may_begin_late_and_end_early(runs):
    scene, reader = runs(0.0)
    part = dataclasses.replace(scene, zoom=tehl.Zoom(factor=2, from_x=-0.4, to_x=-0.1))
    whole, late = (passage(one, reader, 2) for one in (scene, part))
    a = Scales.of(scene).a
    assert [-0.4 < shot.feature_x / a <= -0.1 for shot in reader.items[late.entries[0] - 1 : late.entries[-1] + 2]] == [
        False, *[True] * len(late.entries), False] or len(late.entries) == 9
    at = whole.entries.index(late.entries[-1])
    assert np.abs(late.fields["pressure"][-1] - whole.fields["pressure"][at]).max() < 0.03 * 1.93e9


@pytest.fixture(scope="module")
def sunk():
    """Runs on 128 and 256 columns with surfaces that run-in sank on 128: that of the asperity by a fifth, the other by less."""
    frame, found = np.linspace(-1.5e-4, 1.5e-4, 56), []
    changes = [SurfaceChange(name, frame, np.zeros(1), depth * np.exp(-((frame / 4e-5) ** 2))[:, None], False)
               for name, depth in (("a", 0.3e-6), ("b", 0.1e-6))]
    for columns in (128, 256):
        scene = LINE.replace(**PART, **{"thermal.on": False, "operation.srr": -0.12, "grid.nx": columns})
        reader = Snapshots(march(scene, changes=changes))
        reader.surface_changes = changes
        found.append((scene, reader))
    return found


def test_a_window_has_the_surfaces_after_run_in(runs, sunk):
    (scene, reader), (_, fine) = sunk
    one, zoomed = passage(scene, reader, 1), ZoomedReader(reader, [passage(scene, reader, 2)], True)
    for entry, origin, p in zip(one.entries, one.origins, one.fields["pressure"]):
        own = reader.items[entry].fields["pressure"][origin : origin + one.window.nx + 1]
        assert np.abs(p - own).max() < 1e-4 * 1.93e9
    now, there, before = (each.scalar("p_max_Pa")[1:].max() for each in (zoomed, fine, reader))
    assert abs(now - there) < 0.003 * there and abs(now - there) < 0.4 * abs(before - there) + 1e-4 * there
    assert runs(-0.12)[1].scalar("p_max_Pa")[1:].max() > 1.05 * there
    entry = int(np.argmax(zoomed.scalar("p_max_Pa")))
    p, shot = zoomed.fields(entry, ("pressure",))["pressure"], fine.items[2 * entry]
    near = np.abs(shot.x - shot.feature_x) < 0.2 * Scales.of(scene).a
    assert np.abs(p - shot.fields["pressure"])[near].max() < 0.005 * there


def failing(monkeypatch, fails):
    """Solves of windows that do not converge where fails(number of the solve)."""
    solve, count = window_passage.carefully, itertools.count(1)

    def carefully(solver, P):
        report = solve(solver, P)
        return dataclasses.replace(report, converged=report.converged and not fails(next(count)))

    monkeypatch.setattr(window_passage, "carefully", carefully)


def test_a_step_that_fails_for_good_ends_the_window(runs, monkeypatch):
    failing(monkeypatch, lambda n: n > 61)
    found = passage(*runs(0.0), 2)
    assert found.entries == list(range(1, 31)) and "did not converge with the feature at" in found.ended


def test_a_step_that_fails_once_is_taken_in_halves(runs, monkeypatch):
    """A run whose step is halved there differs by 36 MPa in that step and by 2 MPa later."""
    whole = passage(*runs(0.0), 2)
    failing(monkeypatch, lambda n: n == 61)
    halved = passage(*runs(0.0), 2)
    assert halved.attempts > whole.attempts and not halved.ended and halved.entries == whole.entries
    assert max(np.abs(a - b).max() for a, b in zip(whole.fields["pressure"], halved.fields["pressure"])) < 5e6


def test_numbers_are_those_of_all_moments_between_two_steps_of_the_run(runs, monkeypatch):
    (scene, reader), seen, accept = runs(0.0), [], WindowPassage._accept

    def watched(march, state, origin, ring, dT):
        accept(march, state, origin, ring, dT)
        inside = march.window.inside(origin)
        seen.append([march.levels.get(name)[inside] for name in (fields.P, fields.H)])

    monkeypatch.setattr(WindowPassage, "_accept", watched)
    found = passage(scene, reader, 2)
    s, count = Scales.of(scene), len(found.entries)
    assert len(seen) == 2 * count
    p, h = (np.reshape([reduce(one[n]) for one in seen], (count, 2)) for n, reduce in enumerate((np.max, np.min)))
    assert np.allclose(found.numbers["p_max_Pa"], p.max(axis=1) * s.p_H, rtol=1e-12)
    assert np.allclose(found.numbers["h_min_m"], h.min(axis=1) * s.h, rtol=1e-12)
    assert (p[:, 0] > p[:, 1]).any() and (h[:, 0] < h[:, 1]).any()


def test_states_between_the_steps_of_the_run_are_kept_at_whole_steps_of_the_window(runs, monkeypatch):
    failing(monkeypatch, lambda n: n == 61)
    found = passage(*runs(0.0), 4)
    moments = [at for at, _, _ in found.between]
    assert moments == [n + part for n in range(len(found.entries)) for part in (0.25, 0.5, 0.75)]
    first, last = (found.fields["pressure"][n] for n in (29, 30))
    tops = [fields["pressure"].max() for at, _, fields in found.between if 30 < at < 31]
    assert len(tops) == 3 and min(first.max(), last.max()) * 0.999 < min(tops)
    assert max(*tops, last.max()) <= found.numbers["p_max_Pa"][30] * (1 + 1e-6)
    assert set(found.between[0][2]) == {"pressure", *window_passage.SHEAR}


def test_progress_counts_the_steps_of_the_run(runs):
    seen = []
    scene, reader = runs(0.0)
    passage(scene, reader, 2, lambda *part: seen.append(part))
    last = len(reader) - 1
    assert seen == [(n, last) for n in range(1, last + 1)]


def test_windows_that_move_one_after_the_other_are_those_that_move_together(runs, monkeypatch):
    """In tables and kernels of the one before."""
    seen = []
    scene, reader = runs(-0.12)
    after = [one for one, in passages(scene, reader, [1, 2], lambda *part: seen.append(part))]
    assert seen == [(n, 2 * (len(reader) - 1)) for n in range(1, 2 * len(reader) - 1)]
    monkeypatch.setattr(BaseStates, "holds", lambda *_: False)
    together = [one for one, in passages(scene, reader, [1, 2])]
    assert [one.window.factor for one in after] == [one.window.factor for one in together] == [1, 2]
    for one, other in zip(after, together):
        assert one.entries == other.entries and one.origins == other.origins and not one.ended
        for name, fields_of in one.fields.items():
            assert all(np.array_equal(*pair) for pair in zip(fields_of, other.fields[name]))


@pytest.mark.slow  # a passage, and two windows of it
@pytest.mark.parametrize("srr", [-0.12, 0.12])
def test_a_wider_window_has_the_same_film(srr):
    """In a dent without temperatures, where the oil keeps for long what the inlet made of it."""
    scene = tehl.scene("gear").replace(srr=srr, height=-1.5e-6, **{
        "grid.nx": 128, "grid.ny": 32, "thermal.on": False, "fatigue.on": False, "time.x_end": 0.6})
    reader = Snapshots(tehl.march(scene))
    films = [dict(films_in_dent(scene, reader, passage(one, reader, 4)))
             for one in (scene, scene.replace(**{"zoom.width_x": 2.0}))]
    assert films[0].keys() == films[1].keys() and len(films[0]) > 50
    assert max(abs(films[0][entry] / films[1][entry] - 1) for entry in films[0]) < 0.002


def films_in_dent(scene, reader, found):
    """(entry, smallest film in m) under the feature at the moments of a passage."""
    w, f = found.window, scene.features[0]
    a = Scales.of(scene).a
    for entry, origin, film in zip(found.entries, found.origins, found.fields["film"]):
        x = w.columns(origin) * a
        yield entry, film[np.abs(x - reader.items[entry].feature_x) < f.reach].min()
