"""Figure of a comparison by position: one panel per quantity, one line per result, over one axis."""

import itertools
import textwrap

import numpy as np

from tehl_taichi.errors import StoreError
from tehl_taichi.runs.open_results import BEARING, CAM, FLANK, STUDY
from tehl_taichi.runs.sweep.study_labels import with_unit
from tehl_taichi.values.digits import printed_unit
from tehl_taichi.view.figures import palette

MOST = 6  # panels
TICKS = 6
BESIDE = 0.15  # of the axis, free beside places with names
HIGH = 1.25  # rows of lines
LETTERS = 20  # of a line of a label
PLURAL = {FLANK: "flanks", BEARING: "bearings", CAM: "cams", STUDY: "studies"}
SPELLED = (("(um)", "(µm)"), ("deg C", "°C"), ("lambda", "λ"))


def write(comparison, path, page):
    """Write the figure in the format of a :class:`FigureStyle`; returns the path."""
    page, path = page.of_file(path)
    page.check(path)
    if not (shown := panels(comparison)):
        raise StoreError(f"{' and '.join(comparison.names)} have no result to draw yet")
    return page.save(lambda: drawn(page, comparison, shown), path)


def panels(comparison):
    """Names of the drawn quantities: for each line, the first that any result has."""
    lines = comparison.tables[0].drawn
    found = (next((name for name in names if name in comparison.quantities), None) for names in lines)
    return [name for name in found if name][:MOST]


def drawn(page, comparison, shown):
    """The matplotlib Figure."""
    columns = 1 if page.narrow or len(shown) < 3 else 2
    rows = -(-len(shown) // columns)
    figure, axes = page.figure(rows, columns, HIGH * page.row(columns) * rows, sharex=True)
    for ax, name in itertools.zip_longest(axes.T.flat, shown):
        _panel(ax, comparison, name) if name else ax.set_visible(False)
    for ax in axes[-1] if len(shown) == axes.size else (axes[-1, 0], axes[-2, -1]):
        _dress(ax, comparison)
    page.legend(figure)
    page.title(figure, f"{PLURAL[comparison.kind]} {' and '.join(comparison.names)}")
    return figure


def _panel(ax, comparison, name):
    """Draw a line with error bars for each result."""
    factor, _ = _axis(comparison)
    for table, label, colour in zip(comparison.tables, comparison.labels(), palette.LINES):
        x, y, error = map(np.array, comparison.line(table, name))
        bars = error if np.isfinite(error).any() else None
        ax.errorbar(x * factor, y, bars, fmt="o" if table.ticks else ".-", color=colour, label=label, **palette.BARS)
    ax.set_ylabel(_label(comparison.quantities[name]))
    ax.grid()
    ax.margins(x=BESIDE if comparison.tables[0].ticks else None)


def _label(quantity):
    """Label of an axis, on two lines if it is long."""
    text = f"{quantity.label} ({quantity.unit})" if quantity.unit else quantity.label
    for plain, spelled in SPELLED:
        text = text.replace(plain, spelled)
    return textwrap.fill(text, LETTERS)


def _axis(comparison):
    """(factor, label) of the axis."""
    one = comparison.tables[0]
    factor, unit = printed_unit(one.x_unit, max((abs(place.x) for place in comparison.places), default=0.0))
    return factor, with_unit(one.across, unit) if one.x_unit else one.across


def _dress(ax, comparison):
    """Label the lowest axis; names of places in place of numbers if they have names."""
    ax.set_xlabel(_axis(comparison)[1])
    ax.tick_params(labelbottom=True)
    if comparison.tables[0].ticks:
        places = comparison.places[::-(-len(comparison.places) // TICKS)]
        ax.set_xticks(list(map(comparison.x_of, places)), [place.words.replace(", ", "\n") for place in places])
