"""Interpolation by the polynomial through given points (in kernels: `cubic` of `heat/departure_points.py`)."""

import math


def lagrange(at, to):
    """Weights of the values at positions `at` for the value at `to` (a number or an array)."""
    return [math.prod((to - b) / (a - b) for b in at if b != a) for a in at]
