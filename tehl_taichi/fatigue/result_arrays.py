"""Arrays of a :class:`tehl_taichi.fatigue.search_result.SearchResult`: {name of its field: array}."""

import numpy as np

from tehl_taichi.fatigue import local_strength


def of_surface(surface, passage, limit, counts):
    """Arrays of all points of the surface; limit: sigma_eF, Pa; counts: see
    :func:`tehl_taichi.fatigue.index_statistics.weights`."""
    return {"feature_frame_x": passage.x, "feature_frame_y": passage.y, "findley_stress": surface.f, "Fi": surface.f / limit,
            "sigma1_max": surface.sigma1, "plane_theta": surface.theta, "plane_phi": surface.phi,
            "passed": counts}


def of_plane(plane):
    """Arrays of the subsurface plane that was searched at all points."""
    return {"worst_depth": np.array([plane.depth]), "findley_stress_at_worst_depth": plane.f}


def of_layers(layers):
    """Arrays of all points at every listed depth."""
    return {"fatigue_depth": np.array([layer.depth for layer in layers]),
            "findley_stress_at_depth": at_depths(layers)}


def of_limits(strength, depths, plane, layers):
    """Fatigue limits at the depths of the stresses: below rows (the surface, then depths in m), of the plane (or None), of
    listed layers; {} without a table.
    """
    if strength.table is None:
        return {}
    found = {"limit_under_row": local_strength.limits(strength, [0.0, *depths])}
    found |= of_limit(strength, plane) if plane else {}
    if len(layers) > 1:
        found["limit_at_depth"] = local_strength.limits(strength, [layer.depth for layer in layers])
    return found


def of_limit(strength, plane):
    """Fatigue limit of a plane; {} without a table."""
    found = local_strength.limits(strength, [plane.depth])
    return {} if found is None else {"limit_at_worst_depth": found}


def at_depths(layers):
    """Findley stress (depth, x, y) of layers."""
    return np.stack([layer.f for layer in layers])


def under_row(f, passage, profiles):
    """Findley stress (depth, x, y) below the row of the critical point; f (nx, rows): that of the surface, the first depth."""
    under = max(profiles, key=lambda profile: profile.worst.f)
    row = f[:, [int(np.argmin(np.abs(passage.y - under.worst.y)))]].T
    return np.concatenate([row, under.f])


def of_profiles(f, passage, profiles, listed):
    """Arrays over depth below the row of the critical point; f: as in :func:`under_row`; listed: other depths are listed."""
    return {"under_row_depth" if listed else "fatigue_depth": np.append(0.0, profiles[0].depths),
            "findley_stress_under_row": under_row(f, passage, profiles)}
