"""Figures of a study (matplotlib, the `plot` extra): a result over one or two swept keys, and Fi over the film."""

import itertools
from functools import partial

import numpy as np

from tehl_taichi.errors import StoreError
from tehl_taichi.runs.sweep.axis_syntax import all_numbers, word
from tehl_taichi.runs.sweep.main_effects import main_effects
from tehl_taichi.runs.sweep.study_labels import column_name, key_name, of_column, of_key
from tehl_taichi.runs.sweep.summary_columns import JUDGED, error_of, usual_columns
from tehl_taichi.values.checks import known_names, nearest
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.digits import part_of
from tehl_taichi.view.figures import logarithmic_axis, palette, unknown_errors
from tehl_taichi.view.figures.figure_style import FigureStyle, import_matplotlib
from tehl_taichi.view.figures.map_panels import bar

FILM = "transient_h_min_m"
TOLD = 120  # cells of a map with their values in them
TICKS = 12
EVEN = 1e-3  # of a step: ranges on a screen have four digits
HIGH = 1.7  # rows of lines: height of a figure with one panel


def write_all(study, folder, quantity=None, page=None):
    """Write the figures of a study into `folder`; returns the paths.

    quantity: a column of its table (None: the usual ones); page: a :class:`FigureStyle`. Raises StoreError for an unknown
    column, or if there is nothing to draw.
    """
    chosen = [_known(study, quantity)] if quantity else usual_columns(study.values)
    if not chosen:
        raise StoreError(f"{study.path} has no result to draw yet")
    page = page or FigureStyle()
    return page.write(folder, {name: partial(draw, page, study, *of) for name, draw, *of in _figures(study, chosen)})


def _figures(study, chosen):
    """Generator of (name, function that draws it, its quantity)."""
    for name in chosen:
        if study.plan.gridded and len(study.plan.dims) <= 2:
            yield f"{name}_lines", lines, name
            if len(study.plan.dims) == 2:
                yield f"{name}_map", heat_map, name
        else:
            yield f"{name}_points", points, name
    if JUDGED in chosen and FILM in study.values:
        yield "Fi_over_h_min", index_over_film


def _known(study, quantity):
    """The name of a column. Raises StoreError for another name."""
    if not study.values:
        raise StoreError(f"{study.path} has no column {shown(quantity)}: it has no results yet")
    if not (isinstance(quantity, str) and quantity in study.values):
        raise StoreError(f"{study.path} has no column {shown(quantity)}{nearest(quantity, study.values)}; "
                         f"{known_names(study.values, f'first line of {study.table}')}")
    return quantity


def curve_keys(study):
    """Keys of a study with one or two keys: first the key of the axis (more values; numbers before words), then the key of the
    lines.
    """
    return sorted(study.plan.keys, key=lambda key: (not numeric(study, key), -len(study.plan.coordinate(key)[1])))


def curve_rows(study, values):
    """Values of all cases with one row per line, along the key of the axis."""
    found = values.reshape(study.plan.shape) if len(study.plan.keys) > 1 else values[:, None]
    return found.T if curve_keys(study)[0] == study.plan.keys[0] else found


def lines(page, study, name):
    """Figure of the quantity with its error over one key, a line for each value of the other key."""
    values, errors, label = with_errors(study, name)
    values, errors = curve_rows(study, values), curve_rows(study, errors)
    figure, ((ax,),) = page.figure(height=HIGH * page.row())
    first, *others = curve_keys(study)
    x, x_label, ticks = axis_values(study, first)
    second = axis_values(study, others[0]) if others else None
    colours = import_matplotlib().colormaps[palette.RESULT](np.linspace(0.0, 0.9, len(values)))
    for n, (row, bars) in enumerate(zip(values, errors)):
        ax.errorbar(x, row, bars, fmt="o-", color=colours[n], label=second and second[2][n], **palette.BARS)
        unknown_errors.draw(ax, x, row, bars)
    if second:
        page.legend(figure, title=second[1])
    _dress(ax, x_label, x, ticks, numeric(study, first))
    ax.set_ylabel(label)
    page.title(figure, f"{study.plan.scene.name}: {column_name(name)}{unknown_errors.words(values, errors)}")
    return figure


