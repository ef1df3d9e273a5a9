"""Values of scenes with units: files, options, Python, sweeps."""

import math

import pytest

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.scene import keys, scene_file
from tehl_taichi.scene.gear_pair import GearPair
from tehl_taichi.scene.unit_texts import DECLARED
from tehl_taichi.values.units import TEMPERATURES, UNITS

FILE = """
[contact]
kind = "point"
radius_x = "9.525 mm"
hertz_pressure = "1 GPa"
[bodies.a]
E = "210 GPa"
[operation]
u_a = "100 rpm at 95.49 mm"
u_b = "900 mm/s"
temperature = "343 K"
[oil]
name = "mine"
nu_40 = "100 cSt"
nu_100 = "11 mm2/s"
[[feature]]
height = "0.5 µm"
width = "80 um"
[fatigue]
bending_limit = "700 MPa"
depths = ["50 um", 1e-4]
"""


def test_a_file_with_units_is_that_without(tmp_path):
    (tmp_path / "s.toml").write_text(FILE)
    found = scene_file.load(tmp_path / "s.toml")
    assert found.contact.radius_x == found.contact.radius_y == 9.525e-3 and found.contact.hertz_pressure == 1e9
    assert found.body_a.E == 210e9 and found.oil.nu_40 == 100e-6 and found.operation.temperature == 69.85
    assert found.operation.u_a == pytest.approx(2 * math.pi * 100 / 60 * 0.09549) and found.operation.u_b == pytest.approx(0.9)
    assert found.features[0].height == 0.5e-6 and found.fatigue.bending_limit == 7e8 and found.fatigue.depths == (5e-5, 1e-4)
    (tmp_path / "t.toml").write_text(scene_file.dumps(found))
    assert scene_file.load(tmp_path / "t.toml") == found


@pytest.mark.parametrize("short, text, full, value", [
    ("load", "900 N/mm", "contact.load", 9e5), ("speed", "10 m/s", "operation.u_m", 10.0),
    ("height", "2 um", "feature.height", 2e-6),
    ("temperature", "353.15 K", "operation.temperature", 80.0), ("srr", "-20 %", "operation.srr", -0.2),
    ("hertz_pressure", "1500 MPa", "contact.hertz_pressure", 1.5e9), ("feature.0.width", "0.3 mm", "feature.width", 3e-4)])
def test_changes_with_units(short, text, full, value):
    """Short and full names alike; equal to the bare number."""
    gear = tehl.scene("gear")
    assert gear.replace(**{short: text}) == gear.replace(**{full: value}) != gear


def test_sections_of_python():
    assert tehl.Contact(kind="point", radius_x="1 cm", load="50 N") == tehl.Contact(kind="point", radius_x=0.01, load=50.0)
    assert tehl.Feature(height="-2 um", width="0.5 mm") == tehl.Feature(height=-2e-6, width=5e-4)
    assert GearPair(torque="0.2651 kN m", n1="36.1666666667 Hz").n1 == pytest.approx(2170.0)
    assert tehl.RollingBearing(diameter="9.525 mm", count=9, pitch_diameter="46 mm", load="3 kN").load == 3000.0


def test_the_kind_of_contact_decides_the_unit_of_the_load():
    """5 kN are no load of a line, 5 N/mm none of a ball."""
    with pytest.raises(SceneError, match="'kN' is no unit of it.*N/mm"):
        tehl.scene("gear").replace(load="5 kN")
    with pytest.raises(SceneError, match="'N/mm' is no unit of it.*kN"):
        tehl.scene("mtm").replace(load="5 N/mm")
    assert tehl.scene("mtm").replace(load="0.05 kN").contact.load == 50.0


def test_sweeps_have_numbers():
    """The coordinate of a study is in the declared unit."""
    found = plan(tehl.scene("gear"), {"temperature": "343 K,80 C", "load": ["900 N/mm", 1e6]})
    assert found.coordinate("temperature")[1] == [69.85, 80] and found.coordinate("load")[1] == [9e5, 1e6]
    with pytest.raises(tehl.SceneError, match="343 K,80: 80 has no unit; give each number its unit"):
        plan(tehl.scene("gear"), {"temperature": "343 K,80"})  # 80 K, or 80 deg C?
    together = plan(tehl.scene("gear"), {("height", "width"): [("1 um", "0.1 mm"), ("2 um", "0.2 mm")]})
    assert together.changes(1) == {"height": 2e-6, "width": 2e-4}
    assert plan(tehl.scene("gear"), {"oil.name": "mineral-vg220,mineral-vg320"}).coordinate("oil.name")[1][0] == "mineral-vg220"


