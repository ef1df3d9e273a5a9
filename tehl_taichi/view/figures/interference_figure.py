"""Figure of interference colours as in an optical rig, with a scale of film thickness."""

import numpy as np

from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.view.figures.line_figures import ALONG
from tehl_taichi.view.figures.map_panels import EDGE, half_axis, is_turned, mirrored

FILMS = 512  # of the scale
FINE = 1200  # points of the picture along its longer side: the film is smooth, its fringes are finer than the grid


def interference(page, moments, light):
    """Figure of colours over x, y, with the scale of films for the refractive index at the middle of the contact. light: a
    :class:`tehl_taichi.view.figures.interference.Light`.
    """
    store, n = moments.store, moments.one()
    f = store.fields(n, ["pressure", "film", *(name for name in ("temperature_mid",) if name in store.stored)])
    inlet = store.scene.operation.temperature
    index = light.index_at(store.scene.oil.density_ratio(f["pressure"], f.get("temperature_mid", inlet), inlet))
    x, y, path = _picture(moments, index * f["film"])
    figure, (ax, scale) = _panels(page, np.ptp(y) / np.ptp(x), is_turned(store.scene))
    _draw(ax, store.scene, x, y, light.colours(path))
    middle = float(index[nearest_index(moments.x, 0.0), moments.row])
    _draw_scale(scale, light, middle, moments.film_top([n]))
    page.title(figure, f"{moments.named}: interference colours in {light.words}, {moments.peak(n)}")
    return figure


def _picture(moments, path):
    """(x, y, optical paths) in a and m, interpolated between the nodes of the map."""
    left, right = moments.window
    y, path = mirrored(moments.store.y / moments.a, path)
    s = Scales.of(moments.store.scene)
    side = min(EDGE * s.b / s.a, y[-1]) if is_turned(moments.store.scene) else y[-1]
    per_a = FINE / max(right - left, 2 * side)
    x_fine, y_fine = (np.linspace(*ends, int(np.ptp(ends) * per_a)) for ends in ((left, right), (max(-side, y[0]), side)))
    rows = np.array([np.interp(x_fine, moments.x, column) for column in path.T])
    return x_fine, y_fine, np.array([np.interp(y_fine, y, row) for row in rows.T])


def _panels(page, tall, lying):
    """(figure, axes); tall: height over width of an upright picture."""
    tall = 1 / tall if lying else tall
    room = 0.8 * page.inches * tall
    figure, axes = page.figure(2, height=room + 9 * page.text / 72 + 0.25, height_ratios=(room, 0.25))
    return figure, axes.ravel()


def _draw(ax, scene, x, y, colours):
    """Draw the picture; a wide ellipse is turned, as in other maps."""
    across = f"y / a{half_axis(scene)}"
    if is_turned(scene):
        ax.imshow(colours, extent=(y[0], y[-1], x[-1], x[0]), interpolation="bilinear")
        ax.set(xlabel=f"{across}, flow downwards", ylabel="x / a")
    else:
        ax.imshow(np.swapaxes(colours, 0, 1), extent=(x[0], x[-1], y[0], y[-1]), origin="lower", interpolation="bilinear")
        ax.set(xlabel=ALONG, ylabel=across)


def _draw_scale(ax, light, index, top):
    """Draw the colour of every film up to `top` (m)."""
    h = np.linspace(0.0, top, FILMS)
    ax.imshow(light.colours(index * h)[None], extent=(0.0, top * 1e6, 0.0, 1.0), aspect="auto")
    ax.set(yticks=(), xlabel=f"film (µm) where the refractive index is {index:.3f}, as in the middle")
