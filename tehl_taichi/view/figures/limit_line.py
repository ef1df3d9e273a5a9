"""Line Fi = 1 on a map of the index, and explanations of the lines on such a map."""

from tehl_taichi.view.figures import palette

SAID = "Fi = 1"
TRACE = "trace of the critical plane (at 0° it lies in the surface)"


def crosses_limit(Fi):
    """Whether a map of the index crosses the fatigue limit."""
    return bool(Fi.min() < 1 < Fi.max())


def limit_line(ax, x, y, Fi):
    """Draw Fi (x, y) = 1 if the map crosses it: white with a black rim, visible on every colour."""
    if crosses_limit(Fi):
        ax.contour(x, y, Fi.T, [1.0], colors=[palette.LIMIT], linewidths=[_width()], path_effects=_rim())


def _width():
    import matplotlib

    return 0.8 * matplotlib.rcParams["lines.linewidth"]


def _rim():
    from matplotlib.patheffects import Normal, Stroke

    return [Stroke(linewidth=2.6 * _width(), foreground=palette.RIM), Normal()]


def handle():
    """Line for the legend."""
    from matplotlib.lines import Line2D

    return Line2D([], [], color=palette.LIMIT, lw=_width(), path_effects=_rim(), label=SAID)


def line_words(traced, limited):
    """Text about the lines on maps; traced, limited: whether there are such lines."""
    parts = ([f"blue line: {TRACE}"] if traced else []) + ([f"white line: {SAID}"] if limited else [])
    return f"; {', '.join(parts)}" if parts else ""
