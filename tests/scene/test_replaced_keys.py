"""Values of the user that a change of another key replaces are reported, and no others."""

import pytest

import tehl_taichi as tehl
from tehl_taichi.runs.bearing.ring_scenes import base_of, smooth
from tehl_taichi.scene import scene_file

SHEET = 'base = "smooth-line"\n[oil]\nname = "mine"\nnu_40 = 100e-6\nnu_100 = 11e-6\n'
STEEL = 'base = "smooth-line"\n[bodies.b]\nE = 190e9\n'
LIMITS = 'base = "gear"\n[fatigue]\nbending_limit = 6e8\ntorsion_limit = 4e8\n'
ELLIPSE = 'base = "ball-on-disc"\n[contact]\nkind = "elliptic"\nradius_x = 0.01\nradius_y = 0.02\nload = 20.0\n'
REPLACED = [(SHEET, {"oil.name": "mineral-vg220"}, ["oil.nu_40 = 0.0001", "oil.nu_100 = 1.1e-05"]),
            (STEEL, {"bodies.b.material": "100Cr6"}, ["bodies.b.E = 1.9e+11"]),
            (LIMITS, {"kappa": 0.2, "torsion_limit": 5e8}, ["fatigue.bending_limit = 6e+08"]),
            (ELLIPSE, {"contact.kind": "point"}, ["contact.radius_y = 0.02"])]
KEPT = [(SHEET, {"oil.name": "mine", "temperature": 70.0}), (SHEET, {"oil.nu_40": 150e-6}), (STEEL, {"bodies.b.E": 200e9}),
        (LIMITS, {"endurance": 5e8}), (ELLIPSE, {"hertz_pressure": 1e9}), (STEEL, {"bodies.a.material": "100Cr6"})]


def load(path, text, changes):
    path.write_text(text)
    return scene_file.load(path, changes)


def said(scene):
    return [one for one in scene.warnings() if one.code == "replaced"]


@pytest.mark.parametrize("text, changes, values", REPLACED)
def test_replaced_values_are_reported_by_file_and_in_python(tmp_path, text, changes, values):
    path = tmp_path / "one.toml"
    by_file, by_hand = load(path, text, changes), scene_file.load(path).replace(**changes)
    (sentence,) = said(by_file)
    assert said(by_hand) == [sentence] and all(value in sentence for value in values)
    assert next(iter(changes)).rpartition(".")[2] in sentence.partition(":")[0]


@pytest.mark.parametrize("text, changes, values", REPLACED)
def test_a_file_written_by_tehl_says_no_more(tmp_path, text, changes, values):
    """A whole file holds every number; only those that differ from the usual ones are the user's."""
    whole = scene_file.dumps(load(tmp_path / "one.toml", text, {}))
    (sentence,) = said(load(tmp_path / "two.toml", whole, changes))
    assert all(value in sentence for value in values)
    assert said(load(tmp_path / "new.toml", scene_file.dumps(tehl.scene("gear")), {"oil.name": "mineral-vg220"})) == []


@pytest.mark.parametrize("text, changes", KEPT)
def test_values_named_or_described_anew_are_no_surprise(tmp_path, text, changes):
    assert said(load(tmp_path / "one.toml", text, changes)) == []


def test_a_file_that_needs_its_changes_loads(tmp_path):
    text = SHEET.replace("nu_100 = 11e-6", "nu_100 = 110e-6")
    assert load(tmp_path / "one.toml", text, {"oil.nu_100": 12e-6}).oil.nu_100 == 12e-6


def test_later_changes_and_smooth_copies_keep_the_warning(tmp_path):
    found = load(tmp_path / "one.toml", SHEET, {"oil.name": "mineral-vg220"})
    for one in (found.replace(srr=0.1), base_of(found), smooth(found)):
        assert said(one) == said(found) != []


def test_the_summary_of_a_run_keeps_what_was_said_about_typed_keys(tmp_path):
    """The scene of a store has no memory of what the user gave: that is in the warnings stored at the start."""
    changes = {"oil.name": "mineral-vg220", "oil.k0": 0.12, "thermal.on": False, "grid.nx": 64}
    scene = load(tmp_path / "one.toml", SHEET, changes)
    run = tehl.run(scene, tmp_path / "a.zarr")
    typed = [one for one in scene.warnings() if one.code in ("idle", "replaced")]
    assert len(typed) == 2 and all(run.summary["warnings"].count(one) == 1 for one in typed)
    assert tehl.open(run.path).summary["warnings"] == run.summary["warnings"]
