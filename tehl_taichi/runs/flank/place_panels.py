"""Panels over a sequence of contacts, as along a flank: film, pressure, temperature, index, friction and slip."""

import numpy as np

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
LAST = 6  # panels of a figure: λ, friction and slip fill up what steady or isothermal contacts leave free


def panels(found, points):
    """[(label, {legend: (places, values, error bars)})] of the panels with values, in printed units.

    points(found, what): (place, value, its error bar) of a series of PANELS along the sequence; nan breaks the line, None is no
    error bar.
    """
    every = ((label, {name: (x, y * factor, error * factor) for name, what in lines.items() if (some := points(found, what))
                      for x, y, error in [np.array(some, float).T]}) for label, factor, lines in PANELS)
    return [panel for panel in every if panel[1]]


def draw(axes, shown):
    """Draw these panels; the deciding number is a ring around the other number that it usually equals."""
    for ax, (label, lines) in zip(axes, shown):
        for (name, (x, y, error)), colour in zip(lines.items(), palette.LINES):
            style = {"fmt": "o", "mfc": "none"} if name == JUDGED else {"fmt": ".-"}
            ax.errorbar(x, y, error if np.isfinite(error).any() else None, color=colour, label=name, **style, **palette.BARS)
        ax.set_ylabel(label)
        ax.grid()
        ax.legend()
