"""What a taper leaves of a feature: refused where it is nothing whole, and the heights that pass are those that are judged."""

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.scene import scene_warnings
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.surface.maps import map_warnings

STEP = 2e-6


def saved(tmp_path, heights):
    np.save(tmp_path / "map.npy", heights)
    return {"shape": "map", "file": str(tmp_path / "map.npy"), "unit": "um", "pixel": STEP, "level": "none"}


def hills(rows=61, columns=101):
    return 0.2 * np.outer(np.cos(np.arange(rows) / 5), np.cos(np.arange(columns) / 7))


@pytest.mark.parametrize("extents, short", [({}, 120e-6), ({"extent_x": 80e-6}, 80e-6), ({"extent_y": 60e-6}, 60e-6)])
def test_a_map_keeps_some_height_whole(tmp_path, extents, short):
    keys = {**saved(tmp_path, hills()), **extents}
    f = Feature(**keys, taper=short / 2)
    assert f.kind.window(f, 0.0, 0.0) == pytest.approx(1.0)
    with pytest.raises(SceneError, match=rf"taper = {0.51 * short:g} m .* {short:.4g} m .* at most {short / 2:.4g} m"):
        Feature(**keys, taper=0.51 * short)


@pytest.mark.parametrize("shape", ["rough", "waviness"])
@pytest.mark.parametrize("extents, most", [((300e-6, 0.0), 150e-6), ((300e-6, 200e-6), 100e-6), ((200e-6, 400e-6), 100e-6)])
def test_so_do_the_other_patches(shape, extents, most):
    keys = {"shape": shape, "height": 1e-7, "width": 80e-6, "extent_x": extents[0], "extent_y": extents[1]}
    Feature(**keys, taper=most)
    with pytest.raises(SceneError, match="feature.taper"):
        Feature(**keys, taper=1.02 * most)


def passing(f):
    """Heights as the contact gets them, at the points of the map."""
    (nx, ny), (dx, dy) = f.points, f.steps
    x, y = (np.arange(nx) - (nx - 1) / 2) * dx, (np.arange(ny) - (ny - 1) / 2) * dy
    (left, right), (low, high) = f.ends
    return f.height_at(x[None], y[:, None])[low:high, left:right]


@pytest.mark.parametrize("changes", [{}, {"cutoff": 30e-6}, {"level": "form"}, {"scale": -0.5}, {"extent_x": 100e-6},
                                     {"mirror_x": True}, {"transpose": True}])
def test_preview_and_checks_judge_what_passes(tmp_path, changes):
    heights = hills()
    heights[:, :3] += 1.0  # a step at the rim, which the taper takes away
    f = Feature(**{**saved(tmp_path, heights), "taper": 30e-6, **changes})
    assert f.used == pytest.approx(passing(f), abs=1e-16)
    assert f.measures.high == pytest.approx(passing(f).max()) == f.top and f.measures.low == pytest.approx(passing(f).min())
    assert f.passing(f.cutoff) == pytest.approx(f.used)
    scene = tehl.scene("gear")
    lines = " ".join(map_warnings.lines(f, scene))
    assert f"{passing(f).max() * 1e6:.4g} um (range" in lines and "fading out over 30 um" in lines


def test_a_taper_that_takes_much_is_doubted(tmp_path):
    keys = saved(tmp_path, hills())
    for taper, doubted in ((10e-6, False), (60e-6, True)):
        said = scene_warnings.doubtful_features(_with(Feature(**keys, taper=taper)))
        assert any("of the rms of its patch, 200 x 120 um" in one for one in said) == doubted


def _with(feature):
    import dataclasses

    return dataclasses.replace(tehl.scene("gear"), features=(feature,))
