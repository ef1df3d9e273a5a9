"""Poiseuille flow between two neighbouring nodes, and its derivatives.

Mobility of the face: log-mean of 1/eta, geometric mean of rho, and of H^3 the :func:`cube`, times the factor of the shear law
(:mod:`tehl_taichi.laws.sheared_flow`). That factor depends on the wall stress by the pressure gradient, for each direction
separately, and on the Newtonian stress of sliding, with the face's own viscosity and film.
"""

from tehl_taichi.engine.elementary import root
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import V, above, below
from tehl_taichi.laws.sheared_flow import either
from tehl_taichi.pressure.fields import BASE, DLE, DRP, DX, DY, GAP, IE, LE, P_H, RISE, ROOT, SHEAR, WALL, P
from tehl_taichi.pressure.saturation import Line, share, unknown

LARGEST = 1e30  # Pa, Newtonian stress of the sliding: ghosts have no film
SMALLEST = 1e-300
# what a film carries by pressure, over what its walls carry at the mean speed, up to which walls yield by their law (`eased`):
# by the law alone a linear solve takes twice as many iterations (docs/decisions/18)
CARRIED = 0.1


@ti.dataclass
class FlowNode:
    """Values at a node that the flow depends on."""

    p: V  # pressure
    le: V  # ln eta
    ie: V  # exp(-le)
    root: V  # root of rho / lambda
    gap: V  # film, at least the floor
    skew: V  # fluidity for the flow by pressure over that for the sliding: 1 of a film of one viscosity


@ti.dataclass
class Slopes:
    """Derivatives at a node."""

    le: V  # d le/dP
    root: V  # d root/dP
    skew: V  # d skew/dP


@ti.dataclass
class Wall:
    """Scales of a level and a direction: wall stress (Pa) of a film H = 1 for a difference of P of 1; Pa of P = 1; distance of
    the nodes; stress (Pa) of sliding oil at p = 0 in a film H = 1.
    """

    stress: ti.f64
    p_H: ti.f64
    distance: ti.f64
    shear: ti.f64


@ti.dataclass
class Face:
    """The linearised flux between two nodes, times the distance."""

    p0: V  # its derivatives by the pressure of both,
    p1: V
    h0: V  # and by the film of both
    h1: V
    eps: V  # the mobility
    base: V  # the flux less eps times the difference of P


@ti.func
def log_mean(l0, l1, e0, e1):
    """Logarithmic mean of 1/eta between two nodes (l = ln eta, e = exp(-l)), and minus its derivatives by l0 and l1."""
    d = l1 - l0
    near = ti.abs(d) < 1e-3
    safe = ti.select(near, V(1.0), d)
    mean = ti.select(near, e0 * (1 - d / 2 + d * d / 6), (e0 - e1) / safe)
    return mean, ti.select(near, 0.5 * e0, (e0 - mean) / safe), ti.select(near, 0.5 * e1, (mean - e1) / safe)


@ti.func
def cube(h0, h1):
    """Mean of H^3 between two nodes, and its derivatives by both: with g = (h0 + h1)/2 and s = ((h1 - h0)/(h0 + h1))^2

    g^3 ((1 - s)^2 + 4 s^3).

    The first term is exact for a constant flux and linear H between the nodes (int dX/H^2 and int dX/H^3). The second raises it
    to the arithmetic mean, g^3 (1 + 3 s), if the grid does not resolve the gap: without it nothing limits the inflow by the
    Couette part there, and a solution may not exist. (s = 1/4: one film three times the other.)
    """
    g, e = 0.5 * (h0 + h1), (h1 - h0) / (h0 + h1)
    s = e * e
    f, slope = (1.0 - s) * (1.0 - s) + 4.0 * s * s * s, (12.0 * s + 2.0) * s - 2.0
    return g * g * g * f, g * g * (1.5 * f - slope * e * (1.0 + e)), g * g * (1.5 * f + slope * e * (1.0 - e))


