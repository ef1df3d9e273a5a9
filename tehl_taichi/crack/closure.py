"""Faces that may touch but not pass through each other: opening >= 0, contact force >= 0, one of them zero at every contact.

A tip that touches has K_I = 0.
"""

import numpy as np

from tehl_taichi.crack.complementarity import FREE, LOW, ROUND, solve_bounded


def frictionless(faces, forces):
    """Solve the contact of frictionless faces for given nodal forces. Returns (nodal values (2 nodes, moments), contact forces
    (contacts, moments)).
    """
    rows = faces.contact[: len(faces.contact) - faces.rough]
    free, held = faces.compliance @ forces, np.zeros((len(rows), forces.shape[1]))
    gap, M, at = rows @ free, rows @ faces.compliance @ rows.T, np.full(len(rows), LOW)
    left = np.flatnonzero((gap < 0).any(axis=0))
    while left.size:
        at = solve_bounded(M, gap[:, left[0]], np.zeros(len(rows)), np.full(len(rows), np.inf), at)[1]
        q, fits = _contact_forces(M, gap[:, left], at == FREE)
        fits[0] = True  # many other moments have the same closed contacts
        held[:, left[fits]] = q[:, fits]
        left = left[~fits]
    return close_tips(faces, free + faces.compliance @ (rows.T @ held), held), held


def close_tips(faces, values, held):
    """Nodal values with exactly zero opening at a closed tip (rounding leaves a small one)."""
    values[faces.nodes - 1][held[faces.rough - 1] > 0] = 0.0
    return values


def _contact_forces(M, gap, closed):
    """Contact forces q (contacts, moments) if exactly the contacts `closed` touch, and the consistent moments."""
    q = np.zeros_like(gap)
    q[closed] = np.linalg.solve(M[np.ix_(closed, closed)], -gap[closed])
    wrong = np.where(closed[:, None], q < 0, gap + M @ q < -ROUND * np.abs(gap).max(axis=0))
    return q, ~wrong.any(axis=0)
