"""Tables as users write them: separators, decimal commas, other units."""

import pytest

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.cam import cam_table
from tehl_taichi.runs.flank import load_table
from tehl_taichi.scene.strength import table_file

CAM = "angle_deg, load_N_per_mm, R_mm, u_a_m_s, u_b_m_s\n-20, 116.4, 16.6, 2.0, 0.6\n0, 120, inf, 2.2, 0.7\n"


def cam(tmp_path, text):
    path = tmp_path / "cam.csv"
    path.write_text(text.replace("inf", "18"))
    return cam_table.load(path)


@pytest.mark.parametrize("text", [
    CAM.replace(",", ";").replace(".", ","), CAM.replace(", ", "\t"), CAM.replace(",", " "), CAM.replace("\n", "\n\n"),
    "\n# made by hand, 1; 2\n" + CAM.replace(",", ";").replace(".", ","), CAM + ",,,,\n",
    "angle_rad,load_kN_per_m,R_m,u_a_mm_s,u_b_cm_s\n-0.3490658503988659,116.4,0.0166,2000,60\n0,120,0.018,2200,70\n",
    "angle (deg),load [kN/m],R (cm),u_a (m/s),u_b (m/s)\n-20,116.4,1.66,2.0,0.6\n0,120,1.8,2.2,0.7\n"],
    ids=["semicolons", "tabs", "blanks", "empty lines", "comments", "empty rows", "other units", "brackets"])
def test_a_cam_table_in_other_words_is_the_same_cam(tmp_path, text):
    for one, other in zip(cam(tmp_path, text), cam(tmp_path, CAM), strict=True):
        for key in ("angle", "R", "load", "u_a", "u_b"):
            assert getattr(one, key) == pytest.approx(getattr(other, key), rel=1e-12)
        assert not one.more


def test_a_flank_table_in_other_units(tmp_path):
    path = tmp_path / "flank.csv"
    path.write_text("x_pl_um;R_a_m;R_b_mm;load_N_per_m;u_a_m_s;u_b_m_s;bulk_K\n-3700;0,0103;24,6;560e3;2,3;3,7;363,15\n")
    (at,) = load_table.load(path)
    assert (at.x_pl, at.rho_a, at.rho_b, at.load) == pytest.approx((-3.7e-3, 0.0103, 0.0246, 5.6e5))
    assert at.bulk == pytest.approx(90.0) and not at.more


def test_a_unit_of_something_else_is_no_column(tmp_path):
    with pytest.raises(SceneError, match="no column load_N_per_mm .did you mean 'load_N'"):
        cam(tmp_path, CAM.replace("load_N_per_mm", "load_N"))
    with pytest.raises(SceneError, match="has the column load_N_per_mm twice"):
        cam(tmp_path, "angle_deg,load_N_per_mm,load_kN_per_m,R_mm,u_a_m_s,u_b_m_s\n0,1,1,1,1,1\n")
    with pytest.raises(SceneError, match="row 2: u_b_m_s = '' is not a number"):
        cam(tmp_path, CAM.replace(", 0.6", ","))


@pytest.mark.parametrize("cells, said", [
    ("0,100,5,10,5,4", "has 6 columns; allowed: 5, as in the line of names .a decimal comma needs a semicolon"),
    ("0,100,10,5", "has 4 columns; allowed: 5"), ("0", "has 1 column; allowed: 5")])
def test_a_row_that_does_not_fit_its_names_is_refused(tmp_path, cells, said):
    """Decimal commas between commas shift the columns."""
    heads = "angle_deg,load_N_per_mm,R_mm,u_a_m_s,u_b_m_s"
    for at, rows in enumerate((f"{cells}\n1,100,10,5,4", f"1,100,10,5,4\n{cells}"), 2):
        with pytest.raises(SceneError, match=f"row {at} {said}"):
            cam(tmp_path, f"{heads}\n{rows}\n")


def test_names_in_a_comment_are_none(tmp_path):
    with pytest.raises(SceneError, match="begins with the number -20; allowed: a line of names, without # before it"):
        cam(tmp_path, f"# {CAM}")


def test_empty_cells_beyond_the_names_count_as_none(tmp_path):
    plain, ended = cam(tmp_path, CAM), cam(tmp_path, CAM.replace("\n", ",,\n"))
    assert plain == ended and not ended[0].more
    with pytest.raises(SceneError, match="row 2 has 7 columns"):
        cam(tmp_path, CAM.replace("0.6\n", "0,6,1\n", 1).replace("u_b_m_s", "u_b_m_s,,"))


@pytest.mark.parametrize("form", ["{}/{}", "{} / {}", "{}/({})", "{} ({})", "{}[{}]"])
def test_units_after_a_slash_are_those_in_brackets(tmp_path, form):
    heads = [form.format(*each) for each in (("angle", "deg"), ("load", "N/mm"), ("R", "cm"), ("u_a", "m/s"), ("u_b", "m/s"))]
    found = cam(tmp_path, ";".join(heads) + "\n-20;116,4;1,66;2;0,6\n0;120;1,8;2,2;0,7\n")
    for one, other in zip(found, cam(tmp_path, CAM), strict=True):
        assert (one.angle, one.load, one.R) == pytest.approx((other.angle, other.load, other.R)) and not one.more


@pytest.mark.parametrize("head", ["bulk", "bulk_F", "bulk (F)", "Bulk temperature"])
def test_a_bulk_temperature_in_no_known_unit_is_not_ignored(tmp_path, head):
    path = tmp_path / "flank.csv"
    path.write_text(f"x_pl_mm;R_a_mm;R_b_mm;load_N_per_mm;u_a_m_s;u_b_m_s;{head}\n-3,7;10,3;24,6;560;2,3;3,7;200\n")
    with pytest.raises(SceneError, match="which is no temperature with its unit; allowed: bulk_C, or"):
        load_table.load(path)


TABLES = {"`tehl flank`": "x_pl_mm,load_N_per_mm,R_a_mm,R_b_mm,u_a_m_s,u_b_m_s\n1,300,10,20,3,2\n",
          "`tehl cam`": "angle_deg,load_N_per_mm,R_mm,u_a_m_s,u_b_m_s\n0,100,20,1,3\n",
          "`tehl run --table`": "depth_mm,hardness_HV\n0,700\n1,500\n"}
LOADS = {"`tehl flank`": load_table.load, "`tehl cam`": cam_table.load,
         "`tehl run --table`": lambda path: table_file.text_of(str(path), "fatigue.table")}


@pytest.mark.parametrize("taker, given", [(one, other) for one in LOADS for other in TABLES if one != other])
def test_a_table_for_another_command_is_sent_there_without_a_suggestion(tmp_path, taker, given):
    (tmp_path / "t.csv").write_text(TABLES[taker])
    LOADS[taker](tmp_path / "t.csv")
    (tmp_path / "t.csv").write_text(TABLES[given])
    with pytest.raises(SceneError) as said:
        LOADS[taker](tmp_path / "t.csv")
    assert str(said.value).endswith(f"is one for {given}") and "did you mean" not in str(said.value)


def test_a_suggested_column_begins_like_the_missing_one(tmp_path):
    for written, meant in (("xpl_mm", True), ("X_PL (mm)", True), ("b_mm", False), ("y_mm", False)):
        (tmp_path / "t.csv").write_text(TABLES["`tehl flank`"].replace("x_pl_mm", written))
        with pytest.raises(SceneError) as said:
            load_table.load(tmp_path / "t.csv")
        assert (f"x_pl_mm (did you mean {written!r}?)" in str(said.value)) == meant
