"""Error of the numbers of a run by the finite domain: a share of the film, estimated from the steady start.

A border without pressure in a flooded inlet reduces the film by the share alpha q (0.73 + 0.15 |X|/(alpha p_H)); q is the
reduced pressure of the oil at this place in an endless inlet, 0.73 Grubin's exponent 8/11 (99 lines of M 5 to 100, L 2 to 20:
measured values are 0.82 to 1.14 of this). For a point contact it is 0.73 alpha q, and for its sides (gap there/0.7
films)^(-3/2). A border with the pressure of the oil beyond it leaves a part of this error. The load of the oil beyond it
counts; its deflection of the bodies is missing. In a passage the sides of a line contact add a part of
:mod:`tehl_taichi.march.accuracy.side_change`.
"""

import math
from dataclasses import asdict, dataclass, replace
from dataclasses import fields as of_class

import numpy as np

from tehl_taichi.march.accuracy.error_bars import WHOLE
from tehl_taichi.march.accuracy.heat_before import heat_before
from tehl_taichi.march.accuracy.side_change import side_change
from tehl_taichi.march.quantities import HEAT
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.inlet import Inlet
from tehl_taichi.scene.domain import INLETS, PASSAGE, SIDE, left
from tehl_taichi.values.coded_text import Reason

GRUBIN, LONG = 0.73, 0.15
# Errors by the domain (lines, circles and ellipses from -2.5 to -8.5 a against 12.5 to 20 a, docs/decisions/02-inlet.md); q:
# share of the load that the oil before carries, whose deflection of the bodies is missing. Of the film: a part (domain.left) of
# what a border without pressure loses, and q (FLAT + STEEP q)
FLAT, STEEP = 0.05, 0.45
# Of the largest pressure: q (PRESSURE + q); by q more: of the smallest film of a point contact, by its sides, and of friction
PRESSURE, THINNEST, SLIDING = 0.35, 0.25, {"line": 0.2, "point": 0.7}
# Ends of a user nearer than the automatic ones: NEAR |X|^-5 more of what a border without pressure loses, and to friction
# NEARER |X|^-2 of q more, both less that at the nearest automatic end (lines from -1.2 to -2.8 a, 0.4 to 1.2 GPa, decision 2)
NEAR, NEARER = 0.45, 2.0
# Of the part of the load that grid and oil beyond miss: of film and pressure. Films of rigid circles fall with its square
LOADED = 2.0
# Of the slope at the outlet, p_max per a. Ends at 1.5 to 2.5 a cost the film of lines (M 0.3 to 2, L 5 to 25) 0.21 of it, of
# circles (M 0.5 to 2) 0.5 at most, the largest pressure 0.7, friction 0.56; with a spike there in Newtonian oil the pressure
# 2.1, friction 6.9 (docs/decisions/02-inlet.md)
CUT = {"film": 0.5, "thinnest": 0.5, "pressure": 2.2, "friction": 8.0}
HEATING = 2.0  # of the share of the film: of the rises of temperature
WARMED = 2.0  # of the rise by the heat of the oil before
# Of the change of the film at the sides, for every number of a passage: asperities and dents with sides at 1 b err by 0.01 to
# 0.40 of it against 2.5 b, with temperatures by up to 0.50, exits that the grid does not resolve by more (decision 4)
SIDES = 0.5
BEYOND = Reason("the oil beyond the domain may change it by as much as its value", "beyond")


@dataclass(frozen=True)
class DomainError:
    """Relative errors by the domain. film: of the central film; thinnest: of the minimum film; pressure: of the largest
    pressure; friction: of the friction coefficient; before: error of that coefficient by the oil before the domain; warmed_a,
    warmed_b: of the temperatures of the surfaces by it, K; gap: at the inlet, over the film; lost: relative error of the film
    with a border without pressure; sides: :func:`side_change` of a passage.
    """

    film: float = 0.0
    thinnest: float = 0.0
    pressure: float = 0.0
    friction: float = 0.0
    before: float = 0.0
    warmed_a: float = 0.0
    warmed_b: float = 0.0
    gap: float = 0.0
    lost: float = 0.0
    cut: float = 0.0
    sides: float = 0.0

    @classmethod
    def from_values(cls, values):
        """DomainError from the result of :meth:`values`; for a store without it, zero errors."""
        return cls(**{field.name: values[field.name] for field in of_class(cls) if field.name in values})

    def values(self):
        return asdict(self)

    def cut_off(self, cut):
        """DomainError with that of an outlet where the pressure ends with the slope `cut`."""
        return replace(self, cut=cut, **{name: getattr(self, name) + part * cut for name, part in CUT.items()})

    def of_passage(self, scene, reader):
        """DomainError of a passage from that of its steady start; reader: see :func:`side_change`."""
        return replace(self, sides=side_change(scene, reader))

    def of(self, name, value, inlet, passing):
        """Error of a number of a steady start (or a passage) by the size of the domain; inlet: deg C."""
        sides = SIDES * self.sides * abs(value - inlet * (name in HEAT))
        return math.hypot(self._of_inlet(name, value, inlet, passing), sides)

    def _of_inlet(self, name, value, inlet, passing):
        """As :meth:`of`, without the sides of a passage."""
        if name.startswith("friction"):
            return self.friction * abs(value) + self.before
        if name in HEAT:
            return (PASSAGE if passing else HEATING) * self.film * abs(value - inlet) + self._warmed(name)
        steady = {"h_c_m": self.film, "h_min_m": self.thinnest, "p_max_Pa": self.pressure}
        return (PASSAGE * self.film if passing else steady[name]) * abs(value)

    def _warmed(self, name):
        """Error (K) of a temperature by the oil before the domain; of the film: the larger one of its surfaces."""
        return {"surface_a_max_C": self.warmed_a, "surface_b_max_C": self.warmed_b}.get(name, max(self.warmed_a, self.warmed_b))


