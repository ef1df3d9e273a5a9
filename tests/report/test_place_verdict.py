"""The answer on contacts along a path: by the resolved part, with places that error bars do not separate."""

import made_results
import pytest

from tehl_taichi.report import place_sections, place_verdict
from tehl_taichi.runs import place_warnings
from tehl_taichi.values.coded_warning import CodedWarning, lists


def search(Fi, error=None, early=None, alone=0.9):
    """Summary of a search at the surface; early: (Fi, error) of its resolved part."""
    found = {**made_results.fatigue(Fi, None), "error": {"Fi_max": error}}
    found["contact_alone"] |= {"Fi_max": alone, "error": {"Fi_max": 0.01}}
    if early:
        found["resolved"] = {**made_results.fatigue(early[0], None), "error": {"Fi_max": early[1]}, "to_x_a": -0.5}
    return found


def answer(**found):
    """(headline, tone, sentences) of positions by name."""
    rows = [(name, 1e9, one and {"fatigue": one}) for name, one in found.items()]
    places = place_verdict.judged_places(rows, str, lambda name: f"point {name}")
    return place_verdict.answer(places, len(rows))


def test_the_largest_index_alone_is_named():
    text, tone, sentences = answer(A=search(1.4, 0.1), B=search(1.1, 0.05), C=search(1.02, 0.05), E=None)
    assert (text, tone) == ("Yes: the fatigue limit is exceeded at the surface at point A.", "yes")
    assert sentences[1:] == ("The index that decides is Fi = 1.40 ± 0.10, at the surface at point A.",
                             "It is above 1 at 2 of 4 positions; 1 lies within the error at 1 more.")
    assert sentences[0].startswith("The smooth contacts alone: Fi = 0.900 ± 0.010 at most, 180 µm below the surface at point A")


def test_places_that_errors_do_not_separate_are_named_together():
    text, _, sentences = answer(A=search(1.40, 0.1), B=search(1.45, 0.05), C=search(1.35, 0.06), E=search(1.2, 0.05))
    assert text == "Yes: the fatigue limit is exceeded between A and C, where the errors do not separate the positions."
    assert "at point B; its error does not separate it from A and C." in sentences[1]
    apart, *_ = answer(A=search(1.40, 0.1), B=search(1.1, 0.05), E=search(1.45, 0.05))
    assert "exceeded at A and E, where the errors do not separate" in apart


def test_a_known_error_decides_before_a_larger_index_without_one():
    """As among the surfaces of one contact."""
    for known, unknown in (("A", "B"), ("B", "A")):
        text, *_ = answer(**{known: search(1.40, 0.1), unknown: search(1.45)})
        assert text == f"Yes: the fatigue limit is exceeded at the surface at point {known}."
    text, *_ = answer(A=search(1.45), B=search(0.9, 0.01))
    assert text == "Probably yes: the fatigue limit is exceeded at the surface at point A; the error of this is unknown."


def test_the_thinnest_film_is_named_with_its_place():
    steady = [{"steady": {"h_min_m": film, "error": {"h_min_m": 2e-9}}} for film in (3e-7, 1e-7, 2e-7)]
    rows = [(name, 1e9, summary) for name, summary in zip("ABCD", [*steady, None])]
    assert place_verdict.thinnest(rows) == ("0.1000 ± 0.0020 µm", "B") and place_verdict.thinnest(rows[3:]) is None
    assert place_sections.critical_number(rows, []) == 1 and place_sections.critical_number(rows[3:], []) is None


def test_a_place_is_judged_by_its_resolved_part():
    """The whole passage of D has the largest index, which its grid does not resolve; E decides."""
    text, tone, sentences = answer(D=search(2.3, None, (1.25, 0.02)), E=search(1.9, None, (1.6, 0.03)))
    assert tone == "yes" and text == ("Yes: the fatigue limit is exceeded at the surface at point E, even without the "
                                      "pressures that the grid does not resolve.")
    assert sentences[1] == "The index that decides is Fi = 1.600 ± 0.030, at the surface at point E."
    assert sentences[2].startswith("At D and E the grid does not resolve")
    assert sentences[2].endswith("Fi = 2.3 (error unknown), at the surface at point D.")


@pytest.mark.parametrize("whole, expected", [
    (1.7, ("Not decided: the index stays below 1 while the grid resolves the pressure, and exceeds 1 later at D.", "open")),
    (0.9, ("Probably not: the index stays below 1, but over the whole passage its error is unknown.", "no"))])
