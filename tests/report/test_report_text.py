"""Words and digits of reports."""

import re

import made_results
import numpy as np
import pytest

from tehl_taichi.fatigue import judged_layers
from tehl_taichi.report import number_text, scene_text, verdict
from tehl_taichi.scene import feature_wording, scene
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_text import without_options
from tehl_taichi.values.coded_warning import with_data


def test_a_scale_that_changes_nothing_is_not_told(tmp_path):
    np.save(tmp_path / "m.npy", 1e-7 * np.sin(np.arange(20))[:, None] * np.ones(20))
    of_map = scene("gear").replace(**{"feature.shape": "map", "feature.file": str(tmp_path / "m.npy"), "feature.unit": "m",
                                      "feature.pixel": 1e-5})
    assert "scale" not in scene_text.words(of_map)[-1] and "pixel 10 µm" in scene_text.words(of_map)[-1]
    assert "scale -1" in scene_text.words(of_map.replace(**{"feature.scale": -1.0}))[-1]


@pytest.mark.parametrize("keys, said", [
    ({}, "example values, replace them by those of your material"), ({"source": "Example."}, "example values, replace"),
    ({"source": "DIN 50100, 42CrMo4"}, "DIN 50100, 42CrMo4"), ({"endurance": 450e6}, "no source is given")])
def test_example_values_do_not_pass_for_those_of_a_material(keys, said):
    changed = scene("gear").replace(**{f"fatigue.{key}": value for key, value in keys.items()})
    assert scene_text.material(changed.fatigue).startswith(said)


@pytest.mark.parametrize("Fi, error, tone, said", [
    (1.2, 0.1, "yes", "Yes: the fatigue limit is exceeded at the surface."), (1.05, 0.1, "open", "Not decided"),
    (0.95, 0.1, "open", "Not decided"), (0.8, 0.1, "no", "No: the index stays below 1."), (0.8, None, "no", "Probably not"),
    (1.2, None, "yes", "Probably yes")])
def test_the_answer_knows_how_sure_it_is(Fi, error, tone, said):
    _, headline, found, _ = verdict.of_fatigue({**made_results.fatigue(Fi, None), "error": {"Fi_max": error}})
    assert found == tone and headline.startswith(said)


@pytest.mark.parametrize("averaged, where", [
    ({}, "25 µm below the surface"), ({"error": {"Fi_max": 0.1}}, "9 µm below the surface (stresses averaged over 10 µm)")])
def test_the_critical_plane_is_of_the_point_that_decides(averaged, where):
    deep = {"depth_m": 9e-6, "Fi_max": 1.2, "surface_angle_deg": 38.0, **averaged}
    found = {**made_results.fatigue(0.9, 1.4), "averaged": {**made_results.fatigue(0.8, None), "length_m": 1e-5, "below": deep}}
    angle = deep["surface_angle_deg"] if averaged else found["below"]["surface_angle_deg"]
    assert verdict.of_fatigue(found)[-1][-1].startswith(
        f"The critical plane {where}, on which a crack would begin, is at {angle:.0f}° to the surface.")


def test_a_surface_that_holds_over_a_depth_that_does_not():
    layers = judged_layers.all_layers({"a": made_results.fatigue(0.5, 1.2)})
    assert [where for where, *_ in layers] == ["at the surface", "25 µm below the surface"]


@pytest.mark.parametrize("Fi, error", [(1.0, None), (1.5, 0.5), (0.5, 0.5)])
def test_an_index_whose_bar_just_reaches_1_is_within_it(Fi, error):
    assert judged_layers.judged(Fi, error) == judged_layers.WITHIN


@pytest.mark.parametrize("deep, early", [(0.05, False), (None, True)])
def test_averaged_stresses_settle_an_answer_only_at_and_below_the_surface(deep, early):
    """Where no error of stresses at points is known; else the resolved part decides."""
    def part(error, **more):
        return {"Fi_max": 1.2, "error": {"Fi_max": error}, **more}

    wide = part(0.05, length_m=1e-5, below=part(deep, depth_m=2e-5))
    found = part(None, resolved=part(0.1), below=part(None, depth_m=2e-5), averaged=wide)
    assert judged_layers.deciding({"a": found})[1] == early


def test_digits_follow_the_error():
    assert number_text.value_text(1.00812, 0.0231) == "1.008 ± 0.023" and number_text.value_text(4.0247e9, 1.767e7,
                                                                                                 "Pa") == "4.025 ± 0.018 GPa"
    assert number_text.value_text(3.944e-7, None, "m") == "0.3944 µm" and number_text.value_text(2.5, 0.0) == "2.5 ± 0"
    assert number_text.value_text(2.286e11, 1e12) == "(0.2 ± 1.0)e+12" and number_text.share(0.5, -50.0) == "1 %"
    assert [number_text.roughly(Fi) for Fi in (1.645, 0.911, 1.03, 0.996, 1.004)] == ["1.6", "0.91", "1.03", "0.996", "1.004"]
    assert [number_text.roughly(Fi) for Fi in (0.99997, 1.00002, 1.0)] == ["0.99997", "1.00002", "1"]


