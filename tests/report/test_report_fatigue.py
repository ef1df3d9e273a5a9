"""Reports of a fatigue search: maps of the index, depths, why an error is not known, what makes the answer less sure."""

from types import SimpleNamespace

import made_results
import numpy as np
import pytest
from made_results import THERMAL
from read_pages import numbers, page, values

import tehl_taichi as tehl
from tehl_taichi.march.accuracy import readings
from tehl_taichi.report import chain_plot, number_text, run_tables
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_text import Reason

pytest.importorskip("plotly")
pytest.importorskip("jinja2")
pytestmark = pytest.mark.usefixtures("without_library")


def test_maps_of_the_index_have_a_line_where_it_is_one(thermal, tmp_path):
    seen = page(thermal, tmp_path)
    levels = {name: [trace for trace in figure["data"] if trace["type"] == "contour"] for name, figure in seen.figures.items()}
    assert [name for name, found in levels.items() if found] == []  # made up: its largest is 1
    maps = made_results.maps()
    maps["Fi"] = (1.3 * maps["Fi"][0], *maps["Fi"][1:])
    made = made_results.run(tmp_path / "a.zarr", search=made_results.fatigue(1.3), found=maps)
    seen = page(made, tmp_path)
    rim, white = [trace for trace in seen.figures["index-surface"]["data"] if trace["type"] == "contour"]
    assert white["contours"]["start"] == white["contours"]["end"] == 1 and white["line"]["width"] < rim["line"]["width"]
    drawn = numbers(white).reshape([int(count) for count in white["z"]["shape"].split(", ")])
    around = made_results.maps()["Fi"][0][2:7, :3].T[[2, 1, 0, 1, 2]]  # what is above 1, and one more on each side
    assert drawn == pytest.approx(1.3 * around, rel=1e-6)
    assert "blue line: trace of the critical plane (at 0° it lies in the surface), white line: Fi = 1." in seen.text


@pytest.mark.parametrize("listed, shown", [([0.0, 6e-5, 2.4e-4], 60), ([0.0, 2.5e-5], 25)])
def test_listed_depths_have_their_map_and_the_section(tmp_path, listed, shown):
    """The map of the listed depth next to the worst, 25 µm, which is marked where it lies there; the section has its own."""
    maps = made_results.maps()
    layers = np.stack([maps["Fi"][0]] * len(listed)) * 4e8 * np.arange(1, len(listed) + 1)[:, None, None]
    maps |= {"under_row_depth": maps["fatigue_depth"], "fatigue_depth": (np.array(listed), ["d"], "m", "listed"),
             "findley_stress_at_depth": (layers, ["d", "x", "y"], "Pa", "stress")}
    seen = page(made_results.run(tmp_path / "a.zarr", search=made_results.fatigue(), found=maps), tmp_path)
    assert f"Index Fi {shown} µm below the surface" in seen.text and {"section", "over-depth"} <= set(seen.places)
    below = seen.figures["index-below"]["data"]
    assert numbers(below[0]).max() == pytest.approx(2.0)
    assert any("critical point" in trace.get("name", "") for trace in below) == (shown == 25)
    assert ("The critical depth is 25 µm, under the row y = 0 µm, with Fi = 1.39." in seen.text) == (shown != 25)
    assert numbers(seen.figures["over-depth"]["data"][0]) == pytest.approx(maps["under_row_depth"][0] * 1e6)


@pytest.mark.parametrize("limits", [None, np.array([8e8, 4e8, 2e8])])
def test_one_figure_leads_from_the_load_to_the_verdict(tmp_path, limits):
    """Its last panel is the stress of the second over the strength of the third."""
    maps = made_results.maps()
    depths = maps["fatigue_depth"][0]
    if limits is not None:
        limits = np.resize(limits, depths.size)
        maps |= {"limit_under_row": (limits, ["d"], "Pa", "limit")}
    seen = page(made_results.run(tmp_path / "a.zarr", search=made_results.fatigue(), found=maps), tmp_path)
    traces = seen.figures["chain"]["data"]
    panel = {n: [one for one in traces if one["xaxis"] == ("x" if n == 1 else f"x{n}")] for n in (1, 2, 3, 4)}
    x = {n: [values(one["x"]) for one in found] for n, found in panel.items()}
    assert x[3][1] == pytest.approx(np.full(depths.size, 400.0) if limits is None else limits / 1e6, rel=1e-6)
    stress = maps["findley_stress_under_row"][0].max(axis=1) / 1e6
    assert x[2][0] == pytest.approx(stress, rel=1e-6) and x[4][0] == pytest.approx(stress / x[3][1], rel=1e-6)
    least = [values(one["y"]).min() for one in panel[1]]  # in the middle, made up as p_H (1 + 0.1 step)
    assert least == pytest.approx([1.4e-9 * Scales.of(THERMAL).p_H, 1e-9 * Scales.of(THERMAL).p_H], rel=0.01)


