"""The sections of a scene, one frozen dataclass each (SI; temperatures in deg C)."""

import math
import numbers
from typing import TYPE_CHECKING, Any, Union

from tehl_taichi.errors import SceneError
from tehl_taichi.laws import rheology
from tehl_taichi.laws.criteria import CRITERIA, sensitivities
from tehl_taichi.laws.hardening import HARDENINGS
from tehl_taichi.laws.hardness import RELATIONS
from tehl_taichi.laws.law import declared, section
from tehl_taichi.laws.solid_friction import BOUNDARY
from tehl_taichi.scene import fatigue_limits
from tehl_taichi.scene.fatigue_limits import LARGEST_LIMIT, LEAST_LIMIT, USUAL_LIMIT
from tehl_taichi.scene.named_steels import STEELS, with_steel_numbers
from tehl_taichi.scene.strength import scene_tables
from tehl_taichi.scene.strength.profiles import WORDS as PROFILES
from tehl_taichi.values.checks import build
from tehl_taichi.values.coerce import plain
from tehl_taichi.values.quantity import AUTO, check, choice, count, count_of, documented, quantities, quantity, switch, text
from tehl_taichi.values.unit_hints import hint

LEAST_RESIDUAL, LARGEST_RESIDUAL = 1e5, 1e10  # Pa, in size: what is smaller does nothing, and was meant in MPa
ROWS = 50000  # letters of a table of strength
DEEPEST = 0.03  # m, of a depth: contacts are a millimetre wide, 0.05 was meant in mm
LARGEST_RADIUS = 1.0  # m: the teeth of the largest gears have a fifth of it; a number beyond it was meant in mm
LARGEST_RADIUS_Y = 100.0  # m: a roller is nearly straight


@documented
class Contact:
    """Geometry and load: one of load, hertz_pressure or the Moes pair; 0 = not given.

    The pair gives the speed from L (with alpha and eta0 of the oil) and the load from M.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Contact(load=1.1e6)
    Contact(load=1100000.0)
    >>> tehl.Contact(kind="point", radius_x=0.01, radius_y=0.01, hertz_pressure=1e9).load
    0.0
    """

    kind: str = choice("line", "shape; point: circular", ("line", "point", "elliptic"))
    radius_x: float = quantity(10.6e-3, "m", "reduced radius along x, 1/R' = 1/r_a + 1/r_b", 1e-6, LARGEST_RADIUS,
                               common=(1e-4, 0.4))
    radius_y: float = quantity(math.inf, "m", "reduced radius along y; inf: line, or a circular contact", 1e-6,
                               LARGEST_RADIUS_Y, infinite=True, usual=10e-3)
    load: float = quantity(0.0, "N/m or N", "line: N/m, point and elliptic: N; 0: not given", 0.0, 1e10)
    hertz_pressure: float = quantity(0.0, "Pa", "Hertz pressure instead of a load; 0: not "
                                                "given", 0.0, 2e10, usual=1e9, least=1e7)
    moes_M: float = quantity(0.0, "", "Moes load number, with moes_L instead of load and speed; 0: not given", 0.0, 1e6)
    moes_L: float = quantity(0.0, "", "Moes lubricant number, with moes_M; 0: not given", 0.0, 1e3)

    def __post_init__(self):
        check(self, "contact", load="N/m" if isinstance(self.kind, str) and self.kind == "line" else "N")
        if self.kind == "point" and math.isinf(self.radius_y):
            object.__setattr__(self, "radius_y", self.radius_x)
        self._check_combination()

    def _check_combination(self):
        given = [k for k in ("load", "hertz_pressure", "moes_M") if getattr(self, k) > 0]
        if len(given) != 1:
            raise SceneError(f"contact needs exactly one of load, hertz_pressure or the pair moes_M, moes_L (more than "
                             f"0); given: {', '.join(given) or 'none'}")
        if (self.moes_M > 0) != (self.moes_L > 0):
            raise SceneError(f"contact.moes_M = {self.moes_M:g} and moes_L = {self.moes_L:g} must be given as a pair, both "
                             "more than 0")
        if self.kind == "line" and not math.isinf(self.radius_y):
            raise SceneError(f"contact.radius_y = {self.radius_y:g} m does not match kind 'line'; allowed: inf, or kind "
                             "'elliptic'")
        if self.kind == "elliptic" and math.isinf(self.radius_y):
            raise SceneError("contact.radius_y is not given; an elliptic contact needs its reduced radius along y in m")
        if self.kind == "point" and self.radius_y != self.radius_x:
            raise SceneError(f"contact.radius_y = {self.radius_y:g} m differs from radius_x = {self.radius_x:g} m, which needs "
                             "kind 'elliptic'")
        if self.kind != "line" and not 0.02 <= self.radius_y / self.radius_x <= 50:
            raise SceneError(f"contact.radius_y = {self.radius_y:g} m is out of range; allowed: radius_x/50 to 50 radius_x "
                             f"(radius_x = {self.radius_x:g} m){self._radius_meant()}")

    def _radius_meant(self):
        return hint(self.radius_y, "m", lambda other: 0.02 <= other / self.radius_x <= 50, self.radius_x)


