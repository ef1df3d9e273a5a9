"""What pages draw and tables say against numbers worked out apart: units, places, edges of what is allowed."""

import dataclasses
import math
from types import SimpleNamespace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.scene import hertz

pytest.importorskip("plotly")


def test_the_circle_around_a_shear_path_is_round_and_where_the_path_is(monkeypatch):
    """In MPa: every point as far from the centre as its radius, the points that touch it among them."""
    from tehl_taichi.report import fatigue_plots

    n = 40
    history = {"stress": 1e8 * np.stack([np.sin(np.linspace(0, 6, n) + k) for k in range(6)], axis=1),
               "normal": np.array([0.6, 0.0, 0.8]), "circle": np.array([2e7, -3e7, 1.5e8])}
    monkeypatch.setattr(fatigue_plots, "_briefly", lambda search: "")
    figure = fatigue_plots._path(SimpleNamespace(on=""), "worst", "point", history)
    path, circle, touching = figure.traces
    away = np.hypot(np.array(circle["x"]) - 20.0, np.array(circle["y"]) + 30.0)
    assert away == pytest.approx(np.full(away.size, 150.0)) and np.ptp(circle["x"]) == pytest.approx(300.0, rel=1e-2)
    dip, strike, _ = fatigue_plots.shear_path(history["stress"], history["normal"])
    assert np.array(path["x"]) == pytest.approx(dip / 1e6) and np.array(path["y"]) == pytest.approx(strike / 1e6)
    assert set(np.round(touching["x"], 6)) <= set(np.round(dip / 1e6, 6))


def test_the_section_of_a_crack_is_drawn_in_micrometres_and_megapascals(monkeypatch):
    from tehl_taichi.report import crack_plots

    calls = []

    def field_map(name, caption, x, y, values, *more, **options):
        calls.append((x, y, values))
        return SimpleNamespace(layout={"xaxis": {}, "yaxis": {}})

    monkeypatch.setattr(crack_plots, "field_map", field_map)
    shown = {"x": [-4e-5, 0.0, 4e-5], "depth": [0.0, 1e-5, 5e-5], "tension": [[1e8] * 3, [2e8] * 3, [3e8] * 3], "sides": {}}
    figure = crack_plots._map({"pit_angles_deg": [18.0, 50.0]}, shown)
    x, depth, tension = calls[0]
    assert x.tolist() == pytest.approx([-40, 0, 40]) and depth.tolist() == pytest.approx([0, 10, 50])
    assert tension[:, 0].tolist() == pytest.approx([100, 200, 300])
    assert figure.layout["xaxis"]["range"] == pytest.approx([-40, 40])
    assert figure.layout["yaxis"]["range"] == pytest.approx([50, 0])


def test_a_flank_names_the_largest_index_first(tmp_path):
    import made_results

    from tehl_taichi.report import place_page, place_verdict

    found = place_page.judged_places(tehl.open(made_results.flank(tmp_path)))
    assert [place.Fi for place in found] == [1.4, 0.7] and "at A" in found[0].where and "at C" in found[1].where
    assert place_verdict.worst(found) is found[0]


@pytest.mark.parametrize("pair, said", [("fzg-c", "trapezoid"), (None, "of the table")])
def test_a_flank_says_how_its_load_is_shared(pair, said):
    from tehl_taichi.runs.flank.flank_run import _sharing
    from tehl_taichi.scene.gear_pair import gear_pair

    found = gear_pair(pair) if pair else None
    assert _sharing(found).startswith(said)
    if pair:
        assert "length of the contact lines" in _sharing(SimpleNamespace(load_share=(), beta=20.0))
        assert _sharing(dataclasses.replace(found, load_share=((-1e-3, 0.5), (1e-3, 1.0)))) == "gear.load_share"


@pytest.mark.parametrize("column, least, unit", [("R_a_mm", 0.1, "mm"), ("load_N_per_mm", 1e-3, "N/mm"),
                                                 ("u_a_m_s", 0.0, "m/s")])
