"""Points of figures whose error is unknown: hollow symbols, and the words that explain them."""

import numpy as np

HOLE = 0.5  # of the symbol: its rim can be seen in figures of any width


def draw(ax, x, y, errors):
    """Make symbols "o" with unknown error hollow. x, y, errors: arrays, unknown errors are nan."""
    from matplotlib import rcParams

    unknown = ~np.isfinite(errors)
    ax.plot(x[unknown], y[unknown], "o", color="white", markersize=HOLE * rcParams["lines.markersize"], mew=0, zorder=4)


def words(values, errors):
    """End of a title: what hollow symbols mean, "" where none are drawn."""
    return " (hollow: error unknown)" if (np.isfinite(values) & ~np.isfinite(errors)).any() else ""
