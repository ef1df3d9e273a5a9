"""Answer of a run in one sentence, and its reasons."""

from types import MappingProxyType

from tehl_taichi.fatigue.judged_layers import (
    ABOVE,
    BELOW,
    WITHIN,
    all_layers,
    deciding,
    deciding_point,
    judged,
    order,
    over,
    standing,
)
from tehl_taichi.fatigue.judged_surfaces import by_surface, others
from tehl_taichi.fatigue.pressure_alone import searched, why_none
from tehl_taichi.report.document import Answer
from tehl_taichi.report.number_text import index, sentence_case, value_text
from tehl_taichi.report.scene_text import WHOLE, material, moments, when
from tehl_taichi.runs import run_in_stage
from tehl_taichi.runs.summary import life, limit_meaning, rim_warnings
from tehl_taichi.runs.summary.result_warnings import passed_limit, passes_yield_stress, place_text, steel_bodies
from tehl_taichi.scene import feature_wording
from tehl_taichi.scene.strength.strength import Strength
from tehl_taichi.scene.timeline import total_steps
from tehl_taichi.values.digits import micrometres, number_of, part_of, with_error
from tehl_taichi.values.escape import typed
from tehl_taichi.values.summary_values import error_of

LATER = {state: f"Not decided: the index stays below 1 while the grid resolves the pressure, and {word} 1 later"
         for state, word in ((ABOVE, "exceeds"), (WITHIN, "may exceed"))}
SAID = {ABOVE: "above 1", WITHIN: "1 lies within the error", BELOW: "below 1"}
FATIGUE, FILM = "Does a fatigue crack start here?", "How thick is the film, and how large is the pressure?"


def of(store):
    """The :class:`tehl_taichi.report.document.Answer` of a run's store."""
    summary = store.summary
    if not summary:
        return _none_yet(store)
    found = (of_fatigue(summary["fatigue"], store.scene, others(summary)) if "fatigue" in summary else
             _of_film(summary, store.scene))
    question, headline, tone, sentences = found
    yields, rims = _yielding(summary, store.scene), list(rim_warnings.rims(store, summary))
    stated = {"yield": yields, "rim": rims}  # before the other doubts
    warnings = [one for one in store.warnings if not stated.get(one.code)]
    at_rim = [f"{sentence_case(rim)}." for rim in rims]
    doubts = (*yields, *at_rim, *_cut(store), *_constants(store, summary), *_version(store))
    sentences = (*sentences, *_run_in(summary), *_life(summary), *_read_first(warnings))
    return Answer(question, headline, tone, sentences, doubts, tuple(warnings))


def _life(summary):
    """Sentence about passages to initiation, if an exponent is given."""
    if "life" not in summary:
        return ()
    found = summary["life"]
    return (f"Initiation {life.place(found)}{over(found.get('length_m', 0.0))}: {life.words(found)}.",)


def _read_first(warnings):
    what = "warning" if len(warnings) == 1 else f"{len(warnings)} warnings"
    return (f"Read the {what} below first.",) if warnings else ()


def _spread(searches):
    """Sentences about rough surfaces: share above the limit, and the largest index with the number of searched points."""
    out = []
    for name, found in ((name, searched(one)) for name, one in searches.items()):
        if found.get("rough"):
            top, error = found["statistics"], error_of(found["statistics"], "share_above_1")
            share = _marked(with_error(100 * top["share_above_1"], None if error is None else 100 * error, "%", 2), error)
            largest = _index(found, "Fi_max")
            points = number_of(top["points"], "point")
            out.append(f"Surface {name}: {share} of it has Fi > 1; the largest of {points} is {largest}.")
    return out


