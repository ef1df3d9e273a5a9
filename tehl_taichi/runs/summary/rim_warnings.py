"""Warnings about worst points at the rim of a measured map: the rim may cause them."""

from tehl_taichi.fatigue.judged_surfaces import by_surface
from tehl_taichi.fatigue.pressure_alone import searched
from tehl_taichi.scene.feature_wording import feature_word
from tehl_taichi.scene.scales import Scales

NEAR = 2  # cells of the grid: so near to an edge that a stress is of both its sides


def rims(store, summary):
    """One sentence for every worst point at the rim of a map on its body, each place once; the resolved part first."""
    seen, searches = set(), by_surface(summary)
    for name, found in ((name, searched(one)) for name, one in searches.items()):
        surface = f"surface {name}" if len(searches) > 1 else "the surface"
        for part, of in ((found.get("resolved", {}), " of the resolved part"), (found, "")):
            for point, where in ((part, f"at {surface}"), (part.get("below", {}), f"below {surface}")):
                place = point.get("x_m"), point.get("y_m"), where
                if None not in place and place not in seen:
                    yield from _of_point(store.scene, name, point, f"the critical point {where}{of}")
                seen.add(place)


def _of_point(scene, surface, point, name):
    near = NEAR * max(Scales.of(scene).cell(scene.grid))
    for f in (f for f in scene.features if f.kind.measured and f.surface == surface):
        distance, axis = min(zip(f.to_rim(point["x_m"] - f.x, point["y_m"] - f.y), "xy"))
        if -near <= distance <= max(f.taper, near):
            yield f"{name} lies {_side(f, distance, feature_word(scene))}; {_advice(f, axis)}"


def _side(f, distance, whose):
    """Text of the distance from the rim, and of the surface beyond it."""
    rim = f"{abs(distance) * 1e6:.0f} um {'inside' if distance >= 0 else 'outside'} the rim along which the {whose} ends"
    if 0 <= distance <= f.taper:
        return (f"{rim}, within its taper of {f.taper * 1e6:.3g} um: the heights fade out there, so its index is not that of "
                "the surface")
    taper = f"after a taper of {f.taper * 1e6:.3g} um" if f.taper else "in a step, without a taper"
    return f"{rim}, {taper}: its index may be caused by the edge"


def _advice(f, axis):
    """Advice to move the rim away: a wider patch, if the file has one."""
    n = "xy".index(axis)
    if f.patch[n] < f.size[n] * (1 - 1e-9):
        return f"a larger feature.extent_{axis} moves the rim away (the file has {f.size[n] * 1e3:.3g} mm)"
    return f"the file ends there; use a scan that is longer along {axis}"
