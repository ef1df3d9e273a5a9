"""Arrays of a :class:`tehl_taichi.fatigue.search_result.SearchResult`: {name of its field: array}."""

import numpy as np

from tehl_taichi.values.arrays import nearest_index


def of_surface(surface, passage, limit, counts):
    """Arrays of all points of the surface; limit: sigma_eF, Pa; counts: see
    :func:`tehl_taichi.fatigue.index_statistics.weights`."""
    return {"feature_frame_x": passage.x, "feature_frame_y": passage.y, "findley_stress": surface.f, "Fi": surface.f / limit,
            "sigma1_max": surface.sigma1, "plane_theta": surface.theta, "plane_phi": surface.phi,
            "passed": counts}


def of_plane(plane, strength):
    """Arrays of the subsurface plane that was searched at all points."""
    return {"worst_depth": np.array([plane.depth]), "findley_stress_at_worst_depth": plane.f,
            "limit_at_worst_depth": limits(strength, [plane.depth])}


def of_layers(layers, strength):
    """Arrays of all points at every listed depth."""
    depths = np.array([layer.depth for layer in layers])
    return {"fatigue_depth": depths, "findley_stress_at_depth": at_depths(layers), "limit_at_depth": limits(strength, depths)}


def limits(strength, depths):
    """Limits sigma_eF (Pa) at depths (m), None without a table."""
    return None if strength.table is None else np.array(strength.limits(depths))


def at_depths(layers):
    """Findley stress (depth, x, y) of layers."""
    return np.stack([layer.f for layer in layers])


def under_row(f, passage, profiles):
    """Findley stress (depth, x, y) below the row of the critical point; f (nx, rows): that of the surface, the first depth."""
    under = max(profiles, key=lambda profile: profile.worst.f)
    row = f[:, [nearest_index(passage.y, under.worst.y)]].T
    return np.concatenate([row, under.f])


def of_profiles(f, passage, profiles, listed):
    """Arrays over depth below the row of the critical point; f: as in :func:`under_row`; listed: other depths are listed."""
    depths = np.append(0.0, profiles[0].depths)
    return {"under_row_depth" if listed else "fatigue_depth": depths, "limit_under_row": limits(passage.strength, depths),
            "findley_stress_under_row": under_row(f, passage, profiles)}
