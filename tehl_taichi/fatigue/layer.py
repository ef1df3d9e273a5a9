"""All material points at one depth: their stresses, their critical planes, the worst of them."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue import findley
from tehl_taichi.fatigue.thermal_stress import WORKERS
from tehl_taichi.fatigue.worst_point import Point, worse, worst_of

POINTS = 16  # whose largest principal stresses are found at once


@dataclass(frozen=True)
class Layer:
    """What was found at one depth: maps (nx, rows), the worst point, and that of the early moments where they are wanted."""

    depth: float
    f: np.ndarray
    theta: np.ndarray
    phi: np.ndarray
    sigma1: np.ndarray
    worst: Point
    early: Point | None


def layer(scene, passage, depth, progress, early):
    """Find a Layer: stresses and search of all points at a depth (m). early: moments that are searched apart, or None."""
    operators, parts, worst, before = passage.stresses(depth), [], None, None
    for rows in passage.row_blocks():
        history = passage.history(rows, operators, progress, lambda: findley.prepare(scene.fatigue.criterion))
        f, normals = findley.search(history, scene.fatigue.kappa, criterion=scene.fatigue.criterion, tell=progress)
        shape = passage.x.size, rows.stop - rows.start
        parts.append([v.reshape(shape) for v in (f, *findley.angles(normals), _tension(history))])
        places = passage.places(depth, rows)
        worst = worse(worst, places, history, f, normals)
        if early is not None:
            before = worst_of(history, early, scene.fatigue, f, places, before)
    return Layer(depth, *(np.concatenate(part, axis=1) for part in zip(*parts)), worst, before)


def _tension(history):
    """Largest principal stress of every point (points,), Pa, over its history."""
    def of(points):
        return findley.largest_principal(points).max(axis=1)

    with ThreadPoolExecutor(WORKERS) as pool:
        return np.concatenate(list(pool.map(of, np.array_split(history, -(-len(history) // POINTS)))))
