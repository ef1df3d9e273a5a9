"""All keys of a scene by their full names, with their declarations."""

from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.sections import SECTIONS, Body
from tehl_taichi.values.quantity import kinds

# {first part of a full key: class of that section}; "feature" is the first feature
CLASSES = {**SECTIONS, "oil": Oil, "bodies.a": Body, "bodies.b": Body, "feature": Feature}


def parts(scene):
    """{prefix of the keys, such as "bodies.a" or "feature.0": part} of a scene."""
    sections = {name: getattr(scene, name) for name in SECTIONS}
    features = {f"feature.{n}": feature for n, feature in enumerate(scene.features)}
    return {**sections, "oil": scene.oil, "bodies.a": scene.body_a, "bodies.b": scene.body_b, **features}


def every(scene):
    """Generator of (full key, declaration, value) of every key of a scene except name and note."""
    for name, part in parts(scene).items():
        for key, kind in kinds(type(part)).items():
            yield f"{name}.{key}", kind, getattr(part, key)
