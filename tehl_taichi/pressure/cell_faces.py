"""Poiseuille flow between two neighbouring nodes and its derivatives.

Mobility of the face: log-mean of 1/eta, geometric mean of rho, and of H^3 the :func:`cube`.
"""

from tehl_taichi.engine.lanes import V, above, below
from tehl_taichi.engine.language import ti
from tehl_taichi.pressure.fields import DLE, DRP, GAP, IE, LE, ROOT, P


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
def flux_x(S: ti.template(), k):
    return flux(node(S, k, 0, 0), node(S, k + 1, 0, 0))


@ti.func
def net_flux_y(S: ti.template(), k, n2, up, down):
    here = node(S, k, n2, 0)
    return up * flux(here, node(S, k, n2, 1)) - down * flux(node(S, k, n2, -1), here)


@ti.func
def linear_face(a, da, b, db):
    """The Face between the Nodes a and b with their Slopes."""
    mean, mean_0, mean_1 = log_mean(a.le, b.le, a.ie, b.ie)
    c, c0, c1 = cube(a.gap, b.gap)
    g, r, m = b.p - a.p, a.root * b.root, a.root * b.root * c
    eps = m * mean
    return Face(p0=g * (c * b.root * da.root * mean - m * mean_0 * da.le) - eps,
                p1=g * (c * a.root * db.root * mean - m * mean_1 * db.le) + eps,
                h0=g * (r * c0 * mean - m * mean_0 * da.le_h), h1=g * (r * c1 * mean - m * mean_1 * db.le_h), eps=eps)


@ti.func
def slopes(S: ti.template(), k, n2, up: ti.template(), thinning: ti.template()):
    """The Slopes at row j + up; thinning: row of d LE/dH, or -1."""
    f = V(0.0)
    if ti.static(thinning >= 0):
        f = beside(S, thinning, k, n2, up)
    return Slopes(le=beside(S, DLE, k, n2, up), root=beside(S, DRP, k, n2, up), le_h=f)


@ti.func
def face_x(S: ti.template(), k, thinning: ti.template()):
    return linear_face(node(S, k, 0, 0), slopes(S, k, 0, 0, thinning), node(S, k + 1, 0, 0), slopes(S, k + 1, 0, 0, thinning))


@ti.func
def face_above(S: ti.template(), k, n2, thinning: ti.template()):
    return linear_face(node(S, k, n2, 0), slopes(S, k, n2, 0, thinning), node(S, k, n2, 1), slopes(S, k, n2, 1, thinning))


@ti.func
def face_below(S: ti.template(), k, n2, thinning: ti.template()):
    return linear_face(node(S, k, n2, -1), slopes(S, k, n2, -1, thinning), node(S, k, n2, 0), slopes(S, k, n2, 0, thinning))
