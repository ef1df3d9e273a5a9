"""Keys without effect: whatever is given either changes what a run takes, or is said to have none."""

import dataclasses
import itertools
import math
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.laws import conduction, density, rheology, sheared_flow
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.laws.solid_friction import boundary_stress
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.pressure.conditions import conditions
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.scene import BUILT_INS, Scene, data_sheet, idle_keys, keys, named_oils, run_in, scene_file
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.named_oils import OILS
from tehl_taichi.scene.named_steels import STEELS
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.sections import Body, Contact, Fatigue, Rheology, Thermal, Time
from tehl_taichi.scene.strength.strength import Strength
from tehl_taichi.scene.timeline import step_length, total_steps
from tehl_taichi.values.quantity import Choice, Count, CountOf, Numbers, Pairs, Switch, Text

GEAR = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16})


def passing(*features):
    """The gear contact with these features."""
    return dataclasses.replace(GEAR, features=features)


def measured(*shape, **changes):
    """Random heights of this shape, of which a part passes, beside the axis."""
    heights = 1e-6 * np.random.default_rng(4).random(shape)
    part = {"level": "mean", "cutoff": 2e-5, "taper": 5e-5, "y": 4e-5, "x": -3e-5, "extent_x": 2e-4, "extent_y": 2e-4}
    return Feature.from_heights(heights, 5e-6, **{**part, **changes})


GROUND = {"shape": "ground", "height": 2e-7, "width": 9.2e-5, "extent_x": 4e-4, "extent_y": 5e-4, "taper": 5e-5}
SCENES = {
    "gear": GEAR, "steady": GEAR.replace(**{"time.steady_only": True}), "pure rolling": GEAR.replace(srr=0.0),
    "isothermal": GEAR.replace(**{"thermal.on": False}), "without fatigue": GEAR.replace(**{"fatigue.on": False}),
    "smooth": tehl.scene("smooth-line"), "ball": tehl.scene("ball-on-disc"), "ridge on ball": tehl.scene("ridge-on-ball"),
    "furrow": tehl.scene("furrow-line"), "rough": tehl.scene("rough"),
    "two": dataclasses.replace(GEAR, features=(Feature(), Feature(shape="ridge", height=-5e-7, x=-4e-4))),
    "waves": dataclasses.replace(GEAR, features=(Feature(shape="waviness", height=1e-7, width=1e-4, extent_x=3e-4,
                                                         taper=5e-5),)),
    "dent": passing(Feature(shape="dent", height=-1e-6, width=4e-4, rim=2e-7)),
    "ground": passing(Feature(**GROUND, length=9.5e-5, y=5e-5)),
    "ground marks": passing(Feature(**GROUND, length=math.inf, shortest_x=1.5e-4)), "map": passing(measured(61, 71)),
    "profile": passing(measured(71)), "longitudinal": passing(measured(71, lay="longitudinal")),
    "endless profile": passing(measured(71, extent_y=0.0)),
    "eyring": GEAR.replace(**{"rheology.law": "eyring", "thermal.on": False}),
    "newtonian": tehl.scene("smooth-line").replace(**{"rheology.law": "newtonian"}),
    "data sheet": tehl.scene("smooth-line").replace(**{"oil.nu_40": 220e-6, "oil.nu_100": 19e-6, "thermal.on": False}),
    "moes": tehl.scene("smooth-line").replace(**{"contact.moes_M": 20.0, "contact.moes_L": 10.0}),
    "hardness": GEAR.replace(**{"fatigue.table": "case-hardened"}),
    "bending": GEAR.replace(**{"fatigue.table": "case-hardened", "fatigue.relation": "rotating-bending"}),
    "inclusions": GEAR.replace(**{"fatigue.table": "case-hardened", "fatigue.relation": "murakami",
                                  "fatigue.inclusion": 3e-5, "fatigue.table_b": "none"}),
    "whole table": GEAR.replace(**{"fatigue.table_rows": "depth_m,limit_Pa,kappa,residual_xx_Pa,residual_yy_Pa\n"
                                                         "0.0,5e8,0.4,-4e8,-3e8\n0.001,4e8,0.3,1e8,1e8"}),
    "life": GEAR.replace(**{"fatigue.exponent": 9.0, "fatigue.weibull": 24.0}),
    "one body": GEAR.replace(**{"fatigue.table_b": "case-hardened", "fatigue.surfaces": "a"}),
    "run-in": GEAR.replace(**{"time.run_in": 2, "bodies.a.yield_stress": 2.2e9}),
    "tait": GEAR.replace(**{"oil.density": "tait"})}
