"""Strength table over depth: numbers in SI units as text, which a scene and its store carry, and its columns."""

import functools
from dataclasses import dataclass

DEPTH, HARDNESS, LIMIT, KAPPA = "depth_m", "hardness_HV", "limit_Pa", "kappa"
YIELD, RESIDUAL = "yield_stress_Pa", ("residual_xx_Pa", "residual_yy_Pa")
COLUMNS = (DEPTH, HARDNESS, LIMIT, KAPPA, YIELD, *RESIDUAL)


@dataclass(frozen=True)
class StrengthTable:
    """Columns of a table: {name of COLUMNS: one number per depth}; depths increase."""

    columns: dict

    def has(self, *names):
        return all(name in self.columns for name in names)

    def at(self, name, depth):
        """Value of a column at a depth (m): linear interpolation, constant beyond the ends; a number or an array."""
        import numpy as np

        return np.interp(depth, self.columns[DEPTH], self.columns[name])


def text_of(columns):
    """Text of columns {name: numbers}: a line of names, then one line per depth. Reading it gives equal numbers."""
    lines = [",".join(columns), *(",".join(repr(float(value)) for value in row) for row in zip(*columns.values()))]
    return "\n".join(lines)


@functools.lru_cache(64)
def of_text(text):
    """Read a StrengthTable from its text. Raises ValueError, KeyError if it is none."""
    names, *rows = (line.split(",") for line in text.split("\n"))
    numbers = [tuple(map(float, row)) for row in rows]
    if not numbers or names[0] != DEPTH or set(names) - set(COLUMNS) or {len(row) for row in numbers} != {len(names)}:
        raise ValueError("no table of strength")
    return StrengthTable(dict(zip(names, zip(*numbers))))
