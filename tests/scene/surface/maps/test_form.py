"""Measured maps with rows farther apart than their points, and with the form of their body."""

import numpy as np
import pytest
from map_feature import feature

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.scene import grid_for_error, scene
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.surface.maps import height_map


def test_rows_may_lie_farther_apart_than_the_points_of_a_row(tmp_path):
    y, x = np.mgrid[:31, :41] * np.array([3e-6, 2e-6])[:, None, None]
    np.save(tmp_path / "ramp.npy", 0.03 * x + 0.04 * y)
    ramp = feature(tmp_path / "ramp.npy", unit="m", pixel=2e-6, pixel_y=3e-6, level="none", taper=0.0)
    assert ramp.size == pytest.approx((80e-6, 90e-6)) and ramp.measures.slope == pytest.approx(np.degrees(np.arctan(0.05)))
    rise = ramp.height_at(np.array([11e-6]), np.array([-20e-6])) - ramp.height_at(np.zeros(1), np.zeros(1))
    assert rise == pytest.approx(0.03 * 11e-6 - 0.04 * 20e-6, rel=1e-9)
    part = feature(tmp_path / "ramp.npy", unit="m", pixel=2e-6, pixel_y=3e-6, level="none", extent_x=40e-6, extent_y=30e-6)
    assert part.used.shape == (11, 21)
    said = [*ramp.kind.preview(ramp, scene("gear"))]
    assert said[0].startswith("map ramp.npy: 41 x 31 points 2 x 3 um apart, 80 x 90 um of them used")
    with pytest.raises(SceneError, match="feature.pixel = 2e-06 m, feature.pixel_y = 1e-09 m right"):
        feature(tmp_path / "ramp.npy", unit="m", pixel=2e-6, pixel_y=1e-9, level="none")


def test_a_form_is_what_a_fit_of_second_order_takes_off():
    rng = np.random.default_rng(0)
    y, x = np.mgrid[:31, :40].astype(float)
    values = rng.normal(size=x.shape) + 3 + 0.2 * x - 0.1 * y + 0.02 * x * x - 0.01 * y * y + 0.03 * x * y
    terms = np.stack([np.ones_like(x), x, y, x * x, y * y, x * y], axis=-1).reshape(-1, 6)
    fit = terms @ np.linalg.lstsq(terms, values.ravel(), rcond=None)[0]
    np.testing.assert_allclose(height_map.levelled(values, "form"), values - fit.reshape(values.shape), atol=1e-11)


def flank(folder, bump=0.0):
    """A scan of a flank of 12 mm radius, 0.6 x 0.3 mm, rough by 0.1 um, with a bump (um)."""
    y, x = np.meshgrid((np.arange(61) - 30) * 5.0, (np.arange(121) - 60) * 5.0, indexing="ij")
    rough = 0.1 * np.random.default_rng(1).normal(size=x.shape)
    np.save(folder / "flank.npy", x * x / 24e3 + rough + bump * np.exp(-(x * x + y * y) / 40.0**2))
    return folder / "flank.npy"


def doubts(found):
    return [said for said in found.kind.doubts(found, scene("gear")) if "one curvature" in said]


def test_a_scan_with_the_form_of_its_body_is_doubted_and_rid_of_it(tmp_path):
    found = feature(flank(tmp_path), pixel=5e-6, pixel_y=5e-6)
    said, = doubts(found)
    assert "all but 0.09959 um of its rms of 1.141 um are one curvature" in said and "feature.level = 'form'" in said
    bumpy = feature(flank(tmp_path, 1.2), pixel=5e-6, level="form")
    assert doubts(bumpy) == [] and bumpy.measures.range < 2.5e-6 < found.measures.range
    assert float(bumpy.height_at(np.zeros(1), np.zeros(1))[0]) == pytest.approx(1.2e-6, abs=0.35e-6)


@pytest.mark.parametrize("extent_x, axis, radius", [(0.0, "x", 12.0), (80e-6, "y", 8.0)])
def test_the_form_is_named_along_the_axis_with_the_larger_sag(extent_x, axis, radius):
    """Of the part that is used: 400 or 80 um along x, bent to 12 mm, 160 um along y, bent to 8 mm."""
    y, x = np.mgrid[-16:17, -40:41] * 5e-6
    f = Feature.from_heights(-x**2 / 0.024 - y**2 / 0.016, 5e-6, extent_x=extent_x)
    assert f.form.says == f"convex with a radius of {radius:g} mm along {axis}"


