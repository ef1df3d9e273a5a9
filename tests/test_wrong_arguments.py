"""Arguments of the Python interface of a wrong kind: a sentence, an error of this package, and nothing is left behind."""

import os
import pickle
import subprocess
import sys

import numpy as np
import pytest

import tehl_taichi as tehl

LINE = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})


@pytest.mark.parametrize("wrong, words", [
    (lambda path: tehl.run(LINE, path, progress=True), "progress = True has no method begin"),
    (lambda path: tehl.run(LINE, path, progress=print), "progress = .* has no method begin"),
    (lambda path: tehl.run(LINE, path, force="no"), "force = 'no' must be true or false"),
    (lambda path: tehl.march("gear", state={}), "is not the state of a snapshot"),
    (lambda path: tehl.march("gear", state=3), "state = 3 is not the state of a snapshot"),
    (lambda path: tehl.crack([], lenth=3), r"unknown option 'lenth' \(did you mean 'length'\?\)"),
    (lambda path: tehl.crack([], residual="-100 N"), "residual = '-100 N': 'N' is no unit of it"),
    (lambda path: tehl.crack([], residual="x"), "residual = 'x' must be a stress in Pa"),
    (lambda path: tehl.crack([], tehl.scene("gear")), "no snapshots: tehl_taichi.crack needs those of a passage"),
    (lambda path: tehl.fatigue([], tehl.scene("gear")), "no snapshots: tehl_taichi.fatigue needs those of a passage"),
    (lambda path: tehl.fatigue(iter([])), "no snapshots"),
    (lambda path: tehl.fatigue([], progress=3), "progress = 3 has no method stage"),
    (lambda path: tehl.fatigue([[1e8] * 6], until=0.0), "until = 0.0 has no effect on given stresses"),
    (lambda path: tehl.run(LINE, "a\0b"), "is not a path"),
    (lambda path: tehl.sweep(LINE, {"srr": [0.0]}, path, progress=3), "progress = 3 is no function; allowed: a function"),
    (lambda path: tehl.sweep(LINE, {"srr": [0.0]}, path, scheduler=3), "scheduler = 3 is no scheduler; allowed: its address"),
    (lambda path: tehl.traction(LINE, srr=None), "srr = None is no list; allowed: numbers, or text"),
    (lambda path: tehl.compare([path, path]), "is a list; give its results one by one"),
    (lambda path: tehl.flank(folder=path, changes=3), "changes = 3 must be a dictionary {key: value}"),
    (lambda path: tehl.traction(LINE, path=path, changes=3), "changes = 3 must be a dictionary {key: value}"),
    (lambda path: tehl.Flank(path, {}).plot(3), "path = 3 is not a path"),
    (lambda path: tehl.Comparison([]).plot(3), "path = 3 is not a path"),
    (lambda path: tehl.Comparison([]).plot(path, at="x"), "at = 'x' is not a number"),
    (lambda path: tehl.flank(folder=path, steady="yes"), "steady = 'yes' must be true or false"),
    (lambda path: tehl.flank(folder=path, at=50), "the position past C = 50 m is out of range"),
    (lambda path: tehl.flank(folder=path, at="50 mm"), "the position past C = 0.05 m is out of range"),
    (lambda path: tehl.flank(folder=path, at=["1 kg"]), "'kg' is no unit of it"),
    (lambda path: tehl.bearing("6206", folder=path, dimensions=3), "dimensions = 3 must be a dictionary"),
    (lambda path: tehl.bearing("6206", folder=path, run="no"), "run = 'no' must be true or false"),
    (lambda path: tehl.report(path, path.with_name("x.html"), force="no"), "force = 'no' must be true or false"),
    (lambda path: tehl.report(path, pages=1), "pages = 1 must be true or false"),
    (lambda path: tehl.report(path, progress=3), "progress = 3 has no method stage"),
    (lambda path: tehl.export(path, force=1), "force = 1 must be true or false"),
    (lambda path: tehl.animate(path, force=1), "force = 1 must be true or false"),
    (lambda path: tehl.animate(path, progress=3), "progress = 3 is no function"),
    (lambda path: tehl.scene("gear").replace(**{"zoom.factor": 4.0}), "zoom.factor = 4.0 is not one of 0, 2, 4, 8, 16"),
])
def test_a_sentence(wrong, words, tmp_path):
    with pytest.raises(tehl.SceneError, match=words):
        wrong(tmp_path / "line.zarr")
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize("given, words", [
    ({"threads": True}, "threads = True is not a whole number; allowed: 1"), ({"threads": "2"}, "threads = '2' is not a whole"),
    ({"threads": 0}, "threads = 0 is out of range; allowed: 1 to"), ({"arch": "gpu"}, "arch = 'gpu' is not available; allowed"),
    ({"arch": 3}, "arch = 3 is not available; allowed: cpu, cuda, vulkan")])