def of_fatigue(fatigue, scene=None, beside=MappingProxyType({})):
    """(question, headline, tone, sentences) for the summary of the worse body's search and, in `beside` {surface: summary}, the
    other's.

    scene: of the run, for its moments and its passing feature; None: unknown, all moments of a feature.
    """
    searches = {fatigue.get("surface"): fatigue, **beside}
    if why := why_none(fatigue):
        return FATIGUE, f"No verdict: {why}.", "open", _from_pressure(searches)
    over, (parts, early) = when(scene) if scene else WHOLE, deciding(searches)
    worst, places, known, sentences = _judged_indices(searches)
    rough = any(searched(one).get("rough") for one in searches.values())
    verdict = headline(worst, places, known, ", by the 99th percentile of the index" * rough)
    if rough:
        sentences = ["99th percentile of the index:", *sentences, *_spread(searches)]
    elif early:
        verdict, sentences = _by_resolved_part(parts, worst, sentences, over, feature_wording.position_word(scene))
    text, tone = with_load(verdict, (_worst_alone(searches) or (None, None))[1])
    return FATIGUE, text, tone, (*_alone_words(searches), *sentences, *_plane(fatigue, searches))


def _from_pressure(searches):
    """Sentences about the index of the pressure alone."""
    sentences = (_index_sentence(*layer) for layer in all_layers(searches))
    return ("From the pressure alone, without surface shear and frictional heat:", *sentences)


def _judged_indices(searches):
    """(worst state, text of its places, whether their errors are known, sentences)."""
    found = all_layers(searches)
    worst = max(standing(Fi, error) for _, Fi, error in found)
    decide = [(where, error) for where, Fi, error in found if standing(Fi, error) == worst]
    places, known = _enumeration([where for where, _ in decide]), all(error is not None for _, error in decide)
    return worst[0], places, known, [_index_sentence(*layer) for layer in found]


def _enumeration(words):
    """Text such as 'A, B and C'; a note in brackets that all have is there once."""
    _, bracket, note = words[-1].partition(" (")
    once = bracket + note
    if once and all(word.endswith(once) for word in words):
        words = [word.removesuffix(once) for word in words]
    else:
        once = ""
    return " and ".join(filter(None, (", ".join(words[:-1]), words[-1]))) + once


def _by_resolved_part(parts, whole, sentences, over, whose):
    """((headline, tone), sentences) if the grid resolves the pressure only in a part of the passage.

    parts: {surface: summary of the resolved part}. whole, sentences: worst state and sentences of the whole passage. over: text
    about the passage; whose: text of the position at the end of the resolved part.
    """
    worst, places, known, early = _judged_indices(parts)
    end = f"{whose} up to {_place(next(iter(parts.values()))['to_x_a'])}"
    sentences = [f"While the grid resolves the pressure ({end}; the rest can only add):", *early,
                 f"{sentence_case(over)}, where the grid does not resolve the pressure:", *sentences]
    return _resolved_headline(worst, whole, places, known, over), sentences


def _resolved_headline(worst, whole, places, known, over):
    """(headline, tone): worst, whole: states of the index in the resolved part, which is a lower limit, and in the passage."""
    if worst != BELOW:
        even = "even " if worst == ABOVE else ""
        return headline(worst, places, known, f", {even}without the pressures that the grid does not resolve")
    if whole == BELOW:
        return f"Probably not: the index stays below 1, but {over} its error is unknown.", "no"
    return f"{LATER[whole]}.", "open"


def _place(x):
    """Text of a position of the feature (a), for readers who do not know the frame."""
    if round(x, 2) == 0:
        return "the middle of the contact"
    side = "before" if x < 0 else "behind"
    return f"{x:.2f} a, that is {abs(x):.2f} half-widths {side} the middle of the contact"


def _index_sentence(where, Fi, error):
    return f"{sentence_case(where)}: Fi = {_marked(index(Fi, error), error)}, {SAID[judged(Fi, error)]}."


def _index(part, key):
    """Text of an index of a part of the summary."""
    error = error_of(part, key)
    return _marked(index(part[key], error), error)


def _marked(text, error):
    """The text of a number, with a note if its error is not known."""
    return text if error is not None else f"{text} (error unknown)"


