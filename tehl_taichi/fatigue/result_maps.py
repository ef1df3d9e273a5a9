"""What a fatigue search leaves as arrays: {name: (values, dimensions, units, text)}, as a store keeps them."""

import numpy as np

BOTH = ["feature_frame_x", "feature_frame_y"]
ALONE = "findley_stress_contact_alone"
DEPTH, ROW_DEPTH = "fatigue_depth", "under_row_depth"  # the depths searched; those under a row, where others are listed


def of_surface(surface, passage, limit):
    """Of all points of the surface; limit: sigma_eF, Pa."""
    return {BOTH[0]: (passage.x, BOTH[:1], "m", "along rolling, from the centre of the feature"),
            BOTH[1]: (passage.y, BOTH[1:], "m", "across, from the centre of the contact"),
            "findley_stress": (surface.f, BOTH, "Pa", "Findley stress"), "Fi": index(surface.f, limit),
            "sigma1_max": (surface.sigma1, BOTH, "Pa", "largest principal stress of the passage"),
            "plane_theta": (surface.theta, BOTH, "degree", "angle of the critical plane's normal from the surface normal"),
            "plane_phi": (surface.phi, BOTH, "degree", "direction of the critical plane's normal in the surface, from x")}


def index(f, limit):
    """Findley stress f (nx, rows) over the fatigue limit, both Pa."""
    return f / limit, BOTH, "1", "Findley index"


def of_history(history, name, of):
    """The history of a worst point."""
    return {f"{name}_x_a": (history["x_a"], ["moment"], "m", "centre of the feature; the last moment is unloaded"),
            f"{name}_stress": (history["stress"], ["moment", "component"], "Pa", f"xx, yy, zz, xy, xz, yz at {of}"),
            f"{name}_normal": (history["normal"], ["direction"], "1", "unit normal of its critical plane"),
            f"{name}_circle": (history["circle"], ["of_circle"], "Pa",
                               "around its shear path: centre along dip, strike; radius")}


def of_plane(plane):
    """Of the plane below that was searched at all its points."""
    return {"worst_depth": (np.array([plane.depth]), ["worst_depth"], "m", "below the surface, searched at all points"),
            "findley_stress_at_worst_depth": (plane.f, BOTH, "Pa", "Findley stress at that depth")}


def of_layers(layers):
    """Of all points at every depth asked for."""
    return {DEPTH: (np.array([layer.depth for layer in layers]), [DEPTH], "m", "below the surface"),
            "findley_stress_at_depth": (np.stack([layer.f for layer in layers]), [DEPTH, *BOTH], "Pa", "Findley stress")}


def of_profiles(f, passage, profiles, listed):
    """Over the depth, the surface's f (nx, rows) first: under the row with the worst point, and of the contact alone; listed:
    whether other depths were asked for."""
    depth = ROW_DEPTH if listed else DEPTH
    under = max((profile for profile in profiles if not profile.alone), key=lambda profile: profile.worst.f)
    row = f[:, [int(np.argmin(np.abs(passage.y - under.worst.y)))]].T
    out = {depth: (np.append(0.0, under.depths), [depth], "m", "below the surface"),
           "findley_stress_under_row": (np.concatenate([row, under.f]), [depth, BOTH[0]], "Pa",
                                        "Findley stress below the row of the critical point below the surface")}
    for profile in profiles:
        if profile.alone:
            out[ALONE] = (np.append(np.nan, profile.f.max(axis=1)), [depth], "Pa",
                          "Findley stress of the contact without its feature")
    return out
