"""The sections of a scene, one frozen dataclass each (SI; temperatures in deg C)."""

import math
from dataclasses import dataclass
from typing import Union

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.checks import choice, flag, integer, normalise, number, text
from tehl_taichi.scene.plain import shown


@dataclass(frozen=True)
class Contact:
    """Geometry and load. kind: line, point (circular) or elliptic; radius_x, radius_y: reduced radii m (line: radius_y = inf).

    One of load (N/m for a line, N for a point contact), hertz_pressure (Pa) or the Moes pair moes_M, moes_L; 0 = not
    given. With the pair the speed follows from L (with the oil's alpha and eta0) and the load from M.
    """

    kind: str = "line"
    radius_x: float = 10.6e-3
    radius_y: float = math.inf
    load: float = 0.0
    hertz_pressure: float = 0.0
    moes_M: float = 0.0
    moes_L: float = 0.0

    def __post_init__(self):
        normalise(self)
        choice("contact.kind", self.kind, ("line", "point", "elliptic"))
        number("contact.radius_x", self.radius_x, "m", 1e-6, 1e3)
        number("contact.radius_y", self.radius_y, "m", 1e-6, infinite=True)
        unit = "N/m" if self.kind == "line" else "N"
        number("contact.load", self.load, unit, 0.0, 1e10)
        number("contact.hertz_pressure", self.hertz_pressure, "Pa", 0.0, 2e10)
        number("contact.moes_M", self.moes_M, "", 0.0, 1e6)
        number("contact.moes_L", self.moes_L, "", 0.0, 1e3)
        self._check_combination()

    def _check_combination(self):
        given = [k for k in ("load", "hertz_pressure", "moes_M") if getattr(self, k) > 0]
        if len(given) != 1:
            raise SceneError(f"contact needs exactly one of load, hertz_pressure or the pair moes_M, moes_L (more than "
                             f"0); given: {', '.join(given) or 'none'}")
        if (self.moes_M > 0) != (self.moes_L > 0):
            raise SceneError(f"contact.moes_M = {self.moes_M:g} and moes_L = {self.moes_L:g} come as a pair, both more "
                             "than 0")
        if (self.kind == "line") != math.isinf(self.radius_y):
            raise SceneError(f"contact.radius_y = {self.radius_y:g} m does not fit kind {self.kind!r}: inf for a line "
                             "contact, a length in m otherwise")
        if self.kind == "point" and self.radius_y != self.radius_x:
            raise SceneError(f"contact.radius_y = {self.radius_y:g} m differs from radius_x = {self.radius_x:g} m: that is "
                             "kind 'elliptic'")
        if self.kind != "line" and not 0.02 <= self.radius_y / self.radius_x <= 50:
            raise SceneError(f"contact.radius_y = {self.radius_y:g} m is out of range; allowed: radius_x/50 to 50 radius_x "
                             f"(radius_x = {self.radius_x:g} m)")


@dataclass(frozen=True)
class Body:
    """Elastic half-space: E Pa, nu, k W/mK, rho kg/m3, c J/kgK, alpha 1/K (thermal expansion, for thermal stress).

    Default: steel (Everitt 2018); its alpha, 12e-6, is the usual handbook value of bearing and gear steels.
    """

    E: float = 206e9
    nu: float = 0.3
    k: float = 47.0
    rho: float = 7850.0
    c: float = 450.0
    alpha: float = 12e-6

    def __post_init__(self):
        normalise(self)
        number("bodies.alpha", self.alpha, "1/K", 0.0, 1e-3)
        number("bodies.E", self.E, "Pa", 1e6, 1e13)
        number("bodies.nu", self.nu, "", 0.0, 0.499)
        number("bodies.k", self.k, "W/mK", 0.01, 1e4)
        number("bodies.rho", self.rho, "kg/m3", 1.0, 1e5)
        number("bodies.c", self.c, "J/kgK", 1.0, 1e5)


