"""The pressure that presses a measured map flat, and the cutoff that is named where steel does not bear it."""

import numpy as np
import pytest
from map_feature import feature

import tehl_taichi as tehl
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.scene_warnings import doubtful_features
from tehl_taichi.scene.surface.maps import cutoff_choice, flattening_pressure
from tehl_taichi.scene.yield_stress import YIELDS

STEPS = 2e-6, 2.5e-6
E = 2 / (2 * 0.91 / 210e9)  # E' of steel on steel, Pa


def waves(length, height=0.2e-6, axis=0):
    """Waves of that length and height (m) along x (axis 0) or y (1), on a tilted plane."""
    y, x = np.mgrid[:241, :301] * np.array([STEPS[1], STEPS[0]])[:, None, None]
    return height * np.cos(2 * np.pi * (x, y)[axis] / length) + 0.01 * x - 0.02 * y


@pytest.mark.parametrize("axis", [0, 1])
def test_a_wave_is_pressed_flat_by_johnson_s_pressure(axis):
    """Johnson, section 13.2: pi E* height/length, with the contact modulus E* = E'/2 (115 GPa)."""
    found = flattening_pressure.flattening(waves(40e-6, axis=axis), STEPS, E)
    assert found.max() == pytest.approx(np.pi * 115.4e9 * 0.2e-6 / 40e-6, rel=0.03)
    assert found.min() == pytest.approx(-found.max(), rel=0.03)
    assert flattening_pressure.highest(waves(20e-6, axis=axis), STEPS, E) == pytest.approx(2 * found.max(), rel=0.05)


def test_the_contact_presses_as_much_again_and_a_plane_takes_nothing():
    f = feature(**saved(waves(1.0, 0.0)))
    gear = scene("gear")
    assert cutoff_choice.contact_pressure(f.used, f, gear) == pytest.approx(Scales.of(gear).p_H, rel=1e-6)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def saved(heights):
    """Keys of a map of these heights (m)."""
    np.save("waves.npy", heights)
    return {"shape": "map", "file": "waves.npy", "unit": "m", "pixel": STEPS[0], "pixel_y": STEPS[1], "taper": 40e-6}


def passing(heights, **changes):
    gear = tehl.Scene.from_dict({**scene("gear").to_dict(), "feature": [saved(heights)]})
    return gear.replace(**{"grid.nx": 512, "grid.ny": 128, **changes})


def rough(described):
    """What is said of its roughness."""
    return [said for said in doubtful_features(described) if "spikes of the measurement" in said]


def test_heights_that_steel_does_not_bear_are_told_the_cutoff_that_it_does():
    """Slopes of 7 deg, where nothing but the pressure is doubtful; a tenth less of a cutoff would not do."""
    said, = rough(scan := passing(waves(40e-6, 0.5e-6)))
    assert "need about 6.4 GPa to be flattened in this contact; hardened steel yields above about 4 GPa" in said
    assert "deg" not in said
    cutoff = float(said.split("feature.cutoff = ")[1].split()[0])
    assert f"(m; {cutoff * 1e6:g} um, " in said
    helped, less = (scan.replace(**{"feature.cutoff": value}) for value in (cutoff, 0.9 * cutoff))
    assert rough(helped) == []
    (f,), (almost,) = helped.features, less.features
    assert cutoff_choice.contact_pressure(f.used, f, scan) <= YIELDS < cutoff_choice.contact_pressure(almost.used, almost, scan)


def test_slopes_and_pressure_share_a_sentence():
    said, = rough(passing(waves(40e-6, 1.5e-6)))
    assert "slopes up to 13" in said and ", and need about 1" in said and said.count("feature.cutoff = ") == 1


def test_what_steel_bears_is_not_doubted():
    """Lower waves, longer ones; and a contact that it does not bear anyway, which no cutoff makes better."""
    assert rough(passing(waves(40e-6, 0.2e-6))) == rough(passing(waves(120e-6, 0.5e-6))) == []
    assert rough(passing(waves(40e-6, 0.5e-6), hertz_pressure=4.1e9)) == []
