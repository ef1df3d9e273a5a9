"""Keys of a scene without effect, and the reason: for options, --set, --over, files and Python alike.

Found from the entries that declare keys (laws, shapes, criteria) and from the parts that a scene leaves out (heat, a passage,
slip, a dimension). A new law or shape needs no line here.
"""

from types import SimpleNamespace

import numpy as np

from tehl_taichi.laws import conduction, density, rheology
from tehl_taichi.laws.hardness import RELATIONS
from tehl_taichi.laws.law import declared
from tehl_taichi.laws.solid_friction import BOUNDARY, boundary_stress
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.scene import aliases, data_sheet, fatigue_limits, keys, material_length, run_in, zoom_room
from tehl_taichi.scene.feature import USED_BY
from tehl_taichi.scene.named_oils import OILS
from tehl_taichi.scene.named_steels import STEELS
from tehl_taichi.scene.oil import Oil, in_one_temperature
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.sections import Fatigue, Time, Zoom
from tehl_taichi.scene.strength.strength import Strength
from tehl_taichi.scene.strength.table import HARDNESS, KAPPA, RESIDUAL
from tehl_taichi.values.automatic import AutomaticValue
from tehl_taichi.values.coded_warning import with_data
from tehl_taichi.values.quantity import kinds

MOES = ("oil.eta0", "oil.alpha")  # numbers of the oil that a Moes pair uses
LABELS = ("oil.name", "oil.source", "fatigue.source", "fatigue.limit_of", "fatigue.table", "fatigue.table_b",
          "bodies.a.material", "bodies.b.material")  # nothing follows from them
FOLLOW = {"oil": data_sheet.derived_keys, "fatigue": fatigue_limits.derived_keys}  # functions: numbers that other keys give
PARTS = (0.0, 0.1, 0.5, 1.0, 2.0)  # of the Hertz pressure, at which laws are asked
WARMER = (0.0, 20.0, 80.0)  # K above the inlet, of a film with temperatures
OF_A_PASSAGE = ("from_x", "to_x", "length", "exponent", "limit_cycles", "weibull", "reference_volume", "reference_area")
NUDGE = 0.01  # of a number, by which it is changed to see whether a law takes it


def idle(scene):
    """{full key: reason} of all keys without effect in this scene."""
    return {**reasons_of_left_out(scene), **idle_warnings(scene)}


def idle_warnings(scene):
    """Reasons for keys that belong to another law, shape or description; the user probably means that one."""
    return dict([*_overruled(scene), *_other_laws(scene), *_other_shapes(scene)])


def reasons_of_left_out(scene):
    """Reasons for keys that belong to parts this scene leaves out."""
    return dict(found for rule in RULES for found in rule(scene))


def signature(scene):
    """{full key: value} of all keys with an effect: equal for scenes that give equal results."""
    without = idle(scene)
    return {key: value for key, kind, value in keys.every(scene) if key not in without and key not in LABELS}


def doubts(scene):
    """One sentence about every key that the user gave although it has no effect."""
    found, own = idle(scene), user_keys(scene)
    beside = {"time.steady_only", *["grid.ny"] * ("grid.nx" in own)}  # says what is so; --grid gives both
    beside |= {"time.steps"} if scene.time.steps <= 0 else set()  # all of none, none
    beside |= set() if scene.zoom.factor else {"zoom.factor"}
    for key in sorted(own & found.keys() - beside):
        yield with_data(f"{short_key(key, scene)} has no effect here: {found[key]}", key=key)
    yield from (with_data(f"rheology.{key} has no effect on the film: the law {scene.rheology.law!r} does not use it; it only "
                          "limits the friction of solid contact", key=f"rheology.{key}") for key in BOUNDARY.numbers
                if f"rheology.{key}" in own - found.keys() and _only_solid(scene, key))


def user_keys(scene):
    """Full keys that the user gave.

    For a scene made in Python: keys whose value differs from the default and does not follow from names, sheets or other keys.
    """
    return _unusual(scene) if scene.user_keys is None else scene.user_keys


def _unusual(scene):
    return frozenset(f"{name}.{key}" for name, part in keys.parts(scene).items() for key, usual in _usual(scene, name, part)
                     if usual is not None and getattr(part, key) != usual
                     and not isinstance(getattr(part, key), AutomaticValue))


