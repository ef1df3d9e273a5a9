"""Shear on both surfaces."""

from tehl_taichi.march.step_output import Field

SHEAR = "shear law of the film, boundary friction where the surfaces touch (pressure/tractions)"
X_A = Field(name="traction_x_a", unit="Pa", says="shear traction on body a along x", source=SHEAR, of=lambda s: s.stress[0],
            by_hand=3e7)
Y_A = Field(name="traction_y_a", unit="Pa", says="shear traction on body a along y", source=SHEAR, of=lambda s: s.stress[1],
            by_hand=1.5e6)
X_B = Field(name="traction_x_b", unit="Pa", says="shear traction on body b along x", source=SHEAR, of=lambda s: s.stress[2],
            by_hand=-3e7)
Y_B = Field(name="traction_y_b", unit="Pa", says="shear traction on body b along y", source=SHEAR, of=lambda s: s.stress[3],
            by_hand=4.5e6)
