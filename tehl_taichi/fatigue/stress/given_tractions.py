"""Stresses in a half-space under tractions given on a grid: :func:`tehl_taichi.stresses`."""

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.fatigue.stress.half_space import COMPONENTS, HalfSpaceStress
from tehl_taichi.scene import memory_demand
from tehl_taichi.values.arrays import floats
from tehl_taichi.values.coerce import listed, plain, shown
from tehl_taichi.values.units import amount

LARGEST, FARTHEST = 1e12, 1e3  # Pa, m: no load and no distance of nodes is larger


def stresses(pressure, traction_x, traction_y, dx, dy, depths, nu):
    """Compute stresses: see :func:`tehl_taichi.stresses`."""
    loads = _loads(pressure, traction_x, traction_y)
    line = loads.ndim == 2
    dx, dy = _step("dx", dx), _step_across(dx, dy, line)
    nu = amount("nu", nu, "", 0.0, 0.5)
    z = _depths(depths)
    memory_demand.check_stresses(loads.shape[1:], z.size)
    fields = loads[:, :, None] if line else loads
    x, y = np.arange(fields.shape[1]) * dx, np.arange(fields.shape[2]) * dy
    found = np.stack([_at(fields, x, y, nu, line, depth) for depth in z.ravel()], axis=2)
    found = found[:, 0] if line else found
    return found if z.ndim else found[..., 0, :]


def _step_across(dx, dy, line):
    """Distance of the nodes along y in m, 1 for a line contact, which has none. Raises SceneError."""
    if line and dy is not None:
        raise SceneError(f"dy = {shown(dy)} has no effect on a pressure of shape (nx,); allowed: no dy, or a pressure of shape "
                         "(nx, ny)")
    return 1.0 if line else _step("dy", dx if dy is None else dy)


def _at(fields, x, y, nu, line, depth):
    """Stresses (nx, ny, 6) at one depth."""
    found = HalfSpaceStress(x, y, nu, line=line, mirrored=False, depth=float(depth))(*fields)
    return np.stack([found[name] for name in COMPONENTS], axis=-1)


def _loads(pressure, traction_x, traction_y):
    """Loads (3, nx) or (3, nx, ny): pressure and both shear tractions."""
    pressure = _array("pressure", pressure)
    if pressure.ndim not in (1, 2) or min(pressure.shape) < 2:
        raise SceneError(f"pressure has the shape {pressure.shape}; allowed: (nx,) or (nx, ny) with at least 2 nodes each")
    if pressure.ndim == 1 and traction_y is not None:
        raise SceneError("traction_y needs a pressure of shape (nx, ny): a line contact has none")
    shear = [np.zeros_like(pressure) if values is None else _array(name, values)
             for name, values in (("traction_x", traction_x), ("traction_y", traction_y))]
    for name, values in zip(("traction_x", "traction_y"), shear):
        if values.shape != pressure.shape:
            raise SceneError(f"{name} has the shape {values.shape}, pressure {pressure.shape}: they must agree")
    return np.stack([pressure, *shear])


def _array(name, values):
    values = floats(name, values, "an array of real numbers in Pa")
    if wrong := int((~(np.abs(values) <= LARGEST)).sum()):
        raise SceneError(f"{wrong} of the {values.size} values of {name} are masked, nan or too large; allowed: finite, at "
                         f"most {LARGEST:g} Pa in size")
    return values


def _step(name, value):
    if value is None:
        raise SceneError(f"{name} is missing: the distance of the nodes in m")
    return amount(name, value, "m", 0.0, FARTHEST, strict=True)


def _depths(depths):
    """Depths (m) as an array, of no dimension for a single one. Raises SceneError."""
    given = plain(depths)
    found = [amount("depths", depth, "m", 0.0, FARTHEST) for depth in listed(given)]
    if not found:
        raise SceneError("depths is empty; allowed: one or more numbers in m")
    return np.array(found if isinstance(given, tuple) else found[0])
