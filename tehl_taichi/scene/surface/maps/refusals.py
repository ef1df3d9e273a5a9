"""Refusals of a scan that its scene file can still mend: `tehl new` writes the file and says them."""

from tehl_taichi.errors import SceneError


class KeyMissing(SceneError):
    """A key that must be given is not."""


class HeightsRefused(SceneError):
    """The heights are too steep, too high or not measured; another part, a cutoff or another unit may help."""
