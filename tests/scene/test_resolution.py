"""Features that the grid does not see or that pass beside the domain are refused, coarse ones carry a warning."""

import dataclasses
import re

import pytest

from tehl_taichi.scene import BUILT_INS, SceneError, scene
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.scales import Scales

GEAR = scene("gear").replace(**{"thermal.on": False})
CELL = 4 * Scales.of(GEAR).a / 256  # along x; across it is the same


def on(nx, ny, *features, **changes):
    return dataclasses.replace(GEAR.replace(**{"grid.nx": nx, "grid.ny": ny, "time.steady_only": True, **changes}),
                               features=features, time=GEAR.time)


def told(scene):
    """Its warnings about the features on its grid."""
    return [one for one in scene.warnings() if one.code in ("cells", "room")]


def sentence(call):
    with pytest.raises(SceneError) as caught:
        call()
    return str(caught.value)


PATCH = dict(height=1e-7, extent_x=300e-6, taper=10e-6)
NARROW, WIDE = 3.9 * CELL, 4.1 * CELL
COARSE = {
    "bump": (dict(width=NARROW), "feature.width", "nx"), "ridge": (dict(shape="ridge", width=NARROW), "feature.width", "nx"),
    "furrow": (dict(shape="furrow", height=-1e-6, width=NARROW), "feature.width", "nx"),
    "long bump": (dict(width=NARROW, length=100 * CELL), "feature.width", "nx"),
    "short bump": (dict(width=100 * CELL, length=NARROW), "feature.length", "ny"),
    "waves": (dict(PATCH, shape="waviness", width=NARROW), "feature.width", "nx"),
    "waves across": (dict(PATCH, shape="waviness", width=100e-6, length=NARROW), "feature.length", "ny"),
    "short patch": (dict(PATCH, shape="waviness", width=100e-6, extent_x=NARROW), "feature.extent_x", "nx"),
    "narrow patch": (dict(PATCH, shape="waviness", width=100e-6, extent_y=NARROW), "feature.extent_y", "ny"),
    "roughness": (dict(PATCH, shape="rough", width=NARROW), "feature.width", "nx"),
    "rough strip": (dict(PATCH, shape="rough", width=60e-6, extent_y=NARROW), "feature.extent_y", "ny"),
}


@pytest.mark.parametrize("values, key, count", COARSE.values(), ids=COARSE)
def test_fewer_than_four_cells_are_refused(values, key, count):
    said = sentence(lambda: on(256, 64, Feature(**values)))
    assert f"{key} = " in said and f"is 3.9 cells of grid.{count} = " in said and "at least 4 cells" in said
    nx, ny = map(int, re.search(r"grid\.nx=(\d+)(?: and grid\.ny=(\d+))?", said).groups(64))
    # the grid that the sentence names is taken
    assert on(nx, ny, Feature(**values)).features and (nx, ny) != (256, 64)
    wider = {name: WIDE if value == NARROW else value for name, value in values.items()}
    assert any(f"{key} = " in line and "16" in line for line in on(256, 64, Feature(**wider)).warnings())


@pytest.mark.parametrize("cells, shown", [(3.98, "3.9"), (3.996, "3.9"), (0.996, "0.99"), (0.3, "0.3")])
def test_a_refused_number_of_cells_is_not_shown_as_an_allowed_one(cells, shown):
    assert f" is {shown} cells of grid.nx = 256" in sentence(lambda: on(256, 64, Feature(width=cells * CELL)))


def test_roughness_is_seen_along_both_axes():
    f = Feature(**{**PATCH, "shape": "rough", "width": 10 * CELL})
    assert "grid.ny = 24" in sentence(lambda: on(256, 24, f)) and "grid.nx = 96" in sentence(lambda: on(96, 64, f))


def test_the_worst_of_several_features_is_named():
    said = sentence(lambda: on(256, 64, Feature(), Feature(width=2e-6, x=-1e-4)))
    assert "feature.1.width = 2e-06 m" in said


def test_too_narrow_for_any_grid():
    said = sentence(lambda: on(256, 64, Feature(width=1e-6), **{"grid.x_min": -20.0, "zoom.factor": 2}))
    assert "no grid is fine enough" in said and "feature.width of 6.1e-05 m is enough" in said
    said = sentence(lambda: on(256, 64, Feature(width=1e-6), **{"grid.x_min": -20.0}))
    assert said.endswith("zoom.factor=8 with grid.nx=3904 and grid.ny=192")


