"""Closed faces with Coulomb friction, moment after moment: they stick, or slide against a force of mu times the contact force.

Slip has a history, so the passage is gone through :data:`PASSES` times and the last one counts. In a moment whole sets of
states are exchanged; where that goes round in circles, the friction is bounded by mu times the contact force of the round
before (a positive problem with one answer) until both agree (Haslinger 1983).
"""

import numpy as np

from tehl_taichi.crack.bounds import FREE, HIGH, LOW, bounded

PASSES = 2
TRIES, ROUNDS = 6, 60  # exchanges of states, rounds of bounds in a moment; then it counts as not settled
SAME = 1e-8            # of the largest contact force: two rounds agree
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
    for _ in range(TRIES):
        values, q, f = _forces(C, free, mu, state, slip)
        new = _next(state, values, q, f, mu, slip)
        if (new == state).all():
            return state, values, q, True
        state = new
    return _by_bounds(C, free, mu, slip, np.maximum(q, 0.0))


def _by_bounds(C, free, mu, slip, q):
    """As :func:`_moment`, from contact forces q (nodes,) on."""
    nodes, at = slip.size, np.where(np.tile(q > 0, 2), FREE, LOW)
    gap = free - np.concatenate([np.zeros(nodes), slip])
    for _ in range(ROUNDS):
        low, high = np.concatenate([0 * q, -mu * q]), np.concatenate([0 * q + np.inf, mu * q])
        r, at = bounded(C, gap, low, high, at)
        change, q = np.abs(r[:nodes] - q).max(), r[:nodes]
        if change <= SAME * q.max():
            break
    state = np.select([q <= 0, at[nodes:] == LOW, at[nodes:] == HIGH], [OPEN, UP, DOWN], STUCK)
    return state, free + C @ r, q, bool(change <= SAME * q.max())


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
