"""Scenes: defaults, checks at the door, files."""

import math

import pytest

from tehl_taichi.io import scene_file
from tehl_taichi.scene import BUILT_INS, SceneError, scene
from tehl_taichi.scene.scales import Scales


def test_gear_has_the_hertz_units_of_the_thesis():
    s = Scales.of(scene("gear"))
    assert s.a == pytest.approx(0.362e-3, rel=1e-3) and s.p_H == pytest.approx(1.934e9, rel=1e-3)


def test_srr_keeps_the_mean_speed():
    o = scene("gear").replace(srr=-0.2).operation
    assert (o.u_m, o.u_a, o.u_b) == pytest.approx((8.5, 7.65, 9.35)) and o.u_s < 0


def test_hertz_pressure_gives_back_its_load():
    s = scene("gear").replace(hertz_pressure=1.5e9)
    assert Scales.of(s).p_H == pytest.approx(1.5e9)
    assert scene("gear").replace(load=s.load).load == pytest.approx(s.load)


@pytest.mark.parametrize("M, L", [(20.0, 10.0), (200.0, 10.0)])
def test_moes_pair_comes_out(M, L):
    from tehl_taichi.scene.closed_form import moes_numbers

    s = moes(M, L)
    units = Scales.of(s)
    assert moes_numbers(s.load, units.R, units.E, 0.04, 2.2e-8, s.operation.u_m) == pytest.approx((M, L))


def moes(M, L):
    return scene("smooth-line").replace(**{"oil.name": "moes-test-fluid", "contact.load": 0.0, "contact.moes_M": M,
                                           "contact.moes_L": L})


@pytest.mark.parametrize("name", BUILT_INS)
def test_file_round_trip(name, tmp_path):
    path = tmp_path / "s.toml"
    path.write_text(scene_file.dumps(scene(name)))
    assert scene_file.load(path) == scene(name)


def test_file_with_a_base(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text('base = "gear"\n[operation]\nu_a = 8.0\nu_b = 9.0\n[contact]\nhertz_pressure = 1.2e9\n')
    s = scene_file.load(path)
    assert s.name == "mine" and s.operation.srr == pytest.approx(-1 / 8.5) and s.contact.load == 0
    assert s.features == scene("gear").features


@pytest.mark.parametrize("key, value, words", [
    ("load", -1.0, "at least 0 N/m"), ("load", math.nan, "not a number"), ("load", math.inf, "finite"),
    ("speed", 0.0, "no film"), ("srr", 3.0, "at most 2"), ("temperature", 1e4, "deg C"), ("height", 1.0, "at most"),
    ("grid.nx", 100, "multiple of 16"), ("grid.nx", 64.5, "whole number"), ("oil.viscosity", "roeland", "roelands"),
    ("feature.hight", 1e-6, "height"), ("bodies.a.E", -1.0, "Pa"), ("thermal.on", True, "isothermal"),
    ("feature.y", 1e-4, "y = 0"), ("srr", -2.0, "never passes"), ("load", 1e9, "Hertz pressure"),
    ("contact.radius_y", 0.01, "line"), ("time.courant", 0.0, "at least"), ("sr", 0.1, "srr"),
])
def test_bad_values_are_refused_with_a_sentence(key, value, words):
    with pytest.raises(SceneError, match=words):
        scene("gear").replace(**{key: value})


def test_zero_entrainment_is_refused(tmp_path):
    path = tmp_path / "zero.toml"
    path.write_text('base = "gear"\n[operation]\nu_a = 5.0\nu_b = -5.0\n')
    with pytest.raises(SceneError, match="no entrainment"):
        scene_file.load(path)


def test_unknown_keys_name_the_nearest(tmp_path):
    path = tmp_path / "typo.toml"
    path.write_text('base = "gear"\n[operation]\ntemprature = 80\n')
    with pytest.raises(SceneError, match="temperature"):
        scene_file.load(path)
    with pytest.raises(SceneError, match="smooth-line"):
        scene("smoothline")


def test_left_out_says_why():
    assert any("steady" in line or "no feature" in line for line in scene("smooth-line").left_out())
    assert any("friction" in line for line in scene("pitch-line").left_out())
