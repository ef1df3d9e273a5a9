"""The whole scene: its parts, the checks between them, changes, and conversion to and from plain dictionaries."""

import dataclasses
import functools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from tehl_taichi.errors import SceneError
from tehl_taichi.laws.shear.newtonian import NEWTONIAN
from tehl_taichi.scene import (
    aliases,
    domain,
    domain_warnings,
    film_formula,
    idle_keys,
    left_out,
    moving_surfaces,
    named_oils,
    oil,
    oil_range,
    overlap,
    overrides,
    replaced_keys,
    resolution,
    run_in,
    scales,
    scene_warnings,
    thick_film,
    zoom_room,
)
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.sections import (
    AUTO,
    BOTH,
    SECTIONS,
    Body,
    Contact,
    Fatigue,
    Grid,
    Numerics,
    Operation,
    Output,
    Rheology,
    Thermal,
    Time,
    Zoom,
)
from tehl_taichi.scene.speeds import of_surfaces
from tehl_taichi.scene.surface.maps import map_warnings
from tehl_taichi.scene.timeline import LATEST, moments, total_steps
from tehl_taichi.scene.unit_texts import in_units
from tehl_taichi.values.checks import build, file_name, key_shown, nearest, number
from tehl_taichi.values.coded_text import for_reader
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.quantity import Text, kinds, known_keys
from tehl_taichi.values.unit_hints import hint

TOP = {"name": Text("name of the scene and its stores", 100),  # the keys above all tables
       "note": Text("free text on one line, stored and shown with the run")}
FIRST, LAST = -1.6, 1.4  # of the path of a small feature, in a
CLEAR = 1.3  # distance in a of a feature's front from X = 0 at an automatic start
BEYOND = 1.2  # half-widths, at least, from the centre to the edge of the grid
AT_REST = 0.01  # of the mean speed
PARTS: tuple[Any, ...] = Body, Oil, *SECTIONS.values()
MAX_HERTZ, MIN_HERTZ = 6e9, 1e7  # Pa: outside this range the laws say nothing


