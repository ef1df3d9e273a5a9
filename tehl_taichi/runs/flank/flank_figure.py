"""Figure of a flank: film, pressure, temperature and fatigue; dedendum left of the pitch line, addendum right of it."""

import numpy as np

from tehl_taichi.runs.flank.flank_columns import plotted_value
from tehl_taichi.view.figures import palette

JUDGED = "judged"
# panel: label, factor, {legend: keys in the summary}; "p_H", "judged" ...: see flank_columns.plotted_value
PANELS = (("film (µm)", 1e6, {"steady, centre": ("steady", "h_c_m"), "steady, smallest": ("steady", "h_min_m"),
                              "smallest, feature passes": ("transient", "h_min_m")}),
          ("largest pressure (GPa)", 1e-9, {"Hertz": "p_H", "steady": ("steady", "p_max_Pa"),
                                            "feature passes": ("transient", "p_max_Pa")}),
          ("temperature (°C)", 1, {"film, steady": ("steady", "film_max_C"),
                                   "film, feature passes": ("transient", "film_max_C"),
                                   "surface a, feature passes": ("transient", "surface_a_max_C")}),
          ("Fi", 1, {"99th percentile at the surface": ("fatigue", "statistics", "p99"),
                     "median at the surface": ("fatigue", "statistics", "median"),
                     "99th percentile below it": ("fatigue", "below", "statistics", "p99"),
                     "largest at the surface": ("fatigue", "Fi_max"), "largest below it": ("fatigue", "below", "Fi_max"),
                     JUDGED: "judged"}),
          ("surface with Fi > 1 (%)", 100, {"of the worse body": ("fatigue", "statistics", "share_above_1")}),
          ("λ", 1, {"h_c/Sq": ("lambda",), "λ_GF (formula)": "lambda_GF", "h_min/Ra": "h_min_Ra"}),
          ("friction coefficient", 1, {"steady": ("steady", "friction_coefficient"),
                                       "mean, feature passes": ("transient", "friction_coefficient_mean")}),
          ("SRR", 1, {"(u_a − u_b)/u_m": "srr"}))
LAST = 6  # panels: λ, friction and slip fill up what a steady or isothermal flank leaves free


def drawn(page, flank):
    """The matplotlib Figure of a Flank."""
    shown = [panel for panel in PANELS if any(_series(flank, what) for what in panel[2].values())][:LAST]
    figure, axes = page.figure(len(shown), sharex=True)
    for ax, (label, factor, lines) in zip(axes[:, 0], shown):
        _panel(ax, flank, label, factor, lines)
    _marks(axes[:, 0], flank)
    axes[-1, 0].set_xlabel("x_pl, along the line of action from the pitch point (mm)")
    page.title(figure, flank.title)
    return figure


def _panel(ax, flank, label, factor, lines):
    found = {name: series for name, what in lines.items() if (series := _series(flank, what))}
    for (name, series), colour in zip(found.items(), palette.LINES):
        x, y, error = np.array(series, float).T
        error = error * factor if np.isfinite(error).any() else None
        ax.errorbar(x * 1e3, y * factor, error, color=colour, label=name, **style(name), **palette.BARS)
    ax.set_ylabel(label)
    ax.grid()
    ax.legend()


def style(name):
    """Line style of a series: the deciding number is a ring around the other number that it usually equals."""
    return {"fmt": "o", "mfc": "none"} if name == JUDGED else {"fmt": ".-"}


def _series(flank, what):
    """[(x_pl, value, its error bar or None)] of the positions with this value; nan between the two sides of a jump breaks the
    line.
    """
    out: list[tuple[float, float, float | None]] = []
    for at, p_H, summary in flank.rows:
        value, error = plotted_value(at, p_H, summary, what)
        if value is None:
            continue
        if out and out[-1][0] == at.x_pl:
            out.append((at.x_pl, np.nan, np.nan))
        out.append((at.x_pl, value, error))
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
