"""The word of the user for the feature that passes: his scan where the first feature, from which positions count, is a
measured map."""

import math


def passing(scene):
    """The word for it; scene: None where it is unknown."""
    return "scan" if scene and scene.features and scene.features[0].kind.measured else "feature"


def where(scene):
    """The part of a feature whose position is given: of a scan, which is as long as the contact, it must be its centre."""
    return "scan centre" if passing(scene) == "scan" else "feature"


def between(low, high):
    """'from -0.5 a up to 1 a': positions (a) between which moments count, "" where all do."""
    return " ".join(f"{word} {x:g} a" for word, x in (("from", low), ("up to", high)) if math.isfinite(x))


def from_centre(scene, carries=True):
    """Title of an axis along a surface; carries: whether that has the feature, so that its centre stands still there."""
    return f"x from the {passing(scene)}'s centre{'' if carries else ' at X = 0'} (µm)"


def position(scene):
    """Title of an axis of moments."""
    return f"position of the {where(scene)} x / a"


def carriers(scene):
    """'surface a', 'surfaces a and b': what carries features."""
    names = [surface.name for surface in scene.surfaces if surface.features]
    return f"surface{'s' * (len(names) > 1)} {' and '.join(names)}"
