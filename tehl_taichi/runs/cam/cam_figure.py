"""Figure of a cam: film, pressure, temperature, fatigue, friction and slip over its angle."""

from tehl_taichi.runs.flank.flank_columns import plotted_value
from tehl_taichi.runs.flank.place_panels import LAST, draw, panels

ANGLE = "angle of the cam (degrees)"


def drawn(page, cam):
    """The matplotlib Figure of a Cam."""
    shown = panels(cam, points)[:LAST]
    figure, axes = page.figure(len(shown), sharex=True)
    draw(axes[:, 0], shown)
    axes[-1, 0].set_xlabel(ANGLE)
    page.title(figure, cam.title)
    return figure


def points(cam, what):
    """[(angle, value, its error bar or None)]; an angle without the value (None) breaks the line; [] if no angle has it."""
    rows = [(at.angle, *plotted_value(at, p_H, summary, what)) for at, p_H, summary in cam.rows]
    return rows if any(value is not None for _, value, _ in rows) else []
