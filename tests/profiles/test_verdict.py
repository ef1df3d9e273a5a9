"""The suite of verdicts by strength: a row is what a run with these constants has, stores are used again, texts with bars."""

import math

import pytest
from tehl_taichi.profiles import verdict

import tehl_taichi as tehl
from tehl_taichi.errors import NotConverged

ROW = verdict.VerdictRow("gear", "case", 0.79, 1.09, 34e-6, {"Fi_surface": 0.013, "Fi_below": None}, "b", (5.96e8, 5.95e8))


def quick(monkeypatch, name, **changes):
    """The suite of this scene alone with these changes; the scene itself."""
    monkeypatch.setattr(verdict, "SCENES", (name,))
    monkeypatch.setattr(verdict, "QUICK", changes)
    return tehl.scene(name).replace(**changes)


@pytest.mark.slow
@pytest.mark.parametrize("variant", verdict.VARIANTS)
def test_a_row_is_the_summary_of_a_run_with_its_bars(tmp_path, monkeypatch, taichi_cpu, variant):
    base = quick(monkeypatch, "gear", **{"grid.nx": 256, "feature.length": math.inf, "thermal.on": False})
    monkeypatch.setattr(verdict, "VARIANTS", {variant: verdict.VARIANTS[variant]})
    row, = list(verdict.run(tmp_path, quick=True))[-1]
    scene = base.replace(**verdict.VARIANTS[variant], **{"numerics.estimate_error": True})
    found = tehl.run(scene, tmp_path / "a.zarr").summary["fatigue"]
    assert (row.surface, row.Fi_surface, row.Fi_below) == (found["surface"], found["Fi_max"], found["below"]["Fi_max"])
    assert row.depth_m == found["below"]["depth_m"]
    assert row.error == pytest.approx({"Fi_surface": found["error"]["Fi_max"], "Fi_below": found["below"]["error"]["Fi_max"]},
                                      rel=1e-4)  # stored fields have single precision
    assert any(error is not None for error in row.error.values())


@pytest.mark.slow
def test_rows_of_a_scene_and_its_stores_again(tmp_path, monkeypatch, taichi_cpu):
    quick(monkeypatch, "gear", **{"grid.nx": 32, "grid.ny": 8, "thermal.on": False})
    rows = {row.variant: row for row in list(verdict.run(tmp_path, quick=True))[-1]}
    assert list(rows) == list(verdict.VARIANTS) and all(not row.reason for row in rows.values())
    assert rows["case"].Fi_below < 0.8 * rows["default"].Fi_below and rows["all"].Fi_surface < rows["case"].Fi_surface
    assert rows["default"].limits_Pa == (4e8, 4e8) and rows["case"].limits_Pa[1] < rows["case"].limits_Pa[0] < 6e8
    assert {path.name for path in tmp_path.glob("*.zarr")} == {f"gear{own}-32x8.zarr" for own in ("", "-run-in", "-all")}
    assert rows["run-in"].Fi_below == rows["default"].Fi_below  # on this grid nothing yields at 2.2 GPa
    made = (tmp_path / "gear-32x8.zarr" / "zarr.json").stat().st_mtime_ns
    assert list(verdict.run(tmp_path, quick=True))[-1] == list(rows.values())
    assert (tmp_path / "gear-32x8.zarr" / "zarr.json").stat().st_mtime_ns == made


def test_a_scene_that_does_not_converge_says_why(tmp_path, monkeypatch):
    def lost(*args):
        raise NotConverged("step 3: residual 1e-2")

    monkeypatch.setattr(verdict, "run_or_resume", lost)
    rows = list(verdict.rows("dent", tmp_path))
    assert [row.reason for row in rows] == ["step 3: residual 1e-2"] * len(verdict.VARIANTS)
    assert "step 3" in verdict.page(rows)


def test_rows_are_handed_out_one_by_one(tmp_path, monkeypatch):
    """What an interruption leaves: each row as soon as it is known, in the order of scenes and variants."""
    made = []

    def passages(described, *_):
        made.append(described.name)
        if len(made) == 3:  # its run-in
            raise KeyboardInterrupt
        return None, []

    monkeypatch.setattr(verdict, "_passages", passages)
    monkeypatch.setattr(verdict, "_row", lambda name, variant, *_: verdict.VerdictRow(name, variant))
    so_far = []
    with pytest.raises(KeyboardInterrupt):
        so_far.extend(verdict.run(tmp_path, quick=True))
    assert [len(rows) for rows in so_far] == [1, 2, 3, 4] and [row.variant for row in so_far[-1]] == list(verdict.VARIANTS)[:4]
    assert len(list(verdict.run(tmp_path, quick=True))[-1]) == 5 and made == ["gear"] * 4  # the last one alone


