"""Numbered worst places of a surface with many heights, for the maps of the index and a table."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue.index_peaks import around, worst_places
from tehl_taichi.report.document import table
from tehl_taichi.report.number_text import value_text
from tehl_taichi.report.run_tables import in_file
from tehl_taichi.scene.feature_wording import feature_word, met_words
from tehl_taichi.scene.overlap import height_at
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures.index_text import index_text
from tehl_taichi.view.figures.palette import LIMIT

MOST = 8
UNBROKEN = "\u00a0"  # a space between a number and its unit, where columns are narrow
APART = 0.25  # half-widths between two of them: asperities nearer to each other are one


@dataclass(frozen=True)
class NumberedPoint:
    """x, y: m, from the feature's centre; Fi: at the surface, below: at the worst depth (None: not all points were searched),
    each the largest nearby; height: m, of its surface, or of
    the feature that a smooth surface meets there at X = 0.
    """

    x: float
    y: float
    Fi: float
    below: float | None
    height: float


def places(search):
    """List of :class:`NumberedPoint`, the worst first; [] for a single asperity, dent or ridge, whose critical point
    suffices.
    """
    Fi, scene = search.result.Fi, search.scene
    if Fi is None or Fi.shape[1] == 1 or not _many(scene):
        return []
    x, y = search.result.feature_frame_x, search.result.feature_frame_y
    deep, apart = _below(search), APART * Scales.of(scene).a
    found = worst_places(x, y, Fi if deep is None else np.maximum(Fi, deep), apart, MOST)
    i, j = np.array(found).T
    heights = height_at(_features(search), x[i], y[j])

    def largest(values, place):
        return None if values is None else around(x, y, values, place, apart / 2)

    return [NumberedPoint(float(x[at[0]]), float(y[at[1]]), largest(Fi, at), largest(deep, at), float(height))
            for at, height in zip(found, heights)]


def _features(search):
    """Features of the searched surface; if it has none, those of the other one, which it meets there at X = 0."""
    features = search.scene.features
    return [f for f in features if f.surface == search.result.numbers.get("surface")] or features


def _many(scene):
    """Whether many heights pass: several features, or patches of them."""
    return len(scene.features) > 1 or any("extent_x" in f.kind.uses for f in scene.features)


def _below(search):
    return search.result.index("findley_stress_at_worst_depth")


def number_trace(search):
    """[trace] with their numbers on a map."""
    found = search.places
    text = [str(n) for n in range(1, len(found) + 1)]
    font = {"color": LIMIT, "size": 13, "shadow": "auto"}  # readable on light colours, too
    return [{"type": "scatter", "mode": "text", "x": [p.x * 1e6 for p in found], "y": [p.y * 1e6 for p in found], "text": text,
             "textposition": "top right", "textfont": font, "name": "points of the table",
             "showlegend": False, "hoverinfo": "skip", "cliponaxis": False}] if found else []


def rows(search):
    """Table of these points, None without any."""
    found, scene = search.places, search.scene
    if not found:
        return None
    head, cells = zip(*_columns(search, scene, found))
    caption = (f"Points of the {feature_word(scene)} with the largest index, numbered as on the maps. {_places(search)}; "
               f"Fi: largest value within {value_text(APART / 2 * Scales.of(scene).a, unit='m', digits=3)}.")
    return table(("critical point", *head), [(str(n), *row) for n, row in enumerate(zip(*cells), 1)], caption)


def _places(search):
    """Text about the columns of places and heights."""
    numbers, met = search.result.numbers, met_words(search.scene, search.result.numbers)
    if not met:
        return "x, y: from its centre"
    own = "" if numbers.get("carries_feature", True) else f"; height: of the point{met}"
    return f"x, y: on body {numbers['surface']}, from the point that meets its centre at X = 0{own}"


def _columns(search, scene, found):
    """(heading, cells) of each column that has values."""
    for axis in ("x", "y", "height"):
        yield axis, [value_text(getattr(p, axis), unit="m", digits=3).replace(" ", UNBROKEN) for p in found]
    yield "Fi at the surface", [index_text(p.Fi) for p in found]
    if found[0].below is not None:
        depth = value_text(float(search.result.worst_depth[0]), unit="m", digits=3)
        yield f"Fi {depth} below", [index_text(p.below) for p in found]
    if feature_word(scene) == "scan":
        met = met_words(scene, search.result.numbers)
        yield f"in the file, counted from 1{', point' * bool(met)}{met}", [_in_file(scene, p) for p in found]


def _in_file(scene, p):
    """Text of row and column, with a note if heights fade out there."""
    first = scene.features[0]
    fades = min(first.to_rim(p.x - first.x, p.y - first.y)) < first.taper
    return in_file(scene, p.x, p.y) + ", fading out at the rim" * fades
