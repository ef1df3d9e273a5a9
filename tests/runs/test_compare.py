"""Runs side by side: what differs, which numbers, one figure."""

import functools
import json
from types import SimpleNamespace

import made_results
import numpy as np
import pytest
from small_stores import SMALL, store
from tehl_cli.main import app
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.runs import compare_figure
from tehl_taichi.runs.compare_labels import flat

OTHER = SMALL.replace(name="other", srr=0.12, height=1e-6)


@pytest.fixture
def two(tmp_path):
    """Two stores that are not finished, of scenes that differ in two values, and are named alike in two folders."""
    for folder, description in (("a", SMALL), ("b", OTHER)):
        (tmp_path / folder).mkdir()
        store(tmp_path / folder / "run.zarr", 4, description)
    return tmp_path / "a" / "run.zarr", tmp_path / "b" / "run.zarr"


@pytest.fixture(scope="module")
def runs(taichi_cpu, tmp_path_factory):
    """Two finished short passages: the same asperity at two slips."""
    folder = tmp_path_factory.mktemp("runs")
    base = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "numerics.estimate_error": False,
                                         "time.x_start": -1.4, "time.steps": 4, "fatigue.depths": ()})
    return [tehl.run(base.replace(srr=srr), folder / f"{name}.zarr") for name, srr in (("slow", -0.12), ("fast", 0.12))]


def test_only_what_differs_of_the_scenes_is_told(two):
    found = tehl.compare(*two)
    assert found.differs == {"operation.srr": [-0.12, 0.12], "feature.0.height": [1.5e-6, 1e-6]}
    assert found.names == ["a/run", "b/run"]
    assert found.labels() == ["srr = -0.12, height = 1.5e-06", "srr = 0.12, height = 1e-06"]
    assert found.summaries == {}  # neither is finished


def test_a_third_difference_leaves_the_names_as_labels(two, tmp_path):
    store(tmp_path / "third.zarr", 3, SMALL.replace(load=1.2e6))
    assert tehl.compare(*two, tmp_path / "third.zarr").labels() == ["a/run", "b/run", tmp_path.name + "/third"]


def test_a_named_oil_is_one_difference(two, tmp_path):
    store(tmp_path / "oil.zarr", 3, SMALL.replace(**{"oil.name": "mineral-vg100", "bodies.a.material": "100Cr6"}))
    found = tehl.compare(two[0], tmp_path / "oil.zarr")
    assert found.labels() == ["material = none, oil = reference-pao", "material = 100Cr6, oil = mineral-vg100"]
    assert found.differs["oil.G0"] == [4.57, 4.365]  # the table tells the numbers, too


def test_summaries_stand_side_by_side(runs):
    found = tehl.compare(*runs)
    summaries = [run.summary for run in runs]
    for part, key in (("steady", "h_c_m"), ("transient", "p_max_Pa"), ("fatigue", "Fi_max")):
        assert found.summaries[f"{part}.{key}"] == [summary[part][key] for summary in summaries]
    assert not any(key.startswith(("store", "warnings", "left_out")) for key in found.summaries)


