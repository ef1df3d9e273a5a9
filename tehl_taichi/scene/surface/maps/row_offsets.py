"""Height offsets between the rows of a scan: in stitched maps and in maps measured line by line."""

from dataclasses import dataclass

import numpy as np

NORMAL = 1.4826  # standard deviation over the median of the sizes
MORE = 2.0  # times what heights change from row to row: less is roughness
JUMP = 8.0  # times the usual jump of rows: a stitch
ALIKE, LOOSE = 0.5, 0.3  # correlation of neighbouring rows without their offsets, at least, and of the offsets, at most
FEWEST = 8  # rows


@dataclass(frozen=True)
class RowOffsets:
    """size: usual offset between rows, or the largest one of a stitch (m); rows: number of row pairs with an offset, 0: all."""

    size: float
    rows: int


def without_offsets(values):
    """Heights (rows, columns) less the median of each row."""
    return values - np.median(values, axis=1, keepdims=True)


def find(values):
    """Find the :class:`RowOffsets` of heights (rows, columns) without a plane; None without offsets.

    Grinding marks along the rows also change from row to row, but gradually; they are no offsets.
    """
    if len(values) < FEWEST:
        return None
    offsets, rest = np.median(values, axis=1), without_offsets(values)
    jumps = np.abs(np.diff(offsets))
    within = NORMAL * float(np.median(np.abs(np.diff(rest, axis=0))))
    usual = NORMAL * float(np.median(jumps))
    if usual > MORE * within and within > 0 and _correlation(rest) > ALIKE and _correlation(offsets[:, None]) < LOOSE:
        return RowOffsets(usual, 0)
    stitches = jumps > max(JUMP * usual, MORE * within, 1e-3 * float(np.ptp(values)))
    few = 0 < stitches.sum() <= len(jumps) / FEWEST
    return RowOffsets(float(jumps.max()), int(stitches.sum())) if few else None


def _correlation(values):
    """Correlation of neighbouring rows."""
    first, second = values[:-1] - values[:-1].mean(), values[1:] - values[1:].mean()
    size = float(np.sqrt((first**2).sum() * (second**2).sum()))
    return float((first * second).sum()) / size if size > 0 else 0.0
