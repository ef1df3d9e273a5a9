"""Computation of a bearing: load of every element, contacts with both rings, their runs, the record of all."""

import contextlib
import dataclasses
import math
import os
from os import PathLike
from pathlib import Path

from tehl_taichi.disk import files
from tehl_taichi.disk.locked_folder import only_writer
from tehl_taichi.errors import Error, StoreError, for_reader
from tehl_taichi.runs import place_warnings
from tehl_taichi.runs.bearing import ellipse_slip, kinematics, load_distribution, ring_contacts, ring_scenes, stiffness
from tehl_taichi.runs.bearing.bearing_source import bearing_source
from tehl_taichi.runs.bearing.dry_contact import dry_contact
from tehl_taichi.runs.bearing.ring_contacts import RINGS
from tehl_taichi.runs.bearing.rolling_bearing import RollingBearing
from tehl_taichi.runs.bearing.static_safety import LIMITS, safety
from tehl_taichi.runs.bearing.stored_bearing import Bearing
from tehl_taichi.runs.flank.flank_run import all_changes, first_free_folder
from tehl_taichi.runs.flank.outcomes import computed, stored_outcomes
from tehl_taichi.runs.progress import Progress, progress_of
from tehl_taichi.runs.sweep import pool
from tehl_taichi.scene import Scene, grid_for_features, scene_file
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.film_formula import formula_words, heated_film, spread
from tehl_taichi.scene.scales import reduced_modulus
from tehl_taichi.store.json_values import plain
from tehl_taichi.store.load_scene import find
from tehl_taichi.values.checks import choice, flag, table
from tehl_taichi.values.coded_warning import lists
from tehl_taichi.values.path_arguments import path_of
from tehl_taichi.values.units import amount

ASSUMPTIONS = ("rings keep their shape and do not tilt", "elements roll without gross slip", "centrifugal forces are left out")
SPINS = "spin by outer raceway control (Jones 1959): all of it at the inner ring"
NOTICED = 0.01  # of the largest load, of a centrifugal force
SLIPPED = 41  # points of the slip over an ellipse that are kept


@dataclasses.dataclass(frozen=True)
class RingCase:
    """One ring: its RingContact, DryContact, EllipseSlip (None: rollers), scene, and text about the grid chosen for it."""

    contact: object
    dry: object
    slip: object
    scene: Scene
    grid: str = ""


def bearing(what: str | int | PathLike | RollingBearing, *, load: float | None = None, axial: float | None = None,
            speed: float | None = None, dimensions: dict | None = None, on: str = "inner", feature: Feature | None = None,
            roughness: float | None = None, scene: Scene | str | PathLike | None = None,
            changes: dict | None = None, steady: bool = False, run: bool = True, folder: str | PathLike | None = None,
            workers: int | None = None, threads: int | None = None, progress: Progress | None = None) -> Bearing:
    """Compute a bearing: see :func:`tehl_taichi.bearing`."""
    choice("on", on, RINGS)
    flag("run", run)
    pool.check_numbers(workers, threads, "--threads")
    table("dimensions", dimensions or {}, "{key: value}, as in {'clearance': 10e-6}")
    if roughness is not None:
        roughness = amount("roughness", roughness, "m", 1e-10, 1e-4, usual=1e-7)
    found = bearing_source(what, {**(dimensions or {}), "load": load, "axial": axial, "speed": speed})
    start = find(scene) if scene is not None else found.scene or find()
    base = ring_scenes.base_of(start, feature)
    changes = all_changes(changes or {}, steady)
    ring_scenes.check_free(changes)
    steady = bool(changes.get("time.steady_only"))
    passing = bool(base.features) and not steady and (feature is not None or scene is not None or found.scene is not None)
    doubts = [] if passing else ring_scenes.idle_words(base, changes)
    choose = grid_for_features.is_grid_open(start, changes)
    loads, speeds, rings = solve_mechanics(found, base, changes, on if passing else "", choose)
    target = path_of("folder", folder) if folder else first_free_folder(found.name)
    made = Bearing(target, bearing_record(found, target, loads, speeds, rings, roughness, doubts))
    Bearing.check_writable(target, made)
    made = _with_stored(made, rings) if run else _with_scene_warnings(_with_stored(made, rings), rings)
    _check_scenes(target, rings)
    with only_writer(Path(target)):
        made.write()
        write_scenes(target, rings)
    _report(progress_of(progress), rings, doubts)
    if workers is None and threads is None and passing:
        workers = 1  # all cores for the passage, which takes minutes, the other ring seconds
    if not run:
        return made
    return computed(made, _with_ring, _scenes(rings), workers, threads, progress)


