"""Passage of the feature: the centreline at each moment, with a slider, and numbers over the feature's position."""

import numpy as np

from tehl_taichi.report.number_text import sentence_case
from tehl_taichi.report.plots import colour, line, stack
from tehl_taichi.scene.feature_wording import centre_word, position_title
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.digits import part_of
from tehl_taichi.view.figures.line_figures import ALONG, SURFACES, carrier
from tehl_taichi.view.figures.moments import WINDOW, Moments
from tehl_taichi.view.figures.palette import GREY
from tehl_taichi.view.zoom_window import EXTREMES, ZoomWindow

MOMENTS, COLUMNS = 200, 400  # kept, at most: what a screen shows
DASHES = dict(zip((name for name, *_ in SURFACES), ("solid", "dash", "dot")))
FIELDS = (("pressure (GPa)", 1e-9, {"pressure": ""}), ("film (µm)", 1e6, {"film": ""}),
          ("temperature (°C)", 1.0, {name: text for name, text, _ in SURFACES}))


def even_numbers(count, most):
    """At most `most` of the numbers 0 to count - 1, evenly spaced, with the first and the last."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


def moments(store):
    """Entries at which the slider stops: evenly spaced ones, and those of the largest pressure and the smallest film."""
    extremes = [Moments(store).worst, int(np.argmin(store.scalar("h_min_m")))]
    return np.union1d(even_numbers(store.steps, MOMENTS), extremes)


def columns(store):
    """Shown columns of the grid: the contact and its surroundings."""
    X = store.x / Scales.of(store.scene).a
    near = np.flatnonzero((X >= WINDOW[0]) & (X <= WINDOW[1]))
    return near[even_numbers(len(near), COLUMNS)]


def centreline(store):
    """Figure of pressure, film and temperatures along x; with several entries a slider moves through them."""
    shown, where = moments(store), columns(store)
    lines = _lines(store, shown, where)
    X = store.x[where] / Scales.of(store.scene).a
    panels: list[tuple] = []
    for title, _, names in FIELDS:
        if found := {name: text for name, text in names.items() if name in lines}:
            traces = [trace for name, text in found.items() for trace in _traces(X, lines[name], name, text, len(panels) + 1)]
            panels.append((title, traces, {"range": _range(store, lines, found)}))
    return stack("centreline", _caption(store, shown), ALONG, panels, {"range": _ends(X)},
                 _slides(store, shown, lines, panels) if len(shown) > 1 else {})


def _lines(store, shown, where):
    """{field: (moments, columns)} in the row of the lines, in printed units."""
    names = [name for *_, group in FIELDS for name in group if name in store.stored]
    factors = {name: factor for _, factor, group in FIELDS for name in group}
    row, out = Moments(store).line, {name: np.empty((len(shown), len(where)), "f4") for name in names}
    for k, n in enumerate(shown):
        for name, values in store.fields(int(n), names).items():
            out[name][k] = values[where, row] * factors[name]
    return out


def _traces(X, values, name, text, panel):
    """Traces: the steady start in grey, and a line that the slider moves."""
    several = len(values) > 1
    hue, dash = (colour(1 + list(DASHES).index(name)), DASHES[name]) if text else (colour(0), "solid")
    now = line(X, values[0], text or "this moment", hue, panel, dash, in_legend=bool(text) or panel == 1 and several)
    if not several:
        return [now]
    return [line(X, values[0], "steady start", GREY, panel, dash, in_legend=panel == 1 and name == "pressure"), now]


def _range(store, lines, names):
    """Ends of an axis for all moments; for the film those of `tehl plot`."""
    if "film" in names:
        return [0.0, film_top(store) * 1e6]
    low, high = min(lines[name].min() for name in names), max(lines[name].max() for name in names)
    return [float(low - 0.03 * (high - low)), float(high + 0.05 * (high - low))]


def film_top(store):
    """Upper end (m) of the film's axis: as in the figures of `tehl plot`, including the worst moment."""
    found = Moments(store)
    return found.film_top({*found.several(), found.worst})


