"""The shapes of surface features, one file each (:class:`tehl_taichi.scene.surface.shape.Shape`): a new file is a new choice.

May import `scene.surface.shape`, `values` and what these may; numpy, not taichi. `patch` is the base of shapes that fill a
rectangle.
"""
