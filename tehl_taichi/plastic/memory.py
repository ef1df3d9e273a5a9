"""Memory that run-in needs."""

from tehl_taichi.fatigue.stress.histories import AROUND, MARGIN
from tehl_taichi.plastic.half_space import PAD, odd_length
from tehl_taichi.plastic.layers import layers
from tehl_taichi.scene.resolution import shortest_length
from tehl_taichi.scene.run_in import yielding_surfaces
from tehl_taichi.scene.scales import Scales

WAVE = 420.0  # bytes of a wave in a layer: blocks, strain, stress and their sums; measured on 39x20, 77x39 and 153x77 cells


def needed_bytes(scene):
    """Bytes that the run-in of a scene needs beside its passage, within 25 %; 0 without run-in."""
    if not scene.runs_in or not yielding_surfaces(scene):
        return 0.0
    a, grid = Scales.of(scene).a, scene.grid
    dx, dy = (grid.x_max - grid.x_min) * a / grid.nx, grid.y_max * a / grid.ny
    found = layers(a, dx, shortest_length(scene))
    along = odd_length(int(PAD * _cells(scene, a, dx, "x", grid.nx)))
    across = odd_length(int(PAD * _cells(scene, a, dy, "y", 2 * grid.ny))) // 2 + 1 if scene.rows else 1
    return WAVE * along * across * (found.count + len(found.thickness))


def _cells(scene, a, side, axis, most):
    """Number of cells of the region around the features along an axis; it extends as far as the fatigue search."""
    reach = [(getattr(f, axis), f.reach if axis == "x" else f.reach_y) for f in scene.features]
    low, high = (max(AROUND * a, *(sign * at + far + MARGIN * a for at, far in reach)) for sign in (-1, 1))
    return int(min((low + high) / side + 1, most))
