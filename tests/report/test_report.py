"""Reports: what stands on the page, that it needs nothing else, what it leaves out. Made-up results: nothing is solved."""

import base64
import re

import made_results
import numpy as np
import pytest
from fake_cases import formula, position
from read_pages import numbers, page
from small_stores import SMALL, store
from tehl_cli.main import app
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.report import number_text, verdict
from tehl_taichi.runs.sweep import sweeping
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.scene import scene
from tehl_taichi.scene.timeline import total_steps
from tehl_taichi.values.coded_text import without_options

go = pytest.importorskip("plotly.graph_objects")
pytest.importorskip("jinja2")
STEADY = scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """Nine cases, one of which does not converge."""
    gear = scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16})
    over = {"srr": "-0.1:0.1:3", "feature.height": [0.5e-6, 1e-6, 1.5e-6]}
    return sweeping.run(plan(gear, over), tmp_path_factory.mktemp("report") / "many.zarr", workers=1, work=formula)


@pytest.fixture(scope="module")
def pages(thermal, study, tmp_path_factory):
    """A page of each kind of result."""
    folder = tmp_path_factory.mktemp("kinds")
    results = {"thermal": thermal, "steady line": made_results.run(folder / "line.zarr", STEADY, 1),
               "unfinished": store(folder / "begun.zarr").path, "no fatigue": made_results.run(folder / "bare.zarr", SMALL),
               "study": study.path, "flank": made_results.flank(folder / "flank")}
    return {name: page(of, folder) for name, of in results.items()}


@pytest.fixture(params=["thermal", "steady line", "unfinished", "no fatigue", "study", "flank"])
def any_page(request, pages):
    return pages[request.param]


def test_every_figure_is_one_of_plotly_and_has_something_to_show(any_page):
    found = any_page.figures
    assert sorted(found) == sorted(any_page.places) and found
    for name, figure in found.items():
        go.Figure({"data": figure["data"], "layout": figure["layout"]})  # refuses what plotly does not know
        assert all(np.isfinite(numbers(trace)).any() for trace in figure["data"]), name


def test_a_page_needs_nothing_from_anywhere(any_page):
    assert not [(tag, key, value) for tag, key, value in any_page.attributes
                if key in ("src", "href", "action", "srcset", "data") and not value.startswith("#")]
    assert not re.search(r"url\(|@import", any_page.carried["style"])
    policy, = (value for _, key, value in any_page.attributes if key == "content" and "default-src" in value)
    assert "default-src 'none'" in policy and "http" not in policy


def test_no_section_is_empty(any_page):
    assert any_page.headings and "None" not in any_page.text and "nan" not in any_page.text.split()


def test_the_numbers_are_those_of_the_summary(thermal, pages):
    seen, summary = pages["thermal"], tehl.open(thermal).summary
    f, steady = summary["fatigue"], summary["steady"]
    assert f"At the surface: Fi = {f['Fi_max']:.3f} ± 0.023, 1 lies within the error." in seen.text
    assert "25 µm below the surface: Fi = 1.4 (error unknown), above 1." in seen.text
    for text in (f"{steady['h_c_m'] * 1e6:.4f} µm", "0.0010 µm", "no coarser grid",
                 f"{summary['hertz']['p_Pa'] / 1e9:.4g} GPa", "12.5 s, including kernels 2.5 s", "tehl run made-up", "abc123",
                 "something is doubtful", "σ_eF = 400 MPa with κ = 0.3 (findley): example values, replace them"):
        assert text in seen.text, text
    assert all(sentence in seen.text for sentence in tehl.open(thermal).scene.left_out())
    assert seen.headings[:3] == ["How sure", "Fatigue", "Scene"]
    assert seen.text.index("Probably yes") < seen.text.index("Largest index") < seen.text.index("Appendix")


