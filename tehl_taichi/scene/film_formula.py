"""Central and minimum film by published formulas: smooth, Newtonian; isothermal or with inlet shear heating."""

import functools
import math

import numpy as np

from tehl_taichi.laws.conduction import conductivity
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.scene.scales import Scales, reduced_modulus

PRESSURES = np.linspace(0.0, 1.5e9, 201)  # Pa; 1/eta has fallen to 1e-7 at the last
NOTICED = 0.01  # of the film
ELLIPTICITY = 1.03, 0.64  # k = 1.03 (R_y/R_x)^0.64 (Hamrock & Dowson 1981)


def central_film(scene, ratio=None):
    """Central film (m) by Moes (line) or Nijenbanning, Venner & Moes 1994 (circle, ellipse); ratio: R_x/R_y in place of the
    scene's own; accuracy: see :func:`spread`.
    """
    s, E, Gamma = Scales.of(scene), reduced_modulus(scene), scene.operation.temperature
    eta0, alpha = math.exp(ln_eta(scene.oil, 0.0, Gamma)), pressure_coefficient(scene.oil, Gamma)
    M, L = moes_numbers(scene.load, s.R, E, eta0, alpha, s.u_m, "line" if s.line else "point")
    film = moes_line(M, L) if s.line else nijenbanning(M, L, ratio or s.curvature)
    return film * math.sqrt(2 * eta0 * s.u_m / (E * s.R)) * s.R


# (largest Hertz pressure in Pa, relative spread) against isothermal Newtonian films of the program: lines (0.5 to 3 GPa, 512
# columns, 1 and 10 m/s), 2 to 16 % above, the more the oil is compressed; circles and ellipses of R_x/R_y = 0.2 and 0.5 (0.5 to
# 2 GPa, 128 x 64 cells, 1 and 5 m/s), 7 % below to 5 % above; R_x/R_y = 3 alike, 15 % below to 3 % above
SPREADS = {"line": ((1e9, 0.09), (3e9, 0.16)), "wide": ((2e9, 0.07),), "slender": ((2e9, 0.15),)}
COMPARED = 0.2, 3.0  # R_x/R_y
BEYOND = 0.25  # where nothing was compared
# Films (a^2/R') from which on formulas are 15 to 27 % above (balls and lines at 0.2 to 0.6 GPa, films of 3 to 15 a^2/R'; at 0.4
# and 0.6 within 2 %)
THICK, ABOVE = 1.0, 0.3


def spread(scene):
    """Largest relative difference between :func:`central_film` and a computed isothermal Newtonian film for this scene."""
    s = Scales.of(scene)
    if _is_thick(scene):
        return ABOVE
    if not s.line and not COMPARED[0] <= s.curvature <= COMPARED[1]:
        return BEYOND
    known = SPREADS["line" if s.line else "wide" if s.curvature <= 1 else "slender"]
    return next((within for p, within in known if s.p_H <= p * (1 + 1e-9)), BEYOND)


def _is_thick(scene):
    return central_film(scene) > THICK * Scales.of(scene).h


def formula_words(scene):
    """Text such as 'Moes, line, isothermal, Newtonian, within 9 %': source, validity and accuracy of the formula for this
    load.
    """
    s, within = Scales.of(scene), spread(scene)
    name = "Moes" if s.line else "Nijenbanning, Venner & Moes"
    heavy = ", heavy load" if s.line and within > SPREADS["line"][0][1] or within == BEYOND else ""
    heavy = ", thick film" if _is_thick(scene) else heavy
    return f"{name}, {scene.contact.kind}, isothermal, Newtonian{heavy}: within {within:.0%}"


def heated_film(scene):
    """Central film (m) by formula, reduced by inlet shear heating in thermal scenes.

    Computed central films of 25 random thermal lines (0.3 to 2.4 GPa, SRR -1.6 to 1.7, factor 0.07 to 1) are 0.68 to 1.20 of
    this value, half of them 0.87 to 1.0.
    """
    return central_film(scene) * (1.0 if scene.isothermal else inlet_heating(scene))


def thinnest_film(scene):
    """Minimum film (m) by formula: in the side lobes of a point contact; for a line, which has no lobes, the central film."""
    return heated_film(scene) * (1.0 if Scales.of(scene).line else side_lobes(scene))


def side_lobes(scene):
    """Film in the side lobes of an elliptic contact over its central film, at most 1.

    Ratio of two formulas: minimum film of Hamrock & Dowson 1977, 3.63 U^0.68 G^0.49 W^-0.073 (1 - e^(-0.68 k)), over their
    central film of a circle, 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k)), with k of ELLIPTICITY. Their central film of a
    contact that is long along x is too thick (0.54 GPa, R_x/R_y = 4: lobes 27 % thinner than computed ones); this ratio is up
    to 5 % too thick from 1/3 to 4.
    """
    s, E, Gamma = Scales.of(scene), reduced_modulus(scene), scene.operation.temperature
    U, G = math.exp(ln_eta(scene.oil, 0.0, Gamma)) * s.u_m / (E * s.R), E * pressure_coefficient(scene.oil, Gamma)
    W, slender = scene.load / (E * s.R**2), ELLIPTICITY[0] * s.curvature ** -ELLIPTICITY[1]
    circle = 2.69 * (1 - 0.61 * math.exp(-0.73 * ELLIPTICITY[0]))
    lobes = 3.63 / circle * U**0.01 * G**-0.04 * W**-0.006 * (1 - math.exp(-0.68 * slender))
    return min(1.0, lobes * central_film(scene, ratio=1.0) / central_film(scene))


