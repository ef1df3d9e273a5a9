"""Properties of all shapes: rescaled, raised, turned, mirrored; their volumes, and how far they reach."""

import math

import numpy as np
import pytest

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import scene
from tehl_taichi.scene.feature import Feature

UM = 1e-6
PATCH = {"extent_x": 300 * UM, "extent_y": 220 * UM, "taper": 40 * UM}
HILLS = np.outer(np.sin(np.arange(31) / 4), np.cos(np.arange(41) / 6) + 0.3 * np.sin(np.arange(41)))
MEASURED = {"heights": HILLS, "pixel": 5 * UM, "pixel_y": 7 * UM, "unit": "um", "level": "none", "taper": 30 * UM}
LINE = {**MEASURED, "heights": HILLS[5], "pixel_y": 0.0}
SHAPES = {
    "round": {"height": 1 * UM, "width": 200 * UM}, "elliptic": {"height": -1 * UM, "width": 200 * UM, "length": 320 * UM},
    "endless": {"height": 1 * UM, "width": 200 * UM, "length": math.inf},
    "dent": {"shape": "dent", "height": -2 * UM, "width": 200 * UM, "rim": 0.3 * UM},
    "dent with a wide rim": {"shape": "dent", "height": -2 * UM, "width": 200 * UM, "rim": 0.3 * UM, "rim_width": 90 * UM},
    "ridge": {"shape": "ridge", "height": 1 * UM, "width": 150 * UM},
    "furrow": {"shape": "furrow", "height": -1 * UM, "width": 150 * UM},
    "waviness": {"shape": "waviness", "height": 0.2 * UM, "width": 60 * UM, "extent_x": 300 * UM, "taper": 40 * UM},
    "waviness both ways": {"shape": "waviness", "height": 0.2 * UM, "width": 60 * UM, "length": 90 * UM, **PATCH},
    "rough": {"shape": "rough", "height": 0.2 * UM, "width": 40 * UM, "seed": 4, **PATCH},
    "ground": {"shape": "ground", "height": 0.2 * UM, "width": 40 * UM, "length": 90 * UM, "seed": 4, **PATCH},
    "ground, endless": {"shape": "ground", "height": 0.2 * UM, "width": 40 * UM, "length": math.inf, "extent_x": 300 * UM},
    "map": MEASURED, "part of a map": {**MEASURED, "extent_x": 120 * UM, "extent_y": 140 * UM},
    "profile": LINE, "profile along y": {**LINE, "lay": "longitudinal"}}
TIMES = 1.7
LENGTHS = "width", "length", "rim_width", "extent_x", "extent_y", "taper", "pixel", "pixel_y"


PAIRS = (("width", "length"), ("extent_x", "extent_y"), ("pixel", "pixel_y"))
SWAP = {one: other for pair in PAIRS for one, other in (pair, pair[::-1])}


def made(keys):
    return Feature.from_heights(**keys) if "heights" in keys else Feature(**keys)


def grown(keys):
    """Every length along the surface TIMES as large."""
    return {key: TIMES * value if key in LENGTHS else value for key, value in keys.items()}


def raised(keys):
    return {key: TIMES * value if key in ("height", "rim", "heights") else value for key, value in keys.items()}


def ends(f):
    return f.reach, f.reach_y or 2 * f.reach


def sampled(f, times=1.0, n=(161, 121)):
    """Heights (along x, along y) on 1.3 times the reach of the feature."""
    x, y = (1.3 * end * np.linspace(-1, 1, m) for end, m in zip(ends(f), n))
    return f.height_at(times * x[:, None], times * y)


@pytest.fixture(params=SHAPES)
def keys(request):
    return SHAPES[request.param]


def test_lengths_scale_with_the_feature(keys):
    f, large = made(keys), made(grown(keys))
    assert sampled(large) == pytest.approx(sampled(f), rel=1e-9, abs=1e-16)
    assert (large.reach, large.reach_y, large.top) == pytest.approx((TIMES * f.reach, TIMES * f.reach_y, f.top))
    for one, other in zip(f.kind.sizes(f), large.kind.sizes(large)):
        assert other == pytest.approx({key: TIMES * size for key, size in one.items()})
    if f.kind.rough:
        assert large.kind.finest(large) == pytest.approx(tuple(TIMES * d for d in f.kind.finest(f)))


def test_heights_scale_with_the_height(keys):
    f, high = made(keys), made(raised(keys))
    assert sampled(high) == pytest.approx(TIMES * sampled(f)) and high.top == pytest.approx(TIMES * f.top)
    assert (high.reach, high.reach_y) == (f.reach, f.reach_y)


def test_a_feature_reaches_as_far_as_it_says(keys):
    """Heights in the last quarter before its ends, none beyond them."""
    f = made(keys)
    z = np.abs(sampled(f)) / np.abs(sampled(f)).max()
    for axis in (0,) if f.transverse else (0, 1):
        across, at = z.max(axis=1 - axis), 1.3 * np.abs(np.linspace(-1, 1, z.shape[axis]))
        assert across[at > 1 + 1e-9].max() < 1.1e-5 and across[(at > 0.75) & (at < 1)].max() > 2e-5
    assert f.reach_y > 0 or f.transverse


