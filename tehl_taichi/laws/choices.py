"""All laws: those that a scene chooses between, by the key that chooses, and those that stand alone."""

from tehl_taichi.laws import conduction, density, rheology, viscosity
from tehl_taichi.laws.solid_friction import BOUNDARY

CHOICES = {"rheology.law": rheology.LAWS, "oil.viscosity": viscosity.LAWS, "oil.density": density.LAWS}
ALONE = {**conduction.LAWS, BOUNDARY.name: BOUNDARY}
