"""The sliding (Couette) part of a column of the film, and what the shear law makes of it and of the flow by pressure."""

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
    """A column as its shear law has it."""

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
    """Stress on the walls by a gradient (Pa/m) of the pressure, as the shear law sees it, Pa."""
    return 0.5 * col.h * ti.abs(slope) * scene.strain


@ti.func
def eased(more, col: ti.template(), slope, fluidity, power: ti.template(), scene: ti.template()):
    """What is left at a node of the steep rest of a flow, as the faces ease it."""
    share = V(1.0)
    if ti.static(power > 1.0):
        carried = more * fluidity * col.h * col.h * ti.abs(slope) / (12.0 * scene.eta0)
        share = easing(maximum(carried / (CARRIED * scene.u_m), 1.0), power)[0]
    return more * share


@ti.func
def flow_across(rheology: ti.template(), y, col: ti.template(), newtonian):
    """Smooth and steep part of the flow across the sliding by a stress y on the walls."""
    smooth, steep = either(rheology, False, y * col.skew, y, newtonian, col.p)
    return smooth[0], steep[0]


@ti.func
def flow_along(rheology: ti.template(), x, col: ti.template(), newtonian, scene: ti.template()):
    """Flow along the sliding; as across it where walls carry all (:func:`tehl_taichi.pressure.fluxes.yielding`)."""
    smooth, steep = V(0.0), V(0.0)
    if scene.strain > 0.0:
        exact = either(rheology, True, x * col.skew, x, newtonian, col.p)
        smooth, steep = exact[0][0], exact[1][0]
    else:
        smooth, steep = flow_across(rheology, x, col, newtonian)
    return smooth, steep


@ti.func
def crest(rheology: ti.template(), p):
    """Stress on the walls by the gradient of the pressure, Pa, below which the oil slips along both."""
    limit = wall_limit(rheology, p)
    return ti.select(limit < LARGEST, CREST * limit, V(0.0))


@ti.func
def slipping(rheology: ti.template(), x, skew, newtonian, p):
    """Part of the sliding that the oil slips along walls on which the gradient of the pressure puts x (Pa)."""
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
