"""Figure of a cam: film, pressure, temperature, fatigue, friction and slip over its angle."""

import numpy as np

from tehl_taichi.runs.flank.flank_columns import plotted_value
from tehl_taichi.runs.flank.flank_figure import LAST, PANELS, style
from tehl_taichi.view.figures import palette

ANGLE = "angle of the cam (degrees)"


def panels(cam):
    """[(label, factor, {legend: series})] of the panels with values."""
    found = [(label, factor, {name: one for name, what in lines.items() if len((one := series(cam, what))[0])})
             for label, factor, lines in PANELS]
    return [panel for panel in found if panel[2]][:LAST]


def drawn(page, cam):
    """The matplotlib Figure of a Cam."""
    shown = panels(cam)
    figure, axes = page.figure(len(shown), sharex=True)
    for ax, (label, factor, lines) in zip(axes[:, 0], shown):
        for (name, (x, y, error)), colour in zip(lines.items(), palette.LINES):
            bars = error * factor if np.isfinite(error).any() else None
            ax.errorbar(x, y * factor, bars, color=colour, label=name, **style(name), **palette.BARS)
        ax.set_ylabel(label)
        ax.grid()
        ax.legend()
    axes[-1, 0].set_xlabel(ANGLE)
    page.title(figure, cam.title)
    return figure


def series(cam, what):
    """(angles, values, error bars) of a number; an angle without it breaks the line (nan)."""
    rows = [(at.angle, *plotted_value(at, p_H, summary, what)) for at, p_H, summary in cam.rows]
    if all(value is None for _, value, _ in rows):
        return np.array([]), np.array([]), np.array([])
    return tuple(np.array([np.nan if one is None else one for one in column], float) for column in zip(*rows))
