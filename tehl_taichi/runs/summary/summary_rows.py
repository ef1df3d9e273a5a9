"""Printed summary of a run: rows of (quantity, value with its error and unit). Needs no taichi."""

from dataclasses import replace
from types import MappingProxyType

from tehl_taichi.fatigue.judged_layers import over
from tehl_taichi.fatigue.judged_surfaces import others
from tehl_taichi.march import quantities
from tehl_taichi.march.accuracy.coarse_runs import AREA, CONTACT
from tehl_taichi.march.quantities import HEAT
from tehl_taichi.runs.summary import life, limit_meaning
from tehl_taichi.runs.summary.search_rows import alone_rows, rows_of_fatigue
from tehl_taichi.runs.summary.summary_row import SummaryRow, at_depth, quantity, row_of
from tehl_taichi.values.digits import number_of, with_error
from tehl_taichi.values.summary_values import error_of

HEIGHTS = ("Sa_m", "Sq_m", "Sz_m", "Ra_m", "Rq_m", "Rz_m")


def title(summary):
    """Title of the table."""
    return f"{summary['scene']}: {number_of(summary['steps'], 'step')}, store {summary['store']}"


def summary_rows(summary):
    """[(quantity, value)] of the summary of a finished run."""
    return [row.text_pair for row in rows_of(summary)]


def fatigue_rows(f, beside=MappingProxyType({})):
    """[(quantity, value)] of a fatigue summary."""
    return [row.text_pair for row in rows_of_fatigue(f, beside)]


def life_rows(passages):
    """[(quantity, value)] of {"life": that part of a summary}, or of {}."""
    return [row.text_pair for row in _life_rows(passages)]


def rows_of(summary):
    """List of :class:`SummaryRow` of the summary of a finished run."""
    steady, hertz = summary["steady"], summary["hertz"]
    rows = [SummaryRow("Hertz half-width a", f"{hertz['a_m'] * 1e3:.4f} mm", hertz["a_m"]),
            *([SummaryRow("Hertz half-axis b, across", f"{hertz['b_m'] * 1e3:.4f} mm", hertz["b_m"])] if "b_m" in hertz
              else []),
            SummaryRow("Hertz pressure p_H", f"{hertz['p_Pa'] / 1e9:.4f} GPa", hertz["p_Pa"]),
            *_labelled("steady", steady)]
    if "film_formula_m" in steady:
        formula = steady["film_formula_m"]
        by = steady.get("film_formula", "isothermal, Newtonian")
        rows.append(SummaryRow(f"h_c by formula ({by})", f"{formula * 1e6:.4f} um", formula))
    rows += _roughness_rows(summary)
    rows += _peclet_rows(summary) + _heat_rows("steady", steady) + _passage_rows(summary)
    rows.append(SummaryRow("run time", f"{summary['wall_s']:.1f} s (kernels {summary['compile_s']:.1f} s)", summary["wall_s"]))
    return rows


def _labelled(part, values):
    """Rows of the numbers of a part that have a label and a value."""
    return [row_of(values, entry.key, entry.label, entry.factor, entry.shown)
            for entry in quantities.of_part(part) if entry.label and entry.key in values]


def _roughness_rows(summary):
    """Roughness of each surface, also before its filters, and film over roughness."""
    out = []
    for name, numbers in summary.get("roughness", {}).items():
        of = "both surfaces" if name == "combined" else f"surface {name}"
        out += [*_heights(of, numbers), *_shape(of, numbers), *_heights(f"{of} before filters", numbers.get("before_filters"))]
    return out + ([row_of(summary, "lambda", "lambda = h_c/Sq")] if "lambda" in summary else [])


def _heights(of, numbers):
    """Rows of the known mean, rms and range of heights."""
    known = [key for key in (numbers or {}) if key in HEIGHTS]
    values = " / ".join(f"{numbers[key] * 1e6:.3g}" for key in known)
    rms = next((numbers[key] for key in known if key in ("Sq_m", "Rq_m")), None)
    return [SummaryRow(f"{' / '.join(key[:-2] for key in known)} of {of}", f"{values} um", rms)] if known else []


def _shape(of, numbers):
    lengths = [f"{numbers[key] * 1e6:.3g} um along {key[7]}" for key in ("length_x_m", "length_y_m") if key in numbers]
    return [SummaryRow(f"skewness / rms slope of {of}", f"{numbers['skewness']:.2f} / {numbers['Rq_slope']:.3g}"),
            *([SummaryRow(f"autocorrelation length of {of}", ", ".join(lengths))] if lengths else [])]


def _peclet_rows(summary):
    if "peclet" not in summary:
        return []
    return [SummaryRow("Péclet number of surface a / b", " / ".join(f"{summary['peclet'][which]:.3g}" for which in "ab"))]


