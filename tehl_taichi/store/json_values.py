"""Conversion of values to JSON types."""

import math

import numpy as np


def plain(value):
    """`value` with lists in place of tuples and arrays, Python numbers in place of numpy's, and null for NaN and infinities."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, (np.ndarray, np.generic)):
        return plain(value.tolist())
    return None if isinstance(value, float) and not math.isfinite(value) else value
