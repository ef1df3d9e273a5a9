"""Sentences and numbers about a scene."""

import math
import os

from tehl_taichi.laws import viscosity
from tehl_taichi.laws.rheology import LAWS
from tehl_taichi.report.number_text import value_text
from tehl_taichi.scene import data_sheet, fatigue_limits, mineral_alpha
from tehl_taichi.scene.feature_wording import feature_word, position_word, range_words
from tehl_taichi.scene.named_oils import NO_SOURCE
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.strength import scene_tables
from tehl_taichi.values.quantity import Number, Switch, Text, kinds

WHOLE = "over the whole passage"
LONG = 60  # letters of a word that is shown


def words(scene):
    """Sentences about a scene: note, contact, motion, oil, heat, features."""
    note = [f"Note: {scene.note}"] if scene.note else []
    return [*note, _contact(scene), _motion(scene), _oil(scene), _heat(scene), *_features(scene)]


def shared_words(scene):
    """Sentences about the common scene of a sequence of contacts: note, bodies, oil, heat, features."""
    return [*([f"Note: {scene.note}"] if scene.note else []), _bodies(scene), _oil(scene), _heat(scene), *_features(scene)]


def _contact(scene):
    c, s = scene.contact, Scales.of(scene)
    side = "" if c.kind != "elliptic" else f" along x and {value_text(c.radius_y, unit='m')} across"
    return (f"A {c.kind} contact of reduced radius {value_text(c.radius_x, unit='m')}{side} carries {_load(scene)}: Hertz "
            f"pressure {value_text(s.p_H, unit='Pa')}, {_half_axes(s)}. {_bodies(scene)}")


def _half_axes(s):
    """Text of the half-axes of the dry contact: along x, and along y for point contacts."""
    if s.line:
        return f"half-width {value_text(s.a, unit='m')}"
    return f"half-axes {value_text(s.a, unit='m')} along x and {value_text(s.b, unit='m')} across"


def _load(scene):
    return f"{scene.load / 1e3:.4g} N/mm" if scene.contact.kind == "line" else f"{scene.load:.4g} N"


def _bodies(scene):
    a, b = (body.material or f"E = {body.E / 1e9:.4g} GPa, ν = {body.nu:g}" for body in (scene.body_a, scene.body_b))
    return f"Both bodies: {a}." if a == b else f"Body a: {a}; body b: {b}."


def _motion(scene):
    o = scene.operation
    if o.srr == 0:
        return f"The surfaces roll at {o.u_m:.4g} m/s without slip."
    kind = "slower" if scene.reference.speed < o.u_m else "faster"
    carries = f"; the {feature_word(scene)} is on the {kind} surface, {scene.reference.name}" if scene.features else ""
    return (f"The surfaces move at {o.u_a:.4g} m/s (a) and {o.u_b:.4g} m/s (b): mean {o.u_m:.4g} m/s, slide-roll ratio "
            f"{o.srr:+.3g}{carries}.")


def _oil(scene):
    law = LAWS[scene.rheology.law]
    source = "source not given" if scene.oil.source == NO_SOURCE else scene.oil.source
    return (f"The oil is {scene.oil.name} ({source}) and enters at {scene.operation.temperature:g} °C. Its shear law is "
            f"{law.name}: {law.says}.")


def _heat(scene):
    if scene.isothermal:
        return "The film has the inlet temperature everywhere."
    return "The temperatures of the film and of both surfaces are computed."


def _features(scene):
    if not scene.transient:
        return ["No feature passes: steady contact of smooth surfaces." if scene.features else "The surfaces are smooth."]
    return [f"Surface {f.surface} (body {f.surface}) carries a feature of the shape {f.shape} ({f.kind.says}): "
            f"{', '.join(_sizes(f))}." for f in scene.features]


def _sizes(f):
    """Keys of the sizes of a feature that its shape uses."""
    own = kinds(type(f))
    alone = kinds(f.kind.keys) if f.kind.keys else {}
    keys = [key for key in own if key in f.kind.uses or key in alone] + ["x", "y"]
    for key in dict.fromkeys(keys):
        value, kind = getattr(f, key), own[key]
        if kind.unit == "-" and value == getattr(type(f), key):
            continue  # a factor that changes nothing
        if isinstance(kind, Number) and isinstance(value, (int, float)) and value:
            yield f"{key} {value_text(value, unit=kind.unit.replace('-', '1'))}"
        elif isinstance(kind, Text) and 0 < len(name := os.path.basename(value)) < LONG:  # a file without its folders
            yield f"{key} {name}"
        elif isinstance(kind, Switch) and value:
            yield key