def test_threads_and_kinds_of_machines_that_are_none(given, words, tmp_path):
    with pytest.raises(tehl.RuntimeUnavailable, match=words):
        tehl.run(LINE, tmp_path / "line.zarr", **given)
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize("call", [
    tehl.open, tehl.resume, tehl.zoom, tehl.scene, tehl.export, tehl.report, tehl.animate, tehl.fatigue, tehl.crack, tehl.run,
    tehl.compare, tehl.flank, tehl.bearing, tehl.cam, tehl.simulate, lambda path: tehl.run(LINE, path),
    lambda path: tehl.sweep(LINE, {"srr": [0.0]}, path), lambda path: tehl.traction(LINE, path=path),
    lambda path: tehl.flank(folder=path), lambda path: tehl.report("none.zarr", path), lambda path: tehl.animate("x", path),
    lambda path: tehl.export("none.zarr", path=path), lambda path: tehl.scene("gear").replace(table=path),
    lambda path: tehl.scene("rough").replace(**{"feature.file": path})])
@pytest.mark.parametrize("name", ["x" * 300, "some/" + "x" * 5000, "loop/inside"])
def test_a_path_that_cannot_be_looked_at(call, name, tmp_path, monkeypatch):
    """Names longer than the system allows, and a link to itself."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "loop").symlink_to("loop")
    with pytest.raises(tehl.Error):
        call(name)
    assert [path.name for path in tmp_path.iterdir()] == ["loop"]


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may become another user")
def test_a_folder_that_is_closed_to_this_user(tmp_path):
    """The system's reason is given, and never that nothing exists there."""
    (tmp_path / "closed" / "line.zarr").mkdir(parents=True, mode=0o700)
    code = f"""
import os, tehl_taichi as tehl
def said(path):  # at the first call modules are imported, which only their owner may read (report and export look for theirs)
    for call in tehl.open, tehl.resume, tehl.scene, tehl.zoom, tehl.fatigue, tehl.flank, tehl.bearing:
        try:
            call(path)
        except tehl.Error as error:
            yield str(error).endswith(": Permission denied")
print(sum(said("none.zarr")))
os.seteuid(65534)
print(sum(said({str(tmp_path / "closed" / "line.zarr")!r})))
"""
    tmp_path.chmod(0o755), (tmp_path / "closed").chmod(0o700)
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert out.stdout.split() == ["0", "7"], out.stderr


@pytest.mark.usefixtures("taichi_cpu")
def test_a_state_of_another_scene():
    cold = tehl.scene("gear").replace(**{"grid.nx": 32, "grid.ny": 8, "thermal.on": False, "time.steps": 1})
    state = next(tehl.march(cold)).state
    for scene, words in ((cold.replace(**{"thermal.on": True}), r"no array for heat_T, the scene needs \(9, 9, 33\)"),
                         (cold.replace(**{"grid.nx": 64}), r"shape \(9, 33\) for P, the scene needs \(9, 65\)")):
        with pytest.raises(tehl.SceneError, match=words):
            tehl.march(scene, state)
    with pytest.raises(tehl.SceneError, match="is not the state of a snapshot"):
        tehl.march(cold, {"P": state["P"]})
    assert [one.step for one in tehl.march(cold, state)] == [1]


@pytest.mark.usefixtures("taichi_cpu")
def test_arguments_of_a_run(tmp_path):
    """Paths and depths that are none; nothing is left beside the store."""
    run = tehl.run(LINE, tmp_path / "line.zarr")
    for wrong, words in ((lambda: run.export("csv", 3), "path = 3 is not a path"), (lambda: tehl.report(run, 3), "out = 3 is"),
                         (lambda: run.save_figures(3), "folder = 3 is not a path"),
                         (lambda: run.rest("x"), "steps = 'x' is not a whole"), (lambda: run.rest(0), "steps = 0 is out"),
                         (lambda: run.plot(depth="20 kg"), "'kg' is no unit of it"),
                         (lambda: run.plot(depth=1e-5), "depth = 1e-05 µm is .* did you mean 10 µm")):
        with pytest.raises(tehl.SceneError, match=words):
            wrong()
    assert [path.name for path in tmp_path.iterdir()] == ["line.zarr"]


