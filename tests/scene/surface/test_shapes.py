"""The registry of feature shapes: each entry holds, and its example passes a contact."""

import ast
import math
import pickle
from pathlib import Path

import numpy as np
import pytest
from values.test_registry import hold

from tehl_taichi.scene import Scene, SceneError, scene
from tehl_taichi.scene.feature import OWN, SHAPES, USED_BY, Feature
from tehl_taichi.values.quantity import kinds

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize("name", SHAPES)
def test_every_shape_holds(name):
    hold(SHAPES[name])
    assert name == SHAPES[name].name and SHAPES[name].uses.keys() <= kinds(Feature).keys()


@pytest.mark.parametrize("name", SHAPES)
def test_every_example_is_of_its_shape_and_ends_where_it_reaches(name):
    data = {**scene("gear").replace(**{"grid.nx": 128, "grid.ny": 32}).to_dict(), "feature": [dict(SHAPES[name].example)]}
    f = Scene.from_dict(data).features[0]
    assert f.shape == name
    x = np.linspace(-2 * f.reach, 2 * f.reach, 801)
    y = np.linspace(-2, 2, 401) * (f.reach_y if 0 < f.reach_y < 1 else 1e-3)
    heights = f.height_at(x[None, :], y[:, None])
    largest = max(abs(f.top), abs(f.height))  # a dent is deeper than its rim is high
    assert np.abs(heights).max() <= largest * (1 + 1e-9) or name in ("rough", "ground")  # rms, Ra
    assert np.abs(heights[:, np.abs(x) > f.reach]).max() <= 1.1e-5 * np.abs(heights).max()
    assert f.transverse == (np.ptp(heights, axis=0).max() == 0) and (not f.symmetric or np.allclose(heights, heights[::-1]))
    if f.reach_y > 0:
        assert np.abs(heights[np.abs(y) > f.reach_y]).max(initial=0.0) == 0


@pytest.mark.parametrize("changes", [{}, {"extent_y": 200e-6}, {"length": math.inf}, {"length": math.inf, "extent_y": 200e-6},
                                     {"lay": "longitudinal"}, {"lay": "longitudinal", "extent_y": 200e-6}, {"y": 30e-6}])
@pytest.mark.parametrize("name", SHAPES)
def test_a_feature_is_transverse_where_nothing_varies_along_y(name, changes):
    """And symmetric where its heights are; the end of its patch counts as variation."""
    shape = SHAPES[name]
    used = {*shape.uses, *(kinds(shape.keys) if shape.keys else ()), "y"}
    try:
        f = Feature(**{**shape.example, **{key: value for key, value in changes.items() if key in used}})
    except SceneError:  # waves without variation along y have length = 0
        return
    x, y = np.linspace(-f.reach, f.reach, 41)[:, None] / 2, np.linspace(-400e-6, 400e-6, 161)
    heights = f.height_at(x, y - f.centre_y)
    assert f.transverse == (np.ptp(heights, axis=1).max() == 0)
    assert not f.symmetric or np.allclose(heights, heights[:, ::-1], atol=1e-12 * np.abs(heights).max())


@pytest.mark.parametrize("name", SHAPES)
def test_features_go_to_other_processes(name):
    f = Feature(**SHAPES[name].example)
    assert pickle.loads(pickle.dumps(f)) == f and pickle.loads(pickle.dumps(f)).top == f.top


def test_keys_of_one_shape_are_refused_on_others():
    own = [key for keys in OWN for key in kinds(keys)]
    turns = {"transpose", "mirror_x", "mirror_y"}
    turns |= {"lay", "offset_x", "offset_y", "shortest_x", "shortest_y", "rim", "rim_width"}
    assert {"seed", "file", "unit", "scale", "pixel", "pixel_y", "level", "cutoff", "sha256", *turns} == set(own)
    for key in ("scale", "pixel", "seed"):
        with pytest.raises(SceneError, match=f"feature.{key} .*has no effect: shape 'cosine' .* belongs to {USED_BY[key][0]}"):
            scene("gear").replace(**{f"feature.{key}": 2 if key == "seed" else 1e-4})


def compared(path):
    """Strings that a source file compares with anything."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Compare):
            yield from (part.value for side in (node.left, *node.comparators) for part in ast.walk(side)
                        if isinstance(part, ast.Constant))


@pytest.mark.parametrize("folder", ["tehl_taichi", "cli", "profiles"])
def test_no_shape_is_named_in_a_comparison(folder):
    """What is asked of a feature is asked of its shape."""
    sources = [path for path in (ROOT / folder).rglob("*.py") if path.parent.name != "features"]
    assert len(sources) > 5 and [path for path in sources if set(SHAPES) & set(compared(path))] == []
