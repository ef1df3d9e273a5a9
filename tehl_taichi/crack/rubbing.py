"""Closed faces with Coulomb friction, moment after moment: they stick, or slide against a force of mu times the contact force.

Slip has a history, so the passage is gone through :data:`PASSES` times and the last one counts. In a moment whole sets of
states are exchanged; where that goes round in circles, the friction is bounded by mu times the contact force of the round
before (a positive problem with one answer) until both agree (Haslinger 1983).
"""

import numpy as np

from tehl_taichi.crack.bounds import FREE, HIGH, LOW, bounded
from tehl_taichi.crack.closure import shut

PASSES = 2
TRIES, ROUNDS = 6, 60  # exchanges of states, rounds of bounds in a moment; then it counts as not settled
SAME = 1e-8            # of the largest contact force: two rounds agree
OPEN, STUCK, UP, DOWN = 0, 1, 2, 3  # UP: the slip grows
ROUND = 1e-7  # of the largest opening, slip or force: less decides nothing


def rubbed(faces, forces, mu):
    """(nodal values (2 nodes, moments), contact forces (contacts, moments), number of moments that did not settle)."""
    G, rough, moments = faces.contact, faces.rough, forces.shape[1]
    contacts = len(G) - rough
    S, free, found = G @ faces.compliance @ G.T, G @ faces.compliance @ forces, np.zeros((len(G), moments))
    state, slip = np.full(contacts, OPEN), np.zeros(rough)
    for _ in range(PASSES):
        missed = 0
        for moment in range(moments):
            state, found[:, moment], settled = _moment(S, free[:, moment], mu, state, slip)
            slip, missed = (free[:, moment] + S @ found[:, moment])[contacts:], missed + (not settled)
    held = found[:contacts]
    return shut(faces, faces.compliance @ (forces + G.T @ found), held), held, missed


def _moment(S, free, mu, state, slip):
    """(state, forces (contacts + rough,), whether they settled) at one moment; slip: before it."""
    for _ in range(TRIES):
        r = _forces(S, free, mu, state, slip)
        new = _next(state, r, free + S @ r, mu, slip)
        if (new == state).all():
            return state, r, True
        state = new
    return _by_bounds(S, free, mu, slip, np.maximum(r[: state.size], 0.0))


def _by_bounds(S, free, mu, slip, q):
    """As :func:`_moment`, from contact forces q (contacts,) on."""
    rough, gap = slip.size, free - np.concatenate([0 * q, slip])
    at = np.where(np.concatenate([q, q[:rough]]) > 0, FREE, LOW)
    for _ in range(ROUNDS):
        bound = mu * q[:rough]
        r, at = bounded(S, gap, np.concatenate([0 * q, -bound]), np.concatenate([0 * q + np.inf, bound]), at)
        change, q = np.abs(r[: q.size] - q).max(), r[: q.size]
        if change <= SAME * q.max():
            break
    state = np.where(q > 0, UP, OPEN)
    sticking = at[q.size :]
    state[:rough] = np.select([q[:rough] <= 0, sticking == LOW, sticking == HIGH], [OPEN, UP, DOWN], STUCK)
    return state, r, bool(change <= SAME * q.max())


def _forces(S, free, mu, state, slip):
    """Contact and friction forces (contacts + rough,) in given states."""
    contacts, rough = state.size, slip.size
    k, stuck, r = np.flatnonzero(state != OPEN), np.flatnonzero(state[:rough] == STUCK), np.zeros(len(S))
    rub = np.zeros((rough, contacts))
    rub[np.arange(rough), np.arange(rough)] = mu * ((state[:rough] == DOWN) * 1.0 - (state[:rough] == UP))
    rows = np.concatenate([k, contacts + stuck])
    columns = np.concatenate([S[:, k] + S[:, contacts:] @ rub[:, k], S[:, contacts + stuck]], axis=1)
    found = np.linalg.solve(columns[rows], np.concatenate([-free[k], slip[stuck] - free[contacts + stuck]]))
    r[k] = found[: k.size]
    r[contacts:] = rub @ r[:contacts]
    r[contacts + stuck] = found[k.size :]
    return r


def _next(state, r, moved, mu, slip):
    """States that suit these forces and openings and slips `moved` better."""
    contacts, rough, new = state.size, slip.size, state.copy()
    q, f, opening, growth = r[:contacts], r[contacts:], moved[:contacts], moved[contacts:] - slip
    small, weak, rubs = ROUND * np.abs(moved).max(), ROUND * np.abs(q).max(), state[:rough]
    over = (rubs == STUCK) & (np.abs(f) > mu * (q[:rough] + weak))
    new[:rough][over] = np.where(f[over] < 0, UP, DOWN)
    new[:rough][((rubs == UP) & (growth < -small)) | ((rubs == DOWN) & (growth > small))] = STUCK
    new[(state != OPEN) & (q < -weak)] = OPEN
    new[(state == OPEN) & (opening < -small)] = STUCK
    new[rough:][new[rough:] == STUCK] = UP  # without friction of its own
    return new
