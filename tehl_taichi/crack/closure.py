"""Faces that may touch but not pass through each other: opening >= 0, contact force >= 0, one of them zero at every node.

A tip whose node is closed has K_I = 0.
"""

import numpy as np

from tehl_taichi.crack.bounds import FREE, LOW, ROUND, bounded


def opened(compliance, forces):
    """(values, contact forces), (2 nodes, moments) and (nodes, moments): without friction."""
    nodes = len(forces) // 2
    free, held = compliance @ forces, np.zeros((nodes, forces.shape[1]))
    gap, M, at = free[:nodes], compliance[:nodes, :nodes], np.full(nodes, LOW)
    left = np.flatnonzero((gap < 0).any(axis=0))
    while left.size:
        at = bounded(M, gap[:, left[0]], np.zeros(nodes), np.full(nodes, np.inf), at)[1]
        q, fits = _tried(M, gap[:, left], at == FREE)
        fits[0] = True  # many other moments have the same closed nodes
        held[:, left[fits]] = q[:, fits]
        left = left[~fits]
    values = free + compliance[:, :nodes] @ held
    values[:nodes][held > 0] = 0.0
    return values, held


def _tried(M, gap, closed):
    """(q (nodes, moments), at which moments it fits) when just these nodes touch."""
    q = np.zeros_like(gap)
    q[closed] = np.linalg.solve(M[np.ix_(closed, closed)], -gap[closed])
    wrong = np.where(closed[:, None], q < 0, gap + M @ q < -ROUND * np.abs(gap).max(axis=0))
    return q, ~wrong.any(axis=0)
