"""Named steels, one file each: a new file here is a new name for `bodies.a.material`.

A file contains the numbers of its source, and no others. May import what `scene.sections` may, but not `scene.sections` itself.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from tehl_taichi.values.registry import Checked, Entry

MARTENSITE = 3.8e6  # J/m3K: "about 3.8 N/(mm2 K)"
WHERE = "rho c of martensitic gear steels, about 3.8 N/mm2K, in the flash temperature method of AGMA 925 and ISO/TR 13989"


@dataclass(frozen=True, kw_only=True)
class Steel(Entry):
    """A named steel. numbers: {key of :class:`tehl_taichi.scene.sections.Body`: value}, all of them."""

    numbers: Mapping
    checked: tuple[Checked, ...] = ()

    def __post_init__(self):
        heat = Checked(WHERE, MARTENSITE, lambda: self.numbers["rho"] * self.numbers["c"], 0.05)
        object.__setattr__(self, "checked", (heat, *self.checked))
