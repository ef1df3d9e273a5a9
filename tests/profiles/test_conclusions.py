"""The suite of the thesis' conclusions: verdicts tell decided from undecided, stores are used again."""

import shutil
from pathlib import Path

import numpy as np
import pytest
from tehl_taichi.profiles import conclusions, measure, passage_stresses

from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales


def test_verdicts_need_more_than_the_error():
    assert conclusions.decide(10.0, 3.0) == "follows" and conclusions.decide(-10.0, 3.0) == "does not follow"
    assert conclusions.decide(2.0, 3.0) == conclusions.decide(np.nan, 1.0) == conclusions.decide(5.0, np.nan) == "not decided"


def make(name, f, error, body="a"):
    keys = [("all", window) for window in conclusions.WINDOWS] + [("no thermal stress", "whole"), ("pressure", "whole")]
    deep = {key: 1.4 * f for key in conclusions.DEEP.values()} | {conclusions.ALONE: 1.2 * f}
    values = {key: f for key in keys} | deep | {depth: 25e-6 for depth in conclusions.DEPTHS.values()}
    errors = {key: error for key in [*keys, *deep]}
    return conclusions.ConclusionRow(name, 0.0, values, errors, (0.06, 0.05), body=body, grid="512x64")


def test_the_statements_follow_from_the_rows():
    f = {"-0.12": 400e6, "+0": 370e6, "+0.12": 380e6}
    rows = [make(f"asperity 1.5 um, SRR {srr}", value, 5e6) for srr, value in f.items()]
    rows += [make(f"dent 1.5 um, SRR {srr}", 365e6, 20e6) for srr in f]
    judged = {statement: verdict for statement, verdict, _ in conclusions.verdicts(rows, 400e6)}
    assert judged["Fi(SRR -0.12) > Fi(SRR +0.12): asperity 1.5 um; all; whole"] == "follows"
    assert judged["a dent gives less than an asperity of the same size (SRR +0); whole"] == "not decided"
    assert judged["a dent gives less than an asperity of the same size (SRR -0.12); to 0.5 a"] == "follows"
    assert [verdict for statement, verdict in judged.items() if "without slip" in statement] == ["follows"] * 2
    text = conclusions.page(rows, conclusions.verdicts(rows, 400e6), scene("gear"))
    assert "400 ± 5" in text and "560 ± 5 at 25 um" in text and "**follows**" in text
    for window in conclusions.DEEP:
        assert judged[f"the critical point lies below the surface: asperity 1.5 um, SRR -0.12; {window}"] == "follows"


def test_the_mating_body_has_its_rows_and_its_statements():
    """It is worse at -0.12 (b 450 against a 400), equal in rolling, and turns the statement about the slip round at +0.12."""
    f = {"-0.12": (400e6, 450e6), "+0": (370e6, 370e6), "+0.12": (380e6, 500e6)}
    rows = [make(f"asperity 1.5 um, SRR {srr}", one, 5e6, body) for srr, both in f.items() for body, one in zip("ab", both)]
    judged = {statement: verdict for statement, verdict, _ in conclusions.verdicts(rows, 400e6)}
    said = "Fi(SRR -0.12) > Fi(SRR +0.12): asperity 1.5 um; all; to 0.5 a"
    assert judged[said] == "follows" and judged["worse body: " + said] == "does not follow"
    mating = "body b has a larger stress than body a (surface or below): asperity 1.5 um, SRR {}; to 0.5 a"
    assert [judged[mating.format(srr)] for srr in f] == ["follows", "not decided", "follows"]
    text = conclusions.page(rows, conclusions.verdicts(rows, 400e6), scene("gear"))
    assert "| asperity 1.5 um, SRR -0.12 | a | 512x64 | 400 ± 5 |" in text
    assert "| asperity 1.5 um, SRR -0.12 | b | 512x64 | 450 ± 5 |" in text


def test_the_larger_of_two_is_known_where_both_are():
    assert conclusions.larger((400, 5), (450, 7)) == (450, 7) and conclusions.larger((449, 9), (450, 7)) == (450, 9)
    f, error = conclusions.larger((400, np.nan), (450, 7))
    assert f == 450 and np.isnan(error)


def test_columns_leave_out_finer_grids():
    name = conclusions.DECIDE[0]
    assert conclusions.grids_of(name)[-1] == (2048, 64) and conclusions.grids_of(name, columns=512) == conclusions.GRIDS
    assert conclusions.grids_of(name, columns=256) == conclusions.GRIDS[:2]
    with pytest.raises(SceneError, match="columns = 100 leaves no grid; allowed: at least 128"):
        conclusions.grids_of(name, columns=100)


class Spiked:
    """A store of a feature that passes from -1.5 to 1.2 a under Hertz' pressure, with one node of the outlet at 3 GPa while it
    is behind `since` a."""

    def __init__(self, since):
        self.scene, self.since = scene("gear"), since
        self.a = Scales.of(self.scene).a
        self.x = np.linspace(-2.5, 1.5, 65) * self.a
        self.at = np.linspace(-1.5, 1.2, 28)

    def fields(self, n, names):
        p = 2e9 * np.sqrt(np.maximum(1 - (self.x / self.a) ** 2, 0.0))
        if n and self.at[n - 1] > self.since:
            p[np.searchsorted(self.x, 0.9 * self.a)] = 3e9
        return {"pressure": np.stack([p, p], axis=1)}

    def scalar(self, name):
        if name == "feature_x":
            return np.append(np.nan, self.at * self.a)
        return np.array([self.fields(n, ())["pressure"].max() for n in range(len(self.at) + 1)])