def test_rows_are_kept_beside_their_stores(tmp_path, monkeypatch):
    """Of the same scene and version; a damaged one is searched again."""
    made = []

    def row(name, variant, *_):
        made.append(variant)
        return verdict.VerdictRow(**{**vars(ROW), "variant": variant})

    monkeypatch.setattr(verdict, "_passages", lambda *_: (None, []))
    monkeypatch.setattr(verdict, "_row", row)
    first, again = (list(verdict.rows("gear", tmp_path)) for _ in range(2))
    assert first == again and made == list(verdict.VARIANTS) and first[0].limits_Pa == ROW.limits_Pa
    (tmp_path / "gear-case-256x64.json").write_text("{")
    assert list(verdict.rows("gear", tmp_path)) == first and made[5:] == ["case"]
    monkeypatch.setattr(verdict, "RESIDUAL", None)
    monkeypatch.setitem(verdict.VARIANTS, "residual", {"fatigue.residual_xx": -3e8})
    list(verdict.rows("gear", tmp_path))
    assert made[6:] == ["residual"]
    monkeypatch.setattr(verdict, "__version__", "0.0")
    list(verdict.rows("gear", tmp_path))
    assert made[7:] == list(verdict.VARIANTS)


def search(top, deep, **more):
    return {"Fi_max": top, "below": {"Fi_max": deep, "depth_m": 25e-6}, **more}


def test_indices_are_taken_as_the_verdict_of_a_run_takes_them():
    """The averaged one where its error alone is known, the 99th percentile of rough surfaces."""
    known = {"a:Fi_max": None, "a:below_Fi_max": 0.02, "a:averaged_Fi_max": 0.01, "a:0 um.p99": 0.03, "a:12 um.p99": 0.04}
    wide = search(1.3, 1.4, averaged={"length_m": 1e-5, **search(0.9, 1.3)})
    assert [value[1:] for value in verdict._parts("a", wide, known)] == [(0.9, 0.01), (1.4, 0.02)]
    assert [value[1:] for value in verdict._parts("a", search(1.3, 1.4), known)] == [(1.3, None), (1.4, 0.02)]
    rough = search(1.3, 1.4, rough=True, statistics={"p99": 0.7})
    rough["below"]["statistics"] = {"p99": 0.8, "depth_m": 12e-6}
    assert [value[1:] for value in verdict._parts("a", rough, known)] == [(0.7, 0.03), (0.8, 0.04)]


def test_the_resolved_part_counts_where_its_error_alone_is_known():
    found = search(1.3, 1.4, resolved={**search(1.1, 1.2), "to_x_a": 0.9})
    known = {"a:Fi_max": None, "a:below_Fi_max": 0.02, "a:resolved_Fi_max": 0.01, "a:resolved_below_Fi_max": 0.015}
    top, deep = verdict._parts("a", found, known)
    assert top[1:] == (1.1, 0.01) and top[0]["to_x_a"] == 0.9 and deep[1:] == (1.4, 0.02)
    known["a:below_Fi_max"] = None
    assert [value[1:] for value in verdict._parts("a", found, known)] == [(1.1, 0.01), (1.2, 0.015)]
    del known["a:resolved_below_Fi_max"]
    assert [value[1:] for value in verdict._parts("a", found, known)] == [(1.1, 0.01), (1.4, None)]
    row = verdict.VerdictRow(**{**vars(ROW), "until_a": 0.9})
    assert "1.5 µm asperity (default), case profile: of the passage up to 0.90 a" in verdict.page([row])


def test_the_table_has_bars_and_says_what_runs_in():
    text = verdict.page([ROW])
    assert "| 1.5 µm asperity (default) | case profile | b | 0.790 ± 0.013 | 1.09 | 34 | 596, 595 |" in text
    assert "Run-in: three passages at most, both bodies" in text
    assert {"scene", "variant", "Fi_surface", "Fi_below", "depth_m", "error"} <= verdict.plain_row(ROW).keys()


def test_some_scenes_and_variants_run_in_the_order_of_all(tmp_path, monkeypatch):
    made = []
    monkeypatch.setattr(verdict, "_passages", lambda *_: (None, []))
    monkeypatch.setattr(verdict, "_row", lambda name, variant, *_: made.append(variant) or verdict.VerdictRow(name, variant))
    found = list(verdict.run(tmp_path, only=["rough-pair:all", "gear:case", "rough-pair:default", "dent"]))[-1]
    assert [(row.scene, row.variant) for row in found] == [
        ("gear", "case"), *(("dent", one) for one in verdict.VARIANTS), ("rough-pair", "default"), ("rough-pair", "all")]
    assert len(made) == 8 and {"gear", "dent:all", "rough-pair:run-in"} <= set(verdict.choices())
