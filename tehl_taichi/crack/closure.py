"""Faces that may touch but not pass through each other: opening >= 0, contact force >= 0, one of them zero at every node.

The matrix is symmetric and positive, so there is one answer and exchanging whole sets of nodes finds it, one node at a time
where that does not get on (Judice & Pires 1994; Murty 1974). A tip whose node is closed has K_I = 0.
"""

import numpy as np

TRIES = 8     # exchanges of whole sets without fewer wrong nodes
ROUND = 1e-11  # of the largest opening: less is rounding


def opened(compliance, forces):
    """(values, contact forces), (2 nodes, moments) and (nodes, moments): without friction."""
    nodes = len(forces) // 2
    free, held = compliance @ forces, np.zeros((nodes, forces.shape[1]))
    gap, M, active = free[:nodes], compliance[:nodes, :nodes], np.zeros(nodes, bool)
    left = np.flatnonzero((gap < 0).any(axis=0))
    while left.size:
        _, active = complement(M, gap[:, left[0]], active)
        q, wrong = _tried(M, gap[:, left], active)
        fits = ~wrong.any(axis=0)  # many moments have the same closed nodes
        fits[0] = True
        held[:, left[fits]] = q[:, fits]
        left = left[~fits]
    values = free + compliance[:, :nodes] @ held
    values[:nodes][held > 0] = 0.0
    return values, held


def _tried(M, gap, active):
    """(q, what is wrong with it), both (nodes, ...), when just the active nodes touch."""
    q = np.zeros_like(gap)
    q[active] = np.linalg.solve(M[np.ix_(active, active)], -gap[active])
    touching = active if gap.ndim == 1 else active[:, None]
    return q, np.where(touching, q < 0, gap + M @ q < -ROUND * np.abs(gap).max(axis=0))


def complement(M, gap, active):
    """(q, where q > 0): q >= 0, gap + M q >= 0, one of them zero; active: first guess."""
    fewest, left = gap.size + 1, TRIES
    while True:
        q, wrong = _tried(M, gap, active)
        count = np.count_nonzero(wrong)
        if count == 0:
            return q, active
        if count < fewest:
            fewest, left = count, TRIES
        elif left > 0:
            left -= 1
        else:  # one at a time: finite for a positive matrix
            wrong = np.arange(gap.size) == np.flatnonzero(wrong)[-1]
        active = active ^ wrong