CASES = [(name, key) for name, scene in SCENES.items() for key, kind, _ in keys.every(scene) if not isinstance(kind, Text)]


def prepared(scene):
    """The numbers that a run of the scene takes, in no order that a user knows of, one text after another."""
    s, g = Scales.of(scene), scene.grid
    x, y = np.linspace(g.x_min, g.x_max, 97), np.linspace(-1, 1, 9) * g.y_max if scene.rows else np.zeros(1)
    found = [s, scene.body_a.yield_stress, scene.body_b.yield_stress, _speeds(conditions(scene, s, x)), g.nx, g.x_min, g.x_max,
             g.inlet, scene.rows, scene.numerics, scene.at_rest, scene.rows and (g.y_max, s.curvature)]
    return map(repr, itertools.chain(found, _fatigue(scene), _heat(scene), _laws(scene, s), _passage(scene, s, x, y)))


def differs(scene, now):
    """Whether a run of the scene takes other numbers than `now`; looks no further than to the first of them."""
    return any(one != other for one, other in itertools.zip_longest(prepared(scene), now))


def _speeds(record):
    return [record[name] for name in record.places if name != "inlet"]  # which acts by way of laws alone


def _laws(scene, s):
    inlet, warmer = scene.operation.temperature, (0,) if scene.isothermal else (0, 9, 50)
    places = [(p * s.p_H, inlet + T) for p in (0, 0.3, 1) for T in warmer]
    rho, r = density.rho_ratio if scene.isothermal else density.rho_film, scene.rheology
    oil = scene.film_oil if scene.isothermal else scene.oil
    yield [(float(ln_eta(oil, *at)), float(rho(oil, *at))) for at in places]
    tau, p = (one.ravel() for one in np.meshgrid((1e6, 1e8), [p for p, _ in places]))
    yield [one.tolist() for one in (rheology.shear_stress(r, tau, p), *_flows(r, tau, p), sheared_flow.wall_limit(r, p))]
    yield r.film_floor, r.law
    if scene.operation.u_s:
        yield [boundary_stress(r, p) for p in (1e6, 1e8, 1e9)]


def _flows(r, tau, p):
    """What the film carries by pressure, along the sliding and across it, and the stress that it shears at."""
    yield from (part for along in (True, False) for law in sheared_flow.either(r, along, 0.3 * tau, 0.3 * tau, tau, p)
                for part in law)
    yield from (sheared_flow.mean_stress(r, 0.3 * tau, tau, p), sheared_flow.wall_slip(r, 0.3 * tau, tau, p))


def _heat(scene):
    if not scene.isothermal:
        yield [(b.k, b.rho * b.c, b.k * b.rho) for b in (scene.body_a, scene.body_b)], scene.thermal.nodes, scene.thermal.rounds
        yield scene.thermal.tolerance, scene.output.profiles
        yield [(conduction.conductivity(scene.oil, p), conduction.heat_capacity(scene.oil, p, T)) for p in (0, 5e8)
               for T in (30, 60, 90)]


def _passage(scene, s, x, y):
    if not scene.transient:
        return
    yield [(s.name, s.speed, len(s.features)) for s in scene.surfaces]
    yield step_length(scene), total_steps(scene), scene.path, scene.output.every, scene.symmetric
    yield scene.zoom if scene.zooms else None
    yield scene.runs_in and (scene.time.run_in, [(s.name, s.body.hardening) for s in run_in.yielding_surfaces(scene)])
    for at in np.linspace(*scene.path, 7):
        yield [hash((f.height_at((x[None] - one.pace * at) * s.a - f.x, y[:, None] * s.b - f.y) + 0.0).tobytes())
               for one in scene.surfaces for f in one.features]


def _fatigue(scene):
    f = scene.fatigue
    if scene.judges_steel and not scene.transient:  # the contact alone
        yield [list(_index(Strength(f, s), depth)) for s in scene.judged for depth in (0.0, 1e-5, 3e-4)], f.criterion
        yield f.depths, f.shear, [(s.name, s.body.nu, scene.has_thermal_stress and s.body.alpha) for s in scene.judged]
    if scene.has_fatigue:
        yield [list(_index(Strength(f, s), depth)) for s in scene.judged for depth in (0.0, 1e-5, 3e-4)], f.criterion
        yield f.length if f.length >= 2 * Scales.of(scene).a * (scene.grid.x_max - scene.grid.x_min) / scene.grid.nx else None
        yield f.exponent and (f.exponent, f.limit_cycles)
        yield f.weibull and f.depths and (f.weibull, f.reference_volume, f.reference_area)
        yield f.depths, f.shear, f.from_x, f.to_x, scene.has_thermal_stress
        yield [(s.name, s.body.nu, scene.has_thermal_stress and s.body.alpha) for s in scene.judged]


