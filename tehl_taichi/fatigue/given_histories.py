"""Fatigue of given stress histories: from a finite element model, a strain gauge, another contact program."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue import findley
from tehl_taichi.scene import SceneError
from tehl_taichi.values.arrays import floats
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.quantity import Number

LARGEST = Number("", "Pa", -1e12, 1e12, usual=4e8, least=1e5)


@dataclass(frozen=True, eq=False)
class Points:
    """Fatigue of given stress histories: the result of :func:`tehl_taichi.fatigue` for an array.

    Attributes
    ----------
    f : array (points,)
        Largest value of the criterion, Pa.
    normals : array (points, 3)
        Unit normals of the critical planes, n_z >= 0; nan if no plane is ever sheared or pulled.
    limit : float
        Value of the criterion at which the index is 1, Pa.
    """

    f: np.ndarray
    normals: np.ndarray
    limit: float

    def __repr__(self):
        return f"<tehl.Points: {number_of(self.f.size, 'point')}, Fi_max {self.Fi.max():.3g} at point {self.worst}>"

    @property
    def Fi(self):
        """Index (points,)."""
        return self.f / self.limit

    @property
    def theta(self):
        """Angles (points,) between the critical plane and the surface (the plane z = 0), degrees."""
        return findley.angles(self.normals)[0]

    @property
    def phi(self):
        """Angles (points,) from x to the surface direction of the critical plane's normal, degrees."""
        return findley.angles(self.normals)[1]

    @property
    def worst(self):
        """Number of the point with the largest f."""
        return int(np.argmax(self.f))


def are_stresses(of):
    """Whether `of` is an array or a list of numbers (not a run, a reader or snapshots)."""
    if isinstance(of, (list, tuple)):
        return bool(of) and not hasattr(of[0], "fields")
    return hasattr(of, "__array__")


def _check(stresses):
    """Refuse another shape, values that are no finite stresses, and ones too small or too large for Pa: any contact load causes
    some MPa. Raises SceneError.
    """
    if stresses.ndim != 3 or stresses.shape[2] != 6 or not stresses.size:
        raise SceneError(f"given stresses have the shape {stresses.shape}; allowed: (points, times, 6) or (times, 6), with one "
                         "point and one time at least")
    if lost := int((~np.isfinite(stresses)).sum()):
        raise SceneError(f"{lost} of the {stresses.size} given stresses are masked, nan or infinite; allowed: finite numbers "
                         "in Pa")
    LARGEST.check("the largest of the given stresses", float(stresses.flat[np.argmax(np.abs(stresses))]))


def search(stresses, constants):
    """Search stresses (points, times, 6) or (times, 6), Pa; return the :class:`Points`.

    constants: a scene's :class:`tehl_taichi.scene.sections.Fatigue`. Raises SceneError for another shape or for values that are
    no numbers.
    """
    stresses = floats("given stresses", stresses, "an array of real numbers in Pa")
    stresses = stresses[None] if stresses.ndim == 2 else stresses
    _check(stresses)
    f, normals = findley.search(stresses, constants.kappa, criterion=constants.criterion)
    nowhere = ~(np.isfinite(f) & np.isfinite(normals).all(axis=1))  # no plane of it is ever sheared or pulled
    return Points(np.where(nowhere, 0.0, f), np.where(nowhere[:, None], np.nan, normals), constants.endurance)
