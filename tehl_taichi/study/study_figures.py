"""PNG figures of a study (matplotlib, the `plot` extra): a result over one swept key or two, and Fi against the film."""

import itertools

import numpy as np

from tehl_taichi.errors import StoreError
from tehl_taichi.figures.run_figures import made, pyplot
from tehl_taichi.study.flat import unit_of
from tehl_taichi.study.plan import unit
from tehl_taichi.study.table import all_numbers, word
from tehl_taichi.values.checks import nearest

# drawn where nobody chooses: the first of each line that the study has
USUAL = (("fatigue_Fi_max",), ("transient_h_min_m", "steady_h_c_m"), ("transient_p_max_Pa", "steady_p_max_Pa"))
INDEX, FILM = "fatigue_Fi_max", "transient_h_min_m"
SCALES = {"m": ((1e-3, 1e6, "µm"), (1.0, 1e3, "mm")), "Pa": ((1e9, 1e-6, "MPa"), (np.inf, 1e-9, "GPa"))}
TOLD = 120  # cells of a map with their values in them
TICKS = 12
DPI = 160


def write_all(study, folder, quantity=None, dpi=DPI):
    """Write the figures of a study into `folder`, of one quantity (a column of its table) or of the usual ones; returns the
    paths. Raises StoreError where there is no such column, or nothing to draw."""
    chosen = [_known(study, quantity)] if quantity else usual(study)
    if not chosen:
        raise StoreError(f"{study.path} has no result to draw yet")
    plt, folder, paths = pyplot(), made(folder), []
    for name, figure in _figures(plt, study, chosen):
        paths.append(folder / f"{name}.png")
        figure.savefig(paths[-1], dpi=dpi)
        plt.close(figure)
    return paths


def _figures(plt, study, chosen):
    """Generator of (name, figure)."""
    for name in chosen:
        if study.plan.gridded and len(study.plan.dims) <= 2:
            yield f"{name}_lines", lines(plt, study, name)
            if len(study.plan.dims) == 2:
                yield f"{name}_map", heat_map(plt, study, name)
        else:
            yield f"{name}_points", points(plt, study, name)
    if INDEX in chosen and FILM in study.values:
        yield "Fi_over_h_min", index_over_film(plt, study)


def usual(study):
    found = (next((name for name in names if name in study.values), None) for names in USUAL)
    return [name for name in found if name]


def _known(study, quantity):
    if quantity not in study.values:
        raise StoreError(f"{study.path} has no column {quantity!r}{nearest(quantity, study.values)}; it has "
                         f"{', '.join(study.values) or 'no results yet'}")
    return quantity


def lines(plt, study, name):
    """The quantity over the first key, a line for each value of the second."""
    values, label = scaled(study.values[name], unit_of(name), name)
    values = values.reshape(study.plan.shape)
    figure, ax = plt.subplots(figsize=(7.2, 4.8), layout="constrained")
    x, x_label, ticks = along(study, study.plan.keys[0])
    second = along(study, study.plan.keys[1]) if len(study.plan.keys) > 1 else None
    colours = plt.get_cmap("viridis")(np.linspace(0.0, 0.9, values.reshape(len(x), -1).shape[1]))
    for n, row in enumerate(values.reshape(len(x), -1).T):
        ax.plot(x, row, "o-", ms=4, color=colours[n], label=second and second[2][n])
    if second:
        figure.legend(title=second[1], frameon=False, loc="outside right upper", fontsize=8)
    _dress(ax, study, name, x_label, x, ticks, numeric(study, study.plan.keys[0]))
    ax.set_ylabel(label)
    return figure


