"""What is doubtful although it can be simulated: a sentence each, known before or after the run."""

import dataclasses
import json
import pickle
from types import SimpleNamespace

import numpy as np
import pytest

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.summary import result_warnings
from tehl_taichi.scene import BUILT_INS, scene, thick_film, thin_film, timeline
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.film_formula import heated_film
from tehl_taichi.scene.named_oils import OILS
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.scales import Scales

GEAR = scene("gear")
NEW = {"oil.name": "mine", "oil.viscosity": "roelands", "oil.eta0": 0.1, "oil.alpha": 2e-8, "oil.Z": 0.6}
YASUTOMI = Oil(name="glass", viscosity="yasutomi", rho0=900.0)
TABLE = Oil(name="list", viscosity="table", table=((0.0, -3.0), (1e9, 10.0)), rho0=900.0)
BARUS = Oil(name="thin", viscosity="barus", alpha=1e-8, beta_eta=0.03, rho0=900.0)


def of_oil(oil, **changes):
    return dataclasses.replace(GEAR.replace(**changes) if changes else GEAR, oil=oil).warnings()


@pytest.mark.parametrize("warnings, words", [
    (lambda: GEAR.replace(**{"oil.k0": 0.2}).warnings(), ("reference-pao", "other numbers", "(k0)")),
    (lambda: scene("ball-on-disc").replace(**{"oil.alpha": 2e-8, "oil.eta0": 1.0}).warnings(), ("(eta0, alpha)",)),
    (lambda: GEAR.replace(**NEW).warnings(), ("oil.name = mine", "density, conductivity and heat capacity", "reference-pao")),
    (lambda: of_oil(Oil(name="typo", G0=Oil.G0)), ("oil.name = typo", "all its numbers", "reference-pao")),
    (lambda: of_oil(BARUS), ("barus", "1.93 GPa", "0.5 GPa")),
    (lambda: of_oil(TABLE), ("oil.table ends at 1 GPa", "1.93 GPa", "slope")),
    (lambda: of_oil(YASUTOMI), ("yasutomi", "135 deg C", "inlet temperature of 90 deg C")),
    (lambda: GEAR.replace(**{"oil.name": "moes-test-fluid"}).warnings(), ("roelands", "temperature")),
    (lambda: scene("ball-on-disc").replace(temperature=40.0).warnings(), ("roelands", "inlet temperature")),
    (lambda: of_oil(dataclasses.replace(BARUS, beta_eta=0.0)), ("barus, beta_eta = 0", "temperature")),
    (lambda: scene("smooth-line").replace(**{"contact.moes_M": 100.0, "contact.moes_L": 10.0}).warnings(),
     ("contact.moes_L uses oil.eta0 and oil.alpha", "roelands-temperature")),
])
def test_doubts_about_the_oil(warnings, words):
    found = warnings()
    assert any(all(word in line for word in words) for line in found), found


@pytest.mark.parametrize("name", BUILT_INS)
def test_built_in_scenes_have_no_doubts_about_their_oils(name):
    assert not [line for line in scene(name).warnings() if "oil" in line]


def test_a_film_too_thin_for_the_grid_is_doubted_before_the_run():
    """Thinner than 0.4 of the gap one cell before the edge; the heat of the inlet counts."""
    line = scene("smooth-line").replace(**{"grid.nx": 64, "grid.ny": 16})
    assert not line.warnings()
    said, = line.replace(**{"speed": 0.3, "thermal.on": False}).warnings()
    assert "4.6e-08 m at the centre, 0.63 of the film that 64 columns resolve" in said and said.endswith("use grid.nx=128")
    said, = line.replace(speed=0.002).warnings()
    assert "1.5 nm" in said and "polished steel (10 nm)" in said
    said, = line.replace(**{"contact.hertz_pressure": 4e9, "contact.radius_x": 0.3, "speed": 0.02}).warnings()
    assert "no grid up to 2048 columns" in said
    hot, cold = (line.replace(**{"speed": 50.0, "thermal.on": on}) for on in (True, False))
    assert thin_film.resolved_ratio(hot) < 0.5 * thin_film.resolved_ratio(cold)


def test_no_doubts_about_laws_within_their_range():
    mild = {"hertz_pressure": 0.4e9, "height": 1e-8}
    for oil in (BARUS, TABLE, dataclasses.replace(YASUTOMI, A1=20.0)):
        assert not [line for line in of_oil(oil, **mild) if "range" in line or "slope" in line]
    assert [oil.name for oil in OILS.values()] == list(OILS)


