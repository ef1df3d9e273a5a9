"""Error bars hold: on sequences made by hand, on scenes against grids four times as fine, and when companions fail."""

import json
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from tehl_taichi.profiles import coverage

from tehl_taichi.engine import field_pool
from tehl_taichi.fatigue.assessment import Snapshots
from tehl_taichi.march.accuracy import coarse_runs, error_bars, readings
from tehl_taichi.march.accuracy.error_bars import GridReading, bar, bars, estimated_error, parabola_offset
from tehl_taichi.march.passage import march
from tehl_taichi.runs.summary import result_warnings, summary, summary_rows
from tehl_taichi.scene import scene
from tehl_taichi.scene.rough_surfaces import is_rough
from tehl_taichi.scene.scales import Scales

LIMIT = 2.0


def grids(error, count=3):
    """Values on grids of 16, 32, 64 ... cells whose error is error(1 / cells)."""
    return [LIMIT + error(1 / cells) for cells in (16, 32, 64, 128)[:count]]


@pytest.mark.parametrize("error", [
    lambda h: 3 * h**2, lambda h: -h, lambda h: 0.4 * h**1.5, lambda h: (-1) ** round(np.log2(1 / h)) * h,  # even, oscillating
    lambda h: 9 * h**2 - 200 * h**3,  # changes its sign on the way
    lambda h: 3 * h**2 + 5000 * h**4], ids=("second", "first", "between", "oscillating", "accident", "thin"))
@pytest.mark.parametrize("count", [3, 4])
def test_a_bar_covers_the_error_and_little_more(error, count):
    values = grids(error, count)
    real = abs(values[-1] - LIMIT)
    assert real <= estimated_error(values)[0] < 14 * real


def test_an_earlier_difference_counts_where_the_last_one_is_small_by_accident():
    assert estimated_error([1.0, 1.36, 1.36])[0] == pytest.approx(0.036)  # a tenth of 0.36
    assert estimated_error([1.0, 1.0])[0] == pytest.approx(2e-3)  # two grids may agree by accident
    assert estimated_error([1.0, 1.1])[0] == pytest.approx(0.15) and np.isnan(estimated_error([1.0])[0])


@pytest.mark.parametrize("place", [(), (0.0,)])
def test_two_grids_say_less_of_a_passage(place):
    def two(*values):
        return bar([GridReading(value, place=place, cell=1.0) for value in values], passing=True)[0]

    assert two(1.0, 1.0) == pytest.approx(1e-2) and two(1.0, 1.1) == pytest.approx(0.2)
    assert two(0.7, 1.0, 1.1) < 0.2  # three say more


def test_no_bar_is_narrower_than_what_the_iterations_may_have_left():
    """Grids that agree to 0.1 mK while rounds end at 50 mK."""
    # two grids alone: two thousandths
    assert bar([GridReading(100.0001), GridReading(100.0, settled=0.005)])[0] == pytest.approx(0.2)
    same = [GridReading(100.0002), GridReading(100.0001), GridReading(100.0, settled=0.005)]
    assert bar(same)[0] == 0.005 and bar(same[:2] + [GridReading(100.0)])[0] < 3e-4
    assert readings.temperature_reading(120.0, scene("gear")).settled == 0.1 * scene("gear").thermal.tolerance


@pytest.mark.parametrize("passing", [False, True])
@pytest.mark.parametrize("rises", [(30.0, 31.0), (30.0, 30.01), (20.0, 24.0, 25.0), (0.4, 0.65), (20.0, 45.0)])
def test_a_bar_of_a_temperature_does_not_depend_on_the_zero_of_its_scale(rises, passing):
    """Equal rises over inlets of 0, 90 and 273.15 degrees; two grids that agree hide a fifth of a kelvin, of a passage one."""
    found = []
    for inlet in (0.0, 90.0, 273.15):
        over = SimpleNamespace(operation=SimpleNamespace(temperature=inlet), thermal=scene("gear").thermal)
        found.append(bar([readings.temperature_reading(inlet + rise, over, passing) for rise in rises], passing))
    sizes, reasons = zip(*found)
    assert len(set(reasons)) == 1 and (sizes[0] is None) == bool(reasons[0]) == (rises[-1] == 45.0)
    if not reasons[0]:
        assert sizes == pytest.approx([sizes[0]] * 3, rel=1e-9) and (len(rises) > 2 or sizes[0] >= readings.CHANCE[passing])


