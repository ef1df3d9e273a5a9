"""Flexible GMRES (Saad 1993) with twice-applied Gram-Schmidt.

The basis products are plain BLAS on one thread: faster than kernel launches at these sizes, and reproducible.
"""

import numpy as np


class Workspace:
    """Basis V and preconditioned basis Z for vectors of length n."""

    def __init__(self, n, iterations):
        self.iterations = iterations
        self.V, self.Z = np.zeros((iterations + 1, n)), np.zeros((iterations, n - 1))


def fgmres(apply, precondition, b, tolerance, work):
    """x with |b - A x| <= tolerance |b| as far as work.iterations allow.

    apply(z) -> A z and precondition(v) -> M^-1 v take and return vectors (n,). Returns (x, iterations, reduction).
    """
    beta = float(np.sqrt(np.sum(b * b)))
    if beta == 0.0:
        return np.zeros(work.Z.shape[1]), 0, 0.0
    hessenberg = np.zeros((work.iterations + 1, work.iterations))
    work.V[0] = b / beta
    for k in range(work.iterations):
        work.Z[k] = precondition(work.V[k])
        _extend(apply(work.Z[k]), k, hessenberg, work)
        y, left = _least_squares(hessenberg[: k + 2, : k + 1], beta)
        if left <= tolerance * beta or not np.isfinite(left):
            break
    return y @ work.Z[: k + 1], k + 1, left / beta


def _extend(w, k, hessenberg, work):
    for _ in range(2):
        h = work.V[: k + 1] @ w
        hessenberg[: k + 1, k] += h
        w -= h @ work.V[: k + 1]
    norm = float(np.sqrt(np.sum(w * w)))
    hessenberg[k + 1, k] = norm
    work.V[k + 1] = w / norm if norm > 0 else 0.0


def _least_squares(hessenberg, beta):
    right = np.zeros(hessenberg.shape[0])
    right[0] = beta
    y = np.linalg.lstsq(hessenberg, right, rcond=None)[0]
    return y, float(np.linalg.norm(right - hessenberg @ y))
