"""Third-order upwind-biased difference of a transported quantity, q_{i+1/2} = (2 q_{i+1} + 5 q_i - q_{i-1})/6."""

from tehl_taichi.engine.language import ti

UPWIND = (1 / 6, -1.0, 0.5, 1 / 3)  # weights of q_{i-2} ... q_{i+1} in dx dq/dX
FIRST = (0.0, -0.5, 0.0, 0.5)  # at the first interior node: the central difference


@ti.func
def couette_weights(i):
    """Weights at node i."""
    w = ti.Vector(UPWIND)
    if i == 1:
        w = ti.Vector(FIRST)
    return w
