"""Critical planes of many points: the plane with the largest value of a criterion, as Findley's tau_amp + kappa * sigma_n,max.

tau_amp is the radius of the smallest circle around the path of the shear vector on the plane (`enclosing_circle`). Points run
in parallel, the work on one point is serial, so results do not depend on the number of threads.

Two ideas make the search fast. First, one pass over the history bounds the values of several planes: a circle about any centre
gives an upper bound. The centre of the best plane so far (the same mean of the same moments) gives a bound close to the value,
so only few planes are evaluated exactly. Second, the closer the planes are to each other, the fewer moments can decide between
them (`deciding_moments`).
"""

from tehl_taichi.engine.language import ti
from tehl_taichi.fatigue.deciding_moments import deciding
from tehl_taichi.fatigue.enclosing_circle import enclose, vec3
from tehl_taichi.fatigue.plane_components import mean_stress, plane_frame, project, shear_of, stress, traction, vec6
from tehl_taichi.fatigue.thinning import all_of, extent, thin

FIRST = 4     # halvings of the step for every peak; further ones only for peaks within CLOSE (relative) of the best
CLOSE = 5e-3
MOVES = 40    # largest number of moves with one step length
TURNS = 3     # turned patterns without success before the step is halved: the maximum often lies on a sharp ridge
FIRST_TURNS = 2  # the same number in the first halvings: error at most 3.1e-7 at 3003 points of the gear passage, against a
                 # search of 13 000 planes per point from a 4 degree grid (with 1: 4.7e-6)
MARGIN = 0.06  # peaks of the grid within this (relative) of its best are refined (the grid itself is about 1 % low)
STARTS = 5      # largest number of refined peaks: 4 and 20 agree to 2e-7 at every point of the gear passage (4.2 and 5.6 s)
SHEARED_MARGIN, SHEARED_STARTS = 0.1, 12  # both if the shear alone chooses the plane: grid planes of equal shear differ by 3 %
NEAR = 0.975   # cosine of 13 degrees: planes of the grid within that angle belong to one peak
SAME = 0.9998  # cosine of 1 degree: after the first halvings, peaks within that angle are one peak
TIE = 2.0  # weight of the normal stress over the step (rad): a pattern then follows a ridge of equal shear at every step
SLACK = 1e-11  # relative rounding error of a bound
KEPT = 1e-12  # relative rounding error of a value: a smaller change by leaving out moments is none
REACH = 2.0   # steps that a pattern may move before the deciding moments are chosen again: 0.5 and 8 give the same values at
              # 1473 points of a passage of 539 moments

LANES = 8     # planes bounded at once: the ring of a pattern search
lanes = ti.types.vector(LANES, ti.f64)
PEAK = 5      # numbers kept per peak: normal (3), value, next ring


@ti.func
def value_of(rule: ti.template(), tau, normal, mean, kappa):
    """Value (Pa) of the criterion `rule`. If the shear alone chooses the plane (`sheared`): tau + kappa * normal, whose kappa
    goes to 0 with the step (`tie`), so that the larger normal stress decides between planes of equal shear."""
    out = tau + kappa * normal
    if ti.static(not rule.sheared):
        out = rule.value(tau, normal, mean, kappa)
    return out


@ti.func
def tie(rule: ti.template(), kappa, step):
    """kappa of the criterion; if the shear alone chooses the plane, the weight of the normal stress at this step (rad)."""
    out = kappa
    if ti.static(rule.sheared):
        out = TIE * step
    return out


