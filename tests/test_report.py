"""Reports: what stands on the page, that it needs nothing else, what it leaves out. Made-up results: nothing is solved."""

import base64
import gzip
import html.parser
import json
import re
import subprocess
import sys

import made_results
import numpy as np
import pytest
from fake_cases import formula
from made_results import THERMAL
from small_stores import SMALL, store
from tehl_cli.main import app
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.errors import StoreError
from tehl_taichi.march import readings
from tehl_taichi.report import rounded, scene_words, verdict
from tehl_taichi.scene import scene
from tehl_taichi.scene.route import total_steps
from tehl_taichi.study import many
from tehl_taichi.study.plan import plan

go = pytest.importorskip("plotly.graph_objects")
pytest.importorskip("jinja2")
STEADY = scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
EMPTY = {"meta", "link", "br", "input", "img"}


class Seen(html.parser.HTMLParser):
    """What stands on a page: its text, the attributes of its tags, what the scripts carry. Tags close in order."""

    def __init__(self, page):
        super().__init__()
        self.open, self.text, self.attributes, self.carried, self.headings = [], "", [], {}, []
        self.feed(page)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attributes):
        self.attributes += [(tag, *pair) for pair in attributes]
        if tag not in EMPTY:
            self.open.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        assert self.open.pop()[0] == tag

    def handle_data(self, data):
        tag, attributes = self.open[-1] if self.open else ("", {})
        if tag in ("script", "style"):
            self.carried[attributes.get("id", tag)] = data
            return
        self.text += " ".join(data.split()) + "\n" * bool(data.strip())
        self.headings += [data] * (tag == "h2")

    @property
    def figures(self):
        """{name: plotly's}, unpacked."""
        if "figures" not in self.carried:
            return {}
        return json.loads(gzip.decompress(base64.b64decode(self.carried["figures"])))

    @property
    def places(self):
        """Names of the figures that have a place."""
        return [value for _, key, value in self.attributes if key == "data-figure"]


def page(of, tmp_path):
    return Seen(tehl.report(of, tmp_path / "page.html", force=True).read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def thermal(tmp_path_factory):
    """A finished run with temperatures and fatigue."""
    return made_results.run(tmp_path_factory.mktemp("report") / "made.zarr", search=made_results.fatigue())


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """Nine cases, one of which does not converge."""
    gear = scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16})
    over = {"srr": "-0.1:0.1:3", "feature.height": [0.5e-6, 1e-6, 1.5e-6]}
    return many.run(plan(gear, over), tmp_path_factory.mktemp("report") / "many.zarr", workers=1, work=formula)


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


def numbers(trace):
    """The drawn values of a trace."""
    values = trace.get("z", trace["y"])
    if isinstance(values, dict):
        return np.frombuffer(base64.b64decode(values["bdata"]), "<f4")
    return np.array([value for value in values if value is not None], float)


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
    assert "25 µm below the surface: Fi = 1.4 (error not known), above 1." in seen.text
    for text in (f"{steady['h_c_m'] * 1e6:.4f} µm", "0.0010 µm", "no coarser grid",
                 f"{summary['hertz']['p_Pa'] / 1e9:.4g} GPa", "12.5 s, of it kernels 2.5 s", "tehl run made-up", "abc123",
                 "something is doubtful", "σ_eF = 400 MPa with κ = 0.3 (findley): example values, to be replaced"):
        assert text in seen.text, text
    assert all(sentence in seen.text for sentence in tehl.open(thermal).scene.left_out())
    assert seen.headings[0] == "How sure" and seen.text.index("Probably yes") < seen.text.index("Scene")


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


def test_maps_of_the_index_have_a_line_where_it_is_one(pages, tmp_path):
    seen = pages["thermal"]
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
    assert any("worst point" in trace.get("name", "") for trace in below) == (shown == 25)
    assert ("The worst depth is 25 µm, under the row y = 0 µm, with Fi = 1.39." in seen.text) == (shown != 25)
    assert numbers(seen.figures["over-depth"]["data"][0]) == pytest.approx(maps["under_row_depth"][0] * 1e6)


def test_a_plane_that_is_not_at_the_worst_depth_has_its_own_mark(tmp_path):
    """The worst depth is looked for once more under the row of what is worst in the plane, which then lies beside it."""
    maps = made_results.maps()
    plane = np.roll(maps["Fi"][0], 2, axis=0) * 4e8 * 1.2
    maps |= {"worst_depth": (np.array([27.3e-6]), ["d"], "m", "depth"),
             "findley_stress_at_worst_depth": (plane, ["x", "y"], "Pa", "stress")}
    seen = page(made_results.run(tmp_path / "a.zarr", search=made_results.fatigue(), found=maps), tmp_path)
    mark, = [trace for trace in seen.figures["index-below"]["data"] if "Fi = " in trace.get("name", "")]
    assert mark["name"] == "largest at this depth, Fi = 1.20" and mark["y"] == [0.0]
    assert mark["x"] == pytest.approx([50.0])
    assert "Index Fi 27.3 µm below the surface" in seen.text
    assert "The worst depth is 25 µm, under the row y = 0 µm, with Fi = 1.39." in seen.text


