"""PNG figures of a store (matplotlib, the `plot` extra)."""

from pathlib import Path

import numpy as np

from tehl_taichi.errors import StoreError
from tehl_taichi.io import fatigue_figures
from tehl_taichi.io.fatigue_figures import whole
from tehl_taichi.scene.scales import Scales

POSITIONS = (-0.8, 0.0, 0.8)  # feature positions (in a) shown beside the steady state


def write_all(store, folder):
    """Write every figure the store has data for into `folder`; returns the paths. Raises StoreError."""
    plt = pyplot()
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    figures = {"centreline": centreline(plt, store)}
    if store.y.size > 1:
        figures["maps"] = maps(plt, store)
    if not store.scene.isothermal:
        figures["temperature"] = temperature(plt, store)
        if store.y.size > 1:
            figures["temperature_maps"] = temperature_maps(plt, store)
    if "temperature" in store.stored:
        figures["profiles"] = profiles(plt, store)
    if store.map("worst_stress") is not None:
        found = {name: values for name in fatigue_figures.MAPS if (values := store.map(name)) is not None}
        points = {"surface": _history(store, "worst"), "below": _history(store, "worst_below")}
        figures |= fatigue_figures.all_figures(plt, store.scene.name, found, points, store.summary["fatigue"],
                                               Scales.of(store.scene).a)
    return [_save(plt, figure, folder / f"{name}.png") for name, figure in figures.items()]


def _history(store, name):
    """History of a worst point as the store keeps it, or None."""
    if store.map(f"{name}_stress") is None:
        return None
    return {part: store.map(f"{name}_{part}") for part in ("x_a", "stress", "normal", "circle")}


def write_fatigue(result, title, a, folder):
    """Write the figures of a FatigueResult into `folder`; returns the paths. Raises StoreError."""
    plt, folder = pyplot(), Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    found = {name: value[0] for name, value in result.maps.items()}
    points = {"surface": result.worst, "below": result.worst_below}
    figures = fatigue_figures.all_figures(plt, title, found, points, result.summary, a)
    return [_save(plt, figure, folder / f"{name}.png") for name, figure in figures.items()]


def pyplot():
    """matplotlib's pyplot without a screen. Raises StoreError where it is not installed."""
    try:
        import matplotlib
    except ImportError:
        raise StoreError("figures need matplotlib: pip install 'tehl_taichi[plot]'") from None
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    return plt


def _save(plt, figure, path):
    figure.savefig(path, dpi=110)
    plt.close(figure)
    return path


def entries(store):
    """Entries nearest to the steady state and to the feature positions shown."""
    if store.steps < 2:
        return [0]
    a = Scales.of(store.scene).a
    at = store.scalar("feature_x")[: store.steps] / a
    near = [int(np.nanargmin(np.abs(at - position))) for position in POSITIONS if np.nanmax(at) >= position - 0.05]
    return sorted({0, *near})


def moment(store, n, a):
    """What entry n shows, in words."""
    return "steady start" if n == 0 else f"feature at {store.feature_x(n) / a:+.2f} a"


def axis_row(store):
    """Row of y = 0."""
    return int(np.argmin(np.abs(store.y)))


def draw_map(figure, ax, store, a, values, label, **style):
    """One field over x, y with its mirror image and a colour bar."""
    y, full = whole(store.y / a, values)
    image = ax.pcolormesh(store.x / a, y, full.T, shading="gouraud", **style)
    figure.colorbar(image, ax=ax, label=label)
    ax.set(ylabel="y / a", aspect="equal", xlim=(-1.6, 1.4))


def centreline(plt, store):
    """Pressure and film along y = 0 for several feature positions."""
    a, centre = Scales.of(store.scene).a, axis_row(store)
    figure, (top, low) = plt.subplots(2, 1, sharex=True, figsize=(8, 6.5), constrained_layout=True)
    for n in entries(store):
        f = store.fields(n, ("pressure", "film"))
        style = dict(label=moment(store, n, a), color="0.45" if n == 0 else None, ls="--" if n == 0 else "-", lw=1.5)
        top.plot(store.x / a, f["pressure"][:, centre] / 1e9, **style)
        low.plot(store.x / a, f["film"][:, centre] * 1e6, **style)
    top.set(ylabel="pressure (GPa)", title=f"{store.scene.name}: centreline y = 0")
    low.set(ylabel="film (µm)", xlabel="x / a (flow to the right)", ylim=(0, _film_top(store)), xlim=(-1.6, 1.4))
    top.legend(frameon=False)
    for axes in (top, low):
        axes.grid(alpha=0.25)
    return figure


