"""The page of another question of fatigue: what it asks, which errors hold, what it leaves alone. Made-up results."""

import copy
import dataclasses
from types import SimpleNamespace

import made_results
import pytest
from made_results import THERMAL, fatigue
from read_pages import Seen
from small_stores import store
from tehl_cli.main import app
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.fatigue import assessment
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.report.renewed_search import RenewedSearch
from tehl_taichi.runs import fatigue_errors
from tehl_taichi.scene import scene

pytest.importorskip("plotly")
pytest.importorskip("jinja2")
pytestmark = pytest.mark.usefixtures("without_library")


@pytest.fixture
def made(tmp_path):
    return made_results.run(tmp_path / "made.zarr", search=fatigue(), said=["the old doubt"])


@pytest.fixture
def search(monkeypatch):
    """Stands for the search: [(scene, until) of every one]; what it finds has the index 0.5 at the surface."""
    asked = []

    def run(scene, reader, progress, until):
        asked.append((scene, until))
        if progress:
            progress(1, 2)
        deep = 1.392 if scene.fatigue.depths else None
        found = {**fatigue(0.5, deep), "kappa_F": scene.fatigue.kappa, "sigma_eF_Pa": scene.fatigue.endurance}
        maps = {name: one for name, one in made_results.maps().items() if deep or "worst_below" not in name}
        return made_results.result(found, maps)

    monkeypatch.setattr(assessment, "run", run)
    monkeypatch.setattr(coarse_runs, "resolved", lambda *_: None)
    return asked


def text_of(path):
    return Seen(path.read_text(encoding="utf-8")).text


def test_the_page_is_of_the_fatigue_that_is_asked_for(made, search):
    before = {path: path.read_bytes() for path in made.rglob("*") if path.is_file()}
    path = tehl.report(made, kappa=0.25, endurance=450e6, to_x=0.5)
    (asked, until), text = search[0], text_of(path)
    assert path == made.with_name("made-fatigue.html") and until is None
    assert (asked.fatigue.kappa, asked.fatigue.endurance, asked.fatigue.to_x) == (0.25, 450e6, 0.5)
    assert "Does a fatigue crack start here, with κ = 0.25, σ_eF = 450 MPa, moments with the feature up to 0.5 a?" in text
    assert ("The run was stored with other constants: κ = 0.3, σ_eF = 400 MPa, moments with the feature "
            "anywhere." in text)
    assert "At the surface: Fi = 0.5 (error unknown), below 1." in text and "1.008" not in text
    assert "Fi = 1 is the fatigue limit σ_eF = 450 MPa with κ = 0.25 (findley): no source is given" in text
    assert "Only moments with the feature up to 0.5 a count" in text and "over the whole passage" not in text
    assert "Index Fi at the surface, over all moments that count (feature up to 0.5 a)" in text
    assert ("The smooth contact alone: Fi = 0.9 (error unknown) at 180 µm below surface a, below 1, and 0.6 (error unknown) "
                        "at surface a.") in text
    assert "kappa = 0.25" in text  # the scene file on the page
    assert ("the error of Fi_max of the smooth contact, Fi_max, Fi_max below the surface is not known: "
            f"{fatigue_errors.OTHER}") in text
    assert "the old doubt" not in text
    assert before == {path: path.read_bytes() for path in made.rglob("*") if path.is_file()}


def test_the_stored_question_has_its_own_page(made, search):
    assert tehl.report(made, kappa=0.3, criterion=None) == made.with_suffix(".html") and not search
    assert "1.008 ± 0.023" in text_of(made.with_suffix(".html"))


def test_no_figure_is_of_the_stored_search(made, search):
    seen = Seen(tehl.report(made, depths=[]).read_text(encoding="utf-8"))
    assert "stress-surface" in seen.places and "stress-below" not in seen.places


def test_how_far_the_search_is_is_told(made, search):
    told = []
    tehl.report(made, kappa=0.2, progress=SimpleNamespace(stage=lambda *words: told.append(words)))
    assert told == [("stresses and fatigue", 1, 2)]


def test_a_page_that_is_there_stays(made, search):
    made.with_name("made-fatigue.html").write_text("mine")
    with pytest.raises(StoreError, match="exists already"):
        tehl.report(made, kappa=0.2)
    assert not search and made.with_name("made-fatigue.html").read_text() == "mine"
    made.with_name("made-fatigue.html").write_text('<!doctype html><meta name="generator" content="tehl_taichi">')
    assert "κ = 0.2" in text_of(tehl.report(made, kappa=0.2, force=True))


def test_limits_in_bending_and_torsion_are_the_source_of_what_follows(made, search):
    text = text_of(tehl.report(tehl.open(made), bending_limit=600e6, torsion_limit=390e6))
    assert "from the fatigue limits 600 MPa in reversed bending and 390 MPa in torsion." in text