@ti.func
def bounds(S: ti.template(), some: ti.template(), row, steps, x, y, z, middle, kappa, rule: ti.template()):
    """Upper bounds (LANES,) Pa of the values on planes (x, y, z): circles about the shear of the stress `middle`."""
    ca, cb, cc, cn = traction(middle, x, y, z)
    top, far, mean = lanes(-1e300), lanes(0.0), -1e300
    for q in range(steps):
        t = some[row, q]
        a, b, c, normal = traction(stress(S, row, t), x, y, z)
        n = normal - cn
        da, db, dc = a - ca - n * x, b - cb - n * y, c - cc - n * z
        size = da * da + db * db + dc * dc
        # by select: one instruction, where ti.max takes three for numbers that may be nan
        far, top = ti.select(size > far, size, far), ti.select(normal > top, normal, top)
        mean = ti.max(mean, mean_stress(S, row, t))
    return value_of(rule, ti.sqrt(far) * (1 + SLACK), top + SLACK * ti.abs(top), mean + SLACK * ti.abs(mean), kappa)


@ti.func
def plane_value(S: ti.template(), some: ti.template(), a: ti.template(), b: ti.template(), row, steps, n, kappa,
                rule: ti.template()):
    """Value (Pa) of the criterion on plane n, and the mean stress (6,) whose shear is the centre of the smallest circle."""
    e1, e2 = plane_frame(n)
    top, mean, la, ha, lb, hb = -1e300, -1e300, 1e300, -1e300, 1e300, -1e300
    ia, ja, ib, jb = 0, 0, 0, 0
    for q in range(steps):
        t = some[row, q]
        u, v = project(S, row, t, e1, n), project(S, row, t, e2, n)
        top, mean = ti.max(top, project(S, row, t, n, n)), ti.max(mean, mean_stress(S, row, t))
        a[row, q], b[row, q] = u, v
        if u < la:
            la, ia = u, q
        if u > ha:
            ha, ja = u, q
        if v < lb:
            lb, ib = v, q
        if v > hb:
            hb, jb = v, q
    if hb - lb > ha - la:
        ia, ja = ib, jb
    radius, index, weight = enclose(a, b, row, steps, ia, ja)
    middle = vec6(0.0)
    for k in ti.static(range(3)):
        middle += weight[k] * stress(S, row, some[row, index[k]])
    tau = radius
    if ti.static(rule.chord):
        tau = half_chord(a, b, row, steps)
    value = value_of(rule, tau, top, mean, kappa)
    if ti.static(rule.momentary):
        cu, cv = shear_of(middle, e1, n), shear_of(middle, e2, n)
        value = -1e300
        for q in range(steps):
            t = some[row, q]
            away = ti.sqrt((a[row, q] - cu) ** 2 + (b[row, q] - cv) ** 2)
            value = ti.max(value, value_of(rule, away, project(S, row, t, n, n), mean_stress(S, row, t), kappa))
    return value, middle


@ti.func
def half_chord(a: ti.template(), b: ti.template(), row, steps):
    """Half of the longest chord of the shear path (a, b) of a row, Pa."""
    longest = 0.0
    for t in range(steps):
        for q in range(t):
            longest = ti.max(longest, (a[row, t] - a[row, q]) ** 2 + (b[row, t] - b[row, q]) ** 2)
    return 0.5 * ti.sqrt(longest)


@ti.func
def best_of_ring(S: ti.template(), some: ti.template(), rings: ti.template(), a: ti.template(), b: ti.template(), row, steps,
                 centre, step, turn, value, middle, kappa, rule: ti.template(), prune):
    """(normal, value, middle) of the best of eight planes tilted by `step` (rad) around `centre`, in the directions of the
    ring `turn`; the given ones if none is better. prune 0: every plane is evaluated."""
    e1, e2 = plane_frame(centre)
    n, best, mid = centre, value, middle
    x, y, z = lanes(0.0), lanes(0.0), lanes(0.0)
    for k in ti.static(range(LANES)):
        trial = (centre + step * (rings[turn, k, 0] * e1 + rings[turn, k, 1] * e2)).normalized()
        x[k], y[k], z[k] = trial[0], trial[1], trial[2]
    bound = bounds(S, some, row, steps, x, y, z, middle, kappa, rule)
    for _ in range(LANES):
        top, at, trial = -1e300, 0, centre
        for k in ti.static(range(LANES)):
            if bound[k] > top:
                top, at, trial = bound[k], k, vec3(x[k], y[k], z[k])
        if top <= best and prune == 1:  # so are the others
            break
        v, m = plane_value(S, some, a, b, row, steps, trial, kappa, rule)
        if v > best:
            n, best, mid = trial, v, m
        for k in ti.static(range(LANES)):
            if k == at:
                bound[k] = -1e300
    return n, best, mid


