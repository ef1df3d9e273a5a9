"""Strength of a body at a depth: constants of the criterion, residual stress, yield stress."""

from dataclasses import dataclass
from functools import cached_property

from tehl_taichi.laws.hardness import RELATIONS
from tehl_taichi.scene import yield_stress
from tehl_taichi.scene.strength.table import HARDNESS, KAPPA, LIMIT, RESIDUAL, YIELD, of_text


@dataclass(frozen=True)
class LocalStrength:
    """Strength at a depth (m): kappa and endurance (sigma_eF, Pa) of a criterion; share: limit at the surface over the limit
    here.
    """

    depth: float
    kappa: float
    endurance: float
    criterion: str
    share: float


class Strength:
    """Strength of a body over its depth: from its table, or from the section [fatigue] for all depths.

    fatigue: the section; surface: its :class:`tehl_taichi.scene.moving_surfaces.MovingSurface`.
    """

    def __init__(self, fatigue, surface):
        self.fatigue, self.body = fatigue, surface.body
        text = fatigue.table_text(surface.name)
        self.table = of_text(text) if text else None

    def at(self, depth):
        """The :class:`LocalStrength` at a depth (m)."""
        kappa, endurance = self._constants(depth)
        return LocalStrength(depth, kappa, endurance, self.fatigue.criterion, self.surface_limit / endurance)

    @cached_property
    def surface_limit(self):
        """sigma_eF at the surface, Pa."""
        return self._constants(0.0)[1]

    def limits(self, depths):
        """Limits sigma_eF (Pa) at depths (m), a list."""
        return [self._constants(float(depth))[1] for depth in depths]

    def shares(self, depths):
        """Factors for stresses at depths (m) that make them comparable to the limit at the surface, a list."""
        return [self.surface_limit / limit for limit in self.limits(depths)]

    def kappas(self, depths):
        """Values of kappa at depths (m), a list."""
        return [self._constants(float(depth))[0] for depth in depths]

    def _constants(self, depth):
        """(kappa, sigma_eF in Pa) at a depth (m)."""
        f, table = self.fatigue, self.table
        if table is None:
            return f.kappa, f.endurance
        kappa = float(table.at(KAPPA, depth)) if table.has(KAPPA) else f.kappa
        if table.has(LIMIT):
            return kappa, float(table.at(LIMIT, depth))
        found = RELATIONS[f.relation].constants(float(table.at(HARDNESS, depth)), f, kappa, depth > f.inclusion)
        return (kappa, found[1]) if table.has(KAPPA) else found

    @property
    def varies_in_residual(self):
        """Whether a table gives the residual stress."""
        return self.table is not None and (self.table.has(RESIDUAL[0]) or self.table.has(RESIDUAL[1]))

    @property
    def has_residual(self):
        """Whether there is a residual stress, from a table or constant."""
        return self.varies_in_residual or bool(self.fatigue.residual_xx or self.fatigue.residual_yy)

    def residual(self, depths):
        """Residual stress (along x, along y), Pa, at depths (m): arrays from a table, else the constants of the scene."""
        constant = self.fatigue.residual_xx, self.fatigue.residual_yy
        return tuple(self.table.at(name, depths) if self.table is not None and self.table.has(name) else value
                     for name, value in zip(RESIDUAL, constant))

    def yield_stress(self, depth):
        """Yield stress (Pa) at a depth (m): from the table, else of the body."""
        if self.table is not None and self.table.has(YIELD):
            return float(self.table.at(YIELD, depth))
        return yield_stress.of(self.body)

    @property
    def knows_yield_stress(self):
        """Whether the yield stress is given, or may be that of steel."""
        return self.table is not None and self.table.has(YIELD) or yield_stress.is_known(self.body)
