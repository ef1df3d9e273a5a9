"""Pressure and film of a zoom window along a row, over those of its run."""

import numpy as np

THICK, NODES = 1.6, 2.0  # times the width of other lines; points of a node


def of_row(store, entry, row):
    """(x, pressure, film) of the window at an entry of its run, along the row of that number; None where it has none."""
    entries = store.map("zoom_entry")
    if entries is None or entry not in entries:
        return None
    n, rows = int(np.flatnonzero(entries == entry)[0]), store.map("zoom_y")
    line = int(np.argmin(np.abs(rows - store.y[row])))
    if abs(rows[line] - store.y[row]) > 1e-3 * abs(store.x[1] - store.x[0]):
        return None
    x = store.map("zoom_left")[n] + store.map("zoom_x")
    return x, store.map("zoom_pressure")[n][:, line], store.map("zoom_film")[n][:, line]


def draw(axes, store, entry, row, a, colour):
    """Draw the window into the axes of pressure (GPa) and film (µm) over x/a. Returns whether there was one."""
    found = of_row(store, entry, row)
    if found is None:
        return False
    x, p, h = found
    for ax, values in zip(axes, (p / 1e9, h * 1e6)):
        ax.plot(x / a, values, color=colour, lw=THICK, marker=".", ms=NODES, zorder=4)
    return True
