"""The specific film of ISO/TS 6336-22 and the bulk temperature along a flank."""

import dataclasses
import math

import pytest
from fake_cases import position

import tehl_taichi as tehl
from tehl_taichi.runs.flank import specific_film
from tehl_taichi.runs.flank.flank_source import flank_source
from tehl_taichi.runs.flank.line_contacts import scene_at
from tehl_taichi.runs.sweep import case
from tehl_taichi.scene.gear_pair import gear_pair
from tehl_taichi.scene.scales import Scales


def at_point(point):
    found = flank_source("fzg-c")
    place, = found.positions(at=(point,))
    return scene_at(found.scene, {}, "f", 1, place)


def test_without_slip_the_film_is_the_formula_in_the_units_of_the_standard():
    """In mm, N/mm2 and um, as ISO/TR 15144-1 has it: 1600 rho_n G^0.6 U^0.7 W^-0.13."""
    scene = at_point("C")
    eta, alpha = specific_film.oil_at(scene, 90.0)
    E_r, rho, p = 206e3 / 0.91, Scales.of(scene).R * 1e3, Scales.of(scene).p_H * 1e-6
    G, U = 1e6 * alpha * E_r, eta * 2 * scene.operation.u_m / (2000 * E_r * rho)
    W = 2 * math.pi * p**2 / E_r**2
    assert specific_film.formula_film(scene, 0.05) * 1e6 == pytest.approx(1600 * rho * G**0.6 * U**0.7 * W**-0.13)


def test_sliding_heats_the_oil_and_thins_the_film():
    scene = at_point("E")
    rise = specific_film.flash(scene, 0.05)
    B, o, s = math.sqrt(scene.body_a.rho * scene.body_a.c * scene.body_a.k), scene.operation, Scales.of(scene)
    blok = 1.11 * 0.05 * scene.load * abs(o.u_a - o.u_b) / (B * (o.u_a**0.5 + o.u_b**0.5)) / math.sqrt(2 * s.a)
    assert rise == pytest.approx(blok, rel=0.02), "1.11 f W |u_a - u_b|/(...) of Blok"
    assert specific_film.formula_film(scene, 0.05) < 0.95 * specific_film.formula_film(scene, 0.0)


@pytest.fixture(scope="module")
def rough_gears(tmp_path_factory):
    """A pair with roughness, a permissible film and a bulk temperature, with made-up films."""
    def work(job, *_):
        steady = {"h_c_m": 4e-7, "h_min_m": 3e-7, "friction_coefficient": 0.05}
        return {**position(job), "summary": {"steady": steady, "version": "0.9", "wall_s": 1.0}}

    pair = dataclasses.replace(gear_pair("fzg-c"), Ra1=0.4e-6, Ra2=0.6e-6, lambda_GFP=0.2, bulk_temperature=110.0)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(case, "run_case", work)
        return tehl.flank(pair, at=("B-", "C"), folder=tmp_path_factory.mktemp("film") / "f", workers=1, steady=True)


def test_a_flank_has_the_specific_film_and_its_safety(rough_gears):
    again = tehl.open(rough_gears.folder)
    (low, at), ratios = specific_film.smallest(again), [place.film_ratios for place in again.positions]
    assert low == min(one["lambda_GF"] for one in ratios) and at.point == "B-"
    assert all(one["h_min_Ra"] == pytest.approx(0.6) for one in ratios)
    assert specific_film.safety(again) == pytest.approx(low / 0.2)
    heads = (rough_gears.folder / "flank.csv").read_text().splitlines()[0]
    assert "lambda_GF" in heads and "bulk_C" in heads


def test_the_bulk_temperature_is_that_of_the_contacts_unless_a_change_sets_it(rough_gears):
    assert [at.bulk for at in rough_gears.positions] == [110.0, 110.0]
    base, place = tehl.scene("gear"), rough_gears.positions[0]
    assert scene_at(base, {}, "f", 1, place).operation.temperature == 110.0
    assert scene_at(base, {"temperature": 60.0}, "f", 1, place).operation.temperature == 60.0


def test_a_table_has_its_own_bulk_temperatures(tmp_path):
    (tmp_path / "t.csv").write_text("x_pl_mm,load_N_per_mm,R_a_mm,R_b_mm,u_a_m_s,u_b_m_s,bulk_C\n"
                                    "-3,500,11,24,2.5,3.6,95\n2,560,16,19,3.6,2.9,\n")
    low, high = flank_source(tmp_path / "t.csv").positions()
    assert (low.bulk, high.bulk, low.more) == (95.0, None, {})
    (tmp_path / "t.csv").write_text((tmp_path / "t.csv").read_text().replace("95", "950"))
    with pytest.raises(tehl.SceneError, match="row 2: bulk_C = 950 deg C is out of range"):
        flank_source(tmp_path / "t.csv")


def test_almost_all_heat_goes_into_the_body_that_moves():
    """Almost at rest, body b has no say: the flash falls with the root of the conductivity of body a."""
    scene = at_point("E").replace(srr=1.999999)
    before = specific_film.flash(scene, 0.05)
    ratios = [specific_film.flash(scene.replace(**{f"bodies.{body}.k": scene.body_a.k / 9}), 0.05) / before for body in "ab"]
    assert ratios == pytest.approx([3.0, 1.0], rel=5e-3)


def test_the_specific_film_is_over_the_effective_roughness_whatever_the_sign_of_friction():
    scene, steady = at_point("E"), {"steady": {"h_min_m": 3e-7, "friction_coefficient": -0.05}}
    found = specific_film.film_ratios(scene, steady, 0.5e-6)
    assert found["lambda_GF"] * 0.5e-6 == pytest.approx(specific_film.formula_film(scene, 0.05))
    assert found["h_min_Ra"] == pytest.approx(0.6)


@pytest.mark.parametrize("changes, recorded", [({}, 110.0), ({"operation.temperature": 60.0}, 60.0)])
def test_the_recorded_bulk_temperature_is_that_of_the_scene(rough_gears, changes, recorded):
    from tehl_taichi.runs.flank.flank_run import flank_record
    from tehl_taichi.runs.flank.outcomes import Outcome

    places, subject = rough_gears.positions, {"geometry": rough_gears.record["geometry"]}
    scenes = [scene_at(tehl.scene("gear"), changes, "f", n, place) for n, place in enumerate(places, 1)]
    found = flank_record(subject, places, scenes, [Outcome(rough_gears.folder)] * len(places))
    assert [one["bulk_C"] for one in found["positions"]] == [recorded] * len(places)


def test_hot_oil_thins_the_film_by_its_viscosity_and_its_pressure_coefficient():
    """S^0.22 with S = alpha eta in the contact over that of the bulk; both fall with the temperature."""
    scene = at_point("E")
    bulk, flash = scene.operation.temperature, specific_film.flash(scene, 0.05)
    (eta, alpha), (hot_eta, hot_alpha) = (specific_film.oil_at(scene, at) for at in (bulk, bulk + flash))
    assert hot_eta < eta and hot_alpha < alpha
    ratio = specific_film.formula_film(scene, 0.05) / specific_film.formula_film(scene, 0.0)
    assert ratio == pytest.approx((hot_eta / eta * hot_alpha / alpha) ** 0.22)
