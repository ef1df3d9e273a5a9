"""Built-in tables of strength over depth."""

from tehl_taichi.scene.strength.table import DEPTH, HARDNESS, text_of

SURFACE, CORE, CHD, AT_CHD = 700.0, 400.0, 0.8e-3, 550.0  # HV, HV, m, HV that defines a case-hardening depth (ISO 18203)
STEPS, DEEPEST = 40, 2.0  # rows, and depth over CHD


def case_hardened():
    """Hardness that falls as a bell curve from surface to core and is 550 HV at the case-hardening depth."""
    depths = [n * DEEPEST * CHD / STEPS for n in range(STEPS + 1)]
    part = (AT_CHD - CORE) / (SURFACE - CORE)
    return {DEPTH: depths, HARDNESS: [CORE + (SURFACE - CORE) * part ** ((z / CHD) ** 2) for z in depths]}


# {name: text}; "none" of body b: kappa and endurance of the scene
PROFILES = {"case-hardened": text_of(case_hardened())}
PLAIN = "none"
WORDS = "case-hardened: 700 HV at the surface, 400 HV in the core, 550 HV at 0.8 mm, no residual stress"