def store(p, T, held=0, **changes):
    """A store as far as judges look: the scene and three entries of its series."""
    series = {"p_max_Pa": p, "film_max_C": T, "clamped": held}
    return SimpleNamespace(scene=GEAR.replace(**changes) if changes else GEAR, steps=3,
                           scalar=lambda name: np.array([1.0, 2.0, series[name]]))


def test_films_beyond_what_was_measured():
    said, = result_warnings.beyond_measured(store(4.01e9, 202.0), {})
    assert "4.01 GPa and 202 deg C" in said and "1.1 GPa and 107 deg C" in said
    assert result_warnings.beyond_measured(store(1.2e9, 20.0), {}) and result_warnings.beyond_measured(store(1e9, 108.0), {})
    assert result_warnings.beyond_measured(store(1.09e9, 106.0), {}) == []
    # its laws of heat are not used
    assert result_warnings.beyond_measured(store(4e9, 300.0, **{"thermal.on": False}), {}) == []
    assert "at 8 nodes" in result_warnings.held_temperatures(store(1e9, 50.0, held=5), {})[0]  # 1 + 2 + 5
    assert {result_warnings.beyond_measured, result_warnings.held_temperatures} <= set(result_warnings.CHECKS)


def test_a_crowded_machine_is_told():
    """Where more than a tenth of the launches lost a worker; old summaries have no such count."""
    from tehl_taichi.runs.summary import result_warnings

    assert result_warnings.crowded(None, {}) == [] == result_warnings.crowded(None, {"crowding": [0, 0]})
    assert result_warnings.crowded(None, {"crowding": [30, 3]}) == []
    said, = result_warnings.crowded(None, {"crowding": [30, 4]})
    assert "4 of 30" in said and result_warnings.crowded in result_warnings.CHECKS


def test_doubts_reach_the_store_and_its_summary(taichi_cpu, tmp_path):
    """Of a steady start: the pressure and temperature of its warning are those of its summary."""
    from tehl_taichi.march.passage import march
    from tehl_taichi.runs.summary.summary import summarise
    from tehl_taichi.store.store import Store

    description = scene("gear").replace(**{"thermal.on": True, "grid.nx": 64, "grid.ny": 16})
    first = next(march(description))
    saved = Store.create(tmp_path / "s.zarr", description, first, 1, {"warnings": json.dumps(description.warnings())})
    summary = summarise(saved, {"wall_s": 0.0, "compile_s": 0.0, "steady_error": {}, "crowding": [7, 5]})
    hot = f"{summary['steady']['p_max_Pa'] / 1e9:.2f} GPa and {summary['steady']['film_max_C']:.0f} deg C"
    assert any(hot in line for line in summary["warnings"]) and any("8.8 cells" in line for line in summary["warnings"])
    assert any("5 of 7" in line for line in summary["warnings"]) and summary["crowding"] == [7, 5]
    assert any("8.8 cells" in line for line in Store.open(tmp_path / "s.zarr").warnings)


@pytest.mark.parametrize("surfaces, srr, reach, warned", [("a", -0.12, 1.0, False), ("ab", -0.12, 1.0, False),
                                                          ("ab", -0.12, 9.0, True), ("ab", 2.0, 9.0, False)])
def test_features_without_space_for_a_window_are_a_warning(surfaces, srr, reach, warned):
    """A feature of a surface at rest does not pass."""
    features = tuple(Feature(shape="cosine", height=1e-6, width=200e-6 * (reach if name == "b" else 1.0), surface=name)
                     for name in surfaces)
    zoomed = dataclasses.replace(GEAR, features=features).replace(srr=srr, **{"zoom.factor": 4})
    found = [one for one in zoomed.warnings() if one.code == "window"]
    assert bool(found) == warned and all("surface b has no window of its own (zoom.factor = 4: " in one for one in found)
    assert "window" not in [one.code for one in zoomed.replace(**{"zoom.factor": 0}).warnings()]


@pytest.mark.parametrize("ratio, srr, thermal, said", [
    (3.0, 2.0, True, {"b": 0.07}), (1.5, 1.98, True, {"b": 0.06}), (8.5, -2.0, True, {"a": 0.08}), (1.0, 2.0, True, {}),
    (0.5, 2.0, True, {}), (3.0, 0.0, True, {}), (3.0, 2.0, False, {})])
def test_slow_surfaces_of_wide_ellipses_have_their_error(ratio, srr, thermal, said):
    ball = scene("ball-on-disc").replace(srr=srr, speed=2.0, **{
        "thermal.on": thermal, "contact.kind": "point" if ratio == 1 else "elliptic", "contact.radius_x": 0.0127,
        "contact.radius_y": 0.0127 * ratio**1.6})
    found = {one.data["surface"]: one.data["error"] for one in ball.warnings() if one.code == "slow"}
    assert found == {name: pytest.approx(error) for name, error in said.items()}


