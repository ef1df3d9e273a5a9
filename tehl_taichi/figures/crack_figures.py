"""Figure of a crack: paths and trajectories in the section below the feature, and K through the passage."""

import numpy as np

from tehl_taichi.figures.run_figures import DPI, made, pyplot

COLOURS = {"entry": "C0", "exit": "C3"}
SHOWN = 150e6  # Pa: more tension has the same colour
DEEP = 1.3     # of the deepest line, shown
BAND = 60e-6   # m: length of the pits' band along the surface


def write_crack(result, title, folder, dpi=DPI):
    """Write crack.png of a :class:`tehl_taichi.crack.answer.CrackResult` into `folder`; returns its path. Raises StoreError."""
    plt, path = pyplot(), made(folder) / "crack.png"
    figure = crack_figure(plt, result, title)
    figure.savefig(path, dpi=dpi)
    plt.close(figure)
    return path


def crack_figure(plt, result, title):
    """The section above, a panel with K of every side below."""
    figure, axes = plt.subplot_mosaic([["section", "section"], ["entry", "exit"]], figsize=(10, 8.6), layout="constrained",
                                      height_ratios=(5, 4))
    _section(figure, axes["section"], result)
    axes["section"].set_title(f"{title}, SRR {result.summary['srr']:+g}{_conditions(result.summary)}", fontsize="medium")
    for name in COLOURS:
        _history(axes[name], result, name)
    return figure


def _conditions(summary):
    parts = [f"face friction {summary['face_friction']:g}"] * (summary["face_friction"] > 0)
    parts += [f"{summary['oil']:g} of the film's pressure inside (an upper bound)"] * (summary["oil"] > 0)
    return "".join(f", {part}" for part in parts)


def _section(figure, ax, result):
    plane = result.plane
    tension = np.clip(plane.sigma1(), 0.0, SHOWN)
    deepest = max([40e-6, *(float(line.imag.max()) for side in result.sides.values()
                            for line in (side.trajectory, side.path.points))])
    even = np.linspace(0.0, min(DEEP * deepest, plane.depths[-1]), 200)
    image = ax.pcolormesh(plane.x * 1e6, even * 1e6, np.array([np.interp(even, plane.depths, row) for row in tension]).T / 1e6,
                          cmap="Oranges", shading="gouraud", vmin=0, vmax=SHOWN / 1e6)
    figure.colorbar(image, ax=ax, extend="max", label="largest tension of the passage (MPa)")
    ax.plot(np.array([-1, 1]) * plane.reach * 1e6, [-2, -2], "k", lw=4, clip_on=False)
    for name, side in result.sides.items():
        _lines(ax, name, side, result.summary["pit_angles_deg"])
    width = 1.3 * max([plane.reach, *(float(np.abs(side.path.points.real).max()) for side in result.sides.values())])
    ax.set(xlabel="x' from the feature's centre (µm); the contact rolls to the left over it", ylabel="below the surface (µm)",
           xlim=(-width * 1e6, width * 1e6), ylim=(even[-1] * 1e6, -3.5))
    if result.sides:
        ax.legend(loc="lower right", fontsize=8)


def _lines(ax, name, side, pits):
    """Trajectory, path, and the band of the pits, which lean with rolling."""
    mouth, colour = side.begun.x * 1e6, COLOURS[name]
    low, high = (np.tan(np.radians(angle)) * BAND * 1e6 for angle in pits)
    ax.fill([mouth, mouth - BAND * 1e6, mouth - BAND * 1e6], [0, low, high], color="0.5", alpha=0.18, lw=0,
            label=f"pits, {pits[0]:g} to {pits[1]:g}°" if name == "entry" else None)
    ax.plot(side.trajectory.real * 1e6, side.trajectory.imag * 1e6, "--", color=colour, lw=1.3,
            label=f"{name}: normal to the largest tension ({side.begun.sigma1 / 1e6:.0f} MPa)")
    if side.path.last:
        points = side.path.points * 1e6
        ax.plot(points.real, points.imag, ".-", color=colour, lw=2, ms=4,
                label=f"{name}: crack of {side.path.last.faces.a * 1e6:.0f} µm")


def _history(ax, result, name):
    """K of the first and of the last length over the feature's position."""
    plane = result.plane
    ax.set_title(f"{name} side", fontsize="medium")
    if name not in result.sides or result.sides[name].path.last is None:
        ax.text(0.5, 0.5, "no crack", ha="center", transform=ax.transAxes)
        ax.set_axis_off()
        return
    path, at = result.sides[name].path, plane.centres[:-1] / plane.a
    cracks = [path.last] if path.first is path.last else [path.first, path.last]
    for crack, width in zip(cracks, (1.0, 2.0)):
        for K, kind, style in zip(crack.K, ("K_I", "K_{II}"), ("-", ":")):
            ax.plot(at, K[:-1] / 1e6, style, color=COLOURS[name], lw=width, label=f"${kind}$ at {crack.faces.a * 1e6:.0f} µm")
    ax.set(xlabel="position of the feature, $x_a/a$", ylabel="MPa √m")
    ax.grid(alpha=0.25)
    ax.legend(fontsize=8)
