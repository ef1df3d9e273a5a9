"""Strength over depth in the results of a search: numbers and arrays; none without a table."""

import numpy as np

from tehl_taichi.scene.strength.table import YIELD


def of_point(passage, point):
    """Strength at a subsurface point of a StressHistories: with a table "sigma_eF_Pa", "kappa_F"; with a table or after run-in
    "residual_xx_Pa", "residual_yy_Pa".
    """
    table, left = passage.strength.table, passage.left
    if table is None and left is None:
        return {}
    along, across = passage.strength.residual(point.depth)
    if left is not None:
        found = left.at([point.x], [point.y], [point.depth])[0, 0, 0]
        along, across = along + found[0], across + found[1]
    limits = {"sigma_eF_Pa": point.local.endurance, "kappa_F": point.local.kappa} if table else {}
    return {**limits, "residual_xx_Pa": float(along), "residual_yy_Pa": float(across)}


def limits(strength, depths):
    """Limits sigma_eF (Pa) at depths (m), None without a table."""
    return None if strength.table is None else np.array(strength.limits(depths))


def varies_in_yield(strength):
    """Whether a table gives the yield stress."""
    return strength.table is not None and strength.table.has(YIELD)
