"""Printed rows of a fatigue search: index, place and plane of the worst points, stresses, strength. Needs no taichi."""

import math
from dataclasses import replace
from types import MappingProxyType

from tehl_taichi.fatigue.pressure_alone import searched, why_none
from tehl_taichi.runs.summary.summary_row import SummaryRow, at_depth, depth_text, quantity, row_of
from tehl_taichi.scene.feature_wording import range_words
from tehl_taichi.values.digits import micrometres, number_of
from tehl_taichi.values.summary_values import error_of

SURFACE, BELOW, RESOLVED = "at the surface", "below it", "while resolved"  # parts of a search


def rows_of_fatigue(f, beside=MappingProxyType({})):
    """List of :class:`SummaryRow` of a fatigue summary (see :func:`_rows_of_search`), and the indices of the other body in
    `beside` {surface: summary}. If the tractions give no index: the reason, then the rows of the pressure alone.
    """
    why = why_none(f)
    rows = [*_worse(f, beside), *alone_rows(searched(f).get("contact_alone")), *_distribution_rows(searched(f)),
            *_rows_of_search(searched(f)), *_von_mises_rows([f, *beside.values()]),
            *(row for name, other in beside.items() for row in _rows_of_other(name, searched(other)))]
    if not why:
        return rows
    return [SummaryRow("Fi_max", f"no value: {why}"), *(replace(row, what=f"{row.what}, pressure alone") for row in rows)]


def _worse(f, beside):
    """Row of the body that decides, whose rows follow, if both were searched."""
    return [SummaryRow("worse body", f["surface"], part=SURFACE)] if beside else []


def _distribution_rows(f):
    """Statistics of the index: for rough surfaces at and below the surface; for a single feature the share above 1."""
    if "statistics" not in f:
        return []
    top, deep = f["statistics"], f.get("below", {}).get("statistics")
    share = row_of(top, "share_above_1", "share of the surface with Fi > 1", 100, "%", part=SURFACE)
    if not f.get("rough"):
        return [replace(share, what="share of the surface under the feature with Fi > 1")]
    return [*_percentiles(top, "surface", "", SURFACE), share,
            SummaryRow("cycles with Fi > 1, mean of a passage", f"{top['cycles_above_1']:.3g}", top["cycles_above_1"],
                       part=SURFACE),
            *(_percentiles(deep, "below", at_depth(deep), BELOW) if deep else [])]


def _percentiles(part, where, at, of):
    points = f" ({number_of(part['points'], 'point')})"
    return [row_of(part, "p99", f"Fi {where}, 99th percentile", where=at, note=points, part=of),
            row_of(part, "p90", f"Fi {where}, 90th percentile", where=at, part=of),
            row_of(part, "median", f"Fi {where}, median", where=at, part=of)]


def alone_rows(alone):
    """Indices of the smooth body, whose worst place may be the surface; empty for searches by older versions."""
    if not alone:
        return []
    surface = row_of(alone, "surface_Fi_max", "Fi_max of the smooth contact at the surface", part=SURFACE)
    deep = row_of(alone, "Fi_max", "Fi_max of the smooth contact", where=at_depth(alone), part=BELOW)
    return [deep, surface] if alone["depth_m"] else [surface]


def _rows_of_other(name, f):
    """Largest indices of the other body."""
    deep = f.get("below")
    rows = [row_of(f, "Fi_max", "Fi_max of the other body", where=f" ({name}), at its surface", part=SURFACE)]
    return rows + ([row_of(deep, "Fi_max", "Fi_max of the other body, below", where=f" ({name}){at_depth(deep)}", part=BELOW)]
                   if deep else [])


def _rows_of_search(f):
    """List of :class:`SummaryRow` of a search: the worst point of the surface, then the worst one below it. If the grid does
    not resolve every pressure, the resolved part comes first, on which the verdict rests.
    """
    rows = [row_of(f, "Fi_max", "Fi_max at the surface", where=_all_moments_text(f)),
            _judged_stress(f, f["criterion"]), *_point_rows(f, _frame(f)),
            _stress("largest principal stress at the surface", f["sigma1_max_Pa"]), _constants_row(f),
            *(SummaryRow(f"from the limit in reversed {way}", f"{f[key] / 1e6:g} MPa")
              for way in ("bending", "torsion") if (key := f"{way}_limit_Pa") in f),
            SummaryRow("thermal stress", "included" if f["thermal_stress"] else "not included")]
    rows += [_stress(f"largest at {depth_text(layer)}", layer["findley_stress_max_Pa"]) for layer in f.get("by_depth", [])]
    rows += _stressed_rows(f)
    early = [] if f.get("rough") else _resolved_rows(f)
    return early + _averaged_rows(f) + [replace(row, part=SURFACE) for row in rows] + _below_rows(f)


