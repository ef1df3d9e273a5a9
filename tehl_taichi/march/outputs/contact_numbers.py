"""Numbers of the contact as a whole: extremes, load, friction."""

import numpy as np

from tehl_taichi.march.step_output import Scalar


def mean_friction(s):
    """Mean friction of both bodies, in units of load (p_H times a Hertz unit of area): (int (q_a - q_b) dA)/2."""
    return 0.5 * abs(float(np.sum(s.weights * (s.stress[0] - s.stress[2])))) / s.scales.p_H


def touching_load(s):
    """Load in touching nodes; usually zero."""
    return float(np.sum(s.weights * s.P * s.touch)) if s.touch.any() else 0.0


def touching_area(s):
    """Touching area over the area of the dry contact, whose mean pressure is pi/4 of its largest (point: 2/3)."""
    dry = s.load / (np.pi / 4 if s.scales.line else 2 / 3)
    return float(np.sum(s.weights * (s.touch > 0))) / dry


H0 = Scalar(name="h0_m", unit="m", says="rigid approach", over="point", source="load balance (pressure/newton)",
            of=lambda s: s.H0 * s.scales.h, by_hand=-0.25e-6)
P_MAX = Scalar(name="p_max_Pa", unit="Pa", says="largest pressure", over="maximum", source="largest at the nodes",
               of=lambda s: s.extremes["p_max"] * s.scales.p_H, by_hand=1e9)
H_MIN = Scalar(name="h_min_m", unit="m", says="smallest film", over="minimum", source="smallest at the nodes",
               of=lambda s: s.extremes["h_min"] * s.scales.h, by_hand=1e-6)
H_C = Scalar(name="h_c_m", unit="m", says="film at x = 0, far edge", over="point", source="linear between nodes",
             of=lambda s: s.extremes["h_c"] * s.scales.h, by_hand=1e-6)
TOUCHING = Scalar(name="contact_load_fraction", unit="1", says="load carried by solid contact", over="maximum",
                  source="pressure where the surfaces touch, over the load",
                  of=lambda s: touching_load(s) / s.load, by_hand=0.5 / 0.75)
AREA = Scalar(name="contact_area_share", unit="1", says="area of solid contact", over="maximum",
              source="area where the surfaces touch, over that of the dry contact", of=touching_area,
              by_hand=0.5 / (0.75 * 4 / np.pi))
FRICTION = Scalar(name="friction_coefficient", unit="1", says="friction coefficient", over="mean",
                  source="mean friction of both bodies over the load", of=lambda s: mean_friction(s) / s.load, by_hand=0.02)