def test_an_index_that_exceeds_1_only_later_decides_nothing(whole, expected):
    assert answer(D=search(whole, None, (0.8, 0.02)), E=search(0.7, 0.02))[:2] == expected


def test_later_moments_count_by_their_worst_depth():
    """At the surface the whole passage stays below 1, below it it does not."""
    late = search(0.9, None, (0.8, 0.02))
    late["below"] = made_results.fatigue(0.9, 1.7)["below"]
    late["resolved"]["below"] = {**made_results.fatigue(0.8, 0.7)["below"], "error": {"Fi_max": 0.02}}
    text, tone, sentences = answer(D=late, E=search(0.7, 0.02))
    assert tone == "open" and text.endswith("and exceeds 1 later at D.") and any("Fi = 1.7" in one for one in sentences)


def test_the_load_alone_comes_first():
    text, *_ = answer(A=search(1.4, 0.1, alone=1.2), B=search(0.7, 0.1))
    assert text.endswith("at the surface at point A. The load alone exceeds it, without any feature.")
    larger = search(0.7, 0.1, alone=1.3)
    larger["contact_alone"]["error"]["Fi_max"] = 0.5  # may not exceed the limit, which the other load surely does
    assert answer(A=search(1.4, 0.1, alone=1.2), B=larger)[0].endswith("The load alone exceeds it, without any feature.")


def test_a_load_above_the_limit_answers_where_no_place_does():
    text, tone, _ = answer(D=search(1.7, None, (0.8, 0.02), alone=1.2), E=search(0.7, 0.02))
    assert tone == "yes" and text.startswith("Yes: the fatigue limit is exceeded by the load alone, without any feature. ")
    assert text.endswith("Around the feature: not decided: the index stays below 1 while the grid resolves the pressure, and "
                         "exceeds 1 later at D.")


def test_a_kind_of_warning_is_one_sentence():
    def row(name, *texts):
        lists = {"warnings": list(texts), "warning_codes": ["cells"] * len(texts), "warning_data": [{}] * len(texts)}
        return name, 1e9, lists

    rows = [row("A", "15 cells"), row("B", "14 cells"), row("C"), row("D", "15 cells"), ("E", 1e9, None)]
    assert place_warnings.of(rows, str) == ["A, D: 15 cells (likewise, with other numbers, at B)"]


def test_several_warnings_of_a_code_are_sentences_of_their_own():
    def row(name, keys, cells):
        found = [CodedWarning(f"{key} is idle", "idle", {"key": key}) for key in keys]
        return name, 1e9, lists(found + [CodedWarning(f"{count} cells", "cells") for count in cells])

    rows = [row("A", ["k", "kappa"], [15, 12]), row("B", ["kappa"], [14, 11])]
    assert place_warnings.of(rows, str) == ["A: k is idle", "A, B: kappa is idle", "A: 15 cells (likewise, with other numbers, "
                                            "at B)", "A: 12 cells (likewise, with other numbers, at B)"]


def test_a_warning_of_all_places_names_none():
    same = {"warnings": ["oil"], "warning_codes": ["oil"], "warning_data": [{}]}
    rows = [(n, 1e9, same) for n in range(4)]
    assert place_warnings.of(rows, str) == ["everywhere: oil"]
    other = [(4, 1e9, {"warnings": ["oil 2"], "warning_codes": ["oil"], "warning_data": [{}]}), (5, 1e9, None)]
    assert place_warnings.of([*rows, *other], str) == ["0, 1, 2, 3: oil (likewise, with other numbers, everywhere else)"]
    assert place_warnings.of(rows[:2], str) == ["0, 1: oil"]


def test_a_note_that_all_places_have_is_said_once():
    from tehl_taichi.report.verdict import _enumeration

    note = " (stresses averaged over 10 µm)"
    assert _enumeration([f"at surface a{note}", f"61 µm below it{note}"]) == f"at surface a and 61 µm below it{note}"
    assert _enumeration([f"at surface a{note}", "at surface b"]) == f"at surface a{note} and at surface b"
    assert _enumeration(["A", "B", "C"]) == "A, B and C" and _enumeration([f"A{note}"]) == f"A{note}"


def test_a_place_that_surely_exceeds_the_limit_is_worse_than_a_larger_index_that_may_not():
    rows = [(name, 1e9, {"fatigue": search(Fi, error)}) for name, Fi, error in (("A", 1.2, 0.05), ("B", 1.3, 0.5))]
    places = place_verdict.judged_places(rows, str, str)
    assert place_verdict.worst(places).Fi == 1.2