@ti.func
def neighbour_row(S: ti.template(), row: ti.template(), k, n2, up: ti.template()):
    """Field at row j + up of the lanes (up = -1, 0, 1)."""
    out = S[row, k]
    if ti.static(up == 1):
        out = above(S, row, k, n2)
    elif ti.static(up == -1):
        out = below(S, row, k, n2)
    return out


@ti.func
def node(S: ti.template(), k, n2, up: ti.template(), skew: ti.template()):
    """The FlowNode at row j + up; skew: its row, or -1 for a film with one viscosity."""
    f = V(1.0)
    if ti.static(skew >= 0):
        f = neighbour_row(S, skew, k, n2, up)
    return FlowNode(p=neighbour_row(S, P, k, n2, up), le=neighbour_row(S, LE, k, n2, up), ie=neighbour_row(S, IE, k, n2, up),
                root=neighbour_row(S, ROOT, k, n2, up), gap=neighbour_row(S, GAP, k, n2, up), skew=f)


@ti.func
def mobility(a):
    """Mobility of the oil at the FlowNode a."""
    return a.root * a.root * a.gap * a.gap * a.gap * a.ie


@ti.func
def flux(a, b):
    """Poiseuille flux between the nodes a and b, times their distance."""
    return a.root * b.root * cube(a.gap, b.gap)[0] * log_mean(a.le, b.le, a.ie, b.ie)[0] * (b.p - a.p)


@ti.func
def wall_x(G: ti.template(), l):
    """The Wall of level l along x."""
    return Wall(stress=G[l, WALL], p_H=G[l, P_H], distance=G[l, DX], shear=ti.abs(G[l, SHEAR]))


@ti.func
def wall_y(G: ti.template(), l):
    """The Wall of level l along y."""
    return Wall(stress=G[l, WALL] * G[l, DX] / G[l, DY], p_H=G[l, P_H], distance=G[l, DY], shear=ti.abs(G[l, SHEAR]))


@ti.func
def strain(a, b, mean, wall):
    """Values at the face, Pa: wall stress, pressure, Newtonian stress of sliding (mean: of 1/eta); and the skew."""
    film, skew = 0.5 * (a.gap + b.gap), 0.5 * (a.skew + b.skew)
    sliding = ti.min(wall.shear * skew / ti.max(film * mean, SMALLEST), LARGEST)
    return wall.stress * film * ti.abs(b.p - a.p), 0.5 * wall.p_H * (a.p + b.p), sliding, skew


@ti.dataclass
class LawFlow:
    """Flow by the shear law relative to Newtonian oil, and its derivatives by the logarithms of both stresses and by p."""

    part: V
    strained: V
    slid: V
    by_p: V


@ti.func
def no_flow():
    return LawFlow(part=V(0.0), strained=V(0.0), slid=V(0.0), by_p=V(0.0))


@ti.func
def law_flows(both: ti.template()):
    """Smooth and steep part of :func:`either` as :class:`LawFlow`."""
    return LawFlow(*both[0]), LawFlow(*both[1])


@ti.func
def yielding(rheology: ti.template(), stress, p, sliding, skew, wall, along: ti.template()):
    """Effect of the shear law on the flow along the sliding, or across it: (smooth part, which Newton's method uses fully;
    steep rest).

    In a thermal film a gradient acts on the sliding viscosity divided by `skew`, so that the slip carries at most u_s/2. On the
    way to a start, while walls carry any stress, oil flows along the sliding as across it; otherwise frozen oil, whose slip the
    walls do not limit, would accumulate.
    """
    smooth, steep = no_flow(), no_flow()
    if ti.static(not along):
        smooth, steep = law_flows(either(rheology, False, stress * skew, stress, sliding, p))
    elif wall.stress > 0.0:
        smooth, steep = law_flows(either(rheology, True, stress * skew, stress, sliding, p))
    else:
        smooth, steep = law_flows(either(rheology, False, stress * skew, stress, sliding, p))
    return smooth, steep


