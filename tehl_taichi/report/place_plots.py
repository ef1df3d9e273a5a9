"""Figures of pages over a sequence of contacts, as along a flank or over the cycle of a cam."""

import numpy as np

from tehl_taichi.report.number_text import sentence_case
from tehl_taichi.report.plots import colour, line, rings, stack
from tehl_taichi.runs.flank.place_panels import JUDGED


def figure(name, along, panel, more=""):
    """Figure of one of :func:`tehl_taichi.runs.flank.place_panels.panels`; along: title of the axis; more: words of the
    caption.
    """
    label, lines = panel
    traces = [_trace(which, x.tolist(), y, colour(n)) for n, (which, (x, y, _)) in enumerate(lines.items())]
    return stack(name, f"{sentence_case(label)}{more}.", along, [(label, traces, {})], height=330)


def _trace(name, x, y, shade):
    y = [None if np.isnan(value) else value for value in y.tolist()]
    return rings(x, y, name, shade) if name == JUDGED else line(x, y, name, shade, mode="lines+markers")
