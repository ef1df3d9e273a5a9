"""Fields over the contact at the worst moment of the passage."""

from tehl_taichi.report.passage_plots import columns, film_top, thinned
from tehl_taichi.report.plots import field_map
from tehl_taichi.scene.feature_wording import passing
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures.field_maps import ends, mirrored
from tehl_taichi.view.figures.line_figures import ALONG, SURFACES
from tehl_taichi.view.figures.moments import Moments
from tehl_taichi.view.figures.palette import FILM, PRESSURE, TEMPERATURE

BODIES = ("map-temperature_a", "map-temperature_b")  # one scale of colours for both
ROWS = 101  # of a half domain, at most


def maps(store):
    """Pressure, film and temperatures over x, y; none where nothing varies across."""
    if store.y.size == 1:
        return []
    moments, a, where = Moments(store), Scales.of(store.scene).a, columns(store)
    n, when = moments.worst, _when(moments)
    rows = thinned(store.y.size, ROWS if store.y[0] >= 0 else 2 * ROWS)
    styles, out = _styles(store), []
    for name, values in store.fields(n, list(styles)).items():
        text, scale, unit, factor, keys = styles[name]
        y, full = mirrored(store.y[rows] / a, values[where][:, rows] * factor)
        out.append(field_map(f"map-{name}", f"{text}: {when}.", store.x[where] / a, y, full, scale, unit,
                             ALONG, "y / a", **keys))
    return _alike(out)


def _when(moments):
    """The moment that is shown, in words."""
    of = "the largest pressure of the passage, " if moments.store.steps > 1 else ""
    return f"{of}{moments.peak(moments.worst)}"


def _styles(store):
    """{field: (title, colours, unit, factor, ends of the colours)}."""
    top = film_top(store) * 1e6
    whose = {f"surface {one.name}": f", which carries the {passing(store.scene)}" for one in store.scene.surfaces
             if one.features and store.scene.transient}
    heat: dict[str, tuple] = {name: (f"Temperature, {text}{whose.get(text, '')}", TEMPERATURE, "°C", 1.0, {})
            for name, text, _ in SURFACES if name in store.stored}
    film = f"Film, thicker than {top:.2g} µm in the last colour", FILM, "µm", 1e6, {"zmin": 0.0, "zmax": top}
    return {"pressure": ("Pressure", PRESSURE, "GPa", 1e-9, {}), "film": film, **heat}


def _alike(figures):
    """Both surfaces in one colour scale; the film, far hotter, has its own."""
    heat = [figure.traces[0] for figure in figures if figure.name in BODIES]
    for trace in heat:
        trace |= dict(zip(("zmin", "zmax"), ends([one["z"] for one in heat])))
    return figures
