"""Growth of a crack, piece by piece, in the direction of the largest tension around its tip over the whole passage.

The criterion is the largest sigma_theta at a distance ahead of the tip, in the body with the crack (Erdogan & Sih 1963, at a
finite distance): a short crack follows the trajectory, a long one the stress intensities. The largest k_1 of a vanishing kink
is no criterion here: a closed crack under pressure has no kink that stays open.
"""

from dataclasses import dataclass, field

import numpy as np

from tehl_taichi.crack.compliance import CrackFaces
from tehl_taichi.crack.fillings import FILLINGS
from tehl_taichi.crack.fluid_filled import FluidFilledCrack
from tehl_taichi.values.digits import number_of

WIDEST, FAN = np.radians(75.0), 51  # directions looked at: up to there on both sides
WHY = {"length": "it has reached the given length", "threshold": "K_I stays below the threshold",
       "closed": "its tip never opens", "window": "it leaves the region of computed stresses",
       "surface": "it reaches the surface"}


@dataclass
class LoadedCrack:
    """A crack loaded by the passage: faces, nodal values, K (2, moments) in Pa sqrt(m), share of the length that touches
    (moments,), unsettled moments, oil pressure at the tip (moments,) Pa, and film pressure at the mouth.
    """

    faces: CrackFaces
    values: np.ndarray
    K: np.ndarray
    touching: np.ndarray
    missed: int
    pressure: np.ndarray
    mouth: np.ndarray

    def __repr__(self):
        return f"<Loaded crack: {number_of(self.K.shape[1], 'moment')}, K_I to {self.K[0].max():.3g} Pa sqrt(m)>"


@dataclass
class CrackPath:
    """Path of a crack. points: (m, complex); steps: one dict per length with K_I_max, K_II_range (Pa sqrt(m)) and their
    moments; why: reason of the end (a key of WHY); first, last: :class:`LoadedCrack` at the first and last length.
    """

    points: np.ndarray
    steps: list = field(default_factory=list)
    why: str = "length"
    first: LoadedCrack | None = None
    last: LoadedCrack | None = None

    def __repr__(self):
        return f"<Path of {number_of(self.points.size, 'point')}, stopped by {self.why}>"


def load_crack(plane, points, options, E_star, elements=None):
    """Load a crack along `points` (all within the plane). Returns a :class:`LoadedCrack`."""
    elements = elements or options.elements
    faces = CrackFaces(points, E_star, elements)
    mouth = np.maximum(0.0, -plane.at(points[:1])[0, :, 1])
    wet = FluidFilledCrack(faces, faces.forces(plane.at(faces.points)), mouth, options.oil_share, plane.times,
                           options.face_friction,
              plane.fluid, elements)
    inside = FILLINGS[options.filling].inside(wet)
    touching, K = (inside.held > 0).mean(axis=0), faces.intensities(inside.values)
    return LoadedCrack(faces, inside.values, K, touching, inside.missed, inside.pressure, mouth)


def grow(plane, origin, options, E_star):
    """Grow a crack from a :class:`tehl_taichi.crack.trajectory.CrackStart`. Returns its :class:`CrackPath`."""
    first = options.first * np.exp(1j * np.radians(options.angle))
    path = CrackPath(np.array([origin.x, origin.x + first]))
    while not _load_newest(plane, path, options, E_star):
        z, tip = path.points, path.points[-1]
        da = min(options.step, options.length - path.steps[-1]["length_m"])
        path.points = np.append(z, tip + da * _growth_direction(plane, path.last, tip, tip - z[-2], options))
    return path


def _load_newest(plane, path, options, E_star):
    """Load the crack at its newest length. Returns True, and stores the reason, if it stops growing."""
    tip, before = path.points[-1], path.points[-2]
    rising = tip.imag < before.imag and tip.imag <= options.distance  # what is left above it is a flake that breaks off
    if rising or not plane.holds(tip):
        path.why, path.points = "surface" if rising else "window", path.points[:-1]
        return True
    path.last = load_crack(plane, path.points, options, E_star)
    path.first = path.first or path.last
    path.steps.append(_step_numbers(plane, path.last))
    step = path.steps[-1]
    reasons = {"closed": step["K_I_max"] == 0, "threshold": step["K_I_max"] < (options.threshold or 0.0),
               "length": step["length_m"] >= options.length * (1 - 1e-9)}
    path.why = next((why for why, so in reasons.items() if so), path.why)
    return any(reasons.values())


def _step_numbers(plane, crack):
    K_I, K_II = crack.K
    top = int(np.argmax(K_I))
    return {"length_m": float(crack.faces.a), "K_I_max": float(K_I[top]), "K_II_there": float(K_II[top]),
            "K_II_range": float(np.ptp(K_II)), "feature_x_m": float(plane.centres[top]),
            "oil_at_tip_Pa": float(crack.pressure.max()), "unsettled": int(crack.missed)}


def _growth_direction(plane, crack, tip, last, options):
    """Unit direction of the largest tension at `options.distance` from the tip, over the passage."""
    turns = np.linspace(-WIDEST, WIDEST, FAN)
    directions = last / abs(last) * np.exp(1j * turns)
    at = tip + options.distance * directions
    inside = plane.holds(at)
    tension = np.full((FAN, crack.K.shape[1]), -np.inf)
    tension[inside] = _tension_across(plane, crack, at[inside], directions[inside])
    n, moment = np.unravel_index(int(np.argmax(tension)), tension.shape)
    turn = turns[n] + _parabola_top(tension[:, moment], n) * (turns[1] - turns[0])
    return last / abs(last) * np.exp(1j * turn)


def _tension_across(plane, crack, at, directions):
    """Tension across the directions in the body with the crack, plus the oil pressure that would follow: (points, moments)."""
    own = np.einsum("cpk,km->pmc", crack.faces.around(at), crack.values)
    xx, zz, xz = np.moveaxis(plane.at(at) + own, -1, 0)
    n = 1j * directions[:, None]
    return xx * n.real**2 + zz * n.imag**2 + 2 * xz * n.real * n.imag + crack.pressure


def _parabola_top(values, n):
    """Position (n - 1/2 to n + 1/2) of the maximum of the parabola through the largest value and its two neighbours."""
    if not 0 < n < values.size - 1 or not np.isfinite(values[n - 1 : n + 2]).all():
        return 0.0
    bend = values[n - 1] - 2 * values[n] + values[n + 1]
    return 0.5 * (values[n - 1] - values[n + 1]) / bend if bend < 0 else 0.0
