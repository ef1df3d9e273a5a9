"""Search of the plane with the largest value of a criterion, as Findley's f = tau_amp + kappa * sigma_n,max."""

import dataclasses
import functools
import math

import numpy as np

from tehl_taichi.engine.pointwise import unrolled
from tehl_taichi.laws.criteria import CRITERIA

GRID = 10.0  # degrees between the first planes of a search
# halvings of the step of 5 degrees: to 2e-5 rad, error of a smooth maximum about 1e-9. If the shear alone chooses the plane,
# the value has no maximum there, so its error is of the order of the angle and needs more halvings
SHRINKS, SHEARED_SHRINKS = 12, 22
TURN = 0.2763932022500210  # rad from one pattern of a search to the next
NEAR = 0.85  # share of the largest value on the first planes: points below it cannot be the worst (these planes are 3 % low)
SLICE = 1000  # points of one launch, after which progress is reported: 0.7 s for 411 moments on one thread


@functools.cache
def planes(degrees=GRID):
    """Unit normals (m, 3), about evenly spread over the upper hemisphere; m = 211 at 10 degrees. Read-only."""
    rows = []
    count = round(90 / degrees)
    for i in range(count + 1):
        theta = math.pi / 2 * i / count
        m = max(1, math.ceil(4 * count * math.sin(theta) * (0.5 if i == count else 1) - 1e-9))
        phi = (math.pi if i == count else 2 * math.pi) * np.arange(m) / m
        rows.append(np.stack([math.sin(theta) * np.cos(phi), math.sin(theta) * np.sin(phi),
                              np.full(m, math.cos(theta))], axis=1))
    found = np.concatenate(rows)
    found.setflags(write=False)
    return found


@functools.cache
def rings():
    """(cosine, sine) of the directions of the eight planes of each pattern of a search, (patterns, 8, 2). Read-only.

    Each pattern is turned from the one before. Computed in the kernel they take a quarter of a search.
    """
    from tehl_taichi.fatigue import critical_planes

    found = np.empty((max(SHRINKS, SHEARED_SHRINKS) * critical_planes.MOVES, critical_planes.LANES, 2))
    turn, apart = 0.0, 2 * math.pi / critical_planes.LANES
    for ring in found:
        ring[:] = [(math.cos(turn + k * apart), math.sin(turn + k * apart)) for k in range(len(ring))]
        turn += TURN
    found.setflags(write=False)
    return found


@functools.cache
def traced(criterion):
    """The criterion with a value function that kernels can trace."""
    return dataclasses.replace(criterion, value=unrolled(criterion.value))


def search(history, kappa, prune=True, criterion="findley", degrees=GRID, decided=None, notify=None, known=None,
           worst=False, needed=False):
    """Find the largest value of a criterion over all planes, and its plane, at every point.

    history: (points, times, 6) Pa: xx, yy, zz, xy, xz, yz. kappa: sensitivity of the criterion, >= 0. criterion: a name in
    `tehl_taichi.laws.criteria`. prune=False: every plane is evaluated (for tests). degrees: angle between the first planes.
    decided: (points,) array that takes the number of planes bounded or evaluated. notify: called with (done, total) points.
    known: (f, normals) of a search of histories of which these are some moments; a plane is kept if these moments reach the
    value there. worst: search only points near the worst and those that are `needed`, (points,) bool; the others get the value
    of the best first plane and the normal nan.

    Returns f (points,) Pa (negative where pressure outweighs the shear) and unit normals (points, 3) with n_z >= 0.
    Raises ValueError for a history with NaN or of another shape, KeyError for an unknown criterion.
    """
    from tehl_taichi.engine import runtime

    runtime.ensure()
    history = np.ascontiguousarray(history, float)
    if history.ndim != 3 or history.shape[2] != 6 or not np.isfinite(history).all():
        raise ValueError(f"a stress history must be finite and shaped (points, times, 6), not {history.shape}")
    rule, before = CRITERIA[criterion], np.full((len(history), 4), np.inf)
    if known is not None and rule.falls:
        before[:, 0], before[:, 1:] = known
        before[np.isnan(before).any(axis=1)] = np.inf
    found = functools.partial(_found, kappa=kappa, prune=prune, rule=rule, degrees=degrees)
    if worst and not rule.sheared:
        needed = np.zeros(len(history), bool) | needed
        out = found(history, before, least=np.where(needed, -np.inf, np.inf), notify=notify)
        top = out[:, 0].max(initial=-np.inf)
        some = (out[:, 0] >= top - (1 - NEAR) * abs(top)) & ~needed
        out[~(some | needed), 1:4] = np.nan
        out[some] = found(history[some], before[some])
    else:
        out = found(history, before, notify=notify)
    if decided is not None:
        decided[:] = out[:, 4]
    n = out[:, 1:4]
    if rule.sheared:
        mean = history[:, :, :3].mean(axis=2).max(axis=1)
        out[:, 0] = rule.value(out[:, 0], normal_stress(history, n).max(axis=1), mean, kappa)
    return out[:, 0], np.where(n[:, 2:] < 0, -n, n)


