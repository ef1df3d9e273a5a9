"""The named oils, one file each: a new file here is a new name for `oil.name`.

A file contains the numbers of its source, and no others. May import what `scene.oil` may.
"""

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.scene.oil import Oil
from tehl_taichi.values.registry import Checked, Entry

STEP = 1e5  # Pa, of alpha: ln(eta) bends over some 1e8 Pa, so the error is some 1e-6 of it


@dataclass(frozen=True, kw_only=True)
class NamedOil(Entry):
    """A named oil. numbers: {key of :class:`tehl_taichi.scene.oil.Oil`: value} that differ from the reference oil.

    known: (p in Pa, Gamma in deg C, viscosity in Pa s, relative error, source) of at least one state.
    """

    known: tuple[tuple[float, float, float, float, str], ...]
    numbers: Mapping = field(default_factory=dict)
    checked: tuple[Checked, ...] = ()

    def __post_init__(self):
        states = tuple(Checked(where, eta, functools.partial(self.viscosity, p, Gamma), rel)
                       for p, Gamma, eta, rel, where in self.known)
        object.__setattr__(self, "checked", (*states, *self.checked))

    @property
    def oil(self):
        """The Oil with this name."""
        return Oil(**{"name": self.name, "source": self.source, **self.numbers})

    def viscosity(self, p, Gamma):
        """Viscosity (Pa s) at p (Pa) and Gamma (deg C)."""
        return math.exp(ln_eta(self.oil, p, Gamma))

    def alpha(self, Gamma):
        """Pressure coefficient d ln(eta)/dp (1/Pa) at p = 0 and Gamma (deg C), by one-sided second-order differences."""
        at = [ln_eta(self.oil, n * STEP, Gamma) for n in range(3)]
        return (4 * at[1] - 3 * at[0] - at[2]) / (2 * STEP)

    @property
    def shown_numbers(self):
        """Three-digit texts for lists: viscosity at 40 and 100 deg C in mPa s, alpha at 40 deg C in 1/GPa, at p = 0."""
        numbers = self.viscosity(0.0, 40.0) * 1e3, self.viscosity(0.0, 100.0) * 1e3, self.alpha(40.0) * 1e9
        return tuple(f"{float(f'{number:.3g}'):g}" for number in numbers)
