"""The index by a strength that varies with depth: a constant table is the plain number, another one moves the worst depth."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from rolling import Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment, local_strength
from tehl_taichi.fatigue.search_result import LIMITS
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.stress.residual_field import ResidualField
from tehl_taichi.fatigue.worst_point import worst_of
from tehl_taichi.report import scene_text
from tehl_taichi.runs.summary import limit_meaning, search_rows, summary_rows
from tehl_taichi.scene.scales import Scales

pytestmark = pytest.mark.usefixtures("taichi_cpu")
GEAR = tehl.scene("gear").replace(**{"thermal.on": False, "fatigue.length": 0.0, "fatigue.surfaces": "a"})


def rows(*lines):
    """The change of a scene that gives it this table."""
    return {"fatigue.table_rows": "\n".join(lines)}


def search(alone=False, **changes):
    scene = GEAR.replace(**changes)
    return assessment.run(scene, Rolling(scene, 12, 5), alone=alone)


PLAIN = {"fatigue.kappa": 0.25, "fatigue.endurance": 4.5e8, "fatigue.residual_xx": -3e8}
LINE = "4.5e8,0.25,-3e8"
OWN = {"sigma_eF_Pa", "kappa_F", "residual_xx_Pa", "residual_yy_Pa"}


@pytest.fixture(scope="module")
def plain(taichi_cpu):
    return search(True, **PLAIN)


@pytest.fixture(scope="module")
def case(taichi_cpu):
    return search(True, **{"fatigue.table": "case-hardened"})


def test_a_constant_table_is_the_plain_number_bit_for_bit(plain):
    found = search(True, **rows("depth_m,limit_Pa,kappa,residual_xx_Pa", f"0.0,{LINE}", f"1e-4,{LINE}", f"2e-3,{LINE}"))
    below = {key: value for key, value in found.summary["below"].items() if key not in OWN}
    assert {**found.summary, "below": below} == plain.summary
    for name, (values, *_) in plain.maps.items():
        np.testing.assert_array_equal(found.maps[name][0], values)
    for name in LIMITS:
        np.testing.assert_array_equal(found.index(name), plain.index(name))


def test_of_two_depths_the_larger_index_is_worse_not_the_larger_stress():
    hard, soft = (SimpleNamespace(f=f, share=share, compared=f * share) for f, share in ((5e8, 1.0), (4e8, 1.5)))
    assert worst_of([hard, soft]) is worst_of([soft, hard]) is soft


def test_each_depth_has_its_own_limit_and_kappa(case):
    for part, depth in ((case.summary, 0.0), (case.summary["below"], case.summary["below"]["depth_m"])):
        HV = np.interp(depth, 0.8e-3 / 20 * np.arange(41), 400 + 300 * 0.5 ** (np.arange(41) / 20) ** 2)
        assert part["sigma_eF_Pa"] == pytest.approx(1e6 * (197.75 + 0.56833 * HV), rel=1e-9)
        assert part["kappa_F"] == pytest.approx(0.017 + 8.27e-4 * HV, rel=1e-9)
        assert part["Fi_max"] == pytest.approx(part["findley_stress_max_Pa"] / part["sigma_eF_Pa"], rel=1e-12)


def test_the_profile_is_that_of_single_depths(case):
    """Listed depths are searched by themselves; between the rungs the worst one is no worse than they say."""
    depths = case.row_depths[1:8:3]
    single = search(**{"fatigue.table": "case-hardened", "fatigue.depths": tuple(depths)})
    row = int(np.argmin(np.abs(single.feature_frame_y - case.summary["below"]["y_m"])))
    np.testing.assert_allclose(single.index("findley_stress_at_depth")[1:, :, row],
                               case.index("findley_stress_under_row")[1:8:3], rtol=2e-4)
    assert case.summary["below"]["Fi_max"] >= case.index("findley_stress_under_row")[1:].max() * (1 - 1e-9)


def test_a_soft_layer_is_where_it_is_worst_and_moves_along():
    """Half of the strength in a thin layer."""
    for middle in (1e-4, 3e-4):
        found = search(**rows("depth_m,limit_Pa", "0.0,8e8", f"{0.8 * middle},8e8", f"{middle},3e8", f"{1.2 * middle},8e8"))
        assert found.summary["below"]["depth_m"] == pytest.approx(middle, rel=0.03)
        assert found.summary["below"]["sigma_eF_Pa"] == pytest.approx(3e8, rel=0.1)


def test_harder_steel_has_a_smaller_index():
    found = [search(**rows("depth_m,hardness_HV", f"0.0,{HV}"), **{"fatigue.relation": "rotating-bending"}).summary
             for HV in (300, 400, 600)]
    for above, below in zip(found, found[1:]):
        assert below["Fi_max"] < above["Fi_max"] and below["below"]["Fi_max"] < above["below"]["Fi_max"]
    assert found[0]["below"]["Fi_max"] == pytest.approx(2 * found[2]["below"]["Fi_max"], rel=1e-9)


def test_bodies_are_judged_by_their_own_tables(case):
    both = search(**{"fatigue.surfaces": "both", "fatigue.table": "case-hardened", "fatigue.table_b": "none"}).summaries
    other = search(**{"fatigue.surfaces": "b"}).summary
    assert both["a"]["below"]["Fi_max"] == case.summary["below"]["Fi_max"]
    assert both["b"]["below"]["Fi_max"] == other["below"]["Fi_max"] and "sigma_eF_Pa" not in both["b"]["below"]


@pytest.mark.parametrize("depth", [0.0, 4e-5, 2.3e-4])
def test_residual_stress_is_that_of_its_depth(depth):
    """Its corner lies between the rungs of the search."""
    scene = GEAR.replace(**rows("depth_m,limit_Pa,residual_xx_Pa,residual_yy_Pa", "0.0,4e8,-5e8,-1e8", "2e-4,4e8,1e8,0.0"))
    reader = Rolling(scene, 12, 5)
    passage = StressHistories(scene, reader, reader.centres)
    resting = passage.history(slice(0, 2), passage.stresses(depth), depth=depth)[:, -1]
    wanted = np.interp(depth, [0, 2e-4], [-5e8, 1e8]), np.interp(depth, [0, 2e-4], [-1e8, 0])
    np.testing.assert_allclose(resting[:, :2], np.broadcast_to(wanted, (len(resting), 2)), atol=1.0)
    worst = assessment.run(scene, reader, alone=False)
    deep, unloaded = worst.summary["below"], worst.worst_below["stress"][-1]
    assert unloaded[0] == pytest.approx(deep["residual_xx_Pa"], abs=1e3)
    assert deep["residual_xx_Pa"] == pytest.approx(np.interp(deep["depth_m"], [0, 2e-4], [-5e8, 1e8]))


def test_it_yields_where_the_table_is_soft():
    hard = "0.0,4e8,3e9", "2e-4,4e8,3e9"
    found = search(**rows("depth_m,limit_Pa,yield_stress_Pa", *hard, "2.5e-4,4e8,5e8")).summary["von_mises"]
    assert found["yields"] and found["yield_stress_Pa"] < 6e8 and found["depth_m"] > 2.4e-4
    assert search().summary["von_mises"]["depth_m"] < 2e-4 and not search().summary["von_mises"]["yields"]


def test_the_smooth_contact_has_the_limit_of_its_depth(case):
    alone = case.summary["contact_alone"]
    HV = np.interp(alone["depth_m"], 0.8e-3 / 20 * np.arange(41), 400 + 300 * 0.5 ** (np.arange(41) / 20) ** 2)
    limit = 1e6 * (197.75 + 0.56833 * HV)
    assert alone["Fi_max"] == pytest.approx(alone["findley_stress_max_Pa"] / limit, rel=1e-9)


def test_rows_name_what_holds_at_the_worst_depth(case, plain):
    shown = [row.text_pair for row in search_rows.rows_of_fatigue(case.summary)]
    deep = case.summary["below"]
    assert ("with kappa, sigma_eF", f"{deep['kappa_F']:.4g}, {deep['sigma_eF_Pa'] / 1e6:.4g} MPa") in shown
    assert ("residual stress along x / y", "0 / 0 MPa") in shown
    assert not any("residual" in what for what, _ in summary_rows.fatigue_rows(plain.summary))
    assert "ss2506" in scene_text.material(GEAR.replace(**{"fatigue.table": "case-hardened"}).fatigue)


def test_the_limit_means_a_smooth_contact_of_its_pressure(plain):
    """Of a contact with that pressure the index is 1, where its load alone acts."""
    changes = {"fatigue.shear": False, "fatigue.residual_xx": 0.0, "fatigue.kappa": 0.0}
    summary = search(True, **changes).summary
    summary["contact_alone"]["error"] = {"Fi_max": 0.01}
    p_H = Scales.of(GEAR).p_H
    p, error = limit_meaning.smooth_pressure({"hertz": {"p_Pa": p_H}, "fatigue": summary})
    assert p == pytest.approx(400e6 / 0.25, rel=0.01)  # shear ranges over 0.5 p_H below a line (Johnson 1985)
    Fi = summary["contact_alone"]["Fi_max"]
    assert error == pytest.approx(p * math.hypot(0.01 / Fi, limit_meaning.DISPROPORTION * math.log(Fi)))
    with_residual = search(True, **{**changes, "fatigue.residual_xx": 5e8}).summary
    with_residual["contact_alone"]["error"] = {"Fi_max": 0.01}  # it does not grow with the pressure
    assert limit_meaning.smooth_pressure({"hertz": {"p_Pa": p_H}, "fatigue": with_residual}) is None
    told = limit_meaning.sentence({"hertz": {"p_Pa": p_H}, "fatigue": summary}, GEAR.fatigue)
    assert "595.2 MPa in reversed bending, 383.1 MPa in torsion" in told and f"{p / 1e9:.2f}" in told
    contact = GEAR.replace(**{"fatigue.limit_of": "contact"}).fatigue
    assert "that of a contact" in limit_meaning.sentence({"hertz": {"p_Pa": p_H}, "fatigue": summary}, contact)


def test_the_residual_stress_of_a_point_is_that_of_the_scene_and_of_the_run_in():
    """Both along x and along y; the run-in's at the place of the point, of a field that varies with x, y and depth."""
    scene = GEAR.replace(**{"fatigue.residual_xx": -3e8, "fatigue.residual_yy": -1e8})
    passage = StressHistories(scene, reader := Rolling(scene, 12, 5), reader.centres)
    x, y, z = (np.array([0.0, 1e-4]) for _ in range(3))
    z = z + 1e-5
    stress = np.zeros((2, 6, 2, 2))
    stress[:, 0] = 1e12 * (x[:, None] + 2 * y + 3 * z[:, None, None])
    stress[:, 1] = -2 * stress[:, 0]
    point = SimpleNamespace(x=2e-5, y=5e-5, depth=4e-5)
    assert local_strength.of_point(passage, point) == {}
    passage.left = ResidualField(x, y, z, stress)
    found = local_strength.of_point(passage, point)
    there = 1e12 * (point.x + 2 * point.y + 3 * point.depth)
    assert found == pytest.approx({"residual_xx_Pa": -3e8 + there, "residual_yy_Pa": -1e8 - 2 * there})
