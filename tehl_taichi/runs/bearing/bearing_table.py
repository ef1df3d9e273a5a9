"""Numbers of both rings, one row each, for the table on the screen, the page and the CSV file."""

import math

from tehl_taichi.runs import place_warnings, table_column
from tehl_taichi.runs.bearing.ring_contacts import RINGS
from tehl_taichi.runs.flank.flank_columns import PASSAGE, judged_index, title_of
from tehl_taichi.runs.table_column import TableColumn
from tehl_taichi.values.summary_values import error_of, value_at


def of_ring(*keys):
    """Function that finds a value in the record of a ring by its keys."""
    return lambda bearing, ring: value_at(ring, *keys)


def _result(part, name, label, factor, form, *keys):
    """Row of a number in the summary of a ring, with its error bar."""
    return TableColumn(name, label, factor, form, of_ring("summary", *keys), part,
                       lambda bearing, ring: error_of(ring["summary"], *keys))


def film_ratio(bearing, ring):
    """Film parameter lambda: central film over the combined rms height of both surfaces; the computed film if it exists."""
    if (own := value_at(ring, "summary", "lambda")) is not None:
        return own
    film = value_at(ring, "summary", "steady", "h_c_m") or ring.get("film_formula_m")
    Sq = bearing.get("roughness_Sq_m")
    return film / Sq if film and Sq else None


def sliding_friction(bearing, ring):
    """Friction coefficient of the run; None for rollers, whose contacts do not slip."""
    return value_at(ring, "summary", "steady", "friction_coefficient") if ring["slip"] else None


def sliding_loss(bearing, ring):
    """Power loss (W) by slip in the most loaded contact: friction coefficient x load x mean slip."""
    friction = sliding_friction(bearing, ring)
    return None if friction is None else friction * ring["load_N"] * ring["slip"]["mean_m_s"]


def slip_torque(bearing):
    """Power loss (W) and friction torque (N m) by slip in all contacts of a bearing record; None without runs, or with spin.

    The mean slip of a contact is proportional to b^2, that is Q^(2/3), and its loss to Q^(5/3); the friction coefficient is
    that of the most loaded contact.
    """
    losses = [sliding_loss(bearing, bearing[ring]) for ring in RINGS]
    if None in losses or any(bearing[ring]["spin_rad_s"] for ring in RINGS):
        return None
    shares = sum((load / bearing["ball_load_max_N"]) ** (5 / 3) for load in bearing["loads_N"])
    which, power = bearing["geometry"], sum(losses) * shares
    return power, power / (abs(which["speed"] - which["outer_speed"]) * math.pi / 30)


CONTACT, MOTION, FILM, _ = PARTS = ("contact", "motion", "film", PASSAGE)
ROWS = (
    TableColumn("contact", "contact", 1, "", of_ring("contact"), CONTACT),
    TableColumn("load_N", "load, N", 1, ".1f", of_ring("load_N"), CONTACT),
    TableColumn("R_x_m", "R_x, mm", 1e3, ".4g", of_ring("R_x_m"), CONTACT),
    TableColumn("R_y_m", "R_y, mm", 1e3, ".4g", of_ring("R_y_m"), CONTACT),
    TableColumn("a_m", "half-axis a along rolling, mm", 1e3, ".4g", of_ring("a_m"), CONTACT),
    TableColumn("b_m", "half-axis b across, mm", 1e3, ".4g", of_ring("b_m"), CONTACT),
    TableColumn("p_Hertz_Pa", "Hertz pressure, GPa", 1e-9, ".3f", of_ring("p_Hertz_Pa"), CONTACT),
    TableColumn("static_safety", "static safety (ISO 76)", 1, ".2f", of_ring("static_safety"), CONTACT),
    TableColumn("u_m_m_s", "entrainment speed, m/s", 1, ".3f", of_ring("u_m_m_s"), MOTION),
    TableColumn("srr_centre", "SRR at the centre", 1, ".3g", of_ring("slip", "srr_centre"), MOTION),
    TableColumn("srr_edge", "SRR at the end of the ellipse", 1, ".3g", of_ring("slip", "srr_edge"), MOTION),
    TableColumn("srr", "SRR of the run", 1, ".3g", of_ring("slip", "srr"), MOTION),
    TableColumn("slip_mean_m_s", "mean slip, m/s", 1, ".4f", of_ring("slip", "mean_m_s"), MOTION),
    TableColumn("spin_rad_s", "spin, rad/s", 1, ".1f", lambda bearing, ring: ring["spin_rad_s"] or None, MOTION),
    TableColumn("passes_per_s", "passes of elements per second", 1, ".2f", of_ring("passes_per_s"), MOTION),
    TableColumn("film_formula_m", "h_c by formula, um", 1e6, ".3f", of_ring("film_formula_m"), FILM),
    _result(FILM, "h_c_m", "h_c, um", 1e6, ".3f", "steady", "h_c_m"),
    _result(FILM, "h_min_m", "h_min, um", 1e6, ".3f", "steady", "h_min_m"),
    TableColumn("lambda", "lambda = h_c/Sq", 1, ".2f", film_ratio, FILM),
    TableColumn("friction_coefficient", "friction coefficient at the SRR of the run", 1, ".4f", sliding_friction, FILM,
                lambda bearing, ring: error_of(ring["summary"], "steady", "friction_coefficient")),
    TableColumn("sliding_loss_W", "sliding loss of the most loaded contact, W", 1, ".3g", sliding_loss, FILM),
    _result(FILM, "film_max_C", "film temperature, deg C", 1, ".1f", "steady", "film_max_C"),
    _result(PASSAGE, "passage_p_max_Pa", "largest pressure, GPa", 1e-9, ".3f", "transient", "p_max_Pa"),
    _result(PASSAGE, "passage_h_min_m", "smallest film, um", 1e6, ".3g", "transient", "h_min_m"),
    _result(PASSAGE, "Fi_max", "Fi at the surface", 1, ".3f", "fatigue", "Fi_max"),
    _result(PASSAGE, "Fi_max_below", "Fi below the surface", 1, ".3f", "fatigue", "below", "Fi_max"),
    TableColumn("Fi_judged", "Fi judged", 1, ".3f", lambda bearing, ring: judged_index(ring["summary"])[0], PASSAGE,
                lambda bearing, ring: judged_index(ring["summary"])[1]),
    _result(PASSAGE, "von_mises_max_Pa", "largest von Mises stress, GPa", 1e-9, ".3f", "von_mises", "max_Pa"),
    _result(PASSAGE, "passages", "passages to initiation", 1, ".2g", "life", "passages"),
    _result(PASSAGE, "hours", "hours to initiation", 1, ".2g", "life", "hours"))


