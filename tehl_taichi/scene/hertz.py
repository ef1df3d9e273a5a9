"""Dry contacts after Hertz, in closed form (SI)."""

import functools
import math


def line(load, R, E):
    """Half-width a and maximum pressure p_H for load per length f (N/m); 2/E' = sum (1-nu^2)/E [Eq 1.6]."""
    a = math.sqrt(8 * load * R / (math.pi * E))
    return a, 2 * load / (math.pi * a)


def line_load(p_H, R, E):
    """Load per length (N/m) for the maximum pressure p_H."""
    return 2 * math.pi * R * p_H**2 / E


def line_gap(X):
    """Gap beside a dry line contact, in a^2/R', at |X| >= 1 half-widths from its centre (Johnson, section 4.2(c))."""
    root = math.sqrt(X * X - 1)
    return (X * root - math.log(X + root)) / 2


def point_gap(X):
    """Gap beside a circular contact (Johnson, section 3.4, Eq 3.42)."""
    return X * X / 2 - 1 + ((2 - X * X) * math.asin(1 / X) + math.sqrt(X * X - 1)) / math.pi


def gap_reaches(H, gap=line_gap):
    """Distance from the centre, in a, at which the gap beside the dry contact is H a^2/R' (at most 10)."""
    low, high = 1.0, 10.0
    for _ in range(40):
        X = 0.5 * (low + high)
        low, high = (X, high) if gap(X) < H else (low, X)
    return high


def point(load, R, E):
    """Radius a and maximum pressure p_H of a circular contact, load in N (Johnson, section 4.2)."""
    a = (3 * load * R / (2 * E)) ** (1 / 3)
    return a, 3 * load / (2 * math.pi * a**2)


def elliptic_integrals(m):
    """Complete elliptic integrals (K, E) of the first and second kind with parameter m = e^2 < 1, by the arithmetic-geometric
    mean (Abramowitz & Stegun 17.6).
    """
    a, b, c, total, power = 1.0, math.sqrt(1 - m), math.sqrt(m), 0.5 * m, 1.0
    while abs(c) > 1e-16:
        a, b, c = (a + b) / 2, math.sqrt(a * b), (a - b) / 2
        total += power * c * c
        power *= 2
    K = math.pi / (2 * a)
    return K, K * (1 - total)


@functools.cache
def axes_ratio(radius_ratio):
    """Ratio k >= 1 of the half-axes of the contact ellipse for reduced radii in the ratio R_long/R_short >= 1:
    (k^2 E - K)/(K - E) = R_long/R_short (Johnson, section 4.2)."""
    if radius_ratio < 1 + 1e-6:
        return radius_ratio ** (2 / 3)
    low, high = 0.0, math.log(radius_ratio) + 1e-9
    for _ in range(200):
        middle = 0.5 * (low + high)
        k = math.exp(middle)
        K, E = elliptic_integrals(1 - 1 / k**2)
        low, high = (middle, high) if (k * k * E - K) < radius_ratio * (K - E) else (low, middle)
    return math.exp(0.5 * (low + high))


def ellipse(load, R_x, R_y, E):
    """Half-axis a along x, half-axis b along y and maximum pressure of an elliptic contact, load in N (Johnson, 4.2)."""
    if R_x == R_y:
        a, p_H = point(load, R_x, E)
        return a, a, p_H
    k = axes_ratio(max(R_x, R_y) / min(R_x, R_y))
    m = 1 - 1 / k**2
    K, E2 = elliptic_integrals(m)
    shape = (K - E2) / m if m > 1e-7 else math.pi / 4
    long = (6 * load * max(R_x, R_y) / (math.pi * E) * shape) ** (1 / 3)
    a, b = (long, long / k) if R_x > R_y else (long / k, long)
    return a, b, 3 * load / (2 * math.pi * a * b)


def ellipse_load(p_H, R_x, R_y, E):
    """Load (N) for the maximum pressure p_H; it is proportional to p_H^3."""
    return (p_H / ellipse(1.0, R_x, R_y, E)[2]) ** 3
