"""Index around the feature and below it, and stresses of the worst points."""

import numpy as np

from tehl_taichi.fatigue.findley import largest_principal, shear_path
from tehl_taichi.fatigue.worst_point import on_circle
from tehl_taichi.report.number_text import value_text
from tehl_taichi.report.numbered_points import number_trace
from tehl_taichi.report.plots import colour, field_map, level, line, marks, stack
from tehl_taichi.scene.feature_wording import feature_word, position_title
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures import distribution_figure
from tehl_taichi.view.figures.index_text import answer_points, at_points, critical_word, index_text, judged_text, largest
from tehl_taichi.view.figures.limit_line import crosses_limit, line_words
from tehl_taichi.view.figures.map_panels import mirrored
from tehl_taichi.view.figures.palette import GREY, INDEX, MARK
from tehl_taichi.view.figures.search_data import beside_worst

EVEN = 100  # depths drawn of a section
POINTS = {"surface": ("worst", "critical point at the surface"), "below": ("worst_below", "critical point below the surface")}


def index(search):
    """Figures of Fi at the surface and at the worst depth, with the worst points; lines over x if there is only one row."""
    f, Fi = search.result.numbers, search.result.Fi
    if Fi is None:
        return []
    if Fi.shape[1] == 1:
        return [_over_x(search, f, Fi)]
    found = [_map(search, "surface", "at the surface", Fi, f)]
    deep, plane = (search.result.index(f"findley_stress_at_{what}") for what in ("depth", "worst_depth"))
    if plane is not None:
        found.append(_layer(search, float(search.result.worst_depth[0]), plane, f["below"]))
    elif deep is not None and "below" in f:
        found.append(_listed(search, deep, f["below"]))
    return found


def _listed(search, Fi, worst):
    """Figure of the listed depth next to the worst; Fi (depth, x, y)."""
    depths = search.result.fatigue_depth
    n = beside_worst(depths, worst["depth_m"])
    return _layer(search, depths[n], Fi[n], worst)


def _layer(search, depth, Fi, worst):
    """Figure of one depth (m) with Fi (x, y): with the worst subsurface point if it is there, else with its own largest value;
    the caption names the worst depth, which is sought between the fully searched depths, below some rows.
    """
    if np.isclose(depth, worst["depth_m"]):
        return _map(search, "below", _depth(depth), Fi, worst)
    elsewhere = (f". The critical depth is {worst['depth_m'] * 1e6:.3g} µm, under the row y = {worst['y_m'] * 1e6:.0f} µm, "
                 f"with Fi = {largest(worst)}")
    return _map(search, "below", _depth(depth), Fi, None, elsewhere)


def _depth(depth):
    return f"{depth * 1e6:.3g} µm below the surface"


def _map(search, which, where, Fi, found, more=""):
    """Map of one layer with the line of the fatigue limit, and its worst point with the trace of the critical plane (found: its
    summary; None: the largest value is no worst point); more: end of the caption.
    """
    x, (y, full) = search.result.feature_frame_x * 1e6, mirrored(search.result.feature_frame_y * 1e6, Fi)
    trace = _trace(search, which, found, 0.12 * np.ptp(x)) if found else []
    marked = [*_limit(x, y, full), _marked(search, Fi, found), *trace, *number_trace(search)]
    caption = f"Index Fi {where}, {search.when}{line_words(bool(trace), crosses_limit(full))}{more}."
    return field_map(f"{search.on}index-{which}", caption, x, y, full, INDEX, "Fi", search.along, "y (µm)", marked, height=440)


def _marked(search, Fi, found):
    """Mark of the worst point, or of the largest value of a layer without it."""
    if found:
        return marks([found["x_m"] * 1e6], [found["y_m"] * 1e6],
                     f"{critical_word(search.result.numbers)}, Fi = {largest(found)}", MARK)
    i, j = np.unravel_index(int(np.argmax(Fi)), Fi.shape)
    x, y = search.result.feature_frame_x * 1e6, search.result.feature_frame_y * 1e6
    return marks([x[i]], [y[j]], f"largest at this depth, Fi = {index_text(Fi[i, j])}", MARK)


def _trace(search, which, found, length):
    """[line] where the critical plane of the worst point cuts the layer, `length` µm to both sides; [] if it does not cut
    it.
    """
    history = getattr(search.result, POINTS[which][0])
    if not history or (flat := np.hypot(*history["normal"][:2])) <= 1e-6:
        return []
    normal = history["normal"]
    at, along = np.array([found["x_m"], found["y_m"]]) * 1e6, np.array([-normal[1], normal[0]]) / flat * length
    ends = np.stack([at - along, at + along])
    return [line(ends[:, 0], ends[:, 1], f"critical plane, {found['surface_angle_deg']:.0f}° to the surface", MARK)]


def _briefly(search):
    """Moments of a search, for the end of a caption if the page has two searches."""
    return f", {search.short}" if search.short else ""


def _limit(x, y, Fi):
    """Line Fi = 1 if the map crosses it; values above are clipped, which keeps pages small."""
    if not crosses_limit(Fi):
        return []
    i, j = (_around(np.any(Fi > 1, axis=axis)) for axis in (1, 0))
    return level(x[i], y[j], Fi[i, j], 1.0)