@documented
class Body:
    """An elastic half-space; default: steel (Everitt 2018).

    alpha is a handbook value of bearing and gear steels. A named steel (`tehl steels`) gives all numbers that are not given.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Body(E=75e9, nu=0.22)
    Body(E=75000000000.0, nu=0.22)
    """

    material: str = choice("", "named steel; empty: use the numbers below", ("", *STEELS))
    E: float = quantity(206e9, "Pa", "Young's modulus", 1e6, 1e13)
    nu: float = quantity(0.3, "", "Poisson's ratio", 0.0, 0.499)
    k: float = quantity(47.0, "W/mK", "thermal conductivity", 0.01, 1e4)
    rho: float = quantity(7850.0, "kg/m3", "density", 100.0, 1e5)
    c: float = quantity(450.0, "J/kgK", "specific heat", 1.0, 1e5)
    alpha: float = quantity(12e-6, "1/K", "thermal expansion, for the thermal stress", 0.0, 1e-3)
    yield_stress: float = quantity(0.0, "Pa", "uniaxial yield stress, with which the von Mises stress is compared; 0: not "
                                              "given, 2.2 GPa of hardened bearing steel", 0.0, 1e11, usual=2.2e9, least=1e6)
    hardening: str = choice("perfect", "hardening law of steel that yields in run-in (`tehl laws`)", tuple(HARDENINGS))
    _completed = staticmethod(with_steel_numbers)

    def __post_init__(self):
        check(self, "bodies")


@documented
class Operation:
    """Surface speeds; in a file or a change u_a and u_b in m/s may replace u_m and srr.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Operation(u_m=10.0, srr=0.2).u_a
    11.0
    """

    u_m: float = quantity(8.5, "m/s", "mean speed (u_a + u_b)/2", 1e-6, 1e3, common=(1e-4, 200.0))
    srr: float = quantity(-0.12, "", "slide-roll ratio (u_a - u_b)/u_m; negative: surface a is the slower one", -2.0, 2.0)
    temperature: float = quantity(90.0, "deg C", "temperature of oil and bodies at the inlet", -50.0, 300.0)

    def __post_init__(self):
        if isinstance(self.u_m, numbers.Number) and self.u_m == 0:
            raise SceneError(f"operation.u_m = 0 m/s: without entrainment there is no film and SRR (= {self.srr}) has no "
                             "meaning; allowed: at least 1e-6 m/s")
        check(self, "operation")

    @property
    def u_s(self) -> float:
        """Slip u_a - u_b, m/s."""
        return self.u_m * self.srr

    @property
    def u_a(self) -> float:
        return self.u_m * (1 + self.srr / 2)

    @property
    def u_b(self) -> float:
        return self.u_m * (1 - self.srr / 2)


_RHEOLOGY: Any = section("_RHEOLOGY", law=choice("limiting", "shear law of the film (`tehl laws`)", tuple(rheology.LAWS)),
                    **declared({**rheology.LAWS, BOUNDARY.name: BOUNDARY}))


@documented
class Rheology(_RHEOLOGY):
    """Shear law of the film and friction of solid contact.

    The law acts in flow, friction and heat wherever the surfaces slip, and in the flow wherever a pressure gradient shears the
    film at the walls. `newtonian` gives the film of isothermal formulas and most published films; its friction is higher than
    that of any oil. `tehl laws` lists the laws and their numbers.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Rheology(law="newtonian").thins
    False
    """

    if TYPE_CHECKING:  # keys come from the registries
        law: str

    def __post_init__(self):
        check(self, "rheology")

    @property
    def thins(self):
        """Whether shear reduces the viscosity."""
        return rheology.LAWS[self.law].thins

    @property
    def power(self):
        """Largest power of the wall stress with which the flow exceeds that of a Newtonian oil."""
        return rheology.LAWS[self.law].power


