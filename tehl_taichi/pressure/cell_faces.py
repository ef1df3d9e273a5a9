"""Poiseuille flow between two neighbouring nodes and its derivatives.

Mobility of the face: log-mean of 1/eta, geometric mean of rho, and of H^3 the :func:`cube`; times what the shear law makes of
it under the stress that the gradient along the face puts on the walls (that of each direction by itself).
"""

from tehl_taichi.engine.lanes import V, above, below
from tehl_taichi.engine.language import ti
from tehl_taichi.physics.rheology import poiseuille, poiseuille_slopes
from tehl_taichi.pressure.fields import DLE, DRP, DX, DY, GAP, IE, LE, P_H, ROOT, WALL, P

NEGLIGIBLE = 1e-9  # more flow by a shear law, nearly everywhere: its slopes are not worth finding (6 % of a step)
# What a film carries by pressure, over what its walls carry at the mean speed, up to which walls yield by their law (`eased`).
# Krylov iterations a step, gear isothermal on 512x128, SRR -0.12, 0.12, 0: with 1 16.2, 16.2, 14.4, here 15.8, 15.3, 13.9;
# as its asperity leaves in rolling (0.8 to 1.2 a) on 1024x32 26.6, here 18.7, with 0.02 15.6. Largest pressures change by
# 3e-4 at most (1D, 256 to 2048 columns), with 0.02 by 1 %. By the law alone 37 iterations at SRR 0.12 (512x128)
CARRIED = 0.1


@ti.dataclass
class Node:
    """What the flow feels at a node."""

    p: V  # pressure
    le: V  # ln eta
    ie: V  # exp(-le)
    root: V  # root of rho / lambda
    gap: V  # film, at least the floor


@ti.dataclass
class Slopes:
    """Derivatives at a node."""

    le: V  # d le/dP
    root: V  # d root/dP
    le_h: V  # d le/dH


@ti.dataclass
class Wall:
    """Of a level and a direction: Pa on both walls of a film H = 1 by a difference of P of 1, Pa of P = 1, and the distance of
    the nodes."""

    stress: ti.f64
    p_H: ti.f64
    distance: ti.f64


@ti.dataclass
class Face:
    """The linearised flux between two nodes, times the distance."""

    p0: V  # its derivatives by the pressure of both,
    p1: V
    h0: V  # and by the film of both
    h1: V
    eps: V  # the mobility


@ti.func
def log_mean(l0, l1, e0, e1):
    """Logarithmic mean of 1/eta between two nodes, l = ln eta, e = exp(-l), and minus its derivatives by l0 and l1."""
    d = l1 - l0
    near = ti.abs(d) < 1e-3
    safe = ti.select(near, V(1.0), d)
    mean = ti.select(near, e0 * (1 - d / 2 + d * d / 6), (e0 - e1) / safe)
    return mean, ti.select(near, 0.5 * e0, (e0 - mean) / safe), ti.select(near, 0.5 * e1, (mean - e1) / safe)


@ti.func
def cube(h0, h1):
    """Mean of H^3 between two nodes, and its derivatives by both: with g = (h0 + h1)/2 and s = ((h1 - h0)/(h0 + h1))^2

    g^3 ((1 - s)^2 + 4 s^3).

    The first term is exact where the flux is constant and H linear between the nodes (int dX/H^2 and int dX/H^3 of them). The
    second lifts it to the arithmetic mean, g^3 (1 + 3 s), where the grid does not resolve the gap: without it nothing holds
    back what the Couette part takes in there, and there may be no solution. (s = 1/4: one film three times the other.)
    """
    g, e = 0.5 * (h0 + h1), (h1 - h0) / (h0 + h1)
    s = e * e
    f, slope = (1.0 - s) * (1.0 - s) + 4.0 * s * s * s, (12.0 * s + 2.0) * s - 2.0
    return g * g * g * f, g * g * (1.5 * f - slope * e * (1.0 + e)), g * g * (1.5 * f + slope * e * (1.0 - e))


@ti.func
def beside(S: ti.template(), row: ti.template(), k, n2, up: ti.template()):
    """Field at row j + up of the lanes (up = -1, 0, 1)."""
    out = S[row, k]
    if ti.static(up == 1):
        out = above(S, row, k, n2)
    elif ti.static(up == -1):
        out = below(S, row, k, n2)
    return out


@ti.func
def node(S: ti.template(), k, n2, up: ti.template()):
    """The Node at row j + up."""
    return Node(p=beside(S, P, k, n2, up), le=beside(S, LE, k, n2, up), ie=beside(S, IE, k, n2, up),
                root=beside(S, ROOT, k, n2, up), gap=beside(S, GAP, k, n2, up))


@ti.func
def mobility(a):
    """Of the oil at the Node a."""
    return a.root * a.root * a.gap * a.gap * a.gap * a.ie


@ti.func
def flux(a, b):
    """Poiseuille flux between the Nodes a and b, times the distance."""
    return a.root * b.root * cube(a.gap, b.gap)[0] * log_mean(a.le, b.le, a.ie, b.ie)[0] * (b.p - a.p)


@ti.func
def wall_x(G: ti.template(), l):
    """The Wall of level l along x."""
    return Wall(stress=G[l, WALL], p_H=G[l, P_H], distance=G[l, DX])


