"""Slope of a saturating flux: between its tangent and its secant, by the flux that the last Newton step expected.

Beyond a small pressure gradient sheared oil flows as a plug along one wall: its flux q(g) is nearly a step function of the
difference g of the pressure, and Newton steps with tangents alone do not converge. As for total variation (Chan, Golub & Mulet
1999), the flux w is a separate unknown with the equation w g/q(g) = g. It is eliminated: the residual is unchanged; the slope
is the tangent if w = q(g) and the secant if w = 0. Figures: docs/decisions/01-sheared-flow.md.
"""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import V

LEAST_FLUX = 1e-30


@ti.dataclass
class Line:
    """Flux as a linear function of the difference g of P at the last linearisation, base + rise g; known: 0 at the first one of
    a solve.
    """

    base: V
    rise: V
    known: ti.f64


@ti.func
def unknown():
    return Line(base=V(0.0), rise=V(0.0), known=0.0)


@ti.func
def share(line, flux, g, bend):
    """Share of the tangent in the slope of the flux; the rest is the secant's. bend: tangent minus secant."""
    out = V(1.0)
    if line.known > 0.0:
        expected = line.base + line.rise * g
        safe = ti.select(ti.abs(flux) > LEAST_FLUX, flux, V(LEAST_FLUX))
        out = ti.select(bend < 0.0, ti.min(ti.max(expected / safe, 0.0), 1.0), out)
    return out