def _film_top(store):
    """Upper end (um) of the film's axis: well above the film in the contact, below the gap outside."""
    return 2.5e6 * store.scalar("h_c_m")[0]


def middle_entry(store):
    """Entry with the feature nearest to X = 0 (the only one of a steady run)."""
    at = store.scalar("feature_x")[: store.steps]
    return int(np.nanargmin(np.abs(at))) if np.isfinite(at).any() else 0


SURFACES = (("temperature_mid", "mid-film", "-"), ("temperature_a", "surface a", "--"), ("temperature_b", "surface b", ":"))


def temperature(plt, store):
    """Mid-film and both surfaces along y = 0 for several feature positions."""
    a, centre = Scales.of(store.scene).a, axis_row(store)
    figure, ax = plt.subplots(figsize=(8, 4.8), constrained_layout=True)
    for colour, n in enumerate(entries(store)):
        f = store.fields(n, [name for name, *_ in SURFACES])
        for name, text, style in SURFACES:
            ax.plot(store.x / a, f[name][:, centre], ls=style, color=f"C{colour}", lw=1.4,
                    label=f"{moment(store, n, a)}: {text}" if colour == 0 or style == "-" else None)
    ax.set(xlabel="x / a (flow to the right)", ylabel="temperature (°C)", xlim=(-1.6, 1.4),
           title=f"{store.scene.name}: temperatures along y = 0")
    ax.legend(frameon=False, fontsize=8)
    ax.grid(alpha=0.25)
    return figure


def temperature_maps(plt, store):
    """Mid-film and both surfaces over x, y with the feature nearest to the middle."""
    a, n = Scales.of(store.scene).a, middle_entry(store)
    f = store.fields(n, [name for name, *_ in SURFACES])
    top = max(float(v.max()) for v in f.values())
    figure, axes = plt.subplots(3, 1, figsize=(6.0, 9.5), constrained_layout=True, sharex=True)
    for ax, (name, text, _) in zip(axes, SURFACES):
        draw_map(figure, ax, store, a, f[name], "°C", cmap="inferno", vmax=top)
        ax.set_title(text)
    axes[-1].set_xlabel("x / a (flow to the right)")
    return figure


def profiles(plt, store):
    """Temperature across the film at several x on y = 0, feature nearest to the middle."""
    a, n = Scales.of(store.scene).a, middle_entry(store)
    T = store.fields(n, ["temperature"])["temperature"][:, axis_row(store)]
    zeta = store.map("zeta")
    figure, ax = plt.subplots(figsize=(6, 4.8), constrained_layout=True)
    for X in (-1.0, -0.5, 0.0, 0.5, 1.0):
        ax.plot(T[int(np.argmin(np.abs(store.x / a - X)))], zeta, "o-", ms=3, lw=1.2, label=f"x = {X:+.1f} a")
    ax.set(xlabel="temperature (°C)", ylabel="z / h (0: surface a, 1: surface b)", title=f"{store.scene.name}: across the film")
    ax.legend(frameon=False)
    ax.grid(alpha=0.25)
    return figure


def maps(plt, store):
    """Pressure and film over x, y with the feature nearest to the middle."""
    a, n = Scales.of(store.scene).a, middle_entry(store)
    f = store.fields(n, ("pressure", "film"))
    figure, axes = plt.subplots(2, 1, figsize=(6.5, 8), constrained_layout=True, sharex=True)
    draw_map(figure, axes[0], store, a, f["pressure"] / 1e9, "pressure (GPa)", cmap="inferno")
    draw_map(figure, axes[1], store, a, f["film"] * 1e6, "film (µm)", cmap="viridis", vmax=_film_top(store))
    axes[0].set_title(f"{store.scene.name}: {moment(store, n, a)}")
    axes[1].set_xlabel("x / a (flow to the right)")
    return figure
