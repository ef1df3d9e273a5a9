"""Roughness in standard numbers against sums of waves, whose numbers are formulas."""

import dataclasses
import math

import numpy as np
import pytest
from map_feature import feature

from tehl_taichi.report import surface_plots
from tehl_taichi.runs.flank import flank_columns
from tehl_taichi.runs.summary import summary_numbers
from tehl_taichi.runs.summary.summary_rows import rows_of
from tehl_taichi.runs.sweep import summary_columns
from tehl_taichi.scene import scene, surface_roughness
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.film_formula import central_film
from tehl_taichi.scene.scene_warnings import preview
from tehl_taichi.scene.surface.roughness import Roughness

STEP, COUNT = 0.5e-6, 2000
X = np.arange(COUNT) * STEP
LONG, SHORT = 50e-6, 25e-6  # m, wavelengths; 20 and 40 of them
ENDS = 1 / (2 * np.pi * 20)  # relative error of an autocorrelation length: pairs of points are no whole number of waves


def wave(A, wavelength, phase=0.3):
    return A * np.cos(2 * np.pi * X / wavelength + phase)


def numbers(profile, turned=False):
    return Roughness.of(profile[:, None], (1.0, STEP)) if turned else Roughness.of(profile[None], (STEP, 1.0))


@pytest.mark.parametrize("turned", [False, True])
def test_a_sine(turned):
    A, found = 0.4e-6, numbers(wave(0.4e-6, LONG), turned)
    assert found.profile and (found.Sa, found.Sq, found.Sz) == pytest.approx((2 * A / np.pi, A / np.sqrt(2), 2 * A), rel=1e-3)
    assert abs(found.skewness) < 1e-9 and found.slope == pytest.approx(2 * np.pi * A / LONG / np.sqrt(2), rel=1e-3)
    assert found.lengths[turned] == pytest.approx(LONG * math.acos(0.2) / (2 * np.pi), rel=ENDS)
    assert found.lengths[not turned] is None
    assert found.to_dict().keys() == {"Ra_m", "Rq_m", "Rz_m", "skewness", "Rq_slope", f"length_{'xy'[turned]}_m"}


def test_a_sum_of_sines_is_skewed():
    """The mean of (A cos x + B cos 2x)^3 is 3/4 A^2 B."""
    A, B = 0.4e-6, 0.2e-6
    found = numbers(A * np.cos(2 * np.pi * X / LONG) + B * np.cos(4 * np.pi * X / LONG))
    Sq = np.sqrt((A**2 + B**2) / 2)
    assert found.Sq == pytest.approx(Sq, rel=1e-9) and found.skewness == pytest.approx(0.75 * A**2 * B / Sq**3, rel=1e-6)
    assert found.slope == pytest.approx(np.sqrt((A / LONG) ** 2 + (B / SHORT) ** 2) * 2 * np.pi / np.sqrt(2), rel=2e-3)


def test_the_mean_of_five_ranges():
    """One peak lies in one of the five sections."""
    profile = wave(0.4e-6, LONG)
    profile[777] = 3e-6
    assert numbers(profile).Sz == pytest.approx((4 * 0.8e-6 + 3.4e-6) / 5, rel=1e-3)


def test_an_area():
    """Waves along x and y: the squares of heights and slopes add; each axis has its own autocorrelation length."""
    A, B, y = 0.3e-6, 0.1e-6, np.arange(600) * 1e-6
    found = Roughness.of(A * np.cos(2 * np.pi * X / LONG) + B * np.cos(2 * np.pi * y / 60e-6)[:, None], (STEP, 1e-6))
    assert not found.profile and (found.Sq, found.Sz) == pytest.approx((np.sqrt((A**2 + B**2) / 2), 2 * (A + B)), rel=1e-3)
    assert found.slope == pytest.approx(2 * np.pi * np.sqrt(((A / LONG) ** 2 + (B / 60e-6) ** 2) / 2), rel=2e-3)
    at = math.acos((0.2 * (A**2 + B**2) - B**2) / A**2) * LONG / (2 * np.pi)  # (A^2 cos + B^2)/(A^2 + B^2) = 0.2
    assert found.lengths[0] == pytest.approx(at, rel=ENDS) and found.lengths[1] is None  # along y at least 0.8