@documented
class Thermal:
    """Energy equation; without it the film has the inlet temperature.

    Seven nodes change the film under an asperity by 0.14 % and the largest temperature by 0.08 %. One round (a lagged
    temperature) takes a quarter less time and changes that film by 0.2 %.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Thermal(nodes=7)
    Thermal(nodes=7)
    """

    on: Union[bool, str] = switch(AUTO, "energy equation; auto: if the surfaces slip, or the heat of the inlet reduces h_c by "
                                        "more than 1 % by formula", auto=True)
    nodes: int = count(9, "Chebyshev nodes across the film, odd: one at mid-film", 5, 33)
    tolerance: float = quantity(0.05, "K", "largest temperature change in the last round of a step", 1e-6, 10.0)
    # With 8 of them steps behind a front were taken in parts, with up to 7 % other pressures (a rolling dent), and an asperity
    # of 100 um, whose outlet changes by 100 K and more from round to round, did not pass 1.15 a (128 columns, SRR -0.12, 0.12)
    rounds: int = count(32, "largest number of pressure-temperature rounds of a step", 1, 50)

    def __post_init__(self):
        check(self, "thermal")
        if self.nodes % 2 == 0:
            raise SceneError(f"thermal.nodes = {self.nodes} must be odd, so that one node lies at mid-film")


BOTH = "both"  # as fatigue.surfaces


