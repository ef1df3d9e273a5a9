"""A number with its error has one form in the whole project."""

import math
import re
from pathlib import Path

import pytest

from tehl_taichi.values.digits import SCALES, micrometres, number_of, part_of, printed_unit, with_bar, with_error
from tehl_taichi.values.units import in_unit

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("value, error, shown", [
    (1.00812, 0.0231, "1.008 ± 0.023 u"), (0.3947, 0.0005, "0.39470 ± 0.00050 u"), (123.4, 0.99, "123.40 ± 0.99 u"),
    (-1.23, 0.0456, "-1.230 ± 0.046 u"), (0.0004, 0.0123, "0.000 ± 0.012 u"), (0.5, 0.0999, "0.50 ± 0.10 u"),
    (12345.0, 678.0, "12340 ± 680 u"), (2.286e11, 1e12, "(0.2 ± 1.0)e+12 u"), (3.2e-7, 1e-8, "(3.20 ± 0.10)e-07 u"),
    (1e-20, 1.5e-19, "0 ± 0 u"), (0.3947, 1e-12, "0.3947 ± 0 u"), (2.5, 0.0, "2.5 ± 0 u"), (1.0, math.nan, "1 u"),
    (0.39441, None, "0.3944 u"), (4.0247e9, None, "4.025e+09 u")])
def test_two_digits_of_the_error_and_as_many_decimals_of_the_value(value, error, shown):
    assert with_error(value, error, "u") == shown


def test_value_and_error_have_the_same_decimals():
    for power in range(-11, 12):
        for ratio in (1e-7, 3.3e-5, 0.0099, 0.5, 7.0):
            text = with_error(1.2345 * 10.0**power, 1.2345 * ratio * 10.0**power)
            found = re.match(r"\(?(-?\d+(?:\.(\d+))?) ± (\d+(?:\.(\d+))?)", text)
            assert found and found[2] == found[4] or len(found[2]) == len(found[4]), found


@pytest.mark.parametrize("unit", [*SCALES, "W"])
def test_a_printed_unit_is_read_as_the_number_that_it_stands_for(unit):
    for size in (-3e9, -2e-4, 0.0, 5e-7, 2e-3, 4.0, 8e8, 3e9):
        factor, shown = printed_unit(unit, size)
        assert in_unit("", f"{size * factor!r} {shown}", unit) == pytest.approx(size) if shown != unit else factor == 1.0


@pytest.mark.parametrize("unit, size, shown", [("m", 9e-4, "µm"), ("m", -9e-4, "µm"), ("m", 2e-3, "mm"), ("m", -2e-3, "mm"),
                                               ("m", 2.0, "m"), ("Pa", -9e8, "MPa"), ("Pa", -2e9, "GPa")])
def test_numbers_of_either_sign_have_the_printed_unit_of_their_size(unit, size, shown):
    assert printed_unit(unit, size)[1] == shown


@pytest.mark.parametrize("length, shown", [(9.74e-6, "9.7"), (9.94e-6, "9.9"), (9.96e-6, "10"), (183.4e-6, "183"), (0.0, "0")])
def test_lengths_below_ten_micrometres_have_two_digits(length, shown):
    assert micrometres(length) == shown


def test_nothing_else_writes_a_plus_minus():
    """But what has several errors, or says by what."""
    code = re.compile(r"\} ± \{")
    sources = [*(ROOT / "tehl_taichi").rglob("*.py"), *(ROOT / "cli").rglob("*.py")]
    assert [path.name for path in sources if code.search(path.read_text(encoding="utf-8"))] == ["digits.py"]


@pytest.mark.parametrize("count, verb", [(0, "have"), (1, "has"), (2, "have")])
def test_a_count_of_one_has_a_singular_noun(count, verb):
    assert number_of(count, "case") == (f"{count} case" if count == 1 else f"{count} cases")
    assert number_of(count, "entry", "entries").endswith("entry" if count == 1 else "entries")
    for total in (1, 3):
        assert part_of(count, total, "case", "has", "have") == f"{count} of {number_of(total, 'case')} {verb}"


def test_no_count_of_a_list_has_a_plural_of_its_own():
    """A list may have one entry, except in messages about none, too many or at least two."""
    code = re.compile(r"\{len\([\w.]+\)\} [a-z]+s\b")
    sources = [*(ROOT / "tehl_taichi").rglob("*.py"), *(ROOT / "cli").rglob("*.py")]
    found = [hit for path in sources for line in path.read_text(encoding="utf-8").splitlines() for hit in code.findall(line)]
    assert sorted(found) == [
        "{len(features)} features", "{len(found)} rows", "{len(found)} rows", "{len(names)} names",
        "{len(self.stores)} runs", "{len(value)} characters", "{len(warnings)} warnings"]


@pytest.mark.parametrize("error, said", [(0.02, "1.00 ± 0.02"), (0.0, "1.00 ± 0.02"), (None, "1.00 ± 0.02 ± ?"),
                                         (float("nan"), "1.00 ± 0.02 ± ?")])
def test_a_bar_that_is_not_known_is_marked(error, said):
    assert with_bar("1.00 ± 0.02", error) == said
