"""Interference colours of an oil film between a coated glass and a steel surface, as in optical rigs.

Two beams of equal strength, normal to the film, dark at zero film: the intensity at a wavelength is (1 - cos(4 pi n
h/lambda))/2 (Cameron & Gohar 1966; Foord, Wedeven, Westlake & Cameron 1969). The refractive index n of the oil follows its
density by Lorentz and Lorenz: (n^2 - 1)/(n^2 + 2) over the density is constant. White light is seen by the standard observer
CIE 1931 in the fit of Wyman, Sloan & Shirley 2013, and printed as sRGB (IEC 61966-2-1).
"""

import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.values import checks, units
from tehl_taichi.values.coerce import shown

INDEX = 1.47          # of a mineral oil without pressure
SODIUM = 589.3e-9     # m, wavelength of sodium light
CHROMATIC, MONOCHROMATIC = "chromatic", "monochromatic"
LIGHTS = (CHROMATIC, MONOCHROMATIC)
SEEN = np.arange(380.0, 781.0, 5.0)  # nm
# (size, centre, width below, width above; nm) of the lobes of the colour matching functions x, y, z
LOBES = (((1.056, 599.8, 37.9, 31.0), (0.362, 442.0, 16.0, 26.7), (-0.065, 501.1, 20.4, 26.2)),
         ((0.821, 568.8, 46.9, 40.5), (0.286, 530.9, 16.3, 31.1)), ((1.217, 437.0, 11.8, 36.0), (0.681, 459.0, 26.0, 13.8)))
TO_RGB = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])  # of sRGB, white D65
WHITE = np.array([0.9505, 1.0, 1.0890])  # D65


@dataclass(frozen=True)
class Light:
    """Light of the rig. wavelength (m): of monochromatic light; index: refractive index of the oil at p = 0. Raises SceneError
    for impossible values.
    """

    kind: str = CHROMATIC
    index: float = INDEX
    wavelength: float = SODIUM

    def __post_init__(self):
        checks.choice("interference", self.kind, LIGHTS)
        for key, unit, low, high, usual in (("index", "", 1.2, 2.0, INDEX), ("wavelength", "m", 3.8e-7, 7.8e-7, SODIUM)):
            object.__setattr__(self, key, units.in_unit(key, getattr(self, key), unit))
            checks.number(key, getattr(self, key), unit, low, high, usual=usual)

    def colours(self, path):
        """RGB values 0..1 (..., 3) of optical paths n h (m, any shape); a single wavelength is printed in grey."""
        if self.kind == MONOCHROMATIC:
            return np.repeat(intensity(path, self.wavelength)[..., None], 3, axis=-1)
        return white_light(path)

    def index_at(self, ratio):
        """Refractive index of oil whose density is `ratio` times that at p = 0."""
        share = ratio * (self.index**2 - 1) / (self.index**2 + 2)
        return np.sqrt((1 + 2 * share) / (1 - share))

    @property
    def words(self):
        """Description of the light."""
        of = "white light" if self.kind == CHROMATIC else f"light of {self.wavelength * 1e9:.1f} nm"
        return f"{of}, refractive index {self.index:g} of the oil without pressure"


def light(kind=None, index=None, wavelength=None):
    """The :class:`Light` of these options, None without a kind. Raises SceneError for options without effect."""
    for key, value, needed in (("refractive_index", index, LIGHTS), ("wavelength", wavelength, (MONOCHROMATIC,))):
        if value is not None and kind not in needed:
            raise SceneError(f"{key} = {shown(value)} has no effect without interference = {' or '.join(map(repr, needed))}")
    given = {key: value for key, value in (("index", index), ("wavelength", wavelength)) if value is not None}
    return None if kind is None else Light(kind, **given)


def intensity(path, wavelength):
    """Intensity 0..1 at a wavelength of optical paths n h, both in m."""
    return 0.5 - 0.5 * np.cos(4 * math.pi * np.asarray(path) / wavelength)


def matching(nm):
    """Colour matching functions (3, wavelengths) of the standard observer."""
    return np.array([sum(size * np.exp(-0.5 * ((nm - centre) / np.where(nm < centre, below, above)) ** 2)
                         for size, centre, below, above in lobes) for lobes in LOBES])


def white_light(path):
    """sRGB values of optical paths (m) in light of equal energy, whose white is printed as white."""
    table = np.linspace(0.0, max(float(np.max(path, initial=0.0)), 1e-9), 4096)
    weights = matching(SEEN)
    seen = intensity(table[:, None], SEEN * 1e-9) @ (weights / weights.sum(axis=1, keepdims=True)).T
    rgb = np.clip(seen * WHITE @ TO_RGB.T, 0.0, 1.0)
    rgb = np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * rgb ** (1 / 2.4) - 0.055)
    return np.stack([np.interp(path, table, channel) for channel in rgb.T], axis=-1)
