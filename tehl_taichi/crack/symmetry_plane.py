"""Stresses of a body in its plane of symmetry over the whole passage: a table over x', depth and moments."""

import copy
from typing import Any

import numpy as np

from tehl_taichi.crack.filling import Fluid
from tehl_taichi.crack.residual_stress import ResidualStress
from tehl_taichi.errors import SceneError
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.stress.row_histories import histories_of
from tehl_taichi.values.interpolation import lagrange

WINDOW = 1.3    # a: half width of the table; a path of 100 um turns out to half of that
SKIN = 0.05     # of the feature's half width (or of a, if that is less): depths are even below it, and grow beyond
GROWTH = 1.3    # of the steps between depths
DEEPEST = 1.0   # a
KEPT = (0, 2, 4)  # xx, zz, xz
WITHOUT_RESIDUAL = {"fatigue.residual_xx": 0.0, "fatigue.table": "", "fatigue.table_b": ""}  # changes of a scene


class SymmetryPlane:
    """Stresses in the plane of symmetry.

    x: (x',) m, even; depths: skin (GROWTH^n - 1) m; centres: positions of the feature (m) at every moment, nan for the last,
    unloaded one; stress: (x', depths, moments, 3) Pa: xx, zz, xz with residual stress; a: m; reach: half width of the feature,
    m; times: of the moments, s; fluid: :class:`tehl_taichi.crack.filling.Fluid` (times and fluid are needed for oil that
    flows); surface: the :class:`tehl_taichi.scene.moving_surfaces.MovingSurface` below which the points lie.
    """

    def __init__(self, x, skin, stress, centres, a, reach, residual=None, times=None, fluid=None, surface=None):
        self.surface = surface
        self.x, self.skin, self.stress, self.centres, self.a, self.reach = x, skin, stress, centres, a, reach
        self.depths = skin * (GROWTH ** np.arange(stress.shape[1]) - 1)
        self.residual, self.scale, self.times, self.fluid = residual, float(np.abs(stress).max()), times, fluid

    def having(self, residual):
        """Copy of the plane with this residual stress (Pa, or rows of depth and Pa); None: unchanged."""
        if residual is None:
            return self
        other = copy.copy(self)
        other.residual = ResidualStress(residual)
        return other

    @property
    def distance(self):
        """Distance (m) of every x' from the feature's centre, (x', moments); x' itself on the surface that carries the
        feature.
        """
        slide = self.surface.pace - 1 if self.surface else 0.0
        return self.x[:, None] + slide * self.centres

    def holds(self, points):
        """Whether the table covers the points x + i depth (m): (points,)."""
        points = np.asarray(points)
        return (points.real >= self.x[0]) & (points.real <= self.x[-1]) & (points.imag >= 0) & (points.imag <= self.depths[-1])

    def at(self, points, moments=slice(None)):
        """Stresses (points, moments, 3), Pa, at x + i depth within the table, by cubic interpolation."""
        points = np.asarray(points)
        i, along = _cubic((points.real - self.x[0]) / (self.x[1] - self.x[0]), self.x.size)
        j, down = _cubic(np.log1p(points.imag / self.skin) / np.log(GROWTH), self.depths.size)
        table = self.stress[:, :, moments]
        found: Any = sum((along[p] * down[q])[:, None, None] * table[i + p, j + q] for p in range(4) for q in range(4))
        if self.residual:
            found[..., 0] += self.residual(points.imag)[:, None]
        return found

    def sigma1(self):
        """Largest principal stress in the plane over the passage: (x', depths)."""
        found = principal(self.stress)[0]
        return found.max(axis=2) + (self.residual(self.depths) if self.residual else 0.0)


def _cubic(at, count):
    """First of four nodes and their cubic weights (4, points) for positions `at`, in nodes."""
    first = np.clip(np.floor(at).astype(int) - 1, 0, count - 4)
    return first, np.array(lagrange(range(4), at - first))


def principal(stress):
    """Largest principal stress, and the angle of its direction from x to depth, of stresses (..., 3)."""
    xx, zz, xz = np.moveaxis(stress, -1, 0)
    return (xx + zz) / 2 + np.hypot((xx - zz) / 2, xz), 0.5 * np.arctan2(2 * xz, xx - zz)


def plane_of(scene, reader, residual=None, check=None, surface=None):
    """Build the :class:`SymmetryPlane` of a surface of a stored passage (None: the surface of the first feature).

    reader: see :class:`tehl_taichi.fatigue.stress.histories.StressHistories`. residual: Pa or (depth, Pa) rows, in place of the
    scene's fatigue.residual_xx and tables. check(x', deepest): called with the extent (m) before any stress is computed. Raises
    SceneError if the run has no passage, if y = 0 is no plane of symmetry, or if a stress is no number.
    """
    feature, centres = first_feature_path(scene, reader)
    scene = scene if residual is None else scene.replace(**WITHOUT_RESIDUAL)
    passage = StressHistories(scene, reader, centres, WINDOW, surface)
    skin = SKIN * min(feature.reach, passage.a)
    count = int(np.ceil(np.log1p(DEEPEST * passage.a / skin) / np.log(GROWTH))) + 1
    depths = skin * (GROWTH ** np.arange(count) - 1)
    # x' = 0 is the feature's centre, on the other surface the place that this centre meets at X = 0
    x = passage.x - passage.surface.pace * feature.x
    if check:
        check(x, depths[-1])
    stress = histories_of(passage, depths, [(0, False)])[0][..., KEPT].swapaxes(0, 1)
    if not np.isfinite(stress).all():
        raise SceneError("some stored tractions are not numbers, so the stresses are not known")
    times, centres = passage.centres / passage.surface.speed, np.append(passage.positions + feature.x, np.nan)
    times = np.append(times, 2 * times[-1] - times[0])  # unloaded as long after
    return SymmetryPlane(x, skin, np.ascontiguousarray(stress), centres, passage.a, feature.reach, None, times,
                         Fluid.of(scene), passage.surface).having(residual)


def first_feature_path(scene, reader):
    """First feature, and its position without feature.x (m) at every entry. Raises SceneError, see :func:`plane_of`."""
    centres = np.array([reader.feature_x(n) for n in range(len(reader))])
    if len(reader) < 2 or not np.isfinite(centres).all():
        raise SceneError("a crack needs the passage of a feature: a scene with a feature and at least one time step")
    feature = scene.features[0]
    if reader.y[0] < 0 or any(not one.symmetric for one in scene.features):
        raise SceneError(f"y = 0 is not a plane of symmetry of this scene (feature.y = {feature.y:g} m, or a surface that is "
                         "not even in y), so a crack would leave it; allowed: features on y = 0 that are even in y")
    return feature, centres
