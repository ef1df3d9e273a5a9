"""Flanks, bearings, cams and studies side by side: by position, held against error bars."""

import json
from types import SimpleNamespace

import made_results
import pytest
from fake_cases import formula
from small_stores import SMALL, store
from tehl_cli.main import app
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.runs import place_table
from tehl_taichi.runs.cam import cam_columns
from tehl_taichi.runs.compare_change import NOT_SEPARATED, are_separated, change
from tehl_taichi.runs.compare_places import PlaceComparison
from tehl_taichi.runs.flank import flank_columns
from tehl_taichi.runs.flank.stored_flank import Flank
from tehl_taichi.runs.sweep import case

BASE = tehl.scene("gear").replace(**{"thermal.on": False})


@pytest.mark.parametrize("first, second, expected", [
    ((1.0, 0.49), (1.13, 0.61), NOT_SEPARATED), ((1.0, 0.05), (1.13, 0.05), "+13%"), ((1.0, None), (1.13, 0.2), NOT_SEPARATED),
    ((1.0, None), (1.13, None), "+13%"), ((2e-4, None), (2e-3, None), ""), ((2e-4, 1e-5), (2e-3, 1e-5), ""),
    ((1.0, 0.0), (1.0, 0.0), ""), ((0.01, 0.02), (0.3, 0.02), ""), ((0.02, 1e-3), (0.3, 1e-3), "x 15")])
def test_a_change_is_held_against_error_bars_and_the_size_of_the_quantity(first, second, expected):
    assert change(first, second, nothing=1e-3) == expected


def test_negative_numbers_change_by_their_magnitude():
    """Friction against the direction of x: nearer to zero is more."""
    assert change((-0.05, 0.001), (-0.06, 0.001)) == "-20%" and change((-0.05, 0.001), (-0.04, 0.001)) == "+20%"


def test_temperatures_differ_by_kelvins():
    assert change((90.0, 1.0), (93.2, 0.5), unit="degC") == "+3.2 K" and are_separated((90.0, None), (93.2, None)) is None
    assert change((90.0, 2.0), (93.2, 2.0), unit="degC") == NOT_SEPARATED
    assert are_separated((1.320, None), (1.310, 0.007)) is None and are_separated((1.212, 0.005), (1.210, None)) is False


@pytest.fixture
def flanks(tmp_path):
    """Two flanks of three positions: of another torque, with other numbers, the second with a store."""
    made = [Flank.open(made_results.flank(tmp_path / name)) for name in "ab"]
    record = made[1].to_dict()
    record["geometry"]["torque"] = 300.0
    A, C = (one["summary"] for one in record["positions"][:2])
    A["steady"] |= {"h_c_m": 2e-7, "p_max_Pa": 1.3e9}
    A["fatigue"] |= {"Fi_max": 1.5, "error": {"Fi_max": 0.2}}
    C["fatigue"] |= {"Fi_max": 0.9, "error": {"Fi_max": 0.01}}
    Flank(made[1].folder, record).write()
    return [one.folder for one in made]


def test_flanks_are_compared_by_position(flanks):
    found = tehl.compare(*flanks)
    assert repr(found) == "<tehl.PlaceComparison flank: a, b>" and found.differs == {"torque": [265.1, 300.0]}
    assert found.labels() == ["torque = 265.1", "torque = 300"]
    rows = {(row.name, row.place.key): row for row in found.rows}
    assert [place.key for place in found.places] == ["A", "C", "E"]
    assert rows["steady_h_c_m", "A"].texts == ("0.100 ± ?", "0.200 ± ?")
    assert rows["steady_h_c_m", "A"].change == "+100% (error unknown)"
    assert rows["Fi_max", "A"].change == NOT_SEPARATED, "1.4 of an unknown error, 1.5 ± 0.2"
    assert rows["Fi_max", "C"].change == "+29% (error unknown)" and ("Fi_max", "E") not in rows
    assert found.without_result() == {"a": ["E (x_pl = 9.596 mm)"], "b": ["E (x_pl = 9.596 mm)"]}
    assert rows["srr", "C"].change == "" and found.unequal() == ["steady_h_c_m", "steady_p_max_Pa", "Fi_max", "Fi_judged"]
    assert tehl.compare(*map(tehl.open, flanks)).differs == found.differs


