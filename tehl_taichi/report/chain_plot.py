"""Figure of the way to a verdict: load, stress, strength and index, the last three over the depth."""

import math

import numpy as np

from tehl_taichi.report.plots import Figure, axis, colour, line, marks
from tehl_taichi.scene.feature_wording import feature_word
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.strength.strength import Strength
from tehl_taichi.view.figures.index_text import answer_points, at_points, judged_text
from tehl_taichi.view.figures.moments import WINDOW, Moments
from tehl_taichi.view.figures.palette import GREY
from tehl_taichi.view.zoom_window import ZoomWindow

LEFT, RIGHT, TOP, BOTTOM = [0.0, 0.44], [0.56, 1.0], [0.6, 1.0], [0.0, 0.4]
TITLES = ("1 load: pressure (GPa) over x/a", "2 stress (MPa)", "3 strength, and the stress dotted (MPa)",
          "4 verdict: index Fi = stress/limit")
DEPTH = "below the surface (µm)"


def figures(store, search):
    """[the figure], [] without a search below the surface."""
    if search.result.findley_stress_under_row is None or "below" not in search.result.numbers:
        return []
    body = search.result.numbers.get("surface", "a")
    left = store.residual_fields.get(body)
    panels = _load(store, search), _stress(search), _strength(search, left), _verdict(search)
    traces = [trace for n, found in enumerate(panels, 1) for trace in _panel(n, found)]
    resolved = " while the grid resolves it" * bool(search.on)
    caption = (f"From the load to the verdict, body {body}: largest pressure of the passage{resolved}, stress under the "
               f"{feature_word(search.scene)} at each depth, limit and residual stress there, and stress over limit.")
    caption += " The residual stress with that of run-in is that under the critical point." * bool(left)
    caption += " Lines are of stresses at points; the marks of the index are those of the answer." * (not at_points(
        search.result.numbers))
    return [Figure(f"{search.on}chain", caption, traces, _layout(), 640)]


def _panel(n, traces):
    """Traces in the n-th panel, on its axes; names are in the legend once."""
    return [{**trace, "xaxis": f"x{n}" if n > 1 else "x", "yaxis": f"y{n}" if n > 1 else "y"} for trace in traces]


def _layout():
    """Layout of two rows of two panels; depth points down."""
    places = ((LEFT, TOP), (RIGHT, TOP), (LEFT, BOTTOM), (RIGHT, BOTTOM))
    out = {"margin": {"l": 10, "r": 14, "t": 60, "b": 10}, "hovermode": "closest",
           "legend": {"orientation": "h", "x": 0, "y": 1.02, "yanchor": "bottom"}}
    for n, (title, (x, y)) in enumerate(zip(TITLES, places), 1):
        number = str(n) if n > 1 else ""
        deep = {"autorange": "reversed"} if n > 1 else {"rangemode": "tozero"}
        from_zero = {"rangemode": "tozero"} if n in (2, 3) else {}  # a limit that is constant is no edge of its panel
        out[f"xaxis{number}"] = axis(title, domain=x, anchor=f"y{number}", **from_zero)
        out[f"yaxis{number}"] = axis(DEPTH if n > 1 else "", domain=y, anchor=f"x{number}", **deep)
    return out


def _load(store, search):
    """Lines of the pressure along the row of lines at the moment of its largest value among those of the search (of that in a
    zoom window, where there is one), and of the smooth contact.
    """
    a, moments, window = Scales.of(store.scene).a, Moments(store), ZoomWindow.with_most(store)
    row = window.row(store.y[moments.line]) if window else None
    inside = None if row is None else _worst(store, search, window.entries, window.extremes("p_max_Pa"))
    worst = _worst(store, search, np.arange(1, store.steps), store.scalar("p_max_Pa")[1:]) if inside is None else inside
    X = store.x / a
    shown = (X >= WINDOW[0]) & (X <= WINDOW[1])
    p = {n: store.fields(n, ("pressure",))["pressure"][shown, moments.line] / 1e9 for n in (worst, 0)}
    fine = [] if inside is None else [line(
        window.columns(worst) / a, window.fields(worst, ["pressure"])["pressure"][:, row] / 1e9, "zoom window", colour(4))]
    return [line(X[shown], p[worst], f"with the {feature_word(store.scene)}", colour(0)), *fine,
            line(X[shown], p[0], "smooth contact", GREY, dash="dash")]


def _worst(store, search, entries, pressures):
    """The entry with the largest of these pressures among the moments of the search; None if none of the entries is one."""
    fatigue, x = search.scene.fatigue, store.scalar("feature_x")[entries] / Scales.of(store.scene).a
    last = min(fatigue.to_x, search.result.numbers.get("to_x_a", math.inf)) + 1e-9
    counted = (x >= fatigue.from_x) & (x <= last)
    return int(entries[np.argmax(np.where(counted, pressures, -np.inf))]) if counted.any() else None


def _stress(search):
    result, z = search.result, search.result.row_depths * 1e6
    alone = result.findley_stress_contact_alone
    return [line(result.findley_stress_under_row.max(axis=1) / 1e6, z, f"with the {feature_word(search.scene)}", colour(0),
                 in_legend=False),
            *([] if alone is None else [line(alone / 1e6, z, "smooth contact", GREY, dash="dash", in_legend=False)])]


def _strength(search, left=None):
    """Lines of the fatigue limit, the largest stress, and the residual stress if any; left: ResidualField of a run-in."""
    result = search.result
    strength, z = _of_body(search), result.row_depths * 1e6
    limits = np.full(z.size, result.numbers["sigma_eF_Pa"]) if result.limit_under_row is None else result.limit_under_row
    residual = [np.broadcast_to(one, z.shape) for one in strength.residual(result.row_depths)]
    if left:
        deep = result.numbers["below"]
        under = left.at(deep["x_m"], deep["y_m"], result.row_depths)[0, 0]
        residual = [one + under[:, n] for n, one in enumerate(residual)]
    largest_stress = result.findley_stress_under_row.max(axis=1) / 1e6
    return [line(largest_stress, z, "stress beside it", colour(0), dash="dot", in_legend=False),
            line(limits / 1e6, z, "fatigue limit", colour(2)),
            *(line(values / 1e6, z, f"residual stress along {axis_}", colour(3 + n), dash="dot")
              for n, (axis_, values) in enumerate(zip("xy", residual)) if np.any(values))]


def _of_body(search):
    """Strength of the searched body."""
    name = search.result.numbers.get("surface", "a")
    return Strength(search.scene.fatigue, next(one for one in search.scene.surfaces if one.name == name))


def _verdict(search):
    """Lines of the index over depth, the values that the answer uses, and the limit."""
    result, z = search.result, search.result.row_depths * 1e6
    f, alone = result.numbers, result.index("findley_stress_contact_alone")
    top, *deep = answer_points(f)
    return [line(result.index("findley_stress_under_row").max(axis=1), z, f"with the {feature_word(search.scene)}", colour(0),
                 in_legend=False),
            *([] if alone is None else [line(alone, z, "smooth contact", GREY, dash="dash", in_legend=False)]),
            line([1.0, 1.0], [z[0], z[-1]], "Fi = 1", colour(2)),
            marks([top.Fi], [0.0], f"at the surface: {judged_text(top)}", colour(1), symbol="circle"),
            *(marks([one.Fi], [one.depth * 1e6], f"below: {judged_text(one)}", colour(0)) for one in deep)]
