"""Fillings of a crack, one file each: a new file here is a new choice of `--oil`.

A filling receives a :class:`tehl_taichi.crack.fluid_filled.FluidFilledCrack` and returns its
:class:`tehl_taichi.crack.fluid_filled.FluidState`. It may import the same rooms as `crack`.
"""

import sys

import numpy as np

from tehl_taichi.crack.compliance import CrackFaces
from tehl_taichi.crack.filling import Filling, Fluid
from tehl_taichi.crack.fluid_filled import FluidFilledCrack
from tehl_taichi.values.registry import collect

THIN = Fluid(lambda p: 1.0 + 0.0 * p, lambda p: 1.0 + 0.0 * p)


def check_value(filling, mouth):
    """Check value: factor F_I of a crack of unit length normal to the surface, under unit tension and this pressure at its
    mouth, at the end of a long time.
    """
    faces, pull = CrackFaces(np.array([0, 1j]), 1.0, 12), np.array([1.0, 0.0, 0.0])
    forces = faces.forces(np.tile(pull, (faces.points.size, 3, 1)))
    inside = filling.inside(FluidFilledCrack(faces, forces, np.full(3, mouth), 1.0, np.arange(3) * 1e9, 0.0, THIN, 12))
    return float(faces.intensities(inside.values)[0, -1] / np.sqrt(np.pi))


FILLINGS = collect(sys.modules[__name__], Filling)
