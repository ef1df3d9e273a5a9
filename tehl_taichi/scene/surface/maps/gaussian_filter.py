"""Areal Gaussian filter of heights (ISO 16610-61): waves shorter than a cutoff wavelength are removed."""

import math

import numpy as np

ALPHA = math.sqrt(math.log(2) / math.pi)  # 0.4697: half of a wave as long as the cutoff passes
REACH = 1.5  # cutoffs, to which weights go: 1e-14 of the largest there
FEWEST = 2.0  # points in a cutoff: a finer one would be the identity; from four on half passes to 0.5 %


def lowpass(values, steps, cutoff):
    """Filter `values` (points along y, along x) with the weights exp(-pi (r/(ALPHA cutoff))^2).

    steps: distances of points (m, along x, along y); cutoff in m. At the rim the mean covers the existing points only.
    """
    smooth = _smoothed(_smoothed(values, steps[0], cutoff).T, steps[1], cutoff)
    return np.ascontiguousarray(smooth.T)


def limits(f):
    """Smallest and largest cutoff (m) of a map, by its points and its size."""
    lines = [(step, size) for step, size, count in zip(f.steps, f.part_size, f.points) if count > 1]
    return FEWEST * max(step for step, _ in lines) * (1 - 1e-9), min(size for _, size in lines) * (1 + 1e-9)


def _smoothed(values, step, cutoff):
    """Filtered rows of `values`."""
    count = values.shape[1]
    reach = min(count - 1, math.ceil(REACH * cutoff / step))
    size = count + reach  # so that the end of a row does not meet its beginning
    places = np.arange(size)
    away = np.minimum(places, size - places)
    weights = np.where(away <= reach, np.exp(-math.pi * (away * step / (ALPHA * cutoff)) ** 2), 0.0)
    spectrum = np.fft.rfft(weights)
    rows, whole = (np.fft.irfft(np.fft.rfft(v, size) * spectrum, size)[..., :count] for v in (values, np.ones(count)))
    return rows / whole