def test_a_flat_surface_has_none():
    found = Roughness.of(np.zeros((9, 9)), (1e-6, 1e-6))
    assert found == Roughness(0.0, 0.0, 0.0, 0.0, 0.0, (None, None))


def test_random_heights_of_known_correlation():
    """Gaussian correlation exp(-(r/c)^2) is 0.2 at c sqrt(ln 5)."""
    c, rng, n = 12.0, np.random.default_rng(2), 512
    k = 2 * np.pi * np.fft.fftfreq(n)
    power = np.exp(-np.add.outer(k**2, k**2) * c**2 / 8)
    z = np.fft.ifft2(np.fft.fft2(rng.standard_normal((n, n))) * power).real
    assert Roughness.of(z, (1.0, 1.0)).lengths == pytest.approx((c * np.sqrt(np.log(5)),) * 2, rel=0.1)


def rough_gear(*features, **changes):
    return dataclasses.replace(scene("gear"), features=features).replace(**{"grid.nx": 512, **changes})


def test_before_and_after_the_filter(tmp_path):
    """Of two waves the filter passes the shares of its formula; the taper does not count."""
    np.save(tmp_path / "a.npy", 1e6 * (wave(0.3e-6, 100e-6) + wave(0.2e-6, SHORT)))
    f = feature(tmp_path / "a.npy", shape="profile", pixel=STEP, level="mean", cutoff=50e-6, taper=100e-6)
    found = surface_roughness.to_dict(rough_gear(f))["a"]
    assert found["before_filters"]["Rq_m"] == pytest.approx(np.sqrt(0.3**2 + 0.2**2) * 1e-6 / np.sqrt(2), rel=1e-3)
    shares = (math.exp(-math.log(2) * (50e-6 / length) ** 2) for length in (100e-6, SHORT))  # ISO 16610-61: half at the cutoff
    kept = np.hypot(*(height * share for height, share in zip((0.3e-6, 0.2e-6), shares)))
    assert found["Rq_m"] == pytest.approx(kept / np.sqrt(2), rel=0.02)
    plain = surface_roughness.to_dict(rough_gear(feature(tmp_path / "a.npy", shape="profile", pixel=STEP, level="mean")))["a"]
    assert plain == found["before_filters"]


WAVES = {"shape": "waviness", "height": 0.1e-6, "width": 60e-6, "extent_x": 500e-6, "taper": 60e-6}


def test_shapes_that_are_rough():
    found = surface_roughness.to_dict(rough_gear(Feature(**WAVES)))["a"]  # a transverse one is a line
    assert found["Rq_m"] == pytest.approx(0.1e-6 / np.sqrt(2), rel=0.05) and found["Rz_m"] == pytest.approx(0.2e-6, rel=0.02)
    both = surface_roughness.to_dict(rough_gear(Feature(**WAVES), Feature(**{**WAVES, "width": 37e-6})))["a"]
    assert both["Rq_m"] == pytest.approx(0.1e-6, rel=0.07)
    area = Feature(**{**WAVES, "length": 60e-6, "extent_y": 500e-6})
    assert surface_roughness.to_dict(rough_gear(area))["a"]["Sq_m"] == pytest.approx(0.05e-6, rel=0.08)
    apart = Feature(**WAVES), Feature(**{**WAVES, "x": -900e-6})
    assert surface_roughness.to_dict(rough_gear(*apart)) == {}  # no place has both
    assert surface_roughness.to_dict(scene("gear")) == {} == surface_roughness.to_dict(scene("smooth-line"))


