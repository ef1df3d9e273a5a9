"""Figure of a run-in: heights along the middle before and after, residual stress below them, surface change by passage."""

from tehl_taichi.view.figures import palette, run_in_data
from tehl_taichi.view.figures.map_panels import bar, shade


def run_in(page, moments):
    """Figure of the body whose surface changed most, in its plane y = 0 (or the row next to it)."""
    scene, state = moments.store.scene, moments.store.run_in
    found = run_in_data.profile(scene, state)
    figure, axes = page.figure(2, 2)
    _heights(axes[0, 0], found)
    _passages(axes[0, 1], state.records)
    for ax, (words, stress) in zip(axes[1], found.residual.items()):
        image = shade(ax, found.x * 1e6, found.depths * 1e6, stress / 1e6, cmap=palette.RESULT, vmin=-found.largest / 1e6,
                      vmax=found.largest / 1e6)
        ax.set(title=f"residual {words}", xlabel="x′ (µm)", ylabel="depth (µm)")
        ax.invert_yaxis()
    bar(figure, image, list(axes[1]), "MPa")
    page.title(figure, run_in_data.title(scene, state, found.body))
    return figure


def _heights(ax, found):
    """Draw the heights of a surface's features before and after."""
    for values, label in ((found.before, "before"), (found.after, "after run-in")):
        ax.plot(found.x * 1e6, values * 1e6, label=label)
    ax.set(xlabel="x′ (µm)", ylabel="height (µm)")
    ax.legend()
    ax.grid()


def _passages(ax, records):
    """Draw the surface change by each passage, and by the repeated assessed passage, if any."""
    numbers = [one["passage"] for one in records]
    ax.bar(numbers, [one["surface_change_m"] * 1e9 for one in records], width=0.6,
           color=[palette.GREY if one["judged"] else palette.BLUE for one in records])
    ax.set(xlabel="passage (grey: judged)", xticks=numbers, ylabel="surface change (nm)")
