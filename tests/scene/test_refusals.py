"""Scenes that are refused, each in one sentence that speaks of what the user wrote."""

import dataclasses
import math
import tomllib

import pytest

import tehl_taichi as tehl
from tehl_taichi.runs.sweep import study_file
from tehl_taichi.scene import Scene, SceneError, scene, scene_file
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.sections import Body, Contact, Time
from tehl_taichi.store.load_scene import find, find_changed
from tehl_taichi.values import plugins


def refused(call, *words):
    """The one line in which `call` is refused; it has all of the words."""
    with pytest.raises(SceneError) as caught:
        call()
    sentence = str(caught.value)
    assert all(word in sentence for word in words) and len(sentence.splitlines()) == 1 and len(sentence) < 450, sentence


def parsed(text):
    return scene_file.from_data(tomllib.loads(text), "mine")


GEAR = 'base = "gear"\n'


@pytest.mark.parametrize("text, words", [
    ('[oil]\nname = "moes-test-fuid"', ("did you mean 'moes-test-fluid'", "oil.viscosity missing")),
    ('[oil]\nname = "mine"\nviscosity = "barus"\nalpha = 2e-8', ("'mine'", "oil.eta0 missing")),
    ('[oil]\nname = []', ("oil.name = []", "text")),
    ('[oil]\nname = ""', ("oil.name = ''",)),
    ('oil = 3', ("[oil]", "table", "3")),
    ('operation = 3', ("[operation]", "table", "3")),
    ('bodies = 3', ("[bodies.a]", "3")),
    ('feature = 3', ("[[feature]]", "3")),
    ('feature = [3]', ("[feature]", "table", "3")),
    ('contact = []', ("[contact]", "table")),
    ('name = 3', ("name = 3", "text")),
    ('name = "../x"', ("'../x'", "path separators")),
    ('name = "a\\nb"', ("a\\nb", "one line")),
    ('name = " "', ("name = ' '", "not empty")),
    ('name = ".."', ("name = '..'", "a name")),
    (f'name = "{"x" * 101}"', ("101 characters", "at most 100")),
    ('[operation]\nu_a = "x"\nu_b = 1.0', ("operation.u_a = 'x'", "not a number", "m/s")),
    ('[operation]\nu_a = 1.0', ("u_a and u_b together",)),
    ('[operation]\nu_a = 1.0\nu_b = 2.0\nsrr = 0.1', ("u_a and u_b together, or u_m and srr",)),
    ('[contact]\nload = 1e6\nhertz_pressure = 1e9', ("exactly one", "load, hertz_pressure")),
    ('[contact]\nmoes_M = 100.0\nmoes_L = 10.0\n[operation]\nu_m = 5.0', ("operation.u_m = 5", "moes_L = 10", "contradict")),
    ('[time]\nsteady_only = true\nsteps = 5', ("steady_only", "steps = 5", "contradict")),
    ('[fatigue]\nfrom_x = "abc"', ("fatigue.from_x = 'abc'", "not a number")),
    ('[fatigue]\nfrom_x = nan', ("fatigue.from_x = nan", "not a number")),
    ('[thermal]\non = 1', ("thermal.on = 1", "true, false or 'auto'")),
    (f'[contact]\nload = {"1" * 400}', ("contact.load = 111", "at most 1e+10 N/m")),
    (f'[grid]\nnx = {"1" * 400}', ("grid.nx = 111", "32 to 8192")),
    ('[grid]\nny = [[[[[[[[[[1]]]]]]]]]]', ("grid.ny", "whole number")),
    ('[bodies.b]\nE = -1.0', ("bodies.b.E = -1 Pa", "at least 1e+06 Pa")),
    ('[bodies.a]\nalpha = "x"', ("bodies.a.alpha = 'x'", "1/K")),
    ('[[feature]]\n[[feature]]\nheight = 1.0', ("feature.1.height = 1 m", "at most 0.001 m")),
    ('[[feature]]\nfile = 3', ("feature.file = 3", "text")),
    ('[nonsense]\nx = 1', ("'nonsense'", "known:")),
    ('"a\\nb" = 1', ("a\\nb",)),
])
def test_scene_files(text, words):
    refused(lambda: parsed(GEAR + text), *words)


