"""The undeformed gap, in Hertz units."""


def undeformed(X, Y, curvature):
    """Gap X^2/2 + curvature Y^2/2; curvature: 0 for a line, R_x/R_y for a point contact."""
    return 0.5 * X**2 + 0.5 * curvature * Y**2