@pytest.mark.parametrize("name", ["ball-on-disc", "smooth-line", "mtm"])
@pytest.mark.parametrize("srr", [-2.0, 2.0])
def test_a_surface_at_rest_of_a_smooth_contact_has_its_steps(name, srr):
    """With temperatures a step is chosen by the pace of the other surface, also if body a is the one at rest."""
    rests = scene(name).replace(srr=srr, **{"thermal.on": True})
    assert 0 < timeline.step_length(rests) < 1 and isinstance(rests.warnings(), list)


@pytest.mark.parametrize("srr, rests, other", [(-2.0, "a", "b"), (2.0, "b", "a")])
@pytest.mark.parametrize("thermal", [True, False])
def test_a_steady_contact_may_have_its_first_feature_on_a_surface_at_rest(srr, rests, other, thermal):
    """Nothing passes, so the moving surface is the clock: with a feature on one surface or on both, in either order."""
    def pair(surfaces):
        both = scene("rough-pair")
        return dataclasses.replace(both, features=tuple(dataclasses.replace(f, surface=one)
                                                        for f, one in zip(both.features, surfaces)))

    for surfaces in (rests, rests + other, other + rests):
        still = pair(surfaces).replace(srr=srr, **{"time.steady_only": True, "thermal.on": thermal})
        assert isinstance(still.warnings(), list) and 0 < timeline.step_length(still) < 1 and still.reference.name == other
        assert still.path[0] < 0 < still.path[1] and timeline.total_steps(still) == 0
    with pytest.raises(SceneError, match=f"leaves surface {rests}, which carries the feature, at 0 m/s"):
        pair(rests).replace(srr=srr)


def test_warnings_are_found_once_and_follow_the_keys_that_the_user_gave(monkeypatch):
    from tehl_taichi.scene import scene_warnings

    asked, own = [], scene_warnings.warnings
    monkeypatch.setattr(scene_warnings, "warnings", lambda one: asked.append(one) or own(one))
    some = GEAR.replace(**{"oil.k0": 0.2})
    first = some.warnings()
    first.clear()
    assert some.warnings() and len(asked) == 1  # a list of its own for every caller
    assert pickle.loads(pickle.dumps(some)).warnings() == some.warnings() and len(asked) == 1
    idle = scene("smooth-line").replace(**{"thermal.on": False})
    before = {line.code for line in idle.warnings()}
    assert {line.code for line in idle.with_user_keys({"thermal.nodes"}).warnings()} - before == {"idle"}


def thick_line(speed, **changes):
    return scene("smooth-line").replace(**{"hertz_pressure": 1e8, "speed": speed, "srr": 0.0, "temperature": 20.0,
                                           "thermal.on": False, "oil.name": "mineral-vg460", **changes})


@pytest.mark.parametrize("share, outcome", [(0.009, ""), (0.011, "thick"), (0.24, "thick"), (0.26, "refused")])
def test_a_film_beside_its_bodies_is_doubted_then_refused(share, outcome):
    """The film of a rigid line is proportional to the speed: shares of R' follow from one scene, for every way to a scene."""
    usual = thick_line(5.0)
    speed = 5.0 * share * Scales.of(usual).R / heated_film(usual)
    if outcome != "refused":
        assert ("thick" in [one.code for one in thick_line(speed).warnings()]) == (outcome == "thick")
        return
    faster = dataclasses.replace(usual.operation, u_m=speed)
    for make in (lambda: thick_line(speed), lambda: dataclasses.replace(usual, operation=faster)):
        with pytest.raises(SceneError, match=r"0\.26\d* times the reduced radius \(0.0106 m\).*allowed: at most 0.25 of it"):
            make()
    assert thick_line(speed, **{"grid.inlet": "starved"}).grid.inlet == "starved"  # its film is that of the oil it is given


def test_bodies_end_where_a_refused_film_builds_its_pressure():
    """Two equal cylinders have twice the reduced radius; there the parabola is at eight of the thickest allowed films."""
    R, end = 1.0, 2.0
    assert end**2 / (2 * R) == pytest.approx(8 * thick_film.NO_BODIES * R)
    x = np.sqrt(2 * R * 8 * thick_film.THICKEST * R)
    assert 1 - x**2 / (2 * R) / (R - np.sqrt(R**2 - x**2)) == pytest.approx(0.04, abs=0.005)