def test_lines_and_steady_scenes_need_no_rows():
    ridge = Feature(shape="ridge", width=WIDE, height=1e-7)
    assert on(256, 8, ridge).one_dimensional
    assert GEAR.replace(**{"time.steady_only": True, "width": 2e-6})


def test_enough_cells_carry_no_warning():
    assert told(GEAR) == []
    assert told(on(112, 28, Feature(width=200e-6)))  # 15.5 cells
    assert not told(on(128, 32, Feature(width=200e-6)))  # 17.7
    said, = told(on(64, 16, Feature(width=200e-6)))
    assert "8.8 cells" in said and said.endswith("; grid.nx=128 and grid.ny=32")


def test_which_built_in_scenes_are_coarse():
    coarse = {name for name in BUILT_INS if any("cells of grid" in line for line in scene(name).warnings())}
    assert coarse == {"rough", "rough-pair"}  # 7.1 and 10.6 cells per shortest wave; 592 x 148 would be enough for rough


@pytest.mark.parametrize("feature, words", [
    (dict(y=2e-3), ("feature.y = 0.002 m", "0.0001 m to each side", "-0.000457 to 0.000457 m", "grid.y_max (= 1 b")),
    (dict(y=-4.6e-4), ("feature.y = -0.00046 m",)),
    (dict(PATCH, shape="rough", width=60e-6, extent_y=200e-6, y=-1e-3), ("feature.y = -0.001 m",)),
])
def test_features_beside_the_domain(feature, words):
    said = sentence(lambda: on(256, 64, Feature(**feature)))
    assert all(word in said for word in ("no part", *words)), said


def test_features_at_its_edge_are_cut():
    assert on(256, 64, Feature(y=4.5e-4)).rows == 128
    said, = told(on(256, 64, Feature(y=3e-4)))
    assert said.endswith("heights beyond are cut off; use grid.y_max=1.2, grid.nx=256 and grid.ny=80")
    assert told(on(256, 64, Feature(y=3e-4), **{"grid.y_max": 1.2, "grid.ny": 76})) == []
    assert on(256, 64, Feature(shape="ridge", y=1e-3, height=1e-7)).one_dimensional  # transverse: the same for every y


def test_a_patch_that_is_too_wide_may_be_made_smaller():
    patch = Feature(**dict(PATCH, shape="rough", width=60e-6, extent_y=1.2e-3, y=1e-5))
    said, = (text for text in on(256, 64, patch).warnings() if "cut off" in text)
    extent = float(said.split("feature.extent_y = ")[1].split()[0])
    assert "makes the patch smaller); use grid.y_max=" in said
    smaller = Feature(**dict(PATCH, shape="rough", width=60e-6, extent_y=extent, y=1e-5))
    assert not any("cut off" in text for text in on(256, 64, smaller).warnings())
    assert extent > 0.98 * 2 * (362e-6 - 1e-5)  # b less the way to the side


def test_a_path_that_ends_before_the_domain():
    said = sentence(lambda: GEAR.replace(**{"time.x_start": -8.0, "time.x_end": -3.5}))
    assert "no part" in said and "x_end = -3.5 a" in said and "grid.x_min = -2.5 a" in said
    assert GEAR.replace(**{"time.x_start": -8.0, "time.x_end": -2.5}).transient


def test_features_beside_the_contact_of_a_ball():
    bumps = scene("ridge-on-ball").replace(**{"feature.shape": "cosine", "grid.ny": 64, "grid.nx": 128})
    far = bumps.replace(**{"feature.y": 1.5 * Scales.of(bumps).b})
    assert any("beside the contact" in line for line in far.warnings())
    half = bumps.replace(**{"feature.y": 1.1 * Scales.of(bumps).b})  # reaches 0.7 of its width into it
    assert not any("beside the contact" in line for s in (bumps, half) for line in s.warnings())


def test_thousands_of_features_are_refused_at_once():
    said = sentence(lambda: dataclasses.replace(GEAR, features=(Feature(),) * 3000))
    assert "3000 features" in said and "256" in said and "map" in said
    assert len(dataclasses.replace(GEAR, features=(Feature(height=1e-9),) * 256).features) == 256
