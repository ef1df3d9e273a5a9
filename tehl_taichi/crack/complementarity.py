"""Forces between two bounds: each has zero displacement, or is at a bound (a mixed linear complementarity problem).

The matrix is symmetric and positive, so there is one solution, which has the least energy. Exchanging sets of unknowns finds it
(Judice & Pires 1994); where that makes no progress, steps that reduce the energy do (Stark & Parker 1995).
"""

import numpy as np

LOW, FREE, HIGH = -1, 0, 1
TRIES = 8      # exchanges of whole sets without fewer wrong unknowns
MOST = 20      # steps an unknown that reduce the energy: a few are usual, and without a bound rounding may repeat them
ROUND = 1e-11  # of the largest displacement: less is rounding
YIELD = 1e-12  # of the largest displacement by a unit force: what each unknown gets besides where several mean the same


def solve_bounded(M, gap, low, high, at):
    """Solve for forces r with low <= r <= high: w = gap + M r is >= 0 at LOW, 0 where FREE, <= 0 at HIGH.

    at: first guess of the states. Returns (r, states: LOW, FREE or HIGH).
    """
    fewest, left, small = gap.size + 1, TRIES, ROUND * np.abs(gap).max()
    while left:
        r = _forces(M, gap, low, high, at)
        new = _next_states(r, gap + M @ r, low, high, at, small)
        wrong = np.count_nonzero(new != at)
        if wrong == 0:
            return r, at
        fewest, left = (wrong, TRIES) if wrong < fewest else (fewest, left - 1)
        at = new
    return _descend(M, gap, low, high, at, small)


def _descend(M, gap, low, high, at, small):
    """(r, states) by steps that reduce the energy r M r / 2 + gap r: to the best forces of these states, up to the first bound
    on the way, which then holds; at the best forces the one is freed whose bound is most wrong.
    """
    r, at = np.where(at == LOW, low, np.where(at == HIGH, high, np.clip(0.0, low, high))), at.copy()
    for _ in range(MOST * gap.size):
        step = _forces(M, gap, low, high, at) - r
        room = _room(r, step, low, high)
        first = np.argmin(room)
        r = np.clip(r + min(room[first], 1.0) * step, low, high)
        if room[first] < 1:
            at[first] = LOW if step[first] < 0 else HIGH
            continue
        wrong = (gap + M @ r) * at  # > 0 where the bound is
        if wrong.max() <= small:
            break
        at[np.argmax(wrong)] = FREE
    return r, at


def _room(r, step, low, high):
    """Part of each step up to a bound; infinite where nothing moves."""
    room = np.full(r.size, np.inf)
    return np.divide(np.where(step < 0, low, high) - r, step, out=room, where=step != 0)


def _forces(M, gap, low, high, at):
    """Forces r: at their bounds, or with zero displacement where FREE."""
    r, free = np.where(at == LOW, low, np.where(at == HIGH, high, 0.0)), at == FREE
    r[free] = solve_compliant(M[np.ix_(free, free)], -(gap + M @ r)[free])
    return r


def solve_compliant(M, right_side):
    """Forces that cause the displacements `right_side`.

    Rows may be dependent (touching faces with oil between them). A small compliance of each shares the force between them, or
    makes it large where the displacements contradict each other.
    """
    try:
        return np.linalg.solve(M, right_side)
    except np.linalg.LinAlgError:
        return np.linalg.solve(M + YIELD * np.abs(M).max() * np.eye(len(M)), right_side)


def _next_states(r, w, low, high, at, small):
    """States of the next iteration."""
    new = at.copy()
    free = at == FREE
    new[free & (r < low)], new[free & (r > high)] = LOW, HIGH
    new[((at == LOW) & (w < -small)) | ((at == HIGH) & (w > small))] = FREE
    return new
