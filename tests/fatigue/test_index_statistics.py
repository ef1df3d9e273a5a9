"""Distribution of the index over what features pass: numbers, points, error bars, and what is said of rough surfaces."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from rolling import BothSides, Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment, index_statistics, sampled_rows
from tehl_taichi.fatigue.sought import Sought
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.march.accuracy.error_bars import GridReading, bar
from tehl_taichi.report import verdict
from tehl_taichi.runs.summary import result_warnings, search_rows, summary
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.rough_surfaces import is_rough

WAVES = [{"shape": "waviness", "height": 0.1e-6, "width": width, "x": x, "extent_x": 500e-6, "taper": 60e-6}
         for width, x in ((60e-6, 5e-6), (80e-6, -7e-6), (110e-6, 0.0), (200e-6, 3e-6))]

# a round feature of 0.2 half-widths
NARROW = tehl.scene("gear").replace(**{"thermal.on": False, "feature.width": 0.4 * 0.36216e-3, "fatigue.surfaces": "a"})


def rough_line(**changes):
    features = tuple(Feature(**wave) for wave in WAVES)
    return replace(tehl.scene("gear"), features=features).replace(**{"thermal.on": False, **changes})


def test_numbers_are_those_of_the_points_as_often_as_they_stand_for():
    rng = np.random.default_rng(1)
    Fi, counts = rng.normal(1, 0.3, (40, 7)), rng.integers(0, 3, (40, 7)).astype(float)
    found = index_statistics.statistics(Fi, counts)
    every = np.repeat(Fi.ravel(), counts.ravel().astype(int))
    assert found["share_above_1"] == pytest.approx((every > 1).mean()) and found["points"] == (counts > 0).sum()
    for name, share in index_statistics.QUANTILES.items():
        assert found[name] == pytest.approx(np.quantile(every, share, method="hazen"), abs=0.02)
    alike = index_statistics.statistics(Fi, np.ones_like(Fi))
    assert alike["p90"] == pytest.approx(np.quantile(Fi, 0.9, method="hazen"), rel=1e-12)


@pytest.mark.parametrize("half", [True, False])
def test_points_are_those_that_the_feature_passes(half):
    """A round feature of 0.2 a radius: a half domain's points off its edge stand for two."""
    scene, reader = NARROW, Rolling(NARROW, 32, 33)
    if not half:
        reader.y = np.linspace(-1, 1, 65) * reader.s.a
    passage = StressHistories(scene, reader, reader.centres)
    counts, cell = index_statistics.weights(passage), np.diff(reader.x[:2])[0] * np.diff(reader.y[:2])[0]
    assert counts.sum() * cell == pytest.approx((0.4 * reader.s.a) ** 2, rel=0.15)  # the square around it
    assert (counts[:, passage.y == 0] <= 1).all() and counts.max() == (2 if half else 1)
    other = next(s for s in scene.replace(srr=-0.5).surfaces if s.name == "b")
    slid = index_statistics.weights(StressHistories(scene.replace(srr=-0.5), reader, reader.centres, surface=other))
    assert slid.sum() > 1.5 * counts.sum()  # what it slides over is longer


def test_a_search_has_them_at_the_surface_and_below(taichi_cpu):
    scene = rough_line()
    found = assessment.run(scene, Rolling(scene, 16, 1)).summary
    top, deep = found["statistics"], found["below"]["statistics"]
    assert found["rough"] and top["median"] <= top["p90"] <= top["p99"] <= found["Fi_max"]
    assert deep["p99"] == max(one["p99"] for one in deep["by_depth"]) <= found["below"]["Fi_max"] * 1.001
    a = Rolling(scene).s.a
    assert [one["depth_m"] for one in deep["by_depth"]] == pytest.approx([0.05 * a, 0.1 * a, 0.2 * a, 0.5 * a])
    at_p90 = scene.replace(**{"fatigue.endurance": scene.fatigue.endurance * top["p90"]})
    at_limit = assessment.run(at_p90, Rolling(scene, 16, 1)).summary
    assert at_limit["statistics"]["share_above_1"] == pytest.approx(0.1, abs=0.02)
    assert at_limit["cycles_above_1"] >= 1 and 0 < at_limit["statistics"]["cycles_above_1"] < 3


