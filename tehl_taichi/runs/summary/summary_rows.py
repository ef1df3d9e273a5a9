"""Printed summary of a run: rows of (quantity, value with its error and unit). Needs no taichi."""

import math
from dataclasses import dataclass, replace
from types import MappingProxyType

from tehl_taichi.fatigue.judged_surfaces import others
from tehl_taichi.fatigue.pressure_alone import searched, why_none
from tehl_taichi.march import quantities
from tehl_taichi.march.accuracy.coarse_runs import AREA, CONTACT
from tehl_taichi.march.quantities import HEAT
from tehl_taichi.runs.summary import limit_meaning
from tehl_taichi.scene.feature_wording import range_words
from tehl_taichi.values.digits import micrometres, with_error
from tehl_taichi.values.summary_units import nothing_of

HEIGHTS = ("Sa_m", "Sq_m", "Sz_m", "Ra_m", "Rq_m", "Rz_m")
SURFACE, BELOW, RESOLVED = "at the surface", "below it", "while resolved"  # parts of a search


@dataclass(frozen=True)
class SummaryRow:
    """what: the quantity, equal words for every run; value: with error and unit; number: the value alone if its relative change
    has a meaning; where: place of this value, completes `what`; note: text after the value; part: of the fatigue search, else
    ""; error: bar of the number; nothing: size below which the number counts as zero.
    """

    what: str
    value: str
    number: float | None = None
    where: str = ""
    note: str = ""
    part: str = ""
    error: float | None = None
    nothing: float = 0.0

    @property
    def text_pair(self):
        """(quantity, value) as printed."""
        return self.what + self.where, self.value + self.note


def title(summary):
    """Title of the table."""
    return f"{summary['scene']}: {summary['steps']} steps, store {summary['store']}"


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
    return [_of(values, entry.key, entry.label, entry.factor, entry.shown)
            for entry in quantities.of_part(part) if entry.label and entry.key in values]


def _of(values, key, what, factor=1, unit="", **more):
    """SummaryRow of one of the values with its error."""
    return SummaryRow(what, quantity(values, key, factor, unit), values[key], error=values.get("error", {}).get(key),
                      nothing=nothing_of(key), **more)


def quantity(values, name, factor=1, unit=""):
    """Text 'value ± error unit' of one of the values; three digits if the error is not known."""
    value, error = values[name] * factor, values.get("error", {}).get(name)
    if error is None:
        return f"{with_error(value, None, unit, 3)} (error unknown)"
    return with_error(value, error * factor, unit)


def _roughness_rows(summary):
    """Roughness of each surface, also before its filters, and film over roughness."""
    out = []
    for name, numbers in summary.get("roughness", {}).items():
        of = "both surfaces" if name == "combined" else f"surface {name}"
        out += [*_heights(of, numbers), *_shape(of, numbers), *_heights(f"{of} before filters", numbers.get("before_filters"))]
    return out + ([_of(summary, "lambda", "lambda = h_c/Sq")] if "lambda" in summary else [])


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
    errors = [values.get("error", {}).get(key) for key in HEAT]
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
    return rows + (_alone_rows(summary["contact_alone"]) if "contact_alone" in summary else [])


def _life_rows(summary):
    """Passages to initiation at the worst point."""
    if not (found := summary.get("life")):
        return []
    where = (_at(found) if found["depth_m"] else ", at the surface") + f" ({found['surface']})"
    return [_of(found, "passages", f"passages to initiation, exponent {found['exponent']:g}", where=where)]


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
                      note=f" ({found['rounds']} rounds of the first{', shaken down' if found['shaken_down'] else ''})")
    rows = [_of(found, "surface_change_max_m", "surface change by run-in", 1e9, "nm"),
            _of(found, "plastic_strain_max", "plastic strain by run-in, largest", 100, "%"),
            *(_of(found, f"residual_{end}_Pa", f"residual stress by run-in, {says}", 1e-6, "MPa")
              for end, says in (("min", "smallest"), ("max", "largest")))]
    height = [_of(found, "height_after_m", "height after run-in", 1e6, "um",
                  note=f" (before {found['height_before_m'] * 1e6:.4g})")] if "height_after_m" in found else []
    return [made, *height, *rows] if found["plastic_strain_max"] else [made]


def _zoom_rows(zoom):
    """Rows of the window, and of the largest numbers without it."""
    if not zoom:
        return []
    wide, high = zoom["window_a"]
    size = f"{wide:.2g} x {high:.2g} a" if high else f"{wide:.2g} a"
    base = zoom["base"]
    film = f" / {base['film_max_C']:.4g} °C" if "film_max_C" in base else ""
    return [SummaryRow("zoom window", f"{zoom['factor']} times as fine, {size}"),
            SummaryRow(f"p_max / h_min{' / hottest film' if film else ''} without the zoom",
                       f"{base['p_max_Pa'] / 1e9:.4g} GPa / {base['h_min_m'] * 1e6:.3g} um{film}")]