def _usual(scene, name, part):
    """(key, its value if the user gives none) of a part; None if it follows from other keys."""
    follow = FOLLOW[name](vars(part)) if name in FOLLOW else ()
    follow += ("u_m",) * (name == "operation" and scene.contact.moes_M > 0)
    brought = vars(OILS.get(part.name, Oil())) if name == "oil" else {}
    if name.startswith("bodies") and part.material:
        brought = STEELS[part.material].numbers
    for key in kinds(type(part)):
        yield key, None if key in follow else brought.get(key, getattr(type(part), key))


def short_key(key, scene):
    """Full key as people write it: without the number if there is only one feature."""
    return key.replace("feature.0.", "feature.") if len(scene.features) == 1 else key


def _only_solid(scene, key):
    return key not in rheology.LAWS[scene.rheology.law].numbers and any(key in law.numbers for law in rheology.LAWS.values())


def _overruled(scene):
    if scene.contact.moes_M > 0:
        for key in ("operation.u_m", *aliases.BY_SURFACE):
            yield key, (f"contact.moes_L = {scene.contact.moes_L:g} sets the mean speed, {scene.operation.u_m:.4g} m/s")


def _other_laws(scene):
    laws = "; ".join(f"{law.name}: {', '.join(law.numbers)}" for law in scene.oil.laws[:2])
    used = MOES if scene.contact.moes_M > 0 else ()
    for key in scene.oil.unused:
        if f"oil.{key}" not in used:
            yield f"oil.{key}", f"the laws of this oil ({laws}) do not use it"


def _other_shapes(scene):
    for n, feature in enumerate(scene.features):
        for key, names in USED_BY.items():
            if feature.shape not in names:
                yield f"feature.{n}.{key}", f"shape {feature.shape!r} does not use it; it belongs to {', '.join(names)}"


def _rheology(scene):
    """Numbers of shear laws that are not chosen, and of friction without slip."""
    law = rheology.LAWS[scene.rheology.law]
    for key in declared({**rheology.LAWS, BOUNDARY.name: BOUNDARY}):
        if key not in law.numbers and key not in BOUNDARY.numbers:
            yield f"rheology.{key}", f"the shear law {law.name!r} does not use it"
        elif key not in law.numbers and scene.operation.u_s == 0 and _changes(_friction, scene.rheology, key):
            yield f"rheology.{key}", "nothing slips where the surfaces could touch (SRR = 0)"


def _friction(values):
    return [boundary_stress(values, p) for p in (1e6, 1e8, 1e9)]


def _changes(function, values, key):
    """Whether the result of a function of these values depends on the number `key`."""
    number = getattr(values, key)
    if isinstance(number, tuple):
        return True
    other = SimpleNamespace(**{**vars(values), key: number + NUDGE * (abs(number) or 1.0)})
    return not np.array_equal(function(values), function(other))


def _oil(scene):
    """Numbers that no law uses at the temperature of an isothermal film, and `expansion` if it makes no difference."""
    laws = _laws(scene)
    now, sheet = laws(scene.oil), data_sheet.derived_keys(vars(scene.oil))
    for key in declared({law.name: law for law in scene.oil.laws}):
        used = f"oil.{key}" in MOES and scene.contact.moes_M > 0 or key in (*sheet, *["rho0"] * bool(sheet))
        if not used and not _changes(laws, scene.oil, key):
            yield f"oil.{key}", _why_not_heat(scene)
    if all(np.array_equal(now, laws(SimpleNamespace(**{**vars(scene.oil), "expansion": word})))
           for word in kinds(type(scene.oil))["expansion"].words):
        yield "oil.expansion", "this oil does not expand at the film temperatures"


def _laws(scene):
    """Function of an oil: values of its laws at the pressures and temperature that the film of this scene may have."""
    p, inlet = np.array(PARTS) * Scales.of(scene).p_H, scene.operation.temperature
    if scene.isothermal:
        return lambda oil: _values((ln_eta, _density_of(scene)), oil, p, inlet + 0 * p)
    laws = ln_eta, density.rho_film, conduction.heat_capacity, lambda oil, p, Gamma: conduction.conductivity(oil, p)
    return lambda oil: _values(laws, oil, *(one.ravel() for one in np.meshgrid(p, inlet + np.array(WARMER))))