def test_a_sparing_search_has_all_numbers_with_bars(taichi_cpu):
    """As coarse-grid runs make it: the worst points, also of the early moments, and the points that the feature passes."""
    scene = tehl.scene("gear").replace(**{"thermal.on": False, "feature.width": 0.4 * 0.36216e-3})
    reader = Rolling(scene, 16, 17)
    every, few = (assessment.run(scene, reader, until=-0.2, alone=False, sought=one) for one in (Sought.ALL, Sought.COUNTED))

    def with_bars(found):
        """The numbers of a search that have error bars."""
        largest = {name: part["Fi_max"] for name, part in coarse_runs.indices(found.summaries).items()}
        spread = [(name, [part[key] for key in (*index_statistics.NUMBERS, "points")])
                  for name, part in coarse_runs.distributions(found.summaries)]
        return largest, coarse_runs.von_mises_parts(found.summaries), spread

    assert with_bars(few) == with_bars(every)
    left_out = np.isnan(few.plane_theta)
    assert left_out.sum() > 0.5 * left_out.size and not left_out[few.passed > 0].any()


@pytest.mark.parametrize("cell, chosen", [(0.03, 0.05), (0.01, 0.02), (0.6, 0.5)])
def test_the_worst_depth_is_one_that_a_coarser_grid_sees(monkeypatch, cell, chosen):
    """Under an index that falls with depth, the first of a cell at least; all depths stay listed."""
    rungs = np.geomspace(0.5 * cell, 1.0, 12) * 1e-3
    monkeypatch.setattr(sampled_rows, "indices", lambda passage, depths, counts: (
        1, 5e-4 / np.array(depths)[:, None] * np.ones(40), np.ones(40)))
    passage = SimpleNamespace(a=1e-3, y=np.zeros(1), scene=NARROW)
    found = index_statistics.below(passage, [SimpleNamespace(depths=rungs, counted=None)], np.ones((40, 1)))
    assert found["depth_m"] == pytest.approx(chosen * 1e-3)
    assert max(one["p99"] for one in found["by_depth"]) >= found["p99"] and len(found["by_depth"]) > (chosen < 0.5)


def test_bars_of_a_distribution_have_a_part_of_both_steps():
    """1.5 of the last one; of the one before all at the top of a surface, else a half."""
    def size(values, spread=0.5, **more):
        return bar([GridReading(value, spread=spread, **more) for value in values])[0]

    assert size([0.7, 1.2, 1.21]) == pytest.approx(0.25) and size([0.7, 1.2, 1.21], 1.0) == pytest.approx(0.5)
    assert size([1.2, 1.21, 1.0]) == pytest.approx(1.5 * 0.21) == size([1.21, 1.0])
    assert size([0.02, 0.02, 0.0], blur=0.1) == pytest.approx(0.15)  # a share of none is known as well as others
    assert size([0.0, 0.0, 0.0], blur=0.1) == pytest.approx(0.15)  # also where all grids have none
    assert size([0.1, 1.0, 0.02]) > 0.02  # of other numbers such a change says that nothing is known
    assert bar([GridReading(1.0), GridReading(0.02)])[0] is None


@pytest.mark.parametrize("key, depth, part", [("p99", {}, 1.0), ("p99", {"depth_m": 7e-6}, 0.5), ("median", {}, 0.5)])
def test_the_top_of_a_surface_is_the_least_known(key, depth, part):
    found = coarse_runs._spread_reading({"p99": 1.2, "median": 0.7, "points": 50, **depth}, key)
    assert found.spread == part and found.blur == 0


@pytest.mark.parametrize("p99, share, blurred", [(0.96, 0.0, True), (0.3, 0.0, False), (0.3, 0.02, True)])
def test_no_point_above_1_is_certain_only_far_from_1(p99, share, blurred):
    reading = coarse_runs._spread_reading({"share_above_1": share, "p99": p99, "points": 50}, "share_above_1")
    assert (reading.blur > 0) == blurred and reading.blur * 50 < 2  # at most two of the points


def test_coarse_grids_take_the_waves_that_they_resolve():
    scene = rough_line(**{"grid.nx": 256})
    (coarsest, coarse), refused = coarse_runs.scenes(scene)
    assert not refused and [f.width for f in coarse.features] == [w["width"] for w in WAVES]
    assert [f.width for f in coarsest.features] == [110e-6, 200e-6]
    single = tehl.scene("gear").replace(**{"feature.width": 30e-6, "grid.nx": 256, "thermal.on": False})
    assert coarse_runs.scenes(single)[1]  # nothing would be left: refused