def heat_map(plt, study, name):
    """The quantity over two keys, a cell a case; cases without a result are hatched."""
    values, label = scaled(study.values[name], unit_of(name), name)
    values = values.reshape(study.plan.shape).T
    figure, ax = plt.subplots(figsize=(7.2, 5.2), layout="constrained")
    ax.set_facecolor("0.93")
    ax.patch.set_hatch("//")
    image = ax.imshow(values, origin="lower", aspect="auto", cmap="viridis")
    figure.colorbar(image, label=label)
    for axis, key, at in zip("xy", study.plan.keys, (ax.xaxis, ax.yaxis)):
        _, key_label, ticks = along(study, key)
        shown = range(0, len(ticks), -(-len(ticks) // TICKS))
        at.set_ticks(list(shown), [ticks[n] for n in shown])
        ax.set(**{f"{axis}label": key_label})
    if values.size <= TOLD:
        _tell(ax, values)
    ax.set_title(f"{study.plan.scene.name}: {name}")
    return figure


def _tell(ax, values):
    """Write its value into each cell, light on dark."""
    middle = 0.5 * (np.nanmin(values) + np.nanmax(values))
    for (row, column), value in np.ndenumerate(values):
        if np.isfinite(value):
            ax.text(column, row, f"{value:.3g}", ha="center", va="center", fontsize=8, color="w" if value < middle else "k")


def points(plt, study, name):
    """The quantity of all cases against each key."""
    values, label = scaled(study.values[name], unit_of(name), name)
    keys = study.plan.keys
    rows, columns = -(-len(keys) // 3), min(3, len(keys))
    figure, axes = plt.subplots(rows, columns, figsize=(3.6 * columns + 0.6, 3.4 * rows + 0.4), sharey=True, squeeze=False,
                                layout="constrained")
    for ax, key in itertools.zip_longest(axes.flat, keys):
        if key is None:
            ax.set_visible(False)
            continue
        x, x_label, ticks = along(study, key, per_case=True)
        ax.plot(x, values, "o", ms=4, alpha=0.7)
        _dress(ax, study, "", x_label, x, ticks, numeric(study, key))
    for ax in axes[:, 0]:
        ax.set_ylabel(label)
    figure.suptitle(f"{study.plan.scene.name}: {name}")
    return figure


def index_over_film(plt, study):
    """Fi of every case against the thinnest film of its passage, coloured by the first key."""
    film, film_label = scaled(study.values[FILM], "m", "smallest film of the passage")
    key = study.plan.keys[0]
    colour, colour_label, ticks = along(study, key, per_case=True)
    figure, ax = plt.subplots(figsize=(7.2, 4.8), layout="constrained")
    drawn = ax.scatter(film, study.values[INDEX], c=colour, cmap="viridis", s=28)
    bar = figure.colorbar(drawn, label=colour_label)
    if not numeric(study, key):
        places = dict(zip(colour.tolist(), ticks))
        bar.set_ticks(list(places), labels=list(places.values()))
    ax.axhline(1.0, color="0.5", lw=1, ls="--")
    ax.set(xlabel=film_label, ylabel="fatigue index Fi", title=f"{study.plan.scene.name}: {_count(study)}")
    ax.grid(alpha=0.25)
    return figure


def _count(study):
    return f"{int(np.isfinite(study.values[INDEX]).sum())} of {len(study)} cases"


def _dress(ax, study, name, x_label, x, ticks, numeric):
    ax.set(xlabel=x_label, title=f"{study.plan.scene.name}: {name}" if name else "")
    ax.grid(alpha=0.25)
    if not numeric:
        places = dict(zip(x.tolist(), ticks))
        ax.set_xticks(list(places), list(places.values()))
    elif len(x) > 2 and (x > 0).all() and x.max() > 30 * x.min():
        ax.set_xscale("log")


def numeric(study, key):
    return all_numbers(study.plan.coordinate(key)[1])


def along(study, key, per_case=False):
    """(numbers along a key, its label with unit, the numbers in words); words stand at 0, 1, 2 ..."""
    values = [study.plan.changes(n)[key] for n in range(len(study))] if per_case else study.plan.coordinate(key)[1]
    if not numeric(study, key):
        known = list(dict.fromkeys(map(word, study.plan.coordinate(key)[1])))
        words = [word(value) for value in values]
        return np.array([known.index(one) for one in words], float), key, words
    found, label = scaled(np.array(values, float), unit(study.plan.scene, key), key)
    return found, label, [f"{value:.4g}" for value in found]


def scaled(values, unit_, text):
    """(values in a unit that people read, label)."""
    text = text.removesuffix(f"_{unit_}")  # h_min_m (µm)
    top = np.nanmax(np.abs(values)) if np.isfinite(values).any() else 0.0
    for below, factor, shown in SCALES.get(unit_, ()):
        if top < below:
            return values * factor, f"{text} ({shown})"
    return values, text if unit_ == "1" else f"{text} ({unit_})"