def test_one_limit_is_told_with_what_became_of_it(made, search):
    text = text_of(tehl.report(tehl.open(made), torsion_limit=400e6))
    assert "from the fatigue limit 400 MPa in reversed torsion with kappa = 0.3;" in text and "417.6" in text


@pytest.mark.parametrize("constants, source", [
    ({"residual_xx": -2e8}, "DIN 50100"), ({"kappa": 0.2}, "example values, set your own"),
    ({"kappa": 0.2, "source": "own tests"}, "own tests")])
def test_the_source_of_the_run_is_not_that_of_other_constants(tmp_path, constants, source):
    of_din = made_results.run(tmp_path / "a.zarr", THERMAL.replace(**{"fatigue.source": "DIN 50100"}), search=fatigue())
    assert RenewedSearch(of_din, constants).scene.fatigue.source == source


@pytest.mark.parametrize("changes, said", [
    ({"depths": [5e-5, 1e-4]}, ("depths searched:", "the worst, all points at 50 µm and 100 µm", "the worst")),
    ({"depths": []}, ("depths searched:", "the surface alone", "the worst")),
    ({"thermal_stress": False}, ("thermal stress", "not included", "included")),
    ({"from_x": -0.5, "to_x": 1}, ("moments with the", "feature from -0.5 a up to 1 a", "feature anywhere")),
    ({"residual_yy": -2e8}, ("residual stress along y", "-200 MPa", "0 MPa")),
    ({"criterion": "matake"}, ("the criterion", "matake", "findley")),
    ({"shear": False}, ("shear tractions", "not included", "included"))])
def test_what_differs_is_said(made, changes, said):
    assert RenewedSearch(made, changes).differs == [said]


def test_an_unfinished_run_is_asked_as_far_as_it_goes(tmp_path, search):
    begun = store(tmp_path / "begun.zarr").path
    text = text_of(tehl.report(begun, kappa=0.25))
    assert "The run is not finished: 2 of " in text and "Fi = 0.5 (error unknown)" in text


def test_a_study_and_a_flank_are_refused(tmp_path):
    flank = made_results.flank(tmp_path / "flank")
    with pytest.raises(StoreError, match=r"is a flank; kappa applies to one of its runs, as .*POSITION\.zarr"):
        tehl.report(flank, kappa=0.2, to_x=None)
    with pytest.raises(SceneError, match="kapa"):
        tehl.report(store(tmp_path / "a.zarr").path, kapa=0.2)


def test_the_command_takes_the_options_of_fatigue(made, search):
    done = CliRunner().invoke(app, ["report", str(made), "--kappa", "0.2", "--depths", "none", "--no-thermal-stress"])
    assert done.exit_code == 0 and done.stdout.strip() == str(made.with_name("made-fatigue.html"))
    found = search[0][0].fatigue
    assert (found.kappa, found.depths, found.thermal_stress) == (0.2, (), False)


def told(asked, stored, found):
    """The summary `found` of a search with the section `asked` of a run that has stored this one."""
    of_run = type("Store", (), {"scene": scene("gear"), "summary": {"fatigue": stored}})
    fatigue_errors.add_errors({"a": found}, asked, of_run)
    return found


def test_the_error_stays_where_only_the_limit_is_another():
    own, stored = scene("gear").fatigue, fatigue(0.8)
    stored |= {"error": {"Fi_max": 0.04}, "resolved": {"to_x_a": 0.5, **fatigue(0.6), "error": {"Fi_max": 0.03}}}
    stored["below"] |= {"error": {"Fi_max": None}, "unknown": {"Fi_max": "a peak"}}
    halved = copy.deepcopy(stored)
    for part in coarse_runs.indices({"a": halved}).values():
        part["Fi_max"] /= 2
        part["error"] = {}
    found = told(dataclasses.replace(own, endurance=2 * own.endurance, source="mine", depths=[5e-5]), stored, halved)
    assert found["error"] == {"Fi_max": pytest.approx(0.02)} and found["resolved"]["error"]["Fi_max"] == pytest.approx(0.015)
    assert found["below"]["error"] == {"Fi_max": None} and found["below"]["unknown"] == {"Fi_max": "a peak"}


@pytest.mark.parametrize("changes", [{"kappa": 0.31}, {"to_x": 0.5}, {"residual_xx": -1e8}, {"criterion": "matake"}, {}])
def test_no_error_of_another_search(changes):
    """Nor of the same constants where another version found another stress."""
    stored = {**fatigue(0.8, None), "error": {"Fi_max": 0.04}}
    found = fatigue(0.8 if changes else 0.801, None)
    told(dataclasses.replace(scene("gear").fatigue, **changes), stored, found)
    assert found["error"] == {"Fi_max": None} and found["unknown"] == {"Fi_max": fatigue_errors.OTHER}