@pytest.mark.parametrize("name, waves", [("rough-pair", (11, 12)), ("rough", (8, 11))])
def test_coarse_grids_take_the_long_waves_of_a_random_surface(name, waves):
    """Those of at least four of their cells of 5 a/nx, at the heights and phases that the whole has."""
    scene = tehl.scene(name).replace(**{"grid.nx": 256, "grid.ny": 64})
    found, refused = coarse_runs.scenes(scene)
    assert not refused
    for (least, count), coarse in zip(zip((90.5, 45.3), waves), found):
        assert [len(f.kind.kept(f)[0]) for f in coarse.features] == [count] * len(scene.features)
        assert all(f.shortest_x == pytest.approx(least * 1e-6, rel=0.01) for f in coarse.features)
        assert [f.seed for f in coarse.features] == [f.seed for f in scene.features]


def test_the_summary_has_bars_and_the_table_leads_with_them(taichi_cpu):
    part = {"share_above_1": 0.12, "median": 0.7, "p90": 1.0, "p99": 1.2, "points": 130, "cycles_above_1": 0.2}
    search = {"surface": "b", "rough": True, "Fi_max": 1.3, "statistics": dict(part),
              "below": {"Fi_max": 1.5, "statistics": {**part, "depth_m": 7e-6, "by_depth": []}}}
    names = [bars for _, bars in summary._parts({"transient": {}, "fatigue_by_surface": {"b": search}})]
    assert {"p99": "b:0 um.p99"}.items() <= names[2].items() and names[3]["share_above_1"] == "b:7 um.share_above_1"
    search["statistics"]["error"] = {"p99": 0.1, "share_above_1": 0.05}
    rows = dict(row.text_pair for row in search_rows._distribution_rows(search))
    assert rows["Fi surface, 99th percentile"] == "1.20 ± 0.10 (130 points)"
    assert rows["share of the surface with Fi > 1"] == "12.0 ± 5.0 %" and "Fi below, median, at 7 um" in rows
    plain = [row.what for row in search_rows._distribution_rows({**search, "rough": False})]
    assert plain == ["share of the surface under the feature with Fi > 1"]


@pytest.mark.parametrize("p99, error, tone", [(1.3, 0.1, "yes"), (1.05, 0.1, "open"), (0.8, 0.1, "no")])
def test_the_verdict_of_rough_surfaces_is_by_the_percentile(p99, error, tone):
    top = {"p99": p99, "share_above_1": 0.12, "points": 130, "error": {"p99": error, "share_above_1": 0.05}}
    found = {"surface": "b", "rough": True, "Fi_max": 1.9, "statistics": top, "surface_angle_deg": 60.0,
             "resolved": {"Fi_max": 1.7, "to_x_a": 0.5, "surface_angle_deg": 61.0}}
    _, headline, known, said = verdict.of_fatigue(found)
    assert known == tone and "by the 99th percentile of the index" in headline or tone == "no"
    assert any(one.startswith("Surface b: 12.0 ± 5.0 % of it has Fi > 1; the largest of 130 points is 1.9") for one in said)


def test_one_warning_for_what_single_peaks_leave_unknown():
    why = {"unknown": {"p_max_Pa": "narrow"}, "unknown_codes": {"p_max_Pa": "peak"}}
    search = {"rough": True, "Fi_max": 1.3, "unknown": {"Fi_max": "narrow"}, "below": {"Fi_max": 2.0, "depth_m": 1e-5}}
    told = {"steady": {}, "transient": why, "fatigue": search, "fatigue_by_surface": {"b": search}}
    said, = result_warnings.of_single_peaks(SimpleNamespace(scene=tehl.scene("rough")), told)
    assert "passage p_max, Fi_max" in said and said.data["numbers"] == ["passage p_max_Pa", "Fi_max"]
    assert not {"peak", "resolved", "unknown"} & set(result_warnings.ROUGH_CHECKS.values())


@pytest.mark.parametrize("name, rough", [("gear", False), ("dent", False), ("rough", True), ("rough-pair", True),
                                         ("ridge-on-ball", False), ("smooth-line", False)])
def test_scenes_are_rough_by_their_peaks(name, rough):
    assert is_rough(tehl.scene(name)) == rough
    assert is_rough(rough_line())