def _index(strength, depth):
    """Of two normal stresses at a depth, by what holds there."""
    local, (along, across) = strength.at(depth), map(float, strength.residual(depth))
    for n in (3e8, 1e9):
        yield CRITERIA[local.criterion].value(1e8, n + along - across / 3, n + along / 3 + across,
                                              local.kappa) / local.endurance


def others(kind, value):
    """Other values of a key."""
    if isinstance(kind, Switch):
        return [other for other in (True, False) if other != value]
    if isinstance(kind, Choice):
        return [word for word in kind.words if word != value]
    if isinstance(kind, CountOf):
        return [count for count in kind.counts if count != value]
    if isinstance(kind, Count):
        return [value + (kind.multiple if kind.multiple > 1 else 2), kind.low]
    if isinstance(kind, Numbers):
        return [(50e-6,)]
    if isinstance(kind, Pairs):
        return []
    size = kind.usual or 1.0
    value = size if isinstance(value, str) else value  # "auto"
    return [value * 1.02 if value and math.isfinite(value) else size, value * 0.9, size, -1.0, 1.0, 1.3]


def changed(scene, key, value):
    """The scene with another value there, without the rules of changes; None where it is refused."""
    name, _, last = key.rpartition(".")
    part = dataclasses.replace(keys.parts(scene)[name], **{last: value})
    section, _, number = name.partition(".")
    if section == "feature":
        features = list(scene.features)
        features[int(number)] = part
        return dataclasses.replace(scene, features=tuple(features))
    return dataclasses.replace(scene, **{f"body_{number}" if section == "bodies" else section: part})


def neighbours(scene, key):
    kind, value = next((kind, value) for name, kind, value in keys.every(scene) if name == key)
    for other in others(kind, value):
        try:
            if other != value:
                yield changed(scene, key, other)
        except SceneError:
            continue


def _is_height_of_scan(scene, key):
    """Whether a key is refused, but for the value of a feature that has none."""
    return key == "feature.0.height" and scene.features[0].kind.measured


@pytest.mark.parametrize("name", SCENES)
def test_a_key_changes_what_a_run_takes_or_is_said_to_have_no_effect(name):
    scene, tried = SCENES[name], 0
    idle, now = idle_keys.idle(scene), list(prepared(scene))
    follow = [f"oil.{key}" for key in data_sheet.derived_keys(vars(scene.oil))]
    for key in (key for one, key in CASES if one == name):
        if key in (*idle_keys.LABELS, "contact.kind", *follow) or _is_height_of_scan(scene, key):  # a circle by either name
            continue
        differ = (differs(other, now) for other in neighbours(scene, key))
        first = next(differ, None)
        tried += first is not None
        assert first is None or (first or any(differ)) == (key not in idle), (key, idle.get(key, "acts"))
    assert tried > 60


def test_what_has_no_effect_is_of_every_kind():
    """The property above would hold if nothing were ever idle."""
    found = {key.replace("feature.0.", "feature.") for scene in SCENES.values() for key in idle_keys.idle(scene)}
    assert found >= {"rheology.tau_0", "rheology.mu_boundary", "thermal.nodes", "oil.k0", "oil.beta0", "oil.eta0", "bodies.a.k",
                     "bodies.b.alpha", "grid.ny", "time.courant", "feature.height", "feature.length", "feature.taper",
                     "feature.y", "fatigue.kappa", "fatigue.thermal_stress", "output.profiles", "operation.u_m",
                     "operation.temperature"}