def test_a_base_is_a_name_of_a_scene():
    refused(lambda: parsed("base = []"), "base = []", "text")
    refused(lambda: parsed('base = "gaer"'), "'gaer'", "did you mean 'gear'")


@pytest.mark.parametrize("text, words", [(3000 * "[" + 3000 * "]", "too deeply"), (5000 * "1", "not valid TOML"),
                                         ("", "not valid TOML")], ids=["nested", "digits", "broken"])
def test_files_that_python_cannot_parse(text, words, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(f"a = {text}")
    refused(lambda: scene_file.load(path), words, "mine.toml")


@pytest.mark.parametrize("key, value, low, high", [
    ("k1", math.nan, 0, 1e-7), ("b1", "x", -1e-7, 1e-7), ("A1", math.nan, 0, 1e4), ("Gamma0", "40", -100, 300),
    ("Dz", math.inf, -5, 5), ("Cz", [], -5, 5), ("k2", -1.0, 0, 1e-7), ("c1", True, 0, 1e-7), ("c2", None, 0, 1e-7),
    ("b0", 1.0, -1e-2, 1e-2),
    ("b2", 1.0, -1e-15, 1e-15), ("A2", -1.0, 0, 1e-6), ("B1", 11.0, 0, 10), ("B2", {}, 0, 1e-6), ("C1", 0.0, 0.1, 100),
    ("C2", math.nan, 0.1, 1e3), ("Tg0", 1e3, -250, 200), ("eta_g", 0.0, 1, 1e20), ("p_r", 0.0, 1e6, 1e10),
])
def test_every_number_of_an_oil(key, value, low, high):
    refused(lambda: Oil(**{key: value}), f"oil.{key} = ", f"at least {low:g}", f"at most {high:g}")


@pytest.mark.parametrize("call, words", [
    (lambda: tehl.Contact(lod=1e6), ("unknown key Contact.lod", "did you mean 'load'", "moes_M")),
    (lambda: tehl.Scene(feature=[]), ("unknown key Scene.feature", "did you mean 'features'")),
    (lambda: tehl.Feature(lebel="mean"), ("unknown key Feature.lebel", "did you mean 'level'")),
    (lambda: tehl.GearPair(tork=3), ("unknown key GearPair.tork", "did you mean 'torque'")),
])
def test_an_unknown_key_of_a_class_names_the_nearest_one(call, words):
    refused(call, *words)


@pytest.mark.parametrize("field", dataclasses.fields(Oil), ids=lambda field: field.name)
def test_no_value_of_an_oil_is_unchecked(field):
    refused(lambda: Oil(**{field.name: math.nan if field.type is float else 3}), f"oil.{field.name} = ")


@pytest.mark.parametrize("table", [[1, 2], "x", [[0.0, 1.0]], [[1e9, 1.0], [0.0, 2.0]], [[0.0, "a"], [1e9, 2.0]],
                                   [[0.0, math.nan], [1e9, 2.0]], [[0.0, 1.0, 2.0], [1e9, 2.0]],
                                   [[n * 1e6, 1.0] for n in range(101)]])
def test_viscosity_tables(table):
    refused(lambda: Oil(viscosity="table", table=table), "oil.table")


@pytest.mark.parametrize("oil, words", [
    (dict(viscosity="houpert", eta0=1e-5), ("6.32e-05 Pa s",)),
    (dict(Dz=-0.1), ("Z = ", "more than 0")),
    (dict(viscosity="yasutomi", C2=5.0), ("Yasutomi", "C2 + (T - Tg) F", "1.93e+09 Pa")),
    (dict(viscosity="yasutomi", B1=2.0), ("Yasutomi", "F = 1 - B1 ln(1 + B2 p)")),
    (dict(b0=-1e-2, b1=0.0, b2=0.0), ("heat capacity",)),
    (dict(density="tait", tait_K00=1e9, tait_K1=4.0), ("oil.tait_K00", "of the volume at 9.67e+09 Pa", "at least 0.3")),
])
def test_laws_without_a_value_in_this_contact(oil, words):
    refused(lambda: dataclasses.replace(scene("gear"), oil=Oil(**oil)), *words)


def test_a_density_that_heat_leaves_nothing_of():
    hot = scene("gear").replace(temperature=200.0)
    refused(lambda: dataclasses.replace(hot, oil=Oil(beta0=9e-3)), "oil.beta0", "200 deg C")


def test_a_new_name_needs_the_numbers_of_its_law_in_python_too():
    refused(lambda: scene("gear").replace(**{"oil.name": "mine"}), "'mine'", "oil.viscosity missing")
    refused(lambda: Scene.from_dict({"oil": {"name": "refrence-pao"}}), "did you mean 'reference-pao'")
    new = {"oil.name": "mine", "oil.viscosity": "roelands", "oil.eta0": 0.1, "oil.alpha": 2e-8, "oil.Z": 0.6}
    oil = scene("gear").replace(**new).oil
    assert (oil.name, oil.eta0, oil.rho0, oil.source) == ("mine", 0.1, 853.0, "not given")
    again = Scene.from_dict(scene("gear").replace(**new).to_dict())  # as a store and a file written out have it
    assert again.oil == oil and again.replace(**{"oil.Z": 0.5}).oil.name == "mine"
    renamed = {**scene("gear").to_dict()["oil"], "name": "shop oil"}
    assert Scene.from_dict({**scene("gear").to_dict(), "oil": renamed}).oil.name == "shop oil"


def test_a_named_oil_comes_before_its_changes():
    oil = scene("gear").replace(**{"oil.alpha": 2e-8, "oil.name": "moes-test-fluid"}).oil
    assert oil.viscosity == "roelands" and oil.alpha == 2e-8


@pytest.mark.parametrize("changes, words", [
    ({"load": 1e6, "hertz_pressure": 1e9}, ("load = 1000000.0 and hertz_pressure = 1000000000.0 contradict",)),
    ({"srr": 0.1, "operation.srr": 0.2}, ("srr = 0.1 and operation.srr = 0.2 contradict",)),
    ({"height": 1e-6, "feature.0.height": 2e-6}, ("height = 1e-06 and feature.0.height = 2e-06 contradict",)),
    ({"operation.u_a": 1.0, "operation.u_b": 2.0, "speed": 3.0}, ("operation.u_a = 1.0 and speed = 3.0 contradict",)),
    ({"contact.moes_M": 100.0, "contact.moes_L": 10.0, "speed": 3.0}, ("contact.moes_M = 100.0 and speed = 3.0 contradict",)),
    ({"time.steady_only": True, "time.steps": 3}, ("time.steady_only = True and time.steps = 3 contradict",)),
    ({"oil.alpha": 1e-8}, ("oil.alpha = 1e-08 has no effect", "G0, S0, Dz, Cz")),
    ({"feature.length": math.inf, "feature.extent_x": 5e-4, "feature.shape": "waviness"},
     ("feature.length = inf m", "length = 0")),
    ({"feature.length": 1e-4, "feature.shape": "ridge"}, ("feature.length = 0.0001 has no effect", "shape 'ridge' does not",
                                                          "waviness")),
    ({"feature.extent_x": 1e-4}, ("feature.extent_x = 0.0001 has no effect", "shape 'cosine'")),
    ({"srr": 0.0, "operation.u_a": 1.0, "operation.u_b": 2.0}, ("operation.u_a = 1.0 and srr = 0.0 contradict",)),
    ({"feature.1.height": 1e-6}, ("feature.1.height", "has 1 feature; add one in a scene file, as [[feature]]")),
    ({"bodies.yield_stress": 2e9}, ("unknown key bodies.yield_stress; each body has its own keys, as bodies.a.yield_stress",)),
    ({"bodies.foo": 1.0}, ("unknown key bodies.foo; each body has its own keys, as bodies.a.E",)),
    ({"zoom": 2}, ("[zoom] must be a table of keys and values, not 2; set its keys, as zoom.factor",)),
    ({"grid": "64x16"}, ("[grid] must be a table", "not '64x16'; set its keys, as grid.nx and grid.ny")),
    ({"feature.0.foo.height": 1e-6}, ("unknown key feature.0.foo.height",)),
    ({"operation.u_a": 1.0}, ("u_a and u_b together",)),
    ({"load": 1e3}, ("contact.load = 1000 N/m", "half-width", "at most 1.1e-06 m", "undeformed gap", "more load")),
])
def test_changes_in_python(changes, words):
    refused(lambda: scene("gear").replace(**changes), *words)


def test_what_says_the_same_twice_is_no_contradiction():
    s = scene("gear").replace(**{"srr": 0.1, "operation.srr": 0.1, "contact.load": 0.0, "hertz_pressure": 1e9})
    assert s.operation.srr == 0.1 and s.contact.load == 0
    by_surface = scene("gear").replace(**{"operation.u_a": 8.0, "operation.u_b": 9.0}).operation
    assert (by_surface.u_m, by_surface.srr, by_surface.temperature) == pytest.approx((8.5, -1 / 8.5, 90.0))
    moes = {"contact.moes_M": 100.0, "contact.moes_L": 10.0, "oil.name": "moes-test-fluid", "contact.load": 0}
    pair = scene("smooth-line").replace(**moes)
    refused(lambda: pair.replace(speed=5.0), "operation.u_m = 5.0", "no effect", "moes_L = 10")
    assert Scene.from_dict(pair.to_dict()) == pair == scene_file.from_data(tomllib.loads(scene_file.dumps(pair)), "x")
    assert pair.replace(load=1e6).contact.moes_M == 0
    assert scene("gear").replace(**{"time.steps": 5}).replace(**{"time.steady_only": True}).time == Time(steady_only=True)


@pytest.mark.parametrize("words, sentence", [
    ("--load 1e6 --hertz-pressure 1e9", "--load 1e+06 and --hertz-pressure 1e+09 contradict"),
    ("--isothermal --set thermal.on=1", "--isothermal and --set thermal.on=1 contradict"),
    ("--thermal --set thermal.on=false", "--thermal and --set thermal.on=false contradict"),
    ("--height 1e-6 --set feature.height=2e-6", "--height 1e-06 and --set feature.height=2e-6 contradict"),
    ("--steady --steps 3", "--steady and --steps 3 contradict"),
    ("--srr 0.1 --set operation.srr=0.2", "--srr 0.1 and --set operation.srr=0.2 contradict"),
    ("--srr 0.1 --set operation.u_a=3 --set operation.u_b=4", "--set operation.u_a=3 and --srr 0.1 contradict"),
    ("--speed 3 --set operation.u_a=3 --set operation.u_b=4", "--set operation.u_a=3 and --speed 3 contradict"),
    ("--grid 64x16 --set grid.nx=128", "--grid 64x16 and --set grid.nx=128 contradict"),
    ("--set oil.k0=0.1 --set oil.k0=0.2", "--set oil.k0=0.1 and --set oil.k0=0.2 contradict"),
    ("--target-error 1% --set grid.nx=128", "--target-error 1% chooses the grid"),
    ("--speed 5 --set contact.moes_M=100 --set contact.moes_L=10", "--set contact.moes_M=100 and --speed 5 contradict"),
    ("--set oil.name=moes-test-fuid", "did you mean 'moes-test-fluid'"),
    ("--set name=../x", "path separators"),
    (f"--set contact.load={'1' * 5000}", "contact.load = '1111"),
    (f"--set contact.load={'[' * 3000}", "contact.load = '[[["),
])
def test_options(words, sentence, tmp_path, monkeypatch):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(app, ["run", *words.split()])
    assert isinstance(done.exception, SceneError) and done.exception.exit_code == 2
    refused(lambda: (_ for _ in ()).throw(done.exception), sentence)
    assert not list(tmp_path.iterdir())


def test_parts_of_another_kind():
    refused(lambda: Scene(contact=3), "contact = 3", "Contact")
    refused(lambda: Scene(features=[Feature(), 3]), "features", "Feature")
    refused(lambda: Scene.from_dict([]), "table of sections")
    refused(lambda: Body(E="x"), "bodies.E")
    refused(lambda: Contact(load=10**400), "contact.load = 1000")
    assert Scene(features=[Feature()]).features == (Feature(),)


@pytest.mark.parametrize("base", ('base = "gear"\n', ""))
def test_what_is_set_may_be_what_a_file_needs(tmp_path, base):
    """The file alone is refused; with what is given beside it it is as if that stood in the file."""
    path = tmp_path / "mine.toml"
    path.write_text(base + '[[feature]]\nheight = 1e-6\n[grid]\nx_max = 0.2\n[oil]\nname = "mineral-vg68"\n')
    with pytest.raises(SceneError, match="grid.x_max = 0.2"):
        find_changed(path, {})
    with pytest.raises(SceneError, match="grid.x_max = 0.3"):
        find_changed(path, {"grid.x_max": 0.3})
    found = find_changed(path, {"grid.x_max": 1.5, "feature.0.height": 2e-6, "operation.srr": 0.1})
    path.write_text(path.read_text().replace("x_max = 0.2", "x_max = 1.5").replace("1e-6", "2e-6"))
    assert found == find_changed(path, {"srr": 0.1}) == find(path).replace(srr=0.1) and found.oil.name == "mineral-vg68"
    with pytest.raises(SceneError, match="did you mean 'width'"):
        find_changed(path, {"feature.0.wdth": 2e-6})


@pytest.mark.parametrize("line, words", [
    ("srr = -0,2", ("line 3 has a decimal comma; TOML needs a point: -0.2",)),
    ("srr = 1,5e-3  # of it", ("line 3", "1.5e-3",)), ("srr = -0;2", ("Expected newline", "line 3"))])
def test_a_decimal_comma_is_named(line, words, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(f'base = "gear"\n[operation]\n{line}\n[grid]\nnx = 128\n')
    refused(lambda: scene_file.load(path), "mine.toml is not valid TOML", *words)


@pytest.mark.parametrize("text, read", [
    ('base = "gear"\n[grid]\nnx = 64\n', lambda path: scene_file.load(path).grid.nx == 64),
    ('[over]\nsrr = [0.1, 0.2]\n', lambda path: study_file.is_study_file(path) and study_file.load(path).count == 2),
    ('plugins = ["mine"]\n', lambda path: plugins._toml(path) == {"plugins": ["mine"]})])
def test_the_mark_that_some_editors_put_first(text, read, tmp_path):
    (tmp_path / "mine.toml").write_text(text, encoding="utf-8-sig")
    assert read(tmp_path / "mine.toml")


FILES = (GEAR, "[contact]\nload = 1.1e6\n", GEAR + "[operation]\nu_a = 7.0\nu_b = 9.0\n",
         GEAR + '[oil]\nname = "mineral-vg68"\n[bodies.a]\nmaterial = "100Cr6"\n[bodies.b]\nE = 3e11\n',
         GEAR + '[oil]\nname = "mineral-vg220"\nk0 = 0.2\n',
         '[contact]\nload = 1.1e6\n[[feature]]\nwidth = 300e-6\n[[feature]]\n',
         GEAR + "[fatigue]\ntorsion_limit = 4e8\n", GEAR + "[fatigue]\ntorsion_limit = 4e8\nbending_limit = 6e8\n",
         GEAR + "[oil]\nnu_40 = 220e-6\nnu_100 = 19e-6\nrho_15 = 890\n", 'base = "furrow-line"\n[grid]\nnx = 512\n')
CHANGES = ({"srr": 0.1}, {"speed": 5.0}, {"operation.u_a": 8.0, "operation.u_b": 9.0}, {"hertz_pressure": 2e9},
           {"contact.load": 1.2e6}, {"oil.k0": 0.1}, {"oil.name": "reference-pao"}, {"bodies.a.material": ""},
           {"bodies.b.material": "16MnCr5"}, {"oil.nu_40": 320e-6, "oil.nu_100": 24e-6}, {"oil.rho0": 870.0},
           {"time.steady_only": True}, {"name": "other", "feature": []}, {"height": 1e-6}, {"oil.alpha_40": 2e-8},
           {"kappa": 0.4}, {"endurance": 5e8}, {"torsion_limit": 4.2e8}, {"bending_limit": 6.2e8, "torsion_limit": 4.2e8},
           {"kappa": 0.2, "bending_limit": 6e8}, {"fatigue.criterion": "matake"}, {"torsion_limit": 4e8, "endurance": 5e8},
           {"oil.name": "shop", "oil.viscosity": "barus", "oil.eta0": 0.1, "oil.alpha": 2e-8})


def outcome(make):
    try:
        return make()
    except SceneError as error:
        return str(error)


@pytest.mark.parametrize("changes", CHANGES, ids=lambda changes: ",".join(changes))
@pytest.mark.parametrize("text", FILES, ids=range(len(FILES)))
def test_a_change_of_a_file_is_that_of_its_scene(text, changes, tmp_path):
    """Where a file needs no help, it makes no difference whether its changes come before or after it is judged."""
    path = tmp_path / "mine.toml"
    path.write_text(text)
    assert outcome(lambda: find_changed(path, changes)) == outcome(lambda: find(path).replace(**changes))


@pytest.mark.parametrize("text", ["oil = 3", "operation = 3", "bodies = 3", "[bodies]\na = 3", "feature = 3", "feature = [3]",
                                  "contact = []", "time = 1", "[oil]\nname = []"])
@pytest.mark.parametrize("changes", CHANGES, ids=lambda changes: ",".join(changes))
def test_what_is_no_table_is_refused_whatever_is_changed(text, changes, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(GEAR + text)
    said = outcome(lambda: find_changed(path, changes))
    repaired = {"oil.name", "feature"} & changes.keys() or "oil.nu_40" in changes and "name" in text
    assert isinstance(said, str) or repaired and said == find_changed("gear", changes).replace(name=said.name)


@pytest.mark.parametrize("text, changes", [
    ('[oil]\nname = "mine"\nviscosity = "barus"\nalpha = 2e-8', {"oil.eta0": 0.1}),
    ("[oil]\nnu_40 = 220e-6", {"oil.nu_100": 19e-6}), ("[operation]\nu_a = 8.0", {"operation.u_b": 9.0}),
    ('[operation]\nsrr = "x"', {"srr": 0.1}), ("[fatigue]\nendurance = 400", {"endurance": 400e6}),
    ("[contact]\nload = 350", {"load": 350e3}),
    ('[contact]\nmoes_M = 100.0\nmoes_L = 10.0\n[operation]\nu_m = 5.0', {"load": 1e6}),
    ('[bodies.a]\nmaterial = "100Cr7"', {"bodies.a.material": "100Cr6"})])
def test_what_repairs_a_file(text, changes, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(GEAR + text)
    refused(lambda: find(path))
    found = find_changed(path, changes)
    section = next(iter(changes)).partition(".")[0]
    assert found.name == "mine" and (section not in ("oil", "bodies") or found != scene("gear").replace(name="mine"))
