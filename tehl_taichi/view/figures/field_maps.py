"""Maps over x, y of one moment, in true proportions; arrows on colour bars mark values beyond their ends."""

import numpy as np

from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures import palette, zoom_maps
from tehl_taichi.view.figures.line_figures import SURFACES, carrier
from tehl_taichi.view.figures.map_panels import panels
from tehl_taichi.view.figures.moments import INSIDE


def maps(page, moments):
    """Figure with maps of pressure and film."""
    n = moments.one()
    f = moments.store.fields(n, ("pressure", "film"))
    shown = panels(page, moments, 2)
    pressure = shown.draw(0, f["pressure"] / 1e9, "pressure", cmap=palette.PRESSURE)
    shown.bar(pressure, slice(0, 1), "GPa")
    low, top = film_ends(moments, f["film"])
    film = shown.draw(1, f["film"] * 1e6, "film", cmap=palette.FILM, vmin=low * 1e6, vmax=top * 1e6)
    shown.bar(film, slice(1, 2), "µm")
    window = "; dashed: zoom window" * zoom_maps.outline(shown, moments, n)
    page.title(shown.figure, f"{moments.named}: pressure and film, {moments.peak(n)}{window}")
    return shown.figure


def film_ends(moments, film):
    """(smallest, largest) of a film (x, y) inside the dry contact: colour range without the gap outside."""
    s = Scales.of(moments.store.scene)
    across = 0.0 if s.kind == "line" else moments.store.y / s.b
    inside = moments.x[:, None] ** 2 + across**2 < INSIDE**2
    return float(film.min()), float(film[np.broadcast_to(inside, film.shape)].max())


def ends(fields):
    """(smallest, largest) value of some fields."""
    return min(float(one.min()) for one in fields), max(float(one.max()) for one in fields)


def temperature_maps(page, moments):
    """Figure with maps of mid-film and both surfaces; the surfaces have a separate colour scale, since the film is far
    hotter.
    """
    n = moments.one()
    f = moments.store.fields(n, [name for name, *_ in SURFACES])
    panel = panels(page, moments, 3)
    for shown, label in ((slice(0, 1), "film (°C)"), (slice(1, 3), "both surfaces (°C)")):
        low, top = ends([f[name] for name, *_ in SURFACES[shown]])
        for k, (name, text, _) in list(enumerate(SURFACES))[shown]:
            image = panel.draw(k, f[name], text, cmap=palette.TEMPERATURE, vmin=low, vmax=top)
        panel.bar(image, shown, label)
    scene = moments.store.scene
    page.title(panel.figure, f"{moments.named}: temperatures, {moments.peak(n)}{'; ' * scene.transient}{carrier(scene)}")
    return panel.figure