def test_bumps_are_no_form(tmp_path):
    y, x = np.mgrid[-1:1:81j, -1:1:81j]
    for name, bump in (("round", np.cos(np.pi * np.minimum(np.hypot(x, y), 1))), ("ridge", np.cos(np.pi * x))):
        np.save(tmp_path / f"{name}.npy", 0.5 * bump)
        assert doubts(feature(tmp_path / f"{name}.npy")) == []


def test_a_scan_that_is_upside_down_is_asked_about(tmp_path):
    """Of a flank of 12 mm the rim is low; here it is high, as in `flank`."""
    hollow = flank(tmp_path)
    for level in ("plane", "form"):
        said, = (text for text in feature(hollow, pixel=5e-6, level=level).kind.doubts(
            feature(hollow, pixel=5e-6, level=level), scene("gear")) if "radius of" in text)
        assert "concave with a radius of 12 mm along x" in said and "feature.scale = -1" in said
        np.save(tmp_path / "hill.npy", -np.load(hollow))
        inverted = feature(tmp_path / "hill.npy", pixel=5e-6, level=level, scale=-0.5)  # although it is not upside down
        assert "set feature.scale = 0.5" in "".join(inverted.kind.doubts(inverted, scene("gear")))
        right = feature(hollow, pixel=5e-6, level=level, scale=-1.0)
        assert "upside" not in "".join(right.kind.doubts(right, scene("gear")))
    first, _ = right.kind.preview(right, scene("gear"))
    assert first.endswith("removed (convex with a radius of 12 mm along x; with contact.radius_x = 10.6 mm the other body "
                          "has a radius of 91.2 mm)")
    first, _ = right.kind.preview(right, scene("gear").replace(**{"contact.radius_x": 0.015}))
    assert first.endswith("with contact.radius_x = 15 mm the other body has a concave radius of 59.9 mm)")


def test_a_scan_that_lies_across_is_asked_about(tmp_path):
    """The bodies of a line contact are curved along x alone; those of an ellipse along y, too."""
    def asked(transpose, of="gear"):
        found = feature(flank(tmp_path), pixel=5e-6, level="form", scale=-1.0, transpose=transpose)
        return "".join(said for said in found.kind.doubts(found, scene(of)) if "lies across" in said)

    assert "a radius of 12 mm along y, across the rolling direction" in asked(True)
    assert asked(True).endswith("feature.transpose = false")
    assert asked(False) == asked(True, "ball-on-disc") == ""


def test_what_does_not_fit_into_the_gap_is_told_to_be_a_form(tmp_path):
    high = dict(shape="map", unit="um", file=str(flank(tmp_path)), pixel=5e-6, scale=5.0)
    with pytest.raises(SceneError, match="undeformed gap of .* all but .* one curvature.*'form' to remove it"):
        scene("gear").replace(feature=[high], **{"grid.x_max": 1.2})
    assert scene("gear").replace(feature=[{**high, "level": "form"}], **{"grid.x_max": 1.2}).features


def test_curvatures_are_those_of_a_paraboloid():
    y, x = np.mgrid[:31, :40] * np.array([3e-6, 2e-6])[:, None, None]
    along, across = height_map.curvature(1e-6 + 0.02 * x - 0.5 * x * x / 0.012 + 0.5 * y * y / 0.4, (2e-6, 3e-6))
    assert (along, across) == (pytest.approx(1 / 0.012), pytest.approx(-1 / 0.4))


def test_a_rim_that_is_the_form_s_asks_for_no_taper(tmp_path):
    """A step at the rim because of the curvature: fading it out would hide the cause."""
    formed, flat = (feature(flank(tmp_path), pixel=5e-6, taper=0.0, level=level) for level in ("plane", "form"))
    assert not any("taper" in said for said in formed.kind.doubts(formed, scene("gear")))
    assert any("taper" in said for said in flat.kind.doubts(flat, scene("gear")))


def test_a_target_error_sees_the_map(tmp_path):
    """Waves of 24 um along x, which 128 columns (11.3 um a cell) miss."""
    waves = 0.1 * np.sin(2 * np.pi * np.arange(101) * 2.0 / 24.0) * np.ones((41, 1))
    np.save(tmp_path / "waves.npy", waves)
    keys = {"shape": "map", "file": str(tmp_path / "waves.npy"), "unit": "um", "pixel": 2e-6, "taper": 20e-6}
    rough = tehl.Scene.from_dict({**scene("gear").to_dict(), "feature": [keys]})
    nx, ny = grid_for_error.grid_for(rough, 0.2)
    smooth = grid_for_error.grid_for(scene("gear"), 0.2)
    assert nx == 8 * smooth[0] and ny == 8 * smooth[1]
    assert not any("on this grid the" in said for said in rough.replace(**{"grid.nx": nx, "grid.ny": ny}).warnings())