def _with_scene_warnings(made, rings):
    """Copy of a Bearing with the warnings of the scenes that have not run: those of a run contain them."""
    scenes = [(ring, None, lists(case.scene.typed_warnings)) for ring, case in rings.items() if not made.rings[ring]["summary"]]
    found = place_warnings.of(scenes, "{} ring".format)
    return Bearing(made.folder, {**made.record, "warnings": [*made.record["warnings"], *found]})


def _report(progress, rings, doubts):
    """Report the grids that were chosen, and the keys without effect."""
    for case in (case for case in rings.values() if case.grid):
        progress.say(for_reader(case.grid))
    for sentence in doubts:
        progress.warn(sentence)


def solve_mechanics(found, base, changes, on, choose=False):
    """Solve the mechanics of a BearingSource: (loads, speeds, {ring: :class:`RingCase`}).

    on: ring that carries the features, "" for none; choose: whether their grid is chosen here.
    """
    which, E = found.bearing, reduced_modulus(base.replace(**ring_scenes.bodies(changes)))
    free = ring_contacts.contacts(which)
    loads = load_distribution.distribution(which, stiffness.of_bearing(which, free, E))
    contacts = free if which.rollers else ring_contacts.contacts(which, loads.angle)
    speeds = kinematics.speeds(which, contacts)
    return loads, speeds, {ring: _ring(found, base, changes, contacts[ring], loads, speeds, E, ring == on, choose)
                           for ring in RINGS}


def _ring(found, base, changes, contact, loads, speeds, E, passes, choose):
    dry = dry_contact(found.bearing, contact, loads.largest, E)
    slip = None if found.bearing.rollers else ellipse_slip.slip_over(contact, dry.b, speeds.u_m, speeds.spin[contact.ring])
    made, words = ring_scenes.ring_scene(base, changes, f"{found.name}-{contact.ring}", contact, dry, speeds.u_m,
                                         slip.representative if slip else 0.0, passes, choose)
    return RingCase(contact, dry, slip, made, words)


def bearing_record(found, folder, loads, speeds, rings, roughness, doubts=()):
    """JSON object of `tehl bearing --json` before the runs."""
    which, one = found.bearing, rings["inner"].scene
    return plain({
        "name": found.name, "folder": str(folder), "source": found.source, "estimated": list(found.estimated),
        "changed": list(found.changed), "geometry": dataclasses.asdict(which), "materials": _materials(one),
        "oil": one.oil.name, "temperature_C": one.operation.temperature, "roughness_Sq_m": roughness,
        "assumptions": _assumptions(which, loads, speeds, rings), "ball_load_max_N": loads.largest, "loads_N": loads.loads,
        "azimuths_deg": [math.degrees(one) for one in loads.azimuth],
        "contact_angles_deg": [math.degrees(one) for one in loads.angles],
        "loaded": loads.loaded, "axial_load_N": loads.axial_load, "radial_displacement_m": loads.radial,
        "axial_displacement_m": loads.axial, "end_play_m": loads.end_play, "cage_speed_1_min": speeds.cage * 30 / math.pi,
        "element_passes_per_s": speeds.element_passes, "static_limit_Pa": LIMITS[which.element],
        "warnings": list(doubts),
        **{ring: _ring_record(which, case, speeds, folder) for ring, case in rings.items()}})