@ti.func
def walk(S: ti.template(), some: ti.template(), rings: ti.template(), a: ti.template(), b: ti.template(), row, steps, n, step,
         turn, best, middle, kappa, rule: ti.template(), turns, prune):
    """Move to the best of eight neighbours until `turns` turned patterns find none that is better.

    Returns plane, value, middle, the number of the next ring and the number of patterns.
    """
    failed, count = 0, 0
    while failed < turns and count < MOVES:
        count += 1
        failed += 1
        chosen, value, mid = best_of_ring(S, some, rings, a, b, row, steps, n, step, turn, best, middle, kappa, rule, prune)
        if value > best:
            n, best, middle, failed = chosen, value, mid, 0
        turn += 1
    return n, best, middle, turn, count


@ti.func
def refine(S: ti.template(), some: ti.template(), rings: ti.template(), a: ti.template(), b: ti.template(),
           peaks: ti.template(), row, steps, peak, kappa, rule: ti.template(), step0, shrinks, turns, prune, stage):
    """Refine a peak by a pattern search on the sphere, with `shrinks` halvings of the step; return the number of planes bounded
    or evaluated. Stage 1 leaves out moments that can no longer decide."""
    n, best, middle = get_peak(peaks, row, peak)[0], -1e300, vec6(0.0)
    step, turn, decided, moments = step0, int(peaks[row, peak, 4]), 0, steps
    for halving in range(shrinks + 1):  # before the first one: the value of the peak by all of these moments
        few, weight = moments, tie(rule, kappa, step)
        if ti.static(rule.outer):
            if stage * prune == 1 and halving > 0:
                few = deciding(S, some, a, b, row, moments, n, middle, REACH * step)
        if ti.static(rule.sheared):  # the weight has changed
            best, middle = plane_value(S, some, a, b, row, moments, n, weight, rule)
        if halving == 0 or few < moments:
            value, mid = plane_value(S, some, a, b, row, few, n, weight, rule)
            if halving == 0:
                best, middle = value, mid
            if value >= best - KEPT * ti.abs(best):
                moments = few
        if halving > 0:
            n, best, middle, turn, count = walk(S, some, rings, a, b, row, moments, n, step, turn, best, middle, weight, rule,
                                                turns, prune)
            decided += LANES * count
            step *= 0.5
    if ti.static(rule.sheared):
        best = plane_value(S, some, a, b, row, moments, n, tie(rule, kappa, step) * stage, rule)[0]
    put_peak(peaks, row, peak, n, best, turn)
    return decided


@ti.func
def get_peak(peaks: ti.template(), row, peak):
    """(normal, value) of a peak."""
    return vec3(peaks[row, peak, 0], peaks[row, peak, 1], peaks[row, peak, 2]), peaks[row, peak, 3]


@ti.func
def put_peak(peaks: ti.template(), row, peak, n, value, turn):
    """Store normal, value and next ring of a peak."""
    for k in ti.static(range(3)):
        peaks[row, peak, k] = n[k]
    peaks[row, peak, 3], peaks[row, peak, 4] = value, turn