@pytest.mark.usefixtures("taichi_cpu")
def test_a_path_is_its_run(tmp_path):
    scene = tehl.scene("gear").replace(**{"grid.nx": 32, "grid.ny": 8, "thermal.on": False, "time.steps": 4})
    run = tehl.run(scene, tmp_path / "gear.zarr")
    assert tehl.fatigue(str(run.path), kappa=0.2).summary == run.fatigue(kappa=0.2).summary
    cracks = tehl.crack(run.path, length=20e-6)
    assert cracks.summary == run.crack(length="20 um").summary == pickle.loads(pickle.dumps(cracks)).summary
    for call in (tehl.fatigue, tehl.crack):
        with pytest.raises(tehl.StoreError, match="none.zarr is not a store of tehl run"):
            call("none.zarr")


@pytest.mark.usefixtures("taichi_cpu")
def test_a_file_is_its_scene(tmp_path):
    """Wherever a scene is taken, and as text or path."""
    file = tmp_path / "line.toml"
    file.write_text('base = "smooth-line"\n[grid]\nnx = 32\n[thermal]\non = false\n')
    wanted = tehl.simulate(LINE)[0].scalars["h_c_m"]
    assert [tehl.simulate(one)[0].scalars["h_c_m"] for one in (file, str(file))] == [wanted, wanted]
    strong = tmp_path / "strong.toml"
    strong.write_text('base = "gear"\n[fatigue]\nendurance = "800 MPa"\n')
    assert tehl.fatigue([[1e8] * 6], strong).Fi == tehl.fatigue([[1e8] * 6], endurance=800e6).Fi
    for call in (tehl.march, tehl.simulate, lambda name: tehl.fatigue([[1e8] * 6], name)):
        with pytest.raises(tehl.SceneError, match="none.toml"):
            call(tmp_path / "none.toml")


@pytest.mark.usefixtures("taichi_cpu")
def test_until_is_a_position(tmp_path):
    run = tehl.run(tehl.scene("gear").replace(**{"grid.nx": 32, "grid.ny": 8, "thermal.on": False, "time.steps": 4}),
                   tmp_path / "gear.zarr")
    for until in ("x", float("nan"), None.__class__):
        with pytest.raises(tehl.SceneError, match="until = .* is not a number"):
            run.fatigue(until=until)
    assert run.fatigue(until=float("inf")).summary["Fi_max"] > 0


def test_threads_that_start_together_get_an_answer_each():
    """One of them has Taichi, the others are told so."""
    code = """
import threading, tehl_taichi as tehl
found, line = [], tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
def simulate():
    try:
        found.append(len(tehl.simulate(line)))
    except tehl.RuntimeUnavailable:
        found.append("elsewhere")
some = [threading.Thread(target=simulate) for _ in range(3)]
[one.start() for one in some]; [one.join() for one in some]
print(sorted(map(str, found)))
"""
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert out.strip() == "['1', 'elsewhere', 'elsewhere']"


@pytest.mark.parametrize("operation", [
    lambda p: p / 1e9, lambda p: 2 * p, lambda p: p + p, lambda p: p > 1.0, lambda p: -p, abs, int, round, np.sqrt,
    lambda p: np.ones(2) * p, lambda p: p**2])
def test_operators_on_a_quantity_are_refused_with_the_way_out(operation):
    """The error and the unit would be lost without a word."""
    pressure = tehl.Quantity(3e9, 2e7, "Pa", name="transient.p_max_Pa")
    with pytest.raises(TypeError, match=r"p_max_Pa has an error and a unit: calculate with its `.value` \(Pa\)") as it:
        operation(pressure)
    assert isinstance(it.value, tehl.Error) and float(pressure) == pressure.value and f"{pressure:.1e}" == "3.0e+09"


@pytest.mark.parametrize("given, plain", [
    ({"dx": "20 um"}, {"dx": 2e-5}), ({"depths": "10 um"}, {"depths": 1e-5}), ({"nu": "25 %"}, {"nu": 0.25}),
    ({"depths": ["0.01 mm", 0.0]}, {"depths": [1e-5, 0.0]}), ({"dx": tehl.Quantity(2e-5, None, "m")}, {"dx": 2e-5}),
    ({"pressure": [[1e9] * 3] * 4, "dy": "3e4 nm"}, {"pressure": [[1e9] * 3] * 4, "dy": 3e-5})])
