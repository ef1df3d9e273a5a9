"""Warnings about a domain that is too small: sentences from (store, summary)."""

import math

from tehl_taichi.march.accuracy.domain_error import CUT, SIDES
from tehl_taichi.scene import domain
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_warning import with_data

# Of the film: reported always; reported for ends that the user fixed on a grid with smaller errors; a film that is unknown
MUCH, SOME, ALL = 0.01, 3e-3, 1.0


def short(store, summary):
    """Warning if the part of the domain in the error of the film is large, or larger than that of the grid."""
    steady, g = summary.get("steady", {}), store.scene.grid
    parts = steady.get("error_parts", {}).get("h_c_m")
    if not parts or "inlet_gap" not in steady or g.inlet == "starved":
        return
    part, grid = parts["domain"] / steady["h_c_m"] - _by_outlet(steady), (parts["grid"] or 0.0) / steady["h_c_m"]
    if part > MUCH or part > max(grid, SOME) and not summary.get("domain", {}).get("auto"):
        option = domain.farther(store.scene, steady["h_c_m"] / Scales.of(store.scene).h)
        change = f"{part:.1%}" if part <= ALL else "more than 100%, and with this domain the film is not known"
        yield with_data(f"the domain begins at {-g.x_min:g} a, where the gap is {steady['inlet_gap']:.2g} times the film; the "
                        f"oil before it may change the film by {change}{option}", option, part=part)


def cut_off(store, summary):
    """Warning about a film that ruptures behind the end of the domain."""
    scene, part = store.scene, _by_outlet(summary.get("steady", {}))
    if part > SOME:
        option = domain.with_ends(scene, {"x_max": end} if (end := _behind(scene)) else {})
        yield with_data(f"the film ruptures behind the end of the domain (grid.x_max = {scene.grid.x_max:g} a), which may "
                        f"change it by {part:.1%}{option}", option, part=part)


def _by_outlet(steady):
    """Part of the film that an outlet before the rupture may change."""
    return CUT["film"] * steady.get("outlet_slope", 0.0)


def _behind(scene):
    """End of the domain (a) behind the rupture; None if there is none."""
    present = scene.grid.x_max
    return next((end for end in domain.OUTLETS if end > present and end >= domain.outlet(scene)), None)


def starved(store, summary):
    """Warning about an inlet that the scene starves, with the film reduction."""
    lost, g = summary.get("steady", {}).get("inlet_lost", 0.0), store.scene.grid
    if g.inlet == "starved" and lost > MUCH:
        yield (f"grid.inlet = starved: the oil begins at {-g.x_min:g} a, which takes about {lost:.0%} of the film of a flooded "
               "inlet")


def near_sides(store, summary):
    """Warning if the sides of a line contact are so near to its features that their part of the errors is large."""
    change, g = summary.get("domain", {}).get("side_change", 0.0), store.scene.grid
    if SIDES * change <= MUCH:
        return
    # the change falls with the square of the distance (1.5 um asperity of the gear: 3.2, 0.8, 0.1 % at 0.5, 1, 3 b)
    y_max = math.ceil(2 * g.y_max * math.sqrt(SIDES * change / MUCH)) / 2
    option = domain.with_ends(store.scene, {"y_max": y_max})
    yield with_data(f"the features change the film at the sides of the domain (grid.y_max = {g.y_max:g} b) by {change:.1%}; "
                    f"the sides may change the numbers of the passage by {SIDES * change:.1%}{option}", option,
                    part=SIDES * change)
