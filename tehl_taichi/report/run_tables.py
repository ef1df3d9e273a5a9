"""Tables of a run: numbers with their errors, worst points, numerics, provenance."""

from tehl_taichi.fatigue.judged_layers import deciding, leading, over
from tehl_taichi.fatigue.judged_surfaces import by_surface
from tehl_taichi.march import quantities
from tehl_taichi.report.document import facts, sentences, table
from tehl_taichi.report.number_text import FEW, index, roughly, share, text_parts, value_text
from tehl_taichi.runs.summary.summary_rows import contact_share
from tehl_taichi.runs.sweep.axis_syntax import word
from tehl_taichi.scene.feature_wording import feature_word, met_words
from tehl_taichi.store import integrity
from tehl_taichi.values.coded_text import Reason, reasons_of
from tehl_taichi.values.summary_values import error_of
from tehl_taichi.view.figures.index_text import resolved_words

PARTS = (("steady", "steady start"), ("transient", "passage"), ("fatigue", "fatigue"))
SHORT = 30  # letters of a reason that stands in the row itself
BRIEF = {"exit": "exit not resolved", "peak": "peak not resolved", "unsettled": "not converged"}  # {code: a long reason}
RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def errors(summary):
    """Tables of the numbers with an error or a reason why it is unknown, followed by the long reasons, once each."""
    head: tuple = ("what", "value", "error", "relative")
    reasons: list[str] = []
    tables = [table(head, [row for found in _parts_in_order(summary, part)
                           for row in _with_below(reasons, *found)], when)
              for part, when in PARTS]
    return [*tables, sentences([f"{_mark(n)} {why}" for n, why in enumerate(reasons)], "Why an error is unknown")]


def _parts_in_order(summary, part):
    """[(numbers, text after their names)]; the resolved part is first if it decides the verdict."""
    values = summary.get(part, {})
    found = [(values, ", whole passage" * ("resolved" in values))]
    found += [(wide, over(wide["length_m"])) for wide in [values.get("averaged")] if wide]
    if early := values.get("resolved"):
        found.insert(0 if deciding(by_surface(summary))[1] else len(found), (early, f", {resolved_words(early)}"))
    return found


def _with_below(reasons, found, more):
    """Rows of a part and of the layers below the surface in it; more: text after each label."""
    for says, *rest in (*_with_errors(found, reasons), *_of_below(found.get("below", {}), reasons)):
        yield says + more, *rest


def _of_below(deep, reasons):
    """Rows of the layers below the surface."""
    for says, *rest in _with_errors(deep, reasons):
        yield says.replace("at the surface", f"{value_text(deep['depth_m'], unit='m')} below the surface"), *rest


def _with_errors(values, reasons):
    """Rows of numbers with errors; reasons: list of long reasons, extended by those of these rows."""
    for name, error in values.get("error", {}).items():
        if values.get(name) is None:
            continue
        says, unit = _meaning(name)
        value, shown, scale = text_parts(values[name], error, unit, FEW)
        value = roughly(values[name]) if name == "Fi_max" and error is None else value
        why = reasons_of(values).get(name, Reason("not estimated"))
        yield (says, f"{value} {scale}".strip(), _in_row(why, reasons) if error is None else f"{shown} {scale}".strip(),
               "" if error is None else share(error, values[name]))


def _in_row(why, reasons):
    """Text of a reason in its row: a long one is shortened, with the mark of its note below the tables."""
    if len(why) <= SHORT:
        return why
    if why not in reasons:
        reasons.append(why)
    return f"{BRIEF.get(why.code, 'not known')} {_mark(reasons.index(why))}"


def _mark(n):
    """Mark of the n-th note, from 0."""
    return str(n + 1).translate(RAISED)


def _meaning(name):
    """(long name, unit) of a number of the summary."""
    entry = quantities.of_key(name)
    return (entry.name, entry.unit) if entry else (name, "1")


POINT = (("index Fi", "Fi_max", "1"), ("stress of the criterion", "findley_stress_max_Pa", "Pa"), ("depth", "depth_m", "m"),
         ("x of the {}", "x_m", "m"), ("y of the {}", "y_m", "m"), ("shear amplitude", "tau_amp_Pa", "Pa"),
         ("largest normal stress", "sigma_n_max_Pa", "Pa"), ("largest principal stress", "sigma1_worst_Pa", "Pa"),
         ("critical plane to the surface (0°: it lies in the surface)", "surface_angle_deg", "°"))


