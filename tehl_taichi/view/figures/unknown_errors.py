"""Points of figures whose error is unknown: hollow symbols, and the words that explain them."""

import numpy as np


def draw(ax, x, y, errors):
    """Draw points with unknown error as hollow symbols. x, y, errors: arrays, unknown errors are nan."""
    unknown = ~np.isfinite(errors)
    ax.plot(x[unknown], y[unknown], ".", color="white", markersize=3, zorder=4)


def words(values, errors):
    """End of a title: what hollow symbols mean, "" where none are drawn."""
    return " (hollow: error unknown)" if (np.isfinite(values) & ~np.isfinite(errors)).any() else ""