def test_the_slider_has_every_moment_and_the_worst_first(thermal, pages):
    seen, reader = pages["thermal"], tehl.open(thermal).store
    slides = seen.figures["centreline"]["slides"]
    assert len(slides["labels"]) == len(reader) and slides["first"] == int(np.argmax(reader.scalar("p_max_Pa")))
    table = np.frombuffer(base64.b64decode(slides["lines"][0]["bdata"]), "<f4").reshape(len(reader), -1)
    whole = np.array([reader.fields(n, ["pressure"])["pressure"][:, 0] for n in range(len(reader))]) / 1e9
    shown = (reader.x >= -1.6 * 3.6217e-4) & (reader.x <= 1.4 * 3.6217e-4)
    assert table == pytest.approx(whole[:, shown], rel=1e-6)
    assert len(slides["lines"]) == len(slides["traces"]) == 5  # p, h, three temperatures
    film = np.frombuffer(base64.b64decode(slides["lines"][1]["bdata"]), "<f4").reshape(len(reader), -1)
    assert film[:, np.abs(reader.x[shown]) < 0.9 * 3.6217e-4].max() < seen.figures["centreline"]["layout"]["yaxis2"]["range"][1]
    traces = seen.figures["centreline"]["data"]
    assert [traces[n]["name"] for n in slides["traces"]] == ["this moment", "this moment", "mid-film", "surface a", "surface b"]


def test_lines_and_maps_say_where_and_when(pages, tmp_path):
    half, whole = pages["thermal"].text, made_results.run(tmp_path / "a.zarr", SMALL.replace(**{"feature.y": 2e-5}))
    assert "Along y = 0. Surface a carries the feature. Grey: the steady start" in half
    seen, reader = page(whole, tmp_path), tehl.open(whole).store
    assert "Along y = -362 µm, through the largest pressure." in seen.text
    p = reader.fields(4, ["pressure"])["pressure"] / 1e9
    assert f"Pressure: the largest pressure of the passage, feature at +0.50 a, p_max {p.max():.2f} GPa." in seen.text
    table = np.frombuffer(base64.b64decode(seen.figures["centreline"]["slides"]["lines"][0]["bdata"]), "<f4")
    assert table.max() == pytest.approx(p[np.abs(reader.x / 3.6217e-4) < 1.61, 0].max(), rel=1e-6)


def test_both_surfaces_have_one_scale_of_colours(thermal, tmp_path, monkeypatch):
    """Which is not that of the film."""
    from tehl_taichi.report import map_plots
    from tehl_taichi.store.reader import Reader

    fields = Reader.fields
    factors = {"temperature_mid": 9.0, "temperature_b": 2.0}
    monkeypatch.setattr(Reader, "fields", lambda self, n, names=None: {
        name: factors.get(name, 1.0) * values for name, values in fields(self, n, names).items()})
    maps = {figure.name: figure.traces[0] for figure in map_plots.maps(Reader.open(thermal))}
    a, b = (maps[f"map-temperature_{which}"] for which in "ab")
    assert a["zmin"] == b["zmin"] == a["z"].min() and a["zmax"] == b["zmax"] == b["z"].max()
    assert "zmax" not in maps["map-temperature_mid"]


def test_what_carries_the_feature_is_said_where_temperatures_are(pages):
    seen = pages["thermal"].text
    assert "Temperature, surface a, which carries the feature: " in seen and "Temperature, surface b: " in seen
    assert "Surface a (body a) carries a feature of the shape cosine" in seen
    assert "the contact lies between −1 and 1. Surface a carries the feature." in seen
    assert "the contact lies between −1 and 1.\n" in pages["no fatigue"].text  # isothermal


def test_tables_have_the_error_below_the_surface_and_what_no_figure_shows(pages, tmp_path, monkeypatch):
    monkeypatch.setitem(made_results.EXTRA["passage_error"], "a:below_Fi_max", 0.041)
    seen = page(made_results.run(tmp_path / "a.zarr", search=made_results.fatigue()), tmp_path).text
    assert "fatigue index Fi 25 µm below the surface, largest\n1.392\n0.041\n2.9 %" in seen
    assert "fatigue index Fi 25 µm below the surface, largest\n1.4\nnot estimated\n" in pages["thermal"].text
    assert "largest principal stress at the surface\n300 MPa\n" in seen
    assert "load carried by solid contact\n" in seen and "load carried" not in pages["steady line"].text
    assert "critical plane to the surface (0°: it lies in the surface)\n57 °" in seen


def test_what_has_no_known_error_is_told_with_few_digits(pages):
    run, flank = pages["thermal"].text, pages["flank"].text
    assert "\n0.3 µm\nno coarser grid\n" in run and "\nindex Fi\n1.008 ± 0.023\n1.4\n" in run
    assert "The index that decides is Fi = 1.4, at the surface at A" in flank
    assert number_text.value_text(3.9443e-7, None, "m", digits=3) == "0.394 µm" and number_text.index(1.008, None) == "1.008"
    assert [number_text.index(1.392, error) for error in (None, 0.041)] == ["1.4", "1.392 ± 0.041"]