def moments(scene):
    """Text such as 'feature up to 0.5 a': moments of a passage that count, '' if all do."""
    f = scene.fatigue
    ends = range_words(f.from_x, f.to_x)
    return f"{position_word(scene)} {ends}" if ends else ""


def when(scene):
    """Text of the moments of a search."""
    counted = moments(scene)
    return f"over all moments that count ({counted})" if counted else WHOLE


def material(fatigue, bodies="ab"):
    """Text of the source of kappa and the fatigue limit of these bodies; example values are marked."""
    if tables := scene_tables.words(fatigue, bodies):
        return tables
    default, own_source = type(fatigue)(), fatigue.source.strip().rstrip(".")
    if own_source.lower() not in ("", "example", "examples", default.source):
        limits = fatigue_limits.words(fatigue)
        if limits == fatigue.source:
            return limits + _example_kappa(fatigue)
        return f"{limits} ({own_source})" if limits else fatigue.source
    if own_source == default.source and (fatigue.kappa, fatigue.endurance) != (default.kappa, default.endurance):
        return "no source is given (fatigue.source)" + _example_kappa(fatigue)
    return "example values, replace them by those of your material and name the source (fatigue.source)"


def _example_kappa(fatigue):
    """Text that marks kappa if it is the example value, which neither a limit nor the user replaced."""
    example = fatigue.kappa == type(fatigue)().kappa and "kappa" not in fatigue_limits.derived_keys(vars(fatigue))
    return "; this kappa is an example value, give that of your material (fatigue.kappa, or both limits)" * example


def numbers(scene):
    """(label, value) of the numbers that readers compare first."""
    s = Scales.of(scene)
    rows = [("Hertz pressure p_H", value_text(s.p_H, unit="Pa")), ("half-width a", value_text(s.a, unit="m")),
            *([] if s.line else [("half-axis b, across", value_text(s.b, unit="m"))]), ("load", _load(scene)),
            ("reduced radius R'", value_text(s.R, unit="m")), ("reduced modulus E'", value_text(s.E, unit="Pa")),
            ("mean speed u_m", f"{scene.operation.u_m:.4g} m/s"), ("slide-roll ratio", f"{scene.operation.srr:g}"),
            *oil_numbers(scene)]
    return rows


def oil_numbers(scene):
    """(label, value) of the oil at the inlet, and of its law."""
    oil = scene.oil
    return [("inlet temperature", f"{scene.operation.temperature:g} °C"), ("viscosity at the inlet (p = 0)", _inlet(scene)),
            *_of_sheet(oil), ("viscosity law", oil.viscosity), *_of_oil(oil)]


def grid_numbers(scene):
    """(label, value) of the grid."""
    g, heat = scene.grid, "" if scene.isothermal else f" × {scene.thermal.nodes} nodes across the film"
    across = "" if scene.one_dimensional else f" × {g.ny}"
    return [("grid", f"{g.nx}{across} cells{heat}"), ("domain along x", f"{g.x_min:.3g} to {g.x_max:.3g} a")]


def _inlet(scene):
    """Text of the viscosity at the inlet."""
    eta = math.exp(float(viscosity.ln_eta(scene.oil, 0.0, scene.operation.temperature)))
    return f"{eta * 1e3:.4g} mPa s"


def _of_sheet(oil):
    """Rows of the data sheet behind the law's numbers, in its units; none without a sheet."""
    if not data_sheet.has_sheet(vars(oil)):
        return []
    rows = [(f"data sheet: kinematic viscosity at {at} °C", f"{nu * 1e6:.4g} mm²/s") for at, nu in
            ((40, oil.nu_40), (100, oil.nu_100))]
    density = [("data sheet: density at 15 °C", f"{oil.rho_15:g} kg/m³")] if oil.rho_15 else []
    return [*rows, *density, _alpha(oil)]


def _alpha(oil):
    """Row of the pressure coefficient of the data sheet, or its estimate."""
    if not data_sheet.is_alpha_estimated(oil):
        return "data sheet: α at 40 °C", f"{oil.alpha_40 * 1e9:.4g} 1/GPa"
    alpha = data_sheet.alpha_40(oil.nu_40, oil.rho0, oil.Dz)
    return ("α at 40 °C, not on the data sheet", f"{alpha * 1e9:.3g} 1/GPa, estimated as for a mineral oil, within "
            f"{mineral_alpha.WITHIN * 100:g} %")


def _of_oil(oil):
    """Rows of the numbers of the viscosity law, with their meaning."""
    declared = {key: one.metadata["kind"] for key, one in viscosity.LAWS[oil.viscosity].numbers.items()}
    return [(f"{key}: {kind.about}", f"{getattr(oil, key):.6g} {kind.unit}".rstrip(" -"))
            for key, kind in declared.items() if isinstance(kind, Number)]
