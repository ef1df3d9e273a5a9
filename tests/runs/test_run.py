"""tehl.run, open and resume: what the command line does, from Python."""

from types import SimpleNamespace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.engine import runtime
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.scene.timeline import total_steps
from tehl_taichi.store.store import Store

pytestmark = pytest.mark.usefixtures("taichi_cpu")
# a ridge: one dimension; no sliding, so that its pressures ripple on this grid (0.7 MPa; 0 where oil slips at its limit)
RIDGE = tehl.scene("gear").replace(**{"feature.shape": "ridge", "grid.nx": 64, "grid.ny": 8, "thermal.on": False,
                                      "srr": 0.0, "time.steps": 4})
EACH = coarse_runs.FI, coarse_runs.BELOW, coarse_runs.RESOLVED, coarse_runs.RESOLVED_BELOW


class Heard(tehl.Progress):
    """Notes all that a run tells; Ctrl-C at the end of one step."""

    def __init__(self, stop=None):
        self.said, self.doubts, self.stages, self.steps, self.stop = [], [], [], [], stop

    def say(self, text):
        self.said.append(text)

    def warn(self, sentence):
        self.doubts.append(sentence)

    def stage(self, name, done, total):
        self.stages.append((name, done, total))

    def step(self, snapshot):
        self.steps.append(snapshot.step)
        if snapshot.step == self.stop:
            raise KeyboardInterrupt


@pytest.fixture(scope="module")
def done(taichi_cpu, tmp_path_factory):
    """(run of four steps, what it told)."""
    heard = Heard()
    return tehl.run(RIDGE, tmp_path_factory.mktemp("run") / "a.zarr", progress=heard), heard


@pytest.mark.parametrize("kept", [True, False])
def test_the_first_run_of_a_version_says_that_it_compiles(taichi_cpu, tmp_path, monkeypatch, kept):
    """Half a minute passes before its first step."""
    monkeypatch.setenv("TEHL_CACHE", str(tmp_path))
    assert not runtime.has_kernels()
    if kept:
        runtime.preferred_cache().mkdir()
        (runtime.preferred_cache() / "one.tic").touch()
    heard = Heard()
    tehl.run(tehl.scene("smooth-line").replace(**{"grid.nx": 64, "thermal.on": False}), tmp_path / "a.zarr", progress=heard)
    assert any(said.startswith("compiling kernels, once for this version") for said in heard.said) is not kept


def test_a_run_tells_its_stages_and_steps(done):
    run, heard = done
    assert heard.steps == [1, 2, 3, 4] and heard.doubts == RIDGE.warnings() and "passage cut" in heard.doubts[-1]
    assert any("left out: y direction" in said for said in heard.said)
    passage = [(n, total) for name, n, total in heard.stages if name == "passage"]
    assert passage == [(n, 4) for n in range(5)]
    assert list(dict.fromkeys(name for name, *_ in heard.stages)) == ["steady start", "passage", "stresses and fatigue"]
    last = {name: n == total for name, n, total in heard.stages}
    assert all(last.values())


def test_the_fatigue_search_tells_how_far_it_is_below_the_surface_too(done):
    """From 0 to one total, never back; the halves of its passes are those of the surface and of what lies below."""
    for run, passes, changes in ((done[0], 8, {}), (done[0], 8, {"depths": [20e-6, 50e-6], "surfaces": "a"})):
        heard = Heard()
        run.fatigue(progress=heard, **changes)
        parts = [n for _, n, _ in heard.stages]
        assert parts == sorted(parts) and {total for *_, total in heard.stages} == {100 * passes}
        assert {100 * n for n in range(passes + 1)} <= set(parts)


def test_a_slice_of_points_after_another_is_the_same_search(monkeypatch, taichi_cpu):
    from tehl_taichi.fatigue import findley

    history, told = 1e8 * np.random.default_rng(0).normal(size=(7, 12, 6)), []
    whole = findley.search(history, 0.3)
    monkeypatch.setattr(findley, "SLICE", 3)
    for one, other in zip(findley.search(history, 0.3, notify=lambda *part: told.append(part)), whole):
        np.testing.assert_array_equal(one, other)
    assert told == [(3, 7), (6, 7), (7, 7)]


