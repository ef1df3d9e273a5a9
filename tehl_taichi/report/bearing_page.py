"""Page of a rolling bearing, from its folder: static safety and film first, then loads, contacts and slip."""

import dataclasses
import os
from pathlib import Path

from tehl_taichi.fatigue.judged_surfaces import others
from tehl_taichi.report import place_sections
from tehl_taichi.report.document import Answer, Page, Section, facts, figure_block, sentences, table
from tehl_taichi.report.number_text import FEW, sentence_case, value_text
from tehl_taichi.report.plots import Figure, axis, colour, line, stack
from tehl_taichi.report.verdict import limit_words, of_fatigue
from tehl_taichi.runs.bearing import bearing_figure, bearing_table
from tehl_taichi.runs.bearing.rolling_bearing import OF_BALLS, OF_ROLLERS, ROLLER, RollingBearing
from tehl_taichi.runs.bearing.stored_bearing import Bearing
from tehl_taichi.scene import scene_file
from tehl_taichi.store.reader import Reader
from tehl_taichi.values.digits import printed_unit
from tehl_taichi.values.quantity import kinds
from tehl_taichi.values.summary_values import error_of, value_at

QUESTION = "Does the bearing carry its load, and how thick is the film?"
CRACK_QUESTION = "Does the bearing carry its load, and does a fatigue crack start?"  # of one over which a feature passes


def of(folder):
    """The :class:`tehl_taichi.report.document.Page` of the bearing in `folder`. Raises StoreError."""
    found = Bearing.open(folder)
    heads, rows = bearing_table.elements(found)
    store, ring = _store(found)
    maps = place_sections.critical(store, f"{ring} ring")
    return Page(f"{found.name}: report", found.title, answer(found), (
        Section("Loads and contacts", (facts(bearing_table.facts(found)), figure_block(*figures(found)))),
        *(dataclasses.replace(one, front=True) for one in maps[:1]), *maps[1:],
        *place_sections.scene(store, f"the {ring} ring"),
        Section("Both rings", (*(table(["quantity", "inner ring", "outer ring"], rows, title)
                                 for title, rows in bearing_table.tables(found).items()),
                               sentences(place_sections.passages(_results(found), lambda ring: f"the {ring} ring")))),
        Section("Elements", (table(heads, rows),)),
        Section("Without a result", (sentences([f"{ring} ring: {reason}" for ring, reason in found.failed.items()]),)),
        Section("Bearing", (facts(_dimensions(found)), sentences(_sources(found)))),
        Section("Warnings", (sentences(bearing_table.warnings(found)),)),
        Section("Provenance", (facts(place_sections.provenance(
            found.folder, [one["summary"] for one in found.rings.values()], "both contacts")),))))


def _results(found):
    return [(ring, None, one["summary"]) for ring, one in found.rings.items()]


def _store(found):
    """(Reader, name) of the ring with a passing feature, else of the one with the smaller static safety; (None, name) without a
    run.
    """
    order = sorted(found.rings, key=lambda ring: ("fatigue" not in (found.rings[ring]["summary"] or {}),
                                                  found.rings[ring]["static_safety"]))
    path = found.folder / Path(found.rings[order[0]]["store"]).name
    return Reader.open(path) if os.path.exists(path) else None, order[0]


def answer(found):
    """Answer: static safety, smallest film and its ratio to the roughness; fatigue if a feature passes."""
    ring, worst = min(found.rings.items(), key=lambda entry: entry[1]["static_safety"])
    safe, limit = worst["static_safety"], found.record["static_limit_Pa"]
    static = f"{'Yes' if safe >= 1 else 'No'}: static safety {safe:.2f} at the {ring} ring."
    cracks = list(_cracks(found))
    p_H = value_text(worst["p_Hertz_Pa"], unit="Pa", digits=FEW)
    why = [*[_film(found)] * bool(cracks), f"The Hertz pressure is {p_H}; ISO 76 allows "
           f"{limit / 1e9:g} GPa, where the permanent deformation is 0.0001 of the diameter of an element."]
    doubts = [*limits(found), f"Assumed: {'; '.join(found.record['assumptions'])}.",
              *_estimated(found),
              *place_sections.counted(bearing_table.warnings(found))]
    tone = "yes" if safe < 1 else cracks[0][1] if cracks else "none"
    if not cracks:
        return Answer(QUESTION, f"{static} {_film(found)}", tone, tuple(why), tuple(doubts))
    headline = " ".join([static, *(text for text, _ in cracks)])
    return Answer(CRACK_QUESTION, headline, tone, tuple(why), tuple(doubts))


