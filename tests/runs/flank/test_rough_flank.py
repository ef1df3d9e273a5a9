"""The flank of rough surfaces: the numbers that settle lead in table, file, figure and page."""

import csv

import made_results
import pytest
from fake_cases import rough_search

from tehl_taichi.report import flank_page
from tehl_taichi.runs.flank import flank_columns, flank_figure
from tehl_taichi.runs.flank.stored_flank import Flank
from tehl_taichi.scene import surface_roughness
from tehl_taichi.view.figures.figure_style import FigureStyle

LEADING = ["Fi p99", "Fi median", "Fi > 1, %", "p99 below", "Fi", "Fi below", "Fi judged", "body"]


@pytest.fixture(scope="module")
def rough(tmp_path_factory):
    """Three positions, the last without a result."""
    flank = Flank.open(made_results.flank(tmp_path_factory.mktemp("rough") / "flank"))
    for n, one in enumerate(flank.record["positions"][:2]):
        one["summary"] |= {"fatigue": rough_search(1.2 - 0.5 * n), "roughness": {"a": {"Rq_m": 4e-7}}, "lambda": 0.5 + n}
    flank.write()
    return flank


def test_percentiles_and_share_lead_in_the_table(rough):
    heads, lines = flank_columns.tables(rough.rows)["while the feature passes"]
    assert heads[2:] == LEADING and lines[0][2:] == ["1.20 ± 0.10", "0.700 ± ?", "12.0 ± 5.0", "1.400 ± ?", "1.700 ± ?",
                                                      "2.000 ± ?", "1.20 ± 0.10", "b"]
    assert lines[2][2:] == [""] * len(LEADING)
    heads, lines = flank_columns.tables(rough.rows)["steady film"]
    assert heads[-2:] == ["Sq um", "lambda"] and lines[1][-2:] == ["0.400", "1.50 ± ?"]


def test_the_files_have_them_with_their_errors(rough):
    with (rough.folder / "flank.csv").open() as file:
        first, second, _ = csv.DictReader(file)
    assert [float(first[name]) for name in ("Fi_p99", "error_Fi_p99", "share_above_1", "error_share_above_1", "Sq_m")] == \
        [1.2, 0.1, 0.12, 0.05, 4e-7]
    assert float(second["Fi_p99"]) == 0.7 and second["Fi_p99_below"] == second["Fi_judged"] == "1.4"


def test_figure_and_page_show_them(rough):
    pytest.importorskip("matplotlib")
    labels = [ax.get_ylabel() for ax in flank_figure.drawn(FigureStyle(), rough).axes]
    assert labels == ["film (µm)", "largest pressure (GPa)", "Fi", "surface with Fi > 1 (%)", "λ", "SRR"]
    index, share = (figure.traces for figure in flank_page.figures(rough)[2:4])
    assert [line["name"] for line in index][:2] == ["99th percentile at the surface", "median at the surface"]
    assert share[0]["y"] == pytest.approx([12, 12])
    answer = flank_page.of(rough.folder).answer
    assert "The 99th percentile of the index that decides is Fi = 1.20 ± 0.10, at the surface at A" in answer.sentences[0]


def test_a_single_feature_has_its_largest_index_alone(tmp_path):
    flank = Flank.open(made_results.flank(tmp_path / "flank"))
    flank.record["positions"][0]["summary"]["fatigue"]["statistics"] = rough_search()["statistics"]
    names = {column.name for column in flank_columns.used_columns(flank.rows)}
    assert not {"Fi_p99", "Fi_median", "share_above_1", "Sq_m"} & names


def test_the_rms_height_of_both_surfaces():
    assert surface_roughness.rms_of({"a": {"Sq_m": 1.0}, "b": {"Sq_m": 2.0}, "combined": {"Sq_m": 3.0}}) == 3.0
    assert surface_roughness.rms_of({"b": {"Rq_m": 2.0}}) == 2.0 and surface_roughness.rms_of(None) is None
