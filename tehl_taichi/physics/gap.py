"""Heights of surface features (metres), x and y relative to the feature's centre; arrays."""

import numpy as np


def cosine(height, width, x, y):
    """Axisymmetric bump of one cosine cycle, (height/2)(1 + cos(2 pi r/width)) for r < width/2 (Everitt 2018, Fig 6)."""
    r = np.hypot(x, y)
    return np.where(r < width / 2, 0.5 * height * (1 + np.cos(2 * np.pi * r / width)), 0.0)


def ridge(height, width, x, y):
    """Transverse ridge, height 10^(-10 xi^2) cos(2 pi xi), xi = x/width (Venner & Lubrecht)."""
    xi = x / width
    return height * 10.0 ** (-10 * xi * xi) * np.cos(2 * np.pi * xi) + 0 * y


SHAPES = {"cosine": cosine, "ridge": ridge, "furrow": ridge}


def feature_height(feature, x, y):
    """Height of `feature` (positive = out of the surface; a furrow or dent has a negative height)."""
    return SHAPES[feature.shape](feature.height, feature.width, x, y)
