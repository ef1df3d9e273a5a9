"""J2 plasticity at points: radial return to the flow stress of a hardening law. Components last: xx, yy, zz, xy, xz, yz."""

import numpy as np

WEIGHTS = np.array([1.0, 1, 1, 2, 2, 2])  # how often a component stands in a tensor
HALVINGS = 50  # of the interval of the plastic strain: to its last digit


def deviator(stress):
    """Deviatoric part of stresses (..., 6)."""
    out = np.array(stress, float)
    out[..., :3] -= out[..., :3].mean(axis=-1, keepdims=True)
    return out


def equivalent(deviatoric):
    """Von Mises stress (...) of deviatoric stresses (..., 6)."""
    return np.sqrt(1.5 * (WEIGHTS * deviatoric * deviatoric).sum(axis=-1))


def return_mapping(trial, hardened, flow_stress, G):
    """Return mapping: (plastic strain (n, 6), equivalent plastic strain (n,)) of deviatoric trial stresses (n, 6).

    hardened: equivalent plastic strain before; flow_stress: its function, Pa; G: shear modulus, Pa.
    """
    size = equivalent(trial)
    more = _increment(size, hardened, flow_stress, G)
    return 1.5 * (more / np.maximum(size, 1.0))[:, None] * trial, more


def _increment(size, hardened, flow_stress, G):
    """Increment of plastic strain: solves size - 3 G more = flow_stress(hardened + more); 0 where size is below the flow
    stress.
    """
    low, high = np.zeros_like(size), np.maximum(size - flow_stress(hardened), 0.0) / (3 * G)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        above = size - 3 * G * middle > flow_stress(hardened + middle)
        low, high = np.where(above, middle, low), np.where(above, high, middle)
    return high
