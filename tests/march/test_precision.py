"""Linear solves in single and in double precision: each scene in its own, the same answers in both."""

import subprocess
import sys

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.errors import NotConverged, SceneError
from tehl_taichi.march import passage
from tehl_taichi.march.accuracy.coarse_runs import scenes
from tehl_taichi.march.steady import solve_steady
from tehl_taichi.pressure import precision
from tehl_taichi.scene import scene, scene_file

pytestmark = pytest.mark.usefixtures("taichi_cpu")


# the domain and the inlet of the numbers below
NEWTONIAN = {"thermal.on": False, "rheology.law": "newtonian", "grid.inlet": "starved", "grid.x_min": -2.5}


def line(**changes):
    return scene("smooth-line").replace(**{**NEWTONIAN, "grid.nx": 128, **changes})


def gear(**changes):
    return scene("gear").replace(**{**NEWTONIAN, "grid.nx": 64, "grid.ny": 16, "time.steps": 3, **changes})


def solved(description):
    """(precision of the levels, that of their linear table, film) of the steady contact; the next one takes over its tables."""
    result = solve_steady(description, description.grid.nx, 0)
    assert result.report.converged
    levels = result.solver.levels
    return levels.precision, str(levels.J.dtype), result.values[-1]["h_c"]


def test_every_scene_runs_in_its_own_precision_in_any_order():
    thick, thin = line(**{"grid.nx": 64, "numerics.precision": "f32"}), line(**{"grid.nx": 64}, speed=0.6)
    asked, tables, films = zip(*map(solved, (thick, thin, thick, thick.replace(**{"numerics.precision": "f64"}))))
    assert asked == tables == ("f32", "f64", "f32", "f64")
    assert films[0] == films[2] != films[3] and films[0] == pytest.approx(films[3], rel=1e-6)


def test_lines_are_solved_in_double_so_that_a_study_has_one_set_of_kernels(taichi_cpu):
    """Where nothing varies along y, single precision saves nothing."""
    assert solved(line(**{"grid.nx": 64}))[:2] == ("f64", "f64")
    assert precision.of(gear()) == "f32" == precision.of(line(**{"grid.nx": 64, "numerics.precision": "f32"}))


def test_the_precision_can_be_asked_for():
    """The answers differ by what Newton's tolerance leaves, in no field by more."""
    exact = gear(**{"numerics.tolerance": 1e-9, "numerics.mass_tolerance": 1e-9})
    single, double, own = (list(tehl.march(exact, precision=p))[-1].fields for p in ("f32", "f64", None))
    assert np.array_equal(own["film"], single["film"])
    assert not np.array_equal(double["film"], single["film"])
    for name, field in double.items():
        assert np.abs(single[name] - field).max() <= 1e-7 * np.abs(field).max(), name
    with pytest.raises(SceneError, match="auto, f32, f64"):
        tehl.march(gear(), precision="f16")
    with pytest.raises(SceneError, match="numerics.precision"):
        gear(**{"numerics.precision": 64})


def test_thin_films_are_always_solved_in_double():
    """Asked for or not, before anything is computed; a run leaves nothing behind."""
    thin = line(**{"grid.nx": 64}, speed=0.6)
    assert solved(thin.replace(**{"numerics.precision": "f64"}))[1] == "f64"
    with pytest.raises(SceneError, match=r"'f32': a film of about .* m \(0.00.* is too thin .* allowed: auto, f64"):
        next(tehl.march(thin, precision="f32"))


def test_a_run_of_a_thin_film_in_single_writes_nothing(tmp_path):
    thin = line(**{"grid.nx": 64, "numerics.precision": "f32"}, speed=0.6)
    with pytest.raises(SceneError, match="too thin"):
        tehl.run(thin, tmp_path / "a.zarr")
    assert list(tmp_path.iterdir()) == []


SCRAMBLED = f"""
import importlib, pkgutil, random
import tehl_taichi as tehl
names = [m.name for m in pkgutil.walk_packages(tehl.__path__, "tehl_taichi.") if not m.name.endswith("__main__")]
random.Random(5).shuffle(names)
for name in names:
    importlib.import_module(name)
line = tehl.scene("smooth-line").replace(**{NEWTONIAN | {"grid.nx": 32}})
for precision in ("f64", "f32"):
    print(next(tehl.march(line, precision=precision)).scalars["h_c_m"].hex())
"""