def test_long_passages_are_thinned_but_keep_their_extremes(tmp_path, monkeypatch):
    from tehl_taichi.report import passage_plots

    monkeypatch.setattr(passage_plots, "MOMENTS", 3)
    made = made_results.run(tmp_path / "a.zarr", SMALL, 9)
    slides = page(made, tmp_path).figures["centreline"]["slides"]
    assert len(slides["labels"]) == 3 and slides["labels"][0].startswith("steady start")
    assert slides["labels"][slides["first"]].startswith("feature at")


def test_what_a_run_does_not_have_is_left_out(pages):
    line, begun, whole = pages["steady line"], pages["unfinished"], pages["thermal"]
    assert line.places == ["centreline"] and "Histories" not in line.headings
    assert not [one for one in line.attributes if one[1:] == ("type", "range")]
    assert "temperature (°C)" not in str(line.figures)
    assert "No answer yet: the run is not finished." in begun.text and "Numbers and their errors" not in begun.headings
    assert "Fatigue" not in begun.headings and "tehl resume begun.zarr" in begun.text
    assert f"2 of {total_steps(SMALL)} time steps" in begun.text
    assert {"index-surface", "section", "over-depth", "path-below", "map-temperature_mid"} <= set(whole.places)


def test_warnings_of_the_result_stand_before_those_of_the_scene(pages, tmp_path):
    cut = made_results.THERMAL.replace(**{"time.steps": 4})
    known, found = cut.typed_warnings, ["the first of the result", "the second"]
    assert known
    made = made_results.run(tmp_path / "a.zarr", cut, 5, made_results.fatigue(), said=[*known, *found])
    text = page(made, tmp_path).text
    shown = [without_options(sentence) for sentence in known]
    assert any("`tehl resume" in sentence for sentence in known) and "tehl resume" not in " ".join(shown)
    places = [text.index(sentence) for sentence in ("About the result", *found, "About the scene", *shown)]
    assert places == sorted(places) and text.count("Warning:") == len(known) + 2
    assert "About the result" in pages["thermal"].text and "About the scene" not in pages["thermal"].text
    assert tehl.open(made).store.warnings == [*known, *found]


def test_a_study_shows_its_results_and_what_failed(pages):
    seen = pages["study"]
    assert "is above 1 in 1 of 8 cases with a result" in seen.text and "Without a result: 1 of 9 cases" in seen.text
    assert "Fi = 1 is the fatigue limit σ_eF = 400 MPa with κ = 0.3 (findley): example values" in seen.text
    assert "The largest is Fi = 1.05: slide-roll ratio -0.1, feature height 1.5 µm." in seen.text
    assert "Case 5 (slide-roll ratio 0, feature height 1.5 µm): not converged: made up" in seen.text
    cells = numbers(seen.figures["judged_Fi-map"]["data"][0])
    assert np.isnan(cells).sum() == 1 and np.nanmax(cells) == pytest.approx(1.05)
    assert len(seen.figures["judged_Fi-lines"]["data"]) == 3
    assert "feature height 0.5 to 1.5 µm: 3 values in place of that below" in seen.text


def test_cells_and_bars_of_a_study_are_those_of_their_cases(study):
    """By the made-up formula; some cases exceed the limit, so the answer is open."""
    from tehl_taichi.report import study_page, study_plots

    figures = {figure.name: figure for figure in study_plots.figures(study)}
    cells, lines = np.array(figures["judged_Fi-map"].traces[0]["z"]), figures["judged_Fi-lines"].traces
    shape = [list(dict.fromkeys(study.plan.changes(n)[key] for n in range(9))) for key in study.plan.keys]
    for n in range(9):
        srr, height = (study.plan.changes(n)[key] for key in ("srr", "feature.height"))
        i, j = (values.index(one) for values, one in zip(shape, (srr, height)))
        assert n == 5 or cells[j, i] == pytest.approx(0.5 + 3e5 * height - srr)
    bars = [one for trace in lines for one in trace.get("error_y", {"array": []})["array"] if one is not None]
    assert bars == [0.04] * 3, "of the lowest features alone"
    assert study_page._answer(study).tone == "open"


