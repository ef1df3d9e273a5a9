"""Fatigue of a run whose film has more shear than any oil: no index, and the index of its pressure alone."""

CONSTANTS = ("surface", "carries_feature", "kappa_F", "sigma_eF_Pa", "criterion")
WITHOUT = {"fatigue.shear": False, "fatigue.thermal_stress": False}  # changes of a scene: no shear on the surface, nor its heat


def constants_of(found):
    """Entries that every part of a search shares with its summary `found`: body, criterion and limits."""
    return {key: found[key] for key in CONSTANTS if key in found}


def without_index(found, why):
    """Summary of such a run. found: summary of the search with the changes WITHOUT; why: reason why there is no index."""
    index = {"Fi_max": None, "findley_stress_max_Pa": None}
    return {**index, "unknown": dict.fromkeys(index, why), **constants_of(found),
            "thermal_stress": False, "pressure_alone": found}


def searched(summary):
    """Numbers of a search: the summary itself, or those of the pressure alone."""
    return summary.get("pressure_alone", summary)


def why_none(summary):
    """Reason why there is no index, "" if there is one."""
    return summary["unknown"]["Fi_max"] if "pressure_alone" in summary else ""