@known_keys
@dataclass(frozen=True)
class Scene:
    """A contact, its bodies, oil and motion, and how it is computed; SI units.

    Immutable: :meth:`replace` gives a changed copy. :func:`tehl_taichi.scene` loads one by name, file or store.

    Parameters
    ----------
    name : str
        Stores are named after it.
    contact, operation, rheology, thermal, fatigue, grid, time, numerics, output, zoom
        The sections, classes of these names (:class:`tehl_taichi.Contact` ...).
    body_a, body_b : Body
        Body a carries the features.
    oil : Oil
        The lubricant.
    features : sequence of Feature
        None: a smooth contact.
    note : str
        Free words, stored with the run.

    Raises
    ------
    SceneError
        The sections contradict each other, or a value is out of range.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> scene = tehl.Scene(contact=tehl.Contact(load=1.1e6), grid=tehl.Grid(nx=128, ny=32))
    >>> scene
    <tehl.Scene gear: line contact, p_H 1.93 GPa, u_m 8.5 m/s, SRR -0.12, 1 feature, 128 x 32 cells>
    >>> scene.replace(hertz_pressure=1.5e9, **{"feature.height": -1e-6}).features[0].height
    -1e-06
    """

    name: str = "gear"
    contact: Contact = field(default_factory=lambda: Contact(load=1.1e6))
    body_a: Body = Body()
    body_b: Body = Body()
    operation: Operation = Operation()
    oil: Oil = Oil()
    rheology: Rheology = Rheology()
    features: Sequence[Feature] = (Feature(),)
    thermal: Thermal = Thermal()
    fatigue: Fatigue = Fatigue()
    grid: Grid = Grid()
    time: Time = Time()
    numerics: Numerics = Numerics()
    output: Output = Output()
    zoom: Zoom = Zoom()
    note: str = field(default="", compare=False)
    user_keys = None  # full keys that the user gave: those without effect are reported; None: those of unusual values
    replaced = ()  # warnings about values of the user that other keys replaced

    def __repr__(self):
        s, o, count = scales.Scales.of(self), self.operation, len(self.features)
        cells = f"{self.grid.nx} cells" if self.one_dimensional else f"{self.grid.nx} x {self.grid.ny} cells"
        return (f"<tehl.Scene {self.name}: {self.contact.kind} contact, p_H {s.p_H / 1e9:.2f} GPa, u_m {o.u_m:.3g} m/s, "
                f"SRR {o.srr:g}, {number_of(count, 'feature')}, {cells}>")

    def __post_init__(self):
        file_name("name", self.name)
        TOP["note"].check("note", self.note)
        self._check_kinds()
        resolution.check_count(self.features)
        if self.contact.moes_M > 0:
            object.__setattr__(self, "operation", dataclasses.replace(self.operation, u_m=self._moes_speed()))
        if self.fatigue.thermal_stress is True and self.isothermal:
            raise SceneError("fatigue.thermal_stress = true needs temperatures: use --thermal, or \"auto\"")
        self._check_pressure()
        oil_range.check(self)
        thick_film.check(self)
        object.__setattr__(self, "grid", domain.with_chosen_ends(self))
        self._check_motion()
        self._check_path()
        self._check_room()
        self._check_zoom()
        resolution.check(self)
        self._check_window()
        run_in.check(self)

    def _check_kinds(self):
        """Check the type of every part; features become a tuple."""
        if isinstance(self.features, list):
            object.__setattr__(self, "features", tuple(self.features))
        for key, kind in {**SECTIONS, "body_a": Body, "body_b": Body, "oil": Oil}.items():
            if not isinstance(getattr(self, key), kind):
                raise SceneError(f"{key} = {shown(getattr(self, key))} must be of the class {kind.__name__}")
        if not isinstance(self.features, tuple) or not all(isinstance(f, Feature) for f in self.features):
            raise SceneError(f"features = {shown(self.features)} must be a list of the class Feature")

    def _moes_speed(self):
        u_m = scales.moes_speed(self)
        number(f"contact.moes_L = {self.contact.moes_L:g}: the mean speed that gives it", u_m, "m/s", 1e-6, 1e3)
        return u_m

    def _check_pressure(self):
        p_H = scales.Scales.of(self).p_H
        if not MIN_HERTZ <= p_H <= MAX_HERTZ:
            raise SceneError(f"{self._load_words()} gives a Hertz pressure of {p_H:.3g} Pa; allowed: {MIN_HERTZ:.0e} to "
                             f"{MAX_HERTZ:.0e} Pa{self.load_meant()}")

    def _check_path(self):
        start, end = self.path
        if end <= start:
            raise SceneError(f"time.x_end = {end:g} a must be more than x_start = {start:g} a")
        a = scales.Scales.of(self).a
        front = max((s.pace * start + (f.x + f.reach) / a for s, f in self.passing), default=-10.0)
        if self.transient and front > -LATEST:
            raise SceneError(f"time.x_start = {start:g} a: the features reach up to {front:.2f} a at the start, but the steady "
                             f"start needs a smooth contact; allowed: at most {start - front - LATEST:.2f} a (or -inf)")

    def _check_room(self):
        """Check that a point contact fits into the grid, and a feature into the gap at the ends of the domain."""
        side = float(self.grid.y_max)
        if self.contact.kind != "line" and side < BEYOND:
            raise SceneError(f"grid.y_max = {side:g} b: a {self.contact.kind} contact extends to 1 b; allowed: at "
                             f"least {BEYOND:g} b")
        s = scales.Scales.of(self)
        for key, end in (("x_min", float(self.grid.x_min)), ("x_max", float(self.grid.x_max))):
            gap = 0.5 * end**2 * s.h
            if self.transient and gap < (highest := overlap.highest_at(self, end, gap)):
                farther = f", or a wider domain: {words}" if (words := domain_warnings.domain_words(self)) else ""
                together = " together" * (highest > max(f.top for f in self.features))
                more = math.sqrt(highest / gap) * abs(end) / min(abs(end), domain.INLETS[0])
                raise SceneError(f"{self._load_words()} gives a half-width a of {s.a:.3g} m and so, at grid.{key} = {end:g} a, "
                                 f"an undeformed gap of {gap:.3g} m, smaller than the height of "
                                 f"{domain_warnings.higher(self, highest)}, {highest:.3g} m; allowed: a height of at most "
                                 f"{gap:.2g} m{together}, more load{farther}{self.load_meant(more) or self._form_words()}")

    def _check_zoom(self):
        """Check that a scene with a fine window stores every step."""
        if not self.zooms:
            return
        if self.output.every > 1:
            raise SceneError(f"zoom.factor = {self.zoom.factor} needs every step: use output.every = 1 (it is "
                             f"{self.output.every})")
        zoom_room.check(self)

    def _check_window(self):
        """Check that the fatigue window leaves some moments of the passage."""
        if not self.has_fatigue or total_steps(self) == 0:
            return
        count, start, end = moments(self)
        if count < 2:
            f = self.fatigue
            raise SceneError(f"fatigue.from_x = {f.from_x:g} a to fatigue.to_x = {f.to_x:g} a leaves {count} stored moments of "
                             f"the passage, which extends from {start:.2f} to {end:.2f} a; allowed: a window of at least two")

    def _form_words(self):
        """Sentences about the form of a measured feature, which adds to its height."""
        sentences = (sentence for f in self.features if f.kind.measured for sentence in map_warnings.form(f))
        return "".join(f". {sentence}" for sentence in sentences)

    def _load_words(self):
        """Text of the load as it was given."""
        key, value, unit = self._load_given()
        return f"contact.{key} = {value:g}{' ' * bool(unit)}{unit}"

    def _load_given(self):
        """Key, value and unit of the load as it was given."""
        key = next(key for key in ("load", "hertz_pressure", "moes_M") if getattr(self.contact, key) > 0)
        unit = {"load": self.load_unit, "hertz_pressure": "Pa", "moes_M": ""}[key]
        return key, getattr(self.contact, key), unit

    @property
    def load_unit(self) -> str:
        """Unit of contact.load."""
        return "N/m" if self.contact.kind == "line" else "N"

    def load_meant(self, wider=0.0, least=MIN_HERTZ):
        """Unit in which the load was probably meant, if the load makes no contact, one `wider` times too wide, or a Hertz
        pressure of at least `least` (Pa). Width and pressure scale alike.
        """
        key, value, unit = self._load_given()
        power = 1.0 if key == "hertz_pressure" else 1 / 2 if self.contact.kind == "line" else 1 / 3
        p_H = scales.Scales.of(self).p_H

        def fits(other):
            times = (other / value) ** power
            return times >= wider and least <= times * p_H <= MAX_HERTZ

        return hint(value, unit, fits)

    def _check_motion(self):
        slow = self.reference
        if self.transient and slow.stands:
            least, other = {"a": ("srr > -1.998", "b"), "b": ("srr < 1.998", "a")}[slow.name]
            first = "the first feature" if self.features[1:] else "the feature"
            raise SceneError(f"operation.srr = {self.operation.srr:g} leaves surface {slow.name}, which carries {first}, "
                             f"at {slow.speed:g} m/s, so it never passes; allowed: {least}, a feature of surface {other} "
                             f"as the first one, whose way is the clock, or use --steady")

    @property
    def load(self):
        """Load in N/m (line) or N (point), however the contact was described."""
        return scales.load_of(self)

    @property
    def transient(self) -> bool:
        """True if a feature passes."""
        return bool(self.features) and not self.time.steady_only

    @property
    def zooms(self) -> bool:
        """Whether the passage has a fine window around its feature."""
        return self.transient and self.zoom.factor > 0

    @property
    def runs_in(self) -> bool:
        """Whether run-in passages, in which steel yields, come before the assessed passage."""
        return self.transient and self.time.run_in > 0

    @property
    def at_rest(self) -> tuple:
        """(surface a, surface b): whether it moves at less than a hundredth of the mean speed; then heat treats it as at
        rest.
        """
        o = self.operation
        return o.u_a < AT_REST * o.u_m, o.u_b < AT_REST * o.u_m

    @property
    def surfaces(self) -> tuple:
        """Both surfaces, a first (:class:`tehl_taichi.scene.moving_surfaces.MovingSurface`)."""
        return moving_surfaces.surfaces(self)

    @property
    def reference(self):
        """Surface of the first feature, whose position is the clock of a passage; a without features."""
        return next(s for s in self.surfaces if s.name == moving_surfaces.reference_name(self))

    @property
    def passing(self) -> list:
        """[(surface, feature)] of all passing features."""
        return [(s, f) for s in self.surfaces for f in s.features if not s.stands]

    @property
    def standing(self) -> tuple:
        """Features of a surface at rest; they are in the contact from the steady start on."""
        return tuple(f for s in self.surfaces for f in s.features if s.stands and self.transient)

    @property
    def path(self) -> tuple[float, float]:
        """Start and end position of the first feature's centre, in a; they lie farther out for long features."""
        if not self.features:
            return FIRST, LAST
        a = scales.Scales.of(self).a
        carried = [(s.pace, f) for s, f in self.passing]
        start = min((min(FIRST, -CLEAR - (f.x + f.reach) / a) / pace for pace, f in carried), default=FIRST)
        end = max((max(LAST, LATEST + (f.reach - f.x) / a) / pace for pace, f in carried), default=LAST)
        return (self.time.x_start if self.time.x_start > -math.inf else start,
                self.time.x_end if self.time.x_end < math.inf else end)

    @property
    def one_dimensional(self) -> bool:
        """True for a line contact without variation along y."""
        return self.contact.kind == "line" and (not self.transient or all(f.transverse for f in self.features))

    @property
    def symmetric(self) -> bool:
        """True if the half domain y >= 0 suffices."""
        return not self.transient or all(f.symmetric for f in self.features)

    @property
    def rows(self) -> int:
        """Number of cells along y: 0 in one dimension, grid.ny on the half domain, twice as many on the whole."""
        return 0 if self.one_dimensional else self.grid.ny * (1 if self.symmetric else 2)

    @property
    def isothermal(self) -> bool:
        """Whether no temperatures are computed. Left to the program, they are but for a Moes pair, and for pure rolling where
        the heat of the inlet hardly matters by formula."""
        if self.thermal.on == AUTO:
            return self.contact.moes_M > 0 or self.operation.srr == 0 and not film_formula.inlet_is_warm(self)
        return not self.thermal.on

    @property
    def shear_law(self) -> Rheology:
        """Rheology for the flow of an isothermal film: Newtonian without slip."""
        return self.rheology if self.operation.u_s != 0 else dataclasses.replace(self.rheology, law=NEWTONIAN.name)

    @property
    def keeps_expansion(self) -> bool:
        """Whether the density of an isothermal film keeps its thermal factor, at the inlet temperature.

        It does if thermal.on is left to the program and there is no slip, so that films with and without slip have one oil.
        """
        return self.thermal.on == AUTO and self.contact.moes_M == 0

    @property
    def film_oil(self) -> Oil:
        """Oil of an isothermal film."""
        expansion = oil.in_one_temperature(self.oil.expansion, self.keeps_expansion)
        return dataclasses.replace(self.oil, expansion=expansion) if expansion != self.oil.expansion else self.oil

    @property
    def has_thermal_stress(self) -> bool:
        """Whether the surface temperature contributes to the stresses."""
        counts = self.fatigue.thermal_stress
        return not self.isothermal if counts == AUTO else bool(counts)

    def left_out(self, cut: bool = True) -> list[str]:
        """Parts that this scene does not need and does not compute, each with its reason.

        cut: also list the rest of a cut passage, which a warning reports, too.
        """
        return [for_reader(what) for what in left_out.parts(self, cut)]

    def warnings(self) -> list:
        """Warnings about this scene, one sentence each (see :mod:`tehl_taichi.scene.scene_warnings`)."""
        return [for_reader(one) for one in self.typed_warnings]

    @functools.cached_property
    def typed_warnings(self) -> list:
        """The warnings with the options of the command line, as stores keep them."""
        return scene_warnings.warnings(self)

    @property
    def has_fatigue(self) -> bool:
        """Whether the fatigue of the passage is computed."""
        return self.judges_steel and self.transient

    @property
    def judges_steel(self) -> bool:
        """Whether an index is computed: of the passage, or of the smooth contact alone."""
        return self.fatigue.on and bool(self.judged)

    @property
    def judged(self) -> tuple:
        """Surfaces whose material the fatigue search covers: those of fatigue.surfaces that move (one at rest is always under
        load).
        """
        names = moving_surfaces.NAMES if self.fatigue.surfaces == BOTH else (self.fatigue.surfaces,)
        return tuple(s for s, rests in zip(self.surfaces, self.at_rest) if s.name in names and not rests)

    @property
    def without_fatigue(self) -> str:
        """Reason why the scene has no fatigue index, as in :meth:`left_out`; "" if it has one."""
        if self.has_fatigue:
            return ""
        if self.fatigue.on and not self.transient:
            return "fatigue around features (none passes)"
        return f"stresses and fatigue ({f'surface {self.fatigue.surfaces} is at rest' if self.fatigue.on else 'switched off'})"

    def replace(self, **changes: Any) -> "Scene":
        """Return a changed copy.

        Parameters
        ----------
        **changes
            Short names (srr, load, hertz_pressure, speed, temperature, height, width, kappa, endurance, torsion_limit,
            bending_limit, name), or full keys as in a scene file: "grid.nx", "bodies.a.E", "feature.height" (the first
            feature), "feature.1.height" (the second). A whole part may be an object or a table of it: oil=tehl.Oil(...).

        Returns
        -------
        Scene

        Raises
        ------
        SceneError
            The key is unknown (the message proposes the nearest one), the value is out of range, it has no effect on this
            scene, or two changes contradict each other.

        Examples
        --------
        >>> import tehl_taichi as tehl
        >>> tehl.scene("gear").replace(srr=0.2, **{"grid.nx": 128}).operation.srr
        0.2
        >>> tehl.scene("gear").replace(nx=128)
        Traceback (most recent call last):
        ...
        tehl_taichi.errors.SceneError: unknown key nx (did you mean 'grid.nx'?); all ... names: ...
        """
        single = aliases.resolve_named({key: _as_table(key, value) for key, value in changes.items()})
        changed = Scene.from_dict(overrides.apply_changes(self.to_dict(), single))
        parts = {key: value for key, value in changes.items() if isinstance(value, PARTS)}  # their usual values are no user's
        given = {key: value for key, value in single.items() if not key.startswith(tuple(f"{part}." for part in parts))} | parts
        overrides.check_effect(changed, given)
        return replaced_keys.with_changes(self, changed, given)

    def with_user_keys(self, keys: Iterable[str], replaced: Iterable[str] = ()) -> "Scene":
        """This scene, with a record of the keys that the user gave (see :mod:`tehl_taichi.scene.idle_keys`) and warnings about
        replaced ones (see :mod:`tehl_taichi.scene.replaced_keys`).
        """
        object.__setattr__(self, "user_keys", frozenset(keys))
        object.__setattr__(self, "replaced", tuple(replaced))
        self.__dict__.pop("typed_warnings", None)  # they depend on these keys
        return self

    def to_dict(self) -> dict:
        """Nested dictionary of all values, defaults included; its keys are the sections of a scene file."""
        data: dict[str, Any] = {"name": self.name, "note": self.note}
        for key in SECTIONS:
            data[key] = domain.with_auto(dataclasses.asdict(getattr(self, key)))
        data["bodies"] = {"a": dataclasses.asdict(self.body_a), "b": dataclasses.asdict(self.body_b)}
        data["oil"] = dataclasses.asdict(self.oil)
        data["feature"] = [dataclasses.asdict(f) for f in self.features]
        return data

    @classmethod
    def from_dict(cls, data: dict) -> "Scene":
        """Scene from such a dictionary; missing values take their defaults, unknown keys are refused.

        No key counts as given by the user.
        """
        known = {*TOP, "bodies", "oil", "feature", *SECTIONS}
        if not isinstance(data, dict):
            raise SceneError(f"a scene must be a table of sections, not {shown(data)}")
        for key in data:
            if key not in known:
                raise SceneError(f"unknown section or key {shown(key)}{nearest(key, known)}; known: {', '.join(sorted(known))}")
        data = in_units(data)
        parts = {key: build(kind, data[key], key) for key, kind in SECTIONS.items() if key in data
                 and key not in ("operation", "fatigue")}
        if "operation" in data:
            parts["operation"] = build(Operation, of_surfaces(data["operation"]), "operation")
        if "fatigue" in data:
            parts["fatigue"] = Fatigue.from_values(data["fatigue"])
        parts.update(_bodies(data.get("bodies", {})))
        if "oil" in data:
            parts["oil"] = named_oils.from_values(data["oil"])
        if "feature" in data:
            parts["features"] = _features(data["feature"])
        return cls(name=data.get("name", "gear"), note=data.get("note", ""), **parts).with_user_keys(())