def test_a_number_that_is_zero_on_the_finest_grid_alone_has_no_bar():
    size, reason = bar([GridReading(0.03), GridReading(0.0)])
    assert size is None and "still changes by 0.03 (from zero)" in reason


def test_rounding_on_every_grid_is_nothing_with_a_bar_of_nothing():
    """Friction in pure rolling: 1e-18 that changes by 134 % from grid to grid."""
    assert bar([GridReading(-3e-19), GridReading(2.3e-18)]) == (0.0, "")
    assert bar([GridReading(0.02), GridReading(0.05)])[0] is None


def test_a_number_that_grids_do_not_resolve_has_no_bar():
    def maximum(value, place, doubt=""):
        return GridReading(value, 0.0, (place,), 0.1, doubt)

    assert bar([maximum(1.0, 0.0), maximum(1.01, 0.35)])[0] == pytest.approx(0.015)
    assert bar([maximum(1.0, 0.0), maximum(1.01, 0.85)]) == (None, "its place differs from that on the next coarser grid")
    both = [GridReading(1.0, 0.0, (0.0, 0.0), 0.1), GridReading(1.01, 0.0, (0.85, 0.1), 0.1)]
    assert bar(both)[0] is not None  # it moved in the contact, but not under the feature
    assert bar([maximum(1.0, 0.0), maximum(1.01, 0.0, "too narrow")]) == (None, "too narrow")
    assert bar([maximum(1.0, 0.0, "too narrow"), maximum(1.01, 0.0)])[0] is not None
    assert bar([GridReading(0.4), GridReading(1.0)]) == (None, "it still changes by 60% from grid to grid")
    assert bar([GridReading(5e-6, lost=True), GridReading(1.0), GridReading(1.1)])[0] == pytest.approx(0.15)
    assert bar([GridReading(1.0), GridReading(5e-6, doubt="touches", lost=True)]) == (None, "touches")


def test_an_extreme_is_blurred_by_its_own_grid_and_moves_by_cells_of_the_coarser_one():
    same = [GridReading(1.0, blur=blur) for blur in (0.3, 0.2, 0.1)]
    assert bar(same)[0] == pytest.approx(1.5 * 0.1)
    pairs = [bar([GridReading(1.0, 0.0, (0.0,), 0.2), GridReading(1.01, 0.0, (at,), 0.1)])[0] for at in (0.7, 0.9)]
    assert pairs[0] is not None and pairs[1] is None  # more than four of 0.2


NARROW = "a few cells wide"
QUIET = (2.0e9, 2.0e9, 2.0e9)  # of a part of the passage, on three grids


def narrow(values, *parts, doubt=NARROW):
    """Readings of a number of a narrow peak on grids each twice as fine; parts: pressures of parts of the passage on each."""
    return [GridReading(value, doubt=doubt, course=course) for value, course in zip(values, zip(*parts))]


def test_three_grids_tell_a_narrow_peak_whose_differences_halve():
    """Of a dent that leaves at SRR 0.12: 3.65, 4.39, 4.55 GPa on 128, 256, 512 columns (docs/exit.md), then 4.56 and 4.55."""
    dent = (3.65, 4.39, 4.55)
    own = tuple(1e9 * p for p in dent)
    assert bar(narrow(dent, own, QUIET)) == (pytest.approx(max(0.16, 0.25 * 0.74, 2.0 / 2 * 0.16)), "")
    assert bar(narrow(dent, own, QUIET)[1:]) == bar([GridReading(value, doubt=NARROW) for value in dent]) == (None, NARROW)
    assert bar(narrow((1.12, 1.33, 1.32), own, QUIET))[0] == pytest.approx(0.25 * 0.21)  # an index that follows it
    assert bar([*narrow(dent, own, QUIET)[:2], GridReading(4.55, doubt="touches")]) == (None, "touches")


def test_a_peak_that_grows_like_a_singular_one_stays_unknown():
    newtonian = (3.28, 4.06, 5.23)
    assert bar(narrow(newtonian, tuple(1e9 * p for p in newtonian), QUIET)) == (None, NARROW)
    assert bar(narrow((2.75, 3.26, 3.57), (2.75e9, 3.26e9, 3.57e9), QUIET)) == (None, NARROW)  # in rolling, 3.70 on finer ones


def test_an_index_is_known_no_earlier_than_the_pressure_it_follows_from():
    """Below the surface 0.770, 0.773, 0.774 as long as the contact itself is worst there, 0.840 on grids four times as fine."""
    assert bar(narrow((0.770, 0.773, 0.774), (1.79e9, 1.99e9, 2.36e9), QUIET)) == (None, NARROW)