def inverted(keys):
    """A dent and a furrow stay as they are."""
    if "heights" in keys:
        return {**keys, "scale": -1.0}
    return {**keys, "height": -keys["height"]} if keys.get("shape") not in ("dent", "furrow") else keys


def test_the_top_is_the_largest_height(keys):
    """A furrow has low rims, a dent nothing above the surface; that of random heights is an estimate."""
    for f in (made(keys), made(inverted(keys))):
        highest = sampled(f, n=(2601, 521)).max()
        assert 0.35 * f.top < highest < f.top if hasattr(f.kind, "waves") else highest == pytest.approx(f.top, rel=0.03)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("shape", ["waviness", "rough", "ground"])
def test_waves_too_high_for_the_gap_at_the_end_of_the_domain_are_refused_upright_and_inverted(shape, sign):
    keys = {"feature.shape": shape, "feature.extent_x": 3e-4, "feature.width": 1e-4, "grid.x_max": 1.5}
    with pytest.raises(SceneError, match="smaller than the height of a feature"):
        scene("gear").replace(**keys, **{"feature.height": sign * 20e-6})
    assert scene("gear").replace(**keys, **{"feature.height": sign * 1e-6}).features[0].top > 0


@pytest.mark.parametrize("shape", ["elliptic", "waviness both ways", "map", "part of a map"])
def test_a_turned_feature_has_x_and_y_changed(shape):
    """Its heights, its ends, the sizes and distances that a grid must resolve."""
    keys = SHAPES[shape]
    f, t = made(keys), made({SWAP.get(key, key): value.T if key == "heights" else value for key, value in keys.items()})
    x, y = np.linspace(-1.1, 1.1, 41)[:, None] * f.reach, np.linspace(-1.1, 1.1, 51) * f.reach_y
    assert t.height_at(y, x) == pytest.approx(f.height_at(x, y), abs=1e-16)
    assert (t.reach, t.reach_y) == pytest.approx((f.reach_y, f.reach))
    along, across = f.kind.sizes(f)
    assert t.kind.sizes(t) == tuple({SWAP[key]: size for key, size in one.items()} for one in (across, along))
    if f.kind.rough:
        assert t.kind.finest(t) == pytest.approx(f.kind.finest(f)[::-1])


@pytest.mark.parametrize("shape", ["rough", "ground", "ground, endless", "map", "profile"])
def test_a_mirrored_feature_is_its_reflection(shape):
    f, m = made(SHAPES[shape]), made({**SHAPES[shape], "mirror_x": True})
    assert sampled(m) == pytest.approx(sampled(f)[::-1], abs=1e-16) and np.ptp(sampled(f) - sampled(m)) > 0.01 * UM


def cone_of_a_cosine(R):
    """Volume of (1 + cos(pi r/R))/2 for r < R."""
    return math.pi * R**2 * (0.5 - 2 / math.pi**2)


def ring(edge, wide):
    """Volume of (1 - cos(2 pi (r - edge)/wide))/2 for edge < r < edge + wide."""
    return math.pi * wide * (edge + wide / 2)


@pytest.mark.parametrize("shape, volume", [
    ("round", cone_of_a_cosine(100)), ("elliptic", -1.6 * cone_of_a_cosine(100)),
    ("dent", -2 * cone_of_a_cosine(100) + 0.3 * ring(100, 50)),
    ("dent with a wide rim", -2 * cone_of_a_cosine(100) + 0.3 * ring(100, 90))])
def test_volumes(shape, volume):
    """By the integral in polar coordinates, um^3."""
    f = made(SHAPES[shape])
    x, y = (end * (np.arange(400) - 199.5) / 200 for end in (f.reach, f.reach_y))
    cell = (x[1] - x[0]) * (y[1] - y[0])
    assert f.height_at(x[:, None], y).sum() * cell / UM**3 == pytest.approx(volume, rel=1e-4)


def test_the_area_of_a_ridge():
    """The integral of 10^(-10 xi^2) cos(2 pi xi) is sqrt(pi/b) exp(-pi^2/b), b = 10 ln 10."""
    b = 10 * math.log(10)
    for shape, sign in (("ridge", 1), ("furrow", -1)):
        x = 150 * np.linspace(-1.5, 1.5, 3001)
        area = made(SHAPES[shape]).height_at(x * UM, 0.0).sum() * (x[1] - x[0]) / UM
        assert area == pytest.approx(sign * 150 * math.sqrt(math.pi / b) * math.exp(-math.pi**2 / b), rel=1e-6)


@pytest.mark.parametrize("extent, taper", [(200e-6, 50e-6), (200e-6, 90e-6), (600e-6, 50e-6)])
@pytest.mark.parametrize("length", [0.0, 300e-6])
def test_the_top_of_troughs_is_a_crest_within_their_patch(extent, taper, length):
    """Of waves of 200 and 400 um the first crest is outside, in the taper or whole."""
    x, y = np.linspace(-4e-4, 4e-4, 1601)[:, None], np.linspace(-4e-4, 4e-4, 401)
    for width in (200e-6, 400e-6):
        f = Feature(shape="waviness", height=-2e-6, width=width, length=length, extent_x=extent, taper=taper)
        assert f.top == pytest.approx(max(0.0, f.height_at(x, y).max()), abs=2e-9)
