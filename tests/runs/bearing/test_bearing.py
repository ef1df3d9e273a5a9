"""A whole bearing: what names it, its scenes and files, its page, and one that is computed."""

import csv
import dataclasses
import json
import math
import shutil
from types import SimpleNamespace

import made_results
import numpy as np
import pytest
from commands import here
from fake_cases import position

import tehl_taichi as tehl
from tehl_taichi.disk import user_files
from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.report import bearing_page, document, place_sections
from tehl_taichi.runs.bearing import bearing_figure, bearing_run, bearing_table
from tehl_taichi.runs.bearing.bearing_source import bearing_source
from tehl_taichi.runs.bearing.stored_bearing import Bearing
from tehl_taichi.runs.flank import outcomes
from tehl_taichi.runs.flank.flank_columns import PASSAGE
from tehl_taichi.runs.flank.outcomes import Outcome
from tehl_taichi.runs.open_results import kind
from tehl_taichi.runs.summary import life
from tehl_taichi.runs.sweep import case
from tehl_taichi.scene import resolution, scene
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_warning import CodedWarning, lists
from tehl_taichi.view.figures.figure_style import FigureStyle

NAMES = {"R_x_m", "R_y_m", "a_m", "b_m", "p_Hertz_Pa", "u_m_m_s", "summary"}
DENT = dict(shape="dent", height=-2e-6, width=0.2e-3, rim=0.3e-6)
DUTY = dict(load=3000.0, speed=1500.0)


@pytest.fixture(scope="module")
def dry(tmp_path_factory):
    """A 6206 without runs."""
    return tehl.bearing("6206", **DUTY, roughness=0.1e-6, run=False, folder=tmp_path_factory.mktemp("b") / "b6206")


def test_the_record_has_the_keys_of_the_interface(dry):
    record = dry.to_dict()
    assert record["ball_load_max_N"] == max(record["loads_N"]) and len(record["loads_N"]) == 9
    assert all(NAMES <= record[ring].keys() for ring in ("inner", "outer"))
    assert json.loads((dry.folder / "bearing.json").read_text()) == record
    assert record["estimated"] == ["osculation_inner", "osculation_outer"] and "SKF" in record["source"]


def test_scene_files_have_the_contact_of_the_record(dry):
    for ring, one in dry.rings.items():
        scene = tehl.scene(one["scene_file"])
        s = Scales.of(scene)
        assert (s.p_H, s.a, s.b) == pytest.approx((one["p_Hertz_Pa"], one["a_m"], one["b_m"]))
        assert scene.contact.kind == "elliptic" and scene.operation.u_m == pytest.approx(one["u_m_m_s"])
        assert scene.operation.srr == pytest.approx(one["slip"]["srr_centre"]) and one["slip"]["srr"] == scene.operation.srr
        assert not scene.transient
        assert scene.load == one["load_N"] and scene.name == f"6206-{ring}" and (scene.grid.nx, scene.grid.ny) == (128, 32)


def test_files_of_a_bearing_open_again(dry):
    again = tehl.open(dry.folder)
    assert kind(dry.folder) == "bearing" and again.record == dry.record and repr(again) == repr(dry)
    with (dry.folder / "bearing.csv").open() as file:
        inner, outer = csv.DictReader(file)
    assert inner["ring"] == "inner" and float(outer["p_Hertz_Pa"]) == dry.rings["outer"]["p_Hertz_Pa"]
    assert float(inner["lambda"]) == pytest.approx(dry.rings["inner"]["film_formula_m"] / 0.1e-6) and "h_c_m" not in inner


def test_the_page_begins_with_safety_and_film(dry):
    page = bearing_page.of(dry.folder)
    assert page.answer.headline.startswith("Yes: static safety ")
    assert "(by formula) at the inner ring" in page.answer.headline
    assert "times the roughness" in page.answer.headline and "4.2 GPa" in page.answer.sentences[0]
    assert any("not published" in one for one in page.answer.doubts)
    assert {"bearing-loads", "bearing-contacts"} <= page.figures.keys()
    text = document.render(page)
    assert all(words in text for words in ("9.525 mm", "E = 206 GPa, nu = 0.3", "reference-pao", "inner.toml"))
    assert "profile of a roller" not in text


