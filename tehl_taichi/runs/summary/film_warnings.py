"""Warnings about the film and the pressure of a stored run: friction, peaks and ripples; functions of (store, summary) that
return sentences.
"""

import numpy as np

from tehl_taichi.fatigue.pressure_alone import searched
from tehl_taichi.march.accuracy import readings
from tehl_taichi.march.accuracy.peaks import ripple, sharpest
from tehl_taichi.scene import refinement
from tehl_taichi.scene.feature_wording import position_word
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_text import Option, code_of
from tehl_taichi.values.coded_warning import with_data
from tehl_taichi.values.summary_values import error_of

MOST_FRICTION = 0.2  # of a film: no oil is known to carry more than about 0.12 of the pressure, traction fluids included
MOST_RIPPLE = 0.005  # of the largest pressure: a tenth of what a passing feature changes, ten times what resolved passages show
# reasons of unknown errors that a finer grid may remove; "alone": it has a coarser one
FINER = "touch", "changes", "place", "peak", "value", "rival", "alone"
NO_VALUE = Option("oil without a shear limit has no finite value here; use --thermal or a limiting law (rheology.law)",
                  "oil without a shear limit has no finite value here; temperatures or a limiting law would give one")


def too_much_friction(store):
    """["when value", ...] where the friction coefficient of the film exceeds that of any oil.

    The value is a lower bound, because solid contact has at most the coefficient that the scene gives it.
    """
    film = store.scalar("friction_coefficient") - store.scene.rheology.mu_boundary * store.scalar("contact_load_fraction")
    parts = ("steady", slice(0, 1)), ("in the passage up to", slice(1, None))
    return [f"{when} {film[part].max():.3g}" for when, part in parts if film[part].size and film[part].max() > MOST_FRICTION]


def no_index(store):
    """Reason why the tractions of a run give no fatigue index, "" if they give one."""
    found = too_much_friction(store)
    return (f"the friction coefficient of the film ({', '.join(found)}) is more than {MOST_FRICTION:g}, which no oil reaches"
            if found else "")


def friction(store, summary):
    """Warning about shear beyond that of any oil."""
    rheology, found = store.scene.rheology, too_much_friction(store)
    if found:
        law = (f"a Newtonian film (rheology.law = {rheology.law}) has no limit; its film is valid, its friction is not"
               if not rheology.thins else f"the constants of the law {rheology.law!r} allow this")
        text = f"the friction coefficient ({', '.join(found)}) is more than {MOST_FRICTION:g}, which no oil reaches: {law}"
        most = float(store.scalar("friction_coefficient").max())
        yield with_data(text + _follow(store.scene, summary), friction_coefficient_max=most, limit=MOST_FRICTION)


def _follow(scene, summary):
    """Text of the consequence of such a shear stress: it loads the surface and heats the film."""
    effects = ["the fatigue index is that of the pressure alone"] * ("fatigue" in summary and scene.fatigue.shear)
    effects += ["the temperatures that follow have no meaning"] * (not scene.isothermal)
    return f"; {' and '.join(effects)}" if effects else ""


def unresolved(store, summary):
    """Warnings about unresolved peaks of the steady state, and of the moment with the largest pressure of the passage, unless a
    sequence of grids resolves it.
    """
    known = error_of(summary, "transient", "p_max_Pa") is not None
    for n in dict.fromkeys((0,) if known else (0, int(np.argmax(store.scalar("p_max_Pa"))))):
        p = store.fields(n, ("pressure",))["pressure"]
        height, (i, _) = sharpest(p)
        if height >= 1.0:  # lower peaks show in the error bars, which are unknown then
            at_exit, remedy = readings.is_at_exit(store.x[i], Scales.of(store.scene).a), _remedy(store, i)
            yield with_data(readings.EXIT * at_exit + _where(store, n, p, i) + _because(store, i, remedy), remedy,
                            p_max_Pa=float(p.max()), x_m=float(store.x[i]), entry=int(n))


