"""Figure of a crack: paths and trajectories in the section below the feature, and K through the passage."""

import numpy as np

from tehl_taichi.view.figures import palette
from tehl_taichi.view.figures.figure_style import FigureStyle
from tehl_taichi.view.figures.map_panels import bar, shade

COLOURS = {"entry": palette.BLUE, "exit": palette.BLACK}  # both stand out on the tension
SHOWN = 150e6  # Pa: more tension has the same colour
DEEP = 1.3     # of the deepest line, shown
BELOW = dict(loc="upper center", bbox_to_anchor=(0.5, 0.0), borderaxespad=4.0)  # legends: under the axis, in sizes of text
OILS = {"film": "{}film pressure inside (an upper bound)", "flow": "oil flows along it", "sealed": "oil sealed in"}
BAND = 60e-6   # m: length of the pits' band along the surface


def write_crack(result, title, folder, page=None):
    """Write the figure of a :class:`tehl_taichi.crack.analysis.CrackResult` into `folder`, in the format of the
    :class:`FigureStyle`; returns its path. Raises StoreError.
    """
    page = page or FigureStyle()
    return page.write(folder, {"crack": lambda: crack_figure(page, result, title)})[0]


def crack_figure(page, result, title):
    """Figure with the section above, and a panel with K for every side with a crack below."""
    from matplotlib.figure import Figure

    cracked = [name for name, side in result.sides.items() if side.path.last is not None]
    below = [[name] for name in cracked] if page.narrow else [cracked] * bool(cracked)
    heights = (2.0 * page.row(), *[1.4 * page.row(len(row)) for row in below])
    figure = Figure((page.inches, sum(heights)), layout="constrained")
    axes = figure.subplot_mosaic([["section"] * max(map(len, below), default=1), *below], height_ratios=heights)
    _section(page, figure, axes["section"], result)
    without = "".join(f", no crack on the {name} side" for name in result.options.sides if name not in cracked)
    page.title(figure, f"{title}, SRR {result.summary['srr']:+g}, body {result.summary['surface']}"
                       f"{_conditions(result.summary)}{without}")
    for name in cracked:
        _history(axes[name], result, name)
    return figure


def along(summary):
    """Label of the axis of x'."""
    origin = "the feature's centre" if summary.get("carries_feature", True) else "the place below the feature at X = 0"
    return f"x' from {origin} (µm), rolling to the left"


def _conditions(summary):
    parts = [f"face friction {summary['face_friction']:g}"] * (summary["face_friction"] > 0)
    share = "" if summary["oil_share"] in (None, 1) else f"{summary['oil_share']:g} of "
    parts += [OILS.get(summary["oil"], f"oil: {summary['oil']}").format(share)] * (summary["oil"] != "dry")
    return "".join(f", {part}" for part in parts)


def _section(page, figure, ax, result):
    plane = result.plane
    tension = np.maximum(plane.sigma1(), 0.0)
    deepest = max([40e-6, *(float(line.imag.max()) for side in result.sides.values()
                            for line in (side.trajectory, side.path.points))])
    even = np.linspace(0.0, min(DEEP * deepest, plane.depths[-1]), 200)
    image = shade(ax, plane.x * 1e6, even * 1e6, np.array([np.interp(even, plane.depths, row) for row in tension]) / 1e6,
                  cmap=palette.TENSION, vmin=0, vmax=SHOWN / 1e6)
    bar(figure, image, ax, "largest tension (MPa)")
    if result.summary["carries_feature"]:
        ax.plot(np.array([-1, 1]) * plane.reach * 1e6, [-2, -2], color=palette.BLACK, lw=0.3 * page.text, clip_on=False)
    for name, side in result.sides.items():
        _lines(ax, name, side, result.summary["pit_angles_deg"])
    width = 1.3 * max([plane.reach, *(float(np.abs(side.path.points.real).max()) for side in result.sides.values())])
    ax.set(xlabel=along(result.summary), ylabel="below the surface (µm)",
           xlim=(-width * 1e6, width * 1e6), ylim=(even[-1] * 1e6, -3.5))
    if result.sides:
        ax.legend(**BELOW)


def _lines(ax, name, side, pits):
    """Draw trajectory, path, and the band of the pits, which lean with rolling."""
    mouth, colour = side.start.x * 1e6, COLOURS[name]
    low, high = (np.tan(np.radians(angle)) * BAND * 1e6 for angle in pits)
    ax.fill([mouth, mouth - BAND * 1e6, mouth - BAND * 1e6], [0, low, high], color=palette.GREY, alpha=0.25, lw=0,
            label=f"pits, {pits[0]:g} to {pits[1]:g}°" if name == "entry" else None)
    ax.plot(side.trajectory.real * 1e6, side.trajectory.imag * 1e6, "--", color=colour,
            label=f"{name}: normal to the largest tension ({side.start.sigma1 / 1e6:.0f} MPa)")
    if side.path.last:
        points = side.path.points * 1e6
        ax.plot(points.real, points.imag, ".-", color=colour, lw=2,
                label=f"{name}: crack of {side.path.last.faces.a * 1e6:.0f} µm")


def _history(ax, result, name):
    """Draw K of the first and of the last length over the feature's position."""
    plane = result.plane
    path, at = result.sides[name].path, plane.centres[:-1] / plane.a
    cracks = [path.last] if path.first is path.last else [path.first, path.last]
    for crack, width in zip(cracks, (1.0, 2.0)):
        for K, kind, style in zip(crack.K, ("K_I", "K_II"), ("-", ":")):
            ax.plot(at, K[:-1] / 1e6, style, color=COLOURS[name], lw=width, label=f"{kind} at {crack.faces.a * 1e6:.0f} µm")
    ax.set(xlabel="position of the feature, x_a/a", ylabel=f"{name} side: K (MPa √m)")
    ax.grid()
    ax.legend(**BELOW, ncols=2)
