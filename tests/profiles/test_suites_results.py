"""The suites: their cases are scenes, their verdicts tell good from bad."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
from tehl_taichi.profiles import confirmed_starts, stability, stability_scenes

from tehl_taichi.scene import Scene, SceneError, scene, thin_film
from tehl_taichi.scene.scales import Scales

pytestmark = pytest.mark.usefixtures("taichi_cpu")


def test_every_case_is_a_scene_or_refused_in_a_sentence():
    found = stability_scenes.cases()
    assert len(found) > 40 and all(isinstance(case, (Scene, SceneError)) for case in found.values())
    assert sum(isinstance(case, SceneError) for case in found.values()) < 3


def test_a_case_that_converges_and_one_that_stops():
    short = scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16, "time.steps": 2})
    assert stability.run_case("short", short).verdict == "converged"
    hard = dataclasses.replace(short, numerics=dataclasses.replace(short.numerics, newton_max=1, krylov_max=5))
    stopped = stability.run_case("hard", hard)
    assert stopped.verdict == "stopped" and "did not converge" in stopped.reason


@pytest.mark.slow
def test_a_negative_film_is_a_failure():
    from tehl_taichi.march.passage import march

    shot = next(march(scene("smooth-line").replace(**{"thermal.on": False, "grid.nx": 64})))
    assert stability.sound(shot)
    for name, bad in (("film", -1e-9), ("pressure", np.nan)):
        broken = {**shot.fields, name: np.where(shot.x[:, None] > 0, shot.fields[name], bad)}
        assert not stability.sound(dataclasses.replace(shot, fields=broken))


def test_random_scenes_repeat_and_cover_the_range():
    def drawn(seed):
        return {name: case if isinstance(case, Scene) else str(case)
                for name, case in stability_scenes.random_cases(40, seed).items()}

    found = drawn(3)
    assert found == drawn(3) != drawn(4)
    scenes = [case for case in found.values() if isinstance(case, Scene)]
    assert len(scenes) > 25 and {s.contact.kind for s in scenes} == {"line", "elliptic"}
    lines = [case for name, case in found.items() if name.endswith(" line")]
    assert lines == [case for case in scenes if case.contact.kind == "line"]
    assert {s.isothermal for s in scenes} == {True, False} and len({s.rheology.law for s in scenes}) == 4


def test_rough_scenes_have_two_ground_surfaces():
    found = stability_scenes.rough_cases(20, 3)
    assert found == stability_scenes.rough_cases(20, 3) != stability_scenes.rough_cases(20, 4) and len(found) == 20
    for name, one in found.items():
        assert [f.surface for f in one.features] == ["a", "b"] and not one.isothermal and 0.02 <= abs(one.operation.srr) <= 0.5
        assert all(0.1e-6 <= f.height <= 0.5e-6 for f in one.features)
        lays = ["across" if f.length > f.width else "along" for f in one.features]
        assert name.endswith(", ".join(lays)) and one.features[0].seed != one.features[1].seed
        assert one.path[1] > -one.features[0].reach / Scales.of(one).a  # the front of the patch is behind the middle
    assert {one.operation.srr > 0 for one in found.values()} == {True, False}
    assert {name.partition(" 3-")[2].split(maxsplit=1)[1] for name in found} == {
        f"{a}, {b}" for a in ("across", "along") for b in ("across", "along")}


def test_starts_are_scenes_with_temperatures(monkeypatch):
    drawn = stability.starts(stability_scenes.random_cases(20, 3))
    assert len(drawn) > 4 and all(not s.isothermal and s.time.steps == 1 for s in drawn.values())
    shot = SimpleNamespace(scalars={"newton": 1.0, "cycles": 2.0}, unsettled="it moves")
    monkeypatch.setattr(stability, "march", lambda description: iter([shot, shot]))
    monkeypatch.setattr(stability, "sound", lambda shot: True)
    found = stability.run_case("moving", scene("gear"))
    assert found.unsettled and (found.verdict, found.reason, found.steps) == ("converged", "it moves", 1)


def test_random_scenes_on_the_grids_that_their_films_ask_for():
    drawn = stability_scenes.random_cases(40, 1)
    fine, finer = stability.carried(drawn), 0
    for name, description in drawn.items():
        if isinstance(description, SceneError):
            assert fine[name] is description
            continue
        most, nx = stability.FINEST[Scales.of(description).kind], fine[name].grid.nx
        finer += nx > description.grid.nx
        assert thin_film.resolved_ratio(fine[name]) >= 1 or nx == most
        assert (nx > description.grid.nx) == (thin_film.resolved_ratio(description) < 1)
        assert fine[name].grid.ny == 16 * (nx // 64 if most == 256 else 1)
    assert 8 < finer < 30


def test_an_error_is_a_failure(monkeypatch):
    def broken(description):
        raise ZeroDivisionError("1/0")
        yield

    monkeypatch.setattr(stability, "march", broken)
    assert stability.run_case("broken", scene("gear")).verdict == "failed"


def test_scenes_of_the_suite_run_through_the_pool(taichi_cpu):
    short = scene("smooth-line").replace(**{"thermal.on": False, "grid.nx": 64})
    found = list(stability.run([("short", short), ("refused", SceneError("no"))]))
    assert [(one.name, one.verdict) for one in found] == [("short", "converged"), ("refused", "refused")]


@pytest.mark.slow
def test_scenes_of_the_suite_run_side_by_side():
    short = scene("smooth-line").replace(**{"thermal.on": False, "grid.nx": 64})
    chosen = [(f"srr {srr}", short.replace(srr=srr)) for srr in (0.0, 0.1, 0.2)]
    found = {one.name: one.cycles for one in stability.run(chosen, workers=2)}
    assert found == {one.name: one.cycles for one in stability.run(chosen)}


def test_a_table_of_sentences_is_readable_on_80_columns(capsys, monkeypatch):
    from tehl_cli.tables import list_table

    monkeypatch.setenv("COLUMNS", "80")
    sentence = "a thermal passage with stresses and fatigue on 256x64 cells by two threads"
    list_table("speed", ("what", "seconds", "detail"), [(sentence, "61.904", "step 149.5 ms, 21.7 Krylov, 652 MB")])
    list_table("grids", ("name", "detail"), [("not-to-be-broken-anywhere", "much to tell " * 9)])
    shown = capsys.readouterr().out
    assert max(map(len, shown.splitlines())) <= 80
    assert "61.904" in shown and "Krylov" in shown and "not-to-be-broken-anywhere" in shown


@pytest.mark.parametrize("width", [30, 40, 60])
def test_narrow_terminals_break_no_number(monkeypatch, capsys, width):
    """1.92 and 83 on two lines would be read as 1.92."""
    from tehl_cli.tables import history_table

    monkeypatch.setenv("COLUMNS", str(width))
    scalars = {"step": 3.0, "p_max_Pa": 1.9283e9, "h_min_m": 3.91e-7, "newton": 4.0, "cycles": 26.0}
    history_table(lambda name: [scalars.get(name, 3e-7)], [0])
    row, = (line for line in capsys.readouterr().out.splitlines() if "e-" in line)
    assert row.split()[1::2] == ["3", "1.9283", "0.3910", "3e-07", "3e-07", "3e-07", "4", "26"]


def test_starts_are_confirmed_by_half_a_step_and_twice_the_columns(monkeypatch):
    """Films of 1 um + 0.01 um a column and 100 deg C + 1 K for half a step; one that stops on finer grids."""
    from tehl_taichi.errors import NotConverged

    def march(description):
        if description.grid.nx > 200:
            raise NotConverged("too fine")
        film = (1.0 + 0.01 * description.grid.nx) * 1e-6
        hot = description.time.courant < 1
        yield SimpleNamespace(scalars={"h_c_m": film, "film_max_C": 100.0 + hot}, unsettled="it moves" * (film > 2e-6))

    monkeypatch.setattr(confirmed_starts, "march", march)
    coarse, fine = (scene("gear").replace(**{"grid.nx": nx, "grid.ny": 32}) for nx in (64, 128))
    found, stopped = confirmed_starts.confirm({"coarse": coarse, "fine": fine})
    assert found == confirmed_starts.Confirmed("coarse", 64, 0.0, 1.0, pytest.approx(2.28 / 1.64 - 1), 0.0, True)
    assert not found.holds
    assert (stopped.half_film, stopped.half_K, stopped.finer_film, stopped.finer_K) == (0.0, 1.0, None, None)
    assert (found.moving, stopped.moving) == (True, True)  # 128 columns: 2.28 um
    assert not stopped.holds and confirmed_starts.Confirmed("near", 64, 0.0, 1.0, 0.01, 0.5, True).holds
    ball = scene("ridge-on-ball")
    finest = confirmed_starts.doubled(ball, 2).grid
    assert (finest.nx, finest.ny) == (4 * ball.grid.nx, 4 * ball.grid.ny)
    assert (confirmed_starts.doubled(coarse).grid.nx, confirmed_starts.doubled(coarse).grid.ny) == (128, 32)
    grids = confirmed_starts.finer({"line": coarse, "ball": ball, "none": "refused"}, 6)
    assert (grids["line"].grid.nx, grids["ball"].grid.nx, grids["none"]) == (2048, 512, "refused")
    assert confirmed_starts.finer({"line": coarse}, 2)["line"].grid.nx == 256


def test_a_start_is_doubled_until_it_holds(monkeypatch):
    """Films of 1 um + 1 um / columns and 100 deg C + 128 K / columns hold from 64 columns on, until half a step counts."""
    from tehl_taichi.errors import NotConverged

    run = []

    def march(description):
        nx, half = description.grid.nx, description.time.courant < 1
        run.append((nx, half))
        if nx == 32:
            raise NotConverged("too coarse")
        yield SimpleNamespace(scalars={"h_c_m": (1 + 1 / nx) * 1e-6, "film_max_C": 100 + 128 / nx + 5 * half * (nx < 128)},
                              unsettled="")

    monkeypatch.setattr(confirmed_starts, "march", march)
    coarse = scene("gear").replace(**{"grid.nx": 32, "grid.ny": 32})
    found, = confirmed_starts.confirm({"case": coarse}, again=6)
    assert found.holds and (found.columns, found.finer_K, found.half_K) == (128, 0.5, 0.0)
    assert run == [(32, False), (64, False), (128, False), (64, True), (256, False), (128, True)]
    assert not next(confirmed_starts.confirm({"case": coarse}, again=1)).holds
    monkeypatch.setitem(confirmed_starts.CONFIRMED, True, 64)
    assert next(confirmed_starts.confirm({"case": coarse}, again=6)).columns == 64


def test_a_start_that_is_lost_is_told(monkeypatch):
    from tehl_taichi.profiles import measure

    from tehl_taichi.runs.sweep.pool import LostJob

    monkeypatch.setattr(measure, "side_by_side", lambda *args: iter([(0, LostJob("its worker died"))]))
    lost, = confirmed_starts.confirm({"case": scene("gear")})
    assert (lost.name, lost.columns, lost.finer_K, lost.reason) == ("case", scene("gear").grid.nx, None, "its worker died")
