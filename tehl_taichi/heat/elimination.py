"""Full linear system for each lane of a column: X[c, n nz + m] the matrix, X[c, nz nz + n] the right side."""

from tehl_taichi.engine.language import ti


@ti.func
def eliminate(X: ti.template(), c, nz):
    """Solve the system in X[c] in place (conduction makes it safe without pivoting).

    The solution replaces the right side, the inverse pivots the diagonal. (x -= y on a field would be atomic.)
    """
    rhs = nz * nz
    for d in range(nz):
        inverse = 1.0 / X[c, d * nz + d]
        X[c, d * nz + d] = inverse
        for r in range(d + 1, nz):
            f = X[c, r * nz + d] * inverse
            for m in range(d + 1, nz):
                X[c, r * nz + m] = X[c, r * nz + m] - f * X[c, d * nz + m]
            X[c, rhs + r] = X[c, rhs + r] - f * X[c, rhs + d]
    for back in range(nz):
        d = nz - 1 - back
        total = X[c, rhs + d]
        for m in range(d + 1, nz):
            total -= X[c, d * nz + m] * X[c, rhs + m]
        X[c, rhs + d] = total * X[c, d * nz + d]