def test_the_page_names_the_limit_where_a_feature_passed(dry):
    """Whose it is, and from where: of the scene of that ring."""
    assert bearing_page.limits(dry) == ()
    ran = Bearing(dry.folder, {**dry.record, "inner": {**dry.record["inner"], "summary": {"fatigue": {}}}})
    sentence, = bearing_page.limits(ran)
    assert sentence.startswith("Fi = 1 is the fatigue limit σ_eF = 400 MPa with κ = 0.3 (findley): example values")


@pytest.mark.parametrize("Fi, tone, said", [(1.5, "yes", "Yes: the fatigue limit is exceeded"), (0.5, "no", "No: the index")])
def test_the_answer_of_a_dent_is_that_of_its_crack(dry, Fi, tone, said):
    fatigue = {"surface": "a", "Fi_max": Fi, "error": {"Fi_max": 0.1}, "surface_angle_deg": 30.0}
    ran = Bearing(dry.folder, {**dry.record, "inner": {**dry.record["inner"], "summary": {"fatigue": fatigue}}})
    answer = bearing_page.answer(ran)
    assert answer.tone == tone and "fatigue crack" in answer.question
    assert answer.headline.startswith("Yes: static safety") and f"Fatigue crack at the inner ring? {said}" in answer.headline
    assert answer.sentences[0].startswith("The central film is ") and bearing_page.answer(dry).tone == "none"


def test_the_page_shows_the_contact_that_a_feature_passes(dry, tmp_path):
    """The maps of its store, lying on their side, right below the answer; without a run there are none."""
    assert bearing_page._store(dry) == (None, "inner") and bearing_page.of(dry.folder).front[0].title == "Loads and contacts"
    record = {**dry.record, "outer": {**dry.record["outer"], "store": "elsewhere/made.zarr", "summary": {"fatigue": {}}}}
    made_results.run(tmp_path / "made.zarr", scene("ball-bearing").replace(**{"grid.nx": 32, "grid.ny": 8}), 1)
    store, ring = bearing_page._store(Bearing(tmp_path, record))
    section, middle = place_sections.critical(store, f"{ring} ring")
    assert middle.title == "Middle of the contact: outer ring"
    assert [figure.name for figure in middle.parts[0].figures] == ["map-pressure-middle", "map-film-middle"]
    assert section.title == "Critical position: outer ring"
    assert [[figure.name for figure in part.figures] for part in section.parts] == [["map-pressure"], ["map-film"]]
    assert section.parts[0].figures[0].layout["yaxis"]["autorange"] == "reversed"


def test_the_page_of_too_much_load_says_no(tmp_path):
    found = tehl.bearing("6206", load=20000.0, run=False, folder=tmp_path / "b")
    assert bearing_page.of(found.folder).answer.headline.startswith("No: static safety 0.6")


def test_the_figure_shows_loads_pressure_and_slip(dry):
    pytest.importorskip("matplotlib")
    axes = bearing_figure.drawn(FigureStyle(), dry).axes
    assert [len(ax.patches) for ax in axes] == [9, 0, 0] and [len(ax.lines) for ax in axes] == [0, 2, 2]
    assert max(axes[1].lines[0].get_ydata()) == pytest.approx(dry.rings["inner"]["p_Hertz_Pa"] / 1e9)


def test_results_of_the_runs_come_into_record_and_tables(tmp_path, monkeypatch):
    monkeypatch.setattr(case, "run_case", lambda job, *_: position(job))
    found = tehl.bearing("6205", **DUTY, folder=tmp_path / "b", workers=1)
    assert [one["summary"]["steady"]["h_c_m"] for one in found.rings.values()] == pytest.approx(
        [one["R_x_m"] for one in found.rings.values()])
    assert not found.failed and all(one["converged"] for one in found.rings.values())
    rows = {label: (inner, outer) for label, inner, outer in bearing_table.tables(found)["film"]}
    assert rows["h_c, um"][0] == f"{found.rings['inner']['R_x_m'] * 1e6:.3f} ± ?"