def _ends(X):
    return [float(X[0]), float(X[-1])]


def _slides(store, shown, lines, panels):
    """Data of the slider: lines of every moment, their traces, positions of the feature, texts."""
    traces, found = [trace for _, group, _ in panels for trace in group], Moments(store)
    at = store.scalar("feature_x")[shown] / found.a
    return {"slides": {"lines": list(lines.values()), "traces": [n for n in range(len(traces)) if n % 2],
                       "at": [None if n == 0 else float(x) for n, x in zip(shown, at)],
                       "first": int(np.searchsorted(shown, found.worst)),
                       "labels": [_label(found, int(n)) for n in shown]}}


def _label(moments, n):
    """Text of a moment."""
    store = moments.store
    p, h = store.scalar("p_max_Pa")[n] / 1e9, store.scalar("h_min_m")[n] * 1e6
    return f"{moments.says(n)}: p_max {p:.3f} GPa, h_min {h:.3f} µm"


def _carries(store):
    """Sentence about the surfaces, if their temperatures are drawn."""
    return "" if store.scene.isothermal or not store.scene.transient else f" {carrier(store.scene).capitalize()}."


def _caption(store, shown):
    along = Moments(store).along
    caption = f"{sentence_case(along)}.{_carries(store)}"
    if len(shown) > 1:
        caption += f" Grey: the steady start; dotted: the {centre_word(store.scene)}."
    left = [part_of(len(shown), store.steps, "stored moment")] * (len(shown) < store.steps)
    return caption + (f" {left[0]} are kept in this page." if left else "")


HISTORIES = (("largest pressure (GPa)", 1e-9, {"p_max_Pa": ""}), ("smallest film (µm)", 1e6, {"h_min_m": ""}),
             ("friction coefficient", 1.0, {"friction_coefficient": ""}),
             ("largest temperature (°C)", 1.0,
              {"film_max_C": "film", "surface_a_max_C": "surface a", "surface_b_max_C": "surface b"}),
             ("load on solid contact", 1.0, {"contact_load_fraction": ""}))


def histories(store):
    """Figure of extremes and friction over the position of the feature; None without a passage."""
    if store.steps < 3:
        return None
    x, windows = store.scalar("feature_x")[1:] / Scales.of(store.scene).a, ZoomWindow.all_of(store)
    panels: list[tuple] = []
    for title, factor, names in HISTORIES:
        found = {name: text for name, text in names.items() if name in store.series and np.ptp(store.scalar(name)[1:]) > 0}
        lines = [line(x, store.scalar(name)[1:] * factor, text, colour(n + bool(text)), len(panels) + 1, in_legend=bool(text))
                 for n, (name, text) in enumerate(found.items())]
        lines += [line(x[window.entries - 1], window.extremes(name) * factor, f"zoom window{window.number}", colour(4 + n),
                       len(panels) + 1, in_legend=not panels)
                  for name in found if name in EXTREMES for n, window in enumerate(windows)]
        if lines:
            panels.append((title, lines, {}))
    caption = f"One value per time step; the contact lies between −1 and 1.{_carries(store)}"
    return stack("histories", caption, position_title(store.scene), panels)


LEFT_OVER = {"residual": "residual", "load_error": "load", "mass_error": "mass"}


def residual_plot(store):
    """Figure of the residual of the discrete equations at every step; None without a passage."""
    if store.steps < 3:
        return None
    x = store.scalar("step")
    traces = [line(x, np.maximum(store.scalar(name), 1e-16), text, colour(n))
              for n, (name, text) in enumerate(LEFT_OVER.items())]
    return stack("left-over", "Residual of the discrete equations, error of the load and of the mass at each step.", "step",
                 [("relative", traces, {"type": "log", "exponentformat": "power"})])