def test_lines_and_maps_say_where_and_when(pages, tmp_path):
    half, whole = pages["thermal"].text, made_results.run(tmp_path / "a.zarr", SMALL.replace(**{"feature.y": 2e-5}))
    assert "Along y = 0. Surface a carries the feature. Grey: the steady start" in half
    seen, reader = page(whole, tmp_path), tehl.open(whole).store
    assert "Along y = -362 µm, through the largest pressure." in seen.text
    p = reader.fields(4, ["pressure"])["pressure"] / 1e9
    assert f"Pressure: the largest pressure of the passage, feature at +0.50 a, p_max {p.max():.2f} GPa." in seen.text
    table = np.frombuffer(base64.b64decode(seen.figures["centreline"]["slides"]["lines"][0]["bdata"]), "<f4")
    assert table.max() == pytest.approx(p[np.abs(reader.x / 3.6217e-4) < 1.61, 0].max(), rel=1e-6)


def test_what_carries_the_feature_is_said_where_temperatures_are(pages):
    seen = pages["thermal"].text
    assert "Temperature, surface a, which carries the feature: " in seen and "Temperature, surface b: " in seen
    assert "Surface a, that of body a, carries a feature of the shape cosine" in seen
    assert "the contact lies between −1 and 1. Surface a carries the feature." in seen
    assert "the contact lies between −1 and 1.\n" in pages["no fatigue"].text  # isothermal


def test_tables_have_the_error_below_the_surface_and_what_no_figure_shows(pages, tmp_path, monkeypatch):
    monkeypatch.setitem(made_results.EXTRA["passage_error"], "below_Fi_max", 0.041)
    seen = page(made_results.run(tmp_path / "a.zarr", search=made_results.fatigue()), tmp_path).text
    assert "index of fatigue Fi 25 µm below the surface, largest\n1.392\n0.041\n2.9 %" in seen
    assert "index of fatigue Fi 25 µm below the surface, largest\n1.4\nnot estimated\n" in pages["thermal"].text
    assert "largest principal stress on the surface\n300 MPa\n" in seen
    assert "load carried by solid contact, at most\n" in seen and "load carried" not in pages["steady line"].text
    assert "critical plane to the surface (0°: it lies in the surface)\n57 °" in seen


def test_what_has_no_known_error_is_told_with_few_digits(pages):
    run, flank = pages["thermal"].text, pages["flank"].text
    assert "\n0.3 µm\nno coarser grid\n" in run and "\nindex Fi\n1.008 ± 0.023\n1.4\n" in run
    assert "The largest index is Fi = 1.4, at the surface at A" in flank
    assert rounded.told(3.9443e-7, None, "m", digits=3) == "0.394 µm" and rounded.index(1.008, None) == "1.008"
    assert [rounded.index(1.392, error) for error in (None, 0.041)] == ["1.4", "1.392 ± 0.041"]


def test_a_long_reason_why_an_error_is_not_known_stands_once_behind_the_tables(tmp_path, monkeypatch):
    why, other = "exit not resolved: " + readings.SPIKE.format(0.9), "its place differs from that on the next coarser grid"
    monkeypatch.setitem(made_results.EXTRA, "passage_error", {"p_max_Pa": None, "Fi_max": None, "below_Fi_max": None})
    monkeypatch.setitem(made_results.EXTRA, "passage_unknown", {"p_max_Pa": why, "Fi_max": why, "below_Fi_max": other})
    seen = page(made_results.run(tmp_path / "a.zarr", search=made_results.fatigue()), tmp_path).text
    assert seen.count(why) == 1 and seen.count("\nexit not resolved ¹\n") == 2 and seen.count("\nnot known ²\n") == 1
    assert f"\nWhy an error is not known\n¹ {why}\n² {other}\n" in seen


def test_a_scale_that_changes_nothing_is_not_told(tmp_path):
    np.save(tmp_path / "m.npy", 1e-7 * np.sin(np.arange(20))[:, None] * np.ones(20))
    of_map = scene("gear").replace(**{"feature.shape": "map", "feature.file": str(tmp_path / "m.npy"), "feature.unit": "m",
                                      "feature.pixel": 1e-5})
    assert "scale" not in scene_words.words(of_map)[-1] and "pixel 10 µm" in scene_words.words(of_map)[-1]
    assert "scale -1" in scene_words.words(of_map.replace(**{"feature.scale": -1.0}))[-1]


