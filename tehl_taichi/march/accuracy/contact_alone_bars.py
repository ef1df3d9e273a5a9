"""Fatigue of the contact alone on all grids of the steady start: its numbers and their error bars."""

from tehl_taichi.fatigue import contact_alone
from tehl_taichi.fatigue.assessment import Snapshots
from tehl_taichi.fatigue.judged_layers import first_decides
from tehl_taichi.march.accuracy.coarse_runs import MISES
from tehl_taichi.march.accuracy.domain_error import widened
from tehl_taichi.march.accuracy.error_bars import GridReading, bars
from tehl_taichi.values.coded_text import Reason, unknown_of

INDICES = ("Fi_max", "surface_Fi_max")
NEAR = 2.0  # cells: deeper, a peak of the pressure a few cells wide changes little


def searches(scene, first):
    """{surface: numbers of :func:`tehl_taichi.fatigue.contact_alone.search`, with "error" and "unknown"} of the moving bodies,
    the one that decides first; {} if fatigue is off.

    first: snapshot of the steady start, see :class:`tehl_taichi.march.snapshot.Snapshot`.
    """
    if not scene.fatigue.on:
        return {}
    found = {surface.name: _searched(scene, surface, first) for surface in scene.judged}
    return first_decides(found) if found else {}


def _searched(scene, surface, first):
    each = [contact_alone.search(scene, Snapshots([grid]), surface).summary for grid in (*first.coarser, first)]
    found, reasons = bars([*(_readings(one) for one in each[:-1]), _readings(each[-1], first)])
    if first.unsettled:
        found, reasons = (dict.fromkeys(found, one) for one in (None, Reason(first.unsettled, "unsettled")))
    errors, unknown, _ = widened(found, reasons, _values(each[-1]), first.domain, scene.operation.temperature, passing=True)
    mises = {"error": {"max_Pa": errors.pop(MISES)}, **unknown_of({"max_Pa": unknown.pop(MISES)} if MISES in unknown else {})}
    return {**each[-1], "von_mises": {**each[-1]["von_mises"], **mises}, "error": errors, **unknown_of(unknown)}


def _readings(one, first=None):
    """{name: GridReading} of a search; first: of the grid of the steady start, near whose unresolved peaks of the pressure they
    are unknown.
    """
    doubt = first.grids[-1]["p_max_Pa"].doubt if first and first.grids else ""
    near = NEAR * float(first.x[1] - first.x[0]) if doubt else 0.0
    depths = {"surface_Fi_max": 0.0, "Fi_max": one["depth_m"], MISES: one["von_mises"]["depth_m"]}
    return {name: GridReading(value, positive=True, doubt=doubt if depths[name] < near else "")
            for name, value in _values(one).items()}


def _values(one):
    """{name: number with an error bar} of a search."""
    return {**{name: one[name] for name in INDICES}, MISES: one["von_mises"]["max_Pa"]}
