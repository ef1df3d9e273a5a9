"""Smallest circle around a path of points in a plane, exact, by pivoting (Gaertner 1999)."""

from tehl_taichi.engine.language import ti

PIVOTS = 60   # farthest points added to a circle at most (about 4 are usual)
INSIDE = 1e-12

vec3 = ti.types.vector(3, ti.f64)
ivec3 = ti.types.vector(3, ti.i32)


@ti.func
def circle2(ax, ay, bx, by):
    """Circle (centre x, y, squared radius) with the diameter a-b."""
    ux, uy = 0.5 * (bx - ax), 0.5 * (by - ay)
    return vec3(ax + ux, ay + uy, ux * ux + uy * uy)


@ti.func
def circle3(ax, ay, bx, by, cx, cy):
    """Circle through three points; squared radius -1 if they lie on a line."""
    ux, uy, vx, vy = bx - ax, by - ay, cx - ax, cy - ay
    u2, v2 = ux * ux + uy * uy, vx * vx + vy * vy
    d = 2 * (ux * vy - uy * vx)
    out = vec3(ax, ay, -1.0)
    if ti.abs(d) > 1e-14 * ti.sqrt(u2 * v2):
        x, y = (vy * u2 - uy * v2) / d, (ux * v2 - vx * u2) / d
        out = vec3(ax + x, ay + y, x * x + y * y)
    return out


@ti.func
def inside(c, x, y):
    """Whether the point (x, y) lies in the circle c."""
    return (x - c[0]) ** 2 + (y - c[1]) ** 2 <= c[2] * (1 + INSIDE)


@ti.func
def farthest(a: ti.template(), b: ti.template(), row, steps, c):
    """(index, squared distance) of the point farthest from the centre of c."""
    far, distance = 0, -1.0
    for t in range(steps):
        d = (a[row, t] - c[0]) ** 2 + (b[row, t] - c[1]) ** 2
        if d > distance:
            distance, far = d, t
    return far, distance


@ti.func
def pivot(px, py, m, fx, fy):
    """Smallest circle through an outside point f around m <= 3 points and f: circle and the two other points on it."""
    best = vec3(0.0, 0.0, 1e300)
    bi, bj = -1, -1
    for i in ti.static(range(3)):
        if i < m:
            c = circle2(fx, fy, px[i], py[i])
            good = 1
            for k in ti.static(range(3)):
                if k < m and k != i and not inside(c, px[k], py[k]):
                    good = 0
            if good == 1 and c[2] < best[2]:
                best, bi, bj = c, i, -1
    if bi < 0:
        for i in ti.static(range(3)):
            for j in ti.static(range(i)):
                if i < m:
                    c = circle3(fx, fy, px[i], py[i], px[j], py[j])
                    good = 1
                    for k in ti.static(range(3)):
                        if k < m and k != i and k != j and not inside(c, px[k], py[k]):
                            good = 0
                    if c[2] > 0 and good == 1 and c[2] < best[2]:
                        best, bi, bj = c, i, j
    return best, bi, bj


@ti.func
def enclose(a: ti.template(), b: ti.template(), row, steps, i0, i1):
    """Smallest circle around the points (a, b)[row, :steps]: (radius, points on it, weights of these points).

    The weighted sum of the points is the centre. i0, i1: two distant points to start from.

    Add the farthest point, solve the problem of at most four points exactly, repeat.
    """
    index, px, py = ivec3(i0, i1, i1), vec3(a[row, i0], a[row, i1], 0.0), vec3(b[row, i0], b[row, i1], 0.0)
    m, going, count = 2, 1, 0
    c = circle2(px[0], py[0], px[1], py[1])
    distance = 0.0
    while going == 1:
        far, d = farthest(a, b, row, steps, c)
        going, distance = 0, d
        if count < PIVOTS and d > c[2] * (1 + INSIDE):
            count += 1
            fx, fy = a[row, far], b[row, far]
            best, bi, bj = pivot(px, py, m, fx, fy)
            if bi >= 0 and best[2] > c[2]:
                qx, qy, q = vec3(fx, 0.0, 0.0), vec3(fy, 0.0, 0.0), ivec3(far, far, far)
                for k in ti.static(range(3)):
                    if k == bi:
                        qx[1], qy[1], q[1] = px[k], py[k], index[k]
                    if k == bj:
                        qx[2], qy[2], q[2] = px[k], py[k], index[k]
                px, py, index, c = qx, qy, q, best
                m = 3 if bj >= 0 else 2
                going = 1
    return ti.sqrt(ti.max(distance, 0.0)), index, weights(px, py, m, c)


@ti.func
def weights(px, py, m, c):
    """Weights of the m points on the circle c whose weighted sum is its centre."""
    out = vec3(0.5, 0.5, 0.0)
    if m == 3:
        ux, uy, vx, vy = px[1] - px[0], py[1] - py[0], px[2] - px[0], py[2] - py[0]
        wx, wy, d = c[0] - px[0], c[1] - py[0], ux * vy - uy * vx
        if d != 0.0:
            second, third = (wx * vy - wy * vx) / d, (ux * wy - uy * wx) / d
            out = vec3(1.0 - second - third, second, third)
    return out
