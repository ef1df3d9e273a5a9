"""PNG figures of a store (matplotlib, the `plot` extra)."""

from pathlib import Path

import numpy as np

from tehl_taichi.errors import StoreError
from tehl_taichi.figures import fatigue_figures, palette
from tehl_taichi.figures.fatigue_figures import whole
from tehl_taichi.scene.scales import Scales

POSITIONS = (-0.8, 0.0, 0.8)  # feature positions (in a) shown beside the steady state
WINDOW = (-1.6, 1.4)  # x / a shown: the contact and what is close to it
DPI = 160


def write_all(store, folder, dpi=DPI):
    """Write every figure the store has data for into `folder`, `dpi` dots per inch; returns the paths. Raises StoreError."""
    plt, folder = pyplot(), made(folder)
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
    return [_save(plt, figure, folder / f"{name}.png", dpi) for name, figure in figures.items()]


def beside(path):
    """The folder of the figures of the store at `path` where no other is wanted."""
    return path.with_suffix("") if path.suffix else path.with_name(f"{path.name}-figures")


def made(folder):
    """The folder of that name, made if need be. Raises StoreError."""
    try:
        Path(folder).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StoreError(f"cannot put figures into {folder}: {error.strerror or error}; --out takes a folder") from None
    return Path(folder)


def _history(store, name):
    """History of a worst point as the store keeps it, or None."""
    if store.map(f"{name}_stress") is None:
        return None
    return {part: store.map(f"{name}_{part}") for part in ("x_a", "stress", "normal", "circle")}


def write_fatigue(result, title, a, folder, dpi=DPI):
    """Write the figures of a FatigueResult into `folder`; returns the paths. Raises StoreError."""
    plt, folder = pyplot(), made(folder)
    found = {name: value[0] for name, value in result.maps.items()}
    points = {"surface": result.worst, "below": result.worst_below}
    figures = fatigue_figures.all_figures(plt, title, found, points, result.summary, a)
    return [_save(plt, figure, folder / f"{name}.png", dpi) for name, figure in figures.items()]


def pyplot():
    """matplotlib's pyplot without a screen. Raises StoreError where it is not installed."""
    try:
        import matplotlib
    except ImportError:
        raise StoreError("figures need matplotlib: pip install 'tehl_taichi[plot]'") from None
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    return plt


def _save(plt, figure, path, dpi):
    figure.savefig(path, dpi=dpi)
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
    if n == 0:
        return "steady start" if store.scene.transient else "steady"
    return f"feature at {store.feature_x(n) / a:+.2f} a"


def colours(shown):
    """{entry: colour}, the same in every figure: grey for the steady start, then one for each position of the feature."""
    if len(shown) == 1:
        return {shown[0]: palette.LINES[0]}
    return {n: palette.GREY if n == 0 else palette.LINES[k - 1] for k, n in enumerate(shown)}


def axis_row(store):
    """Row of y = 0."""
    return int(np.argmin(np.abs(store.y)))


def window(store, a):
    """(left, right) in a of what is shown along x."""
    return max(WINDOW[0], store.x[0] / a), min(WINDOW[1], store.x[-1] / a)


def panels(plt, store, a, count):
    """(figure, axes) for `count` maps in their true proportions: below each other, or side by side where they are tall."""
    left, right = window(store, a)
    tall = np.ptp(store.y) * (1 if store.y[0] < 0 else 2) / a / (right - left)
    if tall > 0.9:
        size, grid = (3.9 * count, 2.8 * tall + 1.1), (1, count)
    else:
        size, grid = (6.4, (4.7 * tall + 0.4) * count + 0.9), (count, 1)
    figure, axes = plt.subplots(*grid, figsize=size, layout="compressed", sharex=True, sharey=True)
    for ax in axes[-1:] if grid[1] == 1 else axes:
        ax.set_xlabel("x / a (flow to the right)")
    for ax in axes if grid[1] == 1 else axes[:1]:
        ax.set_ylabel("y / a")
    return figure, axes


def draw_map(ax, store, a, values, title, **style):
    """One field over x, y with its mirror image; returns what a colour bar needs."""
    y, full = whole(store.y / a, values)
    ax.set(aspect="equal", xlim=window(store, a), title=title)
    return ax.pcolormesh(store.x / a, y, full.T, shading="gouraud", **style)


