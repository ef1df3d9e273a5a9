"""Edge dislocations in an elastic half-plane with a free boundary, in plane strain: stresses, and the work between two.

Points are z = x + i depth, depth >= 0; a dislocation at z0 has the jump b = b_x + i b_z. With gamma = E* b/(8 pi i), D = z -
conj z0, d = z - z0 (Muskhelishvili's potentials; the image after Hills, Kelly, Dai & Korsunsky 1996):

      Phi = gamma/d + Phi1,  Phi1 = -gamma/D - conj(gamma) (z0 - conj z0)/D^2,
      Psi = conj(gamma)/d + gamma conj(z0)/d^2 - conj(gamma)/D - Phi1 - z Phi1'.
"""

import numpy as np


def stresses(z, z0, b, E_star):
    """Stresses (sxx, szz, sxz), Pa, at z of dislocations b (m) at z0; E_star = E/(1 - nu^2); all arguments broadcast."""
    g = E_star / (8j * np.pi) * b
    gc, d, D, step = np.conj(g), z - z0, z - np.conj(z0), z0 - np.conj(z0)
    image, slope = -g / D - gc * step / D**2, g / D**2 + 2 * gc * step / D**3
    phi, dphi = g / d + image, slope - g / d**2
    psi = gc / d + g * np.conj(z0) / d**2 - gc / D - image - z * slope
    mean, turn = 2 * phi.real, np.conj(z) * dphi + psi
    return mean - turn.real, mean + turn.real, turn.imag


def work(z, z0, d=None):
    """Factors (A, B) of the work between jumps b at z and b0 at z0: -E*/(8 pi) Re(conj(b) (A b0 - B conj(b0))).

    They come from the force function phi + z conj(phi') + conj(psi), less its value on the boundary, and are symmetric in z and
    z0. d: a more accurate z - z0, if known.
    """
    d, D = z - z0 if d is None else d, z - np.conj(z0)
    depths = -4 * z.imag * z0.imag
    A = 2 * np.log(np.abs(d) / np.abs(D)) + depths / np.conj(D) ** 2
    B = d / np.conj(d) - 2 * d * D.real / (D * np.conj(D)) + 1
    return A, B
