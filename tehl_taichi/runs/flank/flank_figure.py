"""Figure of a flank: film, pressure, temperature and fatigue; dedendum left of the pitch line, addendum right of it."""

from math import nan

from tehl_taichi.runs.flank.flank_columns import plotted_value
from tehl_taichi.runs.flank.place_panels import LAST, draw, panels
from tehl_taichi.view.figures import palette


def drawn(page, flank):
    """The matplotlib Figure of a Flank."""
    shown = panels(flank, points)[:LAST]
    figure, axes = page.figure(len(shown), sharex=True)
    draw(axes[:, 0], shown)
    _marks(axes[:, 0], flank)
    axes[-1, 0].set_xlabel("x_pl, along the line of action from the pitch point (mm)")
    page.title(figure, flank.title)
    return figure


def points(flank, what):
    """[(x_pl in mm, value, its error bar or None)] of the positions with this value; nan between the two sides of a jump
    breaks the line.
    """
    out: list[tuple[float, float, float | None]] = []
    for at, p_H, summary in flank.rows:
        value, error = plotted_value(at, p_H, summary, what)
        x = at.x_pl * 1e3
        if value is not None and out and out[-1][0] == x:
            out.append((x, nan, nan))
        if value is not None:
            out.append((x, value, error))
    return out


def _marks(axes, flank):
    """Draw the visible points A to E, and shade the dedendum."""
    low, high = axes[0].get_xlim()
    points = flank.points or {at.point: at.x_pl for at in flank.positions if at.point}
    shown = {name: x * 1e3 for name, x in points.items() if low <= x * 1e3 <= high}
    for ax in axes:
        if low < 0:
            ax.axvspan(low, min(0.0, high), color=palette.SHADE, zorder=-2)
        for x in shown.values():
            ax.axvline(x, color=palette.GREY, lw=0.8, ls=":", zorder=-1)
        ax.set_xlim(low, high)
    small = dict(fontsize="small", color=palette.GREY, xycoords=("data", "axes fraction"), textcoords="offset points")
    for name, x in shown.items():
        axes[0].annotate(name, (x, 1), xytext=(3, -11), **small)
    if low < 0 < high:
        axes[-1].annotate("dedendum", (0, 0), xytext=(-4, 3), ha="right", **small)
        axes[-1].annotate("addendum", (0, 0), xytext=(4, 3), **small)
