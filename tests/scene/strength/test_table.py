"""Tables of strength over depth: files, what is refused, what scenes and stores carry, what holds at a depth."""

import json
import pickle
import tomllib

import numpy as np
import pytest
from small_stores import SMALL, store
from values.test_registry import hold

from tehl_taichi.laws.hardness import RELATIONS
from tehl_taichi.scene import Scene, SceneError, scene, scene_file
from tehl_taichi.scene.strength import profiles, scene_tables, table
from tehl_taichi.scene.strength.strength import Strength
from tehl_taichi.store import integrity
from tehl_taichi.store.load_scene import find
from tehl_taichi.store.store import Store

GEAR = scene("gear")
CASE = "# a case\ndepth_mm, hardness_HV, residual_xx_MPa\n0, 700, -400\n\n0.5, 600, -100\n1.5, 400, 50\n"


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "case.csv"
    path.write_text(CASE)
    return path


def strength(made, surface="a"):
    return Strength(made.fatigue, next(s for s in made.surfaces if s.name == surface))


@pytest.mark.parametrize("name", RELATIONS)
def test_every_relation_holds_and_rises_with_the_hardness(name):
    hold(RELATIONS[name])
    made = GEAR.replace(**{"fatigue.relation": name, "fatigue.inclusion": 2e-5}).fatigue
    limits = [RELATIONS[name].constants(HV, made, 0.3, True)[1] for HV in range(100, 900, 25)]
    assert (np.diff(limits) > 0).all()


def test_the_built_in_case_has_its_three_hardnesses():
    found = table.of_text(profiles.PROFILES["case-hardened"])
    assert found.at("hardness_HV", [0.0, 0.8e-3]) == pytest.approx([700.0, 550.0])
    assert found.at("hardness_HV", 5e-3) == pytest.approx(400.0, rel=0.06)  # constant beyond 1.6 mm
    assert (np.diff(found.columns["hardness_HV"]) < 0).all()


def test_a_file_is_linear_between_its_rows_and_constant_beyond(case):
    made = strength(GEAR.replace(**{"fatigue.table": str(case), "fatigue.residual_yy": -1e8}))
    at = {depth: made.at(depth) for depth in (0.0, 0.25e-3, 0.01)}
    assert [one.endurance for one in at.values()] == pytest.approx(
        [1e6 * (197.75 + 0.56833 * HV) for HV in (700, 650, 400)], rel=1e-12)
    assert at[0.01].kappa == pytest.approx(0.017 + 8.27e-4 * 400)
    along, across = made.residual(np.array([0.0, 1e-3]))
    assert along == pytest.approx([-400e6, -25e6]) and across == -1e8


def test_a_shifted_table_has_the_shifted_strength(case, tmp_path):
    shift = tmp_path / "shifted.csv"
    shift.write_text("depth_um,hardness_HV\n100,700\n600,600\n1600,400")
    own, moved = (strength(GEAR.replace(**{"fatigue.table": str(path)})) for path in (case, shift))
    for depth in (0.0, 1e-4, 5e-4, 2e-3):
        assert moved.at(depth + 1e-4).endurance == pytest.approx(own.at(depth).endurance, rel=1e-12)


def test_bodies_may_have_tables_of_their_own(case):
    made = GEAR.replace(**{"fatigue.table": str(case), "fatigue.table_b": "case-hardened"})
    assert strength(made).at(1e-3).endurance != strength(made, "b").at(1e-3).endurance
    plain = GEAR.replace(**{"fatigue.table": str(case), "fatigue.table_b": "none"})
    assert strength(plain, "b").at(1e-3).endurance == 400e6 != strength(plain).at(1e-3).endurance
    alone = GEAR.replace(**{"fatigue.table_b": "case-hardened"})
    assert strength(alone).table is None and strength(alone, "b").table is not None


def test_the_path_begins_at_the_scene_file_and_the_scene_carries_the_numbers(case, tmp_path, monkeypatch):
    path = tmp_path / "mine.toml"
    path.write_text('base = "gear"\n[fatigue]\ntable = "case.csv"\n')
    monkeypatch.chdir("/")
    made = find(path)
    case.unlink()
    copies = [Scene.from_dict(made.to_dict()), pickle.loads(pickle.dumps(made)), made.replace(srr=0.1).replace(srr=-0.12),
              scene_file.from_data(tomllib.loads(scene_file.dumps(made)), "mine")]
    assert all(copy == made and strength(copy).at(3e-4) == strength(made).at(3e-4) for copy in copies)
    assert made != scene("gear").replace(**{"fatigue.table": "case-hardened"})


def test_a_store_needs_no_file(case, tmp_path):
    path = store(tmp_path / "a.zarr", description=SMALL.replace(**{"fatigue.table": str(case)})).path
    case.unlink()
    moved = path.rename(tmp_path / "b.zarr")
    assert strength(Store.open(moved).scene).at(1e-3).endurance == pytest.approx(1e6 * (197.75 + 0.56833 * 500), rel=1e-12)
    assert strength(find(moved)).residual(0.0)[0] == -400e6


