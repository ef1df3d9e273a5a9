"""Reduction of the moments of a stress history for planes near a given one: those that may have the largest shear or normal
stress.

A rotation of the plane by an angle changes the shear and the normal stress of a moment by at most that angle times the range of
its principal stresses (Mohr's circle). A moment that is below the best by more than both changes stays below it on all nearby
planes, and a circle around the shear of the others about the same centre also encloses it.
"""

from tehl_taichi.engine.language import ti
from tehl_taichi.fatigue.plane_components import stress, traction


@ti.func
def deciding(S: ti.template(), some: ti.template(), a: ti.template(), b: ti.template(), row, count, n, middle, reach):
    """Sort the moments some[row, :count] so that those that may matter on planes within `reach` (rad) of n come first, with
    shear relative to that of the stress `middle`; returns their number. Scratch: a, b.
    """
    far, top = -1e300, -1e300
    for q in range(count):
        shear, normal, turned = ends(stress(S, row, some[row, q]) - middle, n, reach)
        far, top = ti.max(far, shear - turned), ti.max(top, normal - turned)
        a[row, q], b[row, q] = shear + turned, normal + turned
    q, left = 0, count
    while q < left:
        if a[row, q] >= far or b[row, q] >= top:
            q += 1
        else:
            left -= 1
            some[row, q], some[row, left] = some[row, left], some[row, q]
            a[row, q], b[row, q] = a[row, left], b[row, left]
    return left


@ti.func
def ends(s, n, reach):
    """Shear and normal stress of s on the plane n, and their largest changes on planes within `reach`."""
    a, b, c, normal = traction(s, n[0], n[1], n[2])
    mean = (s[0] + s[1] + s[2]) / 3
    x, y, z = s[0] - mean, s[1] - mean, s[2] - mean
    size = x * x + y * y + z * z + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])  # the range is at most the root of twice that
    return ti.sqrt(ti.max(a * a + b * b + c * c - normal * normal, 0.0)), normal, reach * ti.sqrt(2 * size)