def test_the_least_that_a_table_of_a_flank_may_have(tmp_path, column, least, unit):
    from tehl_taichi.runs.flank import load_table

    row = {"x_pl_mm": 1.0, "R_a_mm": 9.0, "R_b_mm": 8.0, "u_a_m_s": 8.0, "u_b_m_s": 9.0, "load_N_per_mm": 200.0}
    for value, good in ((least, True), (least - 1e-4 if least < 1e-2 else 0.99 * least, False)):
        (tmp_path / "t.csv").write_text(f"{','.join(row)}\n{','.join(str(one) for one in {**row, column: value}.values())}\n")
        if good:
            assert len(load_table.load(tmp_path / "t.csv")) == 1
        else:
            with pytest.raises(tehl.SceneError, match=f"{column} .*{unit}"):
                load_table.load(tmp_path / "t.csv")


def test_rows_of_a_table_of_a_flank_are_in_si_units(tmp_path):
    from tehl_taichi.runs.flank import load_table

    (tmp_path / "t.csv").write_text("x_pl_mm,R_a_mm,R_b_mm,u_a_m_s,u_b_m_s,load_N_per_mm\n"
                                    "1.5,9,8,7,6,200\n-2.5,19,18,17,16,100\n")
    first, second = load_table.load(tmp_path / "t.csv")
    assert (first.x_pl, first.rho_a, first.rho_b, first.u_a, first.u_b, first.load) == pytest.approx(
        (-2.5e-3, 19e-3, 18e-3, 17, 16, 100e3))
    assert second.R == pytest.approx(9e-3 * 8e-3 / 17e-3) and second.srr == pytest.approx(1 / 6.5) and second.u_m == 6.5


def test_one_sample_and_the_seed_nought_are_enough():
    from tehl_taichi.runs.sweep.sampling import latin_hypercube

    assert len(latin_hypercube({"srr": [0.1, 0.2]}, 1, 0).rows) == 1
    for samples, seed in ((0, 0), (1, -1)):
        with pytest.raises(tehl.SceneError, match="must be a whole number of at least"):
            latin_hypercube({"srr": [0.1, 0.2]}, samples, seed)


@pytest.mark.parametrize("name, cells", [("coarse", (128, 32)), ("medium", (256, 64)), ("fine", (512, 128)),
                                         ("96x24", (96, 24))])
def test_grids_by_their_names(monkeypatch, name, cells):
    from commands import here

    calls = []
    monkeypatch.setattr("tehl_taichi.run", lambda scene, *more, **options: calls.append(scene) or (_ for _ in ()).throw(
        tehl.SceneError("caught")))
    assert here("run", "gear", "--grid", name, "--threads", 2).stderr.endswith("tehl: caught\n")
    assert (calls[0].grid.nx, calls[0].grid.ny) == cells


@pytest.mark.parametrize("ratio", [0.2, 0.7, 1.0, 1.6, 5.0])
def test_an_ellipse_carries_its_load(ratio):
    """2/3 pi a b p_H, and turned by 90 degrees it is the same one."""
    load, E, Rx = 120.0, 2.2e11, 11e-3
    found = hertz.ellipse(load, Rx, ratio * Rx, E)
    other = hertz.ellipse(load, ratio * Rx, Rx, E)
    a, b, p = found
    assert 2 / 3 * math.pi * a * b * p == pytest.approx(load, rel=1e-9)
    assert other == pytest.approx((b, a, p), rel=1e-6) and (b > a) == (ratio > 1) or ratio == 1.0


