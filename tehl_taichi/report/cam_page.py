"""Page of a cam, from its folder: thinnest film and largest index over the cycle."""

from tehl_taichi.report import place_page, place_plots, place_verdict
from tehl_taichi.report.document import Answer
from tehl_taichi.runs.cam import cam_columns, cam_figure
from tehl_taichi.runs.cam.stored_cam import Cam
from tehl_taichi.runs.flank.place_panels import LAST, panels


def of(folder, out=None):
    """The :class:`tehl_taichi.report.document.Page` of the cam in `folder`; out: its file, for
    links. Raises StoreError."""
    cam = Cam.open(folder)
    return place_page.page(cam, cam.title, answer(cam), ("Over the cycle", figures(cam)),
                           ("Angles", cam_columns.tables(cam.rows)), origin=[("table", cam.record["source"])], out=out)


def answer(cam):
    """The :class:`tehl_taichi.report.document.Answer` of a cam: the thinnest film, or the largest index if features pass."""
    doubts = place_page.doubts(cam, "angle")
    thin = _thinnest(cam)
    if places := place_page.judged_places(cam):
        headline, tone, sentences = place_verdict.answer(places, len(cam.rows))
        return Answer("At which angle does a fatigue crack start?", headline, tone, (*sentences, thin), doubts)
    headline = thin or "No answer: no angle has a result."
    return Answer("How thick is the film over the cycle?", headline, "none", place_page.smooth_contacts(cam), doubts)


def _thinnest(cam):
    """Sentence about the smallest steady film; "" without results."""
    found = place_verdict.thinnest(cam.rows)
    return f"The smallest film is {found[0]}, at {found[1].words}." if found else ""


def figures(cam):
    """Figures of the panels with values."""
    return [place_plots.figure(f"cam-{n}", cam_figure.ANGLE, panel)
            for n, panel in enumerate(panels(cam, cam_figure.points)[:LAST])]