def test_an_exit_that_is_not_resolved_has_no_error():
    """What is found before the peak is known."""
    assert passage_stresses.unresolved(Spiked(np.inf)) == {}
    late, early = passage_stresses.unresolved(Spiked(0.7)), passage_stresses.unresolved(Spiked(-0.7))
    exits = {(loads, window) for loads in conclusions.LOADS for window in ("exit", "whole")}
    assert set(late) == exits | {conclusions.DEEP["whole"]}
    assert ("all", "entry") in early and all(why.startswith("exit not resolved") for why in late.values())
    row = make("asperity", 400e6, np.nan)
    row.doubts["all", "whole"] = late["all", "whole"]
    assert "400 (exit not resolved)" in conclusions.cells(row) and "400 (error unknown)" in conclusions.cells(row)


def told_by(values, courses, doubts):
    return [passage_stresses.PassageStresses({"a": one}, course, (0.06, 0.05), doubts) for one, course in zip(values, courses)]


def test_three_grids_may_tell_a_peak_that_one_does_not():
    """Of the window of its pressures; what does not depend on them has its error anyway."""
    late, quiet = {"whole": (4.61e9, 5.40e9, 5.52e9)}, {"whole": (5.0e9, 5.2e9, 5.52e9)}
    key, alone = ("all", "whole"), conclusions.ALONE
    found = [{key: 446e6, alone: 478e6}, {key: 525e6, alone: 478e6}, {key: 556e6, alone: 478e6}]

    def told(key, pressures, doubt="exit not resolved"):
        return conclusions.error_of(key, told_by(found, [{"whole": (p, 2e9)} for p in pressures["whole"]], {key: doubt}))

    assert told(key, late)[0] == pytest.approx(40e6, rel=0.01) and np.isnan(told(key, quiet)[0])
    assert told(key, quiet, "")[0] > 0 and told(alone, quiet, "") == (0.0, "")


def test_a_rival_that_grows_is_named():
    key, row = ("all", "whole"), make("asperity", 406e6, 5e6)
    grown = [{"whole": (3.2e9, p)} for p in (1.93e9, 2.25e9, 3.07e9)]
    told = told_by([{key: f} for f in (404e6, 405e6, 406e6)], grown, {})
    row.errors[key], row.doubts[key] = conclusions.error_of(key, told)
    assert "406 (a rival grows)" in conclusions.cells(row)


def test_a_course_is_that_of_a_window():
    windows = conclusions.WINDOWS
    whole, early = (passage_stresses.course(Spiked(0.7), *windows[name]) for name in ("whole", "to 0.5 a"))
    assert len(whole) == len(early) and np.nanmax(whole) == 3e9 and np.isnan(early[-3]) and np.nanmax(early) < 2.1e9


def test_every_case_has_its_own_store():
    names = [conclusions.file_name(name) for name in conclusions.cases()]
    assert len(set(names)) == len(names) == 21


@pytest.mark.slow
def test_a_row_is_computed_once_and_kept(taichi_cpu, tmp_path):
    short = scene("gear").replace(**{"thermal.on": False, "time.steps": 4})
    lines = []
    found, deep = conclusions.rows("short", short, tmp_path, ((64, 16), (96, 16)), lines.append), conclusions.DEEP["whole"]
    assert len(lines) == 2 and [one.body for one in found] == ["a", "b"] and {one.grid for one in found} == {"96x16"}
    for one in found:
        assert one.values["all", "whole"] > 1e8 and one.errors["all", "whole"] > 0
        assert one.values[deep] > 1e8 and 1e-6 < one.values[conclusions.DEPTHS[deep]] < 0.3e-3
    assert found[0].values["all", "whole"] != found[1].values["all", "whole"]
    before = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*") if path.is_file()}
    assert conclusions.rows("short", short, tmp_path, ((64, 16), (96, 16))) == found
    assert before == {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*") if path.is_file()}
    with pytest.raises(StoreError, match="another scene"):
        conclusions.rows("short", short.replace(srr=0.1), tmp_path, ((64, 16),))
    hopeless = short.replace(**{"numerics.newton_max": 1, "numerics.krylov_max": 5})
    assert "did not converge" in conclusions.rows("hopeless", hopeless, tmp_path, ((64, 16),))[0].reason


@pytest.mark.slow
def test_a_large_store_goes_when_it_has_told(taichi_cpu, tmp_path, monkeypatch):
    """What it told serves the next time, and only for the scene that it tells of."""
    short = scene("gear").replace(**{"thermal.on": False, "time.steps": 4, "grid.nx": 64, "grid.ny": 16, **measure.BARE})
    store, kept = tmp_path / "short.zarr", tmp_path / "short.json"
    small = passage_stresses.read_passage(short, store)
    assert store.exists() and not kept.exists()
    part = Path(shutil.copytree(store, tmp_path / "part"))
    monkeypatch.setattr(passage_stresses, "LARGE", 1000)
    large = passage_stresses.read_passage(short, store)
    assert kept.exists() and not store.exists()
    for array in (one for one in part.iterdir() if one.is_dir()):  # what names a store goes last
        shutil.rmtree(array)
    part.rename(store)
    again = passage_stresses.read_passage(short, store)
    assert not store.exists() and again.doubts == large.doubts and again.friction == large.friction
    assert again.values == large.values == small.values
    for window, course in small.courses.items():
        np.testing.assert_array_equal(again.courses[window], course)
    with pytest.raises(StoreError, match="another scene"):
        passage_stresses.read_passage(short.replace(srr=0.1), store)


def test_moments_of_many_columns_are_thinned():
    gear = scene("gear")
    every = [conclusions._sized(gear, nx, 64).output.every for nx in (64, 1024, 2048)]
    assert every == [1, 1, 2]