def test_a_run_is_what_is_stored(done):
    run, _ = done
    again = tehl.open(str(run.path))
    assert run.finished and again.summary == run.summary and again.scene == run.scene == RIDGE
    assert run.summary["steps"] == 4 and run.summary["fatigue"]["Fi_max"] > 0 and run.summary["store"] == str(run.path)
    assert run.summary["crowding"] == [0, 0]  # one block of rows: nothing to share
    shots = list(tehl.march(RIDGE))
    assert again.warnings == run.warnings == run.summary["warnings"]
    assert run.summary["transient"]["p_max_Pa"] == max(shot.scalars["p_max_Pa"] for shot in shots[1:])
    from tehl_taichi.march.accuracy.peaks import ripple

    ripples = [ripple(shot.fields["pressure"].astype("f4"))[0] for shot in shots]  # as they are stored
    found = run.summary["steady"]["ripple_Pa"], run.summary["transient"]["ripple_max_Pa"]
    assert found == (ripples[0], max(ripples[1:])) and found[1] > 0
    np.testing.assert_array_equal(run.store.fields(4)["film"], shots[4].fields["film"].astype("f4"))
    assert repr(run) == f"<tehl.Run gear: 4 steps, finished, {run.path}>"


def test_a_passage_that_lacks_its_fatigue_says_so():
    from tehl_taichi.runs import single_run

    left = SimpleNamespace(store=SimpleNamespace(last_step=total_steps(RIDGE), run_in=None), scene=RIDGE)
    assert single_run._missing_words(left) == ", the whole passage; stresses and errors are missing"
    left.store.last_step -= 1
    assert single_run._missing_words(left) == ""


def test_ctrl_c_says_what_is_stored_and_is_no_error_of_ours(done, tmp_path):
    path = tmp_path / "b.zarr"
    with pytest.raises(KeyboardInterrupt, match="interrupted after [12] steps; resume with: tehl resume .*b.zarr"):
        tehl.run(RIDGE, path, progress=Heard(stop=2))
    half = tehl.open(path)
    assert not half.finished and half.summary == {} and "not finished" in repr(half) and half.rest() == RIDGE
    whole = tehl.resume(path)
    assert whole.finished
    for n in range(5):
        np.testing.assert_array_equal(whole.store.fields(n)["film"], done[0].store.fields(n)["film"])


def test_the_time_of_a_resumed_run_is_that_of_all_its_pieces(tmp_path):
    path = tmp_path / "slow.zarr"
    with pytest.raises(KeyboardInterrupt):
        tehl.run(RIDGE, path, progress=Heard(stop=2))
    with Store.write(path) as saved:  # as if each of its steps had taken a quarter of an hour
        saved.series["wall_s"][: saved.steps] = 900.0
        saved._show()
    assert 900.0 < tehl.resume(path).summary["wall_s"] < 1800.0  # of the steady start, the only one with a state
    with Store.write(path) as saved:  # as if its search had taken hours
        saved.finish({**saved.summary, "wall_s": 9e3})
    assert 9e3 < tehl.resume(path, steps=1).summary["wall_s"] < 9.9e3


def test_a_finished_run_goes_on_behind_its_end(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run = tehl.run(RIDGE.replace(**{"time.steps": np.int64(1), "fatigue.on": False}))
    assert str(run.path) == "runs/gear-1.zarr" and run.rest(2).time.steps == 3
    heard = Heard()
    more = tehl.resume(run.path, steps=2, progress=heard)
    assert heard.steps == [2, 3] and more.summary["steps"] == 3
    whole = tehl.run(tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False}), "s.zarr")
    assert whole.rest() is None and tehl.resume("s.zarr", progress=heard).summary == whole.summary and len(heard.steps) == 2