def _stressed_rows(f):
    """Rows of the stressed volume: area of the smooth track with the risk of the feature."""
    if not (found := f.get("stressed")):
        return []
    areas = [(found[key], where) for key, where in (("track_equal_m2", "below the surface"),
                                                    ("track_equal_surface_m2", "at the surface")) if key in found]
    chances = [(found[key], where) for key, where in (("failure_volume", "below the surface"),
                                                      ("failure_surface", "at the surface")) if key in found]
    across = ", per metre across" * found.get("per_metre", False)
    weighs, crack = f"area of smooth track with the risk of the feature{across}", f"probability of a crack{across},"
    return [*(SummaryRow(f"{weighs}, {where}", f"{area * 1e6:.3g} mm2", area) for area, where in areas),
            *(SummaryRow(f"{crack} {where}", f"{chance:.2g}", chance) for chance, where in chances)]


def nearest_to_yield(searches):
    """Part "von_mises" of the body nearest to its yield stress, of the summaries of its searches; of one whose yield stress is
    not known if there is no other; None without any.
    """
    found = [part for one in searches if (part := searched(one).get("von_mises"))]
    return max(found, key=lambda part: (_bears_known(part), part["max_Pa"] / part["yield_stress_Pa"]), default=None)


def _bears_known(part):
    """Whether the yield stress of the body of a part "von_mises" is known."""
    return part.get("yields", False) is not None


def _von_mises_rows(searches):
    """Largest von Mises stress of the body nearest to its yield stress, and that."""
    if not (found := nearest_to_yield(searches)):
        return []
    where = at_depth(found) if found["depth_m"] else ", at the surface"
    limit = f"{found['yield_stress_Pa'] / 1e9:.3g} GPa" if _bears_known(found) else "not known"
    return [row_of(found, "max_Pa", "largest von Mises stress", 1e-9, "GPa", where=f"{where} ({found['surface']})",
                note=f", yield stress {limit}", part=BELOW)]


def _averaged_rows(f):
    """Indices of stresses averaged over fatigue.length."""
    if not (wide := f.get("averaged")):
        return []
    over, deep = f", over {micrometres(wide['length_m'])} um", wide.get("below")
    rows = [row_of(wide, "Fi_max", "Fi_max of averaged stresses, surface", where=over, part=SURFACE)]
    return rows + ([row_of(deep, "Fi_max", "Fi_max of averaged stresses, below", where=f"{over}{at_depth(deep)}", part=BELOW)]
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
    rows = [row_of(part, "Fi_max", "Fi_max while resolved", where=f" (to {part['to_x_a']:.2f} a)"),
            *_place_rows(part, "while resolved")]
    if deep:
        rows += [row_of(deep, "Fi_max", "below the surface while "
                                     "resolved", where=at_depth(deep)), *_place_rows(deep, "below while resolved")]
    return [replace(row, part=RESOLVED) for row in rows]


def _place_rows(point, when):
    """Rows with place and plane of a worst point."""
    return [replace(row, what=f"{row.what}, {when}") for row in _point_rows(point)[:2]]


def _frame(f):
    """Text after a place on the body without the feature, whose frame moves relative to the feature."""
    return "" if f.get("carries_feature", True) else " (feature.x = 0 at X = 0)"


def _point_rows(f, frame=""):
    """Rows of the worst point at the surface or below it."""
    low, high = f.get("pit_angles_deg", (None, None))
    pits = "" if low is None else f" (usual for pits: {low:g} to {high:g})"
    rows = [SummaryRow("at x, y (as feature.x, feature.y)", f"{f['x_m'] * 1e6:.1f}, {f['y_m'] * 1e6:.1f} um", note=frame),
            SummaryRow("critical plane, angle to the surface", f"{f['surface_angle_deg']:.1f} deg", note=pits),
            SummaryRow("shear amplitude, largest normal stress",
                       f"{f['tau_amp_Pa'] / 1e6:.1f}, {f['sigma_n_max_Pa'] / 1e6:.1f} MPa")]
    own = f.get("sigma1_worst_Pa")  # not in stores before 0.2
    return rows + ([_stress("largest principal stress there", own)] if own is not None else [])


def _below_rows(f):
    if "below" not in f:
        return []
    deep = f["below"]
    rows = [row_of(deep, "Fi_max", "Fi_max below the surface", where=at_depth(deep) + _all_moments_text(f)),
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


def _judged_stress(part, criterion):
    """Row of the stress behind an index, with the relative error of the index."""
    Fi, bar, stress = part["Fi_max"], error_of(part, "Fi_max"), part["findley_stress_max_Pa"]
    error = abs(bar / Fi) * stress if bar is not None and Fi else None
    values = {"stress": stress, "error": {"stress": error}}
    return replace(_stress(f"{criterion} stress", stress), value=quantity(values, "stress", 1e-6, "MPa"), error=error)


def _stress(what, value):
    return SummaryRow(what, f"{value / 1e6:.1f} MPa", value)
