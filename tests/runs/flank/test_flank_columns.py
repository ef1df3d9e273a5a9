"""Columns and panels of flanks and cams show the numbers of their names in the units of their heads."""

import re

import pytest

from tehl_taichi.runs.cam import cam_columns
from tehl_taichi.runs.cam.cam_table import CamPosition
from tehl_taichi.runs.flank import flank_columns
from tehl_taichi.runs.flank.place_panels import PANELS
from tehl_taichi.runs.flank.positions import Position

FACTORS = {"mm": 1e3, "um": 1e6, "µm": 1e6, "GPa": 1e-9, "N/mm": 1e-3, "%": 100}  # of printed units, from SI
FLANK = Position(x_pl=1e-3, rho_a=2e-2, rho_b=3e-2, u_a=4.0, u_b=3.0, load=5e5, slip=1.0, arc=6e-3, point="B", bulk=80.0,
                 film_ratios={"lambda_GF": 0.7, "h_min_Ra": 0.9})
CAM = CamPosition(angle=8.0, R=9e-3, load=1e5, u_a=1.1, u_b=0.4)
COLUMNS = [(FLANK, one) for one in flank_columns.COLUMNS] + [(CAM, one) for one in cam_columns.COLUMNS
                                                             if one not in flank_columns.COLUMNS]
# words in the legends of a figure, and of the keys that they mean
MEANT = {"steady": "steady", "feature passes": "transient", "surface a": "surface_a", "centre": "h_c", "smallest": "h_min",
         "99th": "p99", "median": "median", "below": "below", "film,": "film_max_C", "h_c/": "lambda"}


def results():
    """Summary with numbers that all differ, as its own numbers count them."""
    counted = iter(range(1, 100))

    def part(*keys):
        return {**{key: 1.01 * next(counted) for key in keys}, "error": {key: 0.01 * next(counted) for key in keys}}

    film = "h_c_m", "h_min_m", "p_max_Pa", "film_max_C", "friction_coefficient"
    statistics = "p99", "median", "share_above_1"
    return {"steady": part(*film), "transient": part(*film), "life": part("passages", "hours"), "von_mises": part("max_Pa"),
            "fatigue": {**part("Fi_max"), "rough": True, "statistics": part(*statistics),
                        "below": {**part("Fi_max"), "statistics": part(*statistics)}}}


def path_of(name):
    """(part of the summary ..., key) that the name of a column means."""
    if name.endswith("_below"):
        return "fatigue", "below", *path_of(name.removesuffix("_below"))[1:]
    begin = {"steady": "steady", "passage": "transient", "von": "von_mises", "passages": "life", "hours": "life"}
    part = begin.get(name.partition("_")[0], "fatigue")
    key = re.sub("^(steady|passage|von_mises|Fi)_", "", name).replace("friction", "friction_coefficient")
    if key in ("p99", "median", "share_above_1"):
        return part, "statistics", key
    return part, "Fi_max" if name == "Fi_max" else key


@pytest.mark.parametrize("at, column", COLUMNS, ids=lambda one: getattr(one, "name", ""))
def test_a_column_has_the_number_of_its_name_in_the_unit_of_its_head(at, column):
    assert column.factor == FACTORS.get(column.head.split()[-1], 1)
    name, summary = column.name, results()
    own = re.sub("_(m_s|N_m|m|C|deg)$", "", name)
    if hasattr(at, own):
        assert column.value(at, 1.5e9, summary) == getattr(at, own)
    elif name in FLANK.film_ratios or name == "p_Hertz_Pa":
        assert column.value(at, 1.5e9, summary) == {**FLANK.film_ratios, "p_Hertz_Pa": 1.5e9}[name]
    elif name not in ("Sq_m", "lambda", "Fi_judged", "worse_body"):
        *parts, key = path_of(name)
        for part in parts:
            summary = summary[part]
        assert (column.value(at, 1.5e9, results()), column.error(at, 1.5e9, results())) == (summary[key], summary["error"][key])


@pytest.mark.parametrize("label, factor, lines", PANELS, ids=lambda one: one if isinstance(one, str) else "")
def test_a_panel_draws_the_numbers_of_its_legend_in_the_unit_of_its_axis(label, factor, lines):
    unit = re.search(r"\((.+)\)$", label)
    assert factor == FACTORS.get(unit[1] if unit else "", 1)
    for legend, keys in lines.items():
        for word, key in MEANT.items():
            if isinstance(keys, tuple) and word in legend:
                assert any(key in one for one in keys), (legend, keys)


def test_the_shaded_side_is_the_dedendum_of_negative_distances(tmp_path):
    import made_results

    import tehl_taichi as tehl
    from tehl_taichi.runs.flank import flank_figure
    from tehl_taichi.view.figures.figure_style import FigureStyle

    pytest.importorskip("matplotlib")
    axes = flank_figure.drawn(FigureStyle(), tehl.open(made_results.flank(tmp_path))).axes
    for ax in axes:
        shade, = ax.patches
        assert shade.get_x() == pytest.approx(ax.get_xlim()[0]) and shade.get_x() + shade.get_width() == pytest.approx(0.0)
    sides = {text.get_text(): text.get_ha() for text in axes[-1].texts}
    assert (sides["dedendum"], sides["addendum"]) == ("right", "left"), "of a place at the pitch point"


def test_positions_of_a_stored_flank_are_those_of_its_record(tmp_path):
    import made_results

    import tehl_taichi as tehl

    found = tehl.open(made_results.flank(tmp_path))
    for at, one in zip(found.positions, found.record["positions"], strict=True):
        assert (at.srr, at.R, at.load, at.u_a, at.u_b) == pytest.approx(
            [one[key] for key in ("srr", "R_m", "load_N_m", "u_a_m_s", "u_b_m_s")]) and abs(at.u_m - 1) > 0.5
