"""All laws: those with a key in the scene that chooses one, by that key, and those without a choice."""

from tehl_taichi.laws import conduction, density, rheology, viscosity
from tehl_taichi.laws.solid_friction import BOUNDARY

CHOICES = {"rheology.law": rheology.LAWS, "oil.viscosity": viscosity.LAWS, "oil.density": density.LAWS}
ALONE = {**conduction.LAWS, BOUNDARY.name: BOUNDARY}
