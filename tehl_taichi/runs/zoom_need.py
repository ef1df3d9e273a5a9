"""Need of a finished run for a fine window, and the factors to try."""

from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.march.zoom.window import windows_of
from tehl_taichi.scene import resolution, zoom_room

FACTORS = 4, 8  # of windows to try in turn; a window of half the factor runs with each, for the error bars
# Time per node and step of a window over that of a run with its fatigue: gear with temperatures, 256x64, factor 4, two threads:
# at SRR 0.12 85 s for 24 s without it (1.2), at -0.12, the whole passage, 161 for 24 (0.9)
SLOWER = 1.2
DECIDING = {"p_max_Pa": "the largest pressure", "h_min_m": "the smallest film"}  # numbers whose error a window may determine


def factors(run):
    """Factors of windows to try, in this order; () if the grid of the run resolves features and pressures."""
    return FACTORS if reason(run) else ()


def reason(run):
    """Text why a run needs a window; "" if it needs none."""
    if few := few_cells(run.scene):
        return f"a feature of {few[0]:.2g} cells"
    if (place := until(run.store)) is not None:
        return f"pressure peaks of a few cells behind {place:.2f} a"
    errors = run.summary["transient"].get("error", {})
    unknown = [words for key, words in DECIDING.items() if key in errors and errors[key] is None]
    return f"the error of {unknown[0]} is not known" if unknown and any(errors.values()) else ""


def work(store, factor):
    """Estimated time of a run with windows of this factor and of half of it, over the time of the run without them."""
    from tehl_taichi.march.zoom.zoomed_passage import begin_of

    scene, (first, end) = store.scene, store.scene.path
    part = min((end - begin_of(scene, begin(store))) / (end - first), 1.0)
    cells = scene.grid.nx * max(scene.rows, 1)
    windows = [window for one in levels(factor) for window in windows_of(scene, one)]
    return 1.0 + part * SLOWER * sum(w.factor * w.nx * max(w.ny, 1) for w in windows) / cells


def levels(factor):
    """Factors of the windows of a run: half the factor (for the error bars; omitted if 1), and the factor."""
    return [one for one in (factor // 2, factor) if one > 1]


def until(store):
    """Position (a) of the feature up to which a run needs no window; None if it needs one everywhere, or nowhere."""
    return None if few_cells(store.scene) else coarse_runs.resolved(store.scene, store, store.scalar)


def begin(store):
    """Position (a) of the feature shortly before which windows begin; None: with the passage.

    The inlet determines the film under a feature: the window must see a hollow take oil in, and whatever has too few cells of
    the run for a sure film.
    """
    sure = all(sight.cells >= resolution.SURE for sight in resolution.sights(store.scene))
    return until(store) if sure and not zoom_room.holds_oil(store.scene) else None


def few_cells(scene):
    """Numbers of cells across the features that have too few of them for an error below 5 %."""
    return [sight.cells for sight in resolution.sights(scene) if sight.cells < resolution.ENOUGH]


def settled(run):
    """Whether the error of the largest pressure is known in a run with a window."""
    return run.summary["transient"]["error"].get("p_max_Pa") is not None