def test_positions_of_one_flank_alone_stand_in_their_place(flanks):
    record = Flank.open(flanks[0]).to_dict()
    record["positions"][1] |= {"point": "", "x_pl_m": -1e-3}
    Flank(flanks[0], record).write()
    found = tehl.compare(*flanks)
    assert [place.key for place in found.places] == ["A", -1e-3, "C", "E"]
    assert next(row for row in found.rows if row.name == "Fi_max" and row.place.key == "C").texts == ("-", "0.900 ± 0.010")


def test_oils_of_the_stores_are_differences(flanks):
    """Of what all contacts of a flank have in common."""
    store(flanks[0] / "1.zarr", 2)
    alone = tehl.compare(*flanks)
    assert alone.differs == {"torque": [265.1, 300.0]} and alone.without_settings == [flanks[1].name], "it has no store"
    store(flanks[1] / "1.zarr", 2, SMALL.replace(**{"oil.name": "mineral-vg100"}))
    store(flanks[1] / "2.zarr", 2, SMALL.replace(**{"oil.name": "mineral-vg100", "load": 1.2e6, "srr": 0.1}))
    found = tehl.compare(*flanks)
    assert found.without_settings == []
    assert not any(key.startswith(("contact.", "operation.srr")) for key in found.differs), "positions have their own"
    assert found.differs["oil.name"] == ["reference-pao", "mineral-vg100"] and "oil.S0" in found.differs
    assert found.labels() == ["torque = 265.1, oil = reference-pao", "torque = 300, oil = mineral-vg100"]


def test_the_command_prints_a_table_by_position_and_one_figure(flanks, tmp_path):
    done = CliRunner().invoke(app, ["compare", *map(str, flanks), "--out", str(tmp_path / "c.png"), "--at", "0.5"],
                              env={"COLUMNS": "140"})
    printed = done.stdout
    assert done.exit_code == 0 and (tmp_path / "c.png").exists()
    assert "not separated: the error bars overlap" in printed and "equal in all: reduced radius R'; " in printed
    assert "--at 0.5 has no effect here: it applies to runs" in done.output
    assert "no result in b: E (x_pl = 9.596 mm)" in printed
    assert printed.index("torque") < printed.index("steady h_c, um") < printed.index("C (x_pl = 0 mm)")
    of = json.loads(CliRunner().invoke(app, ["compare", *map(str, flanks), "--json", "--force"]).stdout)
    assert of["kind"] == "flank" and of["figure"].endswith("compare.png")
    row = next(row for row in of["rows"] if row["quantity"] == "Fi_max" and row["at"].startswith("A"))
    assert row["values"] == [1.4, 1.5] and row["errors"] == [None, 0.2] and row["separated"] is False


def test_the_figure_has_a_line_for_each_over_the_line_of_action(flanks, monkeypatch):
    pytest.importorskip("matplotlib")
    from tehl_taichi.runs.compare_places_figure import drawn, panels
    from tehl_taichi.view.figures.figure_style import FigureStyle

    found = tehl.compare(*flanks)
    assert panels(found) == ["Fi_judged", "Fi_max", "steady_h_min_m", "steady_p_max_Pa", "p_Hertz_Pa"]
    figure = drawn(FigureStyle(), found, panels(found))
    first, second = figure.axes[0].containers
    places = Flank.open(flanks[0]).positions
    assert first.lines[0].get_xdata() == pytest.approx([1e3 * at.x_pl for at in places])
    assert second.lines[0].get_ydata()[:2] == pytest.approx([1.5, 0.9])
    assert [ax.get_ylabel() for ax in figure.axes][1:3] == ["steady p_max (GPa)", "Fi at the surface,\nlargest"]
    assert figure.axes[4].get_xlabel().startswith("x_pl")


@pytest.fixture(scope="module")
def studies(tmp_path_factory):
    """Three made-up studies: two over slip, of which the second has a value more, and one over the height."""
    folder = tmp_path_factory.mktemp("studies")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(case, "run_case", lambda job, *_: formula(job))
        slips, more = {"srr": [-0.1, 0.1]}, {"srr": [-0.1, 0.0, 0.1]}
        for name, axes, height in (("thin", slips, 0.5e-6), ("thick", more, 1e-6), ("heights", {"height": [1e-6, 2e-6]}, 1e-6)):
            tehl.sweep(BASE.replace(height=height), axes, folder / name, workers=1)
    return folder


