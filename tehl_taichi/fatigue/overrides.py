"""Constants of a fatigue search that differ from the scene."""

from tehl_taichi.errors import StoreError
from tehl_taichi.scene import SceneError, builtin, keys
from tehl_taichi.scene.aliases import resolve_named
from tehl_taichi.scene.sections import Fatigue
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.quantity import kinds

FREE = ("fatigue", "time", "output", "numerics")  # sections in which a scene may differ from that of its run
OF_POINTS = ("bending_limit", "torsion_limit", "criterion", "endurance", "kappa")  # the others belong to a passage


def agreed(scene, reader):
    """The scene (None: that of the reader) of a run or of snapshots. Raises SceneError if it differs from theirs in anything
    but fatigue and its storage.
    """
    own, scene = getattr(reader, "scene", None), None if scene is None else builtin.scene_or_builtin(scene)
    if scene is None or own is None:
        _check_nodes(scene, reader)
        return scene or own
    theirs = dict((key, value) for key, _, value in keys.every(own))
    other = [key for key, _, value in keys.every(scene) if key.partition(".")[0] not in FREE and theirs.pop(key, None) != value]
    if other:
        many = f"{', '.join(other[:4])} {'are' if other[1:] else 'is'}"
        raise SceneError(f"the given scene differs from that of the run: {many} another; only its [fatigue] may differ. Give "
                         "constants, as kappa = 0.2, or run the other scene")
    return scene


def _check_nodes(scene, snapshots):
    """Refuse snapshots on another grid than that of the scene."""
    if scene is not None and isinstance(snapshots, list) and snapshots and hasattr(snapshots[0], "x"):
        found, requested = (snapshots[0].x.size, snapshots[0].y.size), (scene.grid.nx + 1, scene.rows + 1)
        if found != requested:
            raise SceneError(f"the snapshots have "
                             f"{found[0]} x {found[1]} nodes, the given scene {requested[0]} x {requested[1]}: "
                             "they do not belong together")


def changed(scene, constants):
    """The scene with these fatigue constants (None: its own). Raises SceneError."""
    if scene is None:
        raise SceneError("snapshots need their scene, as the second argument")
    changes = _given(constants)
    return scene.replace(**changes) if changes else scene


def of_points(constants, scene=None):
    """The :class:`tehl_taichi.scene.sections.Fatigue` for stresses without a passage: that of the scene, if any, with these
    constants. Raises SceneError.
    """
    values = {key.partition(".")[2]: value for key, value in _given(constants).items()}
    scene = None if scene is None else builtin.scene_or_builtin(scene)
    own = scene.fatigue if scene is not None else Fatigue()
    free = *OF_POINTS, "on", "source", "limit_of"
    strange = [key for key in kinds(Fatigue) if key not in free and getattr(own, key) != getattr(Fatigue, key)]
    if other := sorted(values.keys() - set(OF_POINTS)) or strange:
        raise SceneError(f"{other[0]} has no effect on given stresses; allowed: {', '.join(OF_POINTS)}")
    return Fatigue.from_values(values) if scene is None else changed(scene, constants).fatigue


def reader_of(of, function):
    """Reader of a run, or a list of snapshots. Raises SceneError for other objects, StoreError for a run whose law is not
    installed here.
    """
    reader = getattr(of, "store", of)
    if lacks := getattr(reader, "lacks", ""):
        raise StoreError(lacks)
    if hasattr(reader, "fields"):
        return reader
    try:
        if snapshots := list(reader):
            return snapshots
        raise SceneError(f"no snapshots: tehl_taichi.{function} needs those of a passage, as tehl_taichi.simulate gives them")
    except TypeError:
        raise SceneError(f"{shown(of)} is neither a run nor snapshots; tehl_taichi.{function} takes what tehl_taichi.open or "
                         "tehl_taichi.march gives") from None


def _given(constants):
    """{full key: value} of the given constants. Raises SceneError if two of them contradict each other."""
    if constants.get("on") is False:
        raise SceneError("on = False has no effect: this call searches the fatigue")
    return resolve_named({f"fatigue.{key}": value for key, value in constants.items() if value is not None})