@pytest.mark.slow
@pytest.mark.parametrize("srr", [-0.12, 0.12])
def test_bars_of_a_rough_line_cover_a_grid_four_times_finer(srr, tmp_path):
    """Nineteen of twenty numbers of the distribution at the surface and below, of both bodies, the others within two bars."""
    shares = []
    coarse, fine = (tehl.run(rough_line(**{"grid.nx": nx, "srr": srr}), tmp_path / f"{nx}.zarr").summary["fatigue_by_surface"]
                    for nx in (128, 512))
    for name, found in coarse.items():
        deep = {one["depth_m"]: one for one in fine[name]["below"]["statistics"]["by_depth"]}
        pairs = [(one, deep[one["depth_m"]]) for one in found["below"]["statistics"]["by_depth"]]
        known = [pair for pair in pairs if pair[0]["error"]["p99"] is not None]  # not where one grid alone reaches that near
        assert len(known) >= 4
        for one, other in ((found["statistics"], fine[name]["statistics"]), *known):
            shares += [abs(one[key] - other[key]) / max(one["error"][key], 1e-12) for key in index_statistics.NUMBERS]
    assert len(shares) >= 40 and np.mean(np.array(shares) <= 1) >= 0.95 and max(shares) < 2


def test_points_follow_a_feature_that_lies_off_the_axis():
    """A quarter of a half-width beside it: as many points, around it."""
    counts = []
    for y in (0.0, 0.25):
        reader = BothSides(NARROW, 32, 33)
        passage = StressHistories(NARROW.replace(**{"feature.y": y * reader.s.a}), reader, reader.centres)
        found = index_statistics.weights(passage)
        assert np.mean(passage.y[found.any(axis=0)] / reader.s.a) == pytest.approx(y, abs=0.02)
        counts.append(found.sum())
    assert counts[1] == pytest.approx(counts[0], rel=0.05)


def test_the_share_above_a_value_is_counted():
    rng = np.random.default_rng(1)
    Fi, counts = rng.normal(1, 0.3, 50), rng.integers(0, 3, 50).astype(float)
    for value, share in zip(*index_statistics.exceeded(Fi, counts)):
        assert share == pytest.approx(counts[Fi > value].sum() / counts.sum())


def test_a_mirrored_half_has_the_percentiles_of_the_whole():
    """A point that stands for two counts as both of them do, which differ by what the solver leaves."""
    half = np.array([0.3, 0.6, 0.8, 1.1, 1.2, 1.4])
    whole = np.concatenate([half * (1 + 1e-7 * np.random.default_rng(3).standard_normal(6)), half])
    one, both = (index_statistics.statistics(Fi, np.full(Fi.size, each)) for Fi, each in ((half, 2.0), (whole, 1.0)))
    assert (one.pop("points"), both.pop("points")) == (6, 12)
    assert one == pytest.approx(both, rel=1e-6) and index_statistics.statistics(np.zeros(3), np.ones(3))["p99"] == 0.0


@pytest.mark.parametrize("passed, chosen", [([2, 3], [5]), ([0, 1, 4], [])])
def test_below_single_features_only_their_own_rows_count(monkeypatch, passed, chosen):
    """Further rows are searched because of what is worst in them; a feature between the rows passes those beside it."""
    counts = np.zeros((40, 5))
    counts[:20, passed] = 1.0
    monkeypatch.setattr(index_statistics, "weights", lambda passage: counts)
    passage = SimpleNamespace(y=np.linspace(-2e-4, 2e-4, 5), rows=slice(3, 8), scene=NARROW, sought=Sought.ALL, boxed=False)
    found = index_statistics.points_below(passage)
    assert list(found) == chosen and all(mask.sum() == 20 for mask in found.values())
    for more in ({"sought": Sought.WORST}, {"boxed": True}):
        assert index_statistics.points_below(SimpleNamespace(**{**vars(passage), **more})) == {}


@pytest.mark.parametrize("count", [1, 3, 8, 9, 61])
def test_sampled_rows_are_spread_over_those_that_count(count):
    """At most eight, in the middle of equal parts: all where there are fewer, never with more at one end."""
    counts = np.zeros((4, count + 7))
    counts[1:3, 5 : 5 + count] = 2.0
    rows = sampled_rows.spread(counts) - 5
    assert rows.size == min(count, 8) == np.unique(rows).size and rows.min() >= 0 and rows.max() < count
    assert np.mean(rows) == pytest.approx((count - 1) / 2, abs=0.5) and np.ptp(np.diff(np.append(rows, rows[:1] + count))) <= 1


