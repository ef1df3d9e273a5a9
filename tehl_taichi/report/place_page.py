"""Parts that the pages of all sequences of contacts have: along a flank, over the cycle of a cam."""

from operator import attrgetter

from tehl_taichi.report import place_sections, place_verdict, position_pages
from tehl_taichi.report.document import Page, Section, facts, figure_block, sentences, table
from tehl_taichi.report.number_text import unit_spelled
from tehl_taichi.runs import place_warnings
from tehl_taichi.values.coded_text import without_options

SHORT, FULL = attrgetter("short"), attrgetter("full")  # texts of a position


def page(found, subtitle, answer, along, positions, more=(), origin=(), out=None):
    """The :class:`tehl_taichi.report.document.Page` of a flank or a cam.

    along: title and figures; positions: title and tables of the positions; more: further sections; origin: further rows of its
    provenance; out: file of the page, for links.
    """
    (title, figures), (of_tables, tables) = along, positions
    store, words = critical(found)
    return Page(f"{found.name}: report", subtitle, answer, (
        Section(title, (figure_block(*figures),)),
        Section(of_tables, (*(table([unit_spelled(head) for head in heads], lines, name)
                              for name, (heads, lines) in tables.items()),
                            sentences(place_sections.passages(found.rows, SHORT)), position_pages.line(found, out, SHORT))),
        *place_sections.critical(store, words), *place_sections.scene(store, words),
        Section("Without a result", (sentences([f"{at.full}: {reason}" for at, reason in found.failed]),)), *more,
        Section("Warnings", (sentences(warnings(found)),)),
        Section("Provenance", (facts(place_sections.provenance(
            found.folder, [summary for *_, summary in found.rows], f"all {of_tables.lower()}", *origin)),))))


def judged_places(found):
    """The :class:`tehl_taichi.report.place_verdict.JudgedPlace` of every position with an index."""
    return place_verdict.judged_places(found.rows, SHORT, FULL)


def critical(found):
    """(store of the critical position or None, text of the position)."""
    return place_sections.critical_place(found, judged_places(found), FULL)


def limits(found):
    """Sentences about the meaning of Fi = 1; () without an index."""
    return place_sections.limit(*critical(found))


def doubts(found, noun, more=()):
    """Sentences of an answer about its meaning, its assumption, what is missing and its warnings; noun: of a position."""
    return (*limits(found), *more, *place_sections.missing(found, noun), f"Assumed: {found.record['assumption']}.",
            *place_sections.counted(warnings(found)))


def smooth_contacts(found):
    """Sentence about the index of steady contacts: see :func:`tehl_taichi.report.place_verdict.of_smooth_contacts`."""
    return place_verdict.of_smooth_contacts(found.rows, SHORT, FULL)


def warnings(found, spelled=without_options):
    """Warnings of all positions, each kind once with its positions; spelled: function for their texts (default: for a page)."""
    return place_warnings.of(found.rows, SHORT, spelled)
