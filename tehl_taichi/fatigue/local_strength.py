"""Numbers of a subsurface point, with the strength there."""


def summary(passage, point):
    """Numbers of a subsurface WorstPoint of a StressHistories."""
    return {"depth_m": point.depth, **point.summary(), **of_point(passage, point)}


def of_point(passage, point):
    """Strength at such a point: with a table "sigma_eF_Pa", "kappa_F"; with a table or after run-in "residual_xx_Pa",
    "residual_yy_Pa".
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
