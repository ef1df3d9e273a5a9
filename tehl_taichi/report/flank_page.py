"""Page of a flank, from its folder: the position where a crack would start."""

from tehl_taichi.fatigue.pressure_alone import why_none
from tehl_taichi.report import place_page, place_plots, place_verdict
from tehl_taichi.report.document import Answer, Section, facts, sentences
from tehl_taichi.runs.flank import specific_film
from tehl_taichi.runs.flank.flank_columns import tables
from tehl_taichi.runs.flank.flank_figure import points
from tehl_taichi.runs.flank.place_panels import panels
from tehl_taichi.runs.flank.stored_flank import Flank
from tehl_taichi.scene.gear_pair import GearPair
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


QUESTION = "Where along the flank does a fatigue crack start?"


def of(folder, out=None):
    """The :class:`tehl_taichi.report.document.Page` of the flank in `folder`; out: its file, for
    links. Raises StoreError."""
    flank = Flank.open(folder)
    load = sentences([f"Load: {flank.record['load_sharing']}.", *no_film_words(flank)])
    return place_page.page(flank, f"{flank.title}, {number_of(len(flank.rows), 'position')}", answer(flank),
                           ("Along the flank", figures(flank)), ("Positions", tables(flank.rows)),
                           [Section("Gears and load", (facts(gears(flank)), load))], out=out)


def answer(flank):
    """The :class:`tehl_taichi.report.document.Answer` of a flank."""
    none = [f"No verdict at {at.full}: {why_none(part)}." for at, _, summary in flank.rows
            if (part := value_at(summary, "fatigue")) and why_none(part)]
    doubts = place_page.doubts(flank, "position", none)
    if places := place_page.judged_places(flank):
        headline, tone, sentences = place_verdict.answer(places, len(flank.rows))
        return Answer(QUESTION, headline, tone, (*sentences, *film_words(flank)), doubts)
    if none:
        return Answer(QUESTION, "No verdict: at all positions the film has more friction than any oil.", "open", (), doubts)
    return _of_films(flank, doubts)


def _of_films(flank, doubts):
    thinnest = place_verdict.thinnest(flank.rows)
    question = "How thick is the film along the flank?"
    if not thinnest:
        return Answer(question, "No answer: no position has a result.", "none", (), doubts)
    text, at = thinnest
    return Answer(question, f"The smallest film is {text}, at {at.full}.", "none",
                  (*place_page.smooth_contacts(flank), *film_words(flank)), doubts)


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
    return (f"Smallest specific film of ISO/TS 6336-22: λ_GF = {ratio:.3g}, at {at.full}{compared}. The film of the formula "
            "(Dowson & Higginson) is that without a feature and with load factors of 1; h_min/Ra is the computed film.",)


def no_film_words(flank):
    """(sentence,) about the reason why film over roughness is missing, () if it exists."""
    if specific_film.smallest(flank) or any(value_at(summary, "lambda") is not None for *_, summary in flank.rows):
        return ()
    return ("λ is not known: the surfaces are smooth, and no roughness of the flanks is given (gear.Ra1, gear.Ra2).",)
