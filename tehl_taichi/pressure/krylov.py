"""Flexible GMRES (Saad 1993) with classical Gram-Schmidt, repeated where it cancels (Daniel et al. 1976).

The basis products are plain BLAS on one thread: faster than kernel launches at these sizes, and reproducible.
"""

import numpy as np

CANCELLED = 0.5  # fraction of the norm below which the projection is repeated


class Workspace:
    """Basis V and preconditioned basis Z for vectors of length n."""

    def __init__(self, n, iterations, dtype=float):
        self.iterations = iterations
        self.V, self.Z = np.zeros((iterations + 1, n), dtype), np.zeros((iterations, n - 1), dtype)


def fgmres(apply, precondition, b, tolerance, work):
    """x with |b - A x| <= tolerance |b| as far as work.iterations allow.

    apply(z, out): out = A z; precondition(v, out): out = M^-1 v. Returns (x, iterations, reduction).
    """
    beta = float(np.sqrt(np.sum(b * b)))
    if beta == 0.0:
        return np.zeros_like(work.Z[0]), 0, 0.0
    rotated = Rotations(work.iterations, beta)
    work.V[0] = b / beta
    for k in range(work.iterations):
        precondition(work.V[k], work.Z[k])
        apply(work.Z[k], work.V[k + 1])
        left = rotated.add(_extend(k, work))
        if left <= tolerance * beta or not np.isfinite(left):
            break
    return rotated.solution().astype(work.Z.dtype) @ work.Z[: k + 1], k + 1, left / beta


def _extend(k, work):
    """Orthogonalise the newest vector against the basis; returns its column of the Hessenberg matrix (k + 2,)."""
    V, w, column = work.V[: k + 1], work.V[k + 1], np.zeros(k + 2)
    norm = np.sqrt(w @ w)
    for _ in range(2):
        before = norm
        h = V @ w
        column[:-1] += h
        w -= h @ V
        norm = np.sqrt(w @ w)
        if norm > CANCELLED * before:
            break
    column[-1] = norm
    w *= w.dtype.type(1 / norm if norm > 0 else 0.0)
    return column


class Rotations:
    """The least-squares problem |beta e_1 - H y|, triangular by Givens rotations as columns of H come in."""

    def __init__(self, size, beta):
        self.R, self.turns, self.right = np.zeros((size, size)), [], np.zeros(size + 1)
        self.right[0] = beta

    def add(self, column):
        """Take one more column; returns the remaining residual."""
        k = len(self.turns)
        for i, (c, s) in enumerate(self.turns):
            column[i], column[i + 1] = c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]
        length = np.hypot(column[k], column[k + 1])
        c, s = (column[k] / length, column[k + 1] / length) if length > 0 else (1.0, 0.0)
        self.turns.append((c, s))
        self.R[:k, k], self.R[k, k] = column[:k], length
        self.right[k], self.right[k + 1] = c * self.right[k], -s * self.right[k]
        return abs(self.right[k + 1])

    def solution(self):
        """y for the columns so far (a zero column gets no weight)."""
        k = len(self.turns)
        y = np.zeros(k)
        for i in range(k - 1, -1, -1):
            if self.R[i, i] > 0:
                y[i] = (self.right[i] - self.R[i, i + 1 : k] @ y[i + 1 :]) / self.R[i, i]
        return y