def test_every_unit_of_a_scene_is_known():
    """A quantity of a new unit needs a row in the table of units."""
    unknown = {kind.unit for kind in DECLARED.values()} - UNITS.keys() - {"deg C", "a^2/R'", "cells"}
    assert not unknown and "deg C" in TEMPERATURES
    assert {key for key in DECLARED if key.startswith("feature.")} >= {f"feature.{key}" for key in ("height", "width", "x")}
    assert "feature" in keys.CLASSES


def test_the_radius_across_follows_the_kind():
    """A point has the radius along x, a line none, an ellipse needs its own; one that is given stays."""
    assert tehl.Contact(kind="point", radius_x=0.02, load=50.0).radius_y == 0.02
    mtm = tehl.scene("mtm")
    assert mtm.replace(**{"contact.radius_x": "20 mm"}).contact.radius_y == 0.02
    assert mtm.replace(**{"contact.kind": "line"}).contact.radius_y == math.inf
    assert tehl.scene("gear").replace(load=50.0, **{"contact.kind": "point"}).contact.radius_y == 10.6e-3
    with pytest.raises(SceneError, match="radius_y is not given"):
        mtm.replace(**{"contact.kind": "elliptic"})
    wide = mtm.replace(**{"contact.kind": "elliptic", "contact.radius_y": 0.02})
    assert wide.replace(**{"contact.radius_x": 0.015}).contact.radius_y == 0.02


def test_a_load_of_another_kind_is_refused():
    """N/m of a line are not N of a ball."""
    with pytest.raises(SceneError, match="'point' needs a load of its own.*N/m; give contact.load in N"):
        tehl.scene("gear").replace(**{"contact.kind": "point"})
    with pytest.raises(SceneError, match="1462.0 N; give contact.load in N/m"):
        tehl.scene("ball-bearing").replace(**{"contact.kind": "line"})
    assert tehl.scene("mtm").replace(**{"contact.kind": "line"}).contact.hertz_pressure == 1e9


def test_bodies_of_a_file_without_base_are_steel(tmp_path):
    """Glass only where the file, or its base, says so."""
    (tmp_path / "s.toml").write_text('[contact]\nkind = "point"\nradius_x = 0.01\nload = 50\n')
    found = scene_file.load(tmp_path / "s.toml")
    assert found.body_a == found.body_b == tehl.Body() and found.body_b.E == 206e9 and found.grid.y_max >= 1.5


def test_equal_values_in_other_units_do_not_contradict():
    """The short name and the full key of one value."""
    changed = tehl.scene("gear").replace(srr="10 %", **{"operation.srr": 0.1})
    assert changed.operation.srr == 0.1
    with pytest.raises(SceneError, match="contradict each other"):
        tehl.scene("gear").replace(srr="10 %", **{"operation.srr": 0.2})


def test_a_speed_beside_a_moes_pair_is_compared_as_a_number(tmp_path):
    """The pair gives the speed; a file that also has it in another unit is judged by its value."""
    u_m = tehl.scene("smooth-line").replace(**{"contact.moes_M": 50.0, "contact.moes_L": 5.0}).operation.u_m
    text = 'base = "smooth-line"\n[contact]\nmoes_M = 50.0\nmoes_L = 5.0\n[operation]\nu_m = "{} mm/s"\n'
    (tmp_path / "s.toml").write_text(text.format(u_m * 1e3))
    assert scene_file.load(tmp_path / "s.toml").operation.u_m == pytest.approx(u_m)
    (tmp_path / "s.toml").write_text(text.format(2 * u_m * 1e3))
    with pytest.raises(SceneError, match="contradict each other"):
        scene_file.load(tmp_path / "s.toml")


@pytest.mark.parametrize("text", ["2e9", "20", " 1e-3 ", "-4"])
def test_text_of_a_number_alone_is_no_number_with_a_unit(text):
    """An exponent was taken for a unit."""
    with pytest.raises(SceneError, match="is not a number; allowed"):
        tehl.scene("gear").replace(**{"bodies.a.yield_stress": text})
