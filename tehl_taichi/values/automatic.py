"""A number that the program chose for "auto" in a scene."""


class AutomaticValue(float):
    """A float; descriptions of the scene show "auto" in its place."""