def _values(laws, oil, p, Gamma):
    """Values of laws at all points, one row per law."""
    return np.array([law(oil, p, Gamma) + 0 * p for law in laws])


def _density_of(scene):
    """Density law of an isothermal film of this scene."""
    def law(oil, p, Gamma):
        expansion = in_one_temperature(oil.expansion, scene.keeps_expansion)
        return density.rho_ratio(SimpleNamespace(**{**vars(oil), "expansion": expansion}), p, Gamma)

    return law


def _why_not_heat(scene):
    return "the film keeps the inlet temperature (isothermal)" if scene.isothermal else ("the laws of this oil give an equal "
                                                                                         "result")


def _temperature(scene):
    laws, o = _laws(scene), scene.operation
    if scene.isothermal and np.array_equal(laws(scene.oil), _laws(_at_other_inlet(scene))(scene.oil)):
        yield "operation.temperature", f"the oil {scene.oil.name} does not depend on it (isothermal, {o.temperature:g} deg C)"


def _at_other_inlet(scene):
    """The scene at another inlet temperature, with the attributes that :func:`_laws` uses."""
    return SimpleNamespace(contact=scene.contact, load=scene.load, body_a=scene.body_a, body_b=scene.body_b, isothermal=True,
                           keeps_expansion=scene.keeps_expansion, operation=SimpleNamespace(
                               u_m=scene.operation.u_m, temperature=scene.operation.temperature + 1.0))


def _heat(scene):
    if not scene.isothermal:
        return
    idle = ("thermal.nodes", "thermal.tolerance", "thermal.rounds", "output.profiles", "fatigue.thermal_stress",
            *(f"bodies.{which}.{key}" for which in "ab" for key in ("k", "rho", "c")))
    yield from ((key, "no temperatures are computed (isothermal)") for key in idle)


def _expansion_of_bodies(scene):
    heated = scene.judges_steel and scene.has_thermal_stress
    for name in "ab":
        if not heated:
            yield f"bodies.{name}.alpha", "no thermal stress is computed"
        elif name not in (surface.name for surface in scene.judged):
            yield f"bodies.{name}.alpha", f"the stresses of body {name} are not searched"


def _passage(scene):
    """Keys that need a passing feature."""
    if scene.transient:
        return
    if not scene.features:
        yield "time.steady_only", "nothing passes (no feature)"
    why = "nothing passes (steady)" if scene.features else "nothing passes (no feature)"
    yield from ((f"time.{key}", why) for key in kinds(Time) if key != "steady_only")
    yield "output.every", why
    for n, feature in enumerate(scene.features):
        yield from ((f"feature.{n}.{key}", why) for key in kinds(type(feature)))


def _fatigue(scene):
    if not scene.judges_steel:
        why = "every searched surface is at rest" if scene.fatigue.on else "fatigue.on = false"
        yield from ((f"fatigue.{key}", why) for key in kinds(Fatigue) if key not in ("on", "source"))
    elif not scene.transient:
        yield from ((f"fatigue.{key}", "nothing passes: the index is that of the smooth contact") for key in OF_A_PASSAGE)
    elif why := material_length.why_not(scene, Scales.of(scene).a * (scene.grid.x_max - scene.grid.x_min) / scene.grid.nx):
        yield "fatigue.length", why


