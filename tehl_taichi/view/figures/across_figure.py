"""Lines along y: pressure and film across the contact."""

import numpy as np

from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.view.figures.line_figures import set_title, start_style
from tehl_taichi.view.figures.map_panels import mirrored


def centreline_y(page, moments):
    """Figure of pressure and film along y for several feature positions, each through its largest pressure; a steady one at x =
    0.
    """
    store, shown = moments.store, moments.several()
    figure, ((top,), (low,)) = page.figure(2, sharex=True)
    for n, (colour, label) in shown.items():
        f = store.fields(n, ("pressure", "film"))
        column = int(np.argmax(f["pressure"].max(axis=1))) if n else nearest_index(moments.x, 0.0)
        y, values = mirrored(store.y / moments.a, np.stack([f["pressure"][column] / 1e9, f["film"][column] * 1e6]))
        style = dict(label=f"{label}, x = {moments.x[column]:+.2f} a", color=colour, **start_style(colour))
        top.plot(y, values[0], **style)
        low.plot(y, values[1], **style)
    top.set(ylabel="pressure (GPa)")
    low.set(ylabel="film (µm)", xlabel="y / a", ylim=(0, 1e6 * moments.film_top(shown)))
    for ax in (top, low):
        ax.grid()
    page.legend(figure)
    set_title(page, figure, moments, "along y, through the largest pressure of each moment" if max(shown) else "along y", [])
    return figure
