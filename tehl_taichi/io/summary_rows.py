"""The summary of a run as people read it: rows of (quantity, value with its error and unit). Needs no taichi."""

from tehl_taichi.march.readings import HEAT
from tehl_taichi.values.digits import decimals


def title(summary):
    """Heading of its table."""
    return f"{summary['scene']}: {summary['steps']} steps, store {summary['store']}"


def summary_rows(summary):
    """(quantity, value) of the summary of a finished run."""
    rows = [("Hertz half-width a", f"{summary['hertz']['a_m'] * 1e3:.4f} mm"),
            ("Hertz pressure p_H", f"{summary['hertz']['p_Pa'] / 1e9:.4f} GPa")]
    steady = summary["steady"]
    for key, name, factor, unit in (("h_c_m", "steady h_c", 1e6, "um"), ("h_min_m", "steady h_min", 1e6, "um"),
                                    ("p_max_Pa", "steady p_max", 1e-9, "GPa")):
        rows.append((name, quantity(steady, key, factor, unit)))
    if "film_formula_m" in steady:
        rows.append(("h_c by formula (isothermal, Newtonian)", f"{steady['film_formula_m'] * 1e6:.4f} um"))
    rows.append(("steady friction coefficient", quantity(steady, "friction_coefficient")))
    rows += _heat_rows("steady", steady)
    rows += _passage_rows(summary)
    rows.append(("run time", f"{summary['wall_s']:.1f} s (kernels {summary['compile_s']:.1f} s)"))
    return rows


def quantity(values, name, factor=1, unit=""):
    """'value ± error unit' of one of the values, with two digits of the error; three digits where that is not known."""
    value, error = values[name] * factor, values.get("error", {}).get(name)
    if error is None:
        return f"{value:.3g} {unit}".rstrip() + " (error unknown)"
    size = error * factor
    digits = min(max(decimals(size), 0), 9) if size > 0 else 4
    return f"{value:.{digits}f} ± {size:.{digits}f} {unit}".rstrip()


def _heat_rows(when, values):
    if "film_max_C" not in values:
        return []
    errors = [values.get("error", {}).get(key) for key in HEAT]
    largest = " / ".join(f"{values[key]:.1f}" + (f" ± {error:.2g}" if error is not None else "")
                         for key, error in zip(HEAT, errors))
    unknown = " (errors unknown)" if errors == [None] * len(HEAT) else ""
    return [(f"{when} film / surface a / surface b, largest", f"{largest} °C{unknown}")]


def _passage_rows(summary):
    rows = []
    if "transient" in summary:
        t = summary["transient"]
        rows += _heat_rows("passage", t)
        rows += [("passage p_max", quantity(t, "p_max_Pa", 1e-9, "GPa")),
                 ("passage h_min", quantity(t, "h_min_m", 1e6, "um")),
                 ("passage friction coefficient, mean", quantity(t, "friction_coefficient_mean")),
                 ("load carried by solid contact", f"{t['contact_load_fraction_max']:.3%} at most"),
                 ("worst residual / load / mass error",
                  f"{t['residual_max']:.1e} / {t['load_error_max']:.1e} / {t['mass_error_max']:.1e}")]
    if "fatigue" in summary:
        rows += fatigue_rows(summary["fatigue"])
    return rows


def fatigue_rows(f):
    """(quantity, value) of a fatigue summary: the worst point of the surface, then of what lies below."""
    rows = [("Fi_max at the surface", quantity(f, "Fi_max")),
            (f"{f['criterion']} stress", _stress(f["findley_stress_max_Pa"])), *_point_rows(f),
            ("largest principal stress on the surface", _stress(f["sigma1_max_Pa"])),
            ("with kappa, sigma_eF", f"{f['kappa_F']:g}, {f['sigma_eF_Pa'] / 1e6:g} MPa"),
            ("thermal stress", "counted" if f["thermal_stress"] else "left out")]
    rows += [(f"largest at {_depth(layer)}", _stress(layer["findley_stress_max_Pa"])) for layer in f.get("by_depth", [])]
    return rows + _below_rows(f) + _resolved_rows(f)


def _resolved_rows(f):
    """What is known as long as the grid resolves the pressure, where it does not always do so."""
    if "resolved" not in f:
        return []
    part = f["resolved"]
    rows = [(f"Fi_max while resolved (to {part['to_x_a']:.2f} a)", quantity(part, "Fi_max"))]
    deep = part.get("below")
    return rows + ([(f"below it while resolved, at {_depth(deep)}", quantity(deep, "Fi_max"))] if deep else [])


def _point_rows(f):
    """The worst point of the surface or below it."""
    low, high = f.get("pit_angles_deg", (None, None))
    pits = "" if low is None else f" (pits begin at {low:g} to {high:g})"
    rows = [("at x, y of the feature", f"{f['x_m'] * 1e6:.1f}, {f['y_m'] * 1e6:.1f} um"),
            ("critical plane to the surface", f"{f['surface_angle_deg']:.1f} deg{pits}"),
            ("shear amplitude, largest normal stress", f"{f['tau_amp_Pa'] / 1e6:.1f}, {f['sigma_n_max_Pa'] / 1e6:.1f} MPa")]
    own = f.get("sigma1_worst_Pa")  # not in stores before 0.2
    return rows + ([("largest principal stress there", _stress(own))] if own is not None else [])


def _below_rows(f):
    if "below" not in f:
        return []
    deep = f["below"]
    rows = [(f"Fi_max below it, at {_depth(deep)}", quantity(deep, "Fi_max")),
            (f"{f['criterion']} stress", _stress(deep["findley_stress_max_Pa"])), *_point_rows(deep)]
    if "contact_alone" in deep:
        alone = deep["contact_alone"]
        rows.append((f"Fi of the contact alone, at {_depth(alone)}", f"{alone['Fi_max']:.4f}"))
    return rows


def _stress(value):
    return f"{value / 1e6:.1f} MPa"


def _depth(values):
    return f"{values['depth_m'] * 1e6:.0f} um"
