"""Mineral gear oils of the grades missing in mineral_oils.py, each as a data sheet.

The viscosity at 40 deg C is the midpoint of the grade (ISO 3448); that at 100 deg C corresponds to viscosity index 95 (ASTM
D2270: VI = 100 (L - nu_40)/(L - H), L and H tabulated over nu_100). The density is the usual 890 kg/m3 at 15 deg C. Alpha is an
estimate.
"""

from tehl_taichi.scene import mineral_alpha
from tehl_taichi.scene.oils import NamedOil
from tehl_taichi.values.registry import Checked

RHO_40 = 890 / 1.017  # kg/m3; by hand: 25 K at 6.8e-4 1/K
RHO_100 = RHO_40 * 0.9592


def _gear_oil(grade, nu_100, L, H):
    """Entry of a gear oil; nu_100 in mm2/s; L, H: interpolated from the standard's table at nu_100."""
    return NamedOil(
        name=f"mineral-vg{grade}", says=f"gear oil, ISO VG {grade}, VI 95",
        source=f"mineral, made of ISO 3448 ({grade} mm2/s at 40 deg C), viscosity index 95 (ASTM D2270: {nu_100:g} mm2/s "
               "at 100 deg C), 890 kg/m3 at 15 deg C; alpha estimated as for a mineral oil, "
               f"within {mineral_alpha.WITHIN * 100:g} %; conductivity and heat capacity are those of the reference PAO",
        numbers=dict(nu_40=grade * 1e-6, nu_100=nu_100 * 1e-6, rho_15=890.0),
        known=((0.0, 40.0, grade * 1e-6 * RHO_40, 1e-6, "by hand: nu rho at 40 deg C"),
               (0.0, 100.0, nu_100 * 1e-6 * RHO_100, 1e-6, "by hand: nu rho at 100 deg C")),
        checked=(Checked("viscosity index, ASTM D2270", 95.0, lambda: 100 * (L - grade) / (L - H), 1e-3),))


VG220 = _gear_oil(220, 18.75, 439.4, 208.45)
VG320 = _gear_oil(320, 23.96, 681.86, 301.02)
