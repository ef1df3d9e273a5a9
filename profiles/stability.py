"""Stiff and extreme scenes, their fatigue included: each must converge, or stop with its reason; never NaN, a negative film
or a hang."""

import time
from dataclasses import dataclass
from typing import Optional

import numpy as np
from tehl_taichi.profiles import measure

from tehl_taichi.errors import NotConverged
from tehl_taichi.fatigue import assessment
from tehl_taichi.march.passage import march, total_steps
from tehl_taichi.runs.sweep import pool
from tehl_taichi.scene import Scene, SceneError, thin_film
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.sections import AUTO
from tehl_taichi.view.figures import palette

MOST_STEPS = 600  # of a passage; with temperatures SRR -1.99 would need 25 536, the feature hardly moves in one
FINEST = {"line": 1024, "point": 256}  # columns, of scenes on the grid that their film needs
COLOURS = {"converged": palette.GREEN, "refused": palette.GREY, "stopped": palette.ORANGE, "failed": palette.VERMILLION}


@dataclass(frozen=True)
class CaseOutcome:
    """verdict: converged, refused (at the door), stopped (not converged, with a reason) or failed (NaN, negative film).

    Fi_max: fatigue index of a passage that converged, else None; unsettled: whether it began from a state in time; carried:
    whether the grid carries its film, by the film formula.
    """

    name: str
    verdict: str
    reason: str
    steps: int
    newton: float
    cycles: float
    seconds: float
    Fi_max: Optional[float] = None
    unsettled: bool = False
    carried: bool = False


def carried(chosen):
    """`chosen`, {name: scene or SceneError}, with as many columns as the warning of a film too thin for the grid needs (of
    lines the rows stay), at most FINEST."""
    return {name: description if isinstance(description, SceneError) else _carried(description)
            for name, description in chosen.items()}


def _carried(description):
    g, line = description.grid, Scales.of(description).line
    most = max(g.nx, FINEST["line" if line else "point"])
    nx, ny = thin_film.sufficient_grid(description, most) or (most, g.ny * most // g.nx)
    return description.replace(**{"grid.nx": nx, "grid.ny": g.ny if line else ny})


def starts(chosen):
    """The scenes with temperatures of {name: scene or SceneError}, each to be run for a step after its start."""
    return {name: description.replace(**{"time.steps": 1} if description.transient else {})
            for name, description in chosen.items() if isinstance(description, Scene) and not description.isothermal}


def run(chosen, precision=AUTO, workers=1, threads=None):
    """Generator of a CaseOutcome for each of `chosen` (pairs of a name and a scene or SceneError), in the order in which they
    end.

    workers: processes side by side, each on `threads` threads (None: all that are left).
    """
    jobs = [(name, description, precision) for name, description in chosen]
    for number, found in measure.side_by_side(run_case, jobs, workers, threads):
        lost = isinstance(found, pool.LostJob)
        yield CaseOutcome(jobs[number][0], "failed", found.reason, 0, 0.0, 0.0, 0.0) if lost else found


def run_case(name, description, precision=AUTO):
    """March one scene to its end with linear solves in `precision`, and search the fatigue of a passage. Returns an Outcome."""
    started, shots, newton, cycles = time.perf_counter(), [], 0.0, 0.0
    verdict, reason, index = "converged", "", None
    if isinstance(description, SceneError):
        return CaseOutcome(name, "refused", str(description), 0, 0.0, 0.0, 0.0)
    description = description.replace(**{"numerics.precision": precision})
    if total_steps(description) > MOST_STEPS:
        description = description.replace(**{"time.steps": MOST_STEPS})
    try:
        for shot in march(description):
            newton, cycles = newton + shot.scalars["newton"], cycles + shot.scalars["cycles"] * bool(shots)
            shots.append(shot)
            if not sound(shot):
                verdict, reason = "failed", f"NaN or negative film at step {shot.step}"
                break
        if verdict == "converged" and description.has_fatigue and len(shots) > 2:
            index = assessment.run(description, shots).summary["Fi_max"]
            if not 0 <= index < np.inf:
                verdict, reason = "failed", f"fatigue index {index}"
    except NotConverged as error:
        verdict, reason = "stopped", str(error)
    except SceneError as error:  # single precision for a film too thin for it
        verdict, reason = "failed" if shots else "refused", str(error)
    except Exception as error:  # noqa: BLE001  anything else is what the suite looks for
        verdict, reason = "failed", repr(error)
    steps = max(len(shots) - 1, 0)
    count, seconds = max(steps, 1), time.perf_counter() - started
    unsettled = shots[0].unsettled if shots else ""
    return CaseOutcome(name, verdict, reason or unsettled, steps, newton / count, cycles / count, seconds, index,
                       bool(unsettled),
                   thin_film.resolved_ratio(description) >= 1)


def sound(shot):
    """No NaN, no negative film or pressure."""
    p, h = shot.fields["pressure"], shot.fields["film"]
    return bool(np.isfinite(p).all() and np.isfinite(h).all() and p.min() >= 0 and h.min() > 0)


def chart(plt, found):
    """Krylov iterations and seconds of a step of every case, by its verdict; those that did not converge are named."""
    figure, ax = plt.subplots(figsize=(7, 4.6), constrained_layout=True)
    for verdict, colour in COLOURS.items():
        own = [one for one in found if one.verdict == verdict]
        steps = [one.seconds / max(one.steps, 1) for one in own]
        cycles = [one.cycles for one in own]
        ax.scatter(steps, cycles, s=16, color=colour, label=f"{len(own)} {verdict}")
        for one, x, y in zip(own, steps, cycles):
            if verdict != "converged":
                ax.annotate(one.name, (x, y), fontsize=6, xytext=(3, 2), textcoords="offset points")
    ax.set(xlabel="seconds a step", ylabel="Krylov iterations a step")
    ax.set_xscale("symlog", linthresh=1e-3)
    ax.set_yscale("symlog", linthresh=1)
    ax.legend(fontsize=8)
    return figure
