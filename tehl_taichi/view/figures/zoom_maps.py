"""Maps of a zoom window at the moment of its largest pressure, and its outline on the maps of the run."""

import numpy as np

from tehl_taichi.view.figures import palette
from tehl_taichi.view.figures.line_figures import ALONG
from tehl_taichi.view.figures.map_panels import bar, half_axis, mirrored, shade
from tehl_taichi.view.zoom_window import ZoomWindow

SHOWN = {"pressure": ("pressure", 1e-9, "GPa", palette.PRESSURE), "film": ("film", 1e6, "µm", palette.FILM),
         "temperature_mid": ("film temperature", 1.0, "°C", palette.TEMPERATURE)}
ROOM = 1.5  # times the median of the film: upper end of its colours, below the gap behind the contact
OUTLINE = dict(color=palette.GREY, ls="--", lw=0.8)


def zoom(page, moments):
    """Figure of pressure, film and film temperature in the window."""
    store, window = moments.store, ZoomWindow.of(moments.store)
    n = window.worst if moments.at is None or moments.one() not in window else moments.one()
    found = window.fields(n, SHOWN)
    x, (y, _) = window.columns(n) / moments.a, mirrored(window.y / moments.a, window.y[None])
    height = np.ptp(y) / np.ptp(x) * page.inches / len(found) + 0.2 * page.text  # more than enough
    figure, axes = page.figure(1, len(found), height, equal=True, sharex=True, sharey=True)
    for ax, name in zip(axes[0], found):
        title, factor, unit, colours = SHOWN[name]
        values = mirrored(window.y, found[name] * factor)[1]
        cut = {"vmax": min(values.max(), ROOM * factor * np.median(found[name]))} if name == "film" else {}
        image = shade(ax, x, y, values, cmap=colours, **cut)
        ax.set(aspect="equal", title=title, xlabel=ALONG.split(" (")[0])
        bar(figure, image, ax, unit, beside=True)
    axes[0][0].set_ylabel(f"y / a{half_axis(store.scene)}")
    page.title(figure, f"{store.scene.name}: zoom window, cells {store.scene.zoom.factor} times finer, {moments.says(n)}, "
                       f"p_max {found['pressure'].max() / 1e9:.2f} GPa")
    return figure


def outline(panels, moments, n):
    """Draw the edges of the window at entry n of the run on its maps. Returns whether it has a window."""
    window = ZoomWindow.of(moments.store)
    if window is None or n not in window or panels.middles:
        return False
    x, (y, _) = window.columns(n) / moments.a, mirrored(window.y / moments.a, window.y[None])
    for ax in panels.axes:
        ax.plot(x[[0, -1, -1, 0, 0]], y[[0, 0, -1, -1, 0]], **OUTLINE)
    return True
