"""The page of a flank: critical position, scene, limit, gears, links to the pages of positions."""

import made_results
import pytest
from read_pages import Seen
from tehl_cli.main import app
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.report import flank_page, place_page
from tehl_taichi.runs.flank.stored_flank import Flank
from tehl_taichi.runs.summary import limit_meaning

pytest.importorskip("plotly")


@pytest.fixture
def flank(tmp_path):
    """A flank of three positions with the stores of the first two."""
    folder = made_results.flank(tmp_path / "f")
    for name, Fi in (("1", 1.4), ("2", 0.7)):
        made_results.run(folder / f"{name}.zarr", search=made_results.fatigue(Fi, None))
    return folder


def test_the_page_says_whose_limit_which_oil_and_where_the_maps_are(flank):
    page = flank_page.of(flank, flank.with_suffix(".html"))
    titles = [section.title for section in page.shown]
    assert "Critical position: A, x_pl = -9.502 mm" in titles and {"The surface", "Scene"} <= set(titles)
    assert page.answer.doubts[0].startswith("Fi = 1 is the fatigue limit σ_eF = 400 MPa with κ = 0.3 (findley): example values")
    assert {"map-pressure", "map-film", "surface"} <= set(page.figures)
    text = str(page.sections)
    assert "The oil is reference-pao" in text and "'grid', '32 × 8 cells" in text


def test_the_smooth_contact_of_the_limit_is_that_of_the_critical_position(tmp_path):
    """Each position has another contact; a run has one, which is this one."""
    folder, search = made_results.flank(tmp_path / "f"), made_results.fatigue(1.4, None)
    search["contact_alone"]["error"] = {"Fi_max": 0.01}
    store = tehl.open(made_results.run(folder / "1.zarr", search=search)).store
    meaning, = [one for one in place_page.limits(Flank.open(folder)) if "has Fi = 1 at about" in one]
    assert "; a smooth contact like that at A, x_pl = -9.502 mm has Fi = 1 at about" in meaning
    assert "a smooth contact like this one has" in limit_meaning.sentence(store.summary, store.scene.fatigue)


def test_gears_are_named_in_units_that_people_read(flank):
    rows = dict(flank_page.gears(Flank.open(flank)))
    assert rows["normal module"] == "4.5 mm" and rows["centre distance"] == "91.5 mm" and rows["teeth of the gear"] == "24"
    assert rows["working pressure angle"] == "22.4388 °" and rows["the feature is on the"] == "pinion"
    pinion, gear = (rows[f"radius of curvature at C, {wheel}"].split() for wheel in ("pinion", "gear"))
    assert pinion[1] == gear[1] == "mm" and "flank of the pinion, 265.1 N m and " in Flank.open(flank).title
    assert pinion[0].startswith("13.97") and float(gear[0]) / float(pinion[0]) == pytest.approx(24 / 16, rel=1e-4)
    assert rows["transverse base pitch"] == f"{3.1415927 * 4.5 * 0.9396926:.6g} mm" and rows["tooth force"].endswith(" N")
    assert not any("Ra" in name or "helix" in name or "permissible" in name for name in rows), "not given"


def test_lambda_or_why_there_is_none(flank):
    found = Flank.open(flank)
    assert flank_page.film_words(found) == () and flank_page.no_film_words(found)[0].startswith("λ is not known: the surfaces")
    record = found.to_dict()
    record["geometry"] |= {"Ra1": 4e-7, "Ra2": 6e-7, "lambda_GFP": 0.2}
    for one, ratio in zip(record["positions"], (0.3, 0.5)):
        one["film_ratios"] = {"lambda_GF": ratio, "h_min_Ra": 0.1}
    words, = flank_page.film_words(Flank(flank, record))
    assert "λ_GF = 0.3, at A, x_pl = -9.502 mm, S_λ = 1.5 times the permissible one" in words
    assert flank_page.no_film_words(Flank(flank, record)) == ()
    del record["geometry"]["lambda_GFP"]
    assert "its permissible value is not given" in flank_page.film_words(Flank(flank, record))[0]


def test_steady_positions_give_the_index_of_their_smooth_contacts(flank):
    """No feature passes, but the index of the smooth contact is known."""
    record = Flank.open(flank).to_dict()
    alone = made_results.fatigue()["contact_alone"] | {"error": {"Fi_max": 0.01}}
    for one, Fi in zip(record["positions"], (0.8, 0.9)):
        del one["summary"]["fatigue"]
        one["summary"]["contact_alone_by_surface"] = {"a": alone | {"Fi_max": Fi}, "b": alone | {"Fi_max": Fi - 0.2}}
    headline, first = (answer := flank_page.answer(Flank(flank, record))).headline, answer.sentences[0]
    assert headline.startswith("The smallest film is")
    assert first.startswith("The smooth contacts alone: Fi = 0.900 ± 0.010 at most, 180 µm below the surface at C, x_pl = ")


def test_pages_of_positions_are_written_and_linked(flank, tmp_path):
    out = tmp_path / "elsewhere" / "page.html"
    out.parent.mkdir()
    assert CliRunner().invoke(app, ["report", str(flank), "--pages", "--out", str(out)]).exit_code == 0
    seen = Seen(out.read_text(encoding="utf-8"))
    links = [value for _, key, value in seen.attributes if key == "href" and not value.startswith("#")]
    assert links == ["../f/1.html", "../f/2.html"] and all((out.parent / link).exists() for link in links)
    before = (flank / "1.html").stat().st_mtime_ns
    tehl.report(flank, tmp_path / "again.html", pages=True)
    assert (flank / "1.html").stat().st_mtime_ns == before, "an existing page is kept"


def test_a_run_has_no_pages_of_positions(flank):
    with pytest.raises(tehl.SceneError, match="1.zarr is a run"):
        tehl.report(flank / "1.zarr", flank.parent / "p.html", pages=True)
