"""Closed faces with Coulomb friction, moment after moment: they stick, or slide against a force of mu times the contact force.

Slip has a history, so the passage is gone through :data:`PASSES` times and the last one counts.
"""

import numpy as np

PASSES = 2
WHOLE = 12  # exchanges of whole sets, then one node at a time
TRIES = 60  # exchanges of states in a moment; then it counts as not settled
OPEN, STUCK, UP, DOWN = 0, 1, 2, 3  # UP: the slip grows
ROUND = 1e-7  # of the largest opening, slip or force: less decides nothing


def rubbed(compliance, forces, mu):
    """(values (2 nodes, moments), contact forces (nodes, moments), number of moments that did not settle) with friction."""
    nodes, moments = len(forces) // 2, forces.shape[1]
    values, held = np.zeros_like(forces), np.zeros((nodes, moments))
    free = compliance @ forces
    state, slip = np.full(nodes, OPEN), np.zeros(nodes)
    for _ in range(PASSES):
        missed = 0
        for moment in range(moments):
            state, values[:, moment], held[:, moment], settled = _moment(compliance, free[:, moment], mu, state, slip)
            slip, missed = values[nodes:, moment].copy(), missed + (not settled)
    return values, held, missed


def _moment(C, free, mu, state, slip):
    """(state, values, contact forces, whether they settled) at one moment; slip: before it."""
    for tried in range(TRIES):
        values, q, f = _forces(C, free, mu, state, slip)
        new = _next(state, values, q, f, mu, slip)
        wrong = np.flatnonzero(new != state)
        if wrong.size == 0:
            return state, values, q, True
        wrong = wrong if tried < WHOLE else wrong[-1:]
        state = state.copy()
        state[wrong] = new[wrong]
    return state, values, np.maximum(q, 0.0), False


def _forces(C, free, mu, state, slip):
    """Values, contact and friction forces (nodes,) in given states."""
    nodes = state.size
    q, f = np.zeros((2, nodes))
    k, stuck = np.flatnonzero(state != OPEN), np.flatnonzero(state == STUCK)
    if k.size == 0:
        return free, q, f
    rub = mu * ((state == DOWN) * 1.0 - (state == UP))
    rows = np.concatenate([k, nodes + stuck])
    columns = np.concatenate([C[:, k] + rub[k] * C[:, nodes + k], C[:, nodes + stuck]], axis=1)
    found = np.linalg.solve(columns[rows], np.concatenate([-free[k], slip[stuck] - free[nodes + stuck]]))
    q[k] = found[: k.size]
    f[k] = rub[k] * q[k]
    f[stuck] = found[k.size :]
    values = free + columns @ found
    values[k] = 0.0
    values[nodes + stuck] = slip[stuck]
    return values, q, f


def _next(state, values, q, f, mu, slip):
    """States that suit these values and forces better."""
    nodes, new = state.size, state.copy()
    opening, growth = values[:nodes], values[nodes:] - slip
    small = ROUND * max(np.abs(values).max(), 1e-300)
    over = (state == STUCK) & (np.abs(f) > mu * q + ROUND * mu * np.abs(q).max())
    new[over] = np.where(f[over] < 0, UP, DOWN)
    new[((state == UP) & (growth < -small)) | ((state == DOWN) & (growth > small))] = STUCK
    new[(state != OPEN) & (q < -ROUND * np.abs(q).max())] = OPEN
    new[(state == OPEN) & (opening < -small)] = STUCK
    return new
