"""The critical plane of stress histories from elsewhere, by every criterion: tension and torsion out of phase.

python profiles/examples/own_stresses.py
"""

import numpy as np

import tehl_taichi as tehl
from tehl_taichi.laws.criteria import CRITERIA

turn = 2 * np.pi * np.arange(64) / 64
stresses = np.zeros((2, turn.size, 6))  # (points, times, 6) in Pa: xx, yy, zz, xy, xz, yz
stresses[:, :, 0] = 200e6 * np.cos(turn)
stresses[0, :, 3] = 120e6 * np.cos(turn)  # in phase
stresses[1, :, 3] = 120e6 * np.sin(turn)  # a quarter of a turn later

for criterion in CRITERIA:
    found = tehl.fatigue(stresses, kappa=0.3, endurance=400e6, criterion=criterion)
    print(f"{criterion}: Fi {found.Fi[0]:.3f} in phase, {found.Fi[1]:.3f} out of phase")
