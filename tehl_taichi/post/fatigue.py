"""Fatigue of the surface around a feature: stress histories of material points of body a, Findley index.

Material points keep their place in the frame of the feature, x' = x - x_a(t). Before the first and after the last
snapshot (feature outside the contact) they move through the steady field, so every history begins and ends unloaded.
"""

import itertools
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from tehl_taichi.post import findley
from tehl_taichi.post.half_space import COMPONENTS, SurfaceStress
from tehl_taichi.scene import SceneError
from tehl_taichi.scene.scales import Scales

WINDOW = 0.6       # half width (in a) of the part searched around one small feature: farther out its stress has died out
MARGIN = 0.3       # (in a) searched beyond the rim of larger features
LOADED = 1.5       # material points are followed while within this distance (in a) of the centre of the contact
BLOCK_BYTES = 4e8  # histories held at once; more points than fit are done in blocks of y rows
WORKERS = 4         # threads of the history pass (transforms run outside the interpreter's lock)
NAMES = ("pressure", "traction_x_a", "traction_y_a")


@dataclass(frozen=True)
class FatigueResult:
    """summary: numbers in SI; maps: name -> (values, dimensions, units, text), in the frame of the feature."""

    summary: dict
    maps: dict


class Snapshots:
    """A list of snapshots (all of one grid) as the reader that :func:`run` wants."""

    def __init__(self, snapshots):
        self.items = list(snapshots)
        self.x, self.y = self.items[0].x, self.items[0].y
        self.time = np.array([s.time for s in self.items])

    def __len__(self):
        return len(self.items)

    def feature_x(self, n):
        """Centre of the feature (m) at entry n."""
        return self.items[n].feature_x

    def fields(self, n, names):
        """{name: (nx+1, ny+1) array} of entry n."""
        return {name: self.items[n].fields[name] for name in names}


def run(scene, reader, progress=None):
    """Findley index of the surface points of body a within 0.6 a of the first feature (0.3 a beyond larger ones), over its
    whole passage.

    reader: x, y (m), len, feature_x(n) (m), fields(n, names) in Pa; or a list of snapshots. Entry 0 is the steady
    start. progress: called with (done, total) entries. Isothermal stresses; on the rows of the reader (where they begin
    with y = 0, the others are its mirror).
    Raises SceneError when no feature passes.
    """
    reader = Snapshots(reader) if isinstance(reader, (list, tuple)) else reader
    centres = np.array([reader.feature_x(n) for n in range(len(reader))])
    if len(reader) < 2 or not np.isfinite(centres).all():
        raise SceneError("fatigue needs the passage of a feature: a scene with a feature and at least one time step")
    passage = Passage(scene, reader, centres)
    found = [passage.block(rows, progress) for rows in passage.row_blocks()]
    return _result(scene, passage, *(np.concatenate(part, axis=1) for part in zip(*found)))


