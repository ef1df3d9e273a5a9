"""Findley's critical plane for many points at once: max over planes of tau_amp + kappa * sigma_n,max.

tau_amp is the radius of the smallest circle around the path of the shear vector on the plane (exact, by pivoting).
One point per parallel iteration, everything inside serial, so results do not depend on the number of threads.
"""

import taichi as ti

SHRINKS = 12  # halvings of the step, 5 degrees -> 2e-5 rad: error of a smooth maximum about 1e-9
MOVES = 40    # moves at one step length at most
TURNS = 3     # turned patterns without success before the step is halved: the maximum often lies on a sharp ridge
PIVOTS = 60   # farthest points added to a circle at most (about 4 are usual)
INSIDE = 1e-12
MARGIN = 0.03  # other peaks of the grid within this of its best are refined too (the grid itself is about 1 % low)
STARTS = 5      # peaks refined at most: 4 and 20 agree to 2e-7 at every point of the gear passage (4.2 s against 5.6 s)
NEAR = 0.975   # cosine of the angle (13 degrees) below which planes of the grid belong to one peak

vec3 = ti.types.vector(3, ti.f64)


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
    """Smallest circle around m <= 3 points and one outside point f, which lies on it: circle and the two partners."""
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
def circle_radius(a: ti.template(), b: ti.template(), row, steps, i0, i1):
    """Radius of the smallest circle around the points (a, b)[row, :steps]; i0, i1: two far points to start from.

    Pivoting (Gaertner 1999): add the farthest point, solve the problem of at most four points exactly, repeat.
    """
    px, py = vec3(a[row, i0], a[row, i1], 0.0), vec3(b[row, i0], b[row, i1], 0.0)
    m, going, count = 2, 1, 0
    c = circle2(px[0], py[0], px[1], py[1])
    while going == 1 and count < PIVOTS:
        count += 1
        far, distance = farthest(a, b, row, steps, c)
        going = 0
        if distance > c[2] * (1 + INSIDE):
            fx, fy = a[row, far], b[row, far]
            best, bi, bj = pivot(px, py, m, fx, fy)
            if bi >= 0 and best[2] > c[2]:
                qx, qy = vec3(fx, 0.0, 0.0), vec3(fy, 0.0, 0.0)
                for k in ti.static(range(3)):
                    if k == bi:
                        qx[1], qy[1] = px[k], py[k]
                    if k == bj:
                        qx[2], qy[2] = px[k], py[k]
                px, py, c = qx, qy, best
                m = 3 if bj >= 0 else 2
                going = 1
    far, distance = farthest(a, b, row, steps, c)
    return ti.sqrt(ti.max(distance, 0.0))


@ti.func
def plane_frame(n):
    """Two unit vectors that complete n to a right-handed frame."""
    h = vec3(0.0, 0.0, 1.0)
    if ti.abs(n[2]) > 0.9:
        h = vec3(1.0, 0.0, 0.0)
    e = h.cross(n).normalized()
    return e, n.cross(e)


@ti.func
def project(S: ti.template(), row, t, u, n):
    """u . sigma . n for the stress (xx, yy, zz, xy, xz, yz) of this point and time."""
    return (u[0] * n[0] * S[row, t, 0] + u[1] * n[1] * S[row, t, 1] + u[2] * n[2] * S[row, t, 2]
            + (u[0] * n[1] + u[1] * n[0]) * S[row, t, 3] + (u[0] * n[2] + u[2] * n[0]) * S[row, t, 4]
            + (u[1] * n[2] + u[2] * n[1]) * S[row, t, 5])


@ti.func
def plane_value(S: ti.template(), a: ti.template(), b: ti.template(), row, steps, n, kappa, best, prune):
    """tau_amp + kappa * sigma_n,max on the plane n, or -1e300 where a bound shows that it is not above `best`.

    The bound: a circle around the bounding box of the path encloses the path.
    """
    e1, e2 = plane_frame(n)
    top, la, ha, lb, hb = -1e300, 1e300, -1e300, 1e300, -1e300
    ia, ja, ib, jb = 0, 0, 0, 0
    for t in range(steps):
        u, v = project(S, row, t, e1, n), project(S, row, t, e2, n)
        top = ti.max(top, project(S, row, t, n, n))
        a[row, t], b[row, t] = u, v
        if u < la:
            la, ia = u, t
        if u > ha:
            ha, ja = u, t
        if v < lb:
            lb, ib = v, t
        if v > hb:
            hb, jb = v, t
    bound = 0.5 * ti.sqrt((ha - la) ** 2 + (hb - lb) ** 2) * (1 + 1e-11)
    value = -1e300
    if prune == 0 or bound + kappa * top + 1e-13 * ti.abs(kappa * top) > best:
        if hb - lb > ha - la:
            ia, ja = ib, jb
        value = circle_radius(a, b, row, steps, ia, ja) + kappa * top
    return value


