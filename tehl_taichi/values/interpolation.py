"""Interpolation by the polynomial through given points (in kernels: `cubic` of `heat/departure_points.py`)."""

import math


def lagrange(at, to):
    """Weights of the values at positions `at` (each a number or an array) for the value at `to` (likewise)."""
    return [math.prod((to - b) / (a - b) for m, b in enumerate(at) if m != n) for n, a in enumerate(at)]