def first_unresolved(store, summary):
    """Warning about the end of the resolved part of a passage, if it is before the outlet, which the error bars cover."""
    part, a = searched(summary.get("fatigue", {})).get("resolved"), Scales.of(store.scene).a
    later = [n for n in range(1, len(store)) if part and store.feature_x(n) > (part["to_x_a"] + 1e-9) * a]
    if later:
        p = store.fields(later[0], ("pressure",))["pressure"]
        height, (i, row) = sharpest(p, store.scalar("p_max_Pa").max())
        if height and not readings.is_at_exit(store.x[i], a):
            at = f"X = {store.x[i] / a:.2f}, y = {store.y[row] * 1e6:.0f} um"
            grid = refinement.finer_grid_option(store.scene)
            yield with_data(f"the resolved part of the passage ends before the {_moment(store, later[0])}: its pressure peak "
                            f"of {p[i, row] / 1e9:.2f} GPa at {at} is only a few cells wide; a finer grid may resolve it: "
                            f"{grid}", grid, p_Pa=float(p[i, row]), x_m=float(store.x[i]), y_m=float(store.y[row]))


def _where(store, n, p, i):
    when = f"of the passage ({_moment(store, n)})" if n else "of the steady state"
    return f"p_max {p.max() / 1e9:.2f} GPa {when}, at X = {store.x[i] / Scales.of(store.scene).a:.2f}, is only a few cells wide"


def _moment(store, n):
    return f"{position_word(store.scene)} at {store.feature_x(n) / Scales.of(store.scene).a:.2f} a"


def _remedy(store, i):
    """Option that may resolve a peak at node i."""
    if store.x[i] > 0 and _endless(store.scene):
        return NO_VALUE
    at_exit = readings.is_at_exit(store.x[i], Scales.of(store.scene).a)
    return refinement.finer_along_option(store.scene) if at_exit else refinement.finer_grid_option(store.scene)


def _because(store, i, remedy):
    """Text of the reason for an unresolved outlet: the frozen film ends in a free edge, a 1/sqrt singularity that only a shear
    limit bounds.
    """
    endless = store.x[i] > 0 and _endless(store.scene)
    return f" and grows like 1/sqrt(cell); {remedy}" if endless else f"; a finer grid may resolve it: {remedy}"


def finer_grid(scene, why):
    """Grid to try if an error is unknown for this Reason, of an exit with cells along x only; "" if no grid helps."""
    if code_of(why) in FINER:
        return refinement.finer_grid_option(scene)
    helps = code_of(why) == "exit" and scene.transient and not _endless(scene)
    return refinement.finer_along_option(scene) if helps else ""


def _endless(scene):
    """Whether the pressure at a free edge of frozen oil is unbounded."""
    return scene.isothermal and not scene.rheology.thins


def worst_ripple(store, entries):
    """((Pa, node), entry) of the largest :func:`tehl_taichi.march.accuracy.peaks.ripple` of the pressure among these
    entries.
    """
    return max((ripple(store.fields(n, ("pressure",))["pressure"]), n) for n in entries)


def ripples(store, summary):
    """Warnings about ripples from node to node along x, at any moment."""
    numbers = ("steady", "ripple_Pa"), ("transient", "ripple_max_Pa")
    size = max(summary.get(part, {}).get(name, 0.0) for part, name in numbers)
    if size > MOST_RIPPLE * float(store.scalar("p_max_Pa").max()):
        (_, i), n = worst_ripple(store, range(len(store)))
        a, at_edge = Scales.of(store.scene).a, bool(store.x[i] > 0) and _endless(store.scene)
        when = f"{_moment(store, n)}, " if n else ""
        text = (f"{readings.EXIT * at_edge}the pressure ripples from node to node along x by up to {size / 1e9:.3f} "
                f"GPa ({when}X = {store.x[i] / a:.2f}), an artefact of the grid; ")
        grid = refinement.finer_grid_option(store.scene)
        remedy = NO_VALUE if at_edge else f"try another time.courant or {grid}"
        yield with_data(text + remedy, NO_VALUE if at_edge else grid, ripple_Pa=size, x_m=float(store.x[i]), entry=int(n))


CHECKS = {friction: "friction", unresolved: "peak", first_unresolved: "resolved", ripples: "ripple"}