@pytest.mark.parametrize("doubt", ["", NARROW])
def test_another_part_of_the_passage_may_overtake(doubt):
    """An island of oil behind an asperity: 1.93, 2.25, 3.07 GPa beside 4.04, 4.03, 4.03; and one that stays below."""
    own, p = (4.04e9, 4.03e9, 4.03e9), (4.04, 4.03, 4.03)
    size, why = bar(narrow(p, own, (1.93e9, 2.25e9, 3.07e9), doubt=doubt))
    assert size is None and why == (doubt or error_bars._rival((1.93e9, 2.25e9, 3.07e9)))
    assert bar(narrow(p, own, (1.9e9, 2.6e9, 2.8e9), doubt=doubt))[0] == pytest.approx(0.0025 if doubt else 0.001)
    near = bar(narrow(p, own, (3.2e9, 3.8e9, 4.0e9), doubt=doubt))[0]  # goes on to 4.1
    assert near == pytest.approx(4.03 * (4.1 / 4.03 - 1))
    assert bar(narrow(p, own, (math.nan, math.nan, 3.07e9), doubt=doubt))[0] < 0.01


def test_a_peak_that_grows_in_all_parts_is_its_own_rival():
    """Not narrow: differences that do not fall yet leave a bar, by the last of them."""
    own, beside_it = (3.0e9, 3.1e9, 3.25e9), (2.9e9, 3.0e9, 3.15e9)
    assert bar(narrow((3.0, 3.1, 3.25), own, beside_it, doubt=""))[0] == pytest.approx(1.75 * 0.15)


def test_what_an_unknown_peak_sways_has_a_wide_bar():
    """The hottest place of a surface, in rolling: 97.9, 98.3, 98.3 deg C, and 99.2 on grids four times as fine."""
    values = (97.91, 98.32, 98.28)
    assert bar([GridReading(value, swayed=True) for value in values])[0] == pytest.approx(3 * 0.41)
    assert bar([GridReading(value) for value in values])[0] < 0.1
    assert bar([GridReading(values[1], swayed=True), GridReading(98.0, swayed=True)])[0] == pytest.approx(3 * 0.32)


def test_parts_of_a_passage_are_the_same_on_every_grid():
    path, coarse, fine = (-1.5, 1.5), np.arange(1, 49) / 16 - 1.5, np.arange(1, 385) / 128 - 1.5
    p = [coarse_runs.course(1e9 + at**2, list(at), path) for at in (coarse, fine)]
    assert len(p[0]) == len(p[1]) == 31 and p[0][0] == pytest.approx(1e9 + 1.4375**2) and p[1][-1] == pytest.approx(1e9 + 2.25)
    assert all(one <= other for one, other in zip(*p))
    cut = coarse_runs.course(np.ones(3), [-1.5, -1.4, -1.38], path)
    assert cut[:2] == (1.0, 1.0) and np.isnan(cut[2:]).all()


def test_an_index_at_the_shallowest_depth_is_settled_by_no_grid():
    shallow = coarse_runs._with_doubt(GridReading(1.8, doubt=coarse_runs.SHALLOW), "", (2e9,))
    assert (shallow.doubt, shallow.course) == (coarse_runs.SHALLOW, ())
    found = coarse_runs._with_doubt(GridReading(1.8), NARROW, (2e9,))
    assert (found.doubt, found.course) == (NARROW, (2e9,)) and coarse_runs._with_doubt(GridReading(1.8), "", (2e9,)).course


def test_a_film_whose_bar_would_reach_zero_has_none():
    """Of 0.24, 0.021, 0.02 um the first difference leaves a tenth of itself, more than the film; of 0.06 um it leaves 4 nm."""
    thin = [GridReading(value, positive=True) for value in (0.24e-6, 0.021e-6, 0.02e-6)]
    assert bar(thin) == (None, error_bars.WHOLE) and bar([GridReading(one.value)
                                                          for one in thin])[0] == pytest.approx(0.0219e-6)
    assert bar([GridReading(0.06e-6, positive=True), *thin[1:]])[0] == pytest.approx(0.0039e-6)


def test_a_film_on_the_floor_is_not_known():
    """Two grids have it there, so they agree to the last digit: 0.0 +- 0.019 um was stated of 0.024 um."""
    gear = short()
    floor = gear.rheology.film_floor * Scales.of(gear).h

    def least(h):
        film = np.full((9, 5), 4e-7)
        film[4, 2] = h
        return readings.film_reading(SimpleNamespace(fields={"film": film}, x=np.arange(9) * 1e-5, feature_x=0.0), gear)

    on, above = least(floor * (1 + 1e-7)), least(2e-8)
    assert on.doubt == readings.TOUCH and on.lost and not above.doubt
    assert bar([least(2.5e-7), on, on]) == (None, readings.TOUCH)
    assert bar([on, on, above]) == (None, "no coarser grid gives it")


