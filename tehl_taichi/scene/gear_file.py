"""The commented file of a gear pair, for `tehl flank`."""

import dataclasses
from pathlib import Path

from tehl_taichi.disk import user_files
from tehl_taichi.scene import scene_file
from tehl_taichi.scene.gear_pair import PAIRS, GearPair, gear_pair
from tehl_taichi.values.quantity import kinds

HEADER = """# A gear pair for tehl flank. SI units (m, N m, Pa), angles in degrees, temperatures in deg C.
# Of x1, x2 and a_w give two. Tip diameters 0 and factors inf follow from the others; delete lines that you do not need."""
SCENE = ('scene = "gear"', "oil, bodies, feature and numerics: a built-in scene, or a scene file beside this one")


def new(path, base):
    """Write the built-in pair `base` with every value, unit, meaning and range. Raises SceneError if that is not possible."""
    path = Path(path)
    pair = gear_pair(base)
    scene_file.check_new(path)
    user_files.text(path, dumps(pair, PAIRS[base][1]))


def dumps(pair, about):
    """TOML text of a pair; about: its description."""
    values = dataclasses.asdict(pair)
    rows = [(f"{key} = {scene_file.toml_value(values[key])}", declared.sentence) for key, declared in kinds(GearPair).items()]
    lines = [f"{text:<{scene_file.COLUMN}}  # {sentence}" for text, sentence in (SCENE, ("[gear]", about), *rows)]
    return "\n".join([HEADER, lines[0], "", *lines[1:], ""])
