"""Refusals of a scan that can be corrected in its scene file: `tehl new` writes the file and prints them."""

from tehl_taichi.errors import SceneError


class KeyMissing(SceneError):
    """A required key is missing."""


class HeightsRefused(SceneError):
    """The heights are too steep, too high or not measured; another part, a cutoff or another unit may help."""