class RoughAcross(Rolling):
    """Pressure that is high on one row in four only, the row of the feature among them."""

    def fields(self, n, names):
        found = super().fields(n, ("pressure", "traction_x_a"))
        crest = 1 + 0.3 * (n > 0) * (np.arange(self.y.size) % 4 == 0)
        found = {name: field * crest for name, field in found.items()} | {"traction_y_a": 0 * found["pressure"]}
        return {name: found[name] for name in names}


def every_point(scene, reader, depths):
    """([{y: statistics of the points under this row}], [statistics of all points]), one per depth; from a search of all."""
    every = assessment.run(scene.replace(**{"fatigue.depths": depths}), reader, alone=False)
    found = [(field / scene.fatigue.endurance, every.passed) for field in every.findley_stress_at_depth[1:]]
    rows = np.flatnonzero((every.passed > 0).any(axis=0))
    by_row = [{float(every.feature_frame_y[row]): index_statistics.statistics(Fi[:, [row]], counts[:, [row]]) for row in rows}
              for Fi, counts in found]
    return by_row, [index_statistics.statistics(Fi, counts) for Fi, counts in found]


@pytest.mark.parametrize("half", [True, False])
def test_statistics_below_a_rough_surface_are_those_of_all_its_points(taichi_cpu, monkeypatch, half):
    """Against a search of all points at these depths. The rows of the worst points alone have a larger median."""
    scene = NARROW
    reader = RoughAcross(scene, 8, 17)
    if not half:
        reader.y = np.concatenate([-reader.y[:0:-1], reader.y])
    monkeypatch.setattr(index_statistics, "is_rough", lambda scene: True)
    deep = assessment.run(scene, reader, alone=False).summary["below"]["statistics"]
    rows, every = every_point(scene, reader, [one["depth_m"] for one in deep["by_depth"]])
    assert 1 < len(rows[0]) == deep["rows"] < 8  # so few that all are searched
    for one, whole, by_row in zip(deep["by_depth"], every, rows):
        assert {**one, **whole} == pytest.approx(one, rel=1e-4)
        assert one["median"] < by_row[min(by_row, key=abs)]["median"]


@pytest.mark.parametrize("reader, y, cells", [(Rolling, 0.0, 8), (BothSides, 5e-5, 16)])
def test_statistics_below_a_feature_are_those_of_its_row_at_their_depth(taichi_cpu, reader, y, cells):
    """Against a search of all points at these depths: stresses between the rungs are known to a thousandth of the index. Rows
    of a search beside the axis are numbered as in the whole grid.
    """
    scene = NARROW.replace(**{"feature.y": y})
    passage = reader(scene, cells, 17)
    deep = assessment.run(scene, passage, alone=False).summary["below"]["statistics"]
    rows, _ = every_point(scene, passage, [one["depth_m"] for one in deep["by_depth"]])
    assert deep["rows"] == 1 < len(rows[0])
    for one, by_row in zip(deep["by_depth"], rows):
        middle = by_row[min(by_row, key=lambda at: abs(at - y))]
        assert {**one, **middle} == pytest.approx(one, rel=1e-3)


def test_statistics_below_a_surface_use_the_limit_of_their_depth(taichi_cpu, tmp_path):
    """With a limit that doubles over depth the index of a depth falls as its limit rises."""
    reader = Rolling(NARROW, 8, 9)
    (tmp_path / "case.csv").write_text("depth_mm,limit_MPa\n0,400\n1,800\n")
    rising = NARROW.replace(**{"fatigue.table": str(tmp_path / "case.csv")})
    plain, stronger = (assessment.run(scene, reader, alone=False).summary["below"]["statistics"]["by_depth"]
                       for scene in (NARROW, rising))
    for one, other in zip(plain, stronger):
        assert other["p99"] == pytest.approx(one["p99"] / (1 + one["depth_m"] / 1e-3), rel=1e-6)


def test_the_sample_is_spread_over_all_points():
    chosen = np.flatnonzero(index_statistics.sample(np.ones((100, 40))))
    assert chosen.size <= index_statistics.SAMPLE and np.ptp(np.diff(chosen)) == 0
    assert 4000 - chosen[-1] <= chosen[1] - chosen[0]
