"""Warnings about a scene that can be simulated, known before a run; one sentence each."""

from tehl_taichi.laws.hardness import RELATIONS
from tehl_taichi.scene import (
    domain,
    domain_warnings,
    film_formula,
    idle_keys,
    keys,
    named_steels,
    oil_range,
    replaced_keys,
    resolution,
    scales,
    slow_surfaces,
    stiff_oil,
    surface_roughness,
    thick_film,
    thin_film,
    timeline,
    zoom_room,
)
from tehl_taichi.scene.strength.strength import Strength
from tehl_taichi.scene.strength.table import HARDNESS
from tehl_taichi.values.coded_text import Option
from tehl_taichi.values.coded_warning import coded_warning, unique, with_data
from tehl_taichi.values.quantity import Number


def warnings(scene):
    """Warnings with the value, the unit and a remedy, each once, with its code; [] without doubts."""
    return coded_warning(CHECKS, scene)


def preview(scene):
    """Lines about its features, printed before a run, each once."""
    return unique([*(line for feature in scene.features for line in feature.kind.preview(feature, scene)), *_roughness(scene)])


def _roughness(scene):
    """One line for each rough surface, and the film by formula over their roughness."""
    found = surface_roughness.by_surface(scene)
    for name, one in found.items():
        before = f" (before the filter {one.before.words})" if one.before else ""
        yield f"surface {name}: {one.used.words}{before}"
    if found and (Sq := surface_roughness.combined(found)[0]):
        yield f"lambda = h_c/Sq by formula: {film_formula.central_film(scene) / Sq:.2g}"


def doubtful_features(scene):
    """Warnings of the shapes of the features."""
    return [sentence for feature in scene.features for sentence in feature.kind.doubts(feature, scene)]


def cut_passage(scene):
    """Warning about a passage that ends while the feature is still in the contact; a passage of 0 steps was the user's
    choice.
    """
    end = timeline.cut_at(scene)
    if end is not None and scene.time.steps != 0:
        whole = timeline.whole_passage(scene).path[1]
        option = Option("; `tehl resume STORE` continues", "")
        yield with_data(f"passage cut at {end:.2f} a: its extremes and fatigue cover only a part; the whole passage ends at "
                        f"{whole:.2f} a{option}", option, end_a=end, whole_a=whole)


MISSED = 0.35  # of Fi, per a between moments: at most 2, 3.6 and 7 % at 0.06, 0.125 and 0.19 a (gear, every choice of moments)


def thinned(scene):
    """Warning about moments that a fatigue search misses because not every step is stored."""
    every, apart = scene.output.every, scene.output.every * timeline.step_length(scene)
    if every > 1 and scene.has_fatigue:
        text = (f"output.every = {every} leaves {apart:.3f} a between the moments of the fatigue search, so Fi can be "
                f"{MISSED * apart:.0%} too small; use a distance of about 0.01 a at entry and exit (every step has "
                f"{apart / every:.3f} a)")
        yield with_data(text, every=every, apart_a=apart)


FAINT, PRESSED = 1e8, 3e8  # Pa: steel under less hardly needs this program; what a load in another unit gives at least


def unusual(scene):
    """Hints about values that were perhaps meant in another unit."""
    for key, kind, value in keys.every(scene):
        if isinstance(kind, Number) and isinstance(value, float) and (hint := kind.doubted(key, value)):
            yield with_data(hint, key=key)
    p_H = scales.Scales.of(scene).p_H
    if scene.contact.load and p_H < FAINT and (hint := scene.load_meant(least=PRESSED)):
        yield with_data(f"contact.load = {scene.contact.load:g} {scene.load_unit} gives a Hertz pressure of only "
                        f"{p_H / 1e6:.0f} MPa{hint}", key="contact.load")


def counted_twice(scene):
    """Warning about residual stress given with a limit that already contains it."""
    f = scene.fatigue
    if not scene.has_fatigue or f.limit_of != "contact":
        return
    strengths = [Strength(f, surface) for surface in scene.judged]
    if f.residual_xx or f.residual_yy or any(one.varies_in_residual for one in strengths):
        yield ("fatigue.limit_of = contact: such a limit contains the residual stress of the contact that it was measured on, "
               "so the given residual stress counts twice; set limit_of = specimen, or no residual stress")


def beyond_relation(scene):
    """Warning about hardness outside the range of the relation that gives the limit."""
    tables = [Strength(scene.fatigue, surface).table for surface in scene.judged] if scene.has_fatigue else []
    hardness = [value for table in tables if table and table.has(HARDNESS) for value in table.columns[HARDNESS]]
    relation = RELATIONS[scene.fatigue.relation]
    if hardness and (min(hardness) < relation.low or max(hardness) > relation.high):
        text = (f"the table has {min(hardness):g} to {max(hardness):g} HV; fatigue.relation = {relation.name} is used for "
                f"{relation.low:g} to {relation.high:g} HV, and limits beyond that range are extrapolated")
        yield with_data(text, hardness_HV=[min(hardness), max(hardness)], range_HV=[relation.low, relation.high])


def left_out_of_window(scene):
    """Features that have no window although they pass, because they leave no space for one."""
    for surface in zoom_room.others(scene) if scene.zooms else []:
        if why := zoom_room.no_room(scene, surface):
            followed = scene.reference.name
            yield with_data(f"surface {surface.name} has no window of its own ({why}); the window of surface {followed} "
                            "resolves only the features that lie in it at the same time", surface=followed)


def wide_domain(scene):
    """Warning that "auto" moved the inlet away from a thick film."""
    return filter(None, [domain.moved(scene)])


def short_domain(scene):
    """Warning about an end of the domain that the user fixed inside a thick film."""
    return filter(None, [domain.too_short(scene)])


# functions of a scene that give its sentences, with the code of these
CHECKS = {resolution.warnings: "cells", domain_warnings.warnings: "room", thin_film.warnings: "film", oil_range.warnings: "oil",
          named_steels.doubts: "steel", cut_passage: "cut", thinned: "moments", doubtful_features: "feature",
          unusual: "unit", idle_keys.doubts: "idle", wide_domain: "inlet", short_domain: "domain",
          stiff_oil.warnings: "frozen", counted_twice: "residual", beyond_relation: "hardness", left_out_of_window: "window",
          thick_film.warnings: "thick", slow_surfaces.warnings: "slow", replaced_keys.warnings: "replaced"}
