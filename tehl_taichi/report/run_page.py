"""Page of one run, finished or not."""

import dataclasses

from tehl_taichi.report import (
    chain_plot,
    crack_plots,
    fatigue_plots,
    map_plots,
    numbered_points,
    passage_plots,
    run_in_plots,
    run_tables,
    scene_text,
    surface_plots,
    verdict,
    zoom_plots,
)
from tehl_taichi.report.document import Page, PageBlock, Section, facts, figure_block, sentences
from tehl_taichi.report.number_text import sentence_case
from tehl_taichi.report.searches import searches
from tehl_taichi.scene.feature_wording import position_word
from tehl_taichi.store.attributes import text
from tehl_taichi.store.reader import Reader
from tehl_taichi.values.coded_text import without_options

DARK = " Points that have not passed the contact by then are dark on the maps: they are not loaded yet."
NO_MAPS = " The store was written by an older version and has no maps of this part; `tehl fatigue` makes them."


def of(folder):
    """The :class:`tehl_taichi.report.document.Page` of the store in `folder`. Raises StoreError."""
    return page(Reader.open(folder))


def page(store, result=None):
    """Page of a :class:`tehl_taichi.store.reader.Reader`; result: the SearchResult, by default that of the store."""
    about = f"{store.scene.name}: a run of tehl_taichi {text(store.attrs, 'version')}"
    sections = (scene_section(store.scene, text(store.attrs, "scene_toml", "")),
                *surface_plots.section(store.scene, store.summary), *run_in_plots.section(store), *_film(store),
                *zoom_plots.section(store), *_fatigue(store, result), *crack_plots.section(store), *_made(store))
    answer = dataclasses.replace(verdict.of(store), known_before=tuple(store.scene.typed_warnings))
    return Page(f"{store.scene.name}: report", about, answer, sections)


def scene_section(scene, source):
    """Section about a scene: sentences, main numbers, and all values."""
    left_out = [without_options(one) for one in scene.left_out(cut=False)]
    whole = PageBlock("source", {"title": "every value, as a scene file", "text": source}) if source else None
    return Section("Scene", (PageBlock("text", {"sentences": scene_text.words(scene)}), facts(scene_text.numbers(scene)),
                             sentences(left_out, "Left out, because the scene does not need these parts"), whole))


def _film(store):
    """Section about pressure, film and temperatures."""
    line, histories = passage_plots.centreline(store), passage_plots.histories(store)
    moved, maps = line.more.get("slides"), tuple(figure_block(*row) for row in map_plots.rows(store))
    if not moved:
        return Section("Film and pressure", (figure_block(line), *maps), front=True),
    slider = PageBlock("slider", {"figures": [line], "first": moved["first"], "last": len(moved["at"]) - 1,
                             "what": position_word(store.scene)})
    return (Section("Passage", (slider,), front="fatigue" not in store.summary),
            Section("Histories", (figure_block(histories), run_tables.solid_contact(store.summary))),
            Section("Moment of the largest pressure", maps))


def _fatigue(store, result):
    """Sections about the index and the worst points, those that decide first."""
    if "fatigue" not in store.summary:
        return ()
    found = searches(store, result)
    return tuple(section for search in found for section in _of_search(store, search, search is found[0]))


def _of_search(store, search, front):
    """Three sections of a search; front: it decides the verdict."""
    of = (", resolved part" if search.on else ", whole passage") * bool(search.short)
    lead = f"The answer uses this {'part' if search.on else 'search'}: " * front
    shown = figure_block(*fatigue_plots.distribution(search), *fatigue_plots.index(search), *fatigue_plots.depth(search))
    behind = NO_MAPS if shown is None else DARK if search.on else ""
    words, numbers = [sentence_case(f"{lead}{search.when}.") + behind] * bool(search.short), search.result.numbers
    return (Section(f"Fatigue{of}", (PageBlock("text", {"sentences": words}) if words else None,
                                     figure_block(*chain_plot.figures(store, search)), shown, numbered_points.rows(search)),
                    front),
            Section(f"Critical points{of}", (run_tables.worst_points(numbers, search.scene), run_tables.tension(numbers))),
            Section(f"Stresses at the critical points{of}",
                    tuple(figure_block(*pair) for pair in fatigue_plots.worst_points(search))))


def _made(store):
    """Section about errors, and origin of the numbers."""
    return (Section("Numbers and their errors", tuple(run_tables.errors(store.summary))),
            Section("Numerics", (run_tables.numerics(store), figure_block(passage_plots.residual_plot(store)))),
            Section("Provenance", (run_tables.provenance(store),)))
