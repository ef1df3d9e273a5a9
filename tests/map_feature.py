"""A feature made of a file of heights, as the tests of measured maps ask for it."""

from tehl_taichi.scene.feature import Feature


def feature(file, **changes):
    """Heights in um, points 1 um apart, taken off over 10 um at the rim, where `changes` say nothing else."""
    return Feature(**{"shape": "map", "file": str(file), "unit": "um", "pixel": 1e-6, "taper": 10e-6, **changes})