def headline(worst, places, known, when=""):
    """(headline, tone); known: the errors are known; when: text of a part of the passage."""
    if worst == WITHIN:
        return f"Not decided: the index is 1 within its error {places}{when}.", "open"
    yes, no, more = ("Yes", "No", "") if known else ("Probably yes", "Probably not", "; the error of this is unknown")
    if worst == ABOVE:
        return f"{yes}: the fatigue limit is exceeded {places}{when}{more}.", "yes"
    return f"{no}: the index stays below 1{when}{more}.", "no"


def with_load(verdict, alone):
    """(headline, tone), with a note if the load alone exceeds the limit, which answers where `verdict` does not.

    alone: numbers of the smooth contact, or None.
    """
    if not alone or judged(alone["Fi_max"], error := error_of(alone, "Fi_max")) != ABOVE:
        return verdict
    text, tone = verdict
    if text.startswith("Yes") or tone == "yes" and error is None:
        return f"{text.removesuffix('.')}. The load alone exceeds it, without any feature.", tone
    load, tone = headline(ABOVE, "by the load alone, without any feature", error is not None)
    return f"{load} Around the feature: {text[0].lower()}{text[1:]}", tone


def _worst_alone(searches):
    """(surface, numbers) of the smooth body whose index decides, or None."""
    found = [(name, part) for name, one in searches.items() if (part := searched(one).get("contact_alone"))]
    return max(found, key=state_and_index, default=None)


def state_and_index(named):
    """Order of (name, numbers) by what is known of the index, then by the index."""
    return order(named[1]["Fi_max"], error_of(named[1], "Fi_max"))


def _alone_words(searches):
    """Sentence about the index of the smooth contact."""
    if not (worst := _worst_alone(searches)):
        return ()
    name, alone = worst
    Fi, top = (_index(alone, key) for key in ("Fi_max", "surface_Fi_max"))
    body, over = f"surface {name}" if name else "the surface", judged(alone["Fi_max"], error_of(alone, "Fi_max"))
    if not alone["depth_m"]:
        return (f"The smooth contact alone: Fi = {Fi} at {body}, {SAID[over]}.",)
    where = f"at {micrometres(alone['depth_m'])} µm below {body}"
    return (f"The smooth contact alone: Fi = {Fi} {where}, {SAID[over]}, and {top} at {body}.",)


def _plane(fatigue, searches):
    """Sentence about the critical plane of the point that decides."""
    pits = fatigue.get("pit_angles_deg")
    known = (f" For comparison, pits on gear flanks were found to begin at {pits[0]:g} to {pits[1]:g}° to the surface."
             if pits else "")
    where, point = deciding_point(searches)
    return (f"The critical plane {where}, on which a crack would begin, is at {point['surface_angle_deg']:.0f}° to the "
            f"surface.{known}",)


def _of_film(summary, scene):
    part, when = (summary["transient"], "least") if "transient" in summary else (summary["steady"], "smallest")
    film, pressure = (_with_error(part, key, unit) for key, unit in (("h_min_m", "m"), ("p_max_Pa", "Pa")))
    centre = _with_error(summary["steady"], "h_c_m", "m")
    why = f"Left out: {scene.without_fatigue}." if scene.without_fatigue else ""
    alone = {name: {"contact_alone": found} for name, found in summary.get("contact_alone_by_surface", {}).items()}
    return FILM, f"The {when} film is {film}, the largest pressure {pressure}.", "none", tuple(filter(None, (
        f"The film in the middle of the steady contact is {centre}.", *_alone_words(alone), why)))


def _with_error(part, key, unit):
    error = error_of(part, key)
    return _marked(value_text(part[key], error, unit), error)


def _none_yet(store):
    total, writer = total_steps(store.scene), store.writer
    state = (f"It is still being written by {writer}." if writer else
             f"It was stopped, or a step did not converge; `tehl resume {typed(store.path.name)}` continues it.")
    question = FATIGUE if store.scene.has_fatigue else FILM
    steps = part_of(store.last_step, total, "time step", "is", "are")
    return Answer(question, "No answer yet: the run is not finished.", "none", (
        f"{steps} stored{run_in_stage.words(store)}. {state}",), _version(store),
        tuple(store.warnings))


def _cut(store):
    if store.cut is None:
        return ()
    return (f"The passage ends at {store.cut:.2f} a, inside the contact; later moments are not part of these numbers.",)


