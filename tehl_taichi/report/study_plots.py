"""Figures of a study's results over its swept keys."""

import numpy as np

from tehl_taichi.report.plots import colour, field_map, line, marks, stack
from tehl_taichi.runs.sweep.study_figures import axis_values, curve_keys, curve_rows, numeric, with_errors
from tehl_taichi.runs.sweep.study_labels import label_with_value, name_and_unit
from tehl_taichi.runs.sweep.summary_columns import usual_columns
from tehl_taichi.view.figures.palette import RESULT

MOST_LINES = 12
LONGEST = 30  # letters of the title of an upright axis


def figures(study):
    """Figures of each usual result: lines over one key and a map over two, or points if the cases form no grid."""
    out = []
    for name in usual_columns(study.values):
        if study.plan.gridded and len(study.plan.dims) <= 2:
            out += [_lines(study, name), *([_map(study, name)] if len(study.plan.dims) == 2 else [])]
        else:
            out += [_points(study, name, key) for key in study.plan.keys]
    return out


def column(study, name):
    """(values in a printed unit, label) of a column of the table."""
    values, _, label = with_errors(study, name)
    return values, label


def _lines(study, name):
    """Figure over one key, a line for each value of the other key (some if there are many)."""
    values, errors, label = with_errors(study, name)
    first = curve_keys(study)[0]
    x, x_label, words = axis_values(study, first)
    rows, bars, seconds = curve_rows(study, values), curve_rows(study, errors), _seconds(study, label)
    shown = np.unique(np.linspace(0, len(rows) - 1, min(len(rows), MOST_LINES)).astype(int))
    traces = [line(x, rows[n], seconds[n], colour(k), in_legend=len(rows) > 1, mode="lines+markers", **_bars(bars[n]))
              for k, n in enumerate(shown)]
    return stack(f"{name}-lines", f"{label}, over {x_label}.", x_label, [(_title(label), traces, {})],
                 _ticks(x, words, numeric(study, first)), height=400)


def _title(label):
    """Title of a vertical axis: only the unit if the label is too long; the caption has both."""
    return label if len(label) <= LONGEST or not name_and_unit(label)[1] else name_and_unit(label)[1]


def _bars(errors):
    """Error bars of a trace; {} if none is known."""
    if not np.isfinite(errors).any():
        return {}
    return {"error_y": {"type": "data", "array": [None if np.isnan(one) else one for one in errors.tolist()], "thickness": 1}}


def _seconds(study, label):
    """Names of the lines."""
    if len(study.plan.keys) == 1:
        return [label]
    _, second, words = axis_values(study, curve_keys(study)[1])
    return [label_with_value(second, word) for word in words]


def _map(study, name):
    """Map over two keys, one cell per case."""
    values, label = column(study, name)
    (x, x_label, x_words), (y, y_label, y_words) = (axis_values(study, key) for key in study.plan.keys)
    places = np.arange(len(x), dtype=float), np.arange(len(y), dtype=float)
    made = field_map(f"{name}-map", f"{label}: one cell per case, empty without a result.", *places,
                     values.reshape(study.plan.shape), RESULT, label, x_label, y_label, true=False, height=400, zsmooth=False)
    made.layout["xaxis"] |= _ticks(places[0], x_words, False)
    made.layout["yaxis"] |= _ticks(places[1], y_words, False)
    return made


def _points(study, name, key):
    """Figure of all cases over one key."""
    values, errors, label = with_errors(study, name)
    x, x_label, words = axis_values(study, key, per_case=True)
    dots = marks(x, values, label, colour(0), symbol="circle", showlegend=False, **_bars(errors))
    dots["marker"] |= {"size": 6, "line": {"width": 0}}
    return stack(f"{name}-{key}", f"{label} of all cases against {x_label}.", x_label, [(_title(label), [dots], {})],
                 _ticks(x, words, numeric(study, key)), height=330)


def _ticks(x, words, numbers):
    """Ticks of an axis of words."""
    places = dict(zip(np.asarray(x).tolist(), words))
    return {} if numbers else {"tickvals": list(places), "ticktext": list(places.values())}