def worst_points(fatigue, scene):
    """Table of the worst points at and below the surface."""
    points = [("surface", {"depth_m": 0.0, **fatigue}), *([("below it", fatigue["below"])] if "below" in fatigue else [])]
    points += [(f"{'below it' if 'depth_m' in part else 'surface'}{over(length)}", {"depth_m": 0.0, **part})
               for part, length in leading(fatigue) if length]
    rows = [(text.format(feature_word(scene)), *(_of_point(point, key, unit) for _, point in points))
            for text, key, unit in POINT]
    places = _in_file(scene, fatigue, [point for _, point in points])
    return table(("critical point", *(where for where, _ in points)), rows + places)


def _in_file(scene, fatigue, points):
    """[(label, position of each point in the file of the scan)]; [] if positions are not those of a scan. fatigue: summary of
    the search.
    """
    if feature_word(scene) != "scan":
        return []
    label = f"nearest point in the file of the scan{met_words(scene, fatigue)}"
    return [(label, *(in_file(scene, p["x_m"], p["y_m"]) for p in points))]


def in_file(scene, x, y):
    """Text of row and column of the point of a scan nearest to x, y (m, as in maps of the index)."""
    first = scene.features[0]
    return first.position_in_file(x - first.x, y - first.y)


def _of_point(point, key, unit):
    """Text of a number of a point, '' without one; the index as everywhere on the page."""
    if key == "Fi_max":
        return index(point[key], error_of(point, key))
    return value_text(point[key], unit=unit) if key in point else ""


def tension(fatigue):
    """Rows of the whole surface besides the critical point; None if they are not stored."""
    most = fatigue.get("sigma1_max_Pa")
    return facts([("largest principal stress at the surface", value_text(most, unit="Pa"))] if most is not None else [])


def solid_contact(summary):
    """Rows of the load share of solid contact; None without a finished passage."""
    passage = summary.get("transient")
    return facts([("load carried by solid contact", contact_share(passage))] if passage else [])


def numerics(store):
    """Rows of grid, tolerances, residuals and work."""
    summary, scene = store.summary, store.scene
    steps = store.scalar("dt_s")[1:]
    across = "" if scene.isothermal else f" × {scene.thermal.nodes} across the film"
    rows = [("nodes", f"{store.x.size} × {store.y.size}{across}"),
            ("grid along x", f"{scene.grid.x_min:g} to {scene.grid.x_max:g} a"),
            ("entries stored", str(store.steps)), ("time steps", str(store.last_step)),
            *([("time step", f"{steps.max() * 1e6:.4g} µs")] if len(steps) else []),
            ("tolerance of the residual", f"{scene.numerics.tolerance:g}"),
            *((f"largest error of {name}", f"{store.scalar(key).max():.1e}") for name, key in
              (("residual", "residual"), ("load", "load_error"), ("mass", "mass_error")))]
    return facts(rows + (_work(summary) if "work" in summary else []))


def _work(summary):
    work = summary["work"]
    rows = [("Newton steps", str(work["newton_steps"])), ("Krylov iterations", str(work["pressure_cycles"])),
            ("most in a step", str(work["cycles_per_step_max"])), ("attempts rejected", str(work["rejected_steps"])),
            ("run time", f"{summary['wall_s']:.1f} s, including kernels {summary['compile_s']:.1f} s")]
    return rows + [(what, f"{value:g}") for what, value in summary.get("clamps", {}).items()]


FROM = ("command", "date", "version", "commit", "python", "numpy", "pyfftw", "zarr", "machine", "cores", "precision")


def provenance(store):
    """Rows of provenance: attributes of the store, and the runtime of its process."""
    runtime = integrity.optional_value(store.attrs, "runtime", {})
    rows = [(key, str(store.attrs[key])) for key in FROM if key in store.attrs]
    return facts([("store", store.path.name), *rows, *((key, word(runtime[key])) for key in ("taichi", "arch", "threads")
                                                       if key in runtime)])
