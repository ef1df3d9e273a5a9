"""Figures of a fatigue result: index of the surface and over depth, stress of the worst points, paths on their planes."""

import numpy as np

from tehl_taichi.fatigue.findley import largest_principal, shear_path
from tehl_taichi.fatigue.worst_point import on_circle
from tehl_taichi.figures import palette

MAPS = ("feature_frame_x", "feature_frame_y", "Fi", "fatigue_depth", "findley_stress_at_depth", "findley_stress_under_row",
        "findley_stress_contact_alone")  # what the figures show where it was found
EVEN = 200  # depths drawn of a section


def all_figures(plt, title, maps, points, summary, a):
    """{name: figure}. maps: {name of MAPS: array} found; points: {"surface": history, "below": the same or None}; summary: of a
    FatigueResult; a: m."""
    figures = {"fatigue": index_figure(plt, title, maps, points, summary)}
    if "findley_stress_under_row" in maps:
        figures["fatigue_depth"] = depth_figure(plt, title, maps, summary)
    figures["fatigue_point"] = worst_points(plt, title, points, summary, a)
    return figures


def whole(y, values):
    """y and values (x, y) with the mirror image of a half domain."""
    if y[0] < 0:
        return y, values
    return np.concatenate([-y[:0:-1], y]), np.hstack([values[:, :0:-1], values])


def index_figure(plt, title, maps, points, summary):
    """Index around the feature: of the surface, and of the worst depth where all its points were searched; lines over x where
    there is one row only."""
    layers = [("surface", maps["Fi"], summary)]
    if "findley_stress_at_depth" in maps:
        deep = summary["below"]
        n = int(np.argmin(np.abs(maps["fatigue_depth"] - deep["depth_m"])))
        Fi = maps["findley_stress_at_depth"][n] / summary["sigma_eF_Pa"]
        layers.append((f"{deep['depth_m'] * 1e6:g} µm below", Fi, deep))
    if maps["feature_frame_y"].size == 1:
        figure = index_lines(plt, maps, layers)
    else:
        figure, axes = plt.subplots(1, len(layers), figsize=(6.4 * len(layers), 5.2), constrained_layout=True, squeeze=False)
        for ax, (where, Fi, found), history in zip(axes[0], layers, points.values()):
            index_map(figure, ax, maps, where, Fi, found, history["normal"])
    figure.suptitle(f"{title}: {summary['criterion']}, κ = {summary['kappa_F']:g}, σ_eF = {summary['sigma_eF_Pa'] / 1e6:g} MPa",
                    fontsize="medium")
    return figure


def index_lines(plt, maps, layers):
    """Index over x, a line for each layer with its worst point."""
    figure, ax = plt.subplots(figsize=(7.5, 4.6), constrained_layout=True)
    for where, Fi, found in layers:
        line, = ax.plot(maps["feature_frame_x"] * 1e6, Fi[:, 0], label=where)
        ax.plot(found["x_m"] * 1e6, found["Fi_max"], "+", color=line.get_color(), ms=12, mew=2,
                label=f"worst, Fi = {found['Fi_max']:.3f}, plane {found['surface_angle_deg']:.0f}° to the surface")
    ax.set(xlabel="x from the feature's centre (µm), flow to the right", ylabel="Fi")
    ax.grid(alpha=0.25)
    ax.legend()
    return figure


def index_map(figure, ax, maps, where, Fi, found, normal):
    """Index of one layer; at its worst point the trace of the critical plane in the layer and its dip."""
    x = maps["feature_frame_x"]
    ys, full = whole(maps["feature_frame_y"] * 1e6, Fi)
    image = ax.pcolormesh(x * 1e6, ys, full.T, cmap=palette.INDEX, shading="gouraud")
    figure.colorbar(image, ax=ax, label=f"Fi, {where}")
    at = np.array([found["x_m"], found["y_m"]]) * 1e6
    ax.plot(*at, "+", color=palette.MARK, ms=12, mew=2, label=f"worst point, Fi = {found['Fi_max']:.3f}")
    flat = np.hypot(normal[0], normal[1])
    if flat > 1e-6:
        trace = np.array([-normal[1], normal[0]]) / flat * 0.12 * np.ptp(x) * 1e6
        ax.plot(*np.stack([at - trace, at + trace]).T, "-", color=palette.MARK, lw=2,
                label=f"critical plane, {found['surface_angle_deg']:.0f}° to the surface")
    ax.set(xlabel="x from the feature's centre (µm), flow to the right", ylabel="y (µm)", aspect="equal")
    ax.legend(loc="upper right")


