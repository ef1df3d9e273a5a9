"""Stress tensor in kernels, and its components on a plane."""

from tehl_taichi.engine.language import ti
from tehl_taichi.fatigue.enclosing_circle import vec3

vec6 = ti.types.vector(6, ti.f64)


@ti.func
def stress(S: ti.template(), row, t):
    """Stress (xx, yy, zz, xy, xz, yz) of this point and moment."""
    return vec6(S[row, t, 0], S[row, t, 1], S[row, t, 2], S[row, t, 3], S[row, t, 4], S[row, t, 5])


@ti.func
def mean_stress(S: ti.template(), row, t):
    """Mean normal stress of this point and moment."""
    return (S[row, t, 0] + S[row, t, 1] + S[row, t, 2]) / 3


@ti.func
def plane_frame(n):
    """Two unit vectors that complete n to a right-handed frame."""
    h = vec3(0.0, 0.0, 1.0)
    if ti.abs(n[2]) > 0.9:
        h = vec3(1.0, 0.0, 0.0)
    e = h.cross(n).normalized()
    return e, n.cross(e)


@ti.func
def project(S: ti.template(), row, t, u, n):
    """Component u . sigma . n of the stress of this point and moment."""
    return (u[0] * n[0] * S[row, t, 0] + u[1] * n[1] * S[row, t, 1] + u[2] * n[2] * S[row, t, 2]
            + (u[0] * n[1] + u[1] * n[0]) * S[row, t, 3] + (u[0] * n[2] + u[2] * n[0]) * S[row, t, 4]
            + (u[1] * n[2] + u[2] * n[1]) * S[row, t, 5])


@ti.func
def shear_of(s, u, n):
    """Component u . s . n."""
    a, b, c, _ = traction(s, n[0], n[1], n[2])
    return u[0] * a + u[1] * b + u[2] * c


@ti.func
def traction(s, x, y, z):
    """Traction vector and normal stress of s on planes with normals (x, y, z)."""
    a, b, c = s[0] * x + s[3] * y + s[4] * z, s[3] * x + s[1] * y + s[5] * z, s[4] * x + s[5] * y + s[2] * z
    return a, b, c, a * x + b * y + c * z
