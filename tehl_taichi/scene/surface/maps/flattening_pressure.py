"""Pressure that flattens measured heights: a wave of height h and wave number |q| needs E'/4 |q| h on two elastic half-spaces.

Johnson, Contact Mechanics, section 13.2 (half of the contact modulus, which is half of E').
"""

import numpy as np

from tehl_taichi.scene.surface.maps.height_map import levelled

RIM = 0.1  # of each side, over which heights fade out: a Fourier series joins opposite sides
SHARE = 0.999  # of the points have less: what is left are spikes of the measurement, and peaks that a dot of plastic flow takes


def flattening(heights, steps, E):
    """Pressure (Pa, above the mean) that flattens `heights` (along y, along x; m), at points away from the rim.

    steps: distances of points (m, along x, along y); E: E' in Pa.
    """
    windows = [_window(count) for count in heights.shape]
    faded = levelled(heights, "plane") * np.outer(*windows)
    rows, columns = heights.shape
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(rows, steps[1])[:, None], np.fft.rfftfreq(columns, steps[0]))
    pressure = np.fft.irfft2(E / 4 * q * np.fft.rfft2(faded), heights.shape)
    return pressure[np.ix_(*(window == 1 for window in windows))]


def highest(heights, steps, E):
    """Pressure (Pa) that only a thousandth of the points exceed."""
    return float(np.quantile(flattening(heights, steps, E), SHARE))


def _window(count):
    """Window function: 1 with half a cosine at both ends."""
    places = np.arange(count)
    inside = (np.minimum(places, places[::-1]) + 0.5) / (RIM * count)
    return 0.5 * (1 - np.cos(np.pi * np.minimum(inside, 1.0)))