@ti.func
def scan(S: ti.template(), some: ti.template(), planes: ti.template(), values: ti.template(), a: ti.template(),
         b: ti.template(), row, steps, middle, kappa, rule: ti.template(), prune):
    """Write the values on all planes of the grid (-1e300 if the bound is too low) and return the largest, Pa; bounds: circles
    about the shear of `middle`."""
    count = planes.shape[0]
    for group in range((count + LANES - 1) // LANES):
        x, y, z = lanes(0.0), lanes(0.0), lanes(0.0)
        for k in ti.static(range(LANES)):
            q = ti.min(group * LANES + k, count - 1)
            x[k], y[k], z[k] = planes[q, 0], planes[q, 1], planes[q, 2]
        bound = bounds(S, some, row, steps, x, y, z, middle, kappa, rule)
        for k in ti.static(range(LANES)):
            if group * LANES + k < count:
                values[row, group * LANES + k] = bound[k]
    first, top = 0, -1e300
    for k in range(count):
        if values[row, k] > top:
            top, first = values[row, k], k
    best = -1e300
    for q in range(count + 1):  # the most promising plane first
        k = first if q == 0 else q - 1
        if q == 0 or k != first:
            if prune == 0 or values[row, k] > best - ti.static(SHEARED_MARGIN if rule.sheared else MARGIN) * ti.abs(best):
                trial = vec3(planes[k, 0], planes[k, 1], planes[k, 2])
                values[row, k] = plane_value(S, some, a, b, row, steps, trial, kappa, rule)[0]
                best = ti.max(best, values[row, k])
            else:
                values[row, k] = -1e300
    return best


@ti.func
def take_best(planes: ti.template(), values: ti.template(), row):
    """(value, normal) of the best remaining plane of the grid; the planes within NEAR of it are removed."""
    top, chosen = -1e300, 0
    for k in range(planes.shape[0]):
        if values[row, k] > top:
            top, chosen = values[row, k], k
    n = vec3(planes[chosen, 0], planes[chosen, 1], planes[chosen, 2])
    for k in range(planes.shape[0]):
        if ti.abs(n[0] * planes[k, 0] + n[1] * planes[k, 1] + n[2] * planes[k, 2]) > NEAR:
            values[row, k] = -1e300
    return top, n


@ti.func
def collect(planes: ti.template(), values: ti.template(), peaks: ti.template(), row, on_grid, rule: ti.template()):
    """Write the peaks of the grid that are to be refined into `peaks`; return their number."""
    count, going = 0, 1
    while going == 1 and count < ti.static(SHEARED_STARTS if rule.sheared else STARTS):
        top, n = take_best(planes, values, row)
        going = 0
        if top > on_grid - ti.static(SHEARED_MARGIN if rule.sheared else MARGIN) * ti.abs(on_grid):
            going = 1
            put_peak(peaks, row, count, n, top, 0.0)
            count += 1
    return count


@ti.func
def hopeful(peaks: ti.template(), row, peak, count):
    """Whether a peak is within CLOSE of the best one and differs from all peaks before it."""
    n, value = get_peak(peaks, row, peak)
    good = 1
    for other in range(count):
        m, top = get_peak(peaks, row, other)
        if value < top - CLOSE * ti.abs(top):
            good = 0
        if other < peak and ti.abs(n.dot(m)) > SAME:
            good = 0
    return good


@ti.kernel
def circle(steps: ti.i32, a: ti.types.ndarray(dtype=ti.f64, ndim=2), b: ti.types.ndarray(dtype=ti.f64, ndim=2),
           out: ti.types.ndarray(dtype=ti.f64, ndim=1)):
    """out = centre and radius of the smallest circle around the path (a, b)[0]."""
    for _ in range(1):
        radius, index, weight = enclose(a, b, 0, steps, 0, steps - 1)
        out[0], out[1], out[2] = 0.0, 0.0, radius
        for k in ti.static(range(3)):
            out[0], out[1] = out[0] + weight[k] * a[0, index[k]], out[1] + weight[k] * b[0, index[k]]


@ti.func
def look(S: ti.template(), some: ti.template(), planes: ti.template(), rings: ti.template(), values: ti.template(),
         a: ti.template(), b: ti.template(), peaks: ti.template(), out: ti.template(), row, steps, kappa, rule: ti.template(),
         step0, shrinks, prune, least):
    """Write the best plane of a point into its row of `out`, with the number of planes bounded or evaluated.

    The first stage uses some of the moments, the second all. Points with less than `least` (Pa) on the grid keep the grid's
    best plane.
    """
    low, high = extent(S, row, steps)
    moments = thin(S, some, row, steps, low, high)
    on_grid = scan(S, some, planes, values, a, b, row, moments, 0.5 * (low + high), tie(rule, kappa, step0), rule, prune)
    count = collect(planes, values, peaks, row, on_grid, rule)
    decided = planes.shape[0]
    for stage in range(0 if on_grid < least else 2):
        if stage == 1:
            moments = all_of(some, row, steps)
        for peak in range(count):
            if stage == 1 and not hopeful(peaks, row, peak, count):
                peaks[row, peak, 3] = -1e300
            else:
                step = step0 if stage == 0 else step0 * 0.5**FIRST
                decided += refine(S, some, rings, a, b, peaks, row, moments, peak, kappa, rule, step,
                                  FIRST if stage == 0 else shrinks - FIRST, FIRST_TURNS if stage == 0 else TURNS, prune,
                                  stage)
    out[row, 0], out[row, 4] = -1e300, decided
    for peak in range(count):
        if peaks[row, peak, 3] > out[row, 0]:
            out[row, 0] = peaks[row, peak, 3]
            for k in ti.static(range(3)):
                out[row, k + 1] = peaks[row, peak, k]


@ti.kernel
def search(points: ti.i32, steps: ti.i32, kappa: ti.f64, rule: ti.template(), step0: ti.f64, shrinks: ti.i32, prune: ti.i32,
           least: ti.types.ndarray(dtype=ti.f64, ndim=1), known: ti.types.ndarray(dtype=ti.f64, ndim=2),
           S: ti.types.ndarray(dtype=ti.f64, ndim=3), planes: ti.types.ndarray(dtype=ti.f64, ndim=2),
           rings: ti.types.ndarray(dtype=ti.f64, ndim=3), values: ti.types.ndarray(dtype=ti.f64, ndim=2),
           a: ti.types.ndarray(dtype=ti.f64, ndim=2), b: ti.types.ndarray(dtype=ti.f64, ndim=2),
           peaks: ti.types.ndarray(dtype=ti.f64, ndim=3),
           some: ti.types.ndarray(dtype=ti.i32, ndim=2), out: ti.types.ndarray(dtype=ti.f64, ndim=2)):
    """out[point] = (f, n_x, n_y, n_z, planes decided) from S[point, time, (xx, yy, zz, xy, xz, yz)].

    f in Pa. rule: a :class:`tehl_taichi.laws.criteria.criterion.Criterion` whose value can be traced. planes (m, 3): unit
    normals of the grid. rings: see :func:`tehl_taichi.fatigue.findley.rings`. step0: first step, rad, halved `shrinks` times.
    least (points,): see :func:`look`. known (points, 4): value and plane of a search of more moments (infinite: none); the
    plane is kept if these moments reach the value there. Scratch: values (points, m), a, b, some (points, steps), peaks
    (points, SHEARED_STARTS, PEAK).
    """
    ti.loop_config(block_dim=8)
    for row in range(points):
        out[row, 4] = 1
        for k in ti.static(range(4)):
            out[row, k] = known[row, k]
        for turn in range(2):  # the known plane, then what is found
            if turn == 1:
                look(S, some, planes, rings, values, a, b, peaks, out, row, steps, kappa, rule, step0, shrinks, prune,
                     least[row])
            if out[row, 0] < 1e300:
                # by all moments: no other plane has more than the known one has, and a peak may have moved beyond REACH
                n = vec3(out[row, 1], out[row, 2], out[row, 3])
                value = plane_value(S, some, a, b, row, all_of(some, row, steps), n, kappa, rule)[0]
                if turn == 0 and value >= out[row, 0] - KEPT * ti.abs(out[row, 0]):
                    break
                out[row, 0] = value if ti.static(rule.sheared) else ti.max(out[row, 0], value)