def depth_figure(plt, title, maps, summary):
    """Index in the section under the row of the worst point below the surface, and its largest value over depth."""
    limit, deep = summary["sigma_eF_Pa"], summary["below"]
    x, depth = maps["feature_frame_x"] * 1e6, maps["fatigue_depth"] * 1e6
    Fi = maps["findley_stress_under_row"] / limit
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.8), constrained_layout=True, sharey=True, width_ratios=(3, 2))
    even = np.linspace(0, depth[-1], EVEN)
    section = np.stack([np.interp(even, depth, column) for column in Fi.T], axis=1)
    image = left.pcolormesh(x, even, section, cmap=palette.INDEX, shading="gouraud")
    figure.colorbar(image, ax=left, label=f"Fi at y = {deep['y_m'] * 1e6:.0f} µm")
    left.plot(deep["x_m"] * 1e6, deep["depth_m"] * 1e6, "+", color=palette.MARK, ms=12, mew=2)
    left.set(xlabel="x from the feature's centre (µm), flow to the right", ylabel="below the surface (µm)",
             title=f"{title}: {summary['criterion']}, κ = {summary['kappa_F']:g}, σ_eF = {limit / 1e6:g} MPa")
    line, = right.plot(Fi.max(axis=1), depth, ".-", label="under the feature")
    right.plot(deep["Fi_max"], deep["depth_m"] * 1e6, "+", color=line.get_color(), ms=12, mew=2,
               label=f"worst, Fi = {deep['Fi_max']:.3f} at {deep['depth_m'] * 1e6:.0f} µm")
    if "findley_stress_contact_alone" in maps:
        right.plot(maps["findley_stress_contact_alone"] / limit, depth, "--", color=palette.GREY,
                   label="contact without its feature")
    right.plot(summary["Fi_max"], 0.0, "o", color=palette.VERMILLION, clip_on=False,
               label=f"surface, Fi = {summary['Fi_max']:.3f}")
    right.set(xlabel="largest Fi", title="over depth")
    right.invert_yaxis()
    right.set_ylim(depth[-1], 0)
    right.grid(alpha=0.25)
    right.legend()
    return figure


def worst_points(plt, title, points, summary, a):
    """Of the worst point of the surface and of the one below it: see :func:`worst_point`."""
    shown = [(f"{title}: worst point of the surface", points["surface"])]
    if points.get("below"):
        shown.append((f"{title}: worst point below, {summary['below']['depth_m'] * 1e6:.0f} µm", points["below"]))
    figure, axes = plt.subplots(len(shown), 2, figsize=(10.5, 4.6 * len(shown)), constrained_layout=True, squeeze=False)
    for (left, right), (name, history) in zip(axes, shown):
        worst_point(plt, left, right, name, history, a)
    return figure


def worst_point(plt, left, right, title, worst, a):
    """Largest principal stress over the feature's position, and the shear path on the critical plane with its circle."""
    position, stress = worst["x_a"][:-1] / a, worst["stress"]
    left.plot(position, largest_principal(stress)[:-1] / 1e6, label="σ₁")
    dip, strike, normal = shear_path(stress, worst["normal"])
    u, v, radius = worst["circle"]
    ends = on_circle(dip, strike, worst["circle"])
    left.plot(position, normal[:-1] / 1e6, label="normal to the critical plane")
    left.set(xlabel="feature position x_a / a", ylabel="stress (MPa)", title=title)
    left.axhline(0, color=palette.RULE, lw=0.8, zorder=0)
    left.legend()
    right.plot(dip / 1e6, strike / 1e6, ".-", ms=3, lw=0.8)
    right.add_patch(plt.Circle((u / 1e6, v / 1e6), radius / 1e6, fill=False, color=palette.VERMILLION))
    right.plot(dip[ends] / 1e6, strike[ends] / 1e6, "o", color=palette.VERMILLION, ms=5)
    right.set(xlabel="shear along dip (MPa)", ylabel="shear along strike (MPa)", aspect="equal",
              title=f"critical plane: τ_amp = {radius / 1e6:.0f} MPa, σ_n,max = {normal.max() / 1e6:.0f} MPa")
    right.margins(0.15)
    right.autoscale_view()
