"""Page of a flank, from its folder: the position where a crack would start."""

from tehl_taichi.fatigue.pressure_alone import why_none
from tehl_taichi.report import place_plots, place_sections, place_verdict, position_pages
from tehl_taichi.report.document import Answer, Page, Section, facts, figure_block, sentences, table
from tehl_taichi.report.number_text import unit_spelled
from tehl_taichi.runs import place_warnings
from tehl_taichi.runs.flank import specific_film
from tehl_taichi.runs.flank.flank_columns import tables
from tehl_taichi.runs.flank.flank_figure import points
from tehl_taichi.runs.flank.place_panels import panels
from tehl_taichi.runs.flank.stored_flank import Flank
from tehl_taichi.scene.gear_pair import GearPair
from tehl_taichi.values.coded_text import without_options
from tehl_taichi.values.digits import number_of, printed_unit
from tehl_taichi.values.quantity import kinds
from tehl_taichi.values.summary_values import value_at
from tehl_taichi.view.figures.palette import GREY

ALONG = "x_pl from the pitch point (mm)"
UNKNOWN = ("beta", "d_a1", "d_a2", "Ra1", "Ra2", "lambda_GFP")  # 0: not given, or a spur gear
# of the geometry of a flank: name, unit
DERIVED = {"alpha_w_deg": ("working pressure angle", "deg"), "eps_alpha": ("transverse contact ratio", ""),
           "p_bt_m": ("transverse base pitch", "m"), "rho_C1_m": ("radius of curvature at C, pinion", "m"),
           "rho_C2_m": ("radius of curvature at C, gear", "m"), "u_C_m_s": ("speed of both surfaces at C", "m/s"),
           "F_bt_N": ("tooth force", "N"), "on": ("the feature is on the", ""), "table": ("table", "")}
READ = {"deg": "°", "deg C": "°C"}


def of(folder, out=None):
    """The :class:`tehl_taichi.report.document.Page` of the flank in `folder`; out: its file, for
    links. Raises StoreError."""
    flank = Flank.open(folder)
    store, words = _critical(flank)
    return Page(f"{flank.name}: report", f"{flank.title}, {number_of(len(flank.rows), 'position')}", answer(flank), (
        Section("Along the flank", (figure_block(*figures(flank)),)),
        Section("Positions", (*(table([unit_spelled(head) for head in heads], lines, title)
                                for title, (heads, lines) in tables(flank.rows).items()),
                              sentences(place_sections.passages(flank.rows, short_name)),
                              position_pages.line(flank, out, short_name))),
        *place_sections.critical(store, words), *place_sections.scene(store, words),
        Section("Not converged", (sentences([f"{_where(at)}: {reason}" for at, reason in flank.failed]),)),
        Section("Gears and load", (facts(gears(flank)),
                                   sentences([f"Load: {flank.record['load_sharing']}.", *no_film_words(flank)]))),
        Section("Warnings", (sentences(warnings(flank)),)),
        Section("Provenance", (facts(place_sections.provenance(
            flank.folder, [summary for *_, summary in flank.rows], "all positions")),))))


def _critical(flank):
    """(store of the critical position or None, text of the position)."""
    return place_sections.critical_place(flank, judged_places(flank), _where)


QUESTION = "Where along the flank does a fatigue crack start?"


def _where(at):
    """A position in words."""
    return f"{at.point}{', ' * bool(at.point)}x_pl = {at.x_pl * 1e3:.3f} mm"


def short_name(at):
    """Short text of a position."""
    return at.point or f"{at.x_pl * 1e3:.3g} mm"


def judged_places(flank):
    """The :class:`tehl_taichi.report.place_verdict.JudgedPlace` of every position with an index."""
    return place_verdict.judged_places(flank.rows, short_name, _where)


def limits(flank):
    """Sentences about the meaning of Fi = 1; () without an index."""
    return place_sections.limit(*_critical(flank))