def test_the_oil_in_words_and_numbers():
    """Of the own law alone: which other laws take a number says nothing about this scene."""
    own = scene("gear").replace(oil={"name": "VG220", "viscosity": "barus", "eta0": 0.2, "alpha": 2e-8})
    assert "The oil is VG220 (source not given) and enters" in " ".join(scene_text.words(own))
    rows = dict(scene_text.numbers(own))
    assert rows["eta0: viscosity at p = 0"] == "0.2 Pa s" and not any("roelands" in what for what in rows)


def test_an_oil_by_its_data_sheet_is_told_as_the_sheet_has_it():
    sheet = {"name": "ours", "nu_40": 220e-6, "nu_100": 18.9e-6, "rho_15": 893.0}
    hot = scene("gear").replace(oil=sheet, temperature=100.0)
    rows = dict(scene_text.numbers(hot))
    assert rows["data sheet: kinematic viscosity at 40 °C"] == "220 mm²/s"
    assert rows["data sheet: kinematic viscosity at 100 °C"] == "18.9 mm²/s"
    assert rows["data sheet: density at 15 °C"] == "893 kg/m³"
    assert rows["α at 40 °C, not on the data sheet"].startswith("27 1/GPa, estimated")
    eta, unit = rows["viscosity at the inlet (p = 0)"].split(maxsplit=1)
    assert unit == "mPa s" and 0.93 < float(eta) / (18.9e-6 * 893e3) < 0.95  # 85 K expand it by 6 %
    known = dict(scene_text.numbers(scene("gear").replace(oil={**sheet, "alpha_40": 21e-9})))
    assert known["data sheet: α at 40 °C"] == "21 1/GPa"
    assert not any("sheet" in what for what in dict(scene_text.numbers(scene("gear"))))


def test_a_scene_in_words():
    text = " ".join(scene_text.words(scene("gear").replace(srr=-0.12)))
    for said in ("A line contact of reduced radius 10.6 mm carries 1100 N/mm", "the feature is on the slower surface",
                 "height 1.5 µm", "width 200 µm", "enters at 90 °C"):
        assert said in text, said
    assert "faster surface" in " ".join(scene_text.words(scene("gear").replace(srr=0.12)))
    assert "without slip" in " ".join(scene_text.words(scene("gear").replace(srr=0.0)))


def test_warnings_lose_what_only_a_terminal_takes():
    from tehl_taichi.scene import left_out as scene_parts
    from tehl_taichi.scene import refinement

    grid = refinement.finer_grid_option(scene("gear"))
    text = without_options(with_data(f"a finer grid may resolve it: {grid}", grid))
    assert text == "a finer grid may resolve it: a grid of 512 × 128 cells (8 times the work)"
    wide = scene("gear").replace(**{"feature.y": 0.3e-3, "grid.nx": 128, "grid.ny": 32})
    room, = (one for one in wide.typed_warnings if one.code == "room")
    assert "use --set grid.y_max=1.2 --grid 128x" in room
    assert "use grid.y_max=1.2 and a grid of 128 × " in without_options(room) and "--" not in without_options(room)
    left_out = scene_parts.parts(scene("gear").replace(**{"thermal.on": False}))
    assert any("--thermal" in one for one in left_out) and not any("--" in without_options(one) for one in left_out)
    assert without_options("feature.taper = 4e-05 (m)") == "feature.taper = 4e-05 (m)"


def test_ticks_have_no_prefix_without_a_unit():
    """plotly writes 150e-6 as 150µ unless told otherwise."""
    from tehl_taichi.report.plots import axis, field_map

    made = field_map("map", "A map.", [0, 1], [0, 1], np.zeros((2, 2)), "Viridis", "1", "x", "y")
    parts = [axis("oil.nu_40 (m2/s)"), made.layout["xaxis"], made.layout["yaxis"], made.traces[0]["colorbar"]]
    assert {part.get("exponentformat") for part in parts} == {"power"}


@pytest.mark.parametrize("x, said", [(-0.5, "-0.50 a, that is 0.50 half-widths before the middle of the contact"),
                                     (0.75, "0.75 a, that is 0.75 half-widths behind the middle of the contact"),
                                     (0.001, "the middle of the contact")])
def test_a_position_is_told_as_the_flow_meets_it(x, said):
    """The flow goes to the right: the feature enters at negative positions."""
    assert verdict._place(x) == said


def test_shares_of_rough_surfaces_are_per_cent_with_their_error():
    from fake_cases import rough_search

    assert verdict._spread({"b": rough_search()}) == [
        "Surface b: 12.0 ± 5.0 % of it has Fi > 1; the largest of 130 points is 1.7 (error unknown)."]