def test_an_extreme_under_a_feature_keeps_its_place_there():
    """The feature has moved by three nodes."""
    x, places = np.arange(40) * 1e-5, []
    for n in (10, 13):
        pressure = 1e9 * np.exp(-((np.arange(40)[:, None] - n) / 4.0) ** 2) * np.ones(3)
        shot = SimpleNamespace(fields={"pressure": pressure}, x=x, feature_x=(n - 2) * 1e-5)
        places.append(readings.pressure_reading(shot, 1e-4).place)
    (here, under), (later, still) = places
    assert later - here == pytest.approx(3e-5) and under == pytest.approx(still) == pytest.approx(2e-5)


def test_extremes_between_nodes():
    x = np.linspace(-1, 1, 21)
    for at in (0.0, 0.03, 0.05):
        P = 1 - (x - at) ** 2
        i = int(P.argmax())
        assert parabola_offset(P, i) == pytest.approx(1 - P[i], abs=1e-15)
    assert parabola_offset(P, 0) == parabola_offset(P, 20) == 0.0 and parabola_offset(np.ones(5), 2) == 0.0


def moes(M, L, nx, x_min=-2.5):
    return scene("smooth-line").replace(**{
        "thermal.on": False, "contact.load": 0.0, "contact.moes_M": M, "contact.moes_L": L, "oil.name": "moes-test-fluid",
        "grid.nx": nx, "grid.x_min": x_min, "grid.inlet": "starved", "rheology.law": "newtonian"})


def start(description):
    return next(march(description))


@pytest.mark.slow
def test_the_bar_of_a_thin_film_holds(taichi_cpu):
    """0.02 % was stated, 0.27 % real."""
    own, finer = start(moes(202.7, 9.427, 256)), start(moes(202.7, 9.427, 1024))
    for name, most in (("h_c_m", 5), ("h_min_m", 10), ("p_max_Pa", 5)):
        real = abs(finer.scalars[name] - own.scalars[name])
        assert real <= own.error[name] <= most * real, name


def test_a_pressure_spike_as_narrow_as_the_grid_has_no_bar(taichi_cpu):
    """Its height is 0.92, 0.94 of the largest on 256, 512 columns, 1.08 on 1024."""
    shot = start(moes(10.0, 10.0, 256, -4.5))
    assert shot.error["p_max_Pa"] is None
    assert shot.unknown["p_max_Pa"].startswith("exit not resolved: a pressure peak of 93% of the largest is only a few cells")
    assert shot.error["h_c_m"] > 0 and "h_c_m" not in shot.unknown


def test_a_film_that_the_grid_does_not_have_has_no_bar(taichi_cpu):
    shot = start(moes(600.0, 6.0, 64))
    assert shot.fields["contact"].any() and set(shot.error.values()) == {None}
    assert set(shot.unknown.values()) == {readings.TOUCH}


@pytest.mark.slow
def test_random_scenes_are_covered(taichi_cpu):
    drawn = [one for kind, one in coverage.battery(5) if kind in ("line, Moes", "line") and one.grid.nx <= 128][:8]
    rows = [{"kind": "line", **coverage.row(one)} for one in drawn]
    lines = {name: numbers for _, name, *numbers in coverage.table(rows)}
    stated, unknown, covered, width, *_ = lines["all"]
    assert stated + unknown == 4 * 8 and stated >= 20 and covered >= 0.9 and 1 < width < 8


def test_the_table_of_a_battery_is_counted_right():
    own = [{"film_max_C": vars(GridReading(value)), "h_c_m": vars(GridReading(5.0))} for value in (100.0, 104.0, 105.0)]
    near, far = {"film_max_C": 105.5, "h_c_m": 5.0}, {"film_max_C": 107.0, "h_c_m": 5.0}
    rows = [{"own": own, "finer": near}, {"own": own, "finer": far}, {"own": own[2:], "finer": near}, {"reason": "stopped"}]
    temperature, film, everything = coverage.table(rows)
    assert temperature == ("steady", "film_max_C", 2, 1, 0.5, pytest.approx(1.25), 1.0, pytest.approx(1.25))
    assert film[:5] == ("steady", "h_c_m", 2, 1, 1.0) and everything[2:5] == (4, 2, 0.75)


