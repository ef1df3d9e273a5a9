"""Table columns of a flank: for the table on the screen, the CSV file and the figure."""

from tehl_taichi.fatigue.judged_layers import worst_layer
from tehl_taichi.fatigue.judged_surfaces import by_surface
from tehl_taichi.fatigue.pressure_alone import why_none
from tehl_taichi.march import quantities
from tehl_taichi.runs import table_column
from tehl_taichi.runs.table_column import TableColumn
from tehl_taichi.scene import surface_roughness
from tehl_taichi.values.summary_values import error_of, value_at


def shown_value(summary, *keys):
    """Value for tables and figures by its keys; None for the distribution over a single feature, where the largest index says
    more.
    """
    if "statistics" in keys and not value_at(summary, "fatigue", "rough"):
        return None
    return value_at(summary, *keys)


def plotted_value(at, p_H, summary, what):
    """(value, error bar) of a series of a figure, None where missing; what: keys in the summary, or the name of a number of the
    position.
    """
    if isinstance(what, tuple):
        return shown_value(summary, *what), error_of(summary, *what)
    if what == "judged":
        return judged_index(summary)
    return {"p_H": p_H, "srr": at.srr if p_H else None, **at.film_ratios}.get(what), None


def judged_index(summary):
    """(Fi, its error bar) that decides about a position, for rough surfaces a percentile; (None, None) without an index."""
    found = value_at(summary, "fatigue")
    if not found or why_none(found):
        return None, None
    _, Fi, error = worst_layer(by_surface(summary))
    return Fi, error


def _of_run(name, head, factor, form, table, *keys):
    """Column of a number of the summary, with its error bar."""
    return TableColumn(name, head, factor, form, lambda at, p_H, summary: shown_value(summary, *keys), table,
                       lambda at, p_H, summary: error_of(summary, *keys))


def _von_mises(at, p_H, summary):
    """The largest stress of a passage; None for steady contacts."""
    return value_at(summary, "von_mises", "max_Pa") if value_at(summary, "transient") else None


CONTACT, STEADY, PASSAGE = TABLES = ("contact", "steady film", "while the feature passes")
# of the parts of a summary
TITLES = {"steady": STEADY, **dict.fromkeys(("transient", "fatigue", "fatigue.statistics", "fatigue.below",
                                             "fatigue.below.statistics"), PASSAGE)}
COLUMNS = (
    TableColumn("point", "at", 1, "", lambda at, *_: at.point, CONTACT),
    TableColumn("x_pl_m", "x_pl mm", 1e3, ".3f", lambda at, *_: at.x_pl, CONTACT),
    TableColumn("arc_m", "arc mm", 1e3, ".3f", lambda at, *_: at.arc, CONTACT),
    TableColumn("R_m", "R' mm", 1e3, ".3f", lambda at, *_: at.R, CONTACT),
    TableColumn("u_m_m_s", "u_m m/s", 1, ".3f", lambda at, *_: at.u_m, CONTACT),
    TableColumn("srr", "SRR", 1, ".3f", lambda at, *_: at.srr, CONTACT),
    TableColumn("load_N_m", "N/mm", 1e-3, ".1f", lambda at, *_: at.load, CONTACT),
    TableColumn("bulk_C", "bulk deg C", 1, ".1f", lambda at, *_: at.bulk, CONTACT),
    TableColumn("p_Hertz_Pa", "p_H GPa", 1e-9, ".3f", lambda at, p_H, _: p_H, CONTACT),
    *(_of_run(one.column, one.head, one.factor, one.form, TITLES[one.part], *one.part.split("."), one.key)
      for one in quantities.ENTRIES if one.column),
    TableColumn("Sq_m", "Sq um", 1e6, ".3f",
                lambda at, p_H, found: surface_roughness.rms_of(value_at(found, "roughness")), STEADY),
    _of_run("lambda", "lambda", 1, ".2f", STEADY, "lambda"),
    TableColumn("lambda_GF", "lambda_GF", 1, ".3f", lambda at, *_: at.film_ratios.get("lambda_GF"), STEADY),
    TableColumn("h_min_Ra", "h_min/Ra", 1, ".3f", lambda at, *_: at.film_ratios.get("h_min_Ra"), STEADY),
    TableColumn("Fi_judged", "Fi judged", 1, ".3f", lambda at, p_H, found: judged_index(found)[0], PASSAGE,
                lambda at, p_H, found: judged_index(found)[1]),
    TableColumn("von_mises_max_Pa", "Mises GPa", 1e-9, ".3f", _von_mises, PASSAGE,
                lambda at, p_H, found: error_of(found, "von_mises", "max_Pa")),
    _of_run("passages", "passages", 1, ".2g", PASSAGE, "life", "passages"),
    _of_run("hours", "hours", 1, ".2g", PASSAGE, "life", "hours"),
    TableColumn("worse_body", "body", 1, "", lambda at, p_H, summary: value_at(summary, "fatigue", "surface"), PASSAGE),
)


def used_columns(rows, columns=COLUMNS):
    """Columns with a value in any of the rows (position, p_H, summary)."""
    return [column for column in columns if any(column.value(*row) not in (None, "") for row in rows)]


def tables(rows, of=COLUMNS, places=2):
    """{title: (heads, lines)} of the tables with values; the first `places` columns, the positions, are in each."""
    columns, out = used_columns(rows, of), {}
    for title in TABLES:
        found = [column for column in columns if column.table == title]
        if title != CONTACT and found:
            found = [column for column in of[:places] if column in columns] + found
        if found:
            heads, lines = [column.head for column in found], [[column.shown(*row) for column in found] for row in rows]
            out[title_of(title, [row[-1] for row in rows])] = heads, lines
    return out


def title_of(part, summaries):
    """Title of a part of the results; stresses of steady contacts are titled "stress", since only the load causes them."""
    passes = any(value_at(summary, key) for summary in summaries for key in ("transient", "fatigue"))
    return "stress" if part == PASSAGE and not passes else part


def csv_text(rows, of=COLUMNS):
    """Table as CSV in SI units, followed by the error bars and the further columns of the user's table of positions."""
    more = list(dict.fromkeys(key for at, *_ in rows for key in at.more))
    further = [more, *([at.more.get(key) for key in more] for at, *_ in rows)]
    lines = table_column.csv_lines(used_columns(rows, of), rows)
    return table_column.csv_text([*line, *others] for line, others in zip(lines, further))
