"""Decisions between the phases of a linear solve: sums over the blocks, the border, Gram-Schmidt, Givens rotations, the end.

Flexible GMRES (Saad 1993) with classical Gram-Schmidt, repeated if it cancels (Daniel et al. 1976). A Krylov vector has two
components besides the rows: the load and the net outflow. The outflow is redundant, but it adds a term to the norm that is
scaled like the sum of all rows. Without it row scales of 1e3 in the inlet hide a loss of mass, which costs three more Newton
steps. The basis is stored without division by its norms; INVERSE holds the factors.
"""

import itertools

from tehl_taichi.engine.language import ti
from tehl_taichi.pressure.linear.schedule import BEGIN, BORDER, END, EXTEND, EXTEND_AGAIN, LEAVE, LIFTED, LOOP, PROJECT

CANCELLED = 0.5  # the projection is repeated if it leaves less than this share of the norm
_row = itertools.count()
INVERSE, LOADS, MASSES, RISES = (next(_row) for _ in range(4))  # of each vector: 1 / norm, load, net outflow; change of H0
RIGHT, COSINE, SINE, WEIGHTS, COLUMN, SCALARS, TRIANGLE = (next(_row) for _ in range(7))  # TRIANGLE: the first of its rows
_entry = itertools.count()  # of SCALARS
COUNT, LOAD, MASS, NORM, BETA, TOLERANCE, LIFT_LOAD, RISE, LEFT = (next(_entry) for _ in range(9))
PORTION, NEXT = (next(_entry) for _ in range(2))  # iterations of a launch; phase at which the next launch begins, or -1
FIXED = next(_entry)  # 1 if H0 is given, without a load equation
SQUARE_SUM, MASS_SUM, LOAD_SUM, DOT_SUM = range(4)  # columns of the partial sums; DOT_SUM: first product with the basis


@ti.func
def total(partial: ti.template(), column):
    """Sum of a column of the partial sums over all blocks."""
    out = 0.0
    for s in range(partial.shape[0]):
        out += partial[s, column]
    return out


@ti.func
def inverse(x):
    """1/x, 0 if x is not positive."""
    return 1.0 / x if x > 0.0 else 0.0


@ti.func
def begin(N: ti.template(), partial: ti.template()):
    """Take the first vector into the basis."""
    load, mass = N[SCALARS, LOAD], N[SCALARS, MASS]
    beta = ti.sqrt(total(partial, SQUARE_SUM) + load * load + mass * mass)
    inv = inverse(beta)
    N[SCALARS, COUNT], N[SCALARS, BETA], N[SCALARS, LEFT], N[SCALARS, RISE] = 0.0, beta, beta, 0.0
    N[INVERSE, 0], N[LOADS, 0], N[MASSES, 0], N[RIGHT, 0] = inv, load * inv, mass * inv, beta


@ti.func
def border(N: ti.template(), partial: ti.template(), k):
    """Set the change of H0 that belongs to preconditioned vector k, so that it satisfies the load equation."""
    N[RISES, k] = 0.0
    if N[SCALARS, FIXED] == 0.0:
        N[RISES, k] = (total(partial, LOAD_SUM) * N[INVERSE, k] - N[LOADS, k]) / N[SCALARS, LIFT_LOAD]
    N[SCALARS, RISE] = N[RISES, k]


@ti.func
def project(N: ti.template(), partial: ti.template(), k):
    """Compute the components of the newest vector along the basis, and subtract them from its load and outflow.

    At the first projection the load is that of the vector before the preconditioner, since the border keeps it.
    """
    if N[SCALARS, NORM] < 0.0:
        load, mass = N[LOADS, k], total(partial, MASS_SUM)
        N[SCALARS, NORM] = ti.sqrt(total(partial, SQUARE_SUM) + load * load + mass * mass)
        N[SCALARS, LOAD], N[SCALARS, MASS] = load, mass
        for i in range(k + 1):
            N[COLUMN, i] = 0.0
    load, mass = N[SCALARS, LOAD], N[SCALARS, MASS]
    for i in range(k + 1):
        h = total(partial, DOT_SUM + i) * N[INVERSE, i] + N[LOADS, i] * load + N[MASSES, i] * mass
        N[COLUMN, i] += h
        N[WEIGHTS, i] = h * N[INVERSE, i]
        N[SCALARS, LOAD] -= h * N[LOADS, i]
        N[SCALARS, MASS] -= h * N[MASSES, i]


