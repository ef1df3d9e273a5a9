"""A made-up state of 2 x 3 nodes, small enough to check every output by hand."""

from types import SimpleNamespace

import numpy as np

P = np.array([[0.0, 1.0, 0.0], [0.0, 0.5, 0.0]])
H = np.array([[2.0, 1.0, 2.0], [2.0, 1.5, 2.5]])
SAMPLE = SimpleNamespace(
    scales=SimpleNamespace(p_H=1e9, h=1e-6, a=1e-4, line=True),
    P=P, H=H, touch=np.array([[0, 1, 0], [0, 0, 0]]), weights=np.full((2, 3), 0.5),
    stress=np.array([2e7 * P, 1e6 * P, -2e7 * P, 3e6 * P]),  # on a along x, y, on b along x, y; Pa
    T=np.array([[[90.0, 95.0, 90.0], [90.0, 92.0, 90.0]], [[90.0, 110.0, 90.0], [90.0, 100.0, 90.0]],
                [[90.0, 94.0, 90.0], [90.0, 91.0, 90.0]]]),  # parabolas across the film: largest between its nodes
    extremes={"h_c": 1.0, "h_min": 1.0, "p_max": 1.0}, H0=-0.25, load=0.75,
    report=SimpleNamespace(load_error=-2e-7, mass_error=1e-8, residual=3e-7, newton=3, cycles=11),
    heat=SimpleNamespace(report=SimpleNamespace(change=0.02, clamped=1)), rejected=1, dt=2e-6, wall=0.25,
    displacements=(-1.5e-4, -1.8e-4))
