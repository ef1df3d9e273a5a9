"""Crack analysis of one body: for both sides of the feature the trajectory, the crack path and the loads that drive it."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.crack import body
from tehl_taichi.crack.fillings import FILLINGS
from tehl_taichi.crack.growth import WHY, CrackPath, grow, load_crack
from tehl_taichi.crack.symmetry_plane import SymmetryPlane, first_feature_path, plane_of
from tehl_taichi.crack.trajectory import CrackStart, start, trajectory
from tehl_taichi.errors import SceneError
from tehl_taichi.fatigue.assessment import PIT_ANGLES, Snapshots
from tehl_taichi.values.digits import number_of

DEPTHS = (10e-6, 20e-6, 40e-6)  # m, at which the chord from the mouth is measured
FAR = 2.0                       # lengths of the crack that its trajectory is followed
CLEAR = 0.05                    # a larger difference between the grids of a crack is said
STRAIGHT = 0.0175               # across over depth: grids change trajectories by a degree, so that less is no direction
SMALL = 0.05                    # of the largest tension along a trajectory: less may stay near zero over a long way


@dataclass(frozen=True, eq=False)
class CrackSide:
    """Result of one side: its :class:`CrackStart`, the trajectory (complex points, m), the tension (Pa) along it, the crack
    path.
    """

    start: CrackStart
    trajectory: np.ndarray
    tension: np.ndarray
    path: CrackPath

    def __repr__(self):
        points = number_of(self.path.points.size, "point")
        return f"<Side from x = {self.start.x * 1e6:.1f} um: {points}, stopped by {self.path.why}>"


@dataclass(frozen=True, eq=False)
class CrackResult:
    """Crack paths on both sides of a feature.

    Attributes
    ----------
    summary : dict
        Numbers in SI units; "surface": "a" or "b", whose cracks these are.
    sides : dict
        {"entry" or "exit": :class:`CrackSide`} of the sides where the surface is in tension.
    plane : SymmetryPlane
        Stresses of that body in the plane below the feature.
    options : CrackOptions
        The options.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.CrackResult({}, {}, None, None)
    <tehl.CrackResult: no side opens>
    """

    summary: dict
    sides: dict
    plane: SymmetryPlane
    options: object

    def __repr__(self):
        each = [f"{name} to {side.path.points.imag.max() * 1e6:.0f} um deep" for name, side in self.sides.items()]
        return f"<tehl.CrackResult: {', '.join(each) or 'no side opens'}>"


def run(scene, reader, options):
    """Return the :class:`CrackResult` of a passage of `scene`. reader: see :func:`plane_of`, or a list of snapshots. Raises
    SceneError.
    """
    reader = Snapshots(reader) if isinstance(reader, list) else reader
    first_feature_path(scene, reader)
    surface = body.cracked_surface(scene, reader, options.surface)

    def check(places, deepest):
        _check_places(places, deepest, options)

    plane = plane_of(scene, reader, options.residual, check=check, surface=surface)
    return follow(plane, scene, options)


def follow(plane, scene, options):
    """Return the :class:`CrackResult` for given stresses of the symmetry plane."""
    _check_places(plane.x, plane.depths[-1], options)
    surface = plane.surface or scene.reference
    E_star, sides, summaries = surface.body.E / (1 - surface.body.nu**2), {}, {}
    for name in options.sides:
        origin = start(plane, name, options.start)
        summaries[name] = {"opens": origin is not None}
        if origin:
            path = grow(plane, origin, options, E_star)
            points, tension = trajectory(plane, origin, FAR * options.length)
            sides[name] = CrackSide(origin, points, tension, path)
            summaries[name] |= _summary(plane, sides[name], options, E_star)
        else:
            summaries[name]["why"] = _why_not(plane, name)
    whose = {"surface": surface.name, "carries_feature": bool(surface.features)}
    return CrackResult({**whose, "sides": summaries, **_common(scene, options)}, sides, plane, options)


def _why_not(plane, side):
    """Reason why no crack starts on that side."""
    if not ((plane.centres < 0) if side == "entry" else (plane.centres > 0)).any():
        return "the passage has no moment with the feature on this side of the contact"
    return "the surface is never in tension on this side, so a crack would not open"


def _check_places(places, deepest, options):
    """Raise SceneError if the mouth or the first piece lies outside the stresses, given at these x' (m) and to depth `deepest`
    (m).
    """
    (low, high), x = places[[0, -1]], options.start
    if x is not None and not low <= x <= high:
        raise SceneError(f"start = {x:g} m is outside the computed stresses; allowed: {low:.3g} to {high:.3g} m")
    tip = (x or 0.0) + options.first * np.exp(1j * np.radians(options.angle))
    if not (low <= tip.real <= high and tip.imag <= deepest):
        mouth = f" from start = {x:g} m" if x is not None else ""
        raise SceneError(f"first = {options.first:g} m{mouth} leads out of the computed stresses (to {high:.3g} m along x, "
                         f"{deepest:.3g} m deep)")


def _common(scene, options):
    return {"srr": scene.operation.srr, "thermal_stress": scene.has_thermal_stress, "face_friction": options.face_friction,
            "oil": options.filling, "oil_is": FILLINGS[options.filling].says,
            "oil_share": options.oil_share if options.filling == "film" else None, "threshold": options.threshold,
            "distance_m": options.distance, "pit_angles_deg": list(PIT_ANGLES)}


def _summary(plane, side, options, E_star):
    origin, path = side.start, side.path
    out = {"start_x_m": origin.x, "start_angle_deg": options.angle, "sigma1_surface_Pa": origin.sigma1,
           "moment_x_m": float(plane.centres[origin.moment]), "trajectory": _shape(side.trajectory),
           "tension_depth_m": _tension_depth(side.trajectory, side.tension), "path": _shape(path.points),
           "K": path.steps, "K_I_max": max((step["K_I_max"] for step in path.steps), default=0.0),
           "stopped": path.why, "why": WHY[path.why]}
    if path.last:
        out["length_m"] = path.steps[-1]["length_m"]
        out |= _checked(plane, path, options, E_star)
    return out


def _shape(points):
    """Direction in which a path leans, and its chord angles (degrees to the surface)."""
    chords = {f"{depth * 1e6:g}": _chord(points, depth) for depth in DEPTHS}
    return {"lean": _lean(points[-1] - points[0]), "deepest_m": float(points.imag.max()), "chord_deg_at_um": chords}


def _lean(way):
    """Direction in which the way from the mouth to the tip leans."""
    if abs(way.real) <= STRAIGHT * way.imag:
        return "neither way"
    return "with rolling" if way.real < 0 else "against rolling"


def _chord(points, depth):
    """Angle between the surface and the line from the mouth to the first point at this depth; None if it stays above."""
    below = np.flatnonzero(points.imag >= depth)
    if below.size == 0:
        return None
    after = points[below[0]]
    before = points[max(below[0] - 1, 0)]
    part = (depth - before.imag) / max(after.imag - before.imag, 1e-30)
    across = (before + part * (after - before)).real - points[0].real
    return float(np.degrees(np.arctan2(depth, abs(across))))


def _tension_depth(points, tension):
    """Largest depth (m) at which the tension along the trajectory is at least SMALL of its largest value."""
    rest, deep = tension - SMALL * tension.max(), points.imag
    ends = np.flatnonzero(np.diff(rest >= 0))
    between = deep[ends] + (deep[ends + 1] - deep[ends]) * rest[ends] / (rest[ends] - rest[ends + 1])
    return float(max(deep[rest >= 0].max(), between.max(initial=0.0)))


def _checked(plane, path, options, E_star):
    """Errors of the stress intensities at the last length, number of moments that did not converge, and warnings."""
    finer = load_crack(plane, path.points, options, E_star, 2 * options.elements).K
    error, missed = _element_error(path.last.K, finer), sum(step["unsettled"] for step in path.steps)
    return {"error_at_last_length": error, "unsettled": missed,
            "doubts": list(_doubts(path, options, missed, max(error.values()), max(np.abs(finer).max(), 1e-30)))}


def _element_error(K, finer):
    """{name: Pa sqrt(m)}: change of the stress intensities (2, moments) with twice as many elements."""
    return {"K_I_max": float(abs(K[0].max() - finer[0].max())), "K_II_range": float(abs(np.ptp(K[1]) - np.ptp(finer[1])))}


def _doubts(path, options, missed, error, largest):
    """Generator of warnings about a path; missed: number of moments that did not converge; error, largest: of the stress
    intensities at the last length."""
    if error > CLEAR * largest:
        yield f"twice as many elements change the stress intensities by {error / largest:.0%}"
    if missed > CLEAR * len(path.steps) * path.last.K.shape[1]:
        yield f"{number_of(missed, 'moment')} did not converge between sticking and sliding"
    if path.points.size > 2 and path.points[2:].imag.min() < 2 * options.distance:
        yield "the crack is closer to the surface than twice `--distance`, at which its direction is found"
