"""Word for the passing feature: "scan" if the first feature, from which positions count, is a measured map."""

import math


def feature_word(scene):
    """"scan" or "feature"; scene: None if it is unknown."""
    return "scan" if scene and scene.features and scene.features[0].kind.measured else "feature"


ORIGIN = "origin of feature.x"


def is_off(scene):
    """Whether the first feature lies beside the origin of feature.x, from which positions count."""
    return bool(scene and scene.features and scene.features[0].x)


def position_word(scene):
    """Text for the point whose position is given: the feature; of a scan, which may be as long as the contact, its centre; the
    origin of feature.x where the first feature lies beside it."""
    return ORIGIN if is_off(scene) else "scan centre" if feature_word(scene) == "scan" else "feature"


def centre_word(scene):
    """Text for that point of a scene, drawn in it."""
    return ORIGIN if is_off(scene) else f"centre of the {feature_word(scene)}"


def range_words(low, high):
    """Text such as 'from -0.5 a up to 1 a': positions (a) between which moments count; "" if all do."""
    return " ".join(f"{word} {x:g} a" for word, x in (("from", low), ("up to", high)) if math.isfinite(x))


def from_centre(scene, carries=True):
    """Title of an axis along a surface; carries: this surface carries the feature, whose centre is then fixed on the axis."""
    origin = ORIGIN if is_off(scene) else f"{feature_word(scene)}'s centre"
    return f"x from the {origin}{'' if carries else ' at X = 0'} (µm)"


def met_words(scene, numbers):
    """Text ' that it meets at X = 0' for the place on the first feature where a point of another surface lies; "" if that stays
    the place: on its own surface, and without slip. numbers: summary of a fatigue search.
    """
    paces = {surface.name: surface.pace for surface in scene.surfaces}
    return "" if paces.get(numbers.get("surface"), 1.0) == 1.0 else " that it meets at X = 0"


def position_title(scene):
    """Title of an axis of feature positions."""
    return f"position of the {position_word(scene)} x / a"


def together(scene):
    """Text ' together, as they lie at X = 0' for heights of two surfaces that slide; "" for others."""
    slide = len({surface.pace for surface in scene.surfaces if surface.features}) > 1
    return " together, as they lie at X = 0" * slide


def carriers(scene):
    """Text of the surfaces with features: 'surface a', 'surfaces a and b'."""
    names = [surface.name for surface in scene.surfaces if surface.features]
    return f"surface{'s' * (len(names) > 1)} {' and '.join(names)}"
