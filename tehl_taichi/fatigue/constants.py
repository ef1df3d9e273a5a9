"""The numbers of a fatigue search that can be other ones than those of the scene."""

from tehl_taichi.scene import SceneError
from tehl_taichi.scene.given import named
from tehl_taichi.scene.parts import Fatigue

OF_POINTS = ("bending_limit", "torsion_limit", "criterion", "endurance", "kappa")  # the others belong to a passage


def changed(scene, constants):
    """The scene with these constants of its fatigue (None: its own). Raises SceneError."""
    if scene is None:
        raise SceneError("snapshots do not know their scene: tehl_taichi.fatigue(snapshots, scene)")
    changes = _given(constants)
    return scene.replace(**changes) if changes else scene


def of_points(constants):
    """:class:`tehl_taichi.scene.parts.Fatigue` of stresses without a passage. Raises SceneError."""
    values = {key.partition(".")[2]: value for key, value in _given(constants).items()}
    if other := sorted(values.keys() - set(OF_POINTS)):
        raise SceneError(f"{other[0]} has no meaning for given stresses; allowed: {', '.join(OF_POINTS)}")
    return Fatigue.from_values(values)


def _given(constants):
    """{full key: value} of those that are given. Raises SceneError where two of them contradict each other."""
    return named({f"fatigue.{key}": value for key, value in constants.items() if value is not None})