def test_another_table_or_none_replaces_the_numbers(case):
    made = GEAR.replace(**{"fatigue.table": str(case)})
    assert made.replace(**{"fatigue.table": ""}) == GEAR
    assert made.replace(**{"fatigue.table": "case-hardened"}) == GEAR.replace(**{"fatigue.table": "case-hardened"})


REFUSED = {
    "depth,hardness_HV\n0,700": r"a column 'depth' \(did you mean 'depth_\w+'\?\); known: depth_m, depth_mm, depth_um",
    "depth_mm,hardness\n0,700": "did you mean 'hardness_HV'",
    "depth_mm,hardness_HV\n0,700\n0.2,nan": "row 2: hardness = nan",
    "depth_mm,hardness_HV\n0,700\n0.2,hard": "row 2: hardness = 'hard' is not a number; allowed: 50 to 1200 HV",
    "depth_mm,hardness_HV\n0,700\n0.2": "row 2 has 1 column; allowed: 2, as in the line of names",
    "depth_mm,hardness_HV\n0,700\n0.2,": "row 2: hardness = '' is not a number",
    "depth_mm,hardness_HV\n0,700\n0.2,650\n0.2,600": "row 3: the depth 200 um does not exceed the one before",
    "depth_mm,hardness_HV\n0,700\n800,400": "row 2: depth = 0.8 m is out of range; allowed: at least 0 m and at most 0.03 m",
    "depth_mm,hardness_HV\n0,60": "",
    "depth_mm,hardness_HV\n0,7000": "row 1: hardness = 7000 HV is out of range",
    "depth_mm,hardness_HV\n0,700\n0,8,550": "row 2 has 3 columns; allowed: 2, as in the line of names",
    "depth_mm;hardness_HV\n0;700\n0.000,8;550": "row 2: depth = '0.000.8' is not a number",
    "depth_mm,limit_Pa\n0,400": "did you mean 400e6 Pa",
    "depth_mm,kappa\n0,0.3": "needed: depth_mm .* and either hardness_HV or limit_MPa",
    "depth_mm,limit_MPa,hardness_HV\n0,400,700": "not both of these",
    "depth_mm,depth_um,hardness_HV\n0,0,700": "two columns of depth",
    "depth_mm,hardness_HV": "0 rows of numbers; allowed: 1 to 500",
    "\n".join(["depth_um,hardness_HV", *(f"{n},700" for n in range(501))]): "501 rows of numbers"}


@pytest.mark.parametrize("content", REFUSED)
def test_a_table_without_sense_is_refused_in_a_sentence(tmp_path, content):
    path = tmp_path / "bad.csv"
    path.write_text(content)
    if not REFUSED[content]:
        GEAR.replace(**{"fatigue.table": str(path)})
        return
    with pytest.raises(SceneError, match=f"fatigue.table = .*{REFUSED[content]}"):
        GEAR.replace(**{"fatigue.table": str(path)})


@pytest.mark.parametrize("changes, said", [
    ({"fatigue.table": "case-hardend"}, "neither a file nor a built-in profile .did you mean 'case-hardened'"),
    ({"fatigue.table": "case-hardened", "fatigue.criterion": "dang-van"}, "gives constants of the criterion findley"),
    ({"fatigue.table": "case-hardened", "fatigue.relation": "murakami"}, "needs the root of the area of the largest"),
    ({"fatigue.table_rows": "depth_m,limit_Pa\n0.0,400"}, "fatigue.table_rows: limit_Pa = 400 Pa is out of range"),
    ({"fatigue.table_rows": "depth_m,limit_Pa\n0.0,4e8\n0.0,4e8"}, "does not exceed the one before"),
    ({"fatigue.table_rows": "depth_m\n0.0"}, "needs hardness_HV or limit_Pa"),
    ({"fatigue.table_rows": "0.0,400"}, "holds no table of strength")])
def test_what_is_no_table_is_refused(changes, said):
    with pytest.raises(SceneError, match=said):
        GEAR.replace(**changes)


@pytest.mark.parametrize("content", [
    "\ufeffdepth_mm;hardness_HV;residual_xx_MPa\n0;700;-400\n0,8;550;-12,5\n",
    "depth_mm\thardness_HV\tresidual_xx_MPa\r\n0\t700\t-400\r\n0.8\t550\t-12.5\r\n",
    "# a comment, first\ndepth_mm, hardness_HV, residual_xx_Pa,\n0,700,-4e8,\n0.8,550,-1.25e7,\n"])
def test_spreadsheets_of_other_countries_give_the_same_table(tmp_path, content):
    path, same = tmp_path / "a.csv", tmp_path / "b.csv"
    path.write_text(content)
    same.write_text("depth_mm,hardness_HV,residual_xx_MPa\n0,700,-400\n0.8,550,-12.5\n")
    assert GEAR.replace(**{"fatigue.table": str(path)}) == GEAR.replace(**{"fatigue.table": str(same)})