@pytest.mark.parametrize("keys, said", [
    ({}, "example values, to be replaced by those of the material itself"), ({"source": "Example."}, "example values, to be"),
    ({"source": "DIN 50100, 42CrMo4"}, "DIN 50100, 42CrMo4"), ({"endurance": 450e6}, "no source is given")])
def test_example_values_do_not_pass_for_those_of_a_material(keys, said):
    changed = scene("gear").replace(**{f"fatigue.{key}": value for key, value in keys.items()})
    assert scene_words.material(changed.fatigue).startswith(said)


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
    known, found = cut.warnings(), ["the first of the result", "the second"]
    assert known
    made = made_results.run(tmp_path / "a.zarr", cut, 5, made_results.fatigue(), said=[*known, *found])
    text = page(made, tmp_path).text
    places = [text.index(sentence) for sentence in ("About the result", *found, "About the scene", *known)]
    assert places == sorted(places) and text.count("Warning:") == len(known) + 2
    assert "About the result" in pages["thermal"].text and "About the scene" not in pages["thermal"].text
    assert tehl.open(made).store.warnings == [*known, *found]


@pytest.mark.parametrize("search", [made_results.fatigue(), None])
def test_that_steel_would_yield_is_said_once(tmp_path, search):
    """First of all doubts where there is an index, else among the warnings."""
    from tehl_taichi.io.result_judge import yielding

    said = [*yielding(None, {"steady": {"p_max_Pa": 4.7e9}}), "another one"]
    made = made_results.run(tmp_path / "a.zarr", THERMAL, 14, search, said=said)  # up to 2.3 p_H
    text = page(made, tmp_path).text
    assert text.count("hardened steel yields") == 1 and ("p_max 4.70 GPa" in text) == (search is None)
    assert ("Read the warning below first" if search else "Read the 2 warnings below first") in text


def test_a_cut_passage_says_so(tmp_path):
    cut = made_results.THERMAL.replace(**{"time.steps": 4})
    text = page(made_results.run(tmp_path / "a.zarr", cut, 5, made_results.fatigue()), tmp_path).text
    assert "inside the contact: what comes later is not in these numbers" in text and "rest of the passage" not in text


@pytest.mark.parametrize("Fi, error, tone, said", [
    (1.2, 0.1, "yes", "Yes: the fatigue limit is exceeded at the surface."), (1.05, 0.1, "open", "Not decided"),
    (0.95, 0.1, "open", "Not decided"), (0.8, 0.1, "no", "No: the index stays below 1."), (0.8, None, "no", "Probably not"),
    (1.2, None, "yes", "Probably yes")])
def test_the_answer_knows_how_sure_it_is(Fi, error, tone, said):
    _, headline, found, _ = verdict.of_fatigue({**made_results.fatigue(Fi, None), "error": {"Fi_max": error}})
    assert found == tone and headline.startswith(said)


def test_a_surface_that_holds_over_a_depth_that_does_not():
    layers = verdict.layers(made_results.fatigue(0.5, 1.2))
    assert [where for where, *_ in layers] == ["at the surface", "25 µm below the surface"]


def test_digits_follow_the_error():
    assert rounded.told(1.00812, 0.0231) == "1.008 ± 0.023" and rounded.told(4.0247e9, 1.767e7, "Pa") == "4.025 ± 0.018 GPa"
    assert rounded.told(3.944e-7, None, "m") == "0.3944 µm" and rounded.told(2.5, 0.0) == "2.5 ± 0"
    assert rounded.told(2.286e11, 1e12) == "2.286e+11 ± 1e+12" and rounded.share(0.5, -50.0) == "1 %"
    assert [rounded.roughly(Fi) for Fi in (1.645, 0.911, 1.03, 0.996, 1.004)] == ["1.6", "0.91", "1.03", "0.996", "1.004"]


def test_the_oil_in_words_and_numbers():
    """Of the own law alone: which other laws take a number says nothing about this scene."""
    own = scene("gear").replace(oil={"name": "VG220", "viscosity": "barus", "eta0": 0.2, "alpha": 2e-8})
    assert "The oil is VG220 (source not given) and comes in" in " ".join(scene_words.words(own))
    rows = dict(scene_words.numbers(own))
    assert rows["eta0: viscosity at p = 0"] == "0.2 Pa s" and not any("roelands" in what for what in rows)