def test_a_run_that_is_not_finished_has_no_numbers(runs, tmp_path):
    store(tmp_path / "broken.zarr", 3)
    found = tehl.compare(runs[0], tmp_path / "broken.zarr")
    assert found.summaries["steady.h_c_m"] == [runs[0].summary["steady"]["h_c_m"], None]
    assert found.to_dict()["finished"] == [True, False]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Three finished runs of numbers that were made up: the second on a scene of another slip, the third without fatigue."""
    folder = tmp_path_factory.mktemp("made")
    deep = made_results.fatigue(1.2, 1.392)
    deep["below"]["depth_m"] = 40e-6
    scene = made_results.THERMAL
    return [made_results.run(folder / "a.zarr", scene, search=made_results.fatigue()),
            made_results.run(folder / "b.zarr", scene.replace(srr=0.12), 4, search=deep),
            made_results.run(folder / "c.zarr", scene)]


def lines_of(*paths):
    return {line.what: line for line in tehl.compare(*paths).lines}


def test_results_are_told_as_tehl_show_tells_them(made):
    """Where a value lies is told with it where runs differ in that; what stands twice tells its part."""
    from tehl_taichi.runs.summary.summary_rows import summary_rows

    found, shown = lines_of(*made[:2]), [dict(summary_rows(tehl.open(path).summary)) for path in made[:2]]
    for what in ("passage p_max", "Fi_max at the surface", "steady h_min", "run time"):
        assert found[what].values == tuple(one[what] for one in shown)
    assert found["Fi_max below the surface"].values == ("1.39 (error unknown), at 25 um", "1.39 (error unknown), at 40 um")
    assert found["Fi_max of the smooth contact, at 180 um"].values == ("0.9 (error unknown)",) * 2
    assert found["findley stress"].values == ("403.2 ± 9.2 MPa", "480.0 ± 9.2 MPa")
    assert found["findley stress, below it"].same and not found["findley stress"].same
    assert found["critical plane, angle to the surface"].values[0] == "57.0 deg"  # without the usual angles of pits
    order = list(found)
    assert order.index("passage p_max") < order.index("Fi_max at the surface") < order.index("findley stress, below it")


def test_the_change_of_two_runs_is_told_where_it_means_something(made, monkeypatch):
    found = lines_of(*made[:2])
    p = [tehl.open(path).summary["transient"]["p_max_Pa"] for path in made]
    assert found["passage p_max"].change == f"{100 * (p[1] / p[0] - 1):+.2g}%" and found["findley stress"].change == "+19%"
    for what in ("at x, y (as feature.x, feature.y)", "with kappa, sigma_eF", "passage film / surface a / surface b, largest"):
        assert found[what].change == ""
    assert {line.change for line in lines_of(*made).values()} == {""}  # of three


@pytest.mark.parametrize("first, error, second, change", [
    (0.2, 0.01, 0.1, "-50%"), (0.2, None, 0.201, "+0.5%"), (0.02, 0.05, 0.3, ""), (0.02, None, 0.3, "x 15"),
    (0.0, None, 0.3, "")])
def test_no_change_from_what_may_be_nothing(first, error, second, change):
    from tehl_taichi.runs.compare_rows import _line
    from tehl_taichi.runs.summary.summary_row import row_of

    rows = [row_of({"h": h, "error": {"h": bar}}, "h", "film") for h, bar in ((first, error), (second, None))]
    assert _line("film", rows).change == change


def test_what_a_run_does_not_have_is_a_dash_in_its_place(made, tmp_path):
    found = lines_of(made[2], made[0], store(tmp_path / "begun.zarr").path)
    assert found["Fi_max at the surface"].values == ("-", "1.008 ± 0.023", "-") and found["steady h_c"].values[2] == "-"
    order = list(found)
    assert order.index("worst residual / load / mass error") < order.index("Fi_max at the surface") < order.index("run time")


def test_the_command_tells_what_differs_and_what_is_the_same(made):
    told = CliRunner().invoke(app, ["compare", *map(str, made[:2])], env={"COLUMNS": "100"}).stdout
    scenes, results, same = told.index("operation.srr"), told.index("passage p_max"), told.index("equal in all: ")
    assert scenes < results < same and "change" in told and "p_max_Pa" not in told
    assert "Hertz pressure p_H" in told[same:] and "Hertz pressure p_H" not in told[:same]
    assert max(map(len, told[:same].splitlines())) <= 100


def test_runs_of_one_scene(tmp_path):
    made = [made_results.run(tmp_path / f"{n}.zarr", SMALL) for n in range(2)]
    told = CliRunner().invoke(app, ["compare", *map(str, made)]).stdout
    assert "the settings are identical" in told and "differences" not in told and "equal in all: Hertz" in told


@pytest.mark.rendered
def test_the_figure_shows_all_runs_at_one_position(runs, tmp_path, monkeypatch):
    shown = []
    monkeypatch.setattr(compare_figure, "_legend", lambda page, figure, curves: shown.append((figure, curves)))
    path = tehl.compare(*runs).plot(tmp_path / "both.png", at=-1.15)
    (figure, curves), = shown
    assert path.stat().st_size > 20_000 and len(figure.axes) == 6
    for curve, run in zip(curves, runs):
        at = run.store.scalar("feature_x")[curve.entry] / curve.a
        assert abs(at + 1.15) < 0.5 * 4 / 64 + 1e-9  # half a step: nothing stored is nearer
    for line, curve in zip(figure.axes[0].lines, curves):
        assert line.get_ydata().max() == pytest.approx(curve.store.fields(curve.entry)["pressure"][:, 0].max() / 1e9)
    assert [len(ax.lines) for ax in figure.axes] == [2, 2, 2, 2, 0, 4]  # nothing thermal; Fi with its worst points


def shown_of(folder, monkeypatch, *scenes):
    """(figure, its curves, title in one line, labels) of a comparison of made-up passages of these scenes."""
    shown = []
    monkeypatch.setattr(compare_figure, "_legend", lambda page, figure, curves: shown.append((figure, curves)))
    tehl.compare(*(made_results.run(folder / f"{n}.zarr", one) for n, one in enumerate(scenes))).plot(folder / "c.png", at=0.5)
    figure, curves = shown[0]
    return figure, curves, " ".join(figure.get_suptitle().split()), [curve.label for curve in curves]


def test_whole_domains_are_compared_along_the_row_of_the_largest_pressure(tmp_path, monkeypatch):
    """Of the made-up fields it is the first one."""
    whole = SMALL.replace(**{"feature.y": 2e-5})
    figure, curves, title, labels = shown_of(tmp_path, monkeypatch, whole, whole.replace(srr=0.12))
    for line, curve in zip(figure.axes[0].lines, curves):
        assert line.get_ydata() == pytest.approx(curve.store.fields(curve.entry, ["pressure"])["pressure"][:, 0] / 1e9)
    assert "gear: along y = -362 µm, through the largest pressure, feature at +0.50 a" in title
    assert labels == ["srr = -0.12", "srr = 0.12"]


@pytest.mark.parametrize("places, at, position, centre", [
    ((0.0, 0.0), "feature", "feature", "x from the feature's centre (µm)"),
    ((2e-5, 2e-5), "origin of feature.x", "origin of feature.x", "x from the origin of feature.x (µm)"),
    ((0.0, 2e-5), "feature or origin of feature.x", "feature x / a or position of the origin of feature.x",
     "x from the feature's centre (µm) or x from the origin of feature.x (µm)")])
def test_positions_count_from_the_origin_of_features_that_lie_beside_it(tmp_path, monkeypatch, places, at, position, centre):
    monkeypatch.setattr(made_results, "run", functools.partial(made_results.run, search=made_results.fatigue()))
    figure, _, title, _ = shown_of(tmp_path, monkeypatch, *(made_results.SMALL.replace(**{"feature.x": x, "srr": srr})
                                                            for x, srr in zip(places, (-0.12, 0.12))))
    assert f", {at} at +0.50 a" in title
    labels = [" ".join(ax.get_xlabel().split()) for ax in figure.axes]
    assert labels.count(f"position of the {position} x / a") == 2 and centre in labels


@pytest.mark.parametrize("changes, along", [({"srr": 0.05}, "x / a"), ({"load": 9e5}, "x (mm)")])
def test_lines_of_the_figure_are_in_the_units_of_their_axes(tmp_path, monkeypatch, changes, along):
    """Contacts of one width are drawn over x/a, others over mm."""
    scenes = made_results.SMALL, made_results.SMALL.replace(**changes)
    monkeypatch.setattr(made_results, "run", functools.partial(made_results.run, search=made_results.fatigue()))
    figure, curves, *_ = shown_of(tmp_path, monkeypatch, *scenes)
    axes = {ax.get_ylabel(): ax for ax in figure.axes}
    for label, name, unit in (("pressure (GPa)", "pressure", 1e9), ("film (µm)", "film", 1e-6)):
        assert axes[label].get_xlabel().startswith(along) or axes[label].get_xlabel() == ""
        for line, curve in zip(axes[label].lines, curves, strict=True):
            np.testing.assert_allclose(line.get_ydata() * unit, curve.along(name))
            np.testing.assert_allclose(line.get_xdata() * (curve.a if along == "x / a" else 1e-3), curve.store.x)
    for label, name, unit in (("p_max (GPa)", "p_max_Pa", 1e9), ("h_min (µm)", "h_min_m", 1e-6)):
        for line, curve in zip(axes[label].lines, curves, strict=True):
            np.testing.assert_allclose(line.get_ydata() * unit, curve.store.scalar(name)[1:])
    for line, curve in zip(axes["Fi, critical row"].lines[::2], curves, strict=True):
        np.testing.assert_allclose(line.get_xdata() * 1e-6, curve.store.map("feature_frame_x"))


def test_rows_that_differ_are_said_in_the_legend(tmp_path, monkeypatch):
    whole = SMALL.replace(**{"feature.y": 2e-5})
    _, _, title, labels = shown_of(tmp_path, monkeypatch, whole, whole.replace(load=0.5e6))
    assert "gear: along the rows of their largest pressures, feature at +0.50 a" in title
    assert labels == ["load = 1.1e+06, along y = -362 µm", "load = 500000, along y = -244 µm"]


def test_half_domains_are_compared_in_the_middle_also_with_whole_ones(tmp_path, monkeypatch):
    _, curves, title, labels = shown_of(tmp_path, monkeypatch, SMALL, SMALL.replace(**{"feature.y": 2e-5}))
    assert "gear: along y = 0, " in title and labels == ["y = 0", "y = 2e-05"]
    assert [round(curve.store.y[curve.row] * 1e6) for curve in curves] == [0, 0]


def test_the_command_prints_and_writes(two, tmp_path):
    done = CliRunner().invoke(app, ["compare", *map(str, two), "--out", str(tmp_path / "c.png")])
    assert done.exit_code == 0 and "operation.srr" in done.stdout and (tmp_path / "c.png").exists()
    told = json.loads(CliRunner().invoke(app, ["compare", *map(str, two), "--json"]).stdout)
    assert told["differs"]["operation.srr"] == [-0.12, 0.12] and told["figure"] == str(two[0].parent / "compare.png")
    again = CliRunner().invoke(app, ["compare", *map(str, two), "--json"])
    assert again.exit_code == 0 and json.loads(again.stdout)["figure"] == str(two[0].parent / "compare-2.png")


@pytest.mark.parametrize("change, told", [("not separated", True), ("+12%", False)])
def test_the_words_of_a_change_are_explained_where_they_stand(capsys, change, told):
    from tehl_cli.compare_command import _results

    line = SimpleNamespace(what="steady h_c", values=("0.40 um", "0.41 um"), change=change, same=False)
    _results(SimpleNamespace(names=("a", "b"), lines=[line]))
    shown = capsys.readouterr().out
    assert change in shown and ("not separated: the error bars overlap" in shown) is told


def test_settings_have_their_units():
    from tehl_cli.compare_command import _with_unit

    keys = "oil.nu_40", "oil.G0", "operation.temperature", "feature.0.height", "bodies.a.E", "contact.load", "made.up"
    assert [_with_unit(key) for key in keys] == [
        "oil.nu_40, m2/s", "oil.G0", "operation.temperature, deg C", "feature.0.height, m", "bodies.a.E, Pa", "contact.load",
        "made.up"]


@pytest.mark.parametrize("pick, why", [((0,), "1 store to compare; allowed: 2 to 8"), ((0, 1, 0), "run.zarr is given twice")])
def test_nothing_to_compare_is_refused(two, pick, why):
    with pytest.raises(tehl.Error, match=why):
        tehl.compare(*(two[n] for n in pick))
    with pytest.raises(tehl.Error, match="the folder does not exist"):
        tehl.compare(two[0], two[0].parent / "none.zarr")


def test_tables_in_tables_become_dotted_keys():
    nested = {"a": {"b": 1, "c": [1, 2]}, "f": [{"x": 1}, {"x": 2}], "e": []}
    assert flat(nested) == {"a.b": 1, "a.c": (1, 2), "f.0.x": 1, "f.1.x": 2, "e": ()}


def test_a_table_of_strength_is_named_and_not_listed():
    """Its contents follow from its name; where only these differ they are what differs."""
    from tehl_taichi.runs.compare_labels import follows

    assert follows("fatigue.table_rows", {"fatigue.table": [], "fatigue.table_rows": []})
    assert not follows("fatigue.table_rows", {"fatigue.table_rows": []})
    assert not follows("fatigue.kappa", {"fatigue.table": []})