SAID = [("smooth-line", {"rheology.tau_0": 1e6}, "rheology.tau_0 has no effect here: the shear law 'limiting'"),
        ("smooth-line", {"rheology.law": "newtonian", "rheology.gamma": 0.05}, "rheology.gamma has no effect on the film"),
        ("gear", {"thermal.on": False, "thermal.nodes": 7}, "thermal.nodes has no effect here: no temperatures"),
        ("gear", {"time.steady_only": True, "height": 1e-6}, "feature.height has no effect here: nothing passes (steady)"),
        ("smooth-line", {"grid.ny": 32}, "grid.ny has no effect here: nothing varies"),
        ("ball-on-glass", {"bodies.b.k": 20.0}, "bodies.b.k has no effect here"),
        ("gear", {"fatigue.on": False, "kappa": 0.2}, "fatigue.kappa has no effect here: fatigue.on = false"),
        ("gear", {"fatigue.length": 5e-6}, "fatigue.length has no effect here: the grid averages by itself"),
        ("rough", {"fatigue.length": 5e-5}, "fatigue.length has no effect here: the surfaces are rough"),
        ("smooth-line", {"fatigue.weibull": 24.0}, "fatigue.weibull has no effect here: nothing passes: the index is that of"),
        ("smooth-line", {"fatigue.on": False, "fatigue.criterion": "matake"}, "fatigue.criterion has no effect")]


@pytest.mark.parametrize("base, changes, said", SAID)
def test_changes_files_and_copies_say_it_alike(tmp_path, base, changes, said):
    scene = tehl.scene(base).replace(**changes)
    assert any(sentence.startswith(said) for sentence in scene.warnings())
    assert any(sentence.startswith(said) for sentence in scene.replace(srr=scene.operation.srr).warnings())
    lines = [f"{key.replace('height', 'feature.height') if key == 'height' else key} = {scene_file.toml_value(value)}"
             for key, value in changes.items() if key not in ("height", "kappa")]
    if len(lines) == len(changes):
        (tmp_path / "a.toml").write_text(f'base = "{base}"\n' + "\n".join(lines))
        assert any(sentence.startswith(said) for sentence in tehl.scene(tmp_path / "a.toml").warnings())


def test_a_scene_with_every_value_is_not_asked_about_them(tmp_path):
    for name in ("gear", "smooth-line", "ball-on-disc"):
        path = tmp_path / f"{name}.toml"
        path.write_text(scene_file.dumps(tehl.scene(name)))
        assert not [sentence for sentence in tehl.scene(path).warnings() if "no effect" in sentence]
    path.write_text(path.read_text().replace("nodes = 9", "nodes = 7"))
    assert any("thermal.nodes has no effect" in sentence for sentence in tehl.scene(path).warnings())


@pytest.mark.parametrize("scene, over, key", [
    (SCENES["smooth"], {"rheology.tau_0": [1e6, 1e8]}, "rheology.tau_0"),
    (SCENES["steady"], {"height": [1e-6, 2e-6]}, "height"),
    (SCENES["isothermal"], {"srr": [0.1, 0.2], "thermal.nodes": [5, 9]}, "thermal.nodes"),
    (SCENES["smooth"], {("srr", "fatigue.exponent"): [(0.1, 8.0), (0.2, 9.0)]}, "fatigue.exponent")])
def test_a_sweep_of_equal_rows_is_refused(scene, over, key):
    with pytest.raises(SceneError, match=f"{key} has no effect here.*the cases would be equal"):
        plan(scene, over).refused()


def test_a_sweep_says_which_cases_are_equal():
    found = plan(GEAR.replace(speed=0.5), {"srr": [0.1, 0.0], "thermal.nodes": [5, 9]})
    assert found.refused() == {} and found.equal() == {3: 2}
    law = plan(SCENES["smooth"], {"rheology.law": ["limiting", "eyring"], "rheology.tau_0": [1e6, 1e8]})
    assert law.refused() == {} and law.equal() == {1: 0}


def test_cases_that_differ_in_what_nothing_follows_from_are_equal():
    assert plan(GEAR, {"oil.source": ["one", "another"], "srr": [0.1, 0.2]}).equal() == {2: 0, 3: 1}


def test_no_window_where_nothing_passes_is_what_is_so():
    said = [[one.split()[0] for one in idle_keys.doubts(SCENES["smooth"].replace(**{"zoom.factor": n}))] for n in (0, 4)]
    assert "zoom.factor" not in said[0] and "zoom.factor" in said[1]


def test_a_law_that_uses_a_number_uses_it_at_zero_too():
    for number in (0.0, 1e-9, -3.0):
        values = SimpleNamespace(used=number, other=number)
        assert idle_keys._changes(lambda given: [given.used], values, "used")
        assert not idle_keys._changes(lambda given: [given.used], values, "other")


