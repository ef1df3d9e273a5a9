"""One figure of several runs: their centrelines at one feature position, their histories, Fi through their worst points."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.figures.run_figures import WINDOW, axis_row, pyplot
from tehl_taichi.scene.scales import Scales

SAME = 1e-9  # relative: half-widths that differ less are one
WIDE = 2.5  # times the largest central film: upper end of the film's axis
FILM_ROOM = (-0.05, WIDE)


@dataclass(frozen=True)
class Curve:
    """One run: its store, label and colour; a m; entry: the one that the centrelines show."""

    store: object
    label: str
    colour: str
    a: float
    entry: int

    def has(self, name):
        return name in self.store.stored

    def centreline(self, name):
        """A field along y = 0."""
        return self.store.fields(self.entry, [name])[name][:, axis_row(self.store)]

    @property
    def passes(self):
        return len(self.store) > 1

    @property
    def moved(self):
        """Centre of the feature over a, at every entry after the steady start."""
        return self.store.scalar("feature_x")[1:] / self.a


def write(comparison, path, at, dpi):
    """Write the figure; returns the path. at: position of the features, a."""
    plt = pyplot()
    curves = [Curve(store, label, f"C{n}", Scales.of(store.scene).a, _entry(store, at))
              for n, (store, label) in enumerate(zip(comparison.stores, comparison.labels()))]
    columns = [column for column in (_lines(curves), _histories(curves)) if column]
    rows = max(map(len, columns))
    figure, axes = plt.subplots(rows, len(columns), figsize=(6.6 * len(columns), 2.7 * rows + 0.6), squeeze=False,
                                constrained_layout=True)
    for panels, column in zip(axes.T, columns):
        for ax, draw in zip(panels, column):
            draw(ax, curves)
            ax.grid(alpha=0.25)
        for ax in panels[len(column):]:
            ax.set_visible(False)
    _legend(figure, curves)
    beside = " (left), and while it passes (right)" if len(columns) > 1 else ""
    figure.suptitle(f"along y = 0, {_moment(curves, at)}{beside}", fontsize="medium")
    figure.savefig(path, dpi=dpi)
    plt.close(figure)
    return path


def _entry(store, at):
    """Entry with the feature nearest to `at`; the steady state of a run without passage."""
    return 1 + int(np.argmin(np.abs(store.scalar("feature_x")[1:] / Scales.of(store.scene).a - at))) if len(store) > 1 else 0


def _moment(curves, at):
    if not any(c.passes for c in curves):
        return "steady"
    off = max(abs(c.moved[c.entry - 1] - at) for c in curves if c.passes)
    told = f"feature at {at:+.2f} a" + (f" (up to {off:.2f} a off)" if off > 0.05 else "")
    return told + ("" if all(c.passes for c in curves) else ", steady where none passes")


def _legend(figure, curves):
    from matplotlib.lines import Line2D

    figure.legend(handles=[Line2D([], [], color=c.colour, label=c.label) for c in curves], frameon=False,
                  loc="outside lower center", ncols=min(len(curves), 3))


def _lines(curves):
    """Panels along x."""
    return [_pressure, _film, *([_temperature] if any(c.has("temperature_mid") for c in curves) else [])]


def _histories(curves):
    """Panels of the passages; none where nothing passes."""
    if not any(c.passes for c in curves):
        return []
    return [_largest_pressure, _least_film, *([_index] if any(c.store.map("Fi") is not None for c in curves) else [])]


def _along(ax, curves, name, factor, **style):
    """A field along x: over a, or in mm where the contacts differ in width."""
    widths = [c.a for c in curves]
    one = max(widths) - min(widths) <= SAME * max(widths)
    for c in curves:
        if c.has(name):
            ax.plot(c.store.x / c.a if one else c.store.x * 1e3, c.centreline(name) * factor, color=c.colour, lw=1.3, **style)
    left, right = (edge if one else edge * max(widths) * 1e3 for edge in WINDOW)
    ax.set(xlabel="x / a (flow to the right)" if one else "x (mm), flow to the right", xlim=(left, right))


def _pressure(ax, curves):
    _along(ax, curves, "pressure", 1e-9)
    ax.set_ylabel("pressure (GPa)")


def _film(ax, curves):
    _along(ax, curves, "film", 1e6)
    top = max(float(c.store.scalar("h_c_m")[0]) for c in curves) * 1e6
    ax.set(ylabel="film (µm)", ylim=(FILM_ROOM[0] * top, FILM_ROOM[1] * top))


def _temperature(ax, curves):
    _along(ax, curves, "temperature_mid", 1)
    _along(ax, curves, "temperature_a", 1, ls="--")
    ax.set_ylabel("mid-film, surface a -- (°C)")


def _over_passage(ax, curves, name, factor):
    for c in curves:
        if c.passes:
            ax.plot(c.moved, c.store.scalar(name)[1:] * factor, color=c.colour, lw=1.3)
    ax.set_xlabel("feature position x_a / a")


def _largest_pressure(ax, curves):
    _over_passage(ax, curves, "p_max_Pa", 1e-9)
    ax.set_ylabel("largest pressure (GPa)")


def _least_film(ax, curves):
    _over_passage(ax, curves, "h_min_m", 1e6)
    ax.set(ylabel="least film (µm)")
    ax.set_ylim(bottom=0)


def _index(ax, curves):
    """Fi of the surface along x through the worst point of each run, which is marked."""
    for c in curves:
        Fi = c.store.map("Fi")
        if Fi is None:
            continue
        x = c.store.map("feature_frame_x") * 1e6
        i, j = np.unravel_index(int(np.argmax(Fi)), Fi.shape)
        ax.plot(x, Fi[:, j], color=c.colour, lw=1.3)
        ax.plot(x[i], Fi[i, j], "+", color=c.colour, ms=11, mew=2)
    ax.set(xlabel="x from the feature's centre (µm)", ylabel="Fi, through the worst point")