@pytest.mark.parametrize("numbers, until", [({}, 0.0), ({"to_x_a": 0.0}, np.inf)])
def test_its_load_is_of_the_moments_of_the_search(tmp_path, numbers, until):
    """The pressures that are made up grow; those after X = 0, the third moment, are not of the search."""
    store = tehl.open(made_results.run(tmp_path / "a.zarr", search=made_results.fatigue())).store
    result = made_results.result({**made_results.fatigue(), **numbers})
    search = SimpleNamespace(result=result, scene=THERMAL.replace(**{"fatigue.to_x": until}), on="")
    loaded = chain_plot.figures(store, search)[0].traces[0]
    assert np.min(loaded["y"]) == pytest.approx(1.3e-9 * Scales.of(THERMAL).p_H, rel=0.01)


def test_a_plane_that_is_not_at_the_worst_depth_has_its_own_mark(tmp_path):
    """The critical depth is looked for once more under the row of what is worst in the plane, which then lies beside it."""
    maps = made_results.maps()
    plane = np.roll(maps["Fi"][0], 2, axis=0) * 4e8 * 1.2
    maps |= {"worst_depth": (np.array([27.3e-6]), ["d"], "m", "depth"),
             "findley_stress_at_worst_depth": (plane, ["x", "y"], "Pa", "stress")}
    seen = page(made_results.run(tmp_path / "a.zarr", search=made_results.fatigue(), found=maps), tmp_path)
    mark, = [trace for trace in seen.figures["index-below"]["data"] if "Fi = " in trace.get("name", "")]
    assert mark["name"] == "largest at this depth, Fi = 1.20" and mark["y"] == [0.0]
    assert mark["x"] == pytest.approx([50.0])
    assert "Index Fi 27.3 µm below the surface" in seen.text
    assert "The critical depth is 25 µm, under the row y = 0 µm, with Fi = 1.39." in seen.text


def test_a_long_reason_why_an_error_is_not_known_stands_once_behind_the_tables(tmp_path, monkeypatch):
    why = Reason("exit not resolved: " + readings.SPIKE.format(0.9), "exit")
    other = Reason("its place differs from that on the next coarser grid", "place")
    monkeypatch.setitem(made_results.EXTRA, "passage_error", {"p_max_Pa": None, "a:Fi_max": None, "a:below_Fi_max": None})
    monkeypatch.setitem(made_results.EXTRA, "passage_unknown", {"p_max_Pa": why, "a:Fi_max": why, "a:below_Fi_max": other})
    seen = page(made_results.run(tmp_path / "a.zarr", search=made_results.fatigue()), tmp_path).text
    assert seen.count(why) == 1 and seen.count("\nexit not resolved ¹\n") == 2 and seen.count("\nnot known ²\n") == 1
    assert f"\nWhy an error is unknown\n¹ {why}\n² {other}\n" in seen


YIELDED = {"max_Pa": 2.4e9, "depth_m": 1e-5, "surface": "a", "yield_stress_Pa": 2.2e9, "yields": True}


@pytest.mark.parametrize("search", [made_results.fatigue(), None])
def test_that_steel_would_yield_is_said_once(tmp_path, search):
    """First of all doubts where there is an index, else among the warnings."""
    if search:
        search = {**search, "von_mises": YIELDED}
    from tehl_taichi.runs.summary.result_warnings import yielding
    from tehl_taichi.values.coded_warning import coded_warning

    said = [*coded_warning({yielding: "yield"}, SimpleNamespace(scene=THERMAL), {"von_mises": YIELDED}), "another one"]
    made = made_results.run(tmp_path / "a.zarr", THERMAL, 14, search, said=said)  # up to 2.3 p_H
    text = page(made, tmp_path).text
    assert text.count("hardened bearing steel yields") == 1 and ("the von Mises stress reaches" in text) == (search is None)
    assert ("Read the warning below first" if search else "Read the 2 warnings below first") in text


def test_a_cut_passage_says_so(tmp_path):
    cut = made_results.THERMAL.replace(**{"time.steps": 4})
    text = page(made_results.run(tmp_path / "a.zarr", cut, 5, made_results.fatigue()), tmp_path).text
    assert "inside the contact; later moments are not part of these numbers" in text and "rest of the passage" not in text


def test_every_row_of_the_critical_points_has_its_own_number():
    keys = {key: unit for _, key, unit in run_tables.POINT if key != "Fi_max"}
    of = {key: (1.25 + 0.1 * n) * {"Pa": 1e8, "m": 1e-5}.get(unit, 1.0) for n, (key, unit) in enumerate(keys.items())}
    top = {key: value for key, value in of.items() if key != "depth_m"}
    found = run_tables.worst_points({**top, "Fi_max": 0.5, "below": {**of, "Fi_max": 0.7}}, THERMAL).data["rows"]
    rows = {label.partition(" of the ")[0]: texts for label, *texts in found}
    assert [rows[axis] for axis in "xy"] == [[number_text.value_text(of[f"{axis}_m"], unit="m")] * 2
                                                                   for axis in "xy"]
    assert rows["index Fi"] == ["0.5", "0.7"] and rows["depth"] == ["0 µm", number_text.value_text(of["depth_m"], unit="m")]
    assert len(set(map(tuple, rows.values()))) == len(rows) == len(run_tables.POINT)


def test_places_in_a_scan_are_those_from_its_own_middle():
    scan = SimpleNamespace(x=3e-4, y=-2e-4, position_in_file=lambda *place: place)
    assert run_tables.in_file(SimpleNamespace(features=[scan]), 3.5e-4, 1e-4) == pytest.approx((0.5e-4, 3e-4))
