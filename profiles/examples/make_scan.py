"""A small scan as a profilometer would give it: a ground tooth flank with one asperity, tilted and not levelled.

python profiles/examples/make_scan.py scan.csv     (heights in nm, 81 x 41 points 5 um apart, rows along y)
"""

import sys

import numpy as np

PIXEL = 5e-6  # m


def scan(seed=3):
    """Heights (41, 81) in nm: grinding lay across the direction of rolling, an asperity of 1 um, the tilt of the table."""
    y, x = np.mgrid[-20:21, -40:41] * PIXEL
    rng = np.random.default_rng(seed)
    lay = sum(40 * np.cos(2 * np.pi * (x / length + rng.uniform())) for length in (180e-6, 130e-6, 95e-6))
    lay = lay * (1 + 0.3 * np.cos(2 * np.pi * y / 300e-6))
    asperity = 1000 * np.exp(-((x - 20e-6) ** 2 + (y + 10e-6) ** 2) / (2 * 35e-6**2))
    return lay + asperity + 2e6 * x - 1e6 * y + 5000


if __name__ == "__main__":
    np.savetxt(sys.argv[1] if len(sys.argv) > 1 else "scan.csv", scan(), delimiter=",", fmt="%.1f")
