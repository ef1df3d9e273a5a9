"""Zoom windows of a run at their largest pressure: lines along the row through the feature on both grids, and maps."""

import numpy as np

from tehl_taichi.report.document import Section, figure_block
from tehl_taichi.report.number_text import sentence_case
from tehl_taichi.report.passage_plots import FIELDS, film_top
from tehl_taichi.report.plots import colour, field_map, line, stack
from tehl_taichi.view.figures.line_figures import ALONG
from tehl_taichi.view.figures.map_panels import mirrored
from tehl_taichi.view.figures.moments import Moments
from tehl_taichi.view.figures.palette import GREY
from tehl_taichi.view.figures.zoom_maps import ROOM, SHOWN
from tehl_taichi.view.zoom_window import ZoomWindow


def section(store):
    """(:class:`Section`,), or () without a window."""
    windows = [window for window in ZoomWindow.all_of(store) if window.entries.size]
    if not windows:
        return ()
    rows = [row for window in windows for row in _rows(store, window)]
    return (Section(f"Zoom window{'s' * bool(windows[1:])}", tuple(figure_block(*row) for row in rows if row)),)


def _rows(store, window):
    """Rows of figures of one window."""
    lines = _lines(store, window)
    return [(lines,) if lines else (), _maps(store, window)]


def _lines(store, window):
    """Figure of pressure, film and temperature along the row of the lines; None if the window does not contain it."""
    moments, n = Moments(store), window.worst
    if (row := window.row(store.y[moments.line])) is None:
        return None
    fine, (low, high) = window.fields(n, SHOWN), (window.columns(n)[0], window.columns(n)[-1])
    near = (store.x >= low) & (store.x <= high)
    panels: list[tuple] = []
    for title, factor, names in FIELDS:
        if (name := next(iter(names))) in fine:
            both = ((store.x[near], store.fields(n, (name,))[name][near, moments.line], "grid of the run", GREY),
                    (window.columns(n), fine[name][:, row], f"window, cells {store.scene.zoom.factor} times finer", colour(0)))
            panels.append((title, [line(x / moments.a, values * factor, text, hue, len(panels) + 1, in_legend=not panels)
                                   for x, values, text, hue in both], _ends(store, name)))
    along = sentence_case(moments.along)
    text = f"{along}, {moments.says(n)}: the largest pressure of the window{window.number}."
    return stack(f"{_name(window)}-lines", text, ALONG, panels)


def _name(window):
    """Beginning of the names of its figures."""
    return window.first.removesuffix("_")


def _ends(store, name):
    """Keys of an axis: the film's range excludes the gap behind the contact."""
    return {"range": [0.0, film_top(store) * 1e6]} if name == "film" else {}


def _maps(store, window):
    """Maps of pressure and film; () if nothing varies along y."""
    if window.y.size == 1:
        return ()
    moments, n = Moments(store), window.worst
    x, found = window.columns(n) / moments.a, window.fields(n, ("pressure", "film"))
    return tuple(_map(moments, x, window, name, values) for name, values in found.items())


def _map(moments, x, window, name, values):
    title, factor, unit, colours = SHOWN[name]
    y, full = mirrored(window.y / moments.a, values * factor)
    top = ROOM * float(np.median(full)) if name == "film" else float(full.max())
    over = f", thicker than {top:.3g} µm in the last colour" * bool(full.max() > top)
    text = f"{title.capitalize()} in the window{window.number}{over}."
    return field_map(f"{_name(window)}-{name}", text, x, y, full, colours, unit, ALONG, "y / a",
                     zmin=float(full.min()), zmax=top)