def test_binary_files_and_large_ones_are_refused(tmp_path):
    binary, large = tmp_path / "a.csv", tmp_path / "b.csv"
    binary.write_bytes(b"\xff\xfe\x00depth")
    large.write_text("depth_um,hardness_HV\n" + "\n" * 1_100_000)
    for path in (binary, large, tmp_path):
        with pytest.raises(SceneError, match="fatigue.table = "):
            GEAR.replace(**{"fatigue.table": str(path)})


def test_a_limit_of_a_contact_beside_residual_stress_is_doubted():
    def doubted(**changes):
        made = GEAR.replace(**{f"fatigue.{key}": value for key, value in changes.items()})
        return any(one.code == "residual" for one in made.warnings())

    assert not doubted(limit_of="contact") and not doubted(residual_xx=-2e8)
    assert doubted(limit_of="contact", residual_xx=-2e8)


@pytest.mark.parametrize("rows, relation, said", [
    ("0.0,900.0\n0.001,400.0", "ss2506", "the table has 400 to 900 HV; fatigue.relation = ss2506 is used for 350 to 800 HV"),
    ("0.0,700.0\n0.001,300.0", "ss2506", "300 to 700 HV"), ("0.0,700.0\n0.001,400.0", "ss2506", ""),
    ("0.0,700.0\n0.001,400.0", "rotating-bending", "120 to 640 HV"), ("0.0,800.0\n0.001,350.0", "ss2506", "")])
def test_a_hardness_beyond_the_relation_is_doubted(rows, relation, said):
    made = GEAR.replace(**{"fatigue.table_rows": f"depth_m,hardness_HV\n{rows}", "fatigue.relation": relation})
    found = [one for one in made.warnings() if one.code == "hardness"]
    assert len(found) == bool(said) and all(said in one for one in found)
    assert not [one for one in made.replace(**{"fatigue.on": False}).warnings() if one.code == "hardness"]


def test_a_store_of_a_relation_that_is_not_installed_names_it():
    data = GEAR.to_dict()
    assert integrity.missing_choice(json.dumps(data)) == ""
    data["fatigue"]["relation"] = "mine"
    found = integrity.missing_choice(json.dumps(data))
    assert found.startswith("fatigue.relation = 'mine', which is not installed here; known: mur")


@pytest.mark.parametrize("key", ["exponent", "weibull"])
def test_an_exponent_is_none_or_one_at_least(key):
    assert getattr(GEAR.replace(**{f"fatigue.{key}": 1.0}).fatigue, key) == 1.0
    with pytest.raises(SceneError, match=f"fatigue.{key} = 0.5 is out of range; allowed: 0, or at least 1 and"):
        GEAR.replace(**{f"fatigue.{key}": 0.5})


def written(folder, head, *rows):
    path = folder / f"{len(list(folder.iterdir()))}.csv"
    path.write_text("\n".join((head, *rows)) + "\n")
    return str(path)


def test_inclusions_weaken_the_surface_more_than_the_depth(tmp_path):
    """Murakami: 1.43 at the surface, 1.56 inside, of equal hardness; a depth of less than an inclusion is the surface."""
    even = written(tmp_path, "depth_um,hardness_HV", "0,600", "1000,600")
    made = strength(GEAR.replace(**{"fatigue.table": even, "fatigue.relation": "murakami", "fatigue.inclusion": 64e-6}))
    surface, inside, deep = (made.at(depth).endurance for depth in (0.0, 50e-6, 1e-3))
    assert deep / surface == pytest.approx(1.56 / 1.43, rel=1e-6) and inside == surface


def test_kappa_of_the_table_comes_before_that_of_the_relation(tmp_path):
    rows = written(tmp_path, "depth_um,hardness_HV,kappa", "0,600,0.21", "1000,600,0.25")
    made = strength(GEAR.replace(**{"fatigue.table": rows}))
    assert made.at(0.0).kappa == 0.21 and made.kappas([1e-3]) == [0.25]


@pytest.mark.parametrize("axis", ["xx", "yy"])
def test_one_column_of_residual_stress_makes_it_vary(tmp_path, axis):
    rows = written(tmp_path, f"depth_um,limit_MPa,residual_{axis}_MPa", "0,400,-300", "100,400,0")
    assert strength(GEAR.replace(**{"fatigue.table": rows})).varies_in_residual


def test_both_tables_are_named(tmp_path):
    one, two = (written(tmp_path, "depth_um,limit_MPa", f"0,{limit}") for limit in (400, 500))
    made = GEAR.replace(**{"fatigue.table": one, "fatigue.table_b": two}).fatigue
    assert [scene_tables.name_of(made, surface) for surface in "ab"] == ["0.csv", "1.csv"]
    assert "0.csv and 1.csv" in scene_tables.words(made)
