"""Shapes of surface features at points where their heights follow by hand, and where a passage puts them."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from tehl_taichi.laws.gap import undeformed
from tehl_taichi.scene import Scene, SceneError, scene
from tehl_taichi.scene.feature import SHAPES, Feature

UM = 1e-6


def height(feature, x, y):
    """um, at x, y in um."""
    return float(feature.height_at(np.array([x * UM]), np.array([y * UM]))[0]) / UM


def test_round_cosine():
    """(1.5/2)(1 + cos(2 pi r/200)): all of it in the middle, half at r = 50, a quarter at r = 200/3, none from r = 100 on."""
    bump = Feature(height=1.5 * UM, width=200 * UM)
    for x, y, share in ((0, 0, 1), (50, 0, 0.5), (0, -50, 0.5), (30, 40, 0.5), (-200 / 3, 0, 0.25), (80, 60, 0), (90, 90, 0)):
        assert height(bump, x, y) == pytest.approx(1.5 * share, abs=1e-12)


def test_elliptic_cosine():
    """Twice as long across as it is wide: y = 80 counts as 40."""
    bump = Feature(height=-2 * UM, width=200 * UM, length=400 * UM)
    for x, y, share in ((0, 0, 1), (50, 0, 0.5), (0, 100, 0.5), (30, 80, 0.5), (0, 150, 0.5 - math.sqrt(0.125)), (0, 200, 0),
                        (100, 0, 0), (60, 160, 0)):
        assert height(bump, x, y) == pytest.approx(-2 * share, abs=1e-12)
    assert bump.reach == pytest.approx(100 * UM) and bump.reach_y == pytest.approx(200 * UM)


def test_a_cosine_without_end_is_transverse():
    """Half of it at a quarter of its width for every y: the scene is 1-D."""
    bump = Feature(height=-2 * UM, width=200 * UM, length=math.inf)
    for y in (0, 80, 1e6):
        assert height(bump, 50, y) == pytest.approx(-1.0, abs=1e-12) and height(bump, 100, y) == 0
    assert bump.transverse and bump.symmetric and bump.reach_y == 0
    assert scene("gear").replace(**{"feature.length": math.inf}).one_dimensional


def test_ridge_and_furrow():
    """10^(-10 xi^2) cos(2 pi xi): xi = 0.1: 10^-0.1 cos 36 deg = 0.642626; 0.25: 0; 0.5: -10^-2.5; the same for every y."""
    for shape, size in (("ridge", 0.2), ("furrow", -2.0)):
        line = Feature(shape=shape, height=size * UM, width=500 * UM)
        for x, share in ((0, 1), (50, 0.642626), (-50, 0.642626), (125, 0), (250, -(10**-2.5)), (350, 0)):
            assert height(line, x, 0) == pytest.approx(size * share, abs=2e-5 * abs(size))
            assert height(line, x, 777) == height(line, x, 0)


def test_waviness_along_and_across():
    """cos(2 pi x/60) cos(2 pi y/90): half of a wave turns the sign, a sixth leaves a half; both together multiply."""
    waves = Feature(shape="waviness", height=0.3 * UM, width=60 * UM, length=90 * UM, extent_x=600 * UM, extent_y=600 * UM)
    for x, y, share in ((0, 0, 1), (30, 0, -1), (0, 45, -1), (30, 45, 1), (10, 0, 0.5), (0, 15, 0.5), (10, 15, 0.25),
                        (0, 30, -0.5), (20, 0, -0.5), (0, 301, 0), (301, 0, 0)):
        assert height(waves, x, y) == pytest.approx(0.3 * share, abs=1e-12)
    assert (waves.reach, waves.reach_y) == pytest.approx((300 * UM, 300 * UM))
    transverse = Feature(shape="waviness", height=0.3 * UM, width=60 * UM, extent_x=600 * UM)
    assert height(transverse, 10, 1e4) == pytest.approx(0.15) and transverse.transverse and not waves.transverse


def test_patches_fade_out_over_their_taper():
    """Rim at 300 um, 100 um of half a cosine inside it: half at 250, (1 - cos 45 deg)/2 at 275, whole at 200."""
    waves = Feature(shape="waviness", height=1 * UM, width=1e4 * UM, extent_x=600 * UM, extent_y=400 * UM, taper=100 * UM)
    quarter = 0.5 * (1 - math.sqrt(0.5))
    for x, y, share in ((200, 0, 1), (250, 0, 0.5), (-275, 0, quarter), (300, 0, 0), (0, 100, 1), (0, -150, 0.5),
                        (0, 175, quarter), (250, 150, 0.25)):
        assert height(waves, x, y) == pytest.approx(share * math.cos(2 * math.pi * x / 1e4), abs=1e-9)


def test_rough_patches_have_their_rms_on_average():
    """Of 60 patches: the mean of their squares at places far from each other is the square of the rms; even in y."""
    x, y = np.meshgrid(np.linspace(-200, 200, 21) * UM, np.linspace(-200, 200, 21) * UM)
    squares = []
    for seed in range(60):
        patch = Feature(shape="rough", height=0.2 * UM, width=40 * UM, extent_x=500 * UM, extent_y=500 * UM, seed=seed)
        z = patch.height_at(x, y)
        squares.append(np.mean(z**2))
        assert np.allclose(z, z[::-1])
    assert math.sqrt(np.mean(squares)) == pytest.approx(0.2 * UM, rel=0.1)


GROUND = {"shape": "ground", "height": 0.3 * UM, "width": 40 * UM, "length": 400 * UM, "extent_x": 600 * UM}


@pytest.mark.parametrize("lay", [{}, {"width": 400 * UM, "length": 40 * UM}, {"length": 0.0}, {"length": math.inf}])
def test_ground_patches_have_their_Ra_on_average(lay):
    """Of 60 patches, also on y = 0, about which they are even."""
    x, y, found = np.linspace(-250, 250, 101)[:, None] * UM, np.linspace(-300, 300, 61) * UM, []
    for seed in range(60):
        z = Feature(**{**GROUND, **lay, "seed": seed}).height_at(x, y)
        assert np.allclose(z, z[:, ::-1])
        found.append((np.mean(np.abs(z)), np.mean(np.abs(z[:, 30]))))
    assert np.mean(found, axis=0) == pytest.approx(0.3 * UM, rel=0.08)


@pytest.mark.parametrize("keys", [GROUND, {"shape": "rough", "height": 0.2 * UM, "width": 40 * UM, "extent_x": 500 * UM,
                                                "extent_y": 600 * UM}])
def test_the_top_of_random_heights_is_a_height_that_they_reach(keys):
    """Not their rms or Ra: of ten patches the highest points are 0.6 to 1.3 times as high, on average."""
    x, y = np.linspace(-250, 250, 101)[:, None] * UM, np.linspace(-300, 300, 101) * UM
    features = [Feature(**{**keys, "seed": seed}) for seed in range(10)]
    highest = np.mean([f.height_at(x, y).max() for f in features])
    assert 0.6 < highest / features[0].top < 1.3


def test_ground_without_a_length_is_as_long_as_wide():
    """Its heights are those of an equal length, without a kink in the middle."""
    x, y = np.linspace(-250, 250, 101)[:, None] * UM, np.linspace(-40, 40, 161) * UM
    one, other = (Feature(**{**GROUND, "length": length}).height_at(x, y) for length in (0.0, GROUND["width"]))
    np.testing.assert_array_equal(one, other)
    bent = np.abs(np.diff(one, n=2, axis=1)).max(axis=0)
    assert bent[79] < 1.5 * np.delete(bent, 79).max()


def test_marks_lie_along_the_longer_of_width_and_length():
    x, y = np.linspace(-250, 250, 251)[:, None] * UM, np.linspace(50, 550, 251) * UM
    across, along = (Feature(**{**GROUND, **lay}).height_at(x, y) for lay in ({}, {"width": 400 * UM, "length": 40 * UM}))
    for z, quick, slow in ((across, 0, 1), (along, 1, 0)):
        assert np.abs(np.diff(z, axis=quick)).mean() > 5 * np.abs(np.diff(z, axis=slow)).mean()
    assert Feature(**{**GROUND, "length": math.inf}).transverse and not Feature(**GROUND).transverse


BANDS = [(GROUND, 40, 160), ({**GROUND, "width": 400 * UM, "length": 40 * UM}, 400, 1600),
         ({"shape": "rough", "height": 0.3 * UM, "width": 40 * UM, "extent_x": 600 * UM, "extent_y": 600 * UM}, 40, 600)]


@pytest.mark.parametrize("keys, finest, longest", BANDS)
def test_a_band_keeps_its_waves_as_they_are(keys, finest, longest):
    """With the shortest wave as its limit nothing is lost; what limits leave and what they take share the mean square."""
    x, y = np.random.default_rng(5).uniform(-0.02, 0.02, (2, 20000))
    wave = {**keys, "extent_x": 0.03, "extent_y": 0.0} if keys["shape"] == "ground" else keys

    def waves(least):
        f = Feature(**{**wave, "shortest_x": least * UM})
        return f.kind.waves(f, x, y)

    whole, part = waves(0), waves(1.7 * finest)
    assert np.array_equal(whole, waves(finest)) and not np.array_equal(whole, part)
    assert np.mean(part**2) + np.mean((whole - part) ** 2) == pytest.approx(np.mean(whole**2), rel=0.05)
    alone = Feature(**{**wave, "shortest_x": longest * UM})  # a single wave is left
    at = np.linspace(-50, 50, 9) * UM
    assert alone.kind.waves(alone, at + longest / 2 * UM, 0.0) == pytest.approx(-alone.kind.waves(alone, at, 0.0), abs=1e-15)
    assert alone.kind.sizes(alone)[0]["width"] == pytest.approx(longest * UM)
    with pytest.raises(SceneError, match=f"shortest_x = .* leaves no wave along x; allowed: at most {longest * UM:g} m"):
        Feature(**{**keys, "shortest_x": 1.1 * longest * UM})


def test_a_limit_across_takes_waves_across():
    """Along y the longest of four waves of 100 um is 400 um; the others are left out."""
    f = Feature(**{**GROUND, "length": 100 * UM, "extent_y": 2e-3, "shortest_y": 400 * UM})
    y = np.linspace(100, 180, 9) * UM
    ahead, behind = (f.kind.waves(f, 30 * UM, np.hypot(at, 0)) for at in (y, y + 400 * UM))
    assert behind == pytest.approx(ahead, abs=0.02 * UM) and np.ptp(ahead) > 0.05 * UM
    assert f.kind.sizes(f)[1]["length"] == pytest.approx(400 * UM)


def test_the_undeformed_gap():
    """x^2/2 R_x + y^2/2 R_y in units of a^2/R_x: X^2/2 + (R_x/R_y) Y^2/2."""
    assert undeformed(np.array([3.0]), np.array([2.0]), 0.0)[0] == 4.5
    assert undeformed(np.array([3.0]), np.array([2.0]), 0.25)[0] == pytest.approx(5.0)


@pytest.fixture(scope="module")
def two_ridges(taichi_cpu):
    """Three steps of two ridges, the second 150 um ahead and twice as high; pure rolling, nothing across."""
    from tehl_taichi.march.passage import march

    base = scene("gear").replace(**{"thermal.on": False, "rheology.law": "newtonian", "srr": -0.4, "grid.nx": 128,
                                    "grid.x_min": -3.5, "time.steps": 3, "time.x_start": -2.6})
    data = base.to_dict()
    data["feature"] = [{"shape": "ridge", "height": 0.2 * UM, "width": 120 * UM},
                       {"shape": "ridge", "height": 0.4 * UM, "width": 80 * UM, "x": 150 * UM}]
    description = Scene.from_dict(data)
    return description, list(march(description))


def test_features_move_with_surface_a(two_ridges):
    """u_a = 8.5 (1 - 0.4/2) = 6.8 m/s, a cell of 5 a/128 per step."""
    from tehl_taichi.scene.scales import Scales

    description, shots = two_ridges
    a = Scales.of(description).a
    assert shots[0].feature_x == pytest.approx(-2.6 * a)
    for before, after in zip(shots, shots[1:]):
        assert after.feature_x - before.feature_x == pytest.approx(5 * a / 128, rel=1e-9)
        assert after.feature_x - before.feature_x == pytest.approx(6.8 * (after.time - before.time), rel=1e-9)


def test_the_film_is_thinner_by_the_height_of_the_features(two_ridges):
    """Far in the inlet, where nothing presses yet, the film loses the height where the ridges stand, and nothing elsewhere."""
    description, shots = two_ridges
    for shot in shots[1:]:
        inlet = shot.x < -1.7 * abs(shots[0].feature_x) / 2.6
        x = (shot.x[inlet] - shot.feature_x) / UM
        lost = (shots[0].fields["film"] - shot.fields["film"])[inlet, 0] / UM
        own = [0.2 * 10 ** (-10 * (x / 120) ** 2) * np.cos(2 * np.pi * x / 120),
               0.4 * 10 ** (-10 * ((x - 150) / 80) ** 2) * np.cos(2 * np.pi * (x - 150) / 80)]
        np.testing.assert_allclose(lost, sum(own), atol=0.004)
        assert lost.max() > 0.3


def test_a_dent_has_a_raised_rim_with_continuous_slopes():
    """Depth 10 um, width 300 um, rim 1.2 um over 75 um: half of the depth at r = 75, none at 150, the rim's top at 187.5."""
    dent = Feature(shape="dent", height=-10 * UM, width=300 * UM, rim=1.2 * UM)
    for x, y, z in ((0, 0, -10), (75, 0, -5), (0, -75, -5), (90, 120, 0), (187.5, 0, 1.2), (112.5, 150, 1.2), (0, 168.75, 0.6),
                    (225, 0, 0), (300, 300, 0)):
        assert height(dent, x, y) == pytest.approx(z, abs=1e-9)
    r = np.linspace(0, 260, 5201)
    slope = np.gradient(dent.height_at(r * UM, 0 * r) / UM, r)
    assert np.abs(np.diff(slope)).max() < 2.2e-4  # no kink: 0.05 um times the curvature of the rim, 1.2/2 (2 pi/75)^2
    assert (dent.top, dent.reach, dent.reach_y) == pytest.approx((1.2 * UM, 225 * UM, 225 * UM)) and dent.symmetric


@pytest.mark.parametrize("keys, said", [({"height": 1 * UM, "rim": 1 * UM}, "a dent has a negative height; allowed: less"),
                                        ({"height": -1 * UM}, "needs the height of its rim, more than 0 m")])
def test_a_dent_without_depth_or_rim_is_refused(keys, said):
    with pytest.raises(SceneError, match=said):
        Feature(shape="dent", **keys)


def test_rough_waves_have_a_crest_on_the_axis():
    """Their mean square there is twice that of all points, as the meaning of the height says; that of ground is not."""
    x, y = np.random.default_rng(2).uniform(-0.5, 0.5, (2, 1001))

    def ratio(shape):
        """Mean squares of endless waves on the axis over those of all points, of 60 surfaces together."""
        found = [[np.mean(SHAPES[shape].waves(SimpleNamespace(seed=seed, extent_x=500 * UM, width=40 * UM, length=40 * UM,
                                                              height=UM, shortest_x=0.0, shortest_y=0.0), x, at) ** 2)
                  for at in (0.0, y)] for seed in range(60)]
        return np.divide(*np.sum(found, axis=0))

    assert ratio("rough") == pytest.approx(2.0, rel=0.15) and ratio("ground") == pytest.approx(1.0, rel=0.15)