def centreline(plt, store):
    """Pressure and film along y = 0 for several feature positions."""
    a, centre = Scales.of(store.scene).a, axis_row(store)
    figure, (top, low) = plt.subplots(2, 1, sharex=True, figsize=(8, 6.5), constrained_layout=True)
    for n, colour in colours(entries(store)).items():
        f = store.fields(n, ("pressure", "film"))
        style = dict(label=moment(store, n, a), color=colour, ls="--" if colour == palette.GREY else "-", lw=1.5)
        top.plot(store.x / a, f["pressure"][:, centre] / 1e9, **style)
        low.plot(store.x / a, f["film"][:, centre] * 1e6, **style)
    top.set(ylabel="pressure (GPa)", title=f"{store.scene.name}: centreline y = 0")
    low.set(ylabel="film (µm)", xlabel="x / a (flow to the right)", ylim=(0, _film_top(store)), xlim=window(store, a))
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
    """Mid-film and both surfaces along y = 0 for several feature positions: a colour each, a kind of line each."""
    a, centre = Scales.of(store.scene).a, axis_row(store)
    figure, ax = plt.subplots(figsize=(8, 4.8), constrained_layout=True)
    for n, colour in colours(entries(store)).items():
        f = store.fields(n, [name for name, *_ in SURFACES])
        for name, _, style in SURFACES:
            ax.plot(store.x / a, f[name][:, centre], ls=style, color=colour, lw=1.4)
        ax.plot([], [], color=colour, label=moment(store, n, a))
    for _, text, style in SURFACES:
        ax.plot([], [], ls=style, color="k", lw=1.4, label=text)
    ax.set(xlabel="x / a (flow to the right)", ylabel="temperature (°C)", xlim=window(store, a),
           title=f"{store.scene.name}: temperatures along y = 0")
    ax.legend(frameon=False, fontsize=8)
    ax.grid(alpha=0.25)
    return figure


def temperature_maps(plt, store):
    """Mid-film and both surfaces over x, y with the feature nearest to the middle, in one scale of colours."""
    a, n = Scales.of(store.scene).a, middle_entry(store)
    f = store.fields(n, [name for name, *_ in SURFACES])
    low, top = min(float(v.min()) for v in f.values()), max(float(v.max()) for v in f.values())
    figure, axes = panels(plt, store, a, 3)
    for ax, (name, text, _) in zip(axes, SURFACES):
        image = draw_map(ax, store, a, f[name], text, cmap=palette.TEMPERATURE, vmin=low, vmax=top)
    figure.colorbar(image, ax=list(axes), label="temperature (°C)", aspect=30)
    figure.suptitle(f"{store.scene.name}: {moment(store, n, a)}")
    return figure


def profiles(plt, store):
    """Temperature across the film at several x on y = 0, feature nearest to the middle."""
    a, n = Scales.of(store.scene).a, middle_entry(store)
    T = store.fields(n, ["temperature"])["temperature"][:, axis_row(store)]
    zeta = store.map("zeta")
    figure, ax = plt.subplots(figsize=(6.8, 4.8), constrained_layout=True)
    for colour, X in zip(palette.LINES, (-1.0, -0.5, 0.0, 0.5, 1.0)):
        ax.plot(T[int(np.argmin(np.abs(store.x / a - X)))], zeta, "o-", ms=3, lw=1.2, color=colour,
                label=f"x = {X:+.1f} a")
    ax.set(xlabel="temperature (°C)", ylabel="z / h (0: surface a, 1: surface b)",
           title=f"{store.scene.name}: across the film, {moment(store, n, a)}")
    figure.legend(frameon=False, loc="outside right upper")
    ax.grid(alpha=0.25)
    return figure


def maps(plt, store):
    """Pressure and film over x, y with the feature nearest to the middle."""
    a, n = Scales.of(store.scene).a, middle_entry(store)
    f = store.fields(n, ("pressure", "film"))
    figure, (left, right) = panels(plt, store, a, 2)
    pressure = draw_map(left, store, a, f["pressure"] / 1e9, "pressure", cmap=palette.PRESSURE)
    figure.colorbar(pressure, ax=left, label="GPa")
    film = draw_map(right, store, a, f["film"] * 1e6, "film", cmap=palette.FILM, vmax=_film_top(store))
    figure.colorbar(film, ax=right, label="µm", extend="max")
    figure.suptitle(f"{store.scene.name}: {moment(store, n, a)}")
    return figure
