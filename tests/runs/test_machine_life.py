"""Hours to initiation of gears and bearings: how often teeth meet, and where tables, records and comparisons have the hours."""

import itertools

import pytest
from fake_cases import position

import tehl_taichi as tehl
from tehl_taichi.runs import machine_life, place_table
from tehl_taichi.runs.bearing import bearing_table
from tehl_taichi.runs.flank import flank_columns
from tehl_taichi.runs.flank.outcomes import Outcome
from tehl_taichi.runs.machine_life import ContactRates
from tehl_taichi.runs.open_results import BEARING, FLANK
from tehl_taichi.runs.sweep import case


def searched(surface="a", error=2e5, **more):
    """Summary with 1e6 passages to initiation on a surface; the feature is on a."""
    found = {name: {"surface": name, "carries_feature": name == "a", "Fi_max": 1.2, **more} for name in "ab"}
    return {"fatigue": found[surface], "fatigue_by_surface": found, "version": "0.9", "wall_s": 1.0,
            "steady": {"h_c_m": 4e-7, "h_min_m": 3e-7, "friction_coefficient": 0.05}, "transient": {"p_max_Pa": 2e9},
            "von_mises": {"max_Pa": 1.8e9, "error": {"max_Pa": 2e7}},
            "life": {"passages": 1e6, "surface": surface, "error": {"passages": error}}}


@pytest.mark.parametrize("z1, z2, on", [(16, 24, "pinion"), (16, 24, "gear"), (17, 40, "pinion"), (20, 20, "gear")])
def test_teeth_meet_as_counted(z1, z2, on):
    """Tooth n of the pinion meets tooth n modulo z2 of the gear: counted over ten hours of 1 turn a minute."""
    rates, meshes = machine_life.of_gears(1.0, z1, z2, on), range(600 * z1)
    a, b = (z1, z2) if on == "pinion" else (z2, z1)
    counted = sum(n % a == 0 for n in meshes), sum(n % b == 0 for n in meshes), sum(n % a == n % b == 0 for n in meshes)
    assert (rates.each["a"], rates.each["b"], rates.pair) == pytest.approx([one / 10 for one in counted], rel=0.01)


def test_hours_of_the_worse_body_with_their_error():
    rates = ContactRates({"a": 100.0, "b": 50.0}, 10.0)
    hours = {body: machine_life.with_hours(searched(body), rates)["life"] for body in "ab"}
    assert (hours["a"]["hours"], hours["a"]["error"]["hours"]) == (1e4, 2e3)
    assert (hours["b"]["hours"], hours["b"]["error"]["hours"]) == (1e5, 2e4), "a meets b's point in one of five contacts"
    assert machine_life.with_hours(searched("b", rough=True), rates)["life"]["hours"] == 2e4, "a rough body in each"
    assert machine_life.with_hours(searched(error=None), rates)["life"]["error"] == {"passages": None, "hours": None}
    at_random = ContactRates({"a": 100.0, "b": 50.0})
    assert "hours" not in machine_life.with_hours(searched("b"), at_random)["life"]
    without = {key: value for key, value in searched().items() if key != "life"}
    assert all(machine_life.with_hours(one, rates) == one for one in (without, None))
    assert machine_life.with_hours(searched(), None) == searched()


def test_a_flank_has_them_in_its_record_table_and_comparison(tmp_path, monkeypatch):
    monkeypatch.setattr(case, "run_case", lambda job, *_: {**position(job), "summary": searched("b")})
    flank = tehl.flank("fzg-c", on="gear", at=("B-",), folder=tmp_path / "f", workers=1, steady=True)
    life, pair = flank.record["positions"][0]["summary"]["life"], flank.record["geometry"]
    assert (pair["z1"], pair["z2"]) == (16, 24)
    assert life["hours"] == pytest.approx(1e6 / (20 * pair["n1"]))
    heads, (line,) = flank_columns.tables(tehl.open(flank.folder).rows)["while the feature passes"]
    shown = dict(zip(heads, line))
    assert shown["Mises GPa"] == "1.800 ± 0.020" and float(shown["hours"].split()[0]) == pytest.approx(life["hours"], rel=0.02)
    numbers = place_table.place_table(FLANK, tehl.open(flank.folder)).numbers
    assert numbers["hours", "B-"] == (life["hours"], life["error"]["hours"])
    assert numbers["von_mises_max_Pa", "B-"] == (1.8e9, 2e7)


def test_a_bearing_has_them_for_the_ring_but_not_for_a_ball_beside_it(tmp_path):
    made = tehl.bearing("6206", load=5000.0, speed=3000.0, run=False, folder=tmp_path / "b")
    for ring, body in itertools.product(("inner", "outer"), "ab"):
        done = made.with_ring(ring, Outcome(tmp_path, searched(body)))
        life, row = done.record[ring]["summary"]["life"], done.rings[ring]
        assert life.get("hours") == (pytest.approx(1e6 / 3600 / row["passes_per_s"]) if body == "a" else None)
        shown = {one.name: one.shown(done.record, row) for one in bearing_table.ROWS}
        assert shown["von_mises_max_Pa"] == "1.800 ± 0.020" and bool(shown["hours"]) == (body == "a")
        assert (place_table.place_table(BEARING, done).numbers.get(("hours", ring)) is None) == (body == "b")
    rough = made.with_ring("inner", Outcome(tmp_path, searched("b", rough=True))).record
    assert rough["inner"]["summary"]["life"]["hours"] == pytest.approx(1e6 / 1800 / rough["element_passes_per_s"])