def rows_of_fatigue(f, beside=MappingProxyType({})):
    """List of :class:`SummaryRow` of a fatigue summary (see :func:`_rows_of_search`), and the indices of the other body in
    `beside` {surface: summary}. If the tractions give no index: the reason, then the rows of the pressure alone.
    """
    why = why_none(f)
    rows = [*_worse(f, beside), *_alone_rows(searched(f).get("contact_alone")), *_distribution_rows(searched(f)),
            *_rows_of_search(searched(f)),
            *(row for name, other in beside.items() for row in _rows_of_other(name, searched(other)))]
    if not why:
        return rows
    return [SummaryRow("Fi_max", f"no value: {why}"), *(replace(row, what=f"{row.what}, pressure alone") for row in rows)]


def _worse(f, beside):
    return [SummaryRow("worse body", f["surface"], part=SURFACE)] if beside else []


def _distribution_rows(f):
    """Statistics of the index: for rough surfaces at and below the surface; for a single feature the share above 1."""
    if "statistics" not in f:
        return []
    top, deep = f["statistics"], f.get("below", {}).get("statistics")
    share = _of(top, "share_above_1", "share of the surface with Fi > 1", 100, "%", part=SURFACE)
    if not f.get("rough"):
        return [replace(share, what="share of the surface under the feature with Fi > 1")]
    return [*_percentiles(top, "surface", "", SURFACE), share,
            SummaryRow("cycles with Fi > 1, mean of a passage", f"{top['cycles_above_1']:.3g}", top["cycles_above_1"],
                       part=SURFACE),
            *(_percentiles(deep, "below", _at(deep), BELOW) if deep else [])]


def _percentiles(part, where, at, of):
    points = f" ({part['points']} points)"
    return [_of(part, "p99", f"Fi {where}, 99th percentile", where=at, note=points, part=of),
            _of(part, "p90", f"Fi {where}, 90th percentile", where=at, part=of),
            _of(part, "median", f"Fi {where}, median", where=at, part=of)]


def _alone_rows(alone):
    """Indices of the smooth body, whose worst place may be the surface; empty for searches by older versions."""
    if not alone:
        return []
    surface = _of(alone, "surface_Fi_max", "Fi_max of the smooth contact at the surface", part=SURFACE)
    deep = _of(alone, "Fi_max", "Fi_max of the smooth contact", where=_at(alone), part=BELOW)
    return [deep, surface] if alone["depth_m"] else [surface]


def _rows_of_other(name, f):
    """Largest indices of the other body."""
    deep = f.get("below")
    rows = [_of(f, "Fi_max", "Fi_max of the other body", where=f" ({name}), at its surface", part=SURFACE)]
    return rows + ([_of(deep, "Fi_max", "Fi_max of the other body, below", where=f" ({name}){_at(deep)}", part=BELOW)]
                   if deep else [])


def _rows_of_search(f):
    """List of :class:`SummaryRow` of a search: the worst point of the surface, then the worst one below it. If the grid does
    not resolve every pressure, the resolved part comes first, on which the verdict rests.
    """
    rows = [_of(f, "Fi_max", "Fi_max at the surface", where=_all_moments_text(f)),
            _judged_stress(f, f["criterion"]), *_point_rows(f, _frame(f)),
            _stress("largest principal stress at the surface", f["sigma1_max_Pa"]), _constants_row(f),
            *(SummaryRow(f"from the limit in reversed {way}", f"{f[key] / 1e6:g} MPa")
              for way in ("bending", "torsion") if (key := f"{way}_limit_Pa") in f),
            SummaryRow("thermal stress", "included" if f["thermal_stress"] else "not included")]
    rows += [_stress(f"largest at {_depth(layer)}", layer["findley_stress_max_Pa"]) for layer in f.get("by_depth", [])]
    rows += _stressed_rows(f)
    early = [] if f.get("rough") else _resolved_rows(f)
    return early + _averaged_rows(f) + [replace(row, part=SURFACE) for row in rows] + _below_rows(f) + _von_mises_rows(f)


def _stressed_rows(f):
    """Rows of the stressed volume: area of the smooth track with the risk of the feature."""
    if not (found := f.get("stressed")):
        return []
    areas = [(found[key], where) for key, where in (("track_equal_m2", "below the surface"),
                                                    ("track_equal_surface_m2", "at the surface")) if key in found]
    chances = [(found[key], where) for key, where in (("failure_volume", "below the surface"),
                                                      ("failure_surface", "at the surface")) if key in found]
    weighs = "area of smooth track with the risk of the feature"
    return [*(SummaryRow(f"{weighs}, {where}", f"{area * 1e6:.3g} mm2", area) for area, where in areas),
            *(SummaryRow(f"probability of a crack {where}", f"{chance:.2g}", chance) for chance, where in chances)]


