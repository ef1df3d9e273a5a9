"""Figure of a run-in: heights along the middle before and after, residual stress below them, changes by passage."""

from tehl_taichi.view.figures import palette, run_in_data
from tehl_taichi.view.figures.map_panels import bar, shade


def run_in(page, moments):
    """Figure of the bodies whose steel flowed, in their planes y = 0 (or the row next to it)."""
    scene, state = moments.store.scene, moments.store.run_in
    found = run_in_data.profiles(scene, state)
    figure, axes = page.figure(2 * len(found), 2)
    largest = max(one.largest for one in found) / 1e6
    for own, above, below in zip(found, axes[::2], axes[1::2]):
        _heights(above[0], own)
        image = _stresses(below, own, largest)
    _changes(axes[0, 1], state.records)
    if len(found) > 1:
        _strains(axes[2, 1], run_in_data.added_strains(found, state.records), state.records)
    bar(figure, image, list(axes[1::2].ravel()), "MPa")
    page.title(figure, run_in_data.title(scene, state, found))
    return figure


def _heights(ax, found):
    """Draw the heights of a surface's features before and after."""
    for values, label in ((found.before, "before"), (found.after, "after run-in")):
        ax.plot(found.x * 1e6, values * 1e6, label=label)
    ax.set(title=f"surface {found.body}", xlabel="x′ (µm)", ylabel="height (µm)")
    ax.legend()
    ax.grid()


def _stresses(axes, found, largest):
    """Draw the residual stresses of a body over its depth; the last image."""
    for ax, (words, stress) in zip(axes, found.residual.items()):
        image = shade(ax, found.x * 1e6, found.depths * 1e6, stress / 1e6, cmap=palette.RESULT, vmin=-largest, vmax=largest)
        ax.set(title=f"body {found.body}: residual {words}", xlabel="x′ (µm)", ylabel="depth (µm)")
        ax.invert_yaxis()
    return image


def _changes(ax, records):
    """Draw the surface change by each passage, and by the repeated assessed passage, if any."""
    numbers = [one["passage"] for one in records]
    ax.bar(numbers, [one["surface_change_m"] * 1e9 for one in records], width=0.6,
           color=[palette.GREY if one["judged"] else palette.BLUE for one in records])
    ax.set(xlabel="passage (grey: judged)", xticks=numbers, ylabel="surface change (nm)")


def _strains(ax, strains, records):
    """Draw the plastic strain that each passage adds to each body."""
    numbers, width = [one["passage"] for one in records], 0.6 / len(strains)
    for place, (body, added) in enumerate(strains.items()):
        shift = (place - (len(strains) - 1) / 2) * width
        ax.bar([n + shift for n in numbers], [100 * one for one in added], width, label=f"body {body}")
    ax.set(xlabel="passage (the last one is judged)", xticks=numbers, ylabel="plastic strain added (%)")
    ax.legend()