@documented
class Fatigue:
    """Fatigue index; kappa and endurance are example values, set those of your material.

    One limit in reversed torsion or bending fixes endurance; both limits also fix kappa. A table gives them over the depth.
    depths = []: only the surface.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> f"{tehl.Fatigue(bending_limit=600e6, torsion_limit=390e6).kappa:.3f}"
    '0.314'
    """

    on: bool = switch(True, "stresses and fatigue index of a passage")
    kappa: float = quantity(0.3, "", f"sensitivity to stress, {sensitivities()}", 0.0, 5.0)
    endurance: float = quantity(400e6, "Pa", "fatigue limit sigma_eF: Fi = 1", 1e6, 1e11)
    bending_limit: float = quantity(0.0, "Pa", "fatigue limit in reversed bending, instead of endurance; with torsion_limit "
                                               "also instead of kappa; 0: not given", 0.0, LARGEST_LIMIT, usual=USUAL_LIMIT,
                                    least=LEAST_LIMIT)
    torsion_limit: float = quantity(0.0, "Pa", "fatigue limit in reversed torsion; 0: not given", 0.0, LARGEST_LIMIT,
                                    usual=USUAL_LIMIT, least=LEAST_LIMIT)
    source: str = text("example values, set your own", "source of kappa and endurance", one_line=False)
    limit_of: str = choice("specimen", "test behind the limit; specimen: in bending or torsion, without residual stress; "
                                       "contact: a smooth rolling contact, with its residual stress", ("specimen", "contact"))
    table: str = text("", "strength over depth: CSV file (depth_mm, hardness_HV or limit_MPa; kappa, yield_stress_MPa, "
                          "residual_xx_MPa, residual_yy_MPa), its path relative to the scene file, or a built-in one "
                          f"({PROFILES})", most=4096, compare=False)
    table_b: str = text("", "table of body b, if different; none: that body has no table", most=4096, compare=False)
    table_rows: str = text("", "contents of the table, set when it is read; empty: read the file", most=ROWS, one_line=False)
    table_rows_b: str = text("", "contents of the table of body b", most=ROWS, one_line=False)
    relation: str = choice("ss2506", "fatigue limit by the hardness of a table (`tehl laws`)", tuple(RELATIONS))
    inclusion: float = quantity(0.0, "m", "root of the area of the largest inclusion, for the relation murakami; 0: not given",
                                0.0, 1e-3, usual=3e-5, least=1e-7)
    exponent: float = quantity(0.0, "", "exponent m of the S-N curve: limit_cycles Fi^-m passages to initiation; 0: not "
                                        "counted", 0.0, 100.0, usual=9.0, least=1.0)
    limit_cycles: float = quantity(1e7, "", "number of passages at the fatigue limit, used with an exponent", 1e3, 1e12)
    weibull: float = quantity(0.0, "", "Weibull exponent of the strength, for the stressed volume; 0: not computed", 0.0, 200.0,
                              usual=24.0, least=1.0)
    reference_volume: float = quantity(0.0, "m3", "stressed volume of a specimen that survives the limit in half of the cases; "
                                                  "0: not given, no probability", 0.0, 1.0, usual=1e-7)
    reference_area: float = quantity(0.0, "m2", "stressed surface of that specimen; 0: not given", 0.0, 1.0, usual=1e-4)
    surfaces: str = choice(BOTH, "surfaces whose material is searched", (BOTH, "a", "b"))
    criterion: str = choice("findley", "fatigue criterion", tuple(CRITERIA))
    depths: Union[tuple, str] = quantities(AUTO, "m", "depths to search; auto: the critical depth under the feature; a list "
                                                      "as [50e-6, 100e-6]: these depths for all points", 1e-7, DEEPEST,
                                           auto=True, usual=1e-4)
    length: float = quantity(10e-6, "m", "side of the square over which stresses are averaged for a second index (material "
                                         "length); 0: only stresses at points", 0.0, 1e-3)
    shear: bool = switch(True, "include the shear tractions")
    thermal_stress: Union[bool, str] = switch(AUTO, "include thermal stress; auto: if temperatures are computed", auto=True)
    residual_xx: float = quantity(0.0, "Pa", "constant residual stress along x", -LARGEST_RESIDUAL, LARGEST_RESIDUAL,
                                  usual=-2e8, least=LEAST_RESIDUAL)
    residual_yy: float = quantity(0.0, "Pa", "constant residual stress along y", -LARGEST_RESIDUAL, LARGEST_RESIDUAL,
                                  usual=-2e8, least=LEAST_RESIDUAL)
    from_x: float = quantity(-math.inf, "a", "first position of the feature that counts; -inf: all", infinite=True)
    to_x: float = quantity(math.inf, "a", "last position of the feature that counts; inf: all", infinite=True)

    def __post_init__(self):
        check(self, "fatigue")
        self._follow_limits()
        scene_tables.read(self)
        if not self.from_x < self.to_x:
            raise SceneError(f"fatigue.from_x = {self.from_x!r} a must be less than to_x = {self.to_x!r} a")
        if self.depths != AUTO:
            object.__setattr__(self, "depths", tuple(self.depths))

    def _follow_limits(self):
        """Set the constants that the limits determine; refuse given constants that differ from these and the defaults."""
        found = fatigue_limits.derived_values(self)
        given = {key: getattr(self, key) for key in fatigue_limits.derived_keys(vars(self))}
        for key, value in found.items():
            object.__setattr__(self, key, value)
        fatigue_limits.check_agreement({key: value for key, value in given.items() if value != getattr(type(self), key)}, self)
        if found:
            check(self, "fatigue")

    @classmethod
    def from_values(cls, values):
        """Section from a table; unknown keys are refused, and constants beside limits that differ from those they determine.

        None marks a derived constant. Raises SceneError.
        """
        free = fatigue_limits.derived_keys(values) if isinstance(values, dict) else ()
        made = build(cls, {key: value for key, value in values.items() if key not in free} if free else values, "fatigue")
        fatigue_limits.check_agreement({key: plain(values[key]) for key in free if values.get(key) is not None}, made)
        return made

    def table_text(self, surface):
        """Text of the table (see :mod:`tehl_taichi.scene.strength.table`) of body "a" or "b", "" without one."""
        return scene_tables.text_of(self, surface)

    @property
    def listed(self):
        """Depths (m) at which every point is searched."""
        return () if self.depths == AUTO else self.depths


@documented
class Grid:
    """Cells and extent of the grid, in half-widths a along x and b along y (b = a unless elliptic).

    The grid has one node more than cells. A scene that is not symmetric in y has twice ny cells; a scene without variation
    along y has none.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Grid(nx=128)
    Grid(nx=128)
    """

    nx: int = count(256, "cells along x", 32, 8192, 16)
    ny: int = count(64, "cells along y, of the half domain y >= 0", 8, 4096, 4)
    x_min: Union[float, str] = quantity(AUTO, "a", "inlet end of the grid; auto: -2.5, or farther for thick "
                                                   "films", -20.0, -1.2, usual=-2.5)
    x_max: Union[float, str] = quantity(AUTO, "a", "outlet end of the grid; auto: 1.5, or farther for thick "
                                                   "films", 1.2, 14.0, usual=1.5)
    y_max: Union[float, str] = quantity(AUTO, "b", "side end of the grid; auto: 1 of a line, at least 1.5 of a point contact",
                                        0.3, 20.0, usual=1.0)
    inlet: str = choice("flooded", "oil before the grid; flooded: unlimited, its pressure acts at the border; starved: the "
                                   "oil begins at x_min without pressure", ("flooded", "starved"))

    def __post_init__(self):
        check(self, "grid")


