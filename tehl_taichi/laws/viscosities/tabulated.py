"""A table of viscosities."""

from itertools import pairwise

from tehl_taichi.engine.pointwise import maximum, minimum, unrolled
from tehl_taichi.laws.law import ViscosityLaw
from tehl_taichi.values.quantity import pairs
from tehl_taichi.values.registry import Checked

MOST_PAIRS = 100  # each is a piece of the compiled law


@unrolled
def ln_eta(oil, p, Gamma):
    """Piecewise linear in p through the pairs of `oil.table` ((p, ln eta), ...), the end slopes continued."""
    out, last = oil.table[0][1] + 0.0 * p, len(oil.table) - 2
    for n, ((p0, ln0), (p1, ln1)) in enumerate(pairwise(oil.table)):
        upper = p - p0 if n == last else minimum(p - p0, p1 - p0)
        out = out + (ln1 - ln0) / (p1 - p0) * (maximum(upper, 0.0) if n > 0 else upper)
    return out


def doubted(oil, Gamma, p):
    """Reason for doubt: the table ends below the Hertz pressure."""
    end = oil.table[-1][0]
    return "" if p <= end else (f"oil.table ends at {end / 1e9:.3g} GPa, the Hertz pressure is {p / 1e9:.3g} GPa: its last "
                                "slope is continued")


TABLE = ViscosityLaw(
    name="table", says="ln(eta) through the points of a table in p, no temperature", source="your own measurement",
    ln_eta=ln_eta, thinned_by=(), doubted=doubted,
    numbers={"table": pairs((), "[p in Pa, ln(eta/Pa s)]", 2, MOST_PAIRS)},
    checked=(Checked("by hand: half-way from -4 to 6", 1.0,
                     lambda: ln_eta(TABLE.having(table=((0.0, -4.0), (1e9, 6.0), (2e9, 10.0))), 0.5e9, 40.0)),
             Checked("by hand: 1 GPa beyond the end with the last slope", 14.0,
                     lambda: ln_eta(TABLE.having(table=((0.0, -4.0), (1e9, 6.0), (2e9, 10.0))), 3e9, 40.0))))
