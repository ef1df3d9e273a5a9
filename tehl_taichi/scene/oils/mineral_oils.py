"""Mineral oils of a handbook table: viscosity and pressure coefficient at 30, 60 and 100 deg C.

G0, S0, Dz, Cz are fitted to these six numbers (straight lines of ln(log10 eta + 4.2) and of Z over ln(1 + Gamma/135)). The
table has no density: the ISO VG in the name is right for any density from 850 to 880 kg/m3.
"""

import functools

from tehl_taichi.scene.oils import NamedOil
from tehl_taichi.values.registry import Checked

TABLE = "Stachowiak & Batchelor, Engineering Tribology, table 2.3"
FITTED = 0.035  # the worst of the fits is 3.05 % off
AT = (30.0, 60.0, 100.0)  # deg C
STEP = 1e5  # Pa


def _mineral(name, says, row, eta, alpha, numbers):
    """Entry of a mineral oil from its viscosities (Pa s) and pressure coefficients (1/Pa) at 30, 60 and 100 deg C."""
    def rise(Gamma):
        return (entry.viscosity(STEP, Gamma) / entry.viscosity(0.0, Gamma) - 1) / STEP

    entry = NamedOil(
        name=name, says=says, numbers=dict(zip(("G0", "S0", "Dz", "Cz"), numbers)),
        source=f"{TABLE} ({row}), fitted within 3 %; density, conductivity and heat capacity are those of the reference PAO",
        known=tuple((0.0, Gamma, value, FITTED, f"{TABLE}, {Gamma:g} deg C") for Gamma, value in zip(AT, eta)),
        checked=tuple(Checked(f"pressure coefficient, {TABLE}, {Gamma:g} deg C", value, functools.partial(rise, Gamma), FITTED)
                      for Gamma, value in zip(AT, alpha)))
    return entry


VG68 = _mineral("mineral-vg68", "mineral, about ISO VG 68", "medicinal white oil", (0.107, 0.0233, 0.0064),
                (29.6e-9, 22.8e-9, 17.8e-9), (4.224, 1.346, 0.790, -0.159))
VG100 = _mineral("mineral-vg100", "mineral, about ISO VG 100", "heavy machine oil, 34 mPa s at 60 deg C",
                 (0.153, 0.034, 0.0091), (23.7e-9, 20.5e-9, 15.8e-9), (4.365, 1.271, 0.592, 0.168))
VG150 = _mineral("mineral-vg150", "mineral, about ISO VG 150", "heavy machine oil, 50.5 mPa s at 60 deg C",
                 (0.250, 0.0505, 0.0126), (25.0e-9, 21.3e-9, 17.6e-9), (4.632, 1.264, 0.560, 0.388))
VG460 = _mineral("mineral-vg460", "mineral, about ISO VG 460", "cylinder oil, 135 mPa s at 60 deg C", (0.810, 0.135, 0.0268),
                 (34e-9, 28e-9, 22e-9), (5.296, 1.263, 0.703, 0.051))
STEEP = _mineral("mineral-vg100-steep", "mineral, about ISO VG 100, low viscosity index", "heavy machine oil, 30 mPa s at 60 "
                 "deg C", (0.165, 0.030, 0.0068), (33.0e-9, 23.8e-9, 16.0e-9), (4.592, 1.470, 0.911, -0.989))
