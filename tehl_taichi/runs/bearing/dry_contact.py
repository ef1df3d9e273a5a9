"""Dry contact of one element with one ring: ellipse or line, and the contact that the solver computes for it."""

from dataclasses import dataclass

from tehl_taichi.scene import hertz

MOST = 50.0  # R_y/R_x of an ellipse that a scene accepts
ELLIPTIC, LINE = "elliptic", "line"


@dataclass(frozen=True)
class DryContact:
    """kind: of the scene, elliptic or line; a, b: half-axes along and across rolling (m; line: b is half the length of the
    roller); p_H: Pa; load: of the element (N); scene_load: N or N/m; words: text with the kind and its reason.
    """

    kind: str
    a: float
    b: float
    p_H: float
    load: float
    scene_load: float
    words: str


def dry_contact(bearing, contact, load, E):
    """The :class:`DryContact` of an element under a load (N); E: E' (Pa).

    Crowned rollers have an elliptic contact until it is as long as they are, then a line contact. An ellipse that is too
    slender for the solver is computed as the line contact of its middle: equal pressure, equal half-width within 2 %.
    """
    if bearing.rollers and contact.R_y == float("inf"):
        return _line(bearing, contact, load, E, "line contact of a straight roller")
    a, b, p_H = hertz.ellipse(load, contact.R_x, contact.R_y, E)
    if bearing.rollers and 2 * b >= bearing.length:
        return _line(bearing, contact, load, E, f"line contact: the ellipse of the crown would be {2e3 * b:.3g} mm long")
    slender = f"slender ellipse, {2e3 * b:.3g} mm of {1e3 * bearing.length:.3g} mm" if bearing.rollers else "ellipse"
    if contact.R_y <= MOST * contact.R_x:
        return DryContact(ELLIPTIC, a, b, p_H, load, load, slender)
    middle = hertz.line_load(p_H, contact.R_x, E)
    return DryContact(LINE, a, b, p_H, load, middle, f"{slender}; computed as the line contact of its middle, because "
                      f"R_y/R_x = {contact.R_y / contact.R_x:.3g} exceeds {MOST:g}")


def _line(bearing, contact, load, E, words):
    per_length = load / bearing.length
    a, p_H = hertz.line(per_length, contact.R_x, E)
    return DryContact(LINE, a, bearing.length / 2, p_H, load, per_length, words)