def _yielding(summary, scene):
    """Warning that a body would yield; it comes first because it changes the meaning of the index."""
    found = summary.get("von_mises")
    if "fatigue" not in summary or not found or not passes_yield_stress(found) or found["surface"] in steel_bodies(summary):
        return ()
    elastic = ("Both bodies are elastic here, while real ones would yield there and flatten; the index is that of elastic "
               "bodies.")
    if "run_in" in summary:
        elastic = "This body has no yield stress, so it is elastic here, while a real one would yield."
    limit, doubt = passed_limit(found, scene)
    return (f"The von Mises stress reaches {found['max_Pa'] / 1e9:.2f} GPa {place_text(found, 'µm')}, more than "
            f"{limit}. {f'{sentence_case(doubt)}.' if doubt else elastic}",)


def _run_in(summary):
    """Sentence about the effect of run-in, which changes the index."""
    if not (found := summary.get("run_in")):
        return ()
    if not found["plastic_strain_max"]:
        return ("Run-in: no steel yields, so the passage is that of elastic bodies.",)
    before, after = (found.get(f"height_{when}_m") for when in ("before", "after"))
    height = "" if after is None else f"the height is {value_text(after, unit='m')} ({value_text(before, unit='m')} before), "
    count = f"{found['passages']} passages" if found["passages"] > 1 else "one passage"
    return (f"After {count} of run-in {height}the surface has changed by up to "
            f"{value_text(found['surface_change_max_m'], unit='m')}, and the residual stress is "
            f"{found['residual_min_Pa'] / 1e6:.0f} to {found['residual_max_Pa'] / 1e6:.0f} MPa; the index counts both.",)


def _counted(scene):
    """Sentence about the part of the passage that counts, if it is not all of it."""
    counted = moments(scene)
    return (f"Only moments with the {counted} count (fatigue.from_x, to_x).",) if counted else ()


def _constants(store, summary):
    if "fatigue" not in summary:
        return (*limit_words(store.scene), *_meaning(store, summary)) if "contact_alone" in summary else ()
    found = {name: searched(one) for name, one in by_surface(summary).items()}
    limits = _limits({name: (f["sigma_eF_Pa"], f["kappa_F"], f["criterion"]) for name, f in found.items()}, store.scene.fatigue)
    stress = "counts" if searched(summary["fatigue"])["thermal_stress"] else "does not count"
    return (*limits, *_meaning(store, summary), f"Thermal stress {stress} in the index.", *_counted(store.scene))


def _meaning(store, summary):
    """Sentence about the meaning of the limit."""
    return filter(None, [limit_meaning.sentence(summary, store.scene.fatigue)])


def limit_words(scene):
    """Sentences about the meaning of Fi = 1: source of the limit; one for each body if they differ."""
    found = {surface.name: Strength(scene.fatigue, surface).at(0.0) for surface in scene.judged or scene.surfaces}
    return _limits({name: (local.endurance, local.kappa, local.criterion) for name, local in found.items()}, scene.fatigue)


def _limits(bodies, known):
    """Sentences about {body: (limit (Pa), kappa, criterion) at its surface}; known: the section [fatigue], which has the
    source."""
    alike: dict = {}
    for name, numbers in bodies.items():
        alike.setdefault((numbers, known.table_text(name)), []).append(name)
    return tuple(_limit(numbers, names, known, len(alike) > 1) for (numbers, _), names in alike.items())


def _limit(numbers, names, known, apart):
    """Sentence about the limit of the bodies `names`; numbers: as in :func:`_limits`; apart: another body has another one."""
    stress, kappa, criterion = numbers
    where = f" at the surface{f' of body {names[0]}' * apart}" if known.table_text(names[0]) or apart else ""
    return (f"Fi = 1 is the fatigue limit{where} σ_eF = {stress / 1e6:.4g} MPa with κ = {kappa:.4g} ({criterion}): "
            f"{material(known, names)}.")


def _version(store):
    return (f"The store was {store.other_version}.",) if store.other_version else ()