def _strength(scene):
    """Constants that the tables of all bodies replace, and keys of tables that do not exist."""
    if not scene.judges_steel:
        return
    tables, f = [Strength(scene.fatigue, surface).table for surface in scene.judged], scene.fatigue
    relation = RELATIONS[f.relation] if any(table and table.has(HARDNESS) for table in tables) else None
    if relation is None:
        yield "fatigue.relation", "no table of hardness is given"
    if relation is None or not relation.inclusion:
        yield "fatigue.inclusion", "the relation murakami is not used"
    by_hardness = relation is not None and relation.findley is not None
    if not f.exponent:
        yield "fatigue.limit_cycles", "fatigue.exponent = 0: passages are not counted"
    if not f.weibull or not f.depths:
        why = "no stressed volume is computed (fatigue.weibull = 0)" if not f.weibull else "fatigue.depths is empty"
        yield from ((f"fatigue.{key}", why) for key in ("reference_volume", "reference_area", *["weibull"] * bool(f.weibull)))
    own_kappa = all(table and (table.has(KAPPA) or table.has(HARDNESS) and by_hardness) for table in tables)
    if own_kappa:
        yield "fatigue.kappa", "the table gives kappa"
    if all(tables):
        limits = fatigue_limits.KEYS if own_kappa or len(fatigue_limits.given_limits(vars(f))) < 2 else ()  # two give kappa
        yield from ((f"fatigue.{key}", "the table gives the limit") for key in ("endurance", *limits))
    for name in RESIDUAL:
        if all(table and table.has(name) for table in tables):
            yield f"fatigue.{name.removesuffix('_Pa')}", "the table gives it"


def _zoom(scene):
    why = zoom_room.why_none(scene)
    if why:
        yield "zoom.factor", why
    if why or not scene.zooms:
        yield from ((f"zoom.{key}", why or "zoom.factor = 0") for key in kinds(Zoom) if key != "factor")


def _across(scene):
    if scene.rows == 0:
        yield from ((f"grid.{key}", "nothing varies along y in this line contact") for key in ("ny", "y_max"))
    for n, feature in enumerate(scene.features):
        if scene.transient and feature.transverse:
            yield f"feature.{n}.y", "the feature does not vary along y"


def _shapes(scene):
    """Keys of features that have no effect with their other keys."""
    if scene.transient:
        yield from ((f"feature.{n}.{key}", why) for n, f in enumerate(scene.features) for key, why in f.kind.idle(f).items())


def _steel(scene):
    """Hardening of steel that does not yield."""
    reasons = run_in.elastic_bodies(scene) if scene.runs_in else dict.fromkeys("ab", "no run-in (time.run_in = 0)")
    for name, why in reasons.items():
        yield f"bodies.{name}.hardening", f"steel of body {name} does not flow: {why}"


RULES = (_rheology, _oil, _temperature, _heat, _expansion_of_bodies, _passage, _fatigue, _strength, _zoom, _shapes, _steel,
         _across)


def changed_keys(scene, changes):
    """Full keys that the changes {full key: value} of a scene give; a value may be a whole part: features, an oil, a body."""
    parts, found = keys.parts(scene), set[str]()
    for key, value in changes.items():
        each = {f"feature.{n}": one for n, one in enumerate(value)} if key == "feature" else {key: value}
        for name, one in each.items():
            found |= _keys_of(name, parts[name], one) if name in parts else {name}
    return found


def _keys_of(name, part, value):
    """Full keys given by a table or an object for a part of a scene; of one with all keys, those with an unusual value."""
    values, names = value if isinstance(value, dict) else vars(value), kinds(type(part))
    whole = names.keys() <= values.keys()
    return {f"{name}.{key}" for key in names if key in values and not (whole and values[key] == getattr(type(part), key))}


def given_keys(scene, tables):
    """Names of the keys that the nested tables of a scene file give.

    A section with all its keys was written by tehl; of it only values count that differ from the default and from every
    built-in scene.
    """
    from tehl_taichi.scene.builtin import BUILT_INS

    usual = [{key: value for key, _, value in keys.every(one)} for one, _ in BUILT_INS.values()]
    values = {key: value for key, _, value in keys.every(scene)}
    found = set()
    for name, part in keys.parts(scene).items():
        table = _table(tables, name)
        whole = set(kinds(type(part))) <= set(table)
        found |= {f"{name}.{key}" for key in table if f"{name}.{key}" in values and not (
            whole and any(one.get(f"{name}.{key}") == values[f"{name}.{key}"] for one in usual))}
    return found


def _table(tables, name):
    section, _, rest = name.partition(".")
    found = tables.get(section, {})
    if section == "feature":
        found = found[int(rest)] if isinstance(found, list) else {}
    elif rest:
        found = found.get(rest, {})
    return found if isinstance(found, dict) else {}
