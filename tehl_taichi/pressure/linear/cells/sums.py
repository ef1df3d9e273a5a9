"""Sums over all columns in a fixed order: CHUNKS partial sums, then GROUPS, then one."""

from tehl_taichi.engine.language import ti
from tehl_taichi.pressure.linear.gmres import COUNT, DOT_SUM, LOAD_SUM, MASS_SUM, SCALARS

CHUNKS, GROUPS = 4096, 64


@ti.func
def product(V: ti.template(), a, b, c, columns: ti.template()):
    """Partial sum c of the scalar product of rows a and b of V."""
    out = ti.cast(0.0, ti.f64)
    for q in range(ti.static((columns + CHUNKS - 1) // CHUNKS)):
        if c + q * CHUNKS < columns:
            out += ti.cast((V[a, c + q * CHUNKS] * V[b, c + q * CHUNKS]).sum(), ti.f64)
    return out


@ti.func
def products(V: ti.template(), parts: ti.template(), most: ti.template(), columns: ti.template(), outflow: ti.template(),
             basis: ti.template(), N: ti.template()):
    """Partial sums of the products of the newest vector (number COUNT + 1 of the basis) with itself, the outflow weights and
    the vectors before it."""
    for t in range((DOT_SUM + most) * CHUNKS):
        m, c = t // CHUNKS, t % CHUNKS
        new = ti.cast(N[SCALARS, COUNT], ti.i32) + 1
        if m < DOT_SUM + new and m != LOAD_SUM:
            other = basis + (m - DOT_SUM if m >= DOT_SUM else new)
            if m == MASS_SUM:
                other = outflow
            parts[m, c] = product(V, basis + new, other, c, columns)


@ti.func
def add_up(parts: ti.template(), groups: ti.template(), totals: ti.template(), first: ti.template(), end: ti.template()):
    """Add up the partial sums: totals[0, m] for first <= m < end."""
    for t in range(ti.static((end - first) * GROUPS)):
        m, g, out = first + t // GROUPS, t % GROUPS, ti.cast(0.0, ti.f64)
        for n in range(CHUNKS // GROUPS):
            out += parts[m, g + n * GROUPS]
        groups[m, g] = out
    for t in range(ti.static(end - first)):
        out = ti.cast(0.0, ti.f64)
        for g in range(GROUPS):
            out += groups[first + t, g]
        totals[0, first + t] = out