def test_studies_over_the_same_keys_are_compared_by_case(studies):
    found = tehl.compare(studies / "thin", studies / "thick")
    assert found.kind == "study" and found.differs["feature.0.height"] == [0.5e-6, 1e-6]
    assert [(place.words, place.x) for place in found.places] == [("srr = -0.1", -0.1), ("srr = 0", 0.0), ("srr = 0.1", 0.1)]
    row = next(row for row in found.rows if row.name == "fatigue_Fi_max")
    assert row.numbers == ((pytest.approx(0.75), 0.04), (pytest.approx(0.9), None)) and row.change == "+20% (error unknown)"
    assert row.quantity.heading == "Fi at the surface, largest"
    judged = next(row for row in found.rows if row.name == "judged_Fi")
    assert judged.numbers == row.numbers and judged.quantity.heading == "Fi judged"
    alone = next(row for row in found.rows if row.place.x == 0.0)
    assert alone.texts[0] == "-" and alone.change == ""


@pytest.mark.parametrize("first, second", [
    ({"speed": [5, 10]}, {"speed": [5.0, 10.0]}), ({"speed": "5:10:2"}, {"operation.u_m": ["10 m/s", "500 cm/s"]}),
    ({"speed": [0.1 + 0.2]}, {"speed": [0.3]}), ({"thermal.on": [True, False]}, {"thermal.on": ["auto", False, True]})])
def test_equal_values_of_two_studies_are_one_place(first, second, tmp_path, monkeypatch):
    """However the key and its values were typed."""
    monkeypatch.setattr(case, "run_case", lambda job, *_: formula(job))
    one, other = (tehl.sweep(BASE, over, tmp_path / name, workers=1) for name, over in (("one", first), ("other", second)))
    found = tehl.compare(one, other)
    assert len(found.places) == max(len(one), len(other))
    assert sum(None not in row.numbers for row in found.rows if row.name == "steady_h_c_m") == len(one)


def test_studies_over_other_keys_and_results_of_two_kinds_are_refused(studies, flanks):
    with pytest.raises(tehl.SceneError, match="thin is over srr and .*heights over height; allowed: studies over the same"):
        tehl.compare(studies / "thin", studies / "heights")
    with pytest.raises(tehl.SceneError, match="a is a flank and .*thin is a study; allowed: results of one kind .a run of the "
                                              "flank is .*a/POSITION.zarr"):
        tehl.compare(flanks[0], studies / "thin")
    with pytest.raises(tehl.StoreError, match="a is given twice"):
        tehl.compare(flanks[0], flanks[0])


def test_a_flank_that_was_killed_before_its_first_file_is_no_run(flanks, tmp_path):
    with pytest.raises(tehl.StoreError, match="is not a run, study, flank, bearing or cam: it has none of"):
        tehl.compare(flanks[0], tmp_path)


def test_bearings_are_compared_by_ring(tmp_path):
    made = [tehl.bearing("6206", load=load, speed=1500.0, run=False, folder=tmp_path / name)
            for name, load in (("low", 2000.0), ("high", 4000.0))]
    found = tehl.compare(*made)
    assert found.differs == {"load": [2000.0, 4000.0]}
    rows = {(row.name, row.place.words): row for row in found.rows}
    assert rows["p_Hertz_Pa", "inner ring"].change == "+26%", "the cube root of two"
    assert "R_x_m" not in found.unequal() and rows["R_x_m", "inner ring"].change == ""
    assert found.plot(tmp_path / "rings.png").exists()
    for folder, load in zip(("low", "high"), (1.0, 2.0)):  # rings have the same load
        store(tmp_path / folder / "6206-inner.zarr", 2, SMALL.replace(load=(1 + 0.05 * load) * 1e6))
    assert tehl.compare(*made).differs == {"load": [2000.0, 4000.0]}


