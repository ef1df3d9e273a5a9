"""Findley search: for every material point the plane with the largest tau_amp + kappa sigma_n,max over its history.

tau_amp = radius of the smallest circle around the path of the shear vector on the plane, exact, by pivoting: start from
the farthest pair seen, add the farthest point outside until none is left (3 to 4 passes a plane).
"""

import taichi as ti

History = ti.types.ndarray(dtype=ti.f64, ndim=3)
Table = ti.types.ndarray(dtype=ti.f64, ndim=2)

PASSES = 60  # far above the 3 to 4 that occur; bounds the loop for any input
INSIDE = 1 + 1e-12  # a point this close to the circle counts as inside (f64)
LAST_STEP = 1e-5  # rad, end of the refinement; the error is of second order in it


@ti.func
def normal(theta, phi):
    return ti.Vector([ti.sin(theta) * ti.cos(phi), ti.sin(theta) * ti.sin(phi), ti.cos(theta)])


@ti.func
def through_three(ax, ay, bx, by, cx, cy):
    """Centre and squared radius of the circle through three points (squared radius -1: on a line)."""
    ux, uy, vx, vy = bx - ax, by - ay, cx - ax, cy - ay
    d = 2 * (ux * vy - uy * vx)
    out = ti.Vector([0.0, 0.0, -1.0])
    if abs(d) > 1e-14 * (ux * ux + uy * uy + vx * vx + vy * vy):
        u2, v2 = ux * ux + uy * uy, vx * vx + vy * vy
        x, y = (vy * u2 - uy * v2) / d, (ux * v2 - vx * u2) / d
        out = ti.Vector([ax + x, ay + y, x * x + y * y])
    return out


@ti.func
def outside(c, x, y):
    return (x - c[0]) ** 2 + (y - c[1]) ** 2 > c[2] * INSIDE + 1e-300


@ti.func
def grow(sx, sy, count, x, y):
    """Smallest circle of the support (up to 3 points) and the new point on its rim; the new support with it."""
    best = ti.Vector([0.0, 0.0, -1.0])
    i0, i1 = -1, -1
    for i in ti.static(range(3)):
        if i < count:
            c = ti.Vector([0.5 * (sx[i] + x), 0.5 * (sy[i] + y), 0.25 * ((sx[i] - x) ** 2 + (sy[i] - y) ** 2)])
            holds = True
            for m in ti.static(range(3)):
                if m < count and outside(c, sx[m], sy[m]):
                    holds = False
            if holds and (best[2] < 0 or c[2] < best[2]):
                best, i0, i1 = c, i, -1
    if best[2] < 0:
        for i in ti.static(range(3)):
            for j in ti.static(range(i + 1, 3)):
                if j < count:
                    c = through_three(sx[i], sy[i], sx[j], sy[j], x, y)
                    holds = c[2] >= 0
                    for m in ti.static(range(3)):
                        if m < count and m != i and m != j and outside(c, sx[m], sy[m]):
                            holds = False
                    if holds and (best[2] < 0 or c[2] < best[2]):
                        best, i0, i1 = c, i, j
    return best, i0, i1


@ti.func
def radius(U: ti.template(), V: ti.template(), p, steps):
    """Radius of the smallest circle around the points (U[p, t], V[p, t])."""
    sx, sy = ti.Vector([U[p, 0], 0.0, 0.0]), ti.Vector([V[p, 0], 0.0, 0.0])
    count = 1
    c = ti.Vector([U[p, 0], V[p, 0], 0.0])
    going = 1
    for _ in range(PASSES):
        if going == 1:
            far, at = -1.0, 0
            for t in range(steps):
                d = (U[p, t] - c[0]) ** 2 + (V[p, t] - c[1]) ** 2
                if d > far:
                    far, at = d, t
            if far <= c[2] * INSIDE + 1e-300:
                going = 0
            else:
                x, y = U[p, at], V[p, at]
                new, i0, i1 = grow(sx, sy, count, x, y)
                if i0 < 0:
                    going = 0
                else:
                    ax, ay = 0.0, 0.0
                    bx, by = 0.0, 0.0
                    for m in ti.static(range(3)):
                        if m == i0:
                            ax, ay = sx[m], sy[m]
                        if m == i1:
                            bx, by = sx[m], sy[m]
                    c = new
                    count = 2 if i1 < 0 else 3
                    sx, sy = ti.Vector([ax, x, bx]), ti.Vector([ay, y, by])
    return ti.sqrt(ti.max(c[2], 0.0))


@ti.func
def on_plane(S: ti.template(), U: ti.template(), V: ti.template(), p, steps, theta, phi, kappa, best, prune):
    """tau_amp + kappa sigma_n,max on one plane; -1e300 if it cannot beat `best` (bound: half the box diagonal)."""
    n = normal(theta, phi)
    u = ti.Vector([ti.cos(theta) * ti.cos(phi), ti.cos(theta) * ti.sin(phi), -ti.sin(theta)])
    v = ti.Vector([-ti.sin(phi), ti.cos(phi), 0.0])
    top, u0, u1, v0, v1 = -1e300, 1e300, -1e300, 1e300, -1e300
    for t in range(steps):
        xx, yy, zz, xy, xz, yz = S[p, t, 0], S[p, t, 1], S[p, t, 2], S[p, t, 3], S[p, t, 4], S[p, t, 5]
        tx, ty, tz = xx * n[0] + xy * n[1] + xz * n[2], xy * n[0] + yy * n[1] + yz * n[2], xz * n[0] + yz * n[1] + zz * n[2]
        a, b = tx * u[0] + ty * u[1] + tz * u[2], tx * v[0] + ty * v[1] + tz * v[2]
        U[p, t], V[p, t] = a, b
        top = ti.max(top, tx * n[0] + ty * n[1] + tz * n[2])
        u0, u1, v0, v1 = ti.min(u0, a), ti.max(u1, a), ti.min(v0, b), ti.max(v1, b)
    out = -1e300
    if prune == 0 or 0.5 * ti.sqrt((u1 - u0) ** 2 + (v1 - v0) ** 2) + kappa * top > best:
        out = radius(U, V, p, steps) + kappa * top
    return out


@ti.kernel
def search(S: History, planes: Table, U: Table, V: Table, kappa: ti.f64, first_step: ti.f64, prune: ti.i32,
           out: Table):
    """out[p] = (largest tau_amp + kappa sigma_n,max, theta, phi) of point p.

    S[p, t, 6]: xx yy zz xy xz yz; planes[m] = (theta, phi) of the normals on a hemisphere about z, then a pattern
    search (8 neighbours, step halved down to 1e-5 rad) from the best one; U, V: scratch (points, steps).
    """
    for p in range(S.shape[0]):
        steps = S.shape[1]
        best, theta, phi = -1e299, 0.0, 0.0
        for m in range(planes.shape[0]):
            f = on_plane(S, U, V, p, steps, planes[m, 0], planes[m, 1], kappa, best, prune)
            if f > best:
                best, theta, phi = f, planes[m, 0], planes[m, 1]
        step = first_step
        while step > LAST_STEP:
            t0, p0, moved = theta, phi, 0
            wide = step / ti.max(ti.sin(t0), 0.1)
            for k in range(9):
                a, b = t0 + (k // 3 - 1) * step, p0 + (k % 3 - 1) * wide
                f = on_plane(S, U, V, p, steps, a, b, kappa, best, prune)
                if f > best:
                    best, theta, phi, moved = f, a, b, 1
            if moved == 0:
                step *= 0.5
        out[p, 0], out[p, 1], out[p, 2] = best, theta, phi
