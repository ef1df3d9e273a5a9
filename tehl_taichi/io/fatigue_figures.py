"""Figures of a fatigue result: index map, largest principal stress of the worst point, path on its critical plane."""

import numpy as np

from tehl_taichi.post.fatigue import on_circle
from tehl_taichi.post.findley import largest_principal, shear_path


def all_figures(plt, title, maps, worst, summary, a):
    """{name: figure}. maps, worst, summary: of a FatigueResult (maps as plain arrays); a: m."""
    figures = {"fatigue": index_map(plt, title, maps, worst["normal"], summary)}
    figures["fatigue_point"] = worst_point(plt, title, worst, summary, a)
    return figures


def whole(y, values):
    """y and values (x, y) with the mirror image of a half domain."""
    if y[0] < 0:
        return y, values
    return np.concatenate([-y[:0:-1], y]), np.hstack([values[:, :0:-1], values])


def index_map(plt, title, maps, normal, summary):
    """Index around the feature; at the worst point the trace of the critical plane in the surface and its dip."""
    x, y, Fi = (maps[name] for name in ("feature_frame_x", "feature_frame_y", "Fi"))
    figure, ax = plt.subplots(figsize=(6.4, 5.2), constrained_layout=True)
    ys, full = whole(y * 1e6, Fi)
    image = ax.pcolormesh(x * 1e6, ys, full.T, cmap="magma", shading="gouraud")
    figure.colorbar(image, ax=ax, label="Fi at the surface")
    at = np.array([summary["x_m"], summary["y_m"]]) * 1e6
    deep = f" {summary['depth_m'] * 1e6:g} µm deep" if summary.get("depth_m") else ""
    ax.plot(*at, "c+", ms=12, mew=2, label=f"worst point{deep}, Fi = {summary['Fi_max']:.3f}")
    flat = np.hypot(normal[0], normal[1])
    if flat > 1e-6:
        trace = np.array([-normal[1], normal[0]]) / flat * 0.12 * np.ptp(x) * 1e6
        ax.plot(*np.stack([at - trace, at + trace]).T, "c-", lw=2,
                label=f"critical plane, {summary['surface_angle_deg']:.0f}° to the surface")
    ax.set(xlabel="x from the feature's centre (µm), flow to the right", ylabel="y (µm)", aspect="equal",
           title=f"{title}: {summary['criterion']}, κ = {summary['kappa_F']:g}, σ_eF = {summary['sigma_eF_Pa'] / 1e6:g} MPa")
    ax.legend(loc="upper right")
    return figure


def worst_point(plt, title, worst, summary, a):
    """Largest principal stress over the feature's position, and the shear path on the critical plane with its circle."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.6), constrained_layout=True)
    position, stress = worst["x_a"][:-1] / a, worst["stress"]
    left.plot(position, largest_principal(stress)[:-1] / 1e6, label="σ₁")
    dip, strike, normal = shear_path(stress, worst["normal"])
    u, v, radius = worst["circle"]
    ends = on_circle(dip, strike, worst["circle"])
    left.plot(position, normal[:-1] / 1e6, label="normal to the critical plane")
    left.set(xlabel="feature position x_a / a", ylabel="stress (MPa)", title=f"{title}: worst point")
    left.axhline(0, color="0.8", lw=0.8, zorder=0)
    left.legend()
    right.plot(dip / 1e6, strike / 1e6, ".-", ms=3, lw=0.8)
    right.add_patch(plt.Circle((u / 1e6, v / 1e6), radius / 1e6, fill=False, color="tab:red"))
    right.plot(dip[ends] / 1e6, strike[ends] / 1e6, "o", color="tab:red", ms=5)
    right.set(xlabel="shear along dip (MPa)", ylabel="shear along strike (MPa)", aspect="equal",
              title=f"critical plane: τ_amp = {radius / 1e6:.0f} MPa, σ_n,max = {normal.max() / 1e6:.0f} MPa")
    right.margins(0.15)
    right.autoscale_view()
    return figure