def test_a_battery_of_exits_leaves_the_contact_in_one_dimension():
    drawn = coverage.battery(3, part="exits")
    assert [kind for kind, _ in drawn] == ["exit"] * 10 + ["exit, thermal"] * 10
    for kind, one in drawn:
        assert one.one_dimensional and one.path[1] > 1.2 and one.grid.nx in (256, 512) and one.isothermal == (kind == "exit")
    assert len({one.operation.srr for _, one in drawn}) > 10 and len({one.features[0].height > 0 for _, one in drawn}) == 2
    own, coarser = ({"p_max_Pa": vars(GridReading(value))} for value in (4.0, 3.9))
    row = {"own": own, "answers": [{"values": coarser}], "finer": {"p_max_Pa": 4.05}}
    assert [coverage.judged([{"kind": kind, **row}])[0][0] for kind in ("exit, thermal", "ridge")] == ["exit", "passage"]


def test_a_battery_of_rough_surfaces_has_both_slips_and_bodies():
    drawn = coverage.battery(1, part="roughness")
    assert [kind for kind, _ in drawn] == ["rough"] * 6 + ["rough pair"] * 6 + ["rough pair, thermal"] * 2
    for kind, one in drawn:
        assert one.one_dimensional and is_rough(one) and one.isothermal == ("thermal" not in kind)
        assert [f.surface for f in one.features] == (["a", "b"] if "pair" in kind else ["a"])
        assert len(coverage.coarse_runs.scenes(one)[0]) == 2 and all(1e-7 <= f.height <= 5e-7 for f in one.features)
    assert {one.operation.srr > 0 for _, one in drawn} == {True, False}
    assert coverage.battery(4)[-14][0] == "rough" and len(coverage.battery(4)) == 62 + 10 + 14


def test_the_numbers_of_rough_surfaces_that_settle_are_judged():
    """Of all bodies and depths together; shares are parts of nothing and count where there are none."""
    own = {name: vars(GridReading(value, spread=0.5)) for name, value in (("a:0 um.p99", 1.0), ("b:0 um.p99", 1.2),
                                                                          ("a:7 um.share_above_1", 0.0), ("b:Fi_max", 2.0))}
    coarser = {name: {**reading, "value": reading["value"] + 0.1} for name, reading in own.items()}
    answers = [{"values": one} for one in (coarser, coarser)]
    row = {"kind": "rough", "own": own, "answers": answers,
           "finer": {"a:0 um.p99": 1.05, "b:0 um.p99": 2.0, "a:7 um.share_above_1": 0.02, "b:Fi_max": 9.0}}
    share, percentile, everything = sorted(coverage.table([row]), key=lambda line: line[2])
    assert share[:5] == ("roughness", "share_above_1, below", 1, 0, 1.0) and share[7] == pytest.approx(0.02)
    assert percentile[:5] == ("roughness", "p99, surface", 2, 0, 0.5) and everything[2] == 3


def short(**changes):
    return scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16, "time.steps": 4,
                                    "numerics.estimate_error": True, **changes})


class Store(Snapshots):
    """Snapshots as the store of a run."""

    def scalar(self, name):
        return np.array([shot.scalars[name] for shot in self.items])


@pytest.fixture(scope="module")
def passage(taichi_cpu):
    return Store(march(short()))


def test_companions_give_the_bars_of_a_passage(passage):
    told = []
    found = coarse_runs.errors(short(), passage, {"a": {"Fi_max": 0.5}},
                              lambda: coarse_runs.answers(short(), lambda *part: told.append(part)))
    bars = found["passage_error"]
    assert bars.keys() == {"p_max_Pa", "h_min_m", "middle_h_min_m", "friction_coefficient_mean", "contact_load_fraction_max",
                           "contact_area_share_max", "a:Fi_max", "a:averaged_Fi_max"}
    assert bars.pop("contact_load_fraction_max") == bars.pop("contact_area_share_max") == 0.0  # nothing touches
    assert all(size > 0 for size in bars.values() if size is not None)
    assert found["passage_error"]["friction_coefficient_mean"] is not None
    assert told == [(0, 3), (1, 3), (2, 3), (3, 3)]  # 16 columns are refused, 32 have a start and two steps