class Passage:
    """The window of material points and where they are at every moment."""

    def __init__(self, scene, reader, centres):
        self.scene, self.reader = scene, reader
        self.a = Scales.of(scene).a
        self.dx = float(reader.x[-1] - reader.x[0]) / (reader.x.size - 1)
        low, high = (max(1, int(side / self.dx + 1e-9)) for side in self._window("x"))
        # material points on nodes of the grid at entry 0: steps of whole cells then need no interpolation
        offset = (reader.x[0] - centres[0]) / self.dx
        self.x = (np.arange(-low, high + 1) + offset - round(offset)) * self.dx
        low, high = self._window("y")
        self.rows = np.flatnonzero((reader.y >= -low * (1 + 1e-9)) & (reader.y <= high * (1 + 1e-9)))
        self.y = reader.y[self.rows]
        # centre of the feature and entry of the reader at every moment
        before, after = self._lead_in(centres[0]), self._lead_out(centres[-1])
        self.centres = np.concatenate([before, centres, after])
        self.entries = np.concatenate([0 * before, np.arange(len(centres)), 0 * after]).astype(int)
        self._widen()

    def _window(self, axis):
        """Distances (m) searched on the negative and the positive side of the first feature's centre."""
        reach = [(getattr(f, axis), f.reach if axis == "x" else f.reach_y) for f in self.scene.features]
        sides = (max(sign * at + r for at, r in reach) + MARGIN * self.a for sign in (-1, 1))
        return [max(WINDOW * self.a, side) for side in sides]

    def _lead_in(self, first):
        if first > -self.a:
            return np.zeros(0)
        steps = int(np.ceil((first + self.x[-1] + LOADED * self.a) / self.dx))
        return first - np.arange(max(steps, 0), 0, -1) * self.dx

    def _lead_out(self, last):
        if last < self.a:
            return np.zeros(0)
        steps = int(np.ceil((LOADED * self.a - last - self.x[0]) / self.dx))
        return last + np.arange(1, max(steps, 0) + 1) * self.dx

    def _widen(self):
        """Unloaded columns on both sides, so that no material point leaves the grid."""
        x0, x1 = self.reader.x[0], self.reader.x[-1]
        low, high = self.centres.min() + self.x[0], self.centres.max() + self.x[-1]
        self.pad = tuple(max(0, int(np.ceil(gap / self.dx)) + 2) for gap in (x0 - low, high - x1))
        self.grid_x = x0 + (np.arange(self.reader.x.size + sum(self.pad)) - self.pad[0]) * self.dx
        line, y = self.scene.contact.kind == "line", self.reader.y
        # a line contact is mirrored about its first row, in the plane of symmetry or (whole domain) far away
        self.stress = SurfaceStress(self.grid_x, y - y[0], self.scene.body_a.nu, line, mirrored=line or y[0] == 0)

    def row_blocks(self):
        """Slices of y rows whose histories fit into BLOCK_BYTES."""
        row_bytes = 8.0 * self.x.size * (self.centres.size + 1) * (len(COMPONENTS) + 2)
        rows = max(1, int(BLOCK_BYTES / row_bytes))
        return [slice(j, min(j + rows, self.y.size)) for j in range(0, self.y.size, rows)]

    def block(self, rows, progress):
        """Findley stress, theta, phi, largest principal stress, each (nx, rows)."""
        shape = self.x.size, rows.stop - rows.start
        history = self.history(rows, progress)
        f, normals = findley.search(history, self.scene.fatigue.kappa)
        sigma1 = np.array([findley.largest_principal(part).max() for part in history])
        return [v.reshape(shape) for v in (f, *findley.angles(normals), sigma1)]

    def history(self, rows, progress=None):
        """(points, times + 1, 6) Pa; points run over x', then rows; the last moment is the unloaded state."""
        shape = self.x.size, rows.stop - rows.start
        out = np.zeros((*shape, self.centres.size + 1, len(COMPONENTS)))
        done = itertools.count(1)
        entries = np.unique(self.entries)
        parts = np.array_split(entries, min(WORKERS, entries.size))
        with ThreadPoolExecutor(WORKERS) as pool:
            tasks = [pool.submit(self._fill, out, part, rows, self.stress.twin()) for part in parts]
            for task in tasks:
                task.result()
                if progress:
                    progress(next(done), len(tasks))
        return out.reshape(-1, *out.shape[2:])

    def _fill(self, out, entries, rows, stress):
        """The moments that belong to these entries of the reader."""
        for entry in entries:
            fields = self._surface(entry, rows, stress)
            for t in np.flatnonzero(self.entries == entry):
                start = (self.centres[t] + self.x[0] - self.grid_x[0]) / self.dx
                out[:, :, t] = _shifted(fields, start, self.x.size)

    def _surface(self, entry, rows, operator):
        loads = self.reader.fields(int(entry), NAMES)
        loads = [np.pad(np.asarray(loads[name], float), (self.pad, (0, 0))) for name in NAMES]
        stress = operator(*loads)
        return np.stack([stress[name][:, self.rows[rows]] for name in COMPONENTS], axis=-1)


def _shifted(fields, start, count):
    """`count` columns of fields (x, y, 6) from column `start`; exact for whole numbers, else linear in x."""
    whole = int(np.round(start))
    if abs(start - whole) < 1e-6:
        return fields[whole: whole + count]
    whole = int(np.floor(start))
    part = start - whole
    return (1 - part) * fields[whole: whole + count] + part * fields[whole + 1: whole + 1 + count]


def _result(scene, passage, f, theta, phi, sigma1):
    limit = scene.fatigue.endurance
    i, j = np.unravel_index(np.argmax(f), f.shape)
    summary = {"Fi_max": f[i, j] / limit, "findley_stress_max_Pa": f[i, j], "x_m": passage.x[i], "y_m": passage.y[j],
               "plane_theta_deg": theta[i, j], "plane_phi_deg": phi[i, j], "surface_angle_deg": theta[i, j],
               "sigma1_max_Pa": sigma1.max(), "kappa_F": scene.fatigue.kappa, "sigma_eF_Pa": limit}
    both = ["feature_frame_x", "feature_frame_y"]
    maps = {both[0]: (passage.x, both[:1], "m", "along rolling, from the centre of the feature"),
            both[1]: (passage.y, both[1:], "m", "across, from the centre of the contact"),
            "findley_stress": (f, both, "Pa", "Findley stress"), "Fi": (f / limit, both, "1", "Findley index"),
            "plane_theta": (theta, both, "degree", "angle of the critical plane's normal from the surface normal"),
            "plane_phi": (phi, both, "degree", "direction of the critical plane's normal in the surface, from x")}
    return FatigueResult({key: float(value) for key, value in summary.items()}, maps)