def _as_table(key, value):
    """Table of a part that is an object, with None for numbers that follow from others; any other value unchanged."""
    if not isinstance(value, PARTS):
        return value
    follow = idle_keys.FOLLOW[key](vars(value)) if key in idle_keys.FOLLOW else ()
    return {**domain.with_auto(dataclasses.asdict(value)), **dict.fromkeys(follow)}


def _bodies(values):
    if not isinstance(values, dict):
        raise SceneError(f"[bodies] may only hold the tables [bodies.a] and [bodies.b], not {shown(values)}")
    if (key := next((key for key in values if key not in ("a", "b")), None)) is not None:
        example = key if key in kinds(Body) else "E"
        raise SceneError(f"unknown key {key_shown(f'bodies.{key}')}; each body has its own keys, as bodies.a.{example} and "
                         f"bodies.b.{example}")
    return {f"body_{key}": build(Body, value, f"bodies.{key}", "bodies") for key, value in values.items()}


def _features(values):
    if not isinstance(values, (list, tuple)):
        raise SceneError(f"features are written as [[feature]] tables, not {shown(values)}")
    names = ["feature"] if len(values) == 1 else [f"feature.{n}" for n in range(len(values))]
    return tuple(value if isinstance(value, Feature) else build(Feature, value, name, "feature")
                 for name, value in zip(names, values))
