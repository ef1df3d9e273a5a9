"""Common figure of several runs: centrelines at one feature position, histories, Fi through the worst points."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.scene.feature_wording import from_centre, position_title, position_word
from tehl_taichi.values.checks import number
from tehl_taichi.view.figures import palette
from tehl_taichi.view.figures.moments import ROOM, WINDOW, Moments

SAME = 1e-9  # relative: half-widths that differ less are one
FILM_ROOM = (-0.05, ROOM)  # of the largest central film


@dataclass(frozen=True)
class Curve:
    """One run in the figure: its moments, label and colour; entry, row: of the lines along x."""

    moments: Moments
    label: str
    colour: str
    entry: int
    row: int

    @property
    def store(self):
        return self.moments.store

    @property
    def a(self):
        return self.moments.a

    def has(self, name):
        return name in self.store.stored

    def along(self, name):
        """A field along x."""
        return self.store.fields(self.entry, [name])[name][:, self.row]

    @property
    def passes(self):
        return len(self.store) > 1


def write(comparison, path, at, page):
    """Write the figure in the format of a :class:`FigureStyle`; returns the path. at: position of the features, a."""
    number("at", at, "a", -1e3, 1e3)
    page, path = page.of_file(path)
    page.check(path)
    moments = [Moments(store) for store in comparison.stores]
    rows, labels, where = _rows(moments, comparison.labels())
    curves = [Curve(one, label, colour, one.nearest(at), row)
              for one, label, colour, row in zip(moments, labels, palette.LINES, rows)]
    return page.save(lambda: _drawn(page, curves, at, where), path)


def _rows(moments, labels):
    """(rows, labels, text of the place): the row with the largest pressure of each run, named in the label if rows differ; y =
    0 for all if one run has only that row.
    """
    if any(one.half for one in moments):
        return [one.row for one in moments], labels, "along y = 0"
    rows, places = [one.line for one in moments], [one.along for one in moments]
    if len(set(places)) == 1:
        return rows, labels, places[0]
    at = [f"along y = {round(float(one.store.y[row]) * 1e6)} µm" for one, row in zip(moments, rows)]
    return rows, [f"{label}, {place}" for label, place in zip(labels, at)], "along the rows of their largest pressures"


def _drawn(page, curves, at, where):
    columns = [column for column in (_lines(curves), _histories(curves)) if column]
    beside = len(columns) > 1 and not page.narrow
    if not beside:
        columns = [sum(columns, [])]
    rows = max(map(len, columns))
    figure, axes = page.figure(rows, len(columns), page.row(len(columns)) * rows * (1.0 if beside else 0.8))
    for panels, column in zip(axes.T, columns):
        for ax, draw in zip(panels, column):
            draw(ax, curves)
            ax.grid()
        for ax in panels[len(column):]:
            ax.set_visible(False)
    _legend(page, figure, curves)
    names = ", ".join(dict.fromkeys(c.store.scene.name for c in curves))
    page.title(figure, f"{names}: {where}, {_moment(curves, at)}{' (left), and while it passes (right)' if beside else ''}")
    return figure


def _moment(curves, at):
    if not any(c.passes for c in curves):
        return "steady"
    off = max(abs(c.moments.moved[c.entry - 1] - at) for c in curves if c.passes)
    where = f"{_said(curves, position_word)} at {at:+.2f} a" + (f" (up to {off:.2f} a away)" if off > 0.05 else "")
    return where + ("" if all(c.passes for c in curves) else ", steady for runs without a passage")


def _said(curves, words):
    """Text of words(scene) of all passages, each once."""
    return " or ".join(dict.fromkeys(words(c.store.scene) for c in curves if c.passes))


def _legend(page, figure, curves):
    from matplotlib.lines import Line2D

    page.legend(figure, [Line2D([], [], color=c.colour, label=c.label) for c in curves])


def _lines(curves):
    """Panels along x."""
    return [_pressure, _film, *([_temperature] if any(c.has("temperature_mid") for c in curves) else [])]


def _histories(curves):
    """Panels of the passages; none without a passage."""
    if not any(c.passes for c in curves):
        return []
    return [_largest_pressure, _least_film, *([_index] if any(c.store.map("Fi") is not None for c in curves) else [])]


def _along(ax, curves, name, factor, **style):
    """Draw a field along x: in units of a, or in mm if the contacts differ in width."""
    widths = [c.a for c in curves]
    one = max(widths) - min(widths) <= SAME * max(widths)
    for c in curves:
        if c.has(name):
            ax.plot(c.store.x / c.a if one else c.store.x * 1e3, c.along(name) * factor, color=c.colour, **style)
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
    ax.set_ylabel("mid-film, a -- (°C)")


def _over_passage(ax, curves, name, factor):
    for c in curves:
        if c.passes:
            ax.plot(c.moments.moved, c.store.scalar(name)[1:] * factor, color=c.colour)
    ax.set_xlabel(_said(curves, position_title))


def _largest_pressure(ax, curves):
    _over_passage(ax, curves, "p_max_Pa", 1e-9)
    ax.set_ylabel("p_max (GPa)")


def _least_film(ax, curves):
    _over_passage(ax, curves, "h_min_m", 1e6)
    ax.set(ylabel="h_min (µm)")
    ax.set_ylim(bottom=0)


def _index(ax, curves):
    """Draw Fi of the surface along x through the worst point of each run, with a mark there."""
    for c in curves:
        Fi = c.store.map("Fi")
        if Fi is None:
            continue
        x = c.store.map("feature_frame_x") * 1e6
        i, j = np.unravel_index(int(np.argmax(Fi)), Fi.shape)
        ax.plot(x, Fi[:, j], color=c.colour)
        ax.plot(x[i], Fi[i, j], "+", color=c.colour, ms=ax.xaxis.label.get_size(), mew=0.2 * ax.xaxis.label.get_size(),
                clip_on=False)  # whole at the rim, too
    ax.set(xlabel=_said(curves, from_centre), ylabel="Fi, critical row")
