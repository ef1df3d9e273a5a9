"""Sections of pages about sequences of contacts: critical position with its maps, common scene, meaning of the limit."""

from tehl_taichi.report import fatigue_plots, map_plots, place_verdict, scene_text, surface_plots
from tehl_taichi.report.document import PageBlock, Section, facts, figure_block
from tehl_taichi.report.searches import searches
from tehl_taichi.report.verdict import limit_words
from tehl_taichi.runs.summary import limit_meaning
from tehl_taichi.store.attributes import text
from tehl_taichi.values.digits import part_of
from tehl_taichi.values.summary_values import value_at
from tehl_taichi.view.figures.map_panels import is_turned

MAPS = ("map-pressure", "map-film")


def critical_number(rows, places):
    """Number of the critical position: the largest index, else the thinnest film; None without results. places: those with an
    index (:class:`tehl_taichi.report.place_verdict.JudgedPlace`).
    """
    if places:
        return place_verdict.worst(places).number
    films = {n: film for n, (*_, summary) in enumerate(rows) if (film := value_at(summary, "steady", "h_min_m")) is not None}
    return min(films, key=lambda n: films[n], default=None)


def critical_place(contacts, places, words):
    """(store of the critical position of a flank or a cam, text of the position); (None, "") without results. places: as for
    :func:`critical_number`; words: function of a position that gives its text."""
    number = critical_number(contacts.rows, places)
    return (None, "") if number is None else (contacts.store_of(number), words(contacts.rows[number][0]))


def critical(store, words):
    """Each :class:`Section` of the position of this store, called `words`: its maps, and those of the middle of a wide ellipse;
    () without a store or maps.
    """
    if not store or not store.finished:
        return ()
    found = map_plots.maps(store)
    maps = [figure for figure in found if figure.name in MAPS]
    middles = [figure for figure in found if figure.name.removesuffix(map_plots.SHORT) in MAPS and figure not in maps]
    index = fatigue_plots.index(searches(store)[0]) if "fatigue" in store.summary else []
    rows = [[one] for one in maps] if is_turned(store.scene) else [maps]
    parts = [part for part in (figure_block(*index), *(figure_block(*row) for row in rows)) if part]
    return tuple(one for one in (Section(f"Critical position: {words}", tuple(parts)),
                                 Section(f"Middle of the contact: {words}", (figure_block(*middles),))) if one.shown)


def scene(store, words):
    """Sections of the surface and the scene; words: text of the position whose scene is shown."""
    if not store:
        return ()
    one, source = store.scene, text(store.attrs, "scene_toml", "")
    whole = PageBlock("source", {"title": f"every value at {words}, as a scene file", "text": source}) if source else None
    return (*surface_plots.section(one, store.summary),
            Section("Scene", (PageBlock("text", {"sentences": scene_text.shared_words(one)}),
                              facts([*scene_text.oil_numbers(one), *scene_text.grid_numbers(one)]), whole)))


def passages(rows, words):
    """(sentence about the index behind the passages in a table of places,), () without passages. rows: (place, Hertz pressure,
    summary or None); words: function of a place that gives its text.
    """
    found = {words(at): early for at, *_, summary in rows if (early := value_at(summary, "life", "resolved")) is not None}
    if not found:
        return ()
    early = ", ".join(name for name in found if found[name])
    most = f"; at {early} the grid does not resolve the pressure of the whole passage, which can only lower them"
    return (f"Passages and hours to initiation are those of the index that decides at each place{most * bool(early)}.",)


def provenance(folder, summaries, runs, *more):
    """Rows of provenance; summaries: of the runs (None: no result); runs: their name; more: rows after the folder."""
    ran = [one for one in summaries if one]
    rows = [("version", ", ".join(sorted({one["version"] for one in ran}))),
            (f"run time of {runs}", f"{sum(one['wall_s'] for one in ran):.0f} s")]
    return [("folder", folder.name), *more, *(rows if ran else [])]


def missing(found, noun):
    """(sentence about the places without a result,) of a flank or a cam, () without such places."""
    count = part_of(len(found.failed), len(found.rows), noun, "has no result and is", "have no result and are")
    return (f"{count} not part of this answer.",) if found.failed else ()


def counted(warnings):
    """(number of warnings as a sentence,), () without warnings."""
    return (f"Number of warnings, listed below: {len(warnings)}.",) if warnings else ()


def limit(store, words):
    """Sentences about the meaning of Fi = 1; () without an index. words: text of the position of the store."""
    if not store or not {"fatigue", "contact_alone"} & store.summary.keys():
        return ()
    return (*limit_words(store.scene), *filter(None, [limit_meaning.sentence(
        store.summary, store.scene.fatigue, f"like that at {words}")]))