@documented
class Time:
    """Path of feature.x = 0, the centre of a first feature there, and length of a step.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Time(courant=0.5)
    Time(courant=0.5)
    """

    steady_only: bool = switch(False, "compute the steady contact only")
    x_start: float = quantity(-math.inf, "a", "first position of the feature; -inf: before the contact", high=20.0,
                              infinite=True)
    x_end: float = quantity(math.inf, "a", "last position of the feature; inf: behind the contact", -20.0, infinite=True)
    courant: float = quantity(1.0, "cells", "distance that the feature moves in a step", 0.05, 4.0)
    steps: int = count(-1, "stop after this many steps; -1: all, 0: the steady start alone", -1, 10**7)
    run_in: int = count(0, "largest number of run-in passages, in which steel yields, before the stored and assessed passage; "
                           "0: elastic bodies", 0, 100)

    def __post_init__(self):
        check(self, "time")
        if self.steady_only and self.steps > 0:
            raise SceneError(f"time.steady_only = true and time.steps = {self.steps} contradict each other: give one of them")


@documented
class Numerics:
    """Tolerances and limits of the pressure solver, and error estimates.

    A tolerance ten times smaller changes the film by less than 0.1 % at 256 columns. krylov_tolerance from 0.03 to 0.3 gives
    equal run times. No converging case came near newton_max or krylov_max. For estimate_error see docs/numerics.md.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Numerics(precision="f64")
    Numerics(precision='f64')
    """

    tolerance: float = quantity(1e-6, "", "rms of min(P, R/D, gap) plus load error", 1e-11, 1e-3)
    mass_tolerance: float = quantity(1e-6, "", "net mass defect over the Couette flux", 1e-9, 1.0)
    krylov_tolerance: float = quantity(0.2, "", "largest tolerance of the linear solves inside Newton", 1e-6, 0.5)
    newton_max: int = count(30, "largest number of Newton steps of an attempt", 1, 1000)
    krylov_max: int = count(80, "largest number of Krylov iterations of a Newton step", 5, 500)
    precision: str = choice(AUTO, "precision of the linear solves inside Newton; auto: f32 for thick films that vary along y "
                                  "(f32 is refused for thin ones); the state and its residual are always double",
                            (AUTO, "f32", "f64"))
    sweep: str = choice("jacobi", "order of the lines in the linear solves: all at once, or alternating (red-black, slower; "
                                  "see docs/decisions/05-line-order.md)", ("jacobi", "red-black"))
    estimate_error: Union[bool, str] = switch(AUTO, "estimate errors by coarse-grid runs, in a seventh of the run time; auto: "
                                                    "for all but very short passages", auto=True)

    def __post_init__(self):
        check(self, "numerics")


@documented
class Output:
    """Contents of the store.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Output(every=4)
    Output(every=4)
    """

    every: int = count(1, "store every n-th step and the last; their extremes include the steps between", 1, 10**6)
    profiles: bool = switch(False, "also store the temperature at every node across the film")

    def __post_init__(self):
        check(self, "output")


@documented
class Zoom:
    """A fine window that moves with the feature through the run; features on both bodies have two.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Zoom(factor=4)
    Zoom(factor=4)
    """

    factor: int = count_of(0, "cells of the window in a cell of the grid, along each axis; 0: no window", 0, 2, 4, 8, 16)
    width_x: float = quantity(0.0, "a", "width of the window along x; 0: as the feature needs", 0.0, 4.0, usual=0.8, least=0.1)
    width_y: float = quantity(0.0, "a", "width of the window along y; 0: as the feature needs", 0.0, 8.0, usual=0.8, least=0.1)
    from_x: Union[float, str] = quantity(AUTO, "a", "first position of the feature with a window; auto: shortly before the "
                                         "grid no longer resolves the pressure; -inf: its whole path", infinite=True, usual=0.5)
    to_x: float = quantity(math.inf, "a", "last position of the feature with a window; inf: its whole path", infinite=True)

    def __post_init__(self):
        check(self, "zoom")
        if not isinstance(self.from_x, str) and not self.from_x < self.to_x:
            raise SceneError(f"zoom.from_x = {self.from_x!r} a must be less than to_x = {self.to_x!r} a")


SECTIONS = {"contact": Contact, "operation": Operation, "rheology": Rheology, "thermal": Thermal, "fatigue": Fatigue,
            "grid": Grid, "time": Time, "numerics": Numerics, "output": Output, "zoom": Zoom}
NEWER = ("zoom",)  # sections that stores of earlier versions do not have
