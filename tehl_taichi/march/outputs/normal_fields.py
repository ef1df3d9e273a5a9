"""Pressure, film, and mask of touching nodes."""

import numpy as np

from tehl_taichi.march.step_output import Field

PRESSURE = Field(name="pressure", unit="Pa", says="film pressure", source="Reynolds' equation, cavitation (pressure/newton)",
                 of=lambda s: s.P * s.scales.p_H, by_hand=1.5e9)
FILM = Field(name="film", unit="m", says="film thickness", source="rigid approach, gap and deflection (pressure/deflection)",
             of=lambda s: s.H * s.scales.h, by_hand=11e-6)
CONTACT = Field(name="contact", unit="1", dtype="u1", says="solid contact (1 where the surfaces touch)",
                source="film at its floor, load carried by the solids (pressure/newton)",
                of=lambda s: s.touch.astype(np.uint8), by_hand=1)
