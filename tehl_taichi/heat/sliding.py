"""Sliding (Couette) part of a column of the film, and the effect of the shear law on it and on the pressure-driven flow."""

from tehl_taichi.engine.elementary import maximum, minimum
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import V
from tehl_taichi.heat.film_tables import NIE
from tehl_taichi.heat.node_table import weight, zeta
from tehl_taichi.laws.rheology import LARGEST
from tehl_taichi.laws.sheared_flow import either, mean_stress, wall_limit, wall_slip
from tehl_taichi.pressure.fluxes import CARRIED, easing
from tehl_taichi.pressure.tractions import against

SMALL = 1e-3  # Pa, of the Newtonian stress: no sliding to speak of
# Of the limiting stress: where the gradient of the pressure puts less on the walls, both are so near their limit that the oil
# slips along both. With one of them alone the hot layer at a crest changes sides from round to round (docs/decisions/15)
CREST = 1e-3


@ti.dataclass
class Couette:
    """The sliding part of a column."""

    e0: V  # int dzeta/eta over 1/eta0
    centre: V  # zeta_c
    newtonian: V  # Pa, size of the stress without a shear law
    sign: V  # of the stress on body a


@ti.dataclass
class Sheared:
    """A column with its shear law."""

    tau: V  # Pa, stress at zeta_c
    along: V  # flow by pressure along the sliding over that of Newtonian oil, without what slips,
    slips: V  # and what slips along a wall,
    across: V  # and across the sliding
    slip: V  # part of the sliding that the oil slips along a wall
    more_x: V  # flow by pressure along the sliding of a film that slips along both walls,
    more_y: V  # and across it


@ti.func
def couette(Z: ti.template(), N: ti.template(), q, h, scene: ti.template()):
    """The Couette part of column q in a film h (m)."""
    nz, e0, e1 = N.shape[1], V(0.0), V(0.0)
    for n in range(nz):
        part = weight(N, n) * Z[NIE, q * nz + n]
        e0 += part
        e1 += zeta(N, n) * part
    newtonian = minimum(ti.abs(scene.u_s) * scene.eta0 / (h * e0), LARGEST)
    return Couette(e0=e0, centre=e1 / e0, newtonian=newtonian, sign=V(against(scene.u_s)))


@ti.func
def wall_stress(col: ti.template(), slope, scene: ti.template()):
    """Wall stress (Pa) by a pressure gradient (Pa/m), for the shear law."""
    return 0.5 * col.h * ti.abs(slope) * scene.strain


@ti.func
def eased(more, col: ti.template(), slope, fluidity, power: ti.template(), scene: ti.template()):
    """Reduced steep part of a flow at a node, consistent with the faces."""
    share = V(1.0)
    if ti.static(power > 1.0):
        carried = more * fluidity * col.h * col.h * ti.abs(slope) / (12.0 * scene.eta0)
        share = easing(maximum(carried / (CARRIED * scene.u_m), 1.0), power)[0]
    return more * share


@ti.func
def flow_across(rheology: ti.template(), y, col: ti.template(), newtonian):
    """Smooth and steep part of the flow across the sliding, for a wall stress y."""
    smooth, steep = either(rheology, False, y * col.skew, y, newtonian, col.p)
    return smooth[0], steep[0]


@ti.func
def flow_along(rheology: ti.template(), x, col: ti.template(), newtonian, scene: ti.template()):
    """Smooth and steep part of the flow along the sliding; equal to that across it while walls carry any stress
    (:func:`tehl_taichi.pressure.fluxes.yielding`).
    """
    smooth, steep = V(0.0), V(0.0)
    if scene.strain > 0.0:
        exact = either(rheology, True, x * col.skew, x, newtonian, col.p)
        smooth, steep = exact[0][0], exact[1][0]
    else:
        smooth, steep = flow_across(rheology, x, col, newtonian)
    return smooth, steep


@ti.func
def crest(rheology: ti.template(), p):
    """Wall stress by the pressure gradient (Pa) below which the oil slips along both walls."""
    limit = wall_limit(rheology, p)
    return ti.select(limit < LARGEST, CREST * limit, V(0.0))


@ti.func
def slipping(rheology: ti.template(), x, skew, newtonian, p):
    """Part of the sliding that is wall slip, for a wall stress x (Pa) by the pressure gradient."""
    return wall_slip(rheology, maximum(x, crest(rheology, p)) * skew, newtonian, p)


@ti.func
def sheared(rheology: ti.template(), col: ti.template(), couette: ti.template(), scene: ti.template()):
    """The Sheared of a column; col: its p, h, px, py, skew."""
    newtonian, fluidity = couette.newtonian, couette.e0 * col.skew
    x, y = wall_stress(col, col.px, scene), wall_stress(col, col.py, scene)
    slip = slipping(rheology, x, col.skew, newtonian, col.p)
    along, steep_x = flow_along(rheology, x, col, newtonian, scene)
    across, steep_y = flow_across(rheology, y, col, newtonian)
    slips = minimum(3.0 * slip * newtonian / maximum(x * col.skew, SMALL), along)
    more_x = eased(steep_x, col, col.px, fluidity, rheology.power, scene)
    more_y = eased(steep_y, col, col.py, fluidity, rheology.power, scene)
    tau = mean_stress(rheology, x * col.skew, newtonian, col.p)
    return Sheared(tau=tau, along=along - slips, slips=slips, across=across, slip=slip, more_x=more_x, more_y=more_y)
