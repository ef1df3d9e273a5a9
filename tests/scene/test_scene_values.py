"""Values of any type where a scene expects another: a sentence or a scene, never another exception."""

import json
import math
import random
import tomllib

import numpy as np
import pytest

from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.scene import BUILT_INS, Scene, SceneError, scene, scene_file
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.sections import Contact, Grid, Operation, Thermal
from tehl_taichi.values.estimate import Quantity

DEEP = []
for _ in range(2000):
    DEEP = [DEEP]
NUMBERS = (0, 1, -1, 3, 64, 10**400, -(10**5000), 0.0, 1e-12, 0.5, 1e300, -1e300, math.nan, math.inf, -math.inf, 1j)
TEXTS = ("", "x", "auto", "gear", "moes-test-fluid", "a\nb", "../x", "\ud800", "\0", "ä" * 300, b"x")
LISTS = ([], [1, 2], [[1, 2], [3, 4]], ["a"], [None], DEEP, (), (1,), {}, {"a": 1}, {"x": {"y": []}}, set(), range(3))
ARRAYS = (np.array([1.0, 2.0]), np.array([]), np.str_("x"), np.int8(3), np.float32(0.5), np.bool_(True), np.longdouble(1.0),
          np.complex128(1j), np.datetime64("2020"), np.float64(math.nan))
ODD = (None, True, False, object(), *NUMBERS, *TEXTS, *LISTS, *ARRAYS)


def places(data, path=()):
    """Paths of every table and value in nested dictionaries and lists."""
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, (list, tuple)) else ()
    for key, value in items:
        yield (*path, key)
        yield from places(value, (*path, key))


def copied(data):
    if isinstance(data, dict):
        return {key: copied(value) for key, value in data.items()}
    return [copied(value) for value in data] if isinstance(data, (list, tuple)) else data


def put(data, path, value):
    for key in path[:-1]:
        data = data[key]
    data[path[-1]] = value


def judged(call):
    """The scene, its file and its warnings made without a failure; or one sentence."""
    try:
        found = call()
    except SceneError as error:
        assert str(error) and len(str(error).splitlines()) == 1 and len(str(error)) < 1500, str(error)
        return None
    assert isinstance(found, Scene) and json.loads(json.dumps(found.to_dict()))
    assert scene_file.from_data(tomllib.loads(scene_file.dumps(found)), "x") == found
    assert all(isinstance(line, str) for line in [*found.warnings(), *found.left_out()])
    return found


@pytest.mark.parametrize("each", [1, pytest.param(6, marks=pytest.mark.slow)])
def test_any_value_anywhere(each):
    rng = random.Random(7)
    bases = {name: scene(name).to_dict() for name in ("gear", "rough", "ridge-on-ball")}
    kept = 0
    for name, base in bases.items():
        for path in places(base):
            for value in rng.sample(ODD, each):
                data = copied(base)
                put(data, path, value)
                kept += judged(lambda: Scene.from_dict(data)) is not None  # noqa: B023
                kept += judged(lambda: scene_file.from_data({"base": name, path[0]: data[path[0]]}, "x")) is not None  # noqa: B023
                if isinstance(path[-1], str):
                    key = ".".join(map(str, path))
                    kept += judged(lambda: scene(name).replace(**{key: value})) is not None  # noqa: B023
    assert kept > 30


def test_several_odd_values_and_keys():
    rng, base = random.Random(8), scene("gear").to_dict()
    spots = list(places(base))
    for _ in range(400):
        data = copied(base)
        for path in sorted(rng.sample(spots, 3), key=len):
            try:
                put(data, path, rng.choice(ODD))
            except (KeyError, IndexError, TypeError, AttributeError):  # its table is none any more
                pass
        data[rng.choice(["x", "", 3, None, "a\nb", "oil", ("a",), "contact"])] = rng.choice(ODD)
        judged(lambda: Scene.from_dict(data))  # noqa: B023