def _von_mises_rows(f):
    """Largest von Mises stress of the body, and its yield stress."""
    if not (found := f.get("von_mises")):
        return []
    where = _at(found) if found["depth_m"] else ", at the surface"
    return [_of(found, "max_Pa", "largest von Mises stress", 1e-9, "GPa", where=f"{where} ({found['surface']})",
                note=f", yield stress {found['yield_stress_Pa'] / 1e9:.3g} GPa", part=BELOW)]


def _averaged_rows(f):
    """Indices of stresses averaged over fatigue.length."""
    if not (wide := f.get("averaged")):
        return []
    over, deep = f", over {micrometres(wide['length_m'])} um", wide.get("below")
    rows = [_of(wide, "Fi_max", "Fi_max of averaged stresses, surface", where=over, part=SURFACE)]
    return rows + ([_of(deep, "Fi_max", "Fi_max of averaged stresses, below", where=f"{over}{_at(deep)}", part=BELOW)]
                   if deep else [])


def _all_moments_text(f):
    """Text after a value of all counted moments, if a part of them has its own row or others are left out."""
    part = range_words(f.get("from_x_a", -math.inf), f.get("to_x_a", math.inf)) or "whole passage" * ("resolved" in f)
    return f", {part}" if part else ""


def _resolved_rows(f):
    """Rows of the moments whose pressure the grid resolves, if it does not resolve all."""
    if "resolved" not in f:
        return []
    part, deep = f["resolved"], f["resolved"].get("below")
    rows = [_of(part, "Fi_max", "Fi_max while resolved", where=f" (to {part['to_x_a']:.2f} a)"),
            *_place_rows(part, "while resolved")]
    if deep:
        rows += [_of(deep, "Fi_max", "below the surface while "
                                     "resolved", where=_at(deep)), *_place_rows(deep, "below while resolved")]
    return [replace(row, part=RESOLVED) for row in rows]


def _place_rows(point, when):
    """Rows with place and plane of a worst point."""
    return [replace(row, what=f"{row.what}, {when}") for row in _point_rows(point)[:2]]


def _frame(f):
    """Text after a place on the body without the feature, whose frame moves relative to the feature."""
    return "" if f.get("carries_feature", True) else " (feature centre at X = 0)"


def _point_rows(f, frame=""):
    """Rows of the worst point at the surface or below it."""
    low, high = f.get("pit_angles_deg", (None, None))
    pits = "" if low is None else f" (usual for pits: {low:g} to {high:g})"
    rows = [SummaryRow("at x, y from the feature centre", f"{f['x_m'] * 1e6:.1f}, {f['y_m'] * 1e6:.1f} um", note=frame),
            SummaryRow("critical plane, angle to the surface", f"{f['surface_angle_deg']:.1f} deg", note=pits),
            SummaryRow("shear amplitude, largest normal stress",
                       f"{f['tau_amp_Pa'] / 1e6:.1f}, {f['sigma_n_max_Pa'] / 1e6:.1f} MPa")]
    own = f.get("sigma1_worst_Pa")  # not in stores before 0.2
    return rows + ([_stress("largest principal stress there", own)] if own is not None else [])


def _below_rows(f):
    if "below" not in f:
        return []
    deep = f["below"]
    rows = [_of(deep, "Fi_max", "Fi_max below the surface", where=_at(deep) + _all_moments_text(f)),
            _judged_stress(deep, f["criterion"]), *_point_rows(deep, _frame(f)),
            *_local_rows(deep)]
    return [replace(row, part=BELOW) for row in rows]


def _constants_row(f):
    return SummaryRow("with kappa, sigma_eF", f"{f['kappa_F']:.4g}, {f['sigma_eF_Pa'] / 1e6:.4g} MPa")


def _local_rows(deep):
    """Rows of the strength table and of the residual stress at the depth of the worst point; empty without table and run-in."""
    if "residual_xx_Pa" not in deep:
        return []
    stress = " / ".join(f"{deep[f'residual_{axis}_Pa'] / 1e6:.4g}" for axis in ("xx", "yy"))
    return [*([_constants_row(deep)] if "sigma_eF_Pa" in deep else []),
            SummaryRow("residual stress along x / y", f"{stress} MPa")]


def contact_share(t, key=CONTACT):
    """Text of the largest share of solid contact in the load, or in the area (key AREA): none, with its error, or as an upper
    bound that this grid allows.
    """
    share, error = t[key], t.get("error", {}).get(key)
    if share == 0:
        return "none"
    return f"{share:.2%} at most, not resolved" if error is None else f"{quantity(t, key, 100)} % at most"


def _judged_stress(part, criterion):
    """Row of the stress behind an index, with the relative error of the index."""
    Fi, bar, stress = part["Fi_max"], part.get("error", {}).get("Fi_max"), part["findley_stress_max_Pa"]
    return replace(_stress(f"{criterion} stress", stress), error=abs(bar / Fi) * stress if bar is not None and Fi else None)


def _stress(what, value):
    return SummaryRow(what, f"{value / 1e6:.1f} MPa", value)


def _at(values):
    return f", at {_depth(values)}"


def _depth(values):
    return f"{micrometres(values['depth_m'])} um"
