"""Figures of a fatigue result: index of the surface and over depth, stresses of the worst points, paths on their planes."""

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.fatigue.findley import largest_principal, shear_path
from tehl_taichi.fatigue.worst_point import on_circle
from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.values.checks import number
from tehl_taichi.values.coerce import plain
from tehl_taichi.values.digits import micrometres
from tehl_taichi.values.summary_values import error_of
from tehl_taichi.view.figures import distribution_figure, palette
from tehl_taichi.view.figures.index_text import answer_points, at_points, index_text, judged_text, mpa
from tehl_taichi.view.figures.limit_line import crosses_limit, handle, limit_line, line_words
from tehl_taichi.view.figures.map_panels import bar, mirrored, shade
from tehl_taichi.view.figures.search_data import beside_worst

EVEN = 200  # depths drawn of a section
FLOW = ", flow to the right"
LEAST = 8.0  # cm that a map needs to stand beside another


@dataclass(frozen=True)
class DrawnLayer:
    """A layer of a map. where: text; Fi: (x, y); at: its worst point, m; angle: between the critical plane there and the
    surface, deg; normal: of that plane; error: of the largest Fi (None: unknown); when: text of the moments, "" if all count.
    """

    where: str
    Fi: Any
    at: tuple
    angle: float | None = None
    normal: Any = None
    error: float | None = None
    when: str = ""

    @property
    def flat(self):
        """Part of the critical plane's normal in the layer; if zero, the plane has no trace in it."""
        return 0.0 if self.normal is None else float(np.hypot(self.normal[0], self.normal[1]))

    @property
    def traced(self):
        return self.flat > 1e-6

    @property
    def legend_text(self):
        plane = "" if self.angle is None else f", plane at {self.angle:.0f}° to the surface"
        return f"largest, Fi = {index_text(self.Fi.max(), self.error)}{plane}"

    @property
    def title(self):
        """Title with the moments, in lines that fit the panel."""
        return "\n".join([*filter(None, [self.when.replace(" (", "\n(")]), self.legend_text])


NAMES = ("fatigue", "fatigue_distribution", "fatigue_depth", "fatigue_point", "fatigue_depth_whole",
         "fatigue_point_whole", "fatigue_depth_resolved", "fatigue_point_resolved")  # at most


def all_figures(page, found):
    """{name: function that draws it}; plain names show the search that decides the verdict. Raises SceneError if the chosen
    depth was not searched.
    """
    layers = [_layers(one) for one in found.each]
    figures = {"fatigue": lambda: index_figure(page, found, layers)}
    if distribution_figure.has_distribution(found.result):
        figures["fatigue_distribution"] = partial(distribution_figure.distribution_figure, page, found)
    for one, more in zip(found.each, ("", "_whole" if found.early else "_resolved")):
        if one.result.findley_stress_under_row is not None:
            figures[f"fatigue_depth{more}"] = partial(depth_figure, page, one)
        figures[f"fatigue_point{more}"] = partial(worst_points, page, one)
    return figures


def _layers(found):
    """The surface, and the chosen layer below it, or the worst layer whose points were all searched."""
    top = _worst(found, "surface", found.result.Fi, found.summary, found.result.worst)
    below, plane = _searched(found), found.result.index("findley_stress_at_worst_depth")
    if found.depth is None and plane is not None:
        return [top, _layer(found, float(found.result.worst_depth[0]), plane)]
    if below is None or (found.depth is None and found.result.findley_stress_at_depth is None):
        return [top]
    depths, worst = found.result.fatigue_depth, found.summary["below"]["depth_m"]
    n = beside_worst(depths, worst) if found.depth is None else nearest_index(depths, found.depth * 1e-6)
    return [top, _layer(found, depths[n], below[n])]


def _layer(found, depth, Fi):
    """Layer at a depth (m) with its index (x, y): with the worst point if that is in it, else with its own largest value."""
    where, deep = f"{depth * 1e6:.3g} µm below", found.summary["below"]
    if np.isclose(depth, deep["depth_m"]):
        return _worst(found, where, Fi, deep, found.result.worst_below)
    i, j = np.unravel_index(int(np.argmax(Fi)), Fi.shape)
    return DrawnLayer(where, Fi, (found.result.feature_frame_x[i], found.result.feature_frame_y[j]), when=found.when)