def _film(found):
    """Sentence about the thinner film of both contacts."""
    films = [(ring, *_central_film(one), bearing_table.film_ratio(found.record, one)) for ring, one in found.rings.items()]
    ring, film, error, how, ratio = min(films, key=lambda entry: entry[1])
    return f"The central film is {value_text(film, error, 'm', FEW)}{how} at the {ring} ring" + (
        f", {ratio:.2g} times the roughness." if ratio else ".")


def _central_film(one):
    """(h_c in m, its error or None, " (by formula)" if it is not computed)."""
    film = value_at(one, "summary", "steady", "h_c_m")
    return (one["film_formula_m"], None, " (by formula)") if film is None else (film, error_of(
        one["summary"], "steady", "h_c_m"), "")


def _cracks(found):
    """(sentence, tone) of the fatigue of every ring over which a feature passed."""
    for ring, one in found.rings.items():
        if "fatigue" in (one["summary"] or {}):
            _, headline, tone, *_ = of_fatigue(one["summary"]["fatigue"], beside=others(one["summary"]))
            yield f"Fatigue crack at the {ring} ring? {headline}", tone


def limits(found):
    """Text of the meaning of Fi = 1, if a feature passed."""
    judged = [ring for ring, one in found.rings.items() if "fatigue" in (one["summary"] or {})]
    return limit_words(scene_file.load(found.folder / f"{judged[0]}.toml")) if judged else ()


def _estimated(found):
    """(sentence about dimensions that are not published,), () if all are."""
    return tuple(f"{sentence_case(words)}." for words in filter(None, [bearing_table.estimated_words(found)]))


def figures(found):
    """Figures of the loads around the ring, and of pressure and slip across both contacts."""
    azimuth, loads = bearing_figure.azimuths(found)
    bars = {"type": "bar", "x": azimuth.tolist(), "y": loads.tolist(), "marker": {"color": colour(0)}, "showlegend": False}
    layout = {"xaxis": axis(bearing_figure.AZIMUTH), "yaxis": axis(bearing_figure.LOADS),
              "margin": {"l": 10, "r": 14, "t": 8, "b": 10}}
    panels: list[tuple] = [("Hertz pressure (GPa)", _lines(bearing_figure.pressures(found), 1), {})]
    if bearing_figure.has_slip(found):
        panels.append(("slip (m/s)", _lines(bearing_figure.slip(found), 2, legend=False), {}))
    return [Figure("bearing-loads", "Load of the elements around the ring.", [bars], layout, 330),
            stack("bearing-contacts", "Both contacts across rolling: Hertz pressure"
                  f"{', and slip of the ring over the ball' * (len(panels) > 1)}.", bearing_figure.ACROSS, panels)]


def _lines(found, panel, legend=True):
    return [line(x.tolist(), y.tolist(), f"{ring} ring", colour(n), panel, in_legend=legend)
            for n, (ring, (x, y)) in enumerate(found.items())]


def _dimensions(found):
    """Rows of every relevant value of the bearing, with its meaning and printed units; oil and bodies."""
    known, which = kinds(RollingBearing), found.record["geometry"]
    idle = OF_BALLS if which["element"] == ROLLER else OF_ROLLERS
    values = [(known[key].about.partition(";")[0], _value(value, known[key])) for key, value in which.items()
              if key in known and key not in idle and value is not None]
    return [*values, ("oil", found.record["oil"]), ("inlet temperature", f"{found.record['temperature_C']:g} °C"),
            *((f"material of the {body}", words) for body, words in found.record["materials"].items())]


def _value(value, declared):
    if not isinstance(value, float):
        return str(value)
    factor, unit = printed_unit(declared.unit, value)
    return f"{value * factor:.6g} {unit}".rstrip(" -")


def _sources(found):
    """Text of the source of the dimensions, and of the scene files."""
    scenes = ", ".join(Path(one["scene_file"]).name for one in found.rings.values())
    return [f"Dimensions: {found.record['source']}.", f"Scenes of both contacts, to run and change: {scenes}.",
            *_estimated(found)]