def test_the_index_below_the_surface_has_a_bar_of_its_own():
    deep = short(**{"grid.nx": 128, "grid.ny": 32, "time.steps": 8, "fatigue.depths": "auto"})
    known = coarse_runs.values(coarse_runs.scenes(deep)[0][-1])
    below = coarse_runs.of_surface("a", coarse_runs.BELOW)
    assert known[below].value > 0 and known[below] != known["a:Fi_max"]
    out = {"transient": {"p_max_Pa": 2e9}, "fatigue_by_surface": {"a": {"Fi_max": 0.5, "below": {"Fi_max": 0.7}}}}
    _, (surface, of_surface), (below, of_below) = summary._parts(out)
    assert surface is out["fatigue_by_surface"]["a"] and of_surface == {"Fi_max": "a:Fi_max"}
    assert below is surface["below"] and of_below == {"Fi_max": coarse_runs.of_surface("a", coarse_runs.BELOW)}
    deep = {"fatigue": {"below": {"unknown": {"Fi_max": "it still changes"}}}}
    said, = result_warnings.unknown_errors(SimpleNamespace(scene=short()), deep)
    assert said == "the error of Fi_max below the surface is not known: it still changes"


@pytest.mark.parametrize("depth,surface,known", [(3e-6, 0.6, False), (3e-6, 0.8, True), (9e-6, 0.6, True)])
def test_an_index_that_grows_towards_the_surface_as_far_as_a_grid_sees_is_not_known(depth, surface, known):
    part = {"Fi_max": surface, "below": {"Fi_max": 0.7, "depth_m": depth, "searched_m": [3e-6, 3e-4]}}
    early = {"Fi_max": surface, "below": {"Fi_max": 0.7, "depth_m": depth}}
    found = coarse_runs.indices({"a": {**part, "resolved": early}})
    assert [coarse_runs._shallow(name, found) == "" for name in found] == [True, known, True, known]
    assert coarse_runs._shallow("a:Fi_max", coarse_runs.indices({"a": {"Fi_max": 0.7}})) == ""


@pytest.mark.parametrize("averaged, known", [(0.6, False), (0.8, True)])
def test_averaged_stresses_below_are_compared_with_averaged_ones_at_the_surface(averaged, known):
    wide = {"Fi_max": averaged, "below": {"Fi_max": 0.7, "depth_m": 3e-6}}
    found = coarse_runs.indices({"a": {"Fi_max": 1.4 - averaged, "below": {"searched_m": [3e-6, 3e-4]}, "averaged": wide}})
    assert (coarse_runs._shallow("a:below_averaged_Fi_max", found) == "") == known


def test_coarse_grid_runs_take_steps_in_proportion_to_their_cells():
    """So that they end where the run ends."""
    cut = short(**{"grid.nx": 128, "grid.ny": 32, "time.steps": 8})
    assert [(one.grid.nx, one.time.steps) for one in coarse_runs.scenes(cut)[0]] == [(32, 2), (64, 4)]
    whole = short(**{"grid.nx": 128, "grid.ny": 32, "time.steps": -1})
    assert [one.time.steps for one in coarse_runs.scenes(whole)[0]] == [-1, -1]


@pytest.mark.parametrize("at, code", [(-0.8, "peak"), (0.3, "peak"), (0.8, "exit")])
def test_a_narrow_peak_is_at_the_exit_only_behind_the_middle(at, code):
    assert readings.doubt(np.array([at]), 0.9, 0, 1.0).code == code


def test_companions_use_the_tables_of_the_run(passage):
    """Others would compile all kernels anew."""
    ready = coarse_runs.scenes(short(**{"grid.nx": 128, "grid.ny": 32}))[0]
    coarse_runs.answers(short(**{"grid.nx": 128, "grid.ny": 32}))
    before = len(field_pool._tables)
    assert [one.grid.nx for one in ready] == [32, 64] and all("values" in coarse_runs.answer(one) for one in ready)
    assert len(field_pool._tables) == before


def test_a_companion_that_fails_spares_the_coarser_ones(monkeypatch):
    tried = []
    monkeypatch.setattr(coarse_runs, "answer", lambda one, *_: tried.append(one.grid.nx) or {"reason": "no"})
    assert coarse_runs.answers(short(**{"grid.nx": 128, "grid.ny": 32})) == [{"reason": "no"}] and tried == [64]


