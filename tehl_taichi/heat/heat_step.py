"""Numbers of a time step for the kernels of the energy equation (see :mod:`tehl_taichi.engine.records`)."""

from tehl_taichi.engine.language import ti


@ti.dataclass
class HeatStep:
    """Numbers of a time step for the energy equation."""

    rate: ti.f64  # 1/s, weight of the new state in d/dt
    inv_x: ti.f64  # 1/m, 1/dx
    inv_y: ti.f64  # 1/m, 1/dy
    B_a: ti.f64  # K m2/W, B of T_s = A + B q, of body a
    B_b: ti.f64  # and of body b
    tolerance: ti.f64  # K, of the Newton steps of a column
    iterations: ti.f64  # of these at most
    back: ti.f64  # s, dt
    back_2: ti.f64  # s, dt and that of the step before
    near: ti.f64  # weight of the state dt ago in d/dt,
    far: ti.f64  # and of that back_2 ago: together 1
    hold: ti.f64  # 1: columns without a solution keep the temperatures of the oil that came in, those without load may change
    even: ti.f64  # 1: both walls are the same in everything
    given: ti.f64  # 1: columns whose pressure is given have given temperatures, too
    moved: ti.f64  # cells that the grid has moved since the last step,
    moved_2: ti.f64  # and since the one before


@ti.dataclass
class Drift:
    """Motion of a body in a time step: position of its material strips."""

    shift: ti.f64  # whole cells that the strips overtake the grid by
    rest: ti.f64  # cells that strip i lies ahead of column i afterwards
    B_last: ti.f64  # K m2/W, of the flux of the last step
