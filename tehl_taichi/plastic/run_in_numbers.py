"""Numbers and arrays of a run-in for summaries and stores."""

import numpy as np

ALONG, ACROSS = 0, 1  # the components xx and yy
RISEN = 1e-9  # m: a dent with a lower rim has none


def numbers(scene, state):
    """Part "run_in" of a summary, of a finished RunInState."""
    judged, made = state.records[-1], [one for one in state.records if not one["judged"]]
    bodies = {name: _of_body(one) for name, one in state.bodies.items()}
    return {"passages": state.passages, "rounds": made[0]["rounds"] if made else judged["rounds"],
            "shaken_down": judged["new_plastic_strain"] == 0.0, "new_plastic_strain": judged["new_plastic_strain"],
            "surface_change_max_m": max(one["surface_change_max_m"] for one in bodies.values()),
            "plastic_strain_max": max(one["plastic_strain_max"] for one in bodies.values()),
            "residual_min_Pa": min(one["residual_min_Pa"] for one in bodies.values()),
            "residual_max_Pa": max(one["residual_max_Pa"] for one in bodies.values()),
            **_heights(scene, state), "contained": state.contained,
            "unsettled_m": state.unsettled, "by_surface": bodies, "history": list(state.records)}


def _of_body(one):
    start = one.start
    along = start.residual[:, [ALONG, ACROSS]]
    return {"surface_change_max_m": float(np.abs(start.sinking).max()), "plastic_strain_max": float(start.hardened.max()),
            "residual_min_Pa": float(along.min()), "residual_max_Pa": float(along.max())}


def _heights(scene, state):
    """Height of the highest point (in a dent: depth of the lowest) of the feature's surface before and after run-in; {} if its
    steel does not yield.
    """
    name = scene.reference.name
    if name not in state.bodies:
        return {}
    one = state.bodies[name]
    before = sum(f.height_at(one.x[:, None] - f.x, one.y[None] - f.y) for f in scene.reference.features) + 0 * one.start.sinking
    after = before - one.start.sinking
    extreme = np.max if before.max() > RISEN else np.min
    return {"height_before_m": float(extreme(before)), "height_after_m": float(extreme(after))}


def arrays(state):
    """{name: (values, dims, units, text)} for a store: sinking of the surface, residual stress and plastic strain of each
    body.
    """
    out = {}
    for name, one in state.bodies.items():
        dims = [f"run_in_{axis}_{name}" for axis in ("depth", "x", "y")]
        of = f"run-in of body {name}"
        places = zip(dims, (one.depths, one.x, one.y), ("depth of layers", "x in the frame of the surface", "across"))
        out |= {dim: (values, [dim], "m", f"{text}, {of}") for dim, values, text in places}
        out[f"sinking_{name}"] = one.start.sinking, dims[1:], "m", f"how far the surface sank, {of}"
        out[f"plastic_strain_{name}"] = one.start.hardened.astype(np.float32), dims, "1", f"equivalent plastic strain, {of}"
        for component, at in (("xx", ALONG), ("yy", ACROSS)):
            stress = one.start.residual[:, at].astype(np.float32)
            out[f"residual_{component}_{name}"] = stress, dims, "Pa", f"residual stress sigma_{component}, {of}"
    return out