def test_cells_of_the_figure_of_a_study_are_those_of_their_cases(study):
    """Each over the values of its keys."""
    from tehl_taichi.runs.sweep import study_figures
    from tehl_taichi.view.figures.figure_style import FigureStyle

    pytest.importorskip("matplotlib")
    figure = FigureStyle().drawn(lambda: study_figures.heat_map(FigureStyle(), study, "judged_Fi"))
    ax, image = figure.axes[0], figure.axes[0].images[0]
    assert image.origin == "lower" and "roll" in ax.get_xlabel() and "height (µm)" in ax.get_ylabel()
    columns, rows = ([label.get_text() for label in axis.get_ticklabels()] for axis in (ax.xaxis, ax.yaxis))
    for n in (0, 2, 7):
        srr, height = (study.plan.changes(n)[key] for key in ("srr", "feature.height"))
        at = rows.index(f"{height * 1e6:g}"), columns.index(f"{srr:g}")
        assert image.get_array()[at] == pytest.approx(0.5 + 3e5 * height - srr)


def test_curves_of_a_study_are_over_the_key_with_more_values(tmp_path):
    """A traction curve over slip, a line for each temperature, though the temperatures were named first; its values by hand."""
    from tehl_taichi.report import study_plots
    from tehl_taichi.runs.sweep import study_figures
    from tehl_taichi.runs.sweep.summary_columns import usual_columns

    gear = scene("gear").replace(**{"feature.height": 0.5e-6, "grid.nx": 64, "grid.ny": 16})
    swept = plan(gear, {"temperature": [60.0, 80.0], "srr": [0.0, 0.1, 0.2]})
    found = sweeping.run(swept, tmp_path / "s.zarr", workers=1, work=formula)
    assert study_figures.curve_keys(found) == ["srr", "temperature"]
    name = usual_columns(found.values)[0]
    values, label = study_plots.column(found, name)
    lines = next(figure for figure in study_plots.figures(found) if figure.name == f"{name}-lines")
    assert [trace["x"].tolist() for trace in lines.traces] == [[0.0, 0.1, 0.2]] * 2
    assert [list(trace["y"]) for trace in lines.traces] == [values[:3].tolist(), values[3:].tolist()]
    assert [trace["name"] for trace in lines.traces] == ["inlet temperature 60 °C", "inlet temperature 80 °C"]


def test_a_study_without_an_index_names_the_range_of_its_results(tmp_path):
    """A made-up film as thick as the radius."""
    from tehl_taichi.report import study_page

    swept = plan(scene("mtm"), {"contact.radius_x": [0.01, 0.02]})
    found = sweeping.run(swept, tmp_path / "s.zarr", workers=1, work=position)
    sentences = study_page.of(found.path).answer.sentences
    assert sentences == ("Steady h_c: 10 mm (error unknown, reduced radius along x 10 mm) to 20 mm (error unknown, reduced "
                         "radius along x 20 mm).",)


def test_rounding_beside_the_largest_value_is_no_result():
    from tehl_taichi.report import study_page

    values, errors = np.array([7e-19, 0.07, 0.07]), np.array([np.nan, np.nan, 0.002])
    assert [study_page._cell(values, errors, n) for n in range(3)] == ["0", "0.07 ± ?", "0.0700 ± 0.0020"]


def test_a_study_over_the_limit_names_its_keys(tmp_path):
    from tehl_taichi.report import study_page

    swept = plan(scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16}), {"endurance": [4e8, 5e8]})
    found = sweeping.run(swept, tmp_path / "s.zarr", workers=1, work=formula)
    assert "differs between the cases: endurance." in study_page.of(found.path).answer.doubts[0]


def test_a_flank_says_where(pages):
    seen = pages["flank"]
    assert "exceeded at the surface at A, x_pl = -" in seen.text and "It is above 1 at 1 of 3 positions." in seen.text
    assert "step 7 failed" in seen.text and "A, C: same everywhere" in seen.text
    assert "Number of warnings, listed below: 1." in seen.text and "module" in seen.text
    films, *_, slip = seen.figures.values()
    assert [mark["text"] for mark in films["layout"]["annotations"]] == ["A", "B", "C", "D", "E"]
    assert [line["y"] for line in films["data"]] == [pytest.approx([0.1, 0.4]), pytest.approx([0.05, 0.2])]
    assert len(slip["data"][0]["y"]) == 3 and slip["data"][0]["y"][1] == 0


def test_the_terminal_has_the_same_answer(thermal, pages):
    shown = CliRunner().invoke(app, ["show", str(thermal)])
    question, headline, *_ = verdict.of_fatigue(tehl.open(thermal).summary["fatigue"])
    assert f"{question} {headline}" in shown.output.splitlines() and headline in pages["thermal"].text
