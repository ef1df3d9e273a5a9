"""Numbers and arrays of strength over depth that a search reports; none where the scene has no table."""

import numpy as np

from tehl_taichi.scene.strength.table import YIELD


def of_point(strength, point):
    """Strength at a point below the surface: "sigma_eF_Pa", "kappa_F", "residual_xx_Pa", "residual_yy_Pa"."""
    if strength.table is None:
        return {}
    local, (along, across) = point.local, strength.residual(point.depth)
    return {"sigma_eF_Pa": local.endurance, "kappa_F": local.kappa, "residual_xx_Pa": float(along),
            "residual_yy_Pa": float(across)}


def limits(strength, depths):
    """sigma_eF (Pa) at depths (m), None without a table."""
    return None if strength.table is None else np.array(strength.limits(depths))


def varies_in_yield(strength):
    """Whether the yield stress follows from a table."""
    return strength.table is not None and strength.table.has(YIELD)
