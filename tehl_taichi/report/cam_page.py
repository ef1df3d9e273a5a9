"""Page of a cam, from its folder: thinnest film and largest index over the cycle."""

import numpy as np

from tehl_taichi.report import place_sections, place_verdict, place_warnings, position_pages
from tehl_taichi.report.document import Answer, Page, Section, facts, figure_block, sentences, table
from tehl_taichi.report.number_text import FEW, sentence_case, unit_spelled, value_text
from tehl_taichi.report.plots import colour, line, rings, stack
from tehl_taichi.runs.cam import cam_columns, cam_figure
from tehl_taichi.runs.cam.stored_cam import Cam
from tehl_taichi.runs.flank.flank_columns import error_of, value_at
from tehl_taichi.runs.flank.flank_figure import JUDGED
from tehl_taichi.values.coded_text import without_options


def of(folder, out=None):
    """The :class:`tehl_taichi.report.document.Page` of the cam in `folder`; out: its file, for
    links. Raises StoreError."""
    cam = Cam.open(folder)
    number = place_sections.critical_number(cam.rows, _places(cam))
    store, words = (None, "") if number is None else (cam.store_of(number), _words(cam.rows[number][0]))
    return Page(f"{cam.name}: report", cam.title, _answer(cam, store), (
        Section("Over the cycle", (figure_block(*figures(cam)),)),
        Section("Angles", (*(table([unit_spelled(head) for head in heads], lines, title)
                             for title, (heads, lines) in cam_columns.tables(cam.rows).items()),
                           position_pages.line(cam, out, _words))),
        *place_sections.critical(store, words), *place_sections.scene(store, words),
        Section("Without a result", (sentences([f"{at.words}: {reason}" for at, reason in cam.failed]),)),
        Section("Warnings", (sentences(warnings(cam)),)),
        Section("Provenance", (facts(_provenance(cam)),))))


def _words(at):
    return at.words


def _places(cam):
    return place_verdict.judged_places(cam.rows, _words, _words)


def _answer(cam, store):
    """Answer: the thinnest film, or the largest index if features pass."""
    left = f"{len(cam.failed)} of {len(cam.rows)} angles have no result and are not part of this answer."
    doubts = (*place_sections.limit(store), f"Assumed: {cam.record['assumption']}.", *[left] * bool(cam.failed))
    thin = _thinnest(cam)
    if places := _places(cam):
        headline, tone, sentences = place_verdict.answer(places, len(cam.rows))
        return Answer("At which angle does a fatigue crack start?", headline, tone, (*sentences, thin), doubts)
    headline = thin or "No answer: no angle has a result."
    return Answer("How thick is the film over the cycle?", headline, "none", (), doubts)


def _thinnest(cam):
    """Sentence about the smallest steady film; "" without results."""
    films = [(value_at(summary, "steady", "h_min_m"), error_of(summary, "steady", "h_min_m"), at) for at, _, summary in cam.rows
             if summary]
    if not films:
        return ""
    film, error, at = min(films, key=lambda entry: entry[0])
    return f"The smallest film is {value_text(film, error, 'm', FEW)}, at {at.words}."


def figures(cam):
    """Figures of the panels with values."""
    return [stack(f"cam-{n}", f"{sentence_case(label)}.", cam_figure.ANGLE, [(label, [
        _line(name, x.tolist(), y.tolist(), factor, colour(m)) for m, (name, (x, y, _)) in enumerate(lines.items())], {})],
        height=330) for n, (label, factor, lines) in enumerate(cam_figure.panels(cam))]


def _line(name, x, y, factor, shade):
    y = [None if np.isnan(value) else value * factor for value in y]
    return rings(x, y, name, shade) if name == JUDGED else line(x, y, name, shade, mode="lines+markers")


def warnings(cam):
    """Warnings of all angles, each once with its angles."""
    return place_warnings.of(cam.rows, _words, without_options)


def _provenance(cam):
    ran = [summary for *_, summary in cam.rows if summary]
    return [("folder", cam.folder.name), ("table", cam.record["source"]),
            ("version", ", ".join(sorted({summary["version"] for summary in ran}))),
            ("run time of all angles", f"{sum(summary['wall_s'] for summary in ran):.0f} s")]
