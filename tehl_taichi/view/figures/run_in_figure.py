"""Figure of a run-in: heights along the middle before and after, residual stress below them, what each passage changed."""

import numpy as np

from tehl_taichi.view.figures import palette
from tehl_taichi.view.figures.field_maps import bar, shade

COMPONENTS = {0: "σ_xx", 1: "σ_yy"}  # of the residual stress, by their place
DEEP = 0.02  # of the largest residual stress: deeper layers have less and are not shown


def run_in(page, moments):
    """The body whose surface changed most, in its plane y = 0 (or the row next to it)."""
    store = moments.store
    state = store.run_in
    name, body = max(state.bodies.items(), key=lambda one: np.abs(one[1].start.sinking).max())
    row, x = int(np.argmin(np.abs(body.y))), body.x * 1e6
    figure, axes = page.figure(2, 2)
    _heights(axes[0, 0], store.scene, name, body, row)
    _passages(axes[0, 1], state.records)
    most = max(np.abs(body.start.residual[:, at, :, row]).max() for at in COMPONENTS) or 1.0
    for ax, (at, words) in zip(axes[1], COMPONENTS.items()):
        stress = body.start.residual[:, at, :, row]
        last = int(np.flatnonzero(np.abs(stress).max(axis=1) >= DEEP * most).max(initial=2))
        image = shade(ax, x, body.depths[: last + 1] * 1e6, stress[: last + 1].T / 1e6, cmap=palette.RESULT, vmin=-most / 1e6,
                      vmax=most / 1e6)
        ax.set(title=f"residual {words}", xlabel="x′ (µm)", ylabel="depth (µm)")
        ax.invert_yaxis()
    bar(figure, image, list(axes[1]), "MPa")
    page.title(figure, f"{store.scene.name}: run-in of body {name}, {_count(state)}")
    return figure


def _count(state):
    count = f"{state.passages} passage{'s' * (state.passages != 1)}"
    return f"{count} before the one that is judged" if state.passages else "no steel yields"


def _heights(ax, scene, name, body, row):
    """Heights of the features of a surface, before and after."""
    features = next(surface for surface in scene.surfaces if surface.name == name).features
    before = sum((f.height_at(body.x - f.x, body.y[row] - f.y) for f in features), np.zeros(body.x.size))
    for values, label in ((before, "before"), (before - body.start.sinking[:, row], "after run-in")):
        ax.plot(body.x * 1e6, values * 1e6, label=label)
    ax.set(xlabel="x′ (µm)", ylabel="height (µm)")
    ax.legend()
    ax.grid()


def _passages(ax, records):
    """Change of the surface by each passage, and by the one that is judged if it came again."""
    numbers = [one["passage"] for one in records]
    ax.bar(numbers, [one["surface_change_m"] * 1e9 for one in records], width=0.6,
           color=[palette.GREY if one["judged"] else palette.BLUE for one in records])
    ax.set(xlabel="passage (grey: judged)", xticks=numbers, ylabel="surface change (nm)")