def test_ground_flanks():
    """Ra = height on a long one; of two short ones, marks across, what passes."""
    long = Feature(shape="ground", height=0.3e-6, width=80e-6, length=math.inf, extent_x=20e-3)
    assert surface_roughness.to_dict(rough_gear(long))["a"]["Ra_m"] == pytest.approx(0.3e-6, rel=0.05)
    found = surface_roughness.to_dict(scene("rough-pair"))
    assert found.keys() == {"a", "b", "combined"} and all(0.2e-6 < found[name]["Sa_m"] < 0.4e-6 for name in "ab")
    assert found["a"]["length_y_m"] > 2 * found["a"]["length_x_m"]


@pytest.mark.parametrize("extent", [2e-3, 25e-3])
def test_the_slope_of_marks_does_not_depend_on_their_length(extent):
    """A short wave is sampled as finely on a long surface."""
    f = Feature(shape="ground", height=0.3e-6, width=40e-6, length=math.inf, extent_x=extent, taper=1e-4)
    x = np.linspace(-extent / 2 + 1e-4, extent / 2 - 1e-4, 400001)
    slope = np.sqrt(np.mean(np.gradient(f.height_at(x, 0.0), x) ** 2))
    assert surface_roughness.to_dict(rough_gear(f, **{"grid.nx": 1024}))["a"]["Rq_slope"] == pytest.approx(slope, rel=0.01)


def test_two_rough_surfaces():
    """Their sum, wherever they are, has the root of the squares of both."""
    z = [wave(0.3e-6, 50e-6) + wave(0.1e-6, 25e-6, 0.6), wave(0.2e-6, 1e-3 / 17)]
    sum_ = numbers(z[0] + z[1])
    Sq, slope, skewness = surface_roughness.combined({name: surface_roughness.SurfaceRoughness(numbers(one))
                                                      for name, one in zip("ab", z)})
    assert (Sq, slope, skewness) == pytest.approx((sum_.Sq, sum_.slope, sum_.skewness), rel=2e-3)
    described = rough_gear(Feature(**WAVES), Feature(**{**WAVES, "surface": "b", "height": 0.2e-6}))
    found = surface_roughness.to_dict(described)
    assert found["combined"]["Sq_m"] == pytest.approx(np.hypot(found["a"]["Rq_m"], found["b"]["Rq_m"]))
    lines = preview(described)
    assert lines[0].startswith("surface a: Ra 0.0") and lines[1].startswith("surface b: Ra 0.1")
    assert float(lines[-1].split(": ")[1]) == pytest.approx(central_film(described) / found["combined"]["Sq_m"], rel=0.06)


def test_rows_and_page():
    described = rough_gear(Feature(**WAVES), Feature(**{**WAVES, "surface": "b"}))
    steady = {"h_c_m": 0.4e-6, "h_min_m": 0.3e-6, "p_max_Pa": 1e9, "friction_coefficient": 0.03, "error": {}}
    found = surface_roughness.to_dict(described)
    summary = {"hertz": {"a_m": 3e-4, "p_Pa": 1e9}, "steady": steady, "wall_s": 1.0, "compile_s": 0.0, "roughness": found,
               "lambda": 4.0, "error": {"lambda": 0.1}}
    rows = {row.what: row for row in rows_of(summary)}
    assert rows["lambda = h_c/Sq"].value == "4.00 ± 0.10"
    assert rows["Ra / Rq / Rz of surface a"].number == found["a"]["Rq_m"] and rows["Sq of both surfaces"].value.endswith(" um")
    assert rows["autocorrelation length of surface b"].value.endswith("um along x")
    table, film = surface_plots.roughness(described, summary)
    assert table.data["head"] == ("roughness", "surface a", "surface b", "both together")
    number = summary_numbers.all_numbers(summary)["lambda"]
    assert (number.value, number.error, summary_columns.error_of("lambda")) == (4.0, 0.1, "error_lambda")
    column, = (one for one in flank_columns.COLUMNS if one.name == "lambda")
    assert column.shown(None, None, summary) == "4.00 ± 0.10" and column.shown(None, None, {}) == ""
    assert film.data["rows"] == [("λ = h_c/Sq", "4.00 ± 0.10")]
