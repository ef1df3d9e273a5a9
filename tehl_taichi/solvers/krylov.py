"""Flexible GMRES (Saad 1993) with twice-applied Gram-Schmidt; reductions in fixed blocks, so reproducible."""

import numpy as np

from tehl_taichi.kernels import reduce


class Workspace:
    """Basis V, preconditioned basis Z and partial sums for vectors of length n."""

    def __init__(self, n, iterations):
        self.n, self.iterations = n, iterations
        self.V, self.Z = np.zeros((iterations + 1, n)), np.zeros((iterations, n))
        self.partial = np.zeros(((n + reduce.BLOCK - 1) // reduce.BLOCK, iterations + 1))
        self.x = np.zeros(n)

    def dots(self, count, w):
        """V[:count] @ w."""
        reduce.block_dots(self.V, count, w, self.n, self.partial)
        return self.partial[:, :count].sum(axis=0)


def fgmres(apply, precondition, b, tolerance, work):
    """x with |b - A x| <= tolerance |b| as far as work.iterations allow.

    apply(z) -> A z and precondition(v) -> M^-1 v take and return vectors (n,). Returns (x, iterations, reduction).
    """
    beta = float(np.sqrt(np.sum(b * b)))
    if beta == 0.0:
        return np.zeros_like(b), 0, 0.0
    hessenberg = np.zeros((work.iterations + 1, work.iterations))
    work.V[0] = b / beta
    for k in range(work.iterations):
        work.Z[k] = precondition(work.V[k])
        _extend(apply(work.Z[k]), k, hessenberg, work)
        y, left = _least_squares(hessenberg[: k + 2, : k + 1], beta)
        if left <= tolerance * beta or not np.isfinite(left):
            break
    reduce.combine(work.Z, k + 1, y, work.x, work.n)
    return work.x.copy(), k + 1, left / beta


def _extend(w, k, hessenberg, work):
    for _ in range(2):
        h = work.dots(k + 1, w)
        hessenberg[: k + 1, k] += h
        reduce.subtract(work.V, k + 1, h, w, work.n)
    norm = float(np.sqrt(np.sum(w * w)))
    hessenberg[k + 1, k] = norm
    work.V[k + 1] = w / norm if norm > 0 else 0.0


def _least_squares(hessenberg, beta):
    right = np.zeros(hessenberg.shape[0])
    right[0] = beta
    y = np.linalg.lstsq(hessenberg, right, rcond=None)[0]
    return y, float(np.linalg.norm(right - hessenberg @ y))
