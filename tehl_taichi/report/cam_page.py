"""Page of a cam, from its folder: thinnest film and largest index over the cycle."""

from tehl_taichi.report import place_plots, place_sections, place_verdict, position_pages
from tehl_taichi.report.document import Answer, Page, Section, facts, figure_block, sentences, table
from tehl_taichi.report.number_text import unit_spelled
from tehl_taichi.runs import place_warnings
from tehl_taichi.runs.cam import cam_columns, cam_figure
from tehl_taichi.runs.cam.stored_cam import Cam
from tehl_taichi.runs.flank.place_panels import LAST, panels
from tehl_taichi.values.coded_text import without_options


def of(folder, out=None):
    """The :class:`tehl_taichi.report.document.Page` of the cam in `folder`; out: its file, for
    links. Raises StoreError."""
    cam = Cam.open(folder)
    store, words = _critical(cam)
    return Page(f"{cam.name}: report", cam.title, answer(cam), (
        Section("Over the cycle", (figure_block(*figures(cam)),)),
        Section("Angles", (*(table([unit_spelled(head) for head in heads], lines, title)
                             for title, (heads, lines) in cam_columns.tables(cam.rows).items()),
                           sentences(place_sections.passages(cam.rows, _words)),
                           position_pages.line(cam, out, _words))),
        *place_sections.critical(store, words), *place_sections.scene(store, words),
        Section("Without a result", (sentences([f"{at.words}: {reason}" for at, reason in cam.failed]),)),
        Section("Warnings", (sentences(warnings(cam)),)),
        Section("Provenance", (facts(place_sections.provenance(
            cam.folder, [summary for *_, summary in cam.rows], "all angles", ("table", cam.record["source"]))),))))


def _words(at):
    return at.words


def _places(cam):
    return place_verdict.judged_places(cam.rows, _words, _words)


def _critical(cam):
    """(store of the critical angle or None, text of the angle)."""
    return place_sections.critical_place(cam, _places(cam), _words)


def limits(cam):
    """Sentences about the meaning of Fi = 1; () without an index."""
    return place_sections.limit(*_critical(cam))


def answer(cam):
    """The :class:`tehl_taichi.report.document.Answer` of a cam: the thinnest film, or the largest index if features pass."""
    doubts = (*limits(cam), f"Assumed: {cam.record['assumption']}.", *place_sections.missing(cam, "angle"),
              *place_sections.counted(warnings(cam)))
    thin = _thinnest(cam)
    if places := _places(cam):
        headline, tone, sentences = place_verdict.answer(places, len(cam.rows))
        return Answer("At which angle does a fatigue crack start?", headline, tone, (*sentences, thin), doubts)
    headline = thin or "No answer: no angle has a result."
    alone = place_verdict.of_smooth_contacts(cam.rows, _words, _words)
    return Answer("How thick is the film over the cycle?", headline, "none", alone, doubts)


def _thinnest(cam):
    """Sentence about the smallest steady film; "" without results."""
    found = place_verdict.thinnest(cam.rows)
    return f"The smallest film is {found[0]}, at {found[1].words}." if found else ""


def figures(cam):
    """Figures of the panels with values."""
    return [place_plots.figure(f"cam-{n}", cam_figure.ANGLE, panel)
            for n, panel in enumerate(panels(cam, cam_figure.points)[:LAST])]


def warnings(cam, spelled=without_options):
    """Warnings of all angles, each kind once with its angles; spelled: function for their texts (default: for a page)."""
    return place_warnings.of(cam.rows, _words, spelled)