@dataclass(frozen=True)
class Operation:
    """u_m m/s mean speed, srr = (u_a - u_b)/u_m, inlet temperature deg C. Surface a carries the feature."""

    u_m: float = 8.5
    srr: float = -0.12
    temperature: float = 90.0

    def __post_init__(self):
        normalise(self)
        number("operation.u_m", self.u_m, "m/s", 0.0, 1e3)
        if self.u_m < 1e-6:
            raise SceneError(f"operation.u_m = {self.u_m:g} m/s: without entrainment there is no film and SRR "
                             f"(= {self.srr:g}) has no meaning; allowed: more than 1e-6 m/s")
        number("operation.srr", self.srr, "", -2.0, 2.0)
        number("operation.temperature", self.temperature, "deg C", -50.0, 300.0)

    @property
    def u_s(self):
        """Slip u_a - u_b, m/s."""
        return self.u_m * self.srr

    @property
    def u_a(self):
        return self.u_m * (1 + self.srr / 2)

    @property
    def u_b(self):
        return self.u_m * (1 - self.srr / 2)


@dataclass(frozen=True)
class Rheology:
    """Shear law of the film and friction of solid contact.

    law: limiting (tau_L = tau_L0 + gamma p, smooth), eyring (tau_0), carreau (tau_0, carreau_n) or newtonian;
    mu_boundary: friction where surfaces touch; film_floor: H at which they touch (Everitt 2018), in a^2/R'.
    """

    law: str = "limiting"
    tau_L0: float = 10e6
    gamma: float = 0.075
    tau_0: float = 10e6
    carreau_n: float = 0.8
    mu_boundary: float = 0.3
    film_floor: float = 5e-6

    def __post_init__(self):
        normalise(self)
        choice("rheology.law", self.law, ("limiting", "newtonian", "eyring", "carreau"))
        number("rheology.tau_L0", self.tau_L0, "Pa", 1e3, 1e9)
        number("rheology.gamma", self.gamma, "", 0.0, 1.0)
        number("rheology.tau_0", self.tau_0, "Pa", 1e3, 1e10)
        number("rheology.carreau_n", self.carreau_n, "", 0.1, 1.0)
        number("rheology.mu_boundary", self.mu_boundary, "", 0.0, 2.0)
        number("rheology.film_floor", self.film_floor, "", 1e-9, 0.1)


AUTO = "auto"


def auto_flag(where, value):
    """Refuse anything but true, false or "auto"."""
    if not isinstance(value, bool) and value != AUTO:
        raise SceneError(f"{where} = {shown(value)} must be true, false or {AUTO!r}")


@dataclass(frozen=True)
class Thermal:
    """The energy equation; on: true, false (the film keeps the inlet temperature) or "auto": where the surfaces slip.

    nodes: Chebyshev nodes across the film (odd: one at mid-film; 9 are good to 0.01 %, 7 to 0.1 %); tolerance: K, change of
    the temperature in the last round of a step; rounds: pressure-temperature rounds of a step at most (1: one lagged
    pass, half the time, film under an asperity 0.3 % off).
    """

    on: Union[bool, str] = AUTO
    nodes: int = 9
    tolerance: float = 0.05
    rounds: int = 8

    def __post_init__(self):
        normalise(self)
        auto_flag("thermal.on", self.on)
        integer("thermal.nodes", self.nodes, 5, 33)
        number("thermal.tolerance", self.tolerance, "K", 1e-6, 10.0)
        integer("thermal.rounds", self.rounds, 1, 50)
        if self.nodes % 2 == 0:
            raise SceneError(f"thermal.nodes = {self.nodes} must be odd, so that one node lies at mid-film")


@dataclass(frozen=True)
class Fatigue:
    """Fatigue index: kappa (normal stress sensitivity) and endurance (sigma_eF, Pa).

    Both are example values to be replaced by those of the material at hand; no source is claimed for them.
    criterion: findley, findley-chord, matake or dang-van; depths: m below the surface, searched too; shear: whether the shear
    tractions count; thermal_stress: true, false or "auto" (where the scene has temperatures); residual_xx, residual_yy:
    constant residual stress, Pa; from_x, to_x: positions of the feature (a) between which moments count.
    """

    on: bool = True
    kappa: float = 0.3
    endurance: float = 400e6
    source: str = "example values, set your own"
    criterion: str = "findley"
    depths: tuple = ()
    shear: bool = True
    thermal_stress: Union[bool, str] = AUTO
    residual_xx: float = 0.0
    residual_yy: float = 0.0
    from_x: float = -math.inf
    to_x: float = math.inf

    def __post_init__(self):
        normalise(self)
        flag("fatigue.on", self.on)
        choice("fatigue.criterion", self.criterion, ("findley", "findley-chord", "matake", "dang-van"))
        flag("fatigue.shear", self.shear)
        auto_flag("fatigue.thermal_stress", self.thermal_stress)
        for key in ("residual_xx", "residual_yy"):
            number(f"fatigue.{key}", getattr(self, key), "Pa", -1e10, 1e10)
        text("fatigue.source", self.source, printable=False)
        for key in ("from_x", "to_x"):
            number(f"fatigue.{key}", getattr(self, key), "a", infinite=True)
        if not self.from_x < self.to_x:
            raise SceneError(f"fatigue.from_x = {self.from_x:g} a must be less than to_x = {self.to_x:g} a")
        if not isinstance(self.depths, tuple):
            raise SceneError(f"fatigue.depths = {shown(self.depths)} must be a list of depths in m, as [50e-6, 100e-6]")
        for depth in self.depths:
            number("fatigue.depths", depth, "m", 1e-7, 0.1)
        number("fatigue.kappa", self.kappa, "", 0.0, 5.0)
        number("fatigue.endurance", self.endurance, "Pa", 1e3, 1e11)