def _found(history, before, kappa, prune, rule, degrees, least=None, notify=None):
    """(points, 5): value (Pa), plane, number of planes bounded or evaluated; before, least: `known`, `least` of
    :func:`tehl_taichi.fatigue.critical_planes.search`."""
    from tehl_taichi.fatigue import critical_planes

    points, steps, _ = history.shape
    least = np.full(points, -np.inf) if least is None else least
    out, grid, most = np.zeros((points, 5)), planes(degrees), min(points, SLICE)
    scratch = [np.empty((most, *size)) for size in ((len(grid),), (steps,), (steps,),
                                                    (critical_planes.SHEARED_STARTS, critical_planes.PEAK))]
    scratch.append(np.empty((most, steps), np.int32))
    shrinks, weight = (SHEARED_SHRINKS, 0.0) if rule.sheared else (SHRINKS, kappa)
    for first in range(0, points, SLICE):
        part = slice(first, min(first + SLICE, points))
        critical_planes.search(part.stop - first, steps, weight, traced(rule), math.radians(degrees / 2), shrinks, int(prune),
                               least[part], before[part], history[part], grid, rings(),
                               *(one[: part.stop - first] for one in scratch), out[part])
        if notify:
            notify(part.stop, points)
    return out


def prepare(criterion):
    """Compile the kernel of the search, or load it from the cache, which takes about a second."""
    search(np.zeros((1, 2, 6)), 0.0, criterion=criterion)


def normal_stress(history, normals):
    """Normal stress (points, times) Pa of a history (points, times, 6) Pa on planes with these normals (points, 3)."""
    x, y, z = normals.T
    weights = np.stack([x * x, y * y, z * z, 2 * x * y, 2 * x * z, 2 * y * z], axis=-1)
    return np.einsum("ptc,pc->pt", history, weights)


def shear_path(history, normal):
    """Stresses on one plane at one point: (shear along the dip, shear along the strike, normal stress), each (times,) Pa.

    history: (times, 6) Pa; normal: (3,) with n_z >= 0.
    """
    xx, yy, zz, xy, xz, yz = history.T
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    vector = np.einsum("ijt,j->it", tensor, normal)
    strike = np.cross([0.0, 0.0, 1.0], normal)
    strike = strike / np.linalg.norm(strike) if np.linalg.norm(strike) > 1e-9 else np.array([0.0, 1.0, 0.0])
    return np.cross(strike, normal) @ vector, strike @ vector, normal @ vector


def smallest_circle(u, v):
    """(centre u, centre v, radius) of the smallest circle around the points (u, v), each (times,)."""
    from tehl_taichi.engine import runtime
    from tehl_taichi.fatigue import critical_planes

    runtime.ensure()
    out = np.zeros(3)
    critical_planes.circle(u.size, np.array([u]), np.array([v]), out)
    return out


def angles(normals):
    """(theta, phi) of unit normals (points, 3), each (points,) degrees.

    theta: from z (into the body) to the normal, which is also the angle between plane and surface. phi: from x to the normal's
    direction in the surface.
    """
    theta = np.degrees(np.arccos(np.clip(normals[:, 2], 0.0, 1.0)))
    return theta, np.degrees(np.arctan2(normals[:, 1], normals[:, 0]))


def largest_principal(S):
    """Largest principal stress (...) of stresses S (..., 6): xx, yy, zz, xy, xz, yz (trigonometric root of the cubic)."""
    xx, yy, zz, xy, xz, yz = np.moveaxis(S, -1, 0)
    mean = (xx + yy + zz) / 3
    dx, dy, dz = xx - mean, yy - mean, zz - mean
    j2 = 0.5 * (dx * dx + dy * dy + dz * dz) + xy * xy + xz * xz + yz * yz
    j3 = dx * (dy * dz - yz * yz) - xy * (xy * dz - yz * xz) + xz * (xy * yz - dy * xz)
    radius = np.sqrt(j2 / 3)
    ratio = np.divide(j3, 2 * radius**3, out=np.ones_like(j3), where=radius > 0)
    return mean + 2 * radius * np.cos(np.arccos(np.clip(ratio, -1, 1)) / 3)
