"""Positions on a flank: each is a line contact with its radii, speeds and load per width."""

from dataclasses import dataclass, field

from tehl_taichi.errors import SceneError
from tehl_taichi.values.checks import integer, nearest, number
from tehl_taichi.values.units import in_unit

ONS = ("pinion", "gear")
BEYOND = 20  # lengths of the path of contact within which a table of shares ends
NEAR = 0.03  # slide-roll ratio beside the pitch point: friction has four fifths of its largest value there (fzg-c, 90 deg C)
JUMPED = 1e-12  # m: nearer than this, a position requested is at a jump of the load


@dataclass(frozen=True)
class Position:
    """One position in SI; body a carries the feature.

    x_pl: coordinate along the line of action from the pitch point, negative in the dedendum of body a; arc: distance along its
    flank (None: unknown); point: A to E, with - or + before and after a jump of the load; slip: u_a - u_b; bulk: temperature of
    the teeth in deg C (None: that of the scene); film_ratios: see :mod:`tehl_taichi.runs.flank.specific_film`.
    """

    x_pl: float
    rho_a: float
    rho_b: float
    u_a: float
    u_b: float
    load: float
    slip: float
    arc: float | None = None
    point: str = ""
    more: dict = field(default_factory=dict)
    bulk: float | None = None
    film_ratios: dict = field(default_factory=dict)

    @property
    def R(self):
        """Reduced radius, m."""
        return self.rho_a * self.rho_b / (self.rho_a + self.rho_b)

    @property
    def u_m(self):
        return 0.5 * (self.u_a + self.u_b)

    @property
    def words(self):
        """Text with its coordinate."""
        return f"x_pl = {self.x_pl * 1e3:.4g} mm"

    @property
    def short(self):
        """Its point, else its coordinate."""
        return self.point or f"{self.x_pl * 1e3:.3g} mm"

    @property
    def full(self):
        """Its point and its coordinate."""
        return f"{self.point}{', ' * bool(self.point)}x_pl = {self.x_pl * 1e3:.3f} mm"

    @property
    def srr(self):
        """Slip over mean speed; exactly 0 at the pitch point."""
        return self.slip / self.u_m


def shares(mesh):
    """[(x in m, share of the tooth force)] along the path of contact, with an x twice at a jump: the table of the pair; 1
    throughout for helical pairs; else the classical trapezoid 1/3 to 2/3, 1, 2/3 to 1/3. Raises SceneError.
    """
    (A, E), pair = mesh.ends, mesh.pair
    if pair.load_share:
        if pair.load_share[0][0] > A or pair.load_share[-1][0] < E:
            raise SceneError(f"gear.load_share covers {pair.load_share[0][0]:.6g} to {pair.load_share[-1][0]:.6g} m past C; "
                             f"needed: {A:.6g} m (A) to {E:.6g} m (E)")
        _check_ways(pair.load_share, E - A)
        return pair.load_share
    if pair.beta:
        return ((A, 1.0), (E, 1.0))
    B, D = mesh.points["B"], mesh.points["D"]
    return ((A, 1 / 3), (B, 2 / 3), (B, 1.0), (D, 1.0), (D, 2 / 3), (E, 1 / 3))


def _check_ways(table, path):
    """Refuse a table that extends far beyond the path: its coordinates were meant in another unit. Raises SceneError."""
    most = BEYOND * path
    for way, _ in (table[0], table[-1]):
        number("gear.load_share: a way past C", way, "m", -most, most, usual=path / 2)


def share(table, x, side):
    """Share at x, linear between the rows of the table; side: - or + of a jump at x."""
    for (x_0, low), (x_1, high) in zip(table, table[1:]):
        if x_0 < x <= x_1 if side == "-" else x_0 <= x < x_1:
            return low + (high - low) * (x - x_0) / (x_1 - x_0)
    return table[-1][1] if side == "+" else table[0][1]


def jumps(mesh, table):
    """Sorted positions x at which the load jumps inside the path."""
    A, E = mesh.ends
    return sorted({x for (x, low), (x_1, high) in zip(table, table[1:]) if x == x_1 and low != high and A < x < E})


