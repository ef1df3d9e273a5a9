"""Findley index of the material points around the feature, over the whole passage.

The stress history of each point is gathered in the frame of the feature (which moves with body a), from a reader of
snapshots; Fi = max over planes of (tau_amp + kappa_F sigma_n,max) / sigma_eF [Everitt 2018, Eq 1.13].
"""

import math
from dataclasses import dataclass, field

import numpy as np

from tehl_taichi.kernels import findley
from tehl_taichi.post.half_space import SurfaceStress
from tehl_taichi.scene.scales import Scales

WINDOW = 0.6  # in a: beyond it the stress is that of the smooth line (the deviation falls as 1/r^2)
PLANE_STEP = 10.0  # degrees of the first plane grid; the refinement makes the result independent of it
NAMES = ("pressure", "traction_x_a", "traction_y_a")


@dataclass
class FatigueResult:
    """summary: the numbers of the worst point; maps: {name: (array, dims, units, text)} in the feature's frame."""

    summary: dict
    maps: dict = field(default_factory=dict)


def hemisphere(step_deg=PLANE_STEP):
    """Plane normals (theta from z, phi) about step_deg apart on a hemisphere; shape (planes, 2), radians."""
    out = []
    for theta in np.arange(0, 90 + 1e-9, step_deg):
        full = 180 if theta == 90 else 360
        count = max(1, round(full * math.sin(math.radians(theta)) / step_deg))
        out += [(math.radians(theta), math.radians(full * k / count)) for k in range(count)]
    return np.array(out)


def findley_stress(history, kappa, prune=True, step_deg=PLANE_STEP):
    """(points, 3): Findley stress (Pa), theta, phi for history (points, steps, 6) in the order xx yy zz xy xz yz."""
    points, steps = history.shape[:2]
    scratch = np.zeros((2, points, steps))
    out = np.zeros((points, 3))
    findley.search(np.ascontiguousarray(history), hemisphere(step_deg), scratch[0], scratch[1], float(kappa),
                   math.radians(step_deg) / 2, int(prune), out)
    return out


def gather(scene, reader, progress=None):
    """Stress histories around the feature: (x', y, history (nxw, nyw, steps, 6)); x' (m) from the feature's centre.

    Memory: nxw nyw steps 48 bytes, 28 MB for 257x65 nodes and 193 steps.
    """
    x, y = np.asarray(reader.x), np.asarray(reader.y)
    a = Scales.of(scene).a
    stress = SurfaceStress(x, y, scene.body_a.nu, scene.contact.kind == "line")
    dx = x[1] - x[0]
    reach = int(WINDOW * a / dx)
    # offsets that fall on grid nodes in the first entry: with whole-cell steps they then always do
    first = reader.feature_x(0)
    local = x[np.argmin(np.abs(x - first))] - first + np.arange(-reach, reach + 1) * dx
    rows = int(np.sum(y <= WINDOW * a + 1e-12))
    history = np.empty((local.size, rows, len(reader), 6))
    for n in range(len(reader)):
        f = reader.fields(n, NAMES)
        now = stress(*(np.asarray(f[name], float) for name in NAMES))
        for c in range(6):
            history[:, :, n, c] = sample(now[c][:, :rows], x, local + reader.feature_x(n))
        if progress:
            progress(n + 1, len(reader))
    return local, y[:rows], history


def sample(values, x, at):
    """Rows of values (nx+1, ...) at positions `at`: exact on nodes, linear between, the end value beyond."""
    s = np.clip((at - x[0]) / (x[1] - x[0]), 0, x.size - 1)
    near = np.rint(s)
    s = np.where(np.abs(s - near) < 1e-6, near, s)
    i = np.minimum(s.astype(int), x.size - 2)
    w = (s - i)[:, None]
    return (1 - w) * values[i] + w * values[i + 1]


def run(scene, reader, progress=None):
    """FatigueResult of a passage. reader: x, y, feature_x(n), fields(n, names), len(); see gather for its memory."""
    local, y, history = gather(scene, reader, progress)
    shape = history.shape[:2]
    found = findley_stress(history.reshape(-1, *history.shape[2:]), scene.fatigue.kappa).reshape(*shape, 3)
    i, j = np.unravel_index(int(np.argmax(found[..., 0])), shape)
    stress, theta, phi = found[i, j]
    angle = plane_angle(theta)
    summary = {"Fi_max": stress / scene.fatigue.endurance, "findley_stress_max_Pa": stress, "x_m": local[i],
               "y_m": y[j], "plane_theta_deg": math.degrees(theta), "plane_phi_deg": math.degrees(phi),
               "surface_angle_deg": angle, "sigma1_max_Pa": largest_principal(history),
               "kappa_F": scene.fatigue.kappa, "sigma_eF_Pa": scene.fatigue.endurance}
    return FatigueResult({key: float(value) for key, value in summary.items()}, _maps(scene, local, y, found))


def plane_angle(theta):
    """Angle (deg, 0..90) between the plane with its normal at theta from z and the surface."""
    angle = math.degrees(theta) % 180
    return min(angle, 180 - angle)


def largest_principal(history):
    """Largest principal stress over all points and steps (Pa)."""
    top = -math.inf
    for part in np.array_split(history.reshape(-1, 6), max(1, history.size // 600000)):
        s = np.empty((len(part), 3, 3))
        for c, (i, j) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))):
            s[:, i, j] = s[:, j, i] = part[:, c]
        top = max(top, float(np.linalg.eigvalsh(s)[:, -1].max()))
    return top


def _maps(scene, local, y, found):
    dims = ["feature_frame_x", "feature_frame_y"]
    return {"feature_frame_x": (local, dims[:1], "m", "from the feature's centre, along rolling"),
            "feature_frame_y": (y, dims[1:], "m", "from the feature's centre, across"),
            "findley_stress": (found[..., 0], dims, "Pa", "Findley stress tau_amp + kappa_F sigma_n,max"),
            "Fi": (found[..., 0] / scene.fatigue.endurance, dims, "1", "Findley index"),
            "plane_theta": (np.degrees(found[..., 1]), dims, "degree", "critical plane normal from z"),
            "plane_phi": (np.degrees(found[..., 2]), dims, "degree", "critical plane normal about z, from x")}