@ti.func
def refine(S: ti.template(), a: ti.template(), b: ti.template(), row, steps, start, value, kappa, step0, prune):
    """Pattern search on the sphere: eight neighbours, move to the best; after TURNS turned patterns halve the step."""
    n, best, step, turn = start, value, step0, 0.0
    for _ in range(SHRINKS):
        failed, count = 0, 0
        while failed < TURNS and count < MOVES:
            count += 1
            failed += 1
            e1, e2 = plane_frame(n)
            chosen = n
            for k in range(8):
                angle = turn + k * 0.7853981633974483
                trial = (n + step * (ti.cos(angle) * e1 + ti.sin(angle) * e2)).normalized()
                v = plane_value(S, a, b, row, steps, trial, kappa, best, prune)
                if v > best:
                    best, chosen, failed = v, trial, 0
            n = chosen
            turn += 0.2763932022500210
        step *= 0.5
    return n, best


@ti.func
def scan(S: ti.template(), planes: ti.template(), values: ti.template(), a: ti.template(), b: ti.template(), row, steps,
         kappa, prune):
    """Values on all planes of the grid (hopeless ones -1e300); returns the largest."""
    best = -1e300
    for k in range(planes.shape[0]):
        trial = vec3(planes[k, 0], planes[k, 1], planes[k, 2])
        values[row, k] = plane_value(S, a, b, row, steps, trial, kappa, best - MARGIN * ti.abs(best), prune)
        best = ti.max(best, values[row, k])
    return best


@ti.func
def take_best(planes: ti.template(), values: ti.template(), row):
    """(value, normal) of the best plane left on the grid; it and its neighbourhood are crossed out."""
    top, chosen = -1e300, 0
    for k in range(planes.shape[0]):
        if values[row, k] > top:
            top, chosen = values[row, k], k
    n = vec3(planes[chosen, 0], planes[chosen, 1], planes[chosen, 2])
    for k in range(planes.shape[0]):
        if ti.abs(n[0] * planes[k, 0] + n[1] * planes[k, 1] + n[2] * planes[k, 2]) > NEAR:
            values[row, k] = -1e300
    return top, n


@ti.kernel
def search(points: ti.i32, steps: ti.i32, kappa: ti.f64, step0: ti.f64, prune: ti.i32,
           S: ti.types.ndarray(dtype=ti.f64, ndim=3), planes: ti.types.ndarray(dtype=ti.f64, ndim=2),
           values: ti.types.ndarray(dtype=ti.f64, ndim=2), a: ti.types.ndarray(dtype=ti.f64, ndim=2),
           b: ti.types.ndarray(dtype=ti.f64, ndim=2), out: ti.types.ndarray(dtype=ti.f64, ndim=2)):
    """out[point] = (f, n_x, n_y, n_z) from S[point, time, (xx, yy, zz, xy, xz, yz)].

    planes (m, 3): unit normals of the grid; values (points, m), a, b (points, steps): scratch; step0: first step, rad.
    """
    for row in range(points):
        on_grid = scan(S, planes, values, a, b, row, steps, kappa, prune)
        best, n = -1e300, vec3(0.0, 0.0, 1.0)
        going, count = 1, 0
        while going == 1 and count < STARTS:
            count += 1
            top, start = take_best(planes, values, row)
            going = 0
            if top > on_grid - MARGIN * ti.abs(on_grid):
                going = 1
                normal, value = refine(S, a, b, row, steps, start, top, kappa, step0, prune)
                if value > best:
                    best, n = value, normal
        out[row, 0] = best
        for k in ti.static(range(3)):
            out[row, k + 1] = n[k]
