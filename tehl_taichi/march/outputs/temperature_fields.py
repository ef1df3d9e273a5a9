"""Temperatures of the film and of both surfaces, in thermal scenes."""

from tehl_taichi.heat.chebyshev import largest
from tehl_taichi.march.step_output import Field, Scalar, thermal

ENERGY = "energy equation across the film (heat/energy)"
CONDUCTION = "conduction into the moving bodies (heat/bodies)"


def across(scene):
    """Whether profiles across the film are stored."""
    return thermal(scene) and scene.output.profiles


MID = Field(name="temperature_mid", unit="degC", says="mid-film temperature", source=ENERGY, exists=thermal,
            of=lambda s: s.T[len(s.T) // 2], by_hand=570.0)
SURFACE_A = Field(name="temperature_a", unit="degC", says="temperature of surface a", source=CONDUCTION, exists=thermal,
                  of=lambda s: s.T[0], by_hand=547.0)
SURFACE_B = Field(name="temperature_b", unit="degC", says="temperature of surface b", source=CONDUCTION, exists=thermal,
                  of=lambda s: s.T[-1], by_hand=545.0)
PROFILE = Field(name="temperature", unit="degC", says="temperature across the film", source=ENERGY, exists=across,
                dims=("x", "y", "zeta"), of=lambda s: s.T.transpose(1, 2, 0), by_hand=1662.0)
FILM_MAX = Scalar(name="film_max_C", unit="degC", says="largest film temperature", over="maximum", exists=thermal,
                  source="the polynomials through the nodes: the hottest place lies between them (heat/across)",
                  of=lambda s: largest(s.T), by_hand=110 + 0.25 / 62)
A_MAX = Scalar(name="surface_a_max_C", unit="degC", says="largest temperature of surface a", over="maximum", exists=thermal,
               source=CONDUCTION, of=lambda s: s.T[0].max(), by_hand=95.0)
B_MAX = Scalar(name="surface_b_max_C", unit="degC", says="largest temperature of surface b", over="maximum", exists=thermal,
               source=CONDUCTION, of=lambda s: s.T[-1].max(), by_hand=94.0)