def test_waves_of_a_measured_surface_are_pressed_flat_by_what_johnson_says():
    """E'/4 q h, along x and along y, with points closer along one of them."""
    from tehl_taichi.scene.surface.maps.flattening_pressure import flattening

    dx, dy, E, h = 1e-6, 2e-6, 2.2e11, 1e-7
    rows, columns = 300, 400
    for waves, along in ((20, "x"), (15, "y")):
        x, y = np.arange(columns) * dx, np.arange(rows) * dy
        length = columns * dx if along == "x" else rows * dy
        wave = np.cos(2 * np.pi * waves * (x[None, :] if along == "x" else y[:, None]) / length)
        p = flattening(h * wave * np.ones((rows, columns)), (dx, dy), E)
        middle = p[p.shape[0] // 4 : -(p.shape[0] // 4), p.shape[1] // 4 : -(p.shape[1] // 4)]
        assert middle.max() == pytest.approx(E / 4 * 2 * np.pi * waves / length * h, rel=0.05)


def test_the_shear_law_of_the_base_is_doubted_with_an_oil_of_ones_own_alone():
    """Not with a named oil, not without slip, not where a law was chosen."""
    from tehl_taichi.scene.oil_range import _shear

    gear = tehl.scene("gear")
    own = dataclasses.replace(gear, oil=dataclasses.replace(gear.oil, name="mine"))
    assert len(list(_shear(own))) == 1 and "oil.name = mine" in next(iter(_shear(own)))
    assert list(_shear(gear)) == []
    for changes in ({"srr": 0.0}, {"rheology.law": "newtonian"}, {"rheology.gamma": 0.07}):
        assert list(_shear(own.replace(**changes))) == [], changes


def test_room_is_asked_for_an_array_and_one_of_its_chunks(tmp_path, monkeypatch):
    """Both are in memory while it is read."""
    import zarr

    from tehl_taichi.store import chunks

    array = zarr.open_group(str(tmp_path), mode="w").create_array("a", shape=(6, 5), chunks=(4, 5), dtype="f8",
                                                                  compressors=zarr.codecs.ZstdCodec(level=1, checksum=True))
    array[:] = np.arange(30.0).reshape(6, 5)
    asked = []
    monkeypatch.setattr(chunks.memory_limit, "check", lambda size, what, kind=None: asked.append(size))
    chunks.check(tmp_path / "a")
    assert asked[0] == 8 * (30 + 20)


def test_the_bar_of_a_run_counts_steps_and_names_what_comes_later(monkeypatch):
    from tehl_cli import live_curves
    from tehl_cli.live_display import Live

    from tehl_taichi.runs.progress import PASSAGE

    made = []

    class Bar:
        def __init__(self, drawn, total, done, name):
            made.append((total, done, name))

        def start(self):
            pass

    monkeypatch.setattr(live_curves, "CurvesBar", Bar)
    live = Live()
    live._start_bar(PASSAGE, 3, 40)
    live._start_bar("fatigue", 1, 9)
    assert made == [(40, 3, "step"), (9, 1, "fatigue")]


def test_a_column_of_a_flank_shows_numbers_in_its_unit_words_as_they_are_and_nothing_for_nothing():
    from tehl_taichi.runs.table_column import TableColumn

    column = TableColumn("h_c", "h_c um", 1e6, ".3f", lambda value: value, "")
    assert [column.shown(value) for value in (2.5e-6, "at C", "", None, 0.0)] == ["2.500", "at C", "", "", "0.000"]


def test_the_least_and_the_largest_mean_speed():
    """1 um/s to 1 km/s, as scene_keys says."""
    for speed, good in ((1e-6, True), (0.99e-6, False), (1.01e3, False)):
        if good:
            assert tehl.scene("smooth-line").replace(**{"speed": speed, "thermal.on": False}).operation.u_m == speed
        else:
            with pytest.raises(tehl.SceneError, match="u_m"):
                tehl.scene("smooth-line").replace(**{"speed": speed, "thermal.on": False})


def test_values_that_are_numbers_alone_are_numbers_in_a_table():
    from tehl_taichi.runs.sweep.axis_syntax import all_numbers

    assert all_numbers([1, 2.5, -3]) and not any(map(all_numbers, (["a", "b"], [1, "a"], [True, False], [1.0, True])))