def _materials(scene):
    """{"ring", "element": description of the material}."""
    bodies = (("ring", scene.body_a), ("element", scene.body_b))
    return {name: ", ".join(filter(None, [body.material, f"E = {body.E / 1e9:g} GPa, nu = {body.nu:g}"]))
            for name, body in bodies}


def _assumptions(which, loads, speeds, rings):
    force = kinematics.centrifugal_force(which, speeds, rings["inner"].scene.body_b.rho)
    out = list(ASSUMPTIONS[:2])
    share = force / loads.largest
    out.append(f"{ASSUMPTIONS[2]} ({force:.3g} N per element{f', {share:.0%} of the largest load' if share > NOTICED else ''})")
    return [*out, SPINS] if any(speeds.spin.values()) else out


def _ring_record(which, case, speeds, folder):
    contact, dry, ring = case.contact, case.dry, case.contact.ring
    line = dry.kind != "elliptic" and which.rollers and dry.b == which.length / 2
    return {"R_x_m": contact.R_x, "R_y_m": contact.R_y, "a_m": dry.a, "b_m": dry.b, "p_Hertz_Pa": dry.p_H,
            "u_m_m_s": speeds.u_m, "contact": dry.words, "load_N": dry.load, "passes_per_s": speeds.passes[ring],
            "static_safety": safety(which, dry.p_H, line), **_slip_record(case.slip, speeds.spin[ring]),
            **_formula(case.scene), "grid": case.grid, "scene_file": str(Path(folder) / f"{ring}.toml"),
            "store": str(Path(folder) / f"{case.scene.name}.zarr"), "converged": False, "reason": "", "summary": None}


def _slip_record(slip, spin):
    """Slip across the contact, thinned out to a few points."""
    if slip is None:
        return {"slip": None, "spin_rad_s": 0.0}
    step = (slip.y.size - 1) // (SLIPPED - 1)
    return {"slip": {"srr": slip.representative, "srr_centre": slip.centre, "srr_edge": slip.edge,
                     "mean_m_s": slip.mean, "pure_rolling_y_b": slip.rolling,
                     "y_m": slip.y[::step], "slip_m_s": slip.slip[::step]}, "spin_rad_s": spin}


def _formula(made):
    return {"film_formula_m": heated_film(made), "film_formula": formula_words(made), "film_formula_spread": spread(made)}


def _with_stored(made, rings):
    """The bearing with the results in its stores. Raises StoreError for stores of other scenes, before anything is replaced."""
    for n, outcome in stored_outcomes(_scenes(rings), made.folder).items():
        made = _with_ring(made, n, outcome)
    return made


def _scenes(rings):
    return [rings[ring].scene for ring in RINGS]


def _with_ring(made, n, outcome):
    return made.with_ring(RINGS[n], outcome)


def _check_scenes(folder, rings):
    """Refuse a folder whose scene files have other scenes, which would be lost. Raises StoreError."""
    for ring, case in rings.items():
        file = Path(folder) / f"{ring}.toml"
        if os.path.lexists(file) and not _describes(file, case.scene):
            raise StoreError(f"{file} holds another scene than this command makes: it was changed, or made with other options. "
                             "Choose another --out, or move the file away")


def _describes(file, scene):
    """Whether a scene file describes this scene, with other comments or without defaults, too."""
    text = scene_file.dumps(scene)
    with contextlib.suppress(OSError, ValueError, Error):
        return files.text(file) == text or scene_file.dumps(find(str(file))) == text
    return False


def write_scenes(folder, rings):
    """Write scene files with every value, FOLDER/inner.toml and outer.toml, unless they exist. Raises StoreError."""
    with files.disk_errors(folder, "cannot write to"):
        for ring, case in rings.items():
            if not os.path.lexists(file := Path(folder) / f"{ring}.toml"):
                files.replace(file, scene_file.dumps(case.scene).encode())