def domain_error(solver):
    """DomainError of the steady film in the table."""
    P = solver.levels.get(fields.P)
    return _by_inlet(solver).cut_off(float(P[:, -2].max() / (P.max() * solver.levels.dx)))


def _by_inlet(solver):
    """DomainError by the oil before the domain, and beside a point contact."""
    v, inlet = solver.levels, Inlet(solver.levels)
    H = v.get(fields.H)
    gap = float(H[v.middle, 0] / np.interp(0.0, v.X, H[v.middle]))
    if not inlet.flooded:
        return DomainError(gap=gap, lost=_lost(v, inlet, H, _raised(v, inlet, H)))
    lost, miss = _lost(v, inlet, H, 0.0), np.abs(inlet.beyond() - inlet.now()).max() / inlet.q[-1]
    outside, sides = inlet.load() / v.scales.load, 0.0 if v.line else THINNEST
    missed = LOADED * abs(solver.load / v.scales.load + outside - 1)
    kept = left(v.scene, gap) + NEAR * _nearer(v, 5)
    film = kept * lost + GRUBIN * float(miss) + (FLAT + STEEP * outside) * outside + missed
    rises = (0.0, 0.0) if v.scene.isothermal else heat_before(solver, inlet)
    return DomainError(film, film + sides * outside, (PRESSURE + outside) * outside + missed,
                       film + (SLIDING[v.scales.kind] + NEARER * _nearer(v, 2)) * outside, _before(v, inlet, H),
                       WARMED * rises[0], WARMED * rises[1], gap, lost)


def _nearer(v, power):
    """|X|^-power at the inlet less that at the nearest automatic one; 0 from there on."""
    return max(abs(v.X[0]) ** -power - INLETS[0] ** -power, 0.0)


def _raised(v, inlet, H):
    """Relative increase of a starved film in a flooded inlet."""
    gain = 0.0
    for _ in range(40):
        lost = min(_lost(v, inlet, H, gain), 0.9)
        gain = 0.5 * (gain + lost / (1 - lost))
    return gain


def _lost(v, inlet, H, gain):
    """Share of the film lost with a border without pressure, for a film that is thicker than H by the share `gain`."""
    film = np.interp(0.0, v.X, H[v.middle])
    q = inlet.without_heat(H + gain * film, (1 + gain) * inlet.carried(H)) / inlet.q[-1]
    if v.line:
        return float(q.max() * (GRUBIN + LONG * abs(v.X[0]) * inlet.q[-1] / v.scales.p_H))
    side = np.interp(0.0, v.X, H[-1]) / film + gain
    return float(q.max() * GRUBIN + (side / SIDE) ** -1.5)


def _before(v, inlet, H):
    """Friction coefficient of the oil sheared before the domain; for a point contact over the width of the grid."""
    _, gap, weights = inlet.far(H)
    wide = 1.0 if v.line else 2 * abs(v.Y[-1])
    sheared = v.conditions["eta0"] * abs(v.conditions["u_s"]) / (v.scales.h * v.scales.p_H)
    return sheared * float(np.sum(weights / gap)) * wide / v.scales.load


def widened(errors, unknown, values, found, inlet, passing=False):
    """Add the DomainError `found` to the bars by the grid: (bars, reasons of unknown ones, {name: {"grid", "domain"}}).

    Both causes are independent, so they add in quadrature. errors: {name: size or None}; values: {name: the number}; inlet: deg
    C.
    """
    parts = {name: {"grid": size, "domain": found.of(name, values[name], inlet, passing)} for name, size in errors.items()}
    whole = {name: None if part["grid"] is None else math.hypot(part["grid"], part["domain"]) for name, part in parts.items()}
    lost = [name for name, size in whole.items() if size is not None and _positive(name) and size >= values[name]]
    return {**whole, **dict.fromkeys(lost)}, {**unknown, **{name: _reason(**parts[name]) for name in lost}}, parts


def _reason(grid, domain):
    """Reason of a bar as large as its number, by its larger part: a finer grid leaves that by the domain."""
    return WHOLE if grid >= domain else BEYOND


def _positive(name):
    return name.startswith(("h_", "p_")) or name.endswith("Fi_max")