@pytest.mark.slow  # a process of its own that imports everything; the order of scenes is asked for above
def test_neither_imports_nor_their_order_fix_a_precision():
    """All modules imported in any order before Taichi starts, then double before single: the numbers of this process."""
    done = subprocess.run([sys.executable, "-c", SCRAMBLED], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    double, single = (float.fromhex(text) for text in done.stdout.split())
    coarse = line(**{"grid.nx": 32})
    own = [next(tehl.march(coarse, precision=p)).scalars["h_c_m"] for p in ("f32", "f64")]
    assert own == [pytest.approx(single, rel=1e-10), pytest.approx(double, rel=1e-10)] and single != double


def test_a_store_and_its_companions_keep_the_precision():
    asked = gear(**{"numerics.precision": "f64"})
    assert {run.numerics.precision for run in scenes(asked)[0]} == {"f64"}
    assert type(asked).from_dict(asked.to_dict()) == asked and 'precision = "f64"' in scene_file.dumps(asked)


def effort(steps):
    """Newton and Krylov per step of a passage."""
    return [np.mean([s.scalars[key] for s in steps[1:]]) for key in ("newton", "cycles")]


def balanced(steps):
    return all(s.scalars[key] < 1e-6 for s in steps for key in ("residual", "load_error", "mass_error"))


def test_steady_films(linear):
    """A line and a circular contact, within what their grids are good for."""
    shot = next(tehl.march(line(**linear)))
    assert shot.scalars["h_c_m"] == pytest.approx(0.43898e-6, rel=1.1e-3) and balanced([shot])
    ball = scene("ball-on-disc").replace(**{"grid.nx": 64, "grid.ny": 32, **NEWTONIAN, **linear})
    shot = next(tehl.march(ball))
    assert shot.scalars["h_c_m"] == pytest.approx(0.13556e-6, rel=1e-3) and balanced([shot])
    assert shot.scalars["newton"] == 4 and shot.scalars["cycles"] < 41  # 37


def test_a_passage_and_its_effort(linear):
    """The asperity enters; steps take as long in single as in double precision."""
    steps = list(tehl.march(gear(**linear, **{"time.steps": 12})))
    newton, cycles = effort(steps)
    assert balanced(steps) and newton < 3.5 and cycles < 21.7  # 3.17, 19.7
    assert steps[12].scalars["p_max_Pa"] == pytest.approx(3.1028e9, rel=1e-3)
    assert steps[12].scalars["h_min_m"] == pytest.approx(0.11873e-6, rel=1e-3)


@pytest.mark.parametrize("linear", ["f32", pytest.param("f64", marks=pytest.mark.slow)], indirect=True)
def test_thermal_steps(linear):
    steps = list(tehl.march(gear(**linear, **{"thermal.on": True, "rheology.law": "limiting", "time.steps": 20})))
    newton, cycles = effort(steps)
    assert balanced(steps) and newton < 3.2 and cycles < 20.9  # 2.90, 18.95
    assert steps[3].scalars["film_max_C"] == pytest.approx(141.93, abs=0.05)


@pytest.fixture
def single_fails(monkeypatch):
    """Every solve of a passage in single precision: a scene whose film is on its floor does it on some machines only, whose
    sums round the other way."""
    own = passage.carefully

    def carefully(solver, P):
        report = own(solver, P)
        report.converged = report.converged and solver.levels.precision == "f64"
        return report

    monkeypatch.setattr(passage, "carefully", carefully)


def test_a_passage_goes_on_in_double_where_single_fails(taichi_cpu, single_fails):
    rough = gear(**{"time.steps": 2})
    with pytest.raises(NotConverged):
        list(tehl.march(rough, precision="f32"))
    states, films = [], []
    for shot in tehl.march(rough):
        states.append(shot.state)
        films.append(shot.fields["film"])
    assert [bool(state.get("double")) for state in states] == [False, True, True]
    again, = tehl.march(rough, states[1])
    np.testing.assert_array_equal(again.fields["film"], films[2])
