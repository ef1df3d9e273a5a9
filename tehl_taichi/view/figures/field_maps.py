"""Maps over x, y of one moment, in their true proportions, with colour bars that say where they are cut."""

import numpy as np

from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures import palette
from tehl_taichi.view.figures.line_figures import ALONG, SURFACES, carrier

LEAST, LEAST_TALL = 5.0, 3.4  # cm that a map needs to stand beside another
TALL = 0.9                    # height over width, beyond it the second
THIN = 20                     # length over thickness of a colour bar, for each map


def mirrored(y, values):
    """y and values (x, y) with the mirror image of a half domain."""
    if y[0] < 0:
        return y, values
    return np.concatenate([-y[:0:-1], y]), np.hstack([values[:, :0:-1], values])


def panels(page, moments, count):
    """(figure, axes, side by side?) for `count` maps: below each other, or side by side where they are tall."""
    left, right = moments.window
    tall = np.ptp(mirrored(moments.store.y, moments.store.y[None])[0]) / moments.a / (right - left)
    beside = page.width / count >= (LEAST_TALL if tall > TALL else LEAST)
    rows, columns = (1, count) if beside else (count, 1)
    room = (tall * page.inches / columns + 0.1 * page.text) * rows + 0.1 * page.text  # more than enough
    figure, axes = page.figure(rows, columns, room, equal=True, sharex=True, sharey=True)
    for ax in axes[-1]:
        ax.set_xlabel(ALONG)
    for ax in axes[:, 0]:
        ax.set_ylabel(f"y / a{_half_axis(moments.store.scene)}")
    return figure, axes.ravel(), beside


def _half_axis(scene):
    """Text after y / a: length of the half-axis b of an ellipse."""
    s = Scales.of(scene)
    return f" (b = {s.b / s.a:.3g} a)" if scene.contact.kind == "elliptic" else ""


def draw_map(ax, moments, values, title, **style):
    """Draw one field over x, y with its mirror image; returns the object for a colour bar."""
    left, right = moments.window
    step = moments.x[1] - moments.x[0]
    seen = (moments.x > left - step) & (moments.x < right + step)
    y, full = mirrored(moments.store.y / moments.a, values[seen])
    ax.set(aspect="equal", xlim=(left, right), title=title)
    return shade(ax, moments.x[seen], y, full, **style)


def shade(ax, x, y, values, **style):
    """values (x, y) in colours; a picture in files of vectors, too."""
    return ax.pcolormesh(x, y, values.T, shading="gouraud", rasterized=True, **style)


def bar(figure, image, axes, label, beside=False):
    """A colour bar with an arrow at each end where colours are cut; beside: below maps that stand side by side."""
    low, top = image.get_clim()
    values = image.get_array()
    cut = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[int(values.min() < low), int(values.max() > top)]
    return figure.colorbar(image, ax=axes, label=label, extend=cut, location="bottom" if beside else "right",
                           aspect=THIN * np.size(axes))


def maps(page, moments):
    """Pressure and film."""
    n = moments.one()
    f = moments.store.fields(n, ("pressure", "film"))
    figure, (first, second), beside = panels(page, moments, 2)
    pressure = draw_map(first, moments, f["pressure"] / 1e9, "pressure", cmap=palette.PRESSURE)
    bar(figure, pressure, first, "GPa", beside)
    film = draw_map(second, moments, f["film"] * 1e6, "film", cmap=palette.FILM, vmax=moments.film_top([n]) * 1e6)
    bar(figure, film, second, "µm", beside)
    page.title(figure, f"{moments.store.scene.name}: pressure and film, {moments.peak(n)}")
    return figure


def ends(fields):
    """(smallest, largest) value of some fields."""
    return min(float(one.min()) for one in fields), max(float(one.max()) for one in fields)


def temperature_maps(page, moments):
    """Mid-film, and both surfaces in a scale of colours of their own: the film is far hotter."""
    n = moments.one()
    f = moments.store.fields(n, [name for name, *_ in SURFACES])
    figure, axes, beside = panels(page, moments, 3)
    for shown, label in ((slice(0, 1), "film (°C)"), (slice(1, 3), "both surfaces (°C)")):
        low, top = ends([f[name] for name, *_ in SURFACES[shown]])
        for ax, (name, text, _) in zip(axes[shown], SURFACES[shown]):
            image = draw_map(ax, moments, f[name], text, cmap=palette.TEMPERATURE, vmin=low, vmax=top)
        bar(figure, image, list(axes[shown]), label, beside)
    scene = moments.store.scene
    page.title(figure, f"{scene.name}: temperatures, {moments.peak(n)}{'; ' * scene.transient}{carrier(scene)}")
    return figure