def test_a_run_shows_itself_as_a_table_and_in_figures(done, tmp_path, monkeypatch):
    run, _ = done
    shown = run._repr_html_()
    assert f"<td>{run.summary['transient']['p_max_Pa'] / 1e9:.3g} GPa (error unknown)</td>" in shown
    film = f"{run.summary['steady']['film_formula_m'] * 1e6:.4f} um"
    assert f"isothermal, Newtonian, heavy load: within 16%)</td><td>{film}</td>" in shown
    assert "<li>passage cut" in shown and "gear: 4 steps" in shown
    data = run.to_xarray()
    assert data.pressure.dims == ("time", "x", "y") and float(data.p_max_Pa[4]) == run.store.scalar("p_max_Pa")[4]
    assert not {*data.dims} - {*data.coords} and data.feature_x.dims == ("time",) and "feature_x" in data.pressure.coords
    assert data.worst_stress.sel(component="xz").shape == data.moment.shape
    drawn = run.plot(width=8.5, dpi=40)
    assert drawn["centreline"].savefig and drawn._repr_html_().count("data:image/png;base64") == len(drawn) > 3
    figures = run.save_figures(tmp_path / "figures", dpi=np.int64(40))
    assert {path.name for path in figures} >= {"centreline.png", "fatigue.png"} and all(path.exists() for path in figures)
    for folder, dpi in ((tmp_path, 5), (figures[0], 40)):
        with pytest.raises(tehl.Error, match="dpi = 5|cannot put figures"):
            run.save_figures(folder, dpi=dpi)
    assert {path.stem for path in figures} == {*drawn}
    monkeypatch.setattr(type(run), "save_figures", lambda self, folder, **options: [folder, options["dpi"]])
    with pytest.warns(DeprecationWarning, match="save_figures"):
        assert run.plot("old", dpi=40) == ["old", 40]


def test_a_number_of_a_run_by_its_name(done):
    run, _ = done
    summary = run.summary
    p = run["p_max"]
    assert p == run["transient.p_max_Pa"] == run["transient.p_max"] and p.value == float(p) == summary["transient"]["p_max_Pa"]
    assert p.unit == "Pa" and p.error is None and p.reason == "not estimated" in str(p)
    assert run["steady.p_max"].value == summary["steady"]["p_max_Pa"] and run["film_formula"].name == "steady.film_formula_m"
    assert run["Fi_max"].value == summary["fatigue"]["Fi_max"] and run["Fi_max"].unit == "" and run["hertz.a_m"].reason == ""
    assert run["fatigue.below.Fi_max"].value == summary["fatigue"]["below"]["Fi_max"]
    assert "transient.h_min_m" in run._ipython_key_completions_()
    with pytest.raises(KeyError, match="'p_mx' is no number of this run .did you mean 'p_max'"):
        run["p_mx"]
    with pytest.raises(tehl.UnknownName) as unknown:
        run["friction"]
    names = list(run)
    assert len(names) > 60 and all(name in run and run[name].value is not None for name in names)
    assert "p_max" in run and "friction" not in run
    assert str(unknown.value) == ("'friction' is no number of this run (did you mean 'friction_coefficient'?); "
                                  f"all {len(names)} names: list(run)")
    assert issubclass(tehl.UnknownName, tehl.Error)


def test_the_fatigue_of_a_run_again(done):
    run, _ = done
    first = run.summary["fatigue"]
    again = tehl.fatigue(run, endurance=np.float64(2e8), kappa=None)
    assert again.summary["findley_stress_max_Pa"] == first["findley_stress_max_Pa"]
    assert again.summary["Fi_max"] == pytest.approx(2 * first["Fi_max"], rel=1e-12)
    asked = run.fatigue(endurance=2e8).summary  # with its errors, as far as those of the run hold
    for part in (asked, asked["below"]):
        assert set(part["error"]) == {"Fi_max"} and isinstance(part["unknown"], dict)
    assert asked == again.summary and tehl.open(run.path).summary["fatigue"] == first
    part = run.fatigue(depths=[], to_x=-1.48).summary
    assert part["findley_stress_max_Pa"] < first["findley_stress_max_Pa"] and "below" not in part
    heard = Heard()
    limits = run.fatigue(bending_limit=500e6, torsion_limit=320e6, depths=[], progress=heard).summary
    assert limits["kappa_F"] == pytest.approx(0.2916, abs=1e-4) and heard.stages[-1][0] == "stresses and fatigue"


def test_the_fatigue_of_snapshots_is_that_of_their_run(done):
    shots = tehl.march(RIDGE)
    found = tehl.fatigue(shots, RIDGE).summary["findley_stress_max_Pa"]
    assert found == pytest.approx(done[0].summary["fatigue"]["findley_stress_max_Pa"], rel=1e-6)  # stored in single precision