def test_companions_that_fail_leave_bars_unknown_and_say_why(passage):
    hopeless = short(**{"grid.nx": 32, "grid.ny": 8, "numerics.newton_max": 1, "numerics.krylov_max": 5})
    refused, one = coarse_runs.scenes(short(**{"grid.nx": 48}))[1], coarse_runs.answer(hopeless)
    assert len(refused) == 3 and "24 x 8 cells is refused: grid.nx = 24" in refused[0]
    assert refused[-1] == "use a grid.nx that is a multiple of 64 and a grid.ny that is a multiple of 16"
    assert "32 x 8 cells failed: " in one["reason"] and "did not converge" in one["reason"]
    own = coarse_runs.passage_readings(short(), passage, passage.scalar)
    found, unknown = coarse_runs.judged([{"reason": refused[0]}, one], own)
    assert set(found.values()) == {None} and "did not converge" in unknown["p_max_Pa"]
    summary = {"steady": {}, "transient": {"error": found, "unknown": unknown}}
    said = list(result_warnings.unknown_errors(SimpleNamespace(scene=short()), summary))
    assert len(said) == 1 and "passage h_min, passage p_max" in said[0] and refused[0] in said[0]


def test_the_film_in_the_middle_is_that_under_the_feature_wherever_its_x_lies(passage):
    """Positions count from feature.x = 0: those of a feature at -2 mm begin behind the contact."""
    moved = Store([replace(shot, feature_x=shot.feature_x + 2e-3) for shot in passage.items])
    plain, other = (coarse_runs.passage_readings(short(**{"feature.x": x}), reader, reader.scalar)[coarse_runs.MIDDLE]
                    for x, reader in ((0.0, passage), (-2e-3, moved)))
    films = {float(shot.fields["film"].min()) for shot in passage.items[1:]}
    assert len(films) > 1 and other.value == plain.value


def test_a_failed_companion_takes_coarser_ones_with_it(passage):
    own = coarse_runs.passage_readings(short(), passage, passage.scalar)
    coarser = {"values": {name: vars(reading) for name, reading in own.items()}}
    assert set(coarse_runs.judged([coarser, {"reason": "no"}], own)[0].values()) == {None}
    assert coarse_runs.judged([{"reason": "no"}, coarser], own)[0]["h_min_m"] is not None


@pytest.mark.parametrize("share, p99, uncertain", [(0.0, 0.3, False), (0.0, 0.6, True), (0.01, 1.2, True), (0.01, 0.3, True)])
def test_a_share_is_uncertain_by_two_of_its_points_unless_none_comes_near(share, p99, uncertain):
    """1.5 times 4/3 points of 400; a percentile at the surface, which short waves raise, keeps a larger part as error."""
    part = {"share_above_1": share, "p99": p99, "median": 0.2, "points": 400}
    found = coarse_runs._spread_reading(part, "share_above_1")
    assert 1.5 * found.blur == pytest.approx(2 / 400 if uncertain else 0.0) and found.value == share
    assert all(not coarse_runs._spread_reading(part, key).blur for key in ("p99", "median"))
    deep = coarse_runs._spread_reading({**part, "depth_m": 2e-5}, "p99").spread
    assert coarse_runs._spread_reading(part, "p99").spread > deep == coarse_runs._spread_reading(part, "median").spread


def test_steps_with_temperatures_are_more_work():
    cold, warm = (short(**{"thermal.on": on}) for on in (False, True))
    assert coarse_runs.heavy_work(warm) > 2 * coarse_runs.heavy_work(cold) == 2 * 65 * 17 * 4


def test_who_gets_companions():
    auto = short(**{"numerics.estimate_error": "auto"})
    for description, expected in (
            (auto, False), (auto.replace(**{"grid.nx": 256, "grid.ny": 64, "time.steps": 40}), True), (short(), True),
            (auto.replace(**{"grid.nx": 256, "grid.ny": 64, "time.steps": 40, "numerics.estimate_error": False}), False)):
        assert coarse_runs.has_coarse_runs(description) == expected


def test_a_run_without_a_passage_or_companions_has_no_bars(passage):
    assert coarse_runs.errors(short(), passage.items[:1], None, None) == {}
    assert coarse_runs.errors(short(**{"numerics.estimate_error": False}), passage, None, None) == {
        "passage_error": {"contact_load_fraction_max": 0.0, "contact_area_share_max": 0.0}, "passage_unknown": {}}


def test_a_summary_has_numbers_or_null():
    from tehl_taichi.runs.summary.summary_row import quantity

    values = {"film": 1.5e-6, "error": {"film": None}}
    assert quantity(values, "film", 1e6, "um") == "1.5 um (error unknown)"
    assert quantity({**values, "error": {"film": 2e-9}}, "film", 1e6, "um") == "1.5000 ± 0.0020 um"
    json.dumps({"error": bars([{"a": GridReading(1.0)}])}, allow_nan=False)


