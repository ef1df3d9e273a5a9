"""Closed faces with Coulomb friction, moment by moment: they stick, or slip against a force of mu times the contact force.

Slip depends on its history, so the passage is computed twice and the second result counts. In each moment whole sets of states
are exchanged. If that cycles, the friction is bounded by mu times the contact force of the previous iteration (a positive
problem with one solution) until both agree (Haslinger 1983). States last for several moments, so several are solved at once.
The second passage ends where it agrees with the first one.
"""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.crack.closure import close_tips
from tehl_taichi.crack.complementarity import FREE, HIGH, LOW, solve_bounded, solve_compliant

TRIES, ROUNDS = 6, 60  # exchanges of states, rounds of bounds in a moment; then it counts as not settled
SAME = 1e-8            # of the largest contact force: two rounds agree
OPEN, STUCK, UP, DOWN = 0, 1, 2, 3  # UP: the slip grows
ROUND = 1e-7    # of the largest opening, slip or force: less decides nothing
AHEAD = 8       # moments tried at once with one state (4 and 16: as fast)
FORGOT = 1e-12  # of the largest slip: passages that differ by less, in the same state, continue alike


@dataclass
class FrictionHistory:
    """States of a passage: forces (contacts + rough, moments), states (contacts, moments), slip (rough, moments), settled
    (moments,).
    """

    forces: np.ndarray
    state: np.ndarray
    slip: np.ndarray
    settled: np.ndarray

    @classmethod
    def none(cls, contacts, rough, moments):
        return cls(np.zeros((contacts + rough, moments)), np.zeros((contacts, moments), int), np.zeros((rough, moments)),
                   np.ones(moments, bool))

    def put(self, at, r, state, slip, settled):
        """Store the values of moments `at`; `state` (contacts,) holds in all of them."""
        self.forces[:, at], self.state[:, at], self.slip[:, at], self.settled[at] = r, state[:, None], slip, settled

    def meets(self, other, at):
        """Whether both histories agree after this moment."""
        apart = np.abs(self.slip[:, at] - other.slip[:, at]).max()
        return (self.state[:, at] == other.state[:, at]).all() and apart <= FORGOT * np.abs(other.slip).max()

    def follow(self, other, begin):
        """Copy the other history from moment `begin` on."""
        rest = slice(begin, None)
        self.forces[:, rest], self.state[:, rest] = other.forces[:, rest], other.state[:, rest]
        self.slip[:, rest], self.settled[rest] = other.slip[:, rest], other.settled[rest]


def with_friction(faces, forces, mu):
    """Solve the contact of faces with friction. Returns (nodal values (2 nodes, moments), contact forces (contacts, moments),
    number of moments that did not settle).
    """
    G, contacts = faces.contact, len(faces.contact) - faces.rough
    S, free = G @ faces.compliance @ G.T, G @ faces.compliance @ forces
    first = _passage(S, free, mu, np.full(contacts, OPEN), np.zeros(faces.rough))
    history = _passage(S, free, mu, first.state[:, -1], first.slip[:, -1], first)
    held = history.forces[:contacts]
    return close_tips(faces, faces.compliance @ (forces + G.T @ history.forces), held), held, int((~history.settled).sum())


def _passage(S, free, mu, state, slip, before=None):
    """The :class:`FrictionHistory` of a passage that starts with this state (contacts,) and slip (rough,).

    It ends early where it agrees with the passage `before`.
    """
    moments = free.shape[1]
    history, now = FrictionHistory.none(state.size, slip.size, moments), 0
    while now < moments:
        *done, then = solve_some(S, free[:, now : now + AHEAD], mu, state, slip)
        history.put(slice(now, now + done[0].shape[1]), *done)
        now, state = now + done[0].shape[1], then
        slip = history.slip[:, now - 1]
        if before and history.meets(before, now - 1):
            history.follow(before, now)
            break
    return history