def answer(flank):
    """The :class:`tehl_taichi.report.document.Answer` of a flank."""
    none = [f"No verdict at {_where(at)}: {why_none(part)}." for at, _, summary in flank.rows
            if (part := value_at(summary, "fatigue")) and why_none(part)]
    doubts = (*limits(flank), *none, *place_sections.missing(flank, "position"), f"Assumed: {flank.record['assumption']}.",
              *place_sections.counted(warnings(flank)))
    if places := judged_places(flank):
        headline, tone, sentences = place_verdict.answer(places, len(flank.rows))
        return Answer(QUESTION, headline, tone, (*sentences, *film_words(flank)), doubts)
    if none:
        return Answer(QUESTION, "No verdict: at all positions the film has more friction than any oil.", "open", (), doubts)
    return _of_films(flank, doubts)


def _of_films(flank, doubts):
    thinnest = place_verdict.thinnest(flank.rows)
    question = "How thick is the film along the flank?"
    if not thinnest:
        return Answer(question, "No answer: no position converged.", "none", (), doubts)
    text, at = thinnest
    return Answer(question, f"The smallest film is {text}, at {_where(at)}.", "none",
                  (*place_verdict.of_smooth_contacts(flank.rows, short_name, _where), *film_words(flank)), doubts)


def figures(flank):
    """Figures of film, pressure, temperature, index, friction and slip over the flank, if available."""
    return [_figure(flank, n, panel) for n, panel in enumerate(panels(flank, points))]


def _figure(flank, n, panel):
    """One of these figures, with the points A to E."""
    letters = ", dotted: the points of the path of contact" if flank.points else ""
    made = place_plots.figure(f"flank-{n}", ALONG, panel, "" if n else f"; dedendum left of the pitch point{letters}")
    made.layout["shapes"] = [_mark(x * 1e3) for x in flank.points.values()]
    made.layout["annotations"] = [{"text": name, "x": x * 1e3, "xref": "x", "yref": "paper", "y": 1, "yanchor": "bottom",
                                   "showarrow": False} for name, x in flank.points.items()]
    made.layout["legend"]["y"] = 1.08
    return made


def _mark(x):
    return {"type": "line", "xref": "x", "yref": "paper", "x0": x, "x1": x, "y0": 0, "y1": 1,
            "line": {"color": GREY, "width": 1, "dash": "dot"}}


def gears(flank):
    """Rows (label, value) of the geometry, lengths in printed units."""
    given, known = flank.record["geometry"], kinds(GearPair)
    rows = [(known[key].about.partition(";")[0], value_in(known[key].unit, given[key]))
            for key in known if _is_given(key, given)]
    return rows + [(name, value_in(unit, given[key])) for key, (name, unit) in DERIVED.items() if key in given]


def _is_given(key, given):
    value = given.get(key)
    return isinstance(value, (int, float)) and bool(value or key not in UNKNOWN)


def value_in(unit, value):
    """Text of a number of the gears with its unit."""
    if isinstance(value, (str, int)):
        return str(value)
    factor, shown = printed_unit(unit, value)
    return f"{value * factor:.6g} {READ.get(shown, shown)}".rstrip(" -")


def film_words(flank):
    """(sentence,) about the smallest specific film, () without one."""
    if not (least := specific_film.smallest(flank)):
        return ()
    ratio, at = least
    safety = specific_film.safety(flank)
    compared = f", S_λ = {safety:.3g} times the permissible one" if safety else "; its permissible value is not given"
    return (f"Smallest specific film of ISO/TS 6336-22: λ_GF = {ratio:.3g}, at {_where(at)}{compared}. The film of the formula "
            "(Dowson & Higginson) is that without a feature and with load factors of 1; h_min/Ra is the computed film.",)


def no_film_words(flank):
    """(sentence,) about the reason why film over roughness is missing, () if it exists."""
    if specific_film.smallest(flank) or any(value_at(summary, "lambda") is not None for *_, summary in flank.rows):
        return ()
    return ("λ is not known: the surfaces are smooth, and no roughness of the flanks is given (gear.Ra1, gear.Ra2).",)


def warnings(flank, spelled=without_options):
    """Warnings of all positions, each kind once with its positions; spelled: function for their texts (default: for a page)."""
    return place_warnings.of(flank.rows, short_name, spelled)