@ti.func
def easing(over, power: ti.template()):
    """Factors that continue a wall flow ~ stress^power in proportion to the stress beyond `over` = 1, with continuous slope.

    By the law alone a front that is 10 % too steep carries forty times too much, and Newton steps reduce it by a fortieth.
    Returns the factors of the flow, of its derivatives, and of its derivative by the logarithm of the bound.
    """
    share, own, by_film = V(1.0), V(1.0), V(0.0)
    if over.max() > 1.0:
        stress = root(over, power)
        carried = 1.0 + power * (stress - 1.0)
        share, own, by_film = carried / over, stress / over, (carried - stress) / over
    return share, own, by_film


@ti.func
def eased(a, b, wall, q, power: ti.template()):
    """The :func:`easing` of the wall flow beyond the smooth part."""
    share, own, by_film = V(1.0), V(1.0), V(0.0)
    if ti.static(power > 1.0):
        over = ti.max(ti.abs(q) / (CARRIED * wall.distance * 0.5 * (a.gap + b.gap)), 1.0)
        share, own, by_film = easing(over, power)
    return share, own, by_film


@ti.func
def driven(a, b, rheology: ti.template(), wall, along: ti.template()):
    """Poiseuille :func:`flux` of oil with a shear law."""
    out = flux(a, b)
    if ti.static(rheology.thins):
        stress, p, sliding, skew = strain(a, b, log_mean(a.le, b.le, a.ie, b.ie)[0], wall)
        smooth, steep = yielding(rheology, stress, p, sliding, skew, wall, along)
        more = out * steep.part
        out = out * smooth.part + more * eased(a, b, wall, more, rheology.power)[0]
    return out


@ti.func
def flux_x(S: ti.template(), k):
    return flux(node(S, k, 0, 0, -1), node(S, k + 1, 0, 0, -1))


@ti.func
def driven_x(S: ti.template(), k, skew: ti.template(), rheology: ti.template(), wall: ti.template()):
    return driven(node(S, k, 0, 0, skew), node(S, k + 1, 0, 0, skew), rheology, wall, True)


@ti.func
def net_driven_y(S: ti.template(), k, n2, up, down, skew: ti.template(), rheology: ti.template(), wall: ti.template()):
    here = node(S, k, n2, 0, skew)
    above_it, below_it = node(S, k, n2, 1, skew), node(S, k, n2, -1, skew)
    return up * driven(here, above_it, rheology, wall, False) - down * driven(below_it, here, rheology, wall, False)


@ti.dataclass
class Yield:
    """Flow by a shear law relative to Newtonian oil, and its derivatives."""

    part: V  # the flux over that of Newtonian oil, by the mobility
    along: V  # and by the difference of P
    by_p: V  # of the flux over the mobility: by the pressure of either node,
    by_h: V  # by the film of either,
    by_le: V  # by the mean of 1/eta through the sliding, times that mean,
    by_skew: V  # and by the skew of either


@ti.func
def yield_of(a, b, mean, eps, rheology: ti.template(), wall, along: ti.template()):
    """The Yield of a face of mobility eps, before multiplication by the difference g of P (in by_p to by_skew)."""
    out = Yield(part=V(1.0), along=V(1.0), by_p=V(0.0), by_h=V(0.0), by_le=V(0.0), by_skew=V(0.0))
    if ti.static(rheology.thins):
        stress, p, sliding, skew = strain(a, b, mean, wall)
        smooth, steep = yielding(rheology, stress, p, sliding, skew, wall, along)
        _, own, by_film = eased(a, b, wall, eps * (b.p - a.p) * steep.part, rheology.power)
        part, strained = smooth.part + own * steep.part, smooth.strained + own * steep.strained
        slid = smooth.slid + own * steep.slid
        out = Yield(part=part, along=part + strained, by_p=0.5 * wall.p_H * (smooth.by_p + own * steep.by_p),
                    by_h=(strained - slid + by_film * steep.part) / (a.gap + b.gap), by_le=slid,
                    by_skew=(smooth.strained + slid) / (2.0 * skew))
    return out


