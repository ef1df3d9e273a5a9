"""Scene that a state belongs to: a march continues only with the contact, the motion and the grid that it began with."""

import json

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import idle_keys
from tehl_taichi.values.coerce import shown

KEY = "scene"  # of a state: JSON text of the numbers below
SECTIONS = ("contact", "operation", "oil", "rheology", "feature", "grid")
OTHERS = ("thermal.nodes", "time.x_start", "time.courant",
          *(f"bodies.{name}.{key}" for name in "ab" for key in ("E", "nu", "k", "rho", "c")))
NAMED = 3  # keys that a message names at most


def recorded(snapshots, scene):
    """Generator of snapshots whose states carry the numbers of their scene."""
    text = json.dumps(_numbers(scene))
    for snapshot in snapshots:
        snapshot.make_state = _WithOrigin(snapshot.make_state, text)
        yield snapshot


class _WithOrigin:
    """Function that makes a state with the text of its scene."""

    def __init__(self, make_state, text):
        self.make_state, self.text = make_state, text

    def __call__(self, **options):
        made = self.make_state(**options)
        return made if options else {**made, KEY: self.text}


def check(state, scene):
    """Refuse a state of a scene whose march would have had another one at this step. Raises SceneError."""
    if KEY not in state:
        return
    theirs, own = json.loads(str(state[KEY])), json.loads(json.dumps(_numbers(scene)))
    other = [key for key in dict.fromkeys([*theirs, *own]) if theirs.get(key) != own.get(key)]
    if other:
        words = "; ".join(f"{key} = {shown(theirs.get(key))} there, {shown(own.get(key))} here" for key in other[:NAMED])
        raise SceneError(f"the state belongs to another scene: {words}{'; ...' * (len(other) > NAMED)}; allowed: "
                         f"`snapshot.state` of this scene (to continue nevertheless, remove {KEY!r} from it)")


def _numbers(scene):
    """{full key: value} of all numbers that a step depends on."""
    found = {key: value for key, value in idle_keys.signature(scene).items()
             if key in OTHERS or key.partition(".")[0] in SECTIONS and not key.endswith(".file")}
    return {**found, "isothermal": scene.isothermal}