def test_the_index_that_decides_is_beside_the_passages_that_follow_from_it(dry):
    """That of the resolved part, if the grid does not resolve the passage; the page says so."""
    early = {"Fi_max": 0.9, "error": {"Fi_max": 0.02}, "to_x_a": 0.5}
    summary = {"fatigue": {"surface": "a", "Fi_max": 1.4, "error": {"Fi_max": None}, "resolved": early}}
    summary |= life.part({"a": summary["fatigue"]}, dataclasses.replace(scene("gear").fatigue, exponent=9.0, limit_cycles=1e6))
    found = Bearing(dry.folder, {**dry.record, "inner": {**dry.record["inner"], "summary": summary}})
    rows = {label: inner for table in bearing_table.tables(found).values() for label, inner, _ in table}
    assert rows["Fi judged"] == "0.900 ± 0.020" and summary["life"]["passages"] == pytest.approx(1e6 * 0.9**-9)
    assert rows["passages to initiation"].startswith("(2.58 ± ")
    said, = place_sections.passages(bearing_page._results(found), str)
    assert "at inner the grid does not resolve" in said


def test_errors_are_printed_in_the_unit_of_their_number(dry):
    """Two digits of an error of 2.3 % in every row."""
    summary = {"steady": {"h_c_m": 1.008e-6, "error": {"h_c_m": 0.023e-6}},
               "transient": {"p_max_Pa": 1.008e9, "error": {"p_max_Pa": 0.023e9}}}
    rings = {name: {**one, "summary": summary} for name, one in dry.rings.items()}
    tables = bearing_table.tables(Bearing(dry.folder, {**dry.record, **rings}))
    rows = {label: inner for table in tables.values() for label, inner, _ in table}
    assert rows["h_c, um"] == rows["largest pressure, GPa"] == "1.008 ± 0.023"


@pytest.mark.parametrize("summary, title", [({"von_mises": {"max_Pa": 1e9}}, "stress"),
                                            ({"von_mises": {"max_Pa": 1e9}, "transient": {"p_max_Pa": 2e9}}, PASSAGE)])
def test_stresses_of_smooth_contacts_are_of_no_feature(dry, summary, title):
    rings = {name: {**one, "summary": summary} for name, one in dry.rings.items()}
    assert list(bearing_table.tables(Bearing(dry.folder, {**dry.record, **rings})))[-1] == title


def test_the_torque_of_the_slip_sums_the_contacts(dry):
    """By hand: of two loaded balls, one with an eighth of the load, 1 + 8^(-5/3) = 1.03125 of the loss of the first."""
    ring = {"summary": {"steady": {"friction_coefficient": 0.05}}, "slip": {"mean_m_s": 0.02}, "load_N": 800.0,
            "spin_rad_s": 0.0}
    record = {"inner": ring, "outer": ring, "ball_load_max_N": 800.0, "loads_N": [800.0, 100.0, 0.0],
              "geometry": {"speed": 3000 / math.pi, "outer_speed": 0.0}}
    power, torque = bearing_table.slip_torque(record)
    assert power == pytest.approx(2 * 0.8 * 1.03125) and torque == pytest.approx(power / 100)
    assert bearing_table.slip_torque(dry.record) is None
    assert bearing_table.slip_torque({**record, "inner": {**ring, "spin_rad_s": 5.0}}) is None


def test_a_ring_without_a_result_is_named(tmp_path, monkeypatch):
    def work(job, *_):
        made = position(job)
        if job.scene.name.endswith("inner"):
            return {**made, "status": "not converged", "reason": "made up", "summary": None}
        return {**made, "summary": {**made["summary"], "version": "0.9", "wall_s": 1.0}}

    monkeypatch.setattr(case, "run_case", work)
    found = tehl.bearing("6205", **DUTY, folder=tmp_path / "b", workers=1)
    assert found.failed == {"inner": "made up"}
    assert "Without a result" in [section.title for section in bearing_page.of(found.folder).shown]


@pytest.mark.parametrize("options, used", [({}, 1), ({"steady": True}, None), ({"workers": 2}, 2), ({"threads": 1}, None)])
def test_a_passage_has_all_cores(tmp_path, monkeypatch, options, used):
    """The other ring takes seconds."""
    seen = []
    monkeypatch.setattr(outcomes, "summaries", lambda scenes, folder, workers, *rest: seen.append(workers) or iter(()))
    tehl.bearing("6206", **DUTY, feature=tehl.Feature(**DENT), folder=tmp_path / "b", **options)
    assert seen == [used]


def test_a_dent_passes_on_one_ring(tmp_path):
    found = tehl.bearing("6206", **DUTY, on="outer", feature=tehl.Feature(**DENT), run=False, folder=tmp_path / "b",
                         changes={"time.steps": 3, "kappa": 0.2})
    inner, outer = (tehl.scene(one["scene_file"]) for one in found.rings.values())
    assert outer.transient and outer.features == (tehl.Feature(**DENT),) and not resolution.warnings(outer)
    assert not inner.transient and inner.features == ()