def test_a_sweep_tells_what_has_no_effect_in_any_case():
    newtonian = SCENES["newtonian"].replace(**{"fatigue.length": 5e-6})
    found = plan(newtonian, {"rheology.gamma": [0.05, 0.08], "srr": [0.1, 0.0]})
    assert [sentence.split()[0] for sentence in found.doubts()] == ["fatigue.length"]  # friction of solid contact needs slip
    slips = plan(SCENES["newtonian"], {"rheology.gamma": [0.05, 0.08], "srr": [0.1, 0.2]})
    assert [sentence.split()[0] for sentence in slips.doubts()] == ["rheology.gamma"]


def test_fatigue_asked_again_says_it_too():
    from tehl_cli.fatigue_command import _doubts

    scene = SCENES["isothermal"].replace(**{"fatigue.on": False})
    assert list(_doubts(scene, {"kappa": 0.2, "thermal_stress": None})) == []
    assert [said.split()[0] for said in _doubts(scene, {"kappa": 0.2, "thermal_stress": False})] == ["fatigue.thermal_stress"]


def test_a_seed_of_no_samples_is_refused(tmp_path):
    with pytest.raises(SceneError, match="seed = 3 has no effect without samples"):
        plan(GEAR, {"srr": [0.1, 0.2]}, seed=3)
    (tmp_path / "a.toml").write_text("seed = 3\n[over]\nsrr = [0.1, 0.2]\n")
    from tehl_taichi.runs.sweep import study_file

    with pytest.raises(SceneError, match="seed = 3"):
        study_file.load(tmp_path / "a.toml")


def test_the_command_says_it_before_it_sweeps():
    from tehl_cli.main import app

    command = "sweep smooth-line --set fatigue.length=5e-6 --over srr=0.1,0.2 --dry-run"
    done = CliRunner().invoke(app, command.split())
    assert done.exit_code == 0 and "warning: fatigue.length has no effect here" in done.output


def test_a_scene_of_parts_says_it_of_unusual_values():
    still = Scene(features=[], thermal=Thermal(on=False, nodes=7), rheology=Rheology(law="newtonian", gamma=0.05),
                  oil=OILS["ridge-test-fluid"], body_a=Body(**STEELS["16MnCr5"].numbers, material="16MnCr5"))
    said = [sentence.split()[0] for sentence in still.warnings() if "no effect" in sentence]
    assert said == ["thermal.nodes", "rheology.gamma"]
    assert [one.split()[0] for one in still.replace(srr=-0.2).warnings() if "no effect" in one] == said
    assert [one.split()[0] for one in idle_keys.doubts(Scene(time=Time(steady_only=True),
                                                             features=(Feature(height=1e-6),)))] == [
        "feature.height"]


def test_what_follows_from_other_keys_was_not_given():
    limits, sheet = Fatigue.from_values({"bending_limit": 4e8}), named_oils.from_values({"nu_40": 220e-6, "nu_100": 19e-6})
    scene = Scene(features=(), contact=Contact(moes_M=20.0, moes_L=10.0), fatigue=limits, oil=sheet)
    assert not {"operation.u_m", "fatigue.endurance", "oil.G0", "oil.S0", "grid.x_min"} & idle_keys.user_keys(scene)
    assert {"contact.moes_M", "fatigue.bending_limit", "oil.nu_40"} <= idle_keys.user_keys(scene)
    assert list(idle_keys.doubts(scene)) == []
    assert all(not list(idle_keys.doubts(tehl.scene(name))) for name in BUILT_INS)


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("changes", [{"fatigue.kappa": 0.6}, {"fatigue.residual_xx": 5e8}, {"fatigue.criterion": "matake"},
                                     {"fatigue.table": "case-hardened"}, {"fatigue.shear": False}], ids=str)
def test_keys_of_the_smooth_contact_alone_act_and_are_swept(changes):
    from tehl_taichi.march.accuracy.contact_alone_bars import searches

    line = tehl.scene("smooth-line").replace(**{"grid.nx": 64, "thermal.on": False})
    other, (key,) = line.replace(**changes), changes
    first, now = (searches(one, next(tehl.march(one)))["a"] for one in (line, other))
    assert any(now[name] != first[name] for name in ("Fi_max", "surface_Fi_max"))
    assert not [one for one in idle_keys.doubts(other) if one.startswith(key)]
    assert plan(line, {key: [getattr(line.fatigue, key.partition(".")[2]), changes[key]]}).refused() == {}