def _worst(found, where, Fi, summary, history):
    return DrawnLayer(where, Fi, (summary["x_m"], summary["y_m"]), summary["surface_angle_deg"], history["normal"],
                 error_of(summary, "Fi_max"), found.when)


def _searched(found):
    """Index (depth, x, y) of whole layers, or None. Raises SceneError if the chosen layer does not exist."""
    layers, row = (found.result.index(f"findley_stress_{what}") for what in ("at_depth", "under_row"))
    if layers is None and found.one_row and row is not None:
        layers = row[:, :, None]
    if layers is None and found.depth is not None:
        raise SceneError(f"depth = {found.depth:g} µm: this depth was not searched at all points; use `tehl fatigue STORE "
                         f"--depths {found.depth * 1e-6:g} --figures FOLDER`")
    if found.depth is not None:
        depths = found.result.fatigue_depth * 1e6
        number("depth", plain(found.depth), "µm", float(depths[0]), float(depths[-1]), usual=100.0)
    return layers


def index_figure(page, found, layers):
    """Figure of the index around the feature in every layer, a row for each of `found.each`; lines if nothing varies along
    y.
    """
    shown, most = [layer for row in layers for layer in row], len(layers[0])
    if found.one_row:
        return index_lines(page, found, shown)
    beside = page.width / most >= LEAST
    rows, columns = (len(layers), most) if beside else (len(shown), 1)
    height = 1.3 * page.inches / columns * rows  # more than enough
    figure, axes = page.figure(rows, columns, height, True, sharey=True, sharex=True)
    for ax, layer in zip(axes.ravel(), shown):
        index_map(figure, ax, found.result, layer, beside and most > 1)
    for ax in axes[-1]:
        ax.set_xlabel(found.along + FLOW * (columns == 1))
    for ax in axes[:, 0]:
        ax.set_ylabel("y (µm)")
    lines = line_words(any(layer.traced for layer in shown), any(crosses_limit(layer.Fi) for layer in shown))
    page.title(figure, replace(found, when="").constants + lines)
    return figure


def index_lines(page, found, layers):
    """Figure of the index over x, a line for each layer with its worst point."""
    figure, ((ax,),) = page.figure(height=1.6 * page.row())
    for layer, colour in zip(layers, palette.LINES):
        where = ": ".join(filter(None, (layer.when, layer.where)))
        ax.plot(found.result.feature_frame_x * 1e6, layer.Fi[:, 0], color=colour, label=where)
        ax.plot(layer.at[0] * 1e6, layer.Fi.max(), "+", color=colour, ms=page.text, mew=0.2 * page.text,
                label=layer.legend_text)
    ax.set(xlabel=found.along + FLOW, ylabel="Fi")
    ax.grid()
    page.legend(figure)
    page.title(figure, replace(found, when="").constants)
    return figure


def index_map(figure, ax, result, layer, beside):
    """Draw the index of one layer; at its worst point the trace of the critical plane and its dip."""
    x, (y, Fi) = result.feature_frame_x, mirrored(result.feature_frame_y * 1e6, layer.Fi)
    image = shade(ax, x * 1e6, y, Fi, cmap=palette.INDEX)
    bar(figure, image, ax, f"Fi, {layer.where}", beside)
    at = np.array(layer.at) * 1e6
    limit_line(ax, x * 1e6, y, Fi)
    _mark(ax, *at)
    if layer.traced:
        trace = np.array([-layer.normal[1], layer.normal[0]]) / layer.flat * 0.12 * np.ptp(x) * 1e6
        ax.plot(*np.stack([at - trace, at + trace]).T, "-", color=palette.MARK)
    ax.set(aspect="equal", title=layer.title, xlim=(x[0] * 1e6, x[-1] * 1e6), ylim=(y[0], y[-1]))


def _mark(ax, x, y):
    import matplotlib

    text = matplotlib.rcParams["font.size"]
    ax.plot(x, y, "+", color=palette.MARK, ms=text, mew=0.2 * text, clip_on=False)  # whole at the rim, too


def depth_figure(page, found):
    """Figure of the index in the section below the row of the worst subsurface point, and of its largest value over depth."""
    depth, Fi = found.result.row_depths * 1e6, found.result.index("findley_stress_under_row")
    sizes = dict(height_ratios=(1, 1)) if page.narrow else dict(width_ratios=(3, 2))
    panels, height = ((2, 1), 3.2 * page.row()) if page.narrow else ((1, 2), 2.3 * page.row(2))
    figure, axes = page.figure(*panels, height=height, **sizes)
    section, over = axes.ravel()
    _section(page, figure, section, found, Fi, depth)
    _over_depth(over, found, Fi, depth)
    for ax in (section, over):  # each with its own numbers
        ax.set(ylabel="below the surface (µm)", ylim=(depth[-1], 0))
    page.legend(figure, over.get_legend_handles_labels()[0] + ([handle()] if crosses_limit(Fi) else []))
    page.title(figure, found.constants)
    return figure


