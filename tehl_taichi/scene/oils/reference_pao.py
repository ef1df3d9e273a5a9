"""Oil of the gear scene: the default numbers of every scene."""

from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.oils import NamedOil

REFERENCE_PAO = NamedOil(
    name="reference-pao", says="a PAO: viscosity of pressure and temperature", source=Oil.source,
    known=((0.0, 0.0, 10**0.37, 1e-12, "by hand at 0 deg C: log10 eta0 = -4.2 + G0"),
           (0.0, 135.0, 10 ** (4.57 * 0.5**1.25 - 4.2), 1e-12, "by hand at 135 deg C: (1 + 135/135)^-1.25 = 2^-1.25")))
