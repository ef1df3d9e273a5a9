"""A number that the program chose where a scene says "auto"."""


class AutomaticValue(float):
    """A float like any other; a description of the scene says "auto" in its place."""