def bending(amplitude=100e6):
    stress = np.zeros((5, 6))
    stress[:, 0] = amplitude * np.array([0, 1, 0, -1, 0])
    return stress


def test_the_fatigue_of_stresses_from_elsewhere():
    """Reversed bending and torsion at the limits of their material have the index 1; twice the stress, twice the index."""
    torsion = np.zeros((5, 6))
    torsion[:, 3] = 320e6 * np.array([0, 1, 0, -1, 0])
    limits = {"bending_limit": 500e6, "torsion_limit": 320e6}
    found = tehl.fatigue(np.stack([bending(500e6), torsion, 2 * torsion]), **limits)
    np.testing.assert_allclose(found.Fi, [1, 1, 2], rtol=1e-8)
    assert found.worst == 2
    angle = np.degrees(np.arccos(np.abs(found.normals[0, 0])))
    assert np.tan(np.radians(2 * angle)) == pytest.approx(1 / 0.2916, rel=1e-3)  # Findley: tan 2 theta = 1/kappa
    assert tehl.fatigue(bending(500e6).tolist(), **limits).Fi == pytest.approx(1)  # one point, as a list


@pytest.mark.parametrize("kappa", [0.0, 0.3, 1.0])
def test_one_limit_and_kappa_are_enough(kappa):
    """The stress of that limit has the index 1; by hand, sigma_eF of torsion is t sqrt(1 + kappa^2), of bending
    (b/2)(kappa + sqrt(1 + kappa^2))."""
    torsion = np.zeros((5, 6))
    torsion[:, 3] = 320e6 * np.array([0, 1, 0, -1, 0])
    found = tehl.fatigue(torsion, kappa=kappa, torsion_limit=320e6)
    assert found.Fi == pytest.approx(1, rel=1e-7) and found.limit == pytest.approx(320e6 * np.sqrt(1 + kappa**2), rel=1e-8)
    found = tehl.fatigue(bending(500e6), kappa=kappa, bending_limit=500e6)
    assert found.Fi == pytest.approx(1) and found.limit == pytest.approx(250e6 * (kappa + np.sqrt(1 + kappa**2)), rel=1e-8)


def test_the_critical_plane_is_told_by_two_angles():
    """Reversed tension along x (y), half of it along y (x), none along z: the normal leans from z by 90 - 36.65 degrees, with
    tan(2 36.65) = 1/0.3, towards x (y)."""
    along_x, along_y = bending(), np.zeros((5, 6))
    along_y[:, 1], along_y[:, 0], along_x[:, 1] = along_x[:, 0], along_x[:, 0] / 2, along_x[:, 0] / 2
    found = tehl.fatigue(np.stack([along_x, along_y]), kappa=0.3)
    np.testing.assert_allclose(found.theta, 90 - 36.65, atol=0.05)
    np.testing.assert_allclose(np.abs(found.phi) % 180, [0, 90], atol=0.05)


@pytest.mark.parametrize("of, constants, said", [
    (bending(), {"kapa": 1}, "kappa"), (bending(), {"to_x": 1.0}, "to_x has no effect"), (bending(), {"kappa": -1}, "kappa"),
    (bending(), {"criterion": "finley"}, "findley"), (bending()[:, :5], {}, "shape"), (bending() * np.nan, {}, "finite"),
    (bending(), {"bending_limit": 5e8, "endurance": 4e8}, "endurance = 400000000.0 and fatigue.bending_limit = .* contradict"),
    (bending(), {"bending_limit": 5e8, "torsion_limit": 2e8}, "between 0.5 and"),
    (bending(), {"bending_limit": -5e8, "torsion_limit": 2e8}, "bending_limit"), ([["a"]], {}, "given stresses"),
    (bending(), {"bending_limit": 5e8, "torsion_limit": 1.1e11}, "torsion_limit.*1e\\+11"),
    ([], {}, "no snapshots")])
def test_bad_stresses_and_constants_are_one_error(of, constants, said):
    with pytest.raises(tehl.SceneError, match=said):
        tehl.fatigue(of, **constants)


