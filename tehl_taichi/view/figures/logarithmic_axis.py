"""Logarithmic axes of results over a changed value."""

import numpy as np

DECADES = 30.0  # ratio of the ends of an axis that is logarithmic
FEW = 1000.0    # ratio of the ends up to which 2 and 5 have ticks, too: an axis within a decade would have none


def choose_x(ax, x):
    """Make the x axis logarithmic if the values `x` are positive and have a wide range or even ratios (low:high:N:log)."""
    x = np.asarray(x, float)
    if not (x.size and x.min() > 0 and (x.max() > DECADES * x.min() or _evenly_in_logarithm(x))):
        return
    from matplotlib.ticker import LogLocator

    ax.set_xscale("log")
    ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if x.max() < FEW * x.min() else (1.0,)))
    ax.xaxis.set_major_formatter("{x:g}")  # plain numbers: no text is read as mathematics
    ax.xaxis.set_minor_formatter("")


def _evenly_in_logarithm(x):
    """Whether three or more values have equal ratios."""
    steps = np.diff(np.log(np.unique(x)))
    return len(steps) > 1 and np.ptp(steps) < 1e-6 * steps.max()