def heat_map(page, study, name):
    """Figure of the quantity over two keys, an equal cell per case; cases without a result are hatched."""
    values, _, label = with_errors(study, name)
    values = values.reshape(study.plan.shape).T
    figure, ((ax,),) = page.figure(height=HIGH * page.row())
    ax.set_facecolor(palette.SHADE)
    ax.patch.set_hatch("//")
    image = ax.imshow(values, origin="lower", aspect="auto", cmap=palette.RESULT)
    bar(figure, image, ax, label)
    for axis, key, at in zip("xy", study.plan.keys, (ax.xaxis, ax.yaxis)):
        x, key_label, ticks = axis_values(study, key)
        shown = range(0, len(ticks), -(-len(ticks) // (TICKS // 2 if page.narrow else TICKS)))
        at.set_ticks(list(shown), [ticks[n] for n in shown])
        ax.set(**{f"{axis}label": key_label + ("" if _even(x) else ", not to scale")})
    if values.size <= TOLD and 3 * values.shape[1] * page.text < 47 * page.inches:
        _write_values(ax, values)
    missing = " (hatched: no result)" if np.isnan(values).any() else ""
    page.title(figure, f"{study.plan.scene.name}: {column_name(name)}{missing}")
    return figure


def _even(x):
    """Whether numbers are evenly spaced."""
    steps = np.diff(x)
    return steps.size < 2 or np.allclose(steps, steps[0], rtol=EVEN, atol=0.0)


def _write_values(ax, values):
    """Write the value into each cell, in a contrasting colour."""
    middle = 0.5 * (np.nanmin(values) + np.nanmax(values))
    for (row, column), value in np.ndenumerate(values):
        if np.isfinite(value):
            ax.text(column, row, f"{value:.3g}", ha="center", va="center", fontsize="small",
                    color="white" if value < middle else palette.BLACK)


def points(page, study, name):
    """Figure of the quantity of all cases with its error over each key, with the share of the spread due to it."""
    values, errors, label = with_errors(study, name)
    keys, effects = study.plan.keys, main_effects(study, name)
    most = 1 if page.narrow else 3
    rows, columns = -(-len(keys) // most), min(most, len(keys))
    figure, axes = page.figure(rows, columns, (1.35 if effects.shares else 1.2) * page.row(columns) * rows, sharey=True)
    for ax, key in itertools.zip_longest(axes.flat, keys):
        if key is None:
            ax.set_visible(False)
            continue
        x, x_label, ticks = axis_values(study, key, per_case=True)
        ax.errorbar(x, values, errors, fmt="o", alpha=0.7, **palette.BARS)
        unknown_errors.draw(ax, x, values, errors)
        _dress(ax, x_label, x, ticks, numeric(study, key))
        ax.set_title(effects.words(key), fontsize="small")
        if ax.get_xscale() == "linear" and numeric(study, key):
            ax.locator_params(axis="x", nbins=5)
    for ax in axes[:, 0]:
        ax.set_ylabel(label)
    page.title(figure, f"{study.plan.scene.name}: {column_name(name)}{unknown_errors.words(values, errors)}")
    return figure


def index_over_film(page, study):
    """Figure of Fi of every case over the minimum film of its passage, both with errors, coloured by the first key."""
    film, film_error, film_label = with_errors(study, FILM)
    Fi, Fi_error, _ = with_errors(study, JUDGED)
    key = study.plan.keys[0]
    colour, colour_label, ticks = axis_values(study, key, per_case=True)
    figure, ((ax,),) = page.figure(height=HIGH * page.row())
    ax.errorbar(film, Fi, Fi_error, film_error, fmt="none", ecolor=palette.GREY, **palette.BARS)
    drawn = ax.scatter(film, Fi, c=colour, cmap=palette.RESULT, s=0.3 * page.text**2, zorder=3)
    unknown_errors.draw(ax, film, Fi, Fi_error)
    scale = bar(figure, drawn, ax, colour_label)
    if not numeric(study, key):
        places = dict(zip(colour.tolist(), ticks))
        scale.set_ticks(list(places), labels=list(places.values()))
    ax.axhline(1.0, color=palette.GREY, ls="--")
    ax.set(xlabel=film_label, ylabel="Fi judged")
    ax.grid()
    hollow = unknown_errors.words(Fi, Fi_error)
    page.title(figure, f"{study.plan.scene.name}: Fi over the smallest film, {_count(study)}{hollow}")
    return figure


def _count(study):
    return part_of(int(np.isfinite(study.values[JUDGED]).sum()), len(study), "case")


def _dress(ax, x_label, x, ticks, in_numbers):
    ax.set(xlabel=x_label)
    ax.grid()
    if not in_numbers:
        places = dict(zip(x.tolist(), ticks))
        ax.set_xticks(list(places), list(places.values()))
    else:
        logarithmic_axis.choose_x(ax, x)


def numeric(study, key):
    return all_numbers(study.plan.coordinate(key)[1])


def axis_values(study, key, per_case=False):
    """(numbers along a key, its label with unit, texts of the numbers); words are at 0, 1, 2 ..."""
    values = [study.plan.changes(n)[key] for n in range(len(study))] if per_case else study.plan.coordinate(key)[1]
    if not numeric(study, key):
        known = list(dict.fromkeys(map(word, study.plan.coordinate(key)[1])))
        words = [word(value) for value in values]
        return np.array([known.index(one) for one in words], float), key_name(key), words
    numbers = np.array(values, float)
    factor, label = of_key(study.plan.scene, key, largest(numbers))
    found = numbers * factor
    return found, label, [f"{value:.4g}" for value in found]


def with_errors(study, name):
    """(values of a column, their error bars, label), in the printed unit; unknown bars are nan."""
    values, errors = study.values[name], study.values.get(error_of(name), np.full(len(study), np.nan))
    factor, label = of_column(name, largest(values))
    return values * factor, errors * factor, label


def largest(values):
    """Largest absolute number, 0 without any."""
    return float(np.nanmax(np.abs(values))) if np.isfinite(values).any() else 0.0