def _around(found):
    """Slice of the True entries and one more at each end."""
    at = np.flatnonzero(found)
    return slice(max(at[0] - 1, 0), at[-1] + 2)


def _over_x(search, f, Fi):
    x = search.result.feature_frame_x * 1e6
    worst = marks([f["x_m"] * 1e6], [f["Fi_max"]], f"largest, plane {f['surface_angle_deg']:.0f}° to the surface", colour(1))
    return stack(f"{search.on}index", f"Index Fi of the surface, {search.when}.", search.along,
                 [("Fi", [line(x, Fi[:, 0], "at the surface", colour(0)), worst], {})], height=440)


def distribution(search):
    """Figure of the share of rough surfaces above an index."""
    if not distribution_figure.has_distribution(search.result):
        return []
    traces = [line(Fi, 100 * share, label, colour(n))
              for n, (label, Fi, share) in enumerate(distribution_figure.curves(search.result))]
    return [stack(f"{search.on}distribution", "Share of the surface above an index.", "index Fi",
                  [("share above (%)", traces, {"type": "log"})], height=360)]


def depth(search):
    """[section below the feature, largest index over depth]; [] without a search below the surface."""
    f, Fi = search.result.numbers, search.result.index("findley_stress_under_row")
    if Fi is None or "below" not in f:
        return []
    deep = f["below"]
    x, z = search.result.feature_frame_x * 1e6, search.result.row_depths * 1e6
    even = np.linspace(0, z[-1], EVEN)
    section = np.stack([np.interp(even, z, column) for column in Fi.T])
    worst = marks([deep["x_m"] * 1e6], [deep["depth_m"] * 1e6], f"{critical_word(f)}, Fi = {largest(deep)}", MARK)
    caption = (f"Index Fi in the section y = {deep['y_m'] * 1e6:.0f} µm under the {feature_word(search.scene)}"
               f"{_briefly(search)}{line_words(False, crosses_limit(section))}.")
    figure = field_map(f"{search.on}section", caption, x, even, section, INDEX, "Fi", search.along,
                       "below the surface (µm)", [*_limit(x, even, section), worst], true=False, height=440)
    figure.layout["yaxis"]["autorange"] = "reversed"
    return [figure, _over_depth(search, f, z, Fi)]


def _over_depth(search, f, z, Fi):
    top, *deep = answer_points(f)
    pointwise = "" if at_points(f) else ", stresses at points"
    traces = [line(Fi.max(axis=1), z, f"under the {feature_word(search.scene)}{pointwise}", colour(0)),
              *(marks([one.Fi], [one.depth * 1e6], f"below: {judged_text(one)}", colour(0)) for one in deep),
              marks([top.Fi], [0.0], f"surface: {judged_text(top)}", colour(1), symbol="circle")]
    alone = search.result.index("findley_stress_contact_alone")
    if alone is not None:
        traces.append(line(alone, z, "smooth contact", GREY, dash="dash"))
    return stack(f"{search.on}over-depth", f"Largest index Fi at each depth{_briefly(search)}.", "largest Fi",
                 [("below the surface (µm)", traces, {"autorange": "reversed"})], height=440)


def worst_points(search):
    """[(stresses over the passage, shear path on the critical plane)] of the worst points at and below the surface."""
    out = []
    for which, (name, text) in POINTS.items():
        if history := getattr(search.result, name):
            out.append((_stresses(search, which, text, history), _path(search, which, text, history)))
    return out


def _stresses(search, which, text, history):
    x, stress = history["x_a"][:-1] / Scales.of(search.scene).a, history["stress"]
    normal = shear_path(stress, history["normal"])[2]
    traces = [line(x, largest_principal(stress)[:-1] / 1e6, "largest principal stress σ₁", colour(0)),
              line(x, normal[:-1] / 1e6, "normal to the critical plane", colour(1))]
    caption = f"Stresses of the {text} while the {feature_word(search.scene)} passes{_briefly(search)}."
    return stack(f"{search.on}stress-{which}", caption, position_title(search.scene), [("MPa", traces, {})], height=400)


def _path(search, which, text, history):
    dip, strike, normal = shear_path(history["stress"], history["normal"])
    u, v, radius = history["circle"] / 1e6
    ends, angle = on_circle(dip, strike, history["circle"]), np.linspace(0, 2 * np.pi, 90)
    traces = [line(dip / 1e6, strike / 1e6, "path", colour(0)),
              line(u + radius * np.cos(angle), v + radius * np.sin(angle), "smallest circle", colour(1)),
              marks(dip[ends] / 1e6, strike[ends] / 1e6, "points on the circle", colour(1), symbol="circle")]
    caption = (f"Shear path of the {text} on its critical plane{_briefly(search)}: amplitude "
               f"{value_text(radius * 1e6, unit='Pa')}, largest normal stress {value_text(normal.max(), unit='Pa')}.")
    return stack(f"{search.on}path-{which}", caption, "shear along dip (MPa)",
                 [("shear along strike (MPa)", traces, {"scaleanchor": "x", "constrain": "domain"})], {"constrain": "domain"},
                 height=400)