def tables(bearing):
    """{title: rows of (label, inner, outer)} of the parts with values; bearing: a Bearing."""
    out = {}
    for part in PARTS:
        found = [(row.head, *(row.shown(bearing.record, ring) for ring in bearing.rings.values()))
                 for row in ROWS if row.table == part and _has(row, bearing)]
        if found:
            out[title_of(part, [bearing.record[ring]["summary"] for ring in RINGS])] = found
    return out


def _has(row, bearing):
    return any(row.value(bearing.record, ring) is not None for ring in bearing.rings.values())


def elements(bearing):
    """(column heads, rows) of the loads of the elements."""
    one = bearing.record
    heads, columns = ["azimuth, deg", "load, N"], [one["azimuths_deg"], one["loads_N"]]
    if any(one["contact_angles_deg"]):
        heads, columns = [*heads, "contact angle, deg"], [*columns, one["contact_angles_deg"]]
    return ["element", *heads], [[str(n), *(f"{value:.1f}" for value in row)] for n, row in enumerate(zip(*columns), 1)]


def facts(bearing):
    """[(label, value)] of quantities of the whole bearing."""
    one, which = bearing.record, bearing.record["geometry"]
    axial = [("axial load", f"{one['axial_load_N']:.1f} N")] if one["axial_load_N"] > 1e-6 * one["ball_load_max_N"] else []
    along = [("axial displacement", f"{one['axial_displacement_m'] * 1e6:.2f} um")] if axial and "end_play_m" in one else []
    play = [("end play", f"{one['end_play_m'] * 1e6:.2f} um")] if one.get("end_play_m") else []
    return [("largest load of an element", f"{one['ball_load_max_N']:.1f} N"),
            ("elements under load", f"{one['loaded']} of {which['count']}"), *axial,
            ("radial displacement", f"{one['radial_displacement_m'] * 1e6:.2f} um"), *along, *play,
            ("speed of the cage", f"{one['cage_speed_1_min']:.1f} 1/min"),
            ("contacts per second of a point of an element", f"{one['element_passes_per_s']:.2f}"), *_torque(one)]


def _torque(one):
    """Rows of power loss and torque by slip, if they are known."""
    if not (found := slip_torque(one)):
        return []
    power, torque = found
    return [("sliding loss of all contacts", f"{power:.3g} W"), ("friction torque of the slip", f"{torque * 1e3:.3g} N mm")]


def estimated_words(bearing):
    """Sentence about dimensions that are not published; "" if all are."""
    keys, which = bearing.record["estimated"], bearing.record["geometry"]
    if not keys:
        return ""
    values = ", ".join(f"{key} = {which[key]:g}" for key in keys)
    return f"estimated, because not published: {values} (osculations of the ratings of ISO 76); set them if you know them"


def warnings(bearing):
    """Warnings of the bearing and of both runs, each kind once with its rings."""
    rings = [(name, None, ring["summary"]) for name, ring in bearing.rings.items()]
    return [*bearing.record.get("warnings", []), *place_warnings.of(rings, "{} ring".format)]


def csv_text(bearing):
    """Table as CSV in SI units: a line per ring, error bars in separate columns."""
    places = [(bearing.record, bearing.rings[ring]) for ring in RINGS]
    lines = table_column.csv_lines([row for row in ROWS if _has(row, bearing)], places)
    return table_column.csv_text([first, *line] for first, line in zip(["ring", *RINGS], lines))