def _section(page, figure, ax, found, Fi, depth):
    """Draw the index (depth, x) at even depths, with its worst point."""
    x, deep, even = found.result.feature_frame_x * 1e6, found.summary["below"], np.linspace(0, depth[-1], EVEN)
    shown = np.stack([np.interp(even, depth, column) for column in Fi.T])
    bar(figure, shade(ax, x, even, shown, cmap=palette.INDEX), ax, f"Fi at y = {deep['y_m'] * 1e6:.0f} µm", not page.narrow)
    limit_line(ax, x, even, shown)
    _mark(ax, deep["x_m"] * 1e6, deep["depth_m"] * 1e6)
    ax.set_xlabel(found.along + FLOW * page.narrow)


def _over_depth(ax, found, Fi, depth):
    (top, *deep), alone = answer_points(found.summary), found.result.index("findley_stress_contact_alone")
    pointwise, judged = ("", "largest") if at_points(found.summary) else (", stresses at points", "judged")
    line, = ax.plot(Fi.max(axis=1), depth, ".-", label=f"under the {found.whose}{pointwise}")
    for one in deep:
        ax.plot(one.Fi, one.depth * 1e6, "+", color=line.get_color(), ms=2.5 * line.get_markersize(),
                mew=line.get_linewidth(), label=f"{judged}, Fi = {judged_text(one)} at {micrometres(one.depth)} µm")
    if alone is not None:
        ax.plot(alone, depth, "--", color=palette.GREY, label="smooth contact")
    ax.plot(top.Fi, 0.0, "o", color=palette.VERMILLION, clip_on=False, label=f"surface, Fi = {judged_text(top)}")
    ax.set_xlabel("largest Fi")
    ax.grid()


def worst_points(page, found):
    """Figure of the critical points at and below the surface: see :func:`worst_point`."""
    shown = [("critical point at the surface", found.result.worst)]
    if found.result.worst_below:
        shown.append((f"critical point below, {micrometres(found.summary['below']['depth_m'])} µm", found.result.worst_below))
    columns = 1 if page.narrow else 2
    height = 1.6 * page.row(columns) * len(shown) * (2 / columns)
    figure, axes = page.figure(len(shown) * 2 // columns, columns, height)
    for (left, right), (name, history) in zip(axes.reshape(-1, 2), shown):
        worst_point(left, right, name, history, found)
    page.legend(figure)
    page.title(figure, found.constants)
    return figure


def worst_point(left, right, title, worst, found):
    """Draw the largest principal stress over the feature's position, and the shear path on the critical plane with its
    circle, of a point of a :class:`DrawnSearch`.
    """
    from matplotlib.patches import Circle

    position, stress = worst["x_a"][:-1] / found.a, worst["stress"]
    dip, strike, normal = shear_path(stress, worst["normal"])
    u, v, radius = worst["circle"]
    ends = on_circle(dip, strike, worst["circle"])
    left.axhline(0, color=palette.RULE, lw=0.8, zorder=0)
    left.plot(position, largest_principal(stress)[:-1] / 1e6, label="largest principal stress σ₁")
    left.plot(position, normal[:-1] / 1e6, label="stress normal to the critical plane")
    left.set(xlabel=found.positions, ylabel="stress (MPa)", title=title)
    right.plot(dip / 1e6, strike / 1e6, ".-", ms=0.2 * left.xaxis.label.get_size(), lw=0.8)
    right.add_patch(Circle((u / 1e6, v / 1e6), radius / 1e6, fill=False, color=palette.VERMILLION))
    right.plot(dip[ends] / 1e6, strike[ends] / 1e6, "o", color=palette.VERMILLION)
    right.set(xlabel="critical plane: shear along dip (MPa)", ylabel="along strike (MPa)", aspect="equal",
              title=f"τ_amp = {mpa(radius)}, σ_n,max = {mpa(normal.max())} MPa")
    right.margins(0.15)
    right.autoscale_view()