@ti.func
def rotate(N: ti.template(), k, norm):
    """Add a column to the least-squares problem |beta e_1 - H y|, made triangular by Givens rotations."""
    for i in range(k):
        p, q = N[COLUMN, i], N[COLUMN, i + 1]
        N[COLUMN, i], N[COLUMN, i + 1] = N[COSINE, i] * p + N[SINE, i] * q, N[COSINE, i] * q - N[SINE, i] * p
    p = N[COLUMN, k]
    length = ti.sqrt(p * p + norm * norm)
    N[COSINE, k], N[SINE, k] = 1.0, 0.0
    if length > 0.0:
        N[COSINE, k], N[SINE, k] = p / length, norm / length
    N[COLUMN, k] = length
    for i in range(k + 1):
        N[TRIANGLE + i, k] = N[COLUMN, i]
    N[RIGHT, k + 1] = -N[SINE, k] * N[RIGHT, k]
    N[RIGHT, k] = N[COSINE, k] * N[RIGHT, k]


@ti.func
def solution(N: ti.template(), count):
    """Compute the weights of the preconditioned vectors (0 for a zero column), and the change of H0."""
    rise = 0.0
    for r in range(count):
        i = count - 1 - r
        y = N[RIGHT, i]
        for j in range(i + 1, count):
            y -= N[TRIANGLE + i, j] * N[WEIGHTS, j]
        N[WEIGHTS, i] = y * inverse(N[TRIANGLE + i, i])
        rise += N[WEIGHTS, i] * N[RISES, i]
    N[SCALARS, RISE] = rise


@ti.func
def extend(N: ti.template(), partial: ti.template(), k, most, once):
    """Take the newest vector into the basis. Returns 0: continue, 1: finished, -1: project again."""
    load, mass, before = N[SCALARS, LOAD], N[SCALARS, MASS], N[SCALARS, NORM]
    norm, out = ti.sqrt(total(partial, SQUARE_SUM) + load * load + mass * mass), -1
    N[SCALARS, NORM] = norm
    if norm > CANCELLED * before or not once:
        inv = inverse(norm)
        N[INVERSE, k + 1], N[LOADS, k + 1], N[MASSES, k + 1] = inv, load * inv, mass * inv
        rotate(N, k, norm)
        left, limit = ti.abs(N[RIGHT, k + 1]), N[SCALARS, TOLERANCE] * N[SCALARS, BETA]
        N[SCALARS, COUNT], N[SCALARS, LEFT], N[SCALARS, NORM] = k + 1.0, left, -1.0
        out = 0 if left > limit and k + 1 < most else 1  # nan ends the iteration
        if out == 1:
            solution(N, k + 1)
    return out


@ti.func
def decide(N: ti.template(), partial: ti.template(), phases: ti.template(), phase, decision, most):
    """Take the decision at the end of `phase` and return the next phase, or -1 at the end of a launch.

    NEXT then holds the phase at which another launch continues, or -1. most: largest number of iterations.
    """
    k, out = ti.cast(N[SCALARS, COUNT], ti.i32), phase + 1
    if decision == BEGIN:
        begin(N, partial)
        N[SCALARS, NORM] = -1.0
    elif decision == BORDER:
        border(N, partial, k)
    elif decision == PROJECT:
        project(N, partial, k)
    elif decision == EXTEND or decision == EXTEND_AGAIN:
        enough = extend(N, partial, k, most, decision == EXTEND)
        if enough >= 0:
            out = phases[phase, LOOP] if enough == 0 else phases[phase, LEAVE]
            if enough == 0 and (k + 1) % ti.cast(N[SCALARS, PORTION], ti.i32) == 0:
                N[SCALARS, NEXT], out = out, -1
    elif decision == LIFTED:
        N[SCALARS, LIFT_LOAD] = total(partial, LOAD_SUM)
        out = -1
    elif decision == END:
        out = -1
    return out
