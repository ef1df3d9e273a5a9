"""Figure of the passing surface: heights over x, y, or over x if nothing varies along y."""

import numpy as np

from tehl_taichi.scene.feature_wording import carriers, from_centre, together
from tehl_taichi.view.figures import palette
from tehl_taichi.view.figures.height_profile import heights
from tehl_taichi.view.figures.map_panels import bar

LABEL = "height (µm)"
COARSE = 400  # points: so few are joined by colours in between, as the heights are; of more, several share a dot


def surface(page, moments):
    """Figure of all features together."""
    scene = moments.store.scene
    found = heights(scene)
    figure = _line(page, found) if found.line else _map(page, found)
    figure.axes[0].set_xlabel(f"{from_centre(scene)}, flow to the right")
    low, high = (float(end) * 1e6 for end in (found.values.min(), found.values.max()))
    holes = "; light: not measured, filled in" if found.filled.any() else ""
    page.title(figure, f"{scene.name}: heights of {carriers(scene)}{together(scene)}, {low:.3g} to {high:.3g} µm{holes}")
    return figure


def _line(page, found):
    figure, ((ax,),) = page.figure(height=1.3 * page.row())
    ax.plot(found.x * 1e6, found.values[:, 0] * 1e6)
    ax.set(ylabel=LABEL, xlim=(found.x[0] * 1e6, found.x[-1] * 1e6))
    ax.grid()
    return figure


def _map(page, found):
    height = 1.2 * page.inches * (min(found.tall, 1.0) if found.true else 0.6)  # more than enough
    figure, ((ax,),) = page.figure(height=height, equal=found.true)
    bar(figure, _picture(ax, found), ax, LABEL)
    ax.set(ylabel="y (µm)", aspect="equal" if found.true else "auto")
    return figure


def _picture(ax, found):
    """Draw heights as a picture (a triangle mesh of a million points takes minutes); each point is the centre of its pixel."""
    ends = [end * 1e6 for at in (found.x, found.y) for end in (at[0] - (at[1] - at[0]) / 2, at[-1] + (at[1] - at[0]) / 2)]
    between = "bilinear" if max(found.values.shape) <= COARSE else "antialiased"
    if found.filled.any():
        _cover(ax, found.filled, ends)
    return ax.imshow(found.values.T * 1e6, origin="lower", extent=ends, interpolation=between, cmap=palette.HEIGHT)


def _cover(ax, filled, ends):
    """Cover unmeasured points with the colour for missing values."""
    from matplotlib.colors import ListedColormap

    ax.imshow(np.where(filled.T, 1.0, np.nan), origin="lower", extent=ends, interpolation="nearest", zorder=1,
              cmap=ListedColormap([palette.SHADE]))
