"""Type of a crack filling, and the properties of the oil in it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from tehl_taichi.laws.density import rho_ratio
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.values.registry import Entry

GAP = 20e-9  # m: left between faces that touch (their roughness), in which oil creeps on


@dataclass(frozen=True, kw_only=True)
class Filling(Entry):
    """A crack filling. inside(wet): the :class:`tehl_taichi.crack.fluid_filled.FluidState` of a
    :class:`tehl_taichi.crack.fluid_filled.FluidFilledCrack`.
    """

    inside: Callable


def _compression(oil, Gamma, p):
    return rho_ratio(oil, p, Gamma) / rho_ratio(oil, 0.0, Gamma)


def _viscosity(oil, Gamma, p):
    return np.exp(ln_eta(oil, p, Gamma))


@dataclass(frozen=True)
class Fluid:
    """Oil in the crack. compression(p): density relative to p = 0; viscosity(p): Pa s; p: Pa, number or array; gap: m, see
    :data:`GAP`.
    """

    compression: Callable
    viscosity: Callable
    gap: float = GAP

    @classmethod
    def of(cls, scene):
        """Oil of the scene at the temperature of the bodies, Newtonian."""
        oil, Gamma = scene.oil, scene.operation.temperature
        return cls(partial(_compression, oil, Gamma), partial(_viscosity, oil, Gamma))

    def compressibility(self, p):
        """Coefficient k (1/Pa) with 1 - k p = 1/compression(p)."""
        p = np.maximum(p, 1e5)
        return (1 - 1 / self.compression(p)) / p
