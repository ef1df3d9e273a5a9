"""Form of a measured map: one curvature along x and one along y, that of the measured body or zero."""

from dataclasses import dataclass

from tehl_taichi.scene.surface.maps.height_map import curvature, levelled

FLAT = 1e-9  # m rms: a tenth of a percent of the thinnest films of this kind (1 um), and less than one molecule
CURVED = 0.25  # of the rms, left without the curvature: less is taken for the form of a body (a ridge as wide leaves 0.28)


@dataclass(frozen=True)
class SurfaceForm:
    """Form of a map. flat: rms height after removing a plane (m); left: rms after removing the curvature, too (m); bent:
    curvature of the more important axis (1/m, positive if convex); axis: "x" or "y".
    """

    flat: float
    left: float
    bent: float
    axis: str

    @classmethod
    def of(cls, raw, steps, sizes):
        """Form of heights (rows, columns) as measured; steps: distances of points; sizes: of the map; along x and y, in m."""
        sags = [(abs(c) * size**2, c, axis) for c, size, axis in zip(curvature(raw, steps), sizes, "xy")]
        _, bent, axis = max(sags)
        flat, left = (float(levelled(raw, level).std()) for level in ("plane", "form"))
        return cls(flat, left, float(bent), axis)

    @property
    def dominant(self):
        """Whether the form is almost all of the map."""
        return self.flat >= FLAT and self.left < CURVED * self.flat

    @property
    def convex(self):
        return self.bent >= 0

    @property
    def says(self):
        """Description of the removed form."""
        if self.bent == 0:
            return "flat"
        return f"{'convex' if self.convex else 'concave'} with a radius of {1e3 / abs(self.bent):.3g} mm along {self.axis}"