@pytest.mark.parametrize("shape", [(0, 3, 6), (2, 0, 6), (0, 6), (0,), (6,), (1, 2, 3, 6)])
def test_no_history_at_all_is_refused(shape):
    with pytest.raises(tehl.SceneError, match=r"given stresses have the shape \(.*\); allowed: \(points, times, 6\)"):
        tehl.fatigue(np.zeros(shape))


def test_masked_and_complex_stresses_are_refused():
    """A mask is no stress, and the imaginary part would be lost; a mask without masked values changes nothing."""
    masked = np.ma.array(bending(), mask=False)
    assert tehl.fatigue(masked).f == tehl.fatigue(bending()).f == tehl.fatigue([*masked]).f
    masked[2, 0] = np.ma.masked
    for given in (masked, [*masked]):
        with pytest.raises(tehl.SceneError, match="1 of the 30 given stresses are masked, nan or infinite; allowed: finite"):
            tehl.fatigue(given)
    with pytest.raises(tehl.SceneError, match="must be an array of real numbers in Pa"):
        tehl.fatigue(bending() + 0j)


@pytest.mark.parametrize("words, said", [
    (("geer",), "gear"), (("no.toml",), "cannot read"), ((5,), "5 is not a scene"), ((RIDGE, "a", {"threads": 0}), "1 to 1024"),
    ((RIDGE, "a", {"threads": "two"}), "threads = 'two'"),
    ((RIDGE, "a", {"threads": 1}), "already runs"), ((RIDGE, "a", {"arch": "metal"}), "cpu")])
def test_bad_input_is_one_error_and_writes_nothing(tmp_path, monkeypatch, words, said):
    monkeypatch.chdir(tmp_path)
    *words, options = words if isinstance(words[-1], dict) else (*words, {})
    with pytest.raises(tehl.Error, match=said) as error:
        tehl.run(*words, **options)
    assert error.value.exit_code == 2 and list(tmp_path.iterdir()) == []
    with pytest.raises(tehl.Error, match="whole number"):
        tehl.resume("a", steps=0.5)


def test_a_completed_run_is_kept_gone_on_with_or_made(done, tmp_path):
    from tehl_taichi.runs.single_run import run_or_resume

    run, _ = done
    heard = Heard()
    assert run_or_resume(RIDGE, run.path, progress=heard).summary == run.summary and heard.stages == []
    with pytest.raises(tehl.StoreError, match="another scene"):
        run_or_resume(RIDGE.replace(srr=0.1), run.path)
    with pytest.raises(KeyboardInterrupt):
        run_or_resume(RIDGE, tmp_path / "c.zarr", progress=Heard(stop=3))
    assert run_or_resume(RIDGE, tmp_path / "c.zarr", progress=heard).finished and heard.steps[-1] == 4
    assert "steady start" not in [name for name, *_ in heard.stages]  # that it had


def test_a_body_that_decides_by_its_error_bar_leads_in_numbers_and_arrays(taichi_cpu, tmp_path, monkeypatch):
    """Of two indices below 1, the one that is 1 within its error decides, though it is the smaller one."""
    scene = RIDGE.replace(**{"srr": -0.2, "time.steps": 20, "fatigue.endurance": 4e9})
    found = {}
    for name in "ab":
        bars = {f"{name}:{key}": 5.0 for key in EACH}
        monkeypatch.setattr(coarse_runs, "errors", lambda *_, bars=bars: {"passage_error": bars, "passage_unknown": {}})
        run = found[name] = tehl.run(scene, tmp_path / f"{name}.zarr")
        again = tehl.fatigue(run, endurance=4.1e9)
        assert run.summary["fatigue"]["surface"] == again.summary["surface"] == name
        assert run.summary["fatigue"] == run.summary["fatigue_by_surface"][name] and run.summary["fatigue"]["Fi_max"] < 1
        assert run.store.map("Fi").max() == pytest.approx(run.summary["fatigue"]["Fi_max"], rel=1e-6)
    np.testing.assert_array_equal(found["a"].store.map("Fi"), found["b"].store.map("other_Fi"))
    assert found["a"].store.map("Fi").max() != found["b"].store.map("Fi").max()
