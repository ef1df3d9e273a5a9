"""Passing surface: its heights; for a measured map also the file and its processing."""

import math
import os

import numpy as np

from tehl_taichi.report.document import Section, facts, figure_block, table
from tehl_taichi.report.number_text import value_text
from tehl_taichi.report.passage_plots import even_numbers
from tehl_taichi.report.plots import colour, field_map, line, stack
from tehl_taichi.scene import surface_roughness
from tehl_taichi.scene.feature_wording import carriers, from_centre, together
from tehl_taichi.scene.surface.maps.height_map import LEVELS
from tehl_taichi.scene.surface.maps.map_warnings import form_taken
from tehl_taichi.values.digits import with_error
from tehl_taichi.view.figures.height_profile import heights
from tehl_taichi.view.figures.palette import HEIGHT, SHADE

STEPS = 1000  # of heights, at least
HOLES = " Light: points that were not measured and were filled smoothly from their neighbours."
MOST = 400  # columns and rows kept: what a screen shows


ROUGHNESS = (("mean height (Sa, Ra)", ("Sa_m", "Ra_m"), "m"), ("rms height (Sq, Rq)", ("Sq_m", "Rq_m"), "m"),
             ("range (Sz, Rz)", ("Sz_m", "Rz_m"), "m"), ("skewness", ("skewness",), "1"), ("rms slope", ("Rq_slope",), "1"),
             ("autocorrelation length along x", ("length_x_m",), "m"), ("along y", ("length_y_m",), "m"))


def section(scene, summary):
    """(:class:`Section`,), or () without a passage."""
    if not scene.transient:
        return ()
    maps = [f for f in scene.features if f.kind.measured]
    parts = figure_block(picture(scene)), *(facts(map_facts(f, scene)) for f in maps), *roughness(scene, summary)
    return (Section("The surface", parts),)


def roughness(scene, summary):
    """(table of the roughness of each surface and of both, film over it) for rough surfaces."""
    columns = {}
    for name, numbers in surface_roughness.to_dict(scene).items():
        columns["both together" if name == "combined" else f"surface {name}"] = numbers
        if "before_filters" in numbers:
            columns[f"surface {name} before its filter"] = numbers["before_filters"]
    if not columns:
        return ()
    rows = [(what, *(_rough_value(numbers, keys, unit) for numbers in columns.values())) for what, keys, unit in ROUGHNESS]
    return table(("roughness", *columns), rows), _film_over(summary) if "lambda" in summary else None


def _film_over(summary):
    return facts([("λ = h_c/Sq", with_error(summary["lambda"], summary["error"]["lambda"], "", 3))])


def _rough_value(numbers, keys, unit):
    return next((value_text(numbers[key], unit=unit) for key in keys if key in numbers), "")


def picture(scene):
    """Figure of the heights of all features together, over x, y or over x alone."""
    found = heights(scene)
    i, j = (even_numbers(at.size, MOST) for at in (found.x, found.y))
    x, y, values = found.x[i] * 1e6, found.y[j] * 1e6, found.values[i][:, j] * 1e6
    along = from_centre(scene)
    caption = f"Heights of the features, on {carriers(scene)}{together(scene)}."
    if found.line:
        drawn_line = line(x, values[:, 0], "height", colour(0), in_legend=False)
        return stack("surface", caption, along, [("height (µm)", [drawn_line], {})], height=330)
    caption += _kept(found, i, j) + HOLES * bool(found.filled.any())
    return field_map("surface", caption, x, y, _stepped(values), HEIGHT, "µm", along, "y (µm)", _holes(found, i, j),
                     true=found.true, height=440)


def _holes(found, i, j):
    """Trace that covers unmeasured points; a point that is left out counts for the kept point before it."""
    if not found.filled.any():
        return []
    holes = np.logical_or.reduceat(np.logical_or.reduceat(found.filled, i, axis=0), j, axis=1)
    return [{"type": "heatmap", "x": found.x[i] * 1e6, "y": found.y[j] * 1e6, "z": np.where(holes, 1.0, np.nan).T,
             "colorscale": [[0, SHADE], [1, SHADE]], "showscale": False, "hovertemplate": "not measured<extra></extra>"}]


def _stepped(values):
    """Heights rounded to less than a thousandth of their range (a power of two), because all digits of a roughness would be a
    megabyte of the page.
    """
    size = float(np.ptp(values))
    step = 2.0 ** math.floor(math.log2(size / STEPS)) if size > 0 else 1.0
    return np.round(values / step) * step


def _kept(found, i, j):
    """Text of the points that are drawn."""
    if (i.size, j.size) == found.values.shape:
        return ""
    return f" {i.size} × {j.size} of {found.x.size} × {found.y.size} points are kept in this page."


def map_facts(f, scene):
    """(label, value) of a map: of its file, and of the passing heights."""
    m, sides = f.measures, [size for size, count in zip(f.patch, f.points) if count > 1]
    turned = f", times {f.scale:g}" if f.scale != 1 else ""
    rim = f", fading out over {value_text(f.taper, unit='m')} at its rim" if f.taper else ""
    return [("file", os.path.basename(f.file)), ("points", " × ".join(str(n) for n in f.points if n > 1)),
            *([("not measured", _missing(f))] if f.holes.any() else []),
            *([(f.kind.lies_name, f.kind.lies(f))] if f.kind.lies(f) else []),
            ("distance between points", " × ".join(value_text(s, unit="m") for s, n in zip(f.steps, f.points) if n > 1)),
            ("unit of the heights", f"{f.unit.replace('um', 'µm')}{turned}"),
            ("removed form", LEVELS[f.level] + form_taken(f, scene)),
            *([("low-pass", f"Gaussian, cutoff {value_text(f.cutoff, unit='m')}")] if f.cutoff else []),
            ("patch used", " × ".join(value_text(size, unit="m") for size in sides) + rim),
            ("range", f"{value_text(m.range, unit='m')}: {_signed(m.low)} to {_signed(m.high)}"),
            ("rms", value_text(m.rms, unit="m")), ("largest slope", f"{m.slope:.2g}°")]


def _missing(f):
    """Text of the unmeasured points of the used part, and of the file if that has more."""
    used, spikes = int(f.holes.sum()), int(f.spikes.sum())
    all_ = int((~np.isfinite(f.heights)).sum())
    return f"{used}, filled in" + f", {spikes} of them spikes" * bool(spikes) + f" ({all_} in the whole file)" * (used < all_)


def _signed(height):
    return value_text(height, unit="m").replace("-", "−")