def test_a_contact_angle_spins_at_the_inner_ring(tmp_path):
    found = tehl.bearing("218", load=0.0, axial=17800.0, run=False, folder=tmp_path / "b")
    assert found.rings["inner"]["spin_rad_s"] > 0 == found.rings["outer"]["spin_rad_s"]
    assert any("outer raceway control" in one for one in found.record["assumptions"])
    slip = found.rings["inner"]["slip"]
    assert slip["srr"] == pytest.approx(-slip["mean_m_s"] / found.rings["inner"]["u_m_m_s"]) and abs(slip["srr_centre"]) < 1e-3
    assert bearing_table.elements(found)[0][-1] == "contact angle, deg"


def test_rollers_say_whether_they_touch_along_a_line(tmp_path):
    keys = dict(element="roller", diameter=8e-3, count=18, pitch_diameter=60e-3, length=10e-3, contact_angle=15.0, taper=4.0)
    found = tehl.bearing("tapered", **DUTY, dimensions={**keys, "crown": 2.5}, run=False, folder=tmp_path / "b")
    inner = found.rings["inner"]
    scene = tehl.scene(inner["scene_file"])
    assert "line contact" in inner["contact"] and scene.contact.kind == "line" and math.isinf(scene.contact.radius_y)
    assert Scales.of(scene).p_H == pytest.approx(inner["p_Hertz_Pa"]) and scene.operation.srr == 0 and inner["slip"] is None
    straight = tehl.bearing("tapered", **DUTY, dimensions=keys, run=False, folder=tmp_path / "s")
    assert straight.rings["inner"]["R_y_m"] is None and straight.rings["inner"]["b_m"] == 5e-3


def test_the_domain_of_rollers_is_as_wide_as_their_features(tmp_path):
    keys = dict(load=2000.0, feature=tehl.Feature(**{**DENT, "width": 0.4e-3}), run=False)
    dented = tehl.bearing("209-roller", **keys, folder=tmp_path / "b").rings["inner"]
    scene = tehl.scene(dented["scene_file"])
    assert scene.transient and scene.grid.y_max * dented["a_m"] >= 2 * scene.features[0].reach_y
    own = tehl.bearing("209-roller", **keys, changes={"grid.y_max": 5.0}, folder=tmp_path / "own").rings["inner"]
    assert tehl.scene(own["scene_file"]).grid.y_max == 5.0


def test_a_scan_passes_on_a_ring(tmp_path):
    x, y = np.linspace(-3, 3, 80), np.linspace(-3, 3, 60)
    np.savetxt(tmp_path / "scan.csv", -0.2 * np.exp(-(x**2 + y[:, None] ** 2)), delimiter=",")
    quick = ("bearing", "6206", "--scan", "scan.csv", "--no-run", "--no-figure")
    found = here(*quick, "--unit", "um", "--pixel", "4e-6", "--out", "b", cwd=tmp_path)
    assert found.returncode == 0, found.stderr
    (feature,) = tehl.scene(tmp_path / "b" / "inner.toml").features
    assert feature.kind.measured and feature.pixel == 4e-6 and feature.level == "form" and feature.taper > 0
    missing = here(*quick, cwd=tmp_path)
    assert missing.returncode == 2 and "feature.unit is missing" in missing.stderr