NUMPY = [("srr", np.float64(-0.1)), ("load", np.int64(1000000)), ("grid.nx", np.int32(128)), ("thermal.on", np.bool_(False)),
         ("temperature", np.float32(80.0)), ("fatigue.depths", np.array([2e-5, 5e-5])), ("name", np.str_("x")),
         ("speed", np.array(8.0)), ("time.steps", np.uint8(3)), ("kappa", np.longdouble(0.25))]


@pytest.mark.parametrize("key, value", NUMPY, ids=[key for key, _ in NUMPY])
def test_numpy_values_become_plain_ones(key, value):
    found = scene("gear").replace(**{key: value})
    assert json.dumps(found.to_dict()) and found == scene("gear").replace(**{key: value.tolist() if key != "kappa" else 0.25})


def test_numpy_values_in_the_parts():
    parts = [Contact(load=np.float64(1e6)), Operation(srr=np.int64(0)), Grid(nx=np.int64(64)), Thermal(on=np.bool_(True)),
             Feature(height=np.float32(1e-6)), Oil(viscosity="table", table=np.array([[0.0, -3.0], [1e9, 5.0]]))]
    for part in parts:
        for value in vars(part).values():
            assert type(value) in (float, int, bool, str, tuple) and not isinstance(value, np.generic)
    assert type(Operation(u_m=8).u_m) is float and Contact(load=10**6) == Contact(load=1e6)


QUANTITIES = [("load", 1.1e6, "N/m"), ("hertz_pressure", 1.2345678901234567e9, "Pa"), ("temperature", 81.23456789, "degC"),
              ("srr", 0.1, ""), ("grid.nx", 128, ""), ("height", 1.1e-6, "m")]


@pytest.mark.parametrize("key, value, unit", QUANTITIES, ids=[key for key, *_ in QUANTITIES])
def test_a_number_of_a_run_becomes_a_value_in_its_unit(key, value, unit):
    assert scene("gear").replace(**{key: Quantity(value, 0.1 * value, unit)}) == scene("gear").replace(**{key: value})
    with pytest.raises(SceneError, match="'K m' is no unit of it|is not a whole number"):
        scene("gear").replace(**{key: Quantity(value, None, "K m")})


def test_a_number_without_a_value_is_refused():
    with pytest.raises(SceneError, match="operation.u_m = 'nan m/s' is not a number"):
        scene("gear").replace(speed=Quantity(math.nan, None, "m/s", "not resolved"))


def test_lists_of_other_packages_and_ranges():
    array = pytest.importorskip("xarray").DataArray([1, 2], {"n": [0, 1]}, name="numbers")
    for given in (array, array.to_series(), range(1, 3)):
        assert plan(scene("gear"), {"srr": given}).axes[0].rows == ((1,), (2,))
    for given in (array * 1e-5, array.to_series() * 1e-5):
        assert scene("gear").replace(**{"fatigue.depths": given}).fatigue.depths == (1e-5, 2e-5)


@pytest.mark.parametrize("name", ["x", "my scene", "ä-ö", 'quo"ted', "it's", "-", "3", "#", "日本"])
def test_any_allowed_name_comes_back_from_a_file(name, tmp_path):
    path = tmp_path / "s.toml"
    path.write_text(scene_file.dumps(scene("gear").replace(name=name)), encoding="utf-8")
    assert scene_file.load(path).name == name


def test_any_text_comes_back_from_a_file():
    rng = random.Random(9)
    for _ in range(50):
        codes = [rng.choice([rng.randrange(0x20), 0x7f, 0x22, 0x5c, rng.randrange(0x20, 0xd7ff), 0x1f600]) for _ in range(9)]
        text = "".join(map(chr, codes))
        found = scene("gear").replace(**{"oil.source": text, "fatigue.source": text})
        assert scene_file.from_data(tomllib.loads(scene_file.dumps(found)), "x") == found


@pytest.mark.parametrize("name", BUILT_INS)
def test_built_in_scenes_are_their_own_dictionaries(name):
    assert judged(lambda: Scene.from_dict(scene(name).to_dict())) == scene(name)