def solve_some(S, free, mu, state, slip):
    """Solve the first n moments of `free` (at least one) that share one state.

    Returns (forces (contacts + rough, n), the state, slip (rough, n), settled, guess of the next state).
    """
    contacts, r = state.size, np.zeros(0)
    for _ in range(TRIES):
        r = _forces(S, free, mu, state, slip)
        moved = free + S @ r
        new = _next_states(state, r, moved, mu, slip)
        n = _count_in_state(state, new)
        if n:
            return r[:, :n], state, moved[contacts:, :n], True, new[:, min(n, new.shape[1] - 1)]
        state = new[:, 0]
    state, r, settled = solve_by_bounds(S, free[:, 0], mu, slip, np.maximum(r[:contacts, 0], 0.0))
    return r[:, None], state, (free[:, :1] + S @ r[:, None])[contacts:], settled, state


def _count_in_state(state, new):
    """Number of consecutive moments from the first one on that are in this state."""
    wrong = np.flatnonzero((new != state[:, None]).any(axis=0))
    return wrong[0] if wrong.size else new.shape[1]


def solve_by_bounds(S, free, mu, slip, q):
    """Solve one moment with bounded friction, starting with contact forces q (contacts,); slip: of the previous moment.

    Returns (state, forces, whether it settled).
    """
    rough, gap = slip.size, free - np.concatenate([0 * q, slip])
    at = np.where(np.concatenate([q, q[:rough]]) > 0, FREE, LOW)
    for _ in range(ROUNDS):
        bound = mu * q[:rough]
        r, at = solve_bounded(S, gap, np.concatenate([0 * q, -bound]), np.concatenate([0 * q + np.inf, bound]), at)
        change, q = np.abs(r[: q.size] - q).max(), r[: q.size]
        if change <= SAME * q.max():
            break
    state = np.where(q > 0, UP, OPEN)
    sticking = at[q.size :]
    state[:rough] = np.select([q[:rough] <= 0, sticking == LOW, sticking == HIGH], [OPEN, UP, DOWN], STUCK)
    return state, r, bool(change <= SAME * q.max())


def _forces(S, free, mu, state, slip):
    """Contact and friction forces (contacts + rough, moments) if all moments have this state."""
    contacts, rough, r = state.size, slip.size, np.zeros_like(free)
    touching, stuck = np.flatnonzero(state != OPEN), np.flatnonzero(state[:rough] == STUCK)
    rub = mu * ((state[:rough] == DOWN) * 1.0 - (state[:rough] == UP))
    rows = np.concatenate([touching, contacts + stuck])
    columns, sliding = S[:, rows], np.flatnonzero(rub)
    columns[:, np.searchsorted(touching, sliding)] += S[:, contacts + sliding] * rub[sliding]
    right_side = -free[rows]
    right_side[touching.size :] += slip[stuck, None]
    found = solve_compliant(columns[rows], right_side)
    r[touching] = found[: touching.size]
    r[contacts:] = rub[:, None] * r[:rough]
    r[contacts + stuck] = found[touching.size :]
    return r


def _next_states(state, r, moved, mu, slip):
    """States (contacts, moments) of the next iteration, from these forces, openings and slips."""
    contacts, rough, rubs = state.size, slip.size, state[: slip.size, None]
    q, f, opening = r[:contacts], r[contacts:], moved[:contacts]
    growth = moved[contacts:] - np.concatenate([slip[:, None], moved[contacts:, :-1]], axis=1)
    small, weak = ROUND * np.abs(moved).max(axis=0), ROUND * np.abs(q).max(axis=0)
    new = np.repeat(state[:, None], r.shape[1], axis=1)
    over = (rubs == STUCK) & (np.abs(f) > mu * (q[:rough] + weak))
    back = ((rubs == UP) & (growth < -small)) | ((rubs == DOWN) & (growth > small))
    new[:rough] = np.where(over, np.where(f < 0, UP, DOWN), np.where(back, STUCK, new[:rough]))
    new[(state[:, None] != OPEN) & (q < -weak)] = OPEN
    new[(state[:, None] == OPEN) & (opening < -small)] = STUCK
    new[rough:][new[rough:] == STUCK] = UP  # without friction of its own
    return new
