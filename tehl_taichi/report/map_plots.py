"""Fields over the contact at the worst moment of the passage."""

import numpy as np

from tehl_taichi.report.passage_plots import columns, even_numbers
from tehl_taichi.report.plots import field_map
from tehl_taichi.scene.feature_wording import feature_word
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures.field_maps import ends, film_ends
from tehl_taichi.view.figures.line_figures import ALONG, SURFACES
from tehl_taichi.view.figures.map_panels import EDGE, MIDDLE, half_axis, is_turned, mirrored
from tehl_taichi.view.figures.moments import Moments
from tehl_taichi.view.figures.palette import FILM, PRESSURE, TEMPERATURE

BODIES = ("map-temperature_a", "map-temperature_b")  # one scale of colours for both
ROWS = 101  # of a half domain, at most
SHORT = "-middle"  # ends the name of a map of the middle of a wide ellipse
BELOW, BELOW_LYING = -0.25, -0.5  # place of the colour bar below a map, in its heights
LYING = 230  # px: height of a map of a wide ellipse on its side


def maps(store):
    """Maps of pressure, film, temperatures over x, y; [] if nothing varies along y.

    A wide ellipse has its long axis to the right, and pressure and film have further maps of its middle.
    """
    if store.y.size == 1:
        return []
    moments, styles = Moments(store), _styles(store)
    n, when = moments.worst, _when(moments)
    fields = store.fields(n, list(styles))
    styles["film"] = _film(moments, fields["film"])
    out = [_map(moments, name, values, styles[name], when) for name, values in fields.items()]
    if is_turned(store.scene):
        out += [_map(moments, name, fields[name], styles[name], when, MIDDLE) for name in ("pressure", "film")]
    return _alike(out)


def rows(store):
    """Lists of these maps, each for a row of a page: a turned ellipse takes the whole width."""
    found = maps(store)
    if not found or not is_turned(store.scene):
        return [found] if found else []
    middles = [figure for figure in found if figure.name.endswith(SHORT)]
    whole = [[figure] for figure in found if not figure.name.endswith(SHORT)]
    return [*whole[:2], middles, *whole[2:]]


def _map(moments, name, values, style, when, side=0.0):
    """Map of a field; side: half-width in a shown across (0: all; for a wide ellipse slightly more)."""
    text, scale, unit, factor, keys = style
    store, where = moments.store, columns(moments.store)
    y, full = mirrored(store.y / moments.a, values[where] * factor)
    x, lying = store.x[where] / moments.a, is_turned(store.scene)
    if lying:
        near = np.flatnonzero(np.abs(y) <= (side or EDGE * Scales.of(store.scene).b / moments.a))
        y, full = y[near], full[:, near]
    kept = even_numbers(y.size, 2 * ROWS)
    y, full = y[kept], full[:, kept]
    title = f"{text}{', middle of the contact' * bool(side)}: {when}."
    across = f"y / a{half_axis(store.scene)}"
    if not lying:
        return field_map(f"map-{name}", title, x, y, full, scale, unit, ALONG, across, **keys)
    found = field_map(f"map-{name}{SHORT * bool(side)}", title, y, x, full.T, scale, unit, f"{across}, flow downwards", "x / a",
                      height=330 if side else LYING, **keys)
    found.layout["yaxis"]["autorange"] = "reversed"
    found.traces[0]["colorbar"]["y"] = BELOW if side else BELOW_LYING
    return found


def _film(moments, film):
    """Style of the film: colour range of the film inside the contact."""
    low, top = (round(end * 1e6, 4) for end in film_ends(moments, film))
    return f"Film, thicker than {top:.3g} µm in the last colour", FILM, "µm", 1e6, {"zmin": low, "zmax": top}


def _when(moments):
    """Text of the shown moment."""
    of = "the largest pressure of the passage, " if moments.store.steps > 1 else ""
    return f"{of}{moments.peak(moments.worst)}"


def _styles(store):
    """{field: (title, colours, unit, factor, ends of the colours)}."""
    whose = {f"surface {one.name}": f", which carries the {feature_word(store.scene)}" for one in store.scene.surfaces
             if one.features and store.scene.transient}
    heat: dict[str, tuple] = {name: (f"Temperature, {text}{whose.get(text, '')}", TEMPERATURE, "°C", 1.0, {})
            for name, text, _ in SURFACES if name in store.stored}
    return {"pressure": ("Pressure", PRESSURE, "GPa", 1e-9, {}), "film": (), **heat}


def _alike(figures):
    """Use one colour scale for both surfaces; the film, far hotter, has its own."""
    heat = [figure.traces[0] for figure in figures if figure.name in BODIES]
    for trace in heat:
        trace |= dict(zip(("zmin", "zmax"), ends([one["z"] for one in heat])))
    return figures