def test_what_yields_and_what_ran_in_is_told_with_its_own_numbers():
    mises = {"max_Pa": 2.41e9, "depth_m": 9e-5, "surface": "a", "yield_stress_Pa": 2.2e9, "yields": True}
    said, = verdict._yielding({"fatigue": {}, "von_mises": mises}, scene("gear"))
    assert said.startswith("The von Mises stress reaches 2.41 GPa") and "more than" in said
    ran = {"passages": 3, "plastic_strain_max": 0.01, "height_before_m": 1.5e-6, "height_after_m": 1.2e-6,
           "surface_change_max_m": 3e-7, "residual_min_Pa": -4.1e8, "residual_max_Pa": 1.2e8}
    said, = verdict._run_in({"run_in": ran})
    assert "the height is 1.2 µm (1.5 µm before)" in said and "residual stress is -410 to 120 MPa" in said


def test_the_smooth_contact_has_its_largest_index_at_its_depth_and_another_at_the_surface():
    alone = {"Fi_max": 0.93, "surface_Fi_max": 0.61, "depth_m": 1.8e-4, "error": {"Fi_max": 0.01, "surface_Fi_max": 0.01}}
    said, = verdict._alone_words({"a": {**made_results.fatigue(), "contact_alone": alone}})
    assert "Fi = 0.930 ± 0.010 at 180 µm below surface a" in said and "and 0.610 ± 0.010 at surface a" in said


def test_the_film_of_a_passage_without_an_index_is_that_of_the_passage():
    steady = {"h_c_m": 4.1e-7, "h_min_m": 3.2e-7, "p_max_Pa": 1.2e9}
    summary = {"steady": steady, "transient": {"h_min_m": 1.1e-7, "p_max_Pa": 2.3e9}}
    headline, *_, sentences = verdict._of_film(summary, scene("gear"))[1:]
    assert headline.startswith("The least film is 0.11 µm (error unknown), the largest pressure 2.3 GPa")
    assert "0.41 µm" in sentences[0]


def test_speeds_and_half_axes_are_of_their_surface_and_direction():
    text = " ".join(scene_text.words(scene("gear").replace(srr=-0.12, speed=10.0)))
    assert "move at 9.4 m/s (a) and 10.6 m/s (b): mean 10 m/s" in text
    wide = scene("ball-bearing")
    s = Scales.of(wide)
    half_axes = (number_text.value_text(size, unit="m") for size in (s.a, s.b))
    assert "half-axes {} along x and {} across".format(*half_axes) in " ".join(scene_text.words(wide)) and s.b > s.a


def limits_of(**keys):
    """Sentences about the limits of a scene with these keys of [fatigue], each as (body or "", limit in MPa, whether it names
    example values)."""
    found = verdict.limit_words(scene("gear").replace(**{f"fatigue.{key}": value for key, value in keys.items()}))
    said = re.compile(r"Fi = 1 is the fatigue limit(?: at the surface)?(?: of body (.))? σ_eF = ([\d.]+) MPa with")
    return [(*said.match(text).groups(default=""), "example values" in text) for text in found]


@pytest.mark.parametrize("keys, said", [
    ({}, [("", "400", True)]), ({"table": "case-hardened"}, [("", "595.6", False)]),
    ({"table": "case-hardened", "table_b": "none"}, [("a", "595.6", False), ("b", "400", True)]),
    ({"table": "case-hardened", "table_b": "none", "surfaces": "a"}, [("", "595.6", False)]),
    ({"table": "case-hardened", "table_b": "none", "surfaces": "b"}, [("", "400", True)])])
def test_bodies_with_other_limits_have_a_sentence_each(keys, said):
    """A body without a table has the constants and their source, not the table of the other one."""
    assert limits_of(**keys) == said


def test_a_run_says_the_limit_of_the_searched_bodies():
    bodies = {"b": (4e8, 0.3, "findley"), "a": (596e6, 0.6, "findley")}
    known = scene("gear").replace(**{"fatigue.table": "case-hardened", "fatigue.table_b": "none"}).fatigue
    b, a = verdict._limits(bodies, known)
    assert b.startswith("Fi = 1 is the fatigue limit at the surface of body b σ_eF = 400 MPa") and "table" not in b
    assert a.startswith("Fi = 1 is the fatigue limit at the surface of body a σ_eF = 596 MPa") and "case-hardened" in a


def test_positions_count_from_the_origin_where_the_first_feature_lies_beside_it():
    """A first feature at 3 mm is not at -9 half-widths when it enters the contact."""
    beside = scene("gear").replace(**{"feature.x": 3e-3})
    w = feature_wording
    words = w.position_word, w.position_title, w.centre_word, w.from_centre
    assert [word(beside) for word in words] == ["origin of feature.x", "position of the origin of feature.x x / a",
                                                "origin of feature.x", "x from the origin of feature.x (µm)"]
    assert [word(scene("gear")) for word in words] == ["feature", "position of the feature x / a", "centre of the feature",
                                                       "x from the feature's centre (µm)"]
