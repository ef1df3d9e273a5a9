"""Forces between two bounds: each has zero displacement, or is at a bound (a mixed linear complementarity problem).

The matrix is symmetric and positive, so there is one solution. Exchanging sets of unknowns finds it; where that makes no
progress, one unknown is exchanged at a time (Judice & Pires 1994; Murty 1974).
"""

from typing import Any

import numpy as np

LOW, FREE, HIGH = -1, 0, 1
TRIES = 8      # exchanges of whole sets without fewer wrong unknowns
ROUND = 1e-11  # of the largest displacement: less is rounding
YIELD = 1e-12  # of the largest displacement by a unit force: what each unknown gets besides where several mean the same


def solve_bounded(M, gap, low, high, at):
    """Solve for forces r with low <= r <= high: w = gap + M r is >= 0 at LOW, 0 where FREE, <= 0 at HIGH.

    at: first guess of the states. Returns (r, states: LOW, FREE or HIGH).
    """
    fewest, left, small = gap.size + 1, TRIES, ROUND * np.abs(gap).max()
    seen: dict[bytes, Any] = {}
    while True:
        r = _forces(M, gap, low, high, at)
        new = _next_states(r, gap + M @ r, low, high, at, small)
        wrong = np.flatnonzero(new != at)
        if wrong.size == 0:
            return r, at
        if at.tobytes() in seen:
            return _smallest_of_cycle(seen, at.tobytes())
        if wrong.size < fewest:
            fewest, left = wrong.size, TRIES
        elif left > 0:
            left -= 1
        else:  # one at a time: finite for a positive matrix, but for rounding
            wrong = wrong[-1:]
            seen[at.tobytes()] = np.clip(r, low, high), at
        at = at.copy()
        at[wrong] = new[wrong]


def _smallest_of_cycle(seen, again):
    """State with the smallest forces of a cycle that starts at `again`; rounding alone makes the states of the cycle differ."""
    states = list(seen)
    return min((seen[state] for state in states[states.index(again) :]), key=lambda found: np.abs(found[0]).max())


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
