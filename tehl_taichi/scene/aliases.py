"""Changes of a scene: short keys get their full names, and contradictory changes are refused."""

from typing import Any

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.tables import as_changes
from tehl_taichi.scene.unit_texts import in_units
from tehl_taichi.values.coerce import plain, shown
from tehl_taichi.values.units import split

SHORT = {"srr": "operation.srr", "load": "contact.load", "hertz_pressure": "contact.hertz_pressure",
         "speed": "operation.u_m", "temperature": "operation.temperature", "height": "feature.height",
         "width": "feature.width", "kappa": "fatigue.kappa", "endurance": "fatigue.endurance",
         "bending_limit": "fatigue.bending_limit", "torsion_limit": "fatigue.torsion_limit"}
LOADS = ("contact.load", "contact.hertz_pressure", "contact.moes_M", "contact.moes_L")
BY_SURFACE = ("operation.u_a", "operation.u_b")
# keys of one line say the same in different ways: only those of one of its groups can be given
EXCLUSIVE = ((LOADS[:1], LOADS[1:2], LOADS[2:]), (BY_SURFACE, ("operation.u_m", "operation.srr")),
             (LOADS[2:], ("operation.u_m", *BY_SURFACE)), (("time.steady_only",), ("time.steps",)),
             (("oil.nu_40", "oil.nu_100", "oil.alpha_40"), ("oil.G0", "oil.S0", "oil.Dz", "oil.Cz")),
             (("oil.rho_15",), ("oil.rho0",)),
             (("fatigue.endurance",), ("fatigue.torsion_limit", "fatigue.bending_limit")))


def full_name(key):
    """Full dotted key of a short one; features without a number are the first one."""
    key = SHORT.get(key, key)
    section, _, rest = key.partition(".")
    return f"feature.0.{rest}" if section == "feature" and rest and not rest[0].isdigit() else key


def resolve(given):
    """Resolve changes (words, key, value) to {full key: value}, of a table the values in it; words: text that the user typed.

    Raises SceneError, with the words of both, if two changes contradict each other.
    """
    found: dict[str, tuple[str, Any]] = {}
    for words, key, value in given:
        key = full_name(key)
        for full, one in as_changes({key: in_units(plain(value), key)}):
            if full in found and found[full][1] != one:
                _contradict(found[full][0], words)
            found[full] = words, one
    for groups in EXCLUSIVE:
        chosen = [[found[key][0] for key in group if key in found and _is_given(key, found[key][1])] for group in groups]
        spoken = [texts[0] for texts in chosen if texts]
        if len(spoken) > 1:
            _contradict(*spoken[:2])
    loads = {key: found[key] for key in LOADS if key in found}
    if loads and not any(_is_given(key, value) for key, (_, value) in loads.items()):
        raise SceneError(f"{next(iter(loads.values()))[0]} is out of range: a contact needs a load; allowed: more than 0")
    return {key: value for key, (_, value) in found.items()}


def check_swept(changes, keys):
    """Refuse changes {key: value} of all cases that a sweep over these keys overrides or contradicts. Raises SceneError."""
    resolve([*((f"{words(key, value)} in all cases", key, value) for key, value in changes.items()),
             *((f"the sweep over {key}", key, f"swept {key}") for key in keys)])


def resolve_named(changes):
    """Resolve changes {key: value} to {full key: value}. Raises SceneError, as :func:`resolve`."""
    return resolve([(words(key, value), key, value) for key, value in changes.items()])


def words(key, value):
    """Text of a change in messages."""
    return f"{key} = {shown(value)}"


def _is_given(key, value):
    """Whether a value sets its key: a load of 0, 0 steps and steady_only = false do not; a speed or slip of 0 does."""
    if key == "time.steps":
        return not isinstance(value, int) or value > 0
    return key.startswith("operation.") or not _is_zero(value)


def _is_zero(value):
    """Whether a value is 0, or text of 0 with a unit: that of a load depends on the contact."""
    number = split(value) if isinstance(value, str) else None
    return float(number[0]) == 0 if number else not value


def _contradict(one, other):
    raise SceneError(f"{one} and {other} contradict each other: give one of them")