def test_cams_are_compared_by_angle(tmp_path):
    from tehl_taichi.runs.cam.stored_cam import Cam

    def cam(name, h, source="t.csv"):
        one = {"R_m": 0.01, "load_N_m": 1e5, "u_a_m_s": 2.0, "u_b_m_s": 1.0, "u_m_m_s": 1.5, "srr": 2 / 3, "p_Hertz_Pa": 1e9,
               "reason": "", "summary": {"steady": {"h_c_m": h, "error": {"h_c_m": 1e-9}}}}
        record = {"name": "mine", "source": source, "oil": "pao", "temperature_C": 90.0,
                  "positions": [{**one, "angle_deg": angle} for angle in (-10.0, 10.0)]}
        return Cam(tmp_path / name, record).write()[0].parent

    found = tehl.compare(cam("one", 2e-7), cam("two", 3e-7, "u.csv"))
    assert found.differs == {"source": ["t.csv", "u.csv"]}
    assert [(row.place.words, row.change) for row in found.rows if row.name == "steady_h_c_m"] == [
        ("-10 deg", "+50%"), ("10 deg", "+50%")]


def test_bars_of_a_line_are_in_the_unit_of_its_values(tmp_path):
    folder = made_results.flank(tmp_path / "a")
    record = Flank.open(folder).to_dict()
    record["positions"][0]["summary"]["steady"] |= {"h_c_m": 2e-7, "error": {"h_c_m": 5e-8}}
    Flank(folder, record).write()
    comparison = PlaceComparison("flank", (place_table.place_table("flank", Flank.open(folder)),))
    _, values, bars = comparison.line(comparison.tables[0], "steady_h_c_m")
    assert bars[0] / values[0] == pytest.approx(0.25)


FACTORS = {"mm": 1e3, "um": 1e6, "N/mm": 1e-3, "GPa": 1e-9, "deg C": 1, "m/s": 1, "": 1}  # from SI


@pytest.mark.parametrize("columns", [flank_columns.COLUMNS, cam_columns.COLUMNS], ids=("flank", "cam"))
def test_printed_units_are_those_that_numbers_are_brought_to(columns):
    """In the heads of the tables and in the labels of a comparison."""
    for column in columns:
        unit = column.head.split()[-1]
        if unit in FACTORS:
            assert column.factor == pytest.approx(FACTORS[unit]), column.head
        if column.name in place_table.CONTACT:
            assert column.factor == pytest.approx(FACTORS[place_table.CONTACT[column.name][1]]), column.name


@pytest.mark.parametrize("unit, x, factor, label", [("Pa", 2e9, 1e-9, "pressure (GPa)"), ("m", 3e-4, 1e6, "pressure (µm)"),
                                                    ("", 0.1, 1.0, "pressure")])
def test_an_axis_is_in_a_unit_of_its_key(unit, x, factor, label):
    from tehl_taichi.runs import compare_places_figure

    tables, places = [SimpleNamespace(x_unit=unit, across="pressure")], [SimpleNamespace(x=one) for one in (x, -x / 2)]
    found = compare_places_figure._axis(SimpleNamespace(tables=tables, places=places))
    assert found == (pytest.approx(factor), label)


@pytest.mark.parametrize("other, said, listed", [
    ([0.2, 0.3], "no place in common", True), ([0.1, 0.3], "equal at the 1 common place: ", False),
    ([-0.1, 0.1], "equal in all: ", False)])
def test_studies_are_equal_only_where_both_have_a_case(other, said, listed, tmp_path, monkeypatch):
    """A quantity that no case of both has is in the table, and never equal."""
    from tehl_taichi.runs.sweep import sweeping
    from tehl_taichi.runs.sweep.plan import plan

    gear = BASE.replace(**{"grid.nx": 64, "grid.ny": 16})
    for name, values in (("a.zarr", [-0.1, 0.1]), ("b.zarr", other)):
        sweeping.run(plan(gear, {"srr": values}), tmp_path / name, workers=1, keep="summary", work=formula)
    monkeypatch.chdir(tmp_path)
    printed = CliRunner().invoke(app, ["compare", "a.zarr", "b.zarr", "--out", "c.png", "--dpi", "40"]).output
    assert said in printed and ("differences between the results" in printed) == listed
    assert ("equal" in printed) != listed and ("passage h_min" in printed)
