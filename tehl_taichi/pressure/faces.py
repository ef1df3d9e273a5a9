"""Poiseuille flow between two neighbouring nodes and its derivatives.

Mobility of the face: log-mean of 1/eta, geometric mean of rho, and of H^3 the :func:`cube`.
"""

import taichi as ti

from tehl_taichi.engine.lanes import V, above, below
from tehl_taichi.pressure.fields import DLE, DRP, GAP, IE, LE, ROOT, P


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
    """P, ln eta, 1/eta, root of rho, film at row j + up."""
    return (beside(S, P, k, n2, up), beside(S, LE, k, n2, up), beside(S, IE, k, n2, up), beside(S, ROOT, k, n2, up),
            beside(S, GAP, k, n2, up))


@ti.func
def flux(p0, l0, e0, r0, h0, p1, l1, e1, r1, h1):
    """Poiseuille flux between two nodes, times the distance."""
    return r0 * r1 * cube(h0, h1)[0] * log_mean(l0, l1, e0, e1)[0] * (p1 - p0)


@ti.func
def flux_x(S: ti.template(), k):
    return flux(*node(S, k, 0, 0), *node(S, k + 1, 0, 0))


@ti.func
def net_flux_y(S: ti.template(), k, n2, up, down):
    here = node(S, k, n2, 0)
    return up * flux(*here, *node(S, k, n2, 1)) - down * flux(*node(S, k, n2, -1), *here)


@ti.func
def linear_face(p0, l0, e0, r0, h0, dl0, dr0, f0, p1, l1, e1, r1, h1, dl1, dr1, f1):
    """Linearised flux between two nodes: derivatives in P0, P1, H0, H1 and the frozen mobility, times the distance."""
    mean, mean_0, mean_1 = log_mean(l0, l1, e0, e1)
    c, c0, c1 = cube(h0, h1)
    g, r, m = p1 - p0, r0 * r1, r0 * r1 * c
    eps = m * mean
    by_p0, by_p1 = g * (c * r1 * dr0 * mean - m * mean_0 * dl0) - eps, g * (c * r0 * dr1 * mean - m * mean_1 * dl1) + eps
    by_h0, by_h1 = g * (r * c0 * mean - m * mean_0 * f0), g * (r * c1 * mean - m * mean_1 * f1)
    return by_p0, by_p1, by_h0, by_h1, eps


@ti.func
def linear_node(S: ti.template(), k, n2, up: ti.template(), thinning: ti.template()):
    """:func:`node` and the derivatives of ln eta and of the root of rho by P, and of ln eta by H (row `thinning`, or none)."""
    f = V(0.0)
    if ti.static(thinning >= 0):
        f = beside(S, thinning, k, n2, up)
    p, l, e, r, h = node(S, k, n2, up)
    return p, l, e, r, h, beside(S, DLE, k, n2, up), beside(S, DRP, k, n2, up), f


@ti.func
def face_x(S: ti.template(), k, thinning: ti.template()):
    return linear_face(*linear_node(S, k, 0, 0, thinning), *linear_node(S, k + 1, 0, 0, thinning))


@ti.func
def face_above(S: ti.template(), k, n2, thinning: ti.template()):
    return linear_face(*linear_node(S, k, n2, 0, thinning), *linear_node(S, k, n2, 1, thinning))


@ti.func
def face_below(S: ti.template(), k, n2, thinning: ti.template()):
    return linear_face(*linear_node(S, k, n2, -1, thinning), *linear_node(S, k, n2, 0, thinning))