def positions_along(mesh, on="pinion", count=9, at=()):
    """Positions of a mesh, from the dedendum of body a (`on`: pinion or gear) to its addendum. Raises SceneError.

    count: number of positions. They include A to E and both sides of every load jump, then one on each side of C, then points
    in the widest gaps. at: these points ("A", "B-", "C") or coordinates x_pl in m instead.
    """
    table = shares(mesh)
    if on not in ONS:
        raise SceneError(f"on = {on!r} is not known{nearest(on, ONS)}; allowed: {', '.join(ONS)}")
    chosen = [both for place in at for both in _requested(mesh, table, place, on)] or _spread(mesh, table, count)
    return sorted((_position(mesh, table, on, *place) for place in dict.fromkeys(chosen)),
                  key=lambda p: (p.x_pl, p.point.endswith("-") == (on == "gear")))


def _marks(mesh, table):
    """(x, side of a jump) of A to E and of the load jumps."""
    jumping = jumps(mesh, table)
    return [(x, side) for x in sorted({*mesh.points.values(), *jumping}) for side in (("-", "+") if x in jumping else ("",))]


def _spread(mesh, table, count):
    marks = _marks(mesh, table)
    integer("positions", count, len(marks), 1000)
    if count >= len(marks) + 2:
        marks += _beside_pitch_point(mesh, marks)
    ways = sorted({x for x, _ in marks})
    parts = [1] * (len(ways) - 1)
    for _ in range(count - len(marks)):
        widest = max(range(len(parts)), key=lambda n: ((ways[n + 1] - ways[n]) / parts[n], -n))
        parts[widest] += 1
    between = [(low + (high - low) * k / part, "") for low, high, part in zip(ways, ways[1:], parts) for k in range(1, part)]
    return marks + between


def _beside_pitch_point(mesh, marks):
    """One position on each side of C, where friction rises from 0 within a small slip (straight lines to the next points would
    hide it); none if C is not between two marks or these are closer.
    """
    way = NEAR * mesh.speeds(0.0)[0] / sum(mesh.omega)
    ways = sorted({x for x, _ in marks})
    if "C" not in mesh.points or not ways[0] < 0.0 < ways[-1]:
        return []
    n = ways.index(0.0)
    return [(-way, ""), (way, "")] if ways[n - 1] < -2 * way and ways[n + 1] > 2 * way else []


def _in_metres(place):
    """A coordinate in m of a text such as "1 mm", other places unchanged. Raises SceneError."""
    return in_unit("the position past C", place, "m") if isinstance(place, str) and place[:1] in "+-.0123456789" else place


def _requested(mesh, table, place, on):
    """All (x, side) of a requested point or coordinate."""
    towards_tip, place = 1 if on == "pinion" else -1, _in_metres(place)
    if isinstance(place, str):
        name, side = place.strip("+-"), place[len(place.strip("+-")):]
        if name not in mesh.points or side and mesh.points[name] not in jumps(mesh, table):
            raise SceneError(f"the point {place!r} is not on this flank; known: {', '.join(mesh.points)} (with - or + where "
                             "the load jumps), or a distance past C in m")
        x = mesh.points[name]
    else:
        A, E = sorted(towards_tip * end for end in mesh.ends)
        number("the position past C", place, "m", A - JUMPED, E + JUMPED, usual=5e-3)
        x, side = min(max(towards_tip * float(place), mesh.ends[0]), mesh.ends[1]), ""
    at_jump = [jump for jump in jumps(mesh, table) if abs(jump - x) < JUMPED]
    return [(at_jump[0], one) for one in side or "-+"] if at_jump else [(x, "")]


def _position(mesh, table, on, x, side):
    wheel, other = (1, 2) if on == "pinion" else (2, 1)
    radii, (u_1, u_2, slip) = mesh.radii(x), mesh.speeds(x)
    speeds, sign = (u_1, u_2), 1 if on == "pinion" else -1
    letter = next((name for name, way in mesh.points.items() if way == x), "")
    return Position(x_pl=sign * x + 0.0, rho_a=radii[wheel - 1], rho_b=radii[other - 1], u_a=speeds[wheel - 1],
                    u_b=speeds[other - 1], load=share(table, x, side or ("+" if x < mesh.ends[1] else "-")) * mesh.full_load,
                    slip=sign * slip + 0.0, arc=mesh.arc(x, wheel) + 0.0, point=f"{letter}{side}", bulk=mesh.pair.bulk)