def test_numbers_of_stresses_may_have_units(given, plain):
    """As the values of a scene."""
    usual = {"pressure": [1e9, 2e9, 0.0], "dx": 1e-5}
    assert np.array_equal(tehl.stresses(**{**usual, **given}), tehl.stresses(**{**usual, **plain}))


@pytest.mark.parametrize("given, words", [
    ({"dx": "10 kg"}, "dx = '10 kg': 'kg' is no unit of it; allowed: a number in m"), ({"dx": "x"}, "dx = 'x' is not a number"),
    ({"depths": "1 Pa"}, "depths = '1 Pa': 'Pa' is no unit of it"), ({"depths": [1e-5, None]}, "depths = None is not a number"),
    ({"depths": []}, "depths is empty"), ({"depths": [[0.0]]}, r"depths = \[0.0\] is not a number"),
    ({"depths": -1e-6}, "depths = -1e-06 m is out of range"), ({"nu": "1 m"}, "nu = '1 m': 'm' is no unit of it")])
def test_wrong_units_of_stresses(given, words):
    with pytest.raises(tehl.SceneError, match=words):
        tehl.stresses(**{"pressure": [1e9, 2e9, 0.0], "dx": 1e-5, **given})


@pytest.mark.usefixtures("taichi_cpu")
def test_positions_points_and_widths_may_have_units(tmp_path):
    """Of exports, figures, animations and the fatigue search."""
    pytest.importorskip("matplotlib")
    scene = tehl.scene("gear").replace(**{"grid.nx": 32, "grid.ny": 8, "thermal.on": False, "time.steps": 4})
    run = tehl.run(scene, tmp_path / "gear.zarr")
    at = float(run.store.scalar("feature_x")[2]) / run["hertz.a"].value
    texts = run.export("csv", tmp_path / "texts", at=f"{at} a", point=[("20 um", "0 mm"), (0.0, 0.0)])
    numbers = run.export("csv", tmp_path / "numbers", at=at, point=[(2e-5, 0.0), (0.0, 0.0)])
    assert {one.name: one.read_bytes() for one in texts.iterdir()} == {one.name: one.read_bytes() for one in numbers.iterdir()}
    films = [run.animate(tmp_path / f"{n}.gif", width=wide, frames=2, dpi=40) for n, wide in enumerate((8.0, "80 mm", "8 cm"))]
    assert len({film.read_bytes() for film in films}) == 1
    assert run.fatigue(until=f"{at} a").summary == run.fatigue(until=at).summary
    for wrong, words in ((lambda: run.export("csv", at="1 mm"), "at = '1 mm': 'mm' is no unit"), (
            lambda: run.animate(width="8 kg"), "width = '8 kg': 'kg' is no unit of it; allowed: a number in cm"),
            (lambda: run.plot(width="1 m"), "width = 100 cm is out of range"), (lambda: run.plot(at="x"), "at = 'x' is not a"),
            (lambda: run.animate(shown="x"), "shown = 'x' is not known"), (
            lambda: tehl.report(run, "page.pdf"), "page.pdf ends in .pdf, and a report is a page of HTML")):
        with pytest.raises(tehl.SceneError, match=words):
            wrong()


def test_what_holds_runs_names_them(tmp_path):
    """Wherever a run is needed."""
    study = tehl.sweep(LINE, {"srr": [0.0]}, tmp_path / "study.zarr", keep="summary", workers=1)
    bearing = tehl.bearing("6206", load="5 kN", speed=3000, run=False, folder=tmp_path / "b")
    for of, words in ((study.path, "is a study: .*cases/NUMBER.zarr"), (bearing.folder, "is a bearing: .*NAME-inner.zarr")):
        for call in (tehl.export, tehl.animate, tehl.resume, tehl.zoom, tehl.scene, tehl.fatigue, tehl.crack):
            with pytest.raises(tehl.StoreError, match=words):
                call(of)


@pytest.mark.usefixtures("taichi_cpu")
def test_a_run_gives_its_scene(tmp_path):
    run = tehl.run(LINE, tmp_path / "line.zarr")
    assert tehl.scene(run) == tehl.scene(run.path) == run.scene
    assert tehl.simulate(run)[0].scalars["h_c_m"] == tehl.simulate(LINE)[0].scalars["h_c_m"]