def test_a_file_names_a_bearing(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text('base = "6206"\nscene = "smooth-line"\n[bearing]\nclearance = 10e-6\nosculation_inner = 0.515\n')
    found = bearing_source(file, {"load": 2000.0, "axial": None})
    assert found.name == "mine" and found.bearing.count == 9 and found.bearing.load == 2000 and found.bearing.clearance == 10e-6
    assert found.estimated == ("osculation_outer",) and found.scene.name == "smooth-line"
    file.write_text('name = "b"\n[bearing]\nelement = "roller"\ndiameter = 8e-3\ncount = 18\npitch_diameter = 0.06\n'
                    'length = 0.01\n')
    assert bearing_source(file, {}).bearing.rollers and bearing_source(file, {}).estimated == ()


def test_a_file_without_a_scene_passes_no_feature(tmp_path):
    """The default scene gives oil and numerics alone, whether a designation or a file names the bearing."""
    file = tmp_path / "mine.toml"
    for line, passes in (("", False), ('scene = "gear"\n', True)):
        file.write_text(f'base = "6206"\n{line}')
        found = tehl.bearing(file, run=False, folder=tmp_path / f"b{passes}")
        assert bool(tehl.scene(found.rings["inner"]["scene_file"]).features) == passes


@pytest.mark.parametrize("name", ["6206", "6206-2RS1", "6206 C3", "SKF 6206/C3", "6206-2Z"])
def test_suffixes_of_seals_and_clearance_make_no_other_balls(name):
    found = bearing_source(name, {})
    assert found.name == "6206" and found.bearing.count == 9 and found.bearing.clearance == 0
    assert ("is ignored" in found.source) == (name != "6206")
    own = bearing_source(name, {"clearance": 15e-6})
    assert own.bearing.clearance == 15e-6 and bearing_source("209-ROLLER", {}).name == "209-roller"


@pytest.mark.parametrize("name, key", [("209 roller", "209-roller"), ("209-Roller C3", "209-roller"), ("SKF  209", "209")])
def test_the_longest_designation_counts(name, key):
    assert bearing_source(name, {}).name == key


@pytest.mark.parametrize("name", ["6206 tapered roller", "6206-needle", "209 ball roller", "6206 taper"])
def test_words_are_no_suffix(name):
    with pytest.raises(SceneError, match="is no suffix of seals, cage or clearance, and .* is a deep groove ball bearing"):
        bearing_source(name, {})
    own = dict(diameter=8e-3, count=18, pitch_diameter=0.06)
    assert bearing_source(name, own).name == name


@pytest.mark.parametrize("words, said", [
    (("roller", "6206", "--length", "10e-3"), "6206 is a ball bearing, not a roller bearing; use `tehl bearing 6206`"),
    (("roller", "mine.toml"), "mine.toml is a ball bearing, not a roller bearing; use `tehl bearing mine.toml`"),
    (("bearing", "209-roller", "--balls", 5), "209-roller is a roller bearing, not a ball bearing; use `tehl roller")])
def test_balls_do_not_become_rollers(tmp_path, words, said):
    (tmp_path / "mine.toml").write_text('base = "6206"\n')
    found = here(*words, "--no-run", "--no-figure", cwd=tmp_path)
    assert found.returncode == 2 and said in " ".join(found.stderr.split()) and not (tmp_path / "runs").exists()


def test_changed_dimensions_are_named_and_have_no_rating(tmp_path):
    found = tehl.bearing("6206", dimensions={"count": 5, "diameter": 14e-3}, run=False, folder=tmp_path / "b")
    assert found.title.startswith("6206, with count and diameter as given: 1000 N radial")
    assert found.record["source"].startswith("6206, with count and diameter as given; otherwise SKF")
    assert "11.2 kN" not in found.record["source"]
    same = bearing_source("6206", {"count": 9, "load": 3000.0, "clearance": 1e-5})
    assert same.changed == () and "11.2 kN" in same.source
    (tmp_path / "mine.toml").write_text('base = "6206"\n[bearing]\ncount = 8\n')
    own, more = bearing_source(tmp_path / "mine.toml", {}), bearing_source(tmp_path / "mine.toml", {"count": 7})
    assert (own.changed, more.changed) == ((), ("count",)) and "11.2 kN" not in own.source + more.source


@pytest.mark.parametrize("text, said", [("", "needs a table \\[bearing\\], or base = a designation"),
                                        ("[bearing]\nballs = 9", "unknown key bearing.balls"),
                                        ("colour = 1", "unknown key 'colour'"), ("base = 3", "base = 3 must be text"),
                                        ('base = "6207x"', "not in the table of this program")])
def test_a_wrong_file_is_refused_in_a_sentence(tmp_path, text, said):
    file = tmp_path / "mine.toml"
    file.write_text(text)
    with pytest.raises(SceneError, match=said):
        bearing_source(file, {})


def test_the_number_of_a_designation_may_be_a_number():
    assert bearing_source(6206, {"load": 3e3}) == bearing_source("6206", {"load": 3e3})


@pytest.mark.parametrize("options, said", [
    (dict(what="6207"), "'6207' are not in the table .*did you mean '620[356]'.*give its elements by dimensions: diameter"),
    (dict(what=3), "bearing '3' are not in the table"), (dict(what=3.5), "bearing = 3.5 is not a path"),
    (dict(on="left"), "on = 'left' is not known; allowed: inner, outer"),
    (dict(roughness=0.1), "roughness = 0.1 m is out of range"),
    (dict(changes={"srr": 0.1}), "operation.srr has no effect: dimensions, load and speed of the bearing set it"),
    (dict(changes={"contact.load": 10.0}), "contact.load has no effect"),
    (dict(dimensions={"balls": 9}), "unknown key bearing.balls"),
    (dict(load=1e6), "inner ring: .*gives a Hertz pressure of .* allowed: 1e\\+07 to 6e\\+09 Pa")])
def test_wrong_calls_are_refused_before_anything_is_written(tmp_path, options, said):
    with pytest.raises(SceneError, match=said):
        tehl.bearing(**{"what": "6206", **options}, run=False, folder=tmp_path / "b")
    assert not (tmp_path / "b").exists()


@pytest.mark.parametrize("changes, said", [
    ({"fatigue.kapa": 0.2}, "unknown key fatigue.kapa .did you mean 'kappa'"),
    ({"feature.hieght": 1}, "unknown key feature.hieght"), ({"time.foo": 3}, "unknown key time.foo"),
    ({"kappa": 7.0}, "fatigue.kappa = 7 is out of range"),
    ({"time.steps": 3, "time.steady_only": True}, "contradict each other")])
def test_keys_of_a_passage_are_checked_where_nothing_passes(tmp_path, changes, said):
    for steady in (False, True):
        with pytest.raises(SceneError, match=said):
            tehl.bearing("6206", changes=changes, steady=steady, run=False, folder=tmp_path / "b")
    assert not (tmp_path / "b").exists()


def test_warnings_of_both_rings_are_one_sentence_whatever_their_numbers():
    """As at the positions of a flank; a warning that the bearing itself has comes first."""
    rings = {name: {"summary": lists([CodedWarning(f"{n} cells", "cells"), CodedWarning("oil", "oil")])}
             for n, name in ((15, "inner"), (14, "outer"))}
    assert bearing_table.warnings(SimpleNamespace(rings=rings, record={"warnings": ["idle"]})) == [
        "idle", "inner ring: 15 cells (likewise, with other numbers, at outer ring)", "inner ring, outer ring: oil"]


def test_keys_of_a_passage_have_no_effect_where_nothing_passes(tmp_path):
    """For commands and Python, in the record and at once."""
    said = []
    listener = tehl.Progress()
    listener.warn = said.append
    keys = {"fatigue.exponent": 9.0, "height": 1e-6, "time.courant": 0.3, "time.steps": 3}
    found = tehl.bearing("6206", changes=keys, run=False, folder=tmp_path / "b", progress=listener)
    assert [one.partition(" has no effect here: ")[0] for one in said] == ["feature.height", "fatigue.exponent",
                                                                           "time.courant", "time.steps"]
    assert tehl.open(tmp_path / "b").record["warnings"] == bearing_table.warnings(found) == said
    dent = dict(feature=tehl.Feature(**DENT), run=False, progress=listener)
    dented = tehl.bearing("6206", changes={**keys, "height": -1e-6}, folder=tmp_path / "d", **dent)
    (cut,) = dented.record["warnings"]  # of its scene, as its run would have it
    assert cut.startswith("inner ring: passage cut at ") and len(said) == 4
    steady = tehl.bearing("6206", changes={"time.steady_only": True}, folder=tmp_path / "s", **dent)
    assert not tehl.scene(steady.rings["inner"]["scene_file"]).transient


def test_the_strength_of_the_steel_counts_in_both_rings(tmp_path):
    """A steady ring has an index of its smooth contact; only keys of a passage end at the other ring."""
    keys = {"kappa": 0.5, "endurance": 3e8, "fatigue.residual_xx": -2e8}
    for more in ({}, dict(feature=tehl.Feature(**DENT))):
        changes = {**keys, **({"fatigue.from_x": -2.0} if more else {})}
        found = tehl.bearing("6206", changes=changes, run=False, folder=tmp_path / f"b{len(more)}", **more)
        for ring in found.rings.values():
            fatigue = tehl.scene(ring["scene_file"]).fatigue
            assert (fatigue.kappa, fatigue.endurance, fatigue.residual_xx) == (0.5, 3e8, -2e8)
        assert not found.record["warnings"]


def test_a_folder_of_something_else_is_kept(tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(StoreError, match="is not the folder of a bearing"):
        tehl.bearing("6206", run=False, folder=tmp_path)


def test_another_bearing_does_not_replace_one(tmp_path):
    """The command again does; a bearing of this name under another load would have other scenes."""
    made = [tehl.bearing("6206", **DUTY, run=False, folder=tmp_path / "q") for _ in "ab"]
    assert made[0].record == made[1].record == tehl.open(tmp_path / "q").record
    with pytest.raises(StoreError, match="q holds bearing 6206; choose another path"):
        tehl.bearing("6203", **DUTY, run=False, folder=tmp_path / "q")
    with pytest.raises(StoreError, match="inner.toml holds another scene .* made with other options"):
        tehl.bearing("6206", load=2000.0, run=False, folder=tmp_path / "q")
    with pytest.raises(StoreError, match="q exists and is the folder of a bearing; choose another path"):
        tehl.flank("fzg-c", at=["C"], folder=tmp_path / "q")
    assert tehl.open(tmp_path / "q").record == made[0].record


def test_changed_scene_files_are_kept(tmp_path):
    keys = dict(**DUTY, run=False, folder=tmp_path / "q")
    file = tmp_path / "q" / "inner.toml"
    tehl.bearing("6206", **keys)
    for text in (f"# mine\n{file.read_text()}", file.read_text().replace("nx = 128", "nx = 256"), "not TOML"):
        file.write_text(text)
        if text.startswith("# mine"):
            tehl.bearing("6206", **keys)
        else:
            with pytest.raises(StoreError, match="inner.toml holds another scene than this command makes: it was changed"):
                tehl.bearing("6206", **keys)
        assert file.read_text() == text


def test_results_stay_where_the_command_comes_again_without_a_run(tmp_path, monkeypatch):
    stored = lambda scenes, folder: {0: Outcome(tmp_path / "x.zarr", {"steady": {"h_c_m": 1e-7}})}  # noqa: E731
    monkeypatch.setattr(bearing_run, "stored_outcomes", stored)
    found = tehl.bearing("6206", **DUTY, run=False, folder=tmp_path / "q")
    assert found.rings["inner"]["summary"] == {"steady": {"h_c_m": 1e-7}} and found.rings["outer"]["summary"] is None


def test_a_damaged_file_is_written_again_beside_its_copy(tmp_path, dry):
    folder = tmp_path / "b6206"
    shutil.copytree(dry.folder, folder)
    for n in (1, 2):
        (folder / "bearing.json").write_text('{"name": 1}')
        found = tehl.bearing("6206", **DUTY, roughness=0.1e-6, run=False, folder=folder)
        assert tehl.open(folder).record == found.record
        assert (folder / f"bearing.json.damaged-{n}").read_text() == '{"name": 1}'


@pytest.mark.parametrize("text", ["{", "[]", '{"name": "b", "geometry": 3}', '{"name": "b", "geometry": {}, "inner": 1}'])
def test_a_damaged_folder_is_refused_in_a_sentence(tmp_path, text):
    (tmp_path / "bearing.json").write_text(text)
    with pytest.raises(StoreError, match="bearing.json is damaged .*; repeat the tehl bearing command to write it again"):
        tehl.open(tmp_path)


def test_nothing_else_is_written_into_the_folder_of_a_bearing(dry):
    with pytest.raises(StoreError, match="lies in .*b6206"):
        user_files.check(dry.folder / "other.png")
    user_files.check(dry.folder / "other.png", of=dry.folder)


def test_the_file_that_makes_a_folder_one_of_results_is_named(tmp_path):
    tehl.bearing("6206", **DUTY, run=False, folder=tmp_path / "b")
    for place in ("x.png", "runs/gear-1.zarr"):
        with pytest.raises(StoreError, match=r"results of tehl \(bearing.json\); choose another path"):
            user_files.check(tmp_path / "b" / place)


@pytest.mark.parametrize("name", ["bearing.json", "flank.json", "cam.json"])
def test_saved_output_of_json_makes_no_folder_one_of_results(tmp_path, name):
    """The shell makes the file before the command starts: `tehl bearing 6206 --json > bearing.json`."""
    (tmp_path / name).touch()
    found = here("bearing", "6206", "--no-run", "--json", "--no-figure", cwd=tmp_path)
    assert found.returncode == 0, found.stderr
    (tmp_path / name).write_text(found.stdout)
    assert here("bearing", "6206", "--no-run", "--no-figure", cwd=tmp_path).returncode == 0
    assert {one.name for one in tmp_path.iterdir()} == {name, "runs"} and len([*(tmp_path / "runs").iterdir()]) == 2


@pytest.mark.parametrize("words, said", [
    (("6206", "--dent", "10e-6"), "--dent '10e-6' must have the form DEPTH,WIDTH,rim=HEIGHT"),
    (("6206", "--dent", "1e-6,2e-4,edge=3"), "must have the form DEPTH,WIDTH,rim=HEIGHT"),
    (("6206", "--dent", "1e-6,2e-4", "--scan", "a.csv"), "contradict each other"),
    (("6206", "--pixel", "1e-6"), "--pixel 1e-06 has no effect without --scan"),
    (("6206", "--scan", "none.csv"), "feature.file = 'none.csv' does not exist"),
    (("nothing",), "the inner dimensions of bearing 'nothing' are not in the table")])
def test_wrong_options_are_refused(tmp_path, words, said):
    found = here("bearing", *words, "--no-run", "--no-figure", cwd=tmp_path)
    assert found.returncode == 2 and said in " ".join(found.stderr.split())


def test_commands_print_and_show_a_bearing(tmp_path):
    quick = ("--no-run", "--no-figure")
    found = here("bearing", "mine", "--ball-diameter", 12e-3, "--balls", 9, "--pitch-diameter", 60e-3, "--dent",
                 "2e-6,2e-4,rim=3e-7", *quick, "--out", "b", "--json", cwd=tmp_path)
    assert found.returncode == 0 and json.loads(found.stdout)["name"] == "mine"
    shown = here("show", "b", cwd=tmp_path)
    assert "static safety (ISO 76)" in shown.stdout and "estimated, because not published" in shown.stdout
    assert "Does the bearing carry its load, and how thick is the film? Yes: static safety" in " ".join(shown.stdout.split())
    own = ("--roller-diameter", 8e-3, "--rollers", 18, "--pitch-diameter", 60e-3, "--length", 10e-3)
    roller = here("roller", "--json", *own, *quick, cwd=tmp_path)
    assert json.loads(roller.stdout)["inner"]["contact"] == "line contact of a straight roller"
    assert here("report", "b", cwd=tmp_path).returncode == 0 and (tmp_path / "b.html").stat().st_size > 1e6


@pytest.mark.slow
def test_a_bearing_is_computed(taichi_cpu, tmp_path):
    """Steady films of both rings near those of the formula, with error bars; a repeated call reads them."""
    keys = dict(changes={"oil.name": "mineral-vg100", "temperature": 70.0, "grid.nx": 64, "grid.ny": 16, "thermal.on": False},
                folder=tmp_path / "b", workers=1)
    found = tehl.bearing("6206", **DUTY, **keys)
    for one in found.rings.values():
        film = one["summary"]["steady"]
        assert one["converged"] and film["h_c_m"] == pytest.approx(one["film_formula_m"], rel=0.25)
        assert film["p_max_Pa"] == pytest.approx(one["p_Hertz_Pa"], rel=0.03) and 0 < film["friction_coefficient"] < 0.09
    assert found.rings["inner"]["summary"]["steady"]["h_c_m"] < found.rings["outer"]["summary"]["steady"]["h_c_m"]
    assert tehl.bearing("6206", **DUTY, **keys).record == found.record
    with pytest.raises(StoreError, match="holds another scene"):
        tehl.bearing("6206", load=2000.0, speed=1500.0, **keys)


def test_contacts_that_do_not_run_warn_of_their_scenes(tmp_path):
    """As their runs would: an estimated alpha, of both rings; a run has its own warnings, and both are not listed."""
    changes, quick = {"oil.name": "mineral-vg220"}, {"thermal.on": False, "grid.nx": 32, "grid.ny": 16}
    first = tehl.bearing("6206", changes=changes, run=False, folder=tmp_path / "a")
    (alpha,) = bearing_table.warnings(first)
    assert alpha.startswith("inner ring, outer ring: oil.alpha_40 is not given")
    tehl.bearing("6206", changes={**changes, **quick}, folder=tmp_path / "b", workers=1)
    again = tehl.bearing("6206", changes={**changes, **quick}, run=False, folder=tmp_path / "b")
    assert again.record["warnings"] == [] and sum("alpha_40" in one for one in bearing_table.warnings(again)) == 1
