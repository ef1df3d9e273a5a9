"""Numbers of each level for the kernels: one table; :mod:`tehl_taichi.pressure.fields` names its columns."""

import numpy as np

from tehl_taichi.pressure import fields
from tehl_taichi.pressure.grids import PAD, columns


class LevelNumbers:
    """Table G[level, column] of `grids`.

    Constant: places and spacings, deflection nearby, film floor. Set per solve: balance of the film (:meth:`slow_down`), its
    slip (:meth:`slip`), wall shear by pressure gradients (:meth:`strain`), and d/dT (:meth:`set_rate`). `conditions`: Record of
    the scene; floor: of the film, dimensionless.
    """

    def __init__(self, grids, conditions, floor):
        self.G, off, s = np.zeros((len(grids.sizes), fields.NCOLS)), PAD + grids.nx + 1, grids.scales
        for l in range(len(grids.sizes)):
            nx, ny, dx, dy = grids.grid(l)
            own, beside = grids.near_kernel(l)[0]
            self._set(l, {fields.OFF: off, fields.NX: nx, fields.NY: ny, fields.JN: ny + 1 if grids.line else ny,
                          fields.DX: dx, fields.DY: dy, fields.K0: own, fields.K1: beside, fields.FLOOR: floor,
                          fields.LINES: l in grids.lines, fields.P_H: s.p_H})
            off += columns(nx, ny)
        self.inv_lambda = 1 / (12 * conditions["eta0"] * s.u_m * s.R**2 / (s.a**3 * s.p_H))
        self.conditions, self.shear = conditions, -conditions["u_s"] * conditions["eta0"] / s.h
        self.wall = s.p_H * s.h / (2 * s.a)
        self.slow_down(1.0)
        self.slip(1.0)
        self.strain(1.0)
        self.set_rate(0.0)

    def _set(self, l, numbers):
        """Set numbers of level l, {column: number}."""
        for column, number in numbers.items():
            self.G[l, column] = number

    def slow_down(self, factor):
        """Set the speed in the film's balance to that of the scene over `factor`."""
        self.G[:, fields.ILAM] = factor * self.inv_lambda

    def slip(self, part):
        """Set the slip in the shear law to this part of the scene's; 0: a Newtonian film."""
        self.G[:, fields.SHEAR] = part * self.shear

    def strain(self, part):
        """Set the wall stress by pressure gradients to this part of it, for flow and heat; 0: walls that carry any stress."""
        self.G[:, fields.WALL] = part * self.wall / self.G[:, fields.DX]
        self.conditions.set(strain=part)

    def set_rate(self, weight, frame=0.0):
        """Set the weight of the newest level in d/dT, 1/T units (0: steady), scaled with dx on every level; frame: speed of its
        frame of reference over u_m.
        """
        self.G[:, fields.CT] = weight * self.G[:, fields.DX]
        self.G[:, fields.FRAME] = frame