def _heat_rows(when, values):
    if "film_max_C" not in values:
        return []
    errors = [error_of(values, key) for key in HEAT]
    each, once = (" (error unknown)", "") if any(error is not None for error in errors) else ("", " (errors unknown)")
    largest = " / ".join(_temperature(values[key], error, each) for key, error in zip(HEAT, errors))
    return [SummaryRow(f"{when} film / surface a / surface b, largest", f"{largest} °C{once}")]


def _temperature(value, error, unknown):
    """Text of a temperature (deg C) with its error; unknown: text in place of an unknown error."""
    return f"{value:.1f}{unknown}" if error is None else with_error(value, error)


def _passage_rows(summary):
    rows = []
    if "transient" in summary:
        t = summary["transient"]
        rows += _heat_rows("passage", t)
        rows += [*_labelled("transient", t), SummaryRow("load carried by solid contact", contact_share(t)),
                 *([SummaryRow("area of solid contact / dry contact area", contact_share(t, AREA))] if t.get(AREA) else []),
                 SummaryRow("worst residual / load / mass error",
                     f"{t['residual_max']:.1e} / {t['load_error_max']:.1e} / {t['mass_error_max']:.1e}")]
    rows += _zoom_rows(summary.get("zoom")) + _run_in_rows(summary.get("run_in"))
    if "fatigue" in summary:
        return rows + rows_of_fatigue(summary["fatigue"], others(summary)) + _meaning_rows(summary) + _life_rows(summary)
    return rows + (alone_rows(summary["contact_alone"]) if "contact_alone" in summary else [])


def _life_rows(summary):
    """Passages to initiation at the point that decides."""
    if not (found := summary.get("life")):
        return []
    where = (at_depth(found) if found["depth_m"] else ", at the surface") + f" ({found['surface']})"
    where += over(found.get("length_m", 0.0), "um") + ", while resolved" * found.get("resolved", False)
    row = row_of(found, "passages", f"passages to initiation, exponent {found['exponent']:g}", where=where)
    rows = [replace(row, value=life.number(found))]
    if alone := found.get("contact_alone"):
        rows.append(replace(row_of(alone, "passages", "passages to initiation by the load alone", where=at_depth(alone) + (
            f" ({alone['surface']})")), value=life.number(alone)))
    return rows


def _meaning_rows(summary):
    """The fatigue limit as the pressure of a smooth contact."""
    if not (found := limit_meaning.smooth_pressure(summary)):
        return []
    p, error = found
    return [SummaryRow("Hertz pressure at which the smooth contact has Fi = 1", with_error(p * 1e-9, error * 1e-9, "GPa"), p)]


def _run_in_rows(found):
    """Rows of the run-in."""
    if not found:
        return []
    made = SummaryRow("passages of run-in", f"{found['passages']}", found["passages"],
                      note=f" ({number_of(found['rounds'], 'round')} of the first"
                           f"{', shaken down' if found['shaken_down'] else ''})")
    rows = [row_of(found, "surface_change_max_m", "surface change by run-in", 1e9, "nm"),
            row_of(found, "plastic_strain_max", "plastic strain by run-in, largest", 100, "%"),
            *(row_of(found, f"residual_{end}_Pa", f"residual stress by run-in, {says}", 1e-6, "MPa")
              for end, says in (("min", "smallest"), ("max", "largest")))]
    height = [row_of(found, "height_after_m", "height after run-in", 1e6, "um",
                  note=f" (before {found['height_before_m'] * 1e6:.4g})")] if "height_after_m" in found else []
    return [made, *height, *rows] if found["plastic_strain_max"] else [made]


def _zoom_rows(zoom):
    """Rows of the window, and of the largest numbers without it."""
    if not zoom:
        return []
    windows = zoom.get("windows", [zoom])
    sizes = [f"{wide:.2g} x {high:.2g} a" if high else f"{wide:.2g} a" for wide, high in (one["window_a"] for one in windows)]
    base = zoom["base"]
    film = f" / {base['film_max_C']:.4g} °C" if "film_max_C" in base else ""
    return [SummaryRow(f"zoom window{'s' * bool(sizes[1:])}", f"{zoom['factor']} times as fine, {' and '.join(sizes)}"),
            SummaryRow(f"p_max / h_min{' / hottest film' if film else ''} without the zoom",
                       f"{base['p_max_Pa'] / 1e9:.4g} GPa / {base['h_min_m'] * 1e6:.3g} um{film}")]


def contact_share(t, key=CONTACT):
    """Text of the largest share of solid contact in the load, or in the area (key AREA): none, with its error, or as an upper
    bound that this grid allows.
    """
    share, error = t[key], error_of(t, key)
    if share == 0:
        return "none"
    return f"{share:.2%} at most, not resolved" if error is None else f"{quantity(t, key, 100)} % at most"
