"""Second fatigue index, of stresses averaged over fatigue.length."""

from tehl_taichi.scene.rough_surfaces import is_rough
from tehl_taichi.values.digits import micrometres

CELLS = 2.0  # of a grid, at least, in a length: a cell averages by itself


def why_not(scene, spacing):
    """Reason why a grid with this spacing (m) along x has no second index, or ""."""
    if is_rough(scene):
        return "the surfaces are rough and judged by percentiles"
    if scene.fatigue.length < CELLS * spacing:
        return f"the grid averages by itself: its cells are {micrometres(spacing)} um, and a length has two of them or more"
    return ""
