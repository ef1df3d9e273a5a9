"""The numbers of a fatigue search that can be other ones than those of the scene."""

from tehl_taichi.criteria import CRITERIA
from tehl_taichi.scene import SceneError
from tehl_taichi.scene.parts import Fatigue
from tehl_taichi.values.checks import build, number
from tehl_taichi.values.plain import plain

OF_POINTS = {"kappa", "endurance", "criterion"}  # the others belong to a passage


def changed(scene, constants):
    """The scene with these constants of its fatigue (None: its own). Raises SceneError."""
    if scene is None:
        raise SceneError("snapshots do not know their scene: tehl_taichi.fatigue(snapshots, scene)")
    changes = {f"fatigue.{key}": value for key, value in _with_limits(constants, scene.fatigue.criterion).items()}
    return scene.replace(**changes) if changes else scene


def of_points(constants):
    """:class:`tehl_taichi.scene.parts.Fatigue` of stresses without a passage. Raises SceneError."""
    values = _with_limits(constants, Fatigue.criterion)
    if other := sorted(values.keys() - OF_POINTS):
        raise SceneError(f"{other[0]} has no meaning for given stresses; allowed: bending_limit, torsion_limit, "
                         f"{', '.join(sorted(OF_POINTS))}")
    return build(Fatigue, values, "fatigue")


def _with_limits(constants, criterion):
    """{name: value} of those that are given; kappa and endurance of the limits in bending and torsion, by their own criterion
    or this one."""
    values = {key: plain(value) for key, value in constants.items() if value is not None}
    bending, torsion = (values.pop(key, None) for key in ("bending_limit", "torsion_limit"))
    if bending is None and torsion is None:
        return values
    if bending is None or torsion is None or {"kappa", "endurance"} & values.keys():
        raise SceneError("give the limits in bending and torsion together, and neither kappa nor endurance with them")
    for name, value in (("bending_limit", bending), ("torsion_limit", torsion)):
        number(name, value, "Pa", 1e3, 1e11)
    chosen = CRITERIA.get(values.get("criterion", criterion))
    if chosen is None:  # the scene refuses it, with those that are allowed
        return values
    kappa, endurance = chosen.from_limits(bending, torsion)
    return {**values, "kappa": kappa, "endurance": endurance}
