"""Scene files (TOML): reading with a base scene, writing with every value, the commented template."""

import math
import tomllib
from pathlib import Path

from tehl_taichi.scene import Scene, SceneError, scene
from tehl_taichi.scene.oil import OILS
from tehl_taichi.scene.whole import SECTIONS

HEADER = "# A tehl_taichi scene. SI units (m, s, N, Pa, kg), temperatures in deg C; [grid] and [time] in half-widths."
COMMENTS = {
    "contact": "one of load (N/m line, N point), hertz_pressure (Pa) or the pair moes_M, moes_L; 0 = not given",
    "bodies.a": "carries the feature. E Pa, nu, k W/mK, rho kg/m3, c J/kgK, alpha 1/K", "bodies.b": "the other surface",
    "operation": "u_m m/s (mean), srr = (u_a - u_b)/u_m (negative: the feature is on the slower surface), temperature",
    "oil": "`tehl oils` lists the named ones", "rheology": "law: limiting, eyring, carreau or newtonian; stresses in Pa",
    "feature": "shape: cosine, ridge, furrow, waviness, rough or map; height m (negative: dent), all lengths in m",
    "thermal": "energy equation; on: true, false or \"auto\" (where the surfaces slip)",
    "fatigue": "Findley: kappa, endurance = sigma_eF in Pa",
    "grid": "cells of the half domain y >= 0; extent in half-widths of the contact",
    "time": "path of the first feature in a (-inf, inf: from before to behind the contact); courant: cells per step",
    "numerics": "tolerances of the discrete equations", "output": "store every n-th step",
}


def load(path):
    """Scene from a TOML file; `base = "gear"` fills what is not given. Raises SceneError (also for broken TOML)."""
    path = Path(path)
    try:
        data = tomllib.loads(path.read_text())
    except (OSError, UnicodeDecodeError) as error:
        raise SceneError(f"cannot read scene file {path}: {getattr(error, 'strerror', None) or error}") from None
    except tomllib.TOMLDecodeError as error:
        raise SceneError(f"{path} is not valid TOML: {error}") from None
    return from_data(data, path.stem)


def from_data(data, name):
    """Scene from a parsed file."""
    base = data.pop("base", None)
    data.setdefault("name", name)
    if base is None:
        return Scene.from_dict({"feature": [], **data})
    return Scene.from_dict(merge(scene(base).to_dict(), data))


def merge(base, data):
    """`base` (a scene as nested dictionary) with the tables and values of `data`; what excludes each other is replaced."""
    for key, value in data.items():
        if key == "contact" and isinstance(value, dict):
            base[key] = _merge_contact(base[key], value)
        elif key == "operation" and isinstance(value, dict) and {"u_a", "u_b"} & value.keys():
            base[key] = {"temperature": base[key]["temperature"], **value}
        elif key == "oil" and isinstance(value, dict) and value.get("name") in OILS:
            base[key] = value  # a named oil brings its own numbers, not those of the base
        elif isinstance(value, dict) and isinstance(base.get(key), dict):
            base[key] = merge(base[key], value)
        else:
            base[key] = value
    return base


def _merge_contact(base, given):
    loads = ("load", "hertz_pressure", "moes_M", "moes_L")
    if any(key in given for key in loads):
        base = {key: value for key, value in base.items() if key not in loads}
    return {**base, **given}


def dumps(description):
    """TOML text of a scene, every value written out; reading it back gives an equal scene."""
    data = description.to_dict()
    lines = [HEADER, f"name = {_value(data['name'])}", ""]
    for key in ("contact", "bodies.a", "bodies.b", "operation", "oil", "rheology"):
        table = data["bodies"][key[-1]] if key.startswith("bodies") else data[key]
        lines += _table(f"[{key}]", table, COMMENTS[key])
    for feature in data["feature"]:
        lines += _table("[[feature]]", feature, COMMENTS["feature"])
    for key in SECTIONS:
        if key not in ("contact", "operation", "rheology"):
            lines += _table(f"[{key}]", data[key], COMMENTS[key])
    return "\n".join(lines)


def _table(head, values, comment):
    return [f"{head}  # {comment}"] + [f"{key} = {_value(value)}" for key, value in values.items()] + [""]


def _value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, (tuple, list)):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    if isinstance(value, float) and math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return repr(value)
