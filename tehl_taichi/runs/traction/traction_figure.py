"""Figure of traction curves: friction, central film and temperature over slip (or speed), a curve per temperature, with error
bars.
"""

import itertools

import numpy as np

from tehl_taichi.runs.traction.traction_rows import AXES, SPEED, SRR, TEMPERATURE, axis
from tehl_taichi.values.digits import printed_unit
from tehl_taichi.view.figures import logarithmic_axis, palette, unknown_errors

PANELS = (("friction coefficient", "friction_coefficient", ""), ("central film", "h_c_m", "m"),
          ("largest film temperature", "film_max_C", "°C"))
ZERO = 1e-12    # of a friction coefficient in pure rolling


def drawn(page, found):
    """The matplotlib Figure of a Traction in a :class:`FigureStyle`."""
    panels = [panel for panel in PANELS if any(row[panel[1]] is not None for row in found.rows)] or PANELS[:1]
    figure, axes = page.figure(len(panels), sharex=True)
    for ax, (label, key, unit) in zip(axes[:, 0], panels):
        _panel(ax, found, label, key, unit)
    _along(axes[-1, 0], found)
    if len(found.curves) > 1:
        page.legend(figure)
    page.title(figure, title(found) + _explained(found, panels))
    return figure


def _explained(found, panels):
    """Words about hollow points, where one of the panels has some."""
    each = (series(found, found.rows, key)[1:] for _, key, _ in panels)
    return next(filter(None, itertools.starmap(unknown_errors.words, each)), "")


def title(found):
    """Scene, oil, and the conditions that all cases of a Traction have in common."""
    scene, rows = found.study.plan.scene, found.rows
    fixed = [_condition(key, rows[0]) for key in (SRR, SPEED, TEMPERATURE) if len({row[AXES[key][0]] for row in rows}) == 1]
    return ", ".join([f"{scene.name}: traction", scene.oil.name or "oil of the scene", *fixed])


def _condition(key, row):
    """Text of a condition, such as "mean speed 1 m/s"."""
    name, words, unit = AXES[key]
    return f"{words} {row[name]:g} {unit}".strip()


def _panel(ax, found, label, key, unit):
    largest = max((abs(row[key]) for row in found.rows if row[key] is not None), default=0.0)
    factor, shown = printed_unit(unit, largest)
    for (name, rows), colour in zip(found.curves.items(), [*palette.LINES] * len(found.rows)):
        x, y, error = series(found, rows, key)
        bars = error * factor if np.isfinite(error).any() else None
        ax.errorbar(x, y * factor, bars, fmt="o-", color=colour, label=name or None, **palette.BARS)
        unknown_errors.draw(ax, x, y * factor, error)
    ax.set_ylabel(f"{label} ({shown})" if shown else label)
    ax.grid()


def _along(ax, found):
    _, name, _ = axis(found.study.plan, found.across)
    factor, unit = scale(found)
    ax.set_xlabel(f"{name} ({unit})" if unit else name)
    x = np.array([row[axis(found.study.plan, found.across)[0]] * factor for row in found.rows])
    logarithmic_axis.choose_x(ax, x)


def scale(found):
    """(factor, unit) of the axis of a Traction."""
    name, _, unit = axis(found.study.plan, found.across)
    return printed_unit(unit, max(abs(row[name]) for row in found.rows))


def series(found, rows, key):
    """(x, values, error bars) of the rows of a curve with this number; unknown errors are nan (a zero needs none)."""
    having = [row for row in rows if row[key] is not None]
    x = [row[axis(found.study.plan, found.across)[0]] * scale(found)[0] for row in having]
    bars = [row["error"][key] if row["error"][key] is not None else 0.0 if abs(row[key]) < ZERO else np.nan for row in having]
    return np.array(x, float), np.array([row[key] for row in having], float), np.array(bars, float)
