"""Closed-form solutions: Hertz contacts and film-thickness formulas (SI unless said)."""

import math


def hertz_line(load, R, E):
    """(half-width a, maximum pressure p_H) for load per length f (N/m), E' as in 2/E' = sum (1-nu^2)/E [Eq 1.6]."""
    a = math.sqrt(8 * load * R / (math.pi * E))
    return a, 2 * load / (math.pi * a)


def hertz_line_load(p_H, R, E):
    """Load per length that gives the maximum pressure p_H."""
    return 2 * math.pi * R * p_H**2 / E


def hertz_point(load, R, E):
    """(radius a, maximum pressure p_H) of a circular contact, load in N (Johnson, section 4.2)."""
    a = (3 * load * R / (2 * E)) ** (1 / 3)
    return a, 3 * load / (2 * math.pi * a**2)


def elliptic_integrals(m):
    """(K, E), complete elliptic integrals of the first and second kind with parameter m = e^2 < 1, by the
    arithmetic-geometric mean (Abramowitz & Stegun 17.6)."""
    a, b, c, total, power = 1.0, math.sqrt(1 - m), math.sqrt(m), 0.5 * m, 1.0
    while abs(c) > 1e-16:
        a, b, c = (a + b) / 2, math.sqrt(a * b), (a - b) / 2
        total += power * c * c
        power *= 2
    K = math.pi / (2 * a)
    return K, K * (1 - total)


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


def hertz_ellipse(load, R_x, R_y, E):
    """(half-axis a along x, half-axis b along y, maximum pressure) of an elliptic contact, load in N (Johnson, 4.2)."""
    if R_x == R_y:
        a, p_H = hertz_point(load, R_x, E)
        return a, a, p_H
    k = axes_ratio(max(R_x, R_y) / min(R_x, R_y))
    m = 1 - 1 / k**2
    K, E2 = elliptic_integrals(m)
    shape = (K - E2) / m if m > 1e-7 else math.pi / 4
    long = (6 * load * max(R_x, R_y) / (math.pi * E) * shape) ** (1 / 3)
    a, b = (long, long / k) if R_x > R_y else (long / k, long)
    return a, b, 3 * load / (2 * math.pi * a * b)


def hertz_ellipse_load(p_H, R_x, R_y, E):
    """Load (N) that gives the maximum pressure p_H: it grows with its cube."""
    return (p_H / hertz_ellipse(1.0, R_x, R_y, E)[2]) ** 3


def nijenbanning(M, L):
    """Central film of a circular contact in Moes units, all regimes (Nijenbanning, Venner & Moes 1994, ratio 1)."""
    H_RI, H_RP = 145 * 1.796 ** (-15 / 7) * M**-2.0, 1.29 * 1.691 ** (-2 / 3) * L ** (2 / 3)
    H_EI, H_EP = 3.18 * 1.63 ** (-14 / 25) * M ** (-2 / 15), 1.48 * 1.63 ** (-7 / 20) * M ** (-1 / 12) * L**0.75
    s = 1.5 * (1 + math.exp(-1.2 * H_EI / H_EP))
    iso = (H_RI**1.5 + (H_EI**-4 + 1.8**-4) ** (-3 / 8)) ** (2 * s / 3)
    return (iso + (H_RP**-8 + H_EP**-8) ** (-s / 8)) ** (1 / s)


def moes_line(M, L):
    """Film of a line contact in Moes units from the four asymptotes (Venner 1991, after Moes)."""
    H_RI, H_RP = 3 / M, 1.287 * L ** (2 / 3)
    H_EI, H_EP = 2.621 * M ** (-1 / 5), 1.311 * M ** (-1 / 8) * L**0.75
    s = (7 + 8 * math.exp(-2 * H_EI / H_RI)) / 5
    iso = (H_RI ** (7 / 3) + H_EI ** (7 / 3)) ** (3 * s / 7)
    return (iso + (H_RP**-3.5 + H_EP**-3.5) ** (-2 * s / 7)) ** (1 / s)


def moes_numbers(load, R, E, eta0, alpha, u_m, kind="line"):
    """(M, L) with U = 2 eta0 u_m/(E' R')."""
    U = 2 * eta0 * u_m / (E * R)
    L = alpha * E * U**0.25
    return (load / (E * R) * U**-0.5 if kind == "line" else load / (E * R**2) * U**-0.75), L