@ti.func
def wall_y(G: ti.template(), l):
    """The Wall of level l along y."""
    return Wall(stress=G[l, WALL] * G[l, DX] / G[l, DY], p_H=G[l, P_H], distance=G[l, DY])


@ti.func
def strain(a, b, wall):
    """Stress on the walls and pressure at the face, Pa."""
    return wall.stress * 0.5 * (a.gap + b.gap) * ti.abs(b.p - a.p), 0.5 * wall.p_H * (a.p + b.p)


@ti.func
def eased(a, b, wall, q, power: ti.template()):
    """Where walls carry q ~ stress^power beyond Newtonian oil, beyond CARRIED it is in proportion to the stress.

    By the law alone a front that is a tenth too steep carries forty times too much, and Newton steps take a fortieth off it.
    Returns what this makes of q as a factor, of its derivatives, and of it by the logarithm of the film.
    """
    share, own, by_film = V(1.0), V(1.0), V(0.0)
    if ti.static(power > 1.0):
        over = ti.max(ti.abs(q) / (CARRIED * wall.distance * 0.5 * (a.gap + b.gap)), 1.0)
        if over.max() > 1.0:
            stress = ti.exp(ti.log(over) / power)
            carried = 1.0 + power * (stress - 1.0)
            share, own, by_film = carried / over, stress / over, (carried - stress) / over
    return share, own, by_film


@ti.func
def driven(a, b, rheology: ti.template(), wall):
    """The :func:`flux` of oil with a shear law."""
    out = flux(a, b)
    if ti.static(rheology.thins):
        more = out * (poiseuille(rheology, *strain(a, b, wall)) - 1.0)
        out += more * eased(a, b, wall, more, rheology.power)[0]
    return out


@ti.func
def flux_x(S: ti.template(), k):
    return flux(node(S, k, 0, 0), node(S, k + 1, 0, 0))


@ti.func
def driven_x(S: ti.template(), k, rheology: ti.template(), wall: ti.template()):
    return driven(node(S, k, 0, 0), node(S, k + 1, 0, 0), rheology, wall)


@ti.func
def net_driven_y(S: ti.template(), k, n2, up, down, rheology: ti.template(), wall: ti.template()):
    here = node(S, k, n2, 0)
    above_it, below_it = node(S, k, n2, 1), node(S, k, n2, -1)
    return up * driven(here, above_it, rheology, wall) - down * driven(below_it, here, rheology, wall)


@ti.func
def linear_face(a, da, b, db, rheology: ti.template(), wall):
    """The Face between the Nodes a and b with their Slopes."""
    mean, mean_0, mean_1 = log_mean(a.le, b.le, a.ie, b.ie)
    c, c0, c1 = cube(a.gap, b.gap)
    g, r, m = b.p - a.p, a.root * b.root, a.root * b.root * c
    eps, along, by_p, by_h = m * mean, g, V(0.0), V(0.0)
    if ti.static(rheology.thins):  # along: g times what the law makes of the flow
        stress, p = strain(a, b, wall)
        law = poiseuille(rheology, stress, p)
        if (law - 1.0).max() > NEGLIGIBLE:
            rise, slope = poiseuille_slopes(rheology, stress, p, law)
            _, own, by_film = eased(a, b, wall, eps * g * (law - 1.0), rheology.power)
            along, by_p = g * (1.0 + own * (law - 1.0)), eps * g * own * slope * 0.5 * wall.p_H
            by_h = eps * g * (own * rise + by_film * (law - 1.0)) / (a.gap + b.gap)
            eps *= 1.0 + own * (law - 1.0 + rise)
    return Face(p0=along * (c * b.root * da.root * mean - m * mean_0 * da.le) - eps + by_p,
                p1=along * (c * a.root * db.root * mean - m * mean_1 * db.le) + eps + by_p,
                h0=along * (r * c0 * mean - m * mean_0 * da.le_h) + by_h,
                h1=along * (r * c1 * mean - m * mean_1 * db.le_h) + by_h, eps=eps)


@ti.func
def slopes(S: ti.template(), k, n2, up: ti.template(), thinning: ti.template()):
    """The Slopes at row j + up; thinning: row of d LE/dH, or -1."""
    f = V(0.0)
    if ti.static(thinning >= 0):
        f = beside(S, thinning, k, n2, up)
    return Slopes(le=beside(S, DLE, k, n2, up), root=beside(S, DRP, k, n2, up), le_h=f)


@ti.func
def face_x(S: ti.template(), k, thinning: ti.template(), rheology: ti.template(), wall: ti.template()):
    return linear_face(node(S, k, 0, 0), slopes(S, k, 0, 0, thinning), node(S, k + 1, 0, 0), slopes(S, k + 1, 0, 0, thinning),
                       rheology, wall)


@ti.func
def face_above(S: ti.template(), k, n2, thinning: ti.template(), rheology: ti.template(), wall: ti.template()):
    return linear_face(node(S, k, n2, 0), slopes(S, k, n2, 0, thinning), node(S, k, n2, 1), slopes(S, k, n2, 1, thinning),
                       rheology, wall)


@ti.func
def face_below(S: ti.template(), k, n2, thinning: ti.template(), rheology: ti.template(), wall: ti.template()):
    return linear_face(node(S, k, n2, -1), slopes(S, k, n2, -1, thinning), node(S, k, n2, 0), slopes(S, k, n2, 0, thinning),
                       rheology, wall)
