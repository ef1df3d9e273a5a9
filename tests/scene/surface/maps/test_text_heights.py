"""Heights in text files of instruments: headers, marks of missing points, errors that name the line."""

import numpy as np
import pytest
from map_feature import feature

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import scene
from tehl_taichi.scene.surface.maps import height_map, text_heights

WYKO = ["Wyko ASCII Data File Format\t0\t0\t1", "X Size\t6", "Y Size\t40", "Height units\t5\t4\t\u00b5m", "",
        "RAW_DATA\t3\t264000"]
ROWS = ["\t".join(f"{0.01 * (i + j)}" for i in range(6)) for j in range(40)]


def written(tmp_path, lines, name="scan.asc", encoding="utf-8"):
    (tmp_path / name).write_text("\n".join(lines) + "\n", encoding=encoding)
    return tmp_path / name


@pytest.mark.parametrize("encoding", ["utf-8", "latin-1"])
def test_the_header_of_an_instrument_is_skipped_and_told(tmp_path, encoding):
    table = text_heights.read(written(tmp_path, WYKO + ROWS, encoding=encoding))
    assert table.values.shape == (40, 6) and table.values[3, 2] == 0.05
    assert table.skipped == "5 header lines skipped"
    found = feature(tmp_path / "scan.asc", taper=2e-6)
    assert [*found.kind.preview(found, scene("gear"))][0].startswith("map scan.asc: 5 header lines skipped, 6 x 40 points")


def test_lines_with_a_number_sign_among_the_heights_are_told(tmp_path):
    table = text_heights.read(written(tmp_path, ["# x", *ROWS[:9], "#" + ROWS[9], *ROWS[10:]]))
    assert table.values.shape == (39, 6) and table.skipped == "1 header line skipped, 1 line with # among the heights skipped"


@pytest.mark.parametrize("mark", ["Bad", "nan", "NaN", "No data", "NODATA", "bad data", "***", "---", ""])
@pytest.mark.parametrize("between", ["\t", ",", ";"])
def test_marks_of_missing_points_are_no_words(tmp_path, mark, between):
    rows = [row.split("\t") for row in ROWS]
    rows[0][0] = rows[0][5] = rows[7][2] = mark
    values = text_heights.read(written(tmp_path, [*map(between.join, rows)])).values
    assert values.shape == (40, 6) and [*map(tuple, np.argwhere(np.isnan(values)))] == [(0, 0), (0, 5), (7, 2)]


@pytest.mark.parametrize("mark", ["Bad", "No Data", "***"])
def test_marks_between_blanks(tmp_path, mark):
    rows = [row.replace("\t", " ") for row in ROWS]
    rows[0] = " ".join([mark] * 6)
    values = text_heights.read(written(tmp_path, ["of a flank", *rows])).values
    assert values.shape == (40, 6) and np.isnan(values).sum() == 6 and np.isnan(values[0]).all()


@pytest.mark.parametrize("at, row, words", [
    (20, "and so on", "line 21 has 1 columns|line 21: 'and so on' is neither"),
    (20, ROWS[20].replace("0.23", "high"), "line 21: 'high' is neither a number nor a mark of an unmeasured point"),
    (0, ROWS[0].replace("0.03", "high"), "line 1: 'high' is neither"),
    (20, ROWS[20] + "\t1", r"line 21 has 7 columns, the first row \(line 1\) 6")])
def test_what_is_wrong_below_the_header_is_named_by_its_line(tmp_path, at, row, words):
    with pytest.raises(SceneError, match=f"cannot read heights from .*scan.asc: ({words})"):
        height_map.table_of(written(tmp_path, [*ROWS[:at], row, *ROWS[at + 1:]]))


def test_words_alone_are_refused(tmp_path):
    (tmp_path / "scan.txt").write_bytes(bytes(range(256)) * 20)
    with pytest.raises(SceneError, match="cannot read heights from"):
        height_map.table_of(tmp_path / "scan.txt")
    with pytest.raises(SceneError, match="no line is a row of numbers"):
        height_map.table_of(written(tmp_path, WYKO))


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be", "utf-8-sig"])
def test_encodings_of_windows(tmp_path, encoding):
    table = height_map.table_of(written(tmp_path, ["Height units\t\u00b5m", *ROWS], encoding=encoding))
    assert table.values.shape == (40, 6) and table.values[3, 2] == 0.05 and table.stated.unit == "um"
