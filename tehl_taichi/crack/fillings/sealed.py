"""A mouth that seals: while it is open, the film's pressure acts in the whole crack; when it closes, the oil is trapped.

Trapped oil may part the faces at the mouth by its own pressure. It then escapes until its pressure just keeps them shut.
"""

import numpy as np

from tehl_taichi.crack.filling import Filling
from tehl_taichi.crack.fillings import check_value
from tehl_taichi.values.registry import Checked

SAME, ROUNDS = 1e-10, 60  # of the pressure; rounds of the oil's compressibility, or of the pressure that lets oil out


def inside(wet):
    """State with one pressure in the whole crack."""
    return wet.marched(1, lambda march: _full(march, march.under(0, wet.mouth[0])), _step)


def _full(march, found):
    """A state, and the oil content of the full crack in it."""
    return found, march.wet.fluid.compression(found.pressure) * (march.volume @ found.values)


def _step(march, n, before, content):
    """State and content at moment n. The film does not enter a shut mouth, whatever its pressure, until the faces there
    part.
    """
    if before.pressed >= 0:
        inside = _shut_in(march, n, content)
        if inside.pressed >= 0:
            return inside, content
    found = march.under(n, march.wet.mouth[n])
    if found.pressed < 0:
        return _full(march, found)
    inside = _shut_in(march, n, content)
    return (inside, content) if inside.pressed >= 0 else _full(march, _leaking_state(march, n, inside.pressure[0]))


def _shut_in(march, n, content):
    """The :class:`tehl_taichi.crack.fluid_filled.MomentState` with this content, if no oil escapes."""
    if content[0] <= 0:
        return march.under(n, 0.0)
    p = np.array([march.wet.mouth[n]])
    for _ in range(ROUNDS):
        found = march.holding(n, content, np.diag(march.wet.fluid.compressibility(p) * content))
        change, p = abs(found.pressure - p).max(), found.pressure
        if change <= SAME * p[0]:
            break
    return found


def _leaking_state(march, n, high):
    """State at the pressure at which the mouth just touches.

    It lies between the film's pressure, at which the mouth is shut, and `high`, at which it opens (Illinois method).
    """
    low = march.wet.mouth[n]
    f_low, f_high = march.under(n, low).pressed, march.under(n, high).pressed
    for _ in range(ROUNDS):
        p = (low * f_high - high * f_low) / (f_high - f_low)
        found = march.under(n, p)
        if abs(found.pressed) <= SAME * abs(f_low) or abs(high - low) <= SAME * abs(high):
            break
        if found.pressed < 0:
            high, f_high, f_low = p, found.pressed, f_low / 2
        else:
            low, f_low, f_high = p, found.pressed, f_high / 2
    return found


SEALED: Filling = Filling(
    name="sealed", says="film pressure while the mouth is open; oil inside is trapped when it closes",
    source="Keer & Bryant 1983; Bower 1988 (J. Tribol. 110)", inside=inside,
    checked=(Checked("normal edge crack, tension 1 and pressure 3 at a mouth that stays open: four times that of the tension",
                     4 * 1.1215, lambda: check_value(SEALED, mouth=3.0), 1e-3),))
