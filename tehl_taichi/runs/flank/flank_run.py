"""Computation of a flank: its positions, their runs, the record of both."""

import dataclasses
import math
import os
from collections.abc import Sequence
from os import PathLike
from pathlib import Path

from tehl_taichi.runs import machine_life
from tehl_taichi.runs.flank.flank_source import flank_source
from tehl_taichi.runs.flank.line_contacts import scene_at
from tehl_taichi.runs.flank.mesh import Mesh
from tehl_taichi.runs.flank.outcomes import Outcome, computed
from tehl_taichi.runs.flank.specific_film import film_ratios
from tehl_taichi.runs.flank.stored_flank import Flank
from tehl_taichi.runs.progress import Progress
from tehl_taichi.scene import Scene
from tehl_taichi.scene.aliases import resolve, words
from tehl_taichi.scene.gear_pair import GearPair
from tehl_taichi.scene.scales import Scales
from tehl_taichi.store.json_values import plain
from tehl_taichi.store.load_scene import find
from tehl_taichi.values.checks import CHANGES, flag, table
from tehl_taichi.values.coerce import listed
from tehl_taichi.values.path_arguments import path_of

ASSUMPTION = ("each position is a separate contact with constant load and speeds during the passage (a passage takes about "
              "0.1 ms, a mesh a few ms)")
SHARING = {"table": "of the table", "given": "gear.load_share",
           "spur": "trapezoid: 1/3 to 2/3 from A to B, 1 from B to D, 2/3 to 1/3 from D to E",
           "helical": "normal force over the mean length of the contact lines, b eps_alpha/cos beta_b"}
WAITING = "it has not run yet; repeat the tehl flank command with --out to resume"


def flank(gear: str | PathLike | GearPair = "fzg-c", *, torque: float | None = None, speed: float | None = None,
          on: str | None = None, positions: int | None = None, at: Sequence[str | float] = (),
          scene: Scene | str | PathLike | None = None, changes: dict | None = None, steady: bool = False,
          folder: str | PathLike | None = None, workers: int | None = None, threads: int | None = None,
          progress: Progress | None = None) -> Flank:
    """Compute a flank: see :func:`tehl_taichi.flank`."""
    found, scene = flank_source(gear).changed(torque, speed), None if scene is None else find(scene)
    changes = all_changes(changes or {}, steady)
    places = found.positions(on, positions, listed(at))
    scenes = [scene_at(scene or found.scene, changes, found.name, n, place) for n, place in enumerate(places, 1)]
    target = path_of("folder", folder) if folder else first_free_folder(found.name)
    subject = describe(found, target, (on or "pinion") if found.pair else "")
    outcomes = [Outcome(target / f"{one.name}.zarr", reason=WAITING) for one in scenes]

    def with_outcome(_, n, outcome):
        outcomes[n] = outcome
        return Flank(target, flank_record(subject, places, scenes, outcomes))

    made = Flank(target, flank_record(subject, places, scenes, outcomes))
    Flank.check_writable(target, made)
    return computed(made, with_outcome, scenes, workers, threads, progress)


def all_changes(changes, steady):
    """{full key: value} of all changes. Raises SceneError if `steady` contradicts a change, or an argument is no such thing."""
    table("changes", changes, CHANGES)
    flag("steady", steady)
    return resolve([*((words(key, value), key, value) for key, value in changes.items()),
                    *[("steady = True", "time.steady_only", True)] * steady])


def flank_record(subject, places, scenes, outcomes):
    """JSON object of a flank: its description (see :func:`describe`), and the positions with their scenes and outcomes."""
    pair = subject["geometry"]
    Ra = 0.5 * (pair.get("Ra1", 0.0) + pair.get("Ra2", 0.0))
    rates = machine_life.of_gears(pair["n1"], pair["z1"], pair["z2"], pair["on"]) if "z1" in pair else None
    return plain({**subject, "positions": [_position(*one, Ra, rates) for one in zip(places, scenes, outcomes)]})


def describe(found, folder, on):
    """Description of a flank; found: result of :func:`flank_source`; on: pinion or gear, "" for a table."""
    return {"name": found.name, "folder": str(folder), "assumption": ASSUMPTION, "load_sharing": _sharing(found.pair),
            "geometry": _geometry(found.pair, on) if found.pair else {"table": found.source}}


def _sharing(pair):
    """Text about the load sharing."""
    return SHARING["table" if not pair else "given" if pair.load_share else "helical" if pair.beta else "spur"]


def _geometry(pair, on):
    mesh, sign = Mesh(pair), -1 if on == "gear" else 1
    return {**dataclasses.asdict(pair), "on": on, "alpha_w_deg": math.degrees(mesh.alpha_w), "d_a1": mesh.d_a(1),
            "d_a2": mesh.d_a(2), "eps_alpha": mesh.eps_alpha, "p_bt_m": mesh.p_bt, "s_C_m": mesh.rho_C(1),
            "rho_C1_m": mesh.rho_C(1), "rho_C2_m": mesh.rho_C(2), "u_C_m_s": mesh.speeds(0.0)[0], "F_bt_N": mesh.F_bt,
            "points_x_pl_m": {name: sign * x + 0.0 for name, x in mesh.points.items()}}


def _position(at, scene, outcome, Ra, rates):
    """Entry of a position; Ra: mean roughness of both flanks in m, 0: not given; rates: ContactRates, None for a table."""
    bulk = None if at.bulk is None else scene.operation.temperature
    return {"point": at.point, "x_pl_m": at.x_pl, "arc_m": at.arc, "rho_a_m": at.rho_a, "rho_b_m": at.rho_b, "R_m": at.R,
            "u_a_m_s": at.u_a, "u_b_m_s": at.u_b, "srr": at.srr, "load_N_m": at.load, "p_Hertz_Pa": Scales.of(scene).p_H,
            "bulk_C": bulk, "film_ratios": film_ratios(scene, outcome.summary, Ra), **at.more, "store": str(outcome.store),
            "converged": outcome.summary is not None, "reason": outcome.reason,
            "summary": machine_life.with_hours(outcome.summary, rates)}


def first_free_folder(name):
    """First of runs/NAME-1, runs/NAME-2 ... that does not exist."""
    n = 1
    while os.path.lexists(folder := Path("runs") / f"{name}-{n}"):
        n += 1
    return folder