@ti.func
def bent(y, line, eps, g, rheology: ti.template(), along: ti.template()):
    """The Yield with the :func:`share` of its bend: along the sliding the walls switch, across it they do not."""
    if ti.static(rheology.thins and along):
        bend = y.along - y.part
        kept = share(line, eps * g * y.part, g, bend)
        y = Yield(part=y.part, along=y.part + kept * bend, by_p=kept * y.by_p, by_h=kept * y.by_h, by_le=kept * y.by_le,
                  by_skew=kept * y.by_skew)
    return y


@ti.func
def linear_face(a, da, b, db, line, rheology: ti.template(), wall, x: ti.template()):
    """The Face between the nodes a and b with their Slopes; line: its last Line; x: it lies along the sliding."""
    mean, mean_0, mean_1 = log_mean(a.le, b.le, a.ie, b.ie)
    c, c0, c1 = cube(a.gap, b.gap)
    g, r, m = b.p - a.p, a.root * b.root, a.root * b.root * c
    eps = m * mean
    y = bent(yield_of(a, b, mean, eps, rheology, wall, x), line, eps, g, rheology, x)
    by_p, by_h, by_mean, along = eps * g * y.by_p, eps * g * y.by_h, m * g * (y.part - y.by_le), g * y.part * mean
    by_skew, carried = eps * g * y.by_skew, eps * y.along
    return Face(p0=along * c * b.root * da.root - by_mean * mean_0 * da.le + by_skew * da.skew + by_p - carried,
                p1=along * c * a.root * db.root - by_mean * mean_1 * db.le + by_skew * db.skew + by_p + carried,
                h0=along * r * c0 + by_h, h1=along * r * c1 + by_h, eps=carried, base=eps * g * y.part - carried * g)


@ti.func
def slopes(S: ti.template(), k, n2, up: ti.template(), skew: ti.template()):
    """The Slopes at row j + up; skew: as in :func:`node`; its slope is in the next row."""
    f = V(0.0)
    if ti.static(skew >= 0):
        f = neighbour_row(S, skew + 1, k, n2, up)
    return Slopes(le=neighbour_row(S, DLE, k, n2, up), root=neighbour_row(S, DRP, k, n2, up), skew=f)


@ti.func
def face_x(S: ti.template(), k, known, skew: ti.template(), rheology: ti.template(), wall: ti.template()):
    """The Face to the right of k; its Line is kept for the next linearisation. known: there is one of this solve."""
    line = unknown()
    if ti.static(rheology.thins):
        line = Line(base=S[BASE, k], rise=S[RISE, k], known=known)
    face = linear_face(node(S, k, 0, 0, skew), slopes(S, k, 0, 0, skew), node(S, k + 1, 0, 0, skew),
                       slopes(S, k + 1, 0, 0, skew), line, rheology, wall, True)
    if ti.static(rheology.thins):
        S[BASE, k], S[RISE, k] = face.base, face.eps
    return face


@ti.func
def face_above(S: ti.template(), k, n2, skew: ti.template(), rheology: ti.template(), wall: ti.template()):
    return linear_face(node(S, k, n2, 0, skew), slopes(S, k, n2, 0, skew), node(S, k, n2, 1, skew),
                       slopes(S, k, n2, 1, skew), unknown(), rheology, wall, False)


@ti.func
def face_below(S: ti.template(), k, n2, skew: ti.template(), rheology: ti.template(), wall: ti.template()):
    return linear_face(node(S, k, n2, -1, skew), slopes(S, k, n2, -1, skew), node(S, k, n2, 0, skew),
                       slopes(S, k, n2, 0, skew), unknown(), rheology, wall, False)