def inlet_heating(scene):
    """Thermal factor 1/(1 + 0.213 (1 + 2.23 S^0.83) Q^0.64), Q = beta eta0 u_m^2/k, beta = -d ln eta/d Gamma, S = |SRR|.

    After Gupta et al. 1992, from memory and without their factor of the load: films under high loads agree better without it.
    """
    o = scene.operation
    return _inlet_factor(scene.oil, o.temperature, o.u_m, abs(o.u_s / o.u_m))


@functools.lru_cache(maxsize=64)
def _inlet_factor(oil, Gamma, u_m, S):
    """The thermal factor of :func:`inlet_heating` at the inlet temperature Gamma (deg C)."""
    below, above = (ln_eta(oil, 0.0, Gamma + part) for part in (-0.5, 0.5))
    Q = max(below - above, 0.0) * math.exp(ln_eta(oil, 0.0, Gamma)) * u_m**2 / conductivity(oil, 0.0)
    return 1 / (1 + 0.213 * (1 + 2.23 * S**0.83) * Q**0.64)


def inlet_is_warm(scene):
    """Whether inlet shear heating reduces the film noticeably."""
    return 1 - inlet_heating(scene) > NOTICED


def heat_words(scene):
    """Text about an omitted energy equation: the reduction of the film by inlet shear heating if it is noticeable, else ""."""
    less = f"{1 - inlet_heating(scene):.0%}"
    return f"; by formula inlet shear heating alone reduces h_c by {less}" if inlet_is_warm(scene) else ""


@functools.lru_cache(maxsize=64)
def pressure_coefficient(oil, Gamma):
    """Coefficient alpha* (1/Pa) = 1 / int eta0/eta dp, on which films depend for any viscosity law (Blok 1963).

    For the gear oil it is 1.15e-8; its slope at the inlet is 1.37e-8.
    """
    fluidity = np.exp(ln_eta(oil, 0.0, Gamma) - ln_eta(oil, PRESSURES, Gamma) + 0 * PRESSURES)  # of constant oil, too
    return 1 / float(np.trapezoid(fluidity, PRESSURES))


def nijenbanning(M, L, ratio=1.0):
    """Central film of an elliptic contact in Moes units, all regimes (Nijenbanning, Venner & Moes 1994); ratio: R_x/R_y, 1 for
    a circle. Towards lines (ratio 0) its asymptotes scale as those of :func:`moes_line` with the largest load per width.
    """
    wide = 1 + 0.006 * math.log(ratio) + 0.63 * ratio ** (4 / 7)
    H_RI = 145 * (1 + 0.796 * ratio ** (14 / 15)) ** (-15 / 7) / ratio * M**-2.0
    H_RP = 1.29 * (1 + 0.691 * ratio) ** (-2 / 3) * L ** (2 / 3)
    H_EI = 3.18 * wide ** (-14 / 25) * ratio ** (-1 / 15) * M ** (-2 / 15)
    H_EP = 1.48 * wide ** (-7 / 20) * ratio ** (-1 / 24) * M ** (-1 / 12) * L**0.75
    s = 1.5 * (1 + math.exp(-1.2 * H_EI / H_EP))
    iso = (H_RI**1.5 + (H_EI**-4 + (1.8 / ratio) ** -4) ** (-3 / 8)) ** (2 * s / 3)
    return (iso + (H_RP**-8 + H_EP**-8) ** (-s / 8)) ** (1 / s)


def moes_line(M, L):
    """Film of a line contact in Moes units from the four asymptotes (Venner 1991, after Moes)."""
    H_RI, H_RP = 3 / M, 1.287 * L ** (2 / 3)
    H_EI, H_EP = 2.621 * M ** (-1 / 5), 1.311 * M ** (-1 / 8) * L**0.75
    s = (7 + 8 * math.exp(-2 * H_EI / H_RI)) / 5
    iso = (H_RI ** (7 / 3) + H_EI ** (7 / 3)) ** (3 * s / 7)
    return (iso + (H_RP**-3.5 + H_EP**-3.5) ** (-2 * s / 7)) ** (1 / s)


def moes_numbers(load, R, E, eta0, alpha, u_m, kind="line"):
    """Moes numbers (M, L) with U = 2 eta0 u_m/(E' R')."""
    U = 2 * eta0 * u_m / (E * R)
    L = alpha * E * U**0.25
    return (load / (E * R) * U**-0.5 if kind == "line" else load / (E * R**2) * U**-0.75), L