@dataclass(frozen=True)
class Grid:
    """nx x ny cells of the half domain y >= 0 (nodes: one more; twice ny cells where the scene is not symmetric); extent in
    half-widths of the contact, a along x and b along y (b = a unless elliptic)."""

    nx: int = 256
    ny: int = 64
    x_min: float = -2.5
    x_max: float = 1.5
    y_max: float = 1.0

    def __post_init__(self):
        normalise(self)
        integer("grid.nx", self.nx, 32, 8192)
        integer("grid.ny", self.ny, 8, 4096)
        for key, multiple in (("nx", 16), ("ny", 4)):
            if getattr(self, key) % multiple:
                raise SceneError(f"grid.{key} = {getattr(self, key)} cells must be a multiple of {multiple}, so that "
                                 "coarser grids exist")
        number("grid.x_min", self.x_min, "a", -20.0, -1.2)
        number("grid.x_max", self.x_max, "a", 1.2, 10.0)
        number("grid.y_max", self.y_max, "b", 0.3, 20.0)


@dataclass(frozen=True)
class Time:
    """Path of the first feature's centre from x_start to x_end (in a; -inf, inf: from before the contact until behind it,
    whatever the size of the features), courant cells a step, at most `steps` (0: all)."""

    steady_only: bool = False
    x_start: float = -math.inf
    x_end: float = math.inf
    courant: float = 1.0
    steps: int = 0

    def __post_init__(self):
        normalise(self)
        flag("time.steady_only", self.steady_only)
        number("time.x_start", self.x_start, "a", high=20.0, infinite=True)
        number("time.x_end", self.x_end, "a", -20.0, infinite=True)
        number("time.courant", self.courant, "", 0.05, 4.0)
        integer("time.steps", self.steps, 0, 10**7)
        if self.steady_only and self.steps > 0:
            raise SceneError(f"time.steady_only = true and time.steps = {self.steps} contradict each other: give one of them")


@dataclass(frozen=True)
class Numerics:
    """Tolerances of the pressure solver, each with its reason.

    tolerance 1e-6: rms of min(P, R/D, gap) plus load error; ten times less moves the film by under 0.1 % at 256 columns.
    mass_tolerance 1e-6: net mass defect over the Couette flux, the conservation that users check.
    krylov_tolerance 0.2: at most, inside Newton; from 0.03 to 0.3 a passage costs the same. newton_max, krylov_max: no
    converging case came near them. estimate_error: companion runs on coarser grids tell the error of the passage's numbers
    (an eighth more work).
    """

    tolerance: float = 1e-6
    mass_tolerance: float = 1e-6
    krylov_tolerance: float = 0.2
    newton_max: int = 30
    krylov_max: int = 80
    estimate_error: bool = False

    def __post_init__(self):
        normalise(self)
        flag("numerics.estimate_error", self.estimate_error)
        number("numerics.tolerance", self.tolerance, "", 1e-11, 1e-3)
        number("numerics.mass_tolerance", self.mass_tolerance, "", 1e-9, 1.0)
        number("numerics.krylov_tolerance", self.krylov_tolerance, "", 1e-6, 0.5)
        integer("numerics.newton_max", self.newton_max, 1, 1000)
        integer("numerics.krylov_max", self.krylov_max, 5, 500)


@dataclass(frozen=True)
class Output:
    """every: store every n-th step; profiles: store the temperature at every node across the film too."""

    every: int = 1
    profiles: bool = False

    def __post_init__(self):
        normalise(self)
        flag("output.profiles", self.profiles)
        integer("output.every", self.every, 1, 10**6)
