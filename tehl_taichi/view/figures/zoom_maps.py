"""Maps of the zoom windows at the moment of the largest pressure, and their outlines on the maps of the run."""

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
    """Figure of pressure, film and film temperature in the windows, one row each."""
    store, windows = moments.store, ZoomWindow.all_of(moments.store)
    most = ZoomWindow.with_most(store)
    n = most.worst if moments.at is None or moments.one() not in most else moments.one()
    shown = [name for name in SHOWN if name in most.names]
    figure, axes = page.figure(len(windows), len(shown), _height(page, windows, len(shown)), equal=True, sharex="row",
                               sharey="row")
    for row, window in zip(axes, windows):
        _draw(figure, row, moments, window, n, shown)
        row[0].set_ylabel(f"y / a{half_axis(store.scene)}")
    p, many = max(float(one.fields(n, ["pressure"])["pressure"].max()) for one in windows), "s" * bool(windows[1:])
    page.title(figure, f"{moments.named}: zoom window{many}, cells {store.scene.zoom.factor} times finer, "
                       f"{moments.says(n)}, p_max {p / 1e9:.2f} GPa")
    return figure


def _height(page, windows, count):
    """Height (inches) of a row of `count` maps: more than enough for the highest window."""
    tall = max(np.ptp(mirrored(one.y, one.y[None])[0]) / np.ptp(one.x) for one in windows)
    return tall * page.inches / count + 0.2 * page.text


def _draw(figure, row, moments, window, n, shown):
    """Draw the maps `shown` of a window at entry n of the run into a row of axes."""
    found = window.fields(n, shown)
    x, (y, _) = window.columns(n) / moments.a, mirrored(window.y / moments.a, window.y[None])
    for ax, name in zip(row, shown):
        title, factor, unit, colours = SHOWN[name]
        values = mirrored(window.y, found[name] * factor)[1]
        cut = {"vmax": min(values.max(), ROOM * factor * np.median(found[name]))} if name == "film" else {}
        image = shade(ax, x, y, values, cmap=colours, **cut)
        ax.set(aspect="equal", title=title, xlabel=ALONG.split(" (")[0])
        bar(figure, image, ax, unit, beside=True)


def outline(panels, moments, n):
    """Draw the edges of the windows at entry n of the run on its maps. Returns whether it has a window."""
    windows = [window for window in ZoomWindow.all_of(moments.store) if n in window]
    if not windows or panels.middles:
        return False
    for window in windows:
        x, (y, _) = window.columns(n) / moments.a, mirrored(window.y / moments.a, window.y[None])
        for ax in panels.axes:
            ax.plot(x[[0, -1, -1, 0, 0]], y[[0, 0, -1, -1, 0]], **OUTLINE)
    return True