@pytest.mark.parametrize("errors, told", [
    ({"surface_a_max_C": 2.1, "surface_b_max_C": 1.6}, "302.6 (error unknown) / 182.4 ± 2.1 / 150.7 ± 1.6 °C"),
    ({}, "302.6 / 182.4 / 150.7 °C (errors unknown)")])
def test_a_temperature_without_an_error_says_so(errors, told):
    values = dict(zip(readings.HEAT, (302.57, 182.36, 150.72)))
    row, = summary_rows._heat_rows("passage", {**values, "error": dict.fromkeys(readings.HEAT) | errors})
    assert row.value == told


def test_a_narrow_peak_at_any_moment_leaves_pressure_and_fatigue_unknown(passage):
    kept = [shot.fields["pressure"].copy() for shot in passage.items]
    smooth = 1.9e9 * np.sqrt(np.maximum(1 - (passage.x / 0.3622e-3) ** 2, 0.0))[:, None] * np.ones(passage.y.size)
    try:
        for shot in passage.items:
            shot.fields["pressure"][...] = smooth
        before = coarse_runs.passage_readings(short(), passage, passage.scalar, {"a": {"Fi_max": 0.5}})
        assert not any(reading.doubt for reading in before.values())
        i = int(np.searchsorted(passage.x, 0.8 * 0.3622e-3))
        passage.items[2].fields["pressure"][i] = 0.9 * passage.scalar("p_max_Pa")[1:].max()
        passage.items[2].fields["pressure"][i + 1 :] = 0.0
        after = coarse_runs.passage_readings(short(), passage, passage.scalar, {"a": {"Fi_max": 0.5}})
        nobody = short(**{"numerics.estimate_error": False})
        alone = coarse_runs.errors(nobody, passage, {"a": {"Fi_max": 0.5}}, None)["passage_unknown"]
    finally:
        for shot, field in zip(passage.items, kept):
            shot.fields["pressure"][...] = field
    assert "exit not resolved: a pressure peak of 90% of the largest" in after["p_max_Pa"].doubt and after["a:Fi_max"].doubt
    middle = min(passage.items[1:], key=lambda shot: abs(shot.feature_x))
    assert before["middle_h_min_m"].value == middle.fields["film"].min()
    assert not after["h_min_m"].doubt and alone == {name: after[name].doubt for name in ("p_max_Pa", "a:Fi_max")}


@pytest.mark.parametrize("shares, size", [((0.05, 0.02, 0.0), 0.0),  # the finest film carries all: so do finer ones
                                          ((0.2, 0.05, 0.008), None), ((0.12, 0.11, 0.107), pytest.approx(0.003, rel=0.8))])
def test_the_load_on_solid_contact_has_a_bar_or_none(shares, size):
    found, why = bar([GridReading(share, positive=True) for share in shares])
    assert found == size and bool(why) == (size is None)


def test_a_passage_that_touches_without_companions_says_so(passage):
    shots = [replace(shot, scalars={**shot.scalars, "contact_load_fraction": 0.01 * n}) for n, shot in enumerate(passage.items)]
    found = coarse_runs.errors(short(**{"numerics.estimate_error": False}), Store(shots), None, None)
    assert "contact_load_fraction_max" not in found["passage_error"]
    assert "touch" in found["passage_unknown"]["contact_load_fraction_max"]


def test_a_reader_whose_fields_take_work_keeps_their_peaks():
    """And knows them by the largest pressure that they are compared with."""
    class Worked:
        def __init__(self):
            self.x, self.peaks, self.asked = np.linspace(-2e-4, 2e-4, 41), {}, []

        def fields(self, n, names):
            self.asked.append(n)
            return {"pressure": np.where(np.arange(41) == 30 + n, 2e9, 1e9)[:, None] * np.ones((1, 3))}

    reader = Worked()
    first = readings.pressure_doubt(reader, [0, 1], 2e9, 1e-4)
    assert first and first == readings.pressure_doubt(reader, [0, 1], 2e9, 1e-4) and reader.asked == [0, 1]
    readings.pressure_doubt(reader, [1], 9e9, 1e-4)
    assert reader.asked == [0, 1, 1]


def test_a_largest_value_on_the_axis_is_known_across_it():
    """The row before the first one is its mirror image: a parabola with its top at y = 0 has nothing between its nodes."""
    values = np.ones((3, 1)) * (2 - 0.1 * np.arange(5.0) ** 2)
    assert readings._between(values, 1, 0) == pytest.approx(0.0, abs=1e-15)