def test_a_scene_in_words():
    text = " ".join(scene_words.words(scene("gear").replace(srr=-0.12)))
    for said in ("A line contact of reduced radius 10.6 mm carries 1100 N/mm", "the feature is on the slower one",
                 "height 1.5 µm", "width 200 µm", "comes in at 90 °C"):
        assert said in text, said
    assert "faster one" in " ".join(scene_words.words(scene("gear").replace(srr=0.12)))
    assert "without slip" in " ".join(scene_words.words(scene("gear").replace(srr=0.0)))


def test_a_study_shows_its_results_and_what_failed(pages):
    seen = pages["study"]
    assert "is above 1 in 1 of 8 cases with a result" in seen.text and "Without a result: 1 of 9 cases" in seen.text
    assert "The largest is Fi = 1.05: srr -0.1, feature.height (µm) 1.5." in seen.text
    assert "Case 5 (srr 0, feature.height (µm) 1.5): not converged: made up" in seen.text
    cells = numbers(seen.figures["fatigue_Fi_max-map"]["data"][0])
    assert np.isnan(cells).sum() == 1 and np.nanmax(cells) == pytest.approx(1.05)
    assert len(seen.figures["fatigue_Fi_max-lines"]["data"]) == 3


def test_a_flank_says_where(pages):
    seen = pages["flank"]
    assert "exceeded at the surface at A, x_pl = -" in seen.text and "It is above 1 at 1 of 3 positions." in seen.text
    assert "step 7 failed" in seen.text and "A, C: same everywhere" in seen.text
    assert "Warnings of the positions, listed below: 1." in seen.text and "module" in seen.text
    films, *_, slip = seen.figures.values()
    assert [mark["text"] for mark in films["layout"]["annotations"]] == ["A", "B", "C", "D", "E"]
    assert [line["y"] for line in films["data"]] == [pytest.approx([0.1, 0.4]), pytest.approx([0.05, 0.2])]
    assert len(slip["data"][0]["y"]) == 3 and slip["data"][0]["y"][1] == 0


def test_a_file_that_is_there_stays_unless_forced(thermal, tmp_path):
    (tmp_path / "mine.html").write_text("mine")
    words = ["report", str(thermal), "--out", str(tmp_path / "mine.html")]
    refused = CliRunner().invoke(app, words).exception
    assert isinstance(refused, StoreError) and "exists already; choose another --out, or --force" in str(refused)
    assert (tmp_path / "mine.html").read_text() == "mine"
    assert CliRunner().invoke(app, [*words, "--force"]).output.strip() == str(tmp_path / "mine.html")
    assert (tmp_path / "mine.html").read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mine.html"]


@pytest.mark.slow
def test_it_needs_no_matplotlib(thermal, tmp_path):
    code = f"import sys; sys.modules['matplotlib'] = None; import tehl_taichi as tehl; tehl.report({str(thermal)!r}, 'a.html')"
    assert subprocess.run([sys.executable, "-c", code], cwd=tmp_path).returncode == 0 and (tmp_path / "a.html").exists()


def test_open_shows_the_file_that_was_written(thermal, tmp_path, monkeypatch):
    shown = []
    monkeypatch.setattr("typer.launch", shown.append)
    for words in ([], ["--open"]):
        CliRunner().invoke(app, ["report", str(thermal), "--out", str(tmp_path / f"{len(words)}.html"), *words])
    assert shown == [(tmp_path / "1.html").as_uri()]


def test_what_is_no_result_is_refused_and_nothing_written(tmp_path):
    (tmp_path / "empty").mkdir()
    with pytest.raises(StoreError, match="is not a store"):
        tehl.report(tmp_path / "empty")
    (tmp_path / "flank").mkdir()
    (tmp_path / "flank" / "flank.json").write_text('{"name": "half"')
    with pytest.raises(StoreError, match="flank.json is damaged"):
        tehl.report(tmp_path / "flank")
    with pytest.raises(StoreError, match="is a folder; --out takes the name of a file"):
        tehl.report(tmp_path / "empty", tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["empty", "flank"]


def test_the_page_goes_beside_the_folder(thermal):
    made = tehl.report(tehl.open(thermal))
    assert made == thermal.with_suffix(".html") and made.stat().st_size < 4e6
    made.unlink()


@pytest.mark.parametrize("name", ["plotly", "jinja2"])
def test_what_is_not_installed_is_named_with_how_to_get_it(thermal, tmp_path, monkeypatch, name):
    monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(StoreError, match=rf"a report needs {name}: pip install 'tehl_taichi\[report\]'"):
        tehl.report(thermal, tmp_path / "a.html")


def test_the_terminal_has_the_same_answer(thermal, pages):
    shown = CliRunner().invoke(app, ["show", str(thermal)])
    question, headline, *_ = verdict.of_fatigue(tehl.open(thermal).summary["fatigue"])
    assert f"{question} {headline}" in shown.output.splitlines() and headline in pages["thermal"].text
