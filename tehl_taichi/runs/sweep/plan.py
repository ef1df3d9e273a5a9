"""Plan of a sweep: a scene, the keys that change and their values; its cases, and those that the scene refuses."""

import contextlib
import hashlib
import json
import math
from dataclasses import dataclass, field

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.sweep import axis_syntax
from tehl_taichi.runs.sweep.sampling import interval, latin_hypercube
from tehl_taichi.scene import Scene, aliases, idle_keys
from tehl_taichi.scene.unit_texts import column_in_units
from tehl_taichi.values.checks import table
from tehl_taichi.values.coded_warning import counted, lists
from tehl_taichi.values.coerce import plain, shown
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.quantity import kinds

LOOKED_AT = 100  # cases of a larger plan whose warnings and idle keys are looked at, 30 ms each
MOST = 100_000  # cases: more are a mistake in a range
ONE = "case"  # the dimension of a study whose keys change together


@dataclass(frozen=True)
class Plan:
    """Cases, numbered from 0 in the order of the axes, the last axis fastest. Raises SceneError.

    scene: of every case before its changes; axes: tuple of :class:`tehl_taichi.runs.sweep.axis_syntax.Axis`; drawn: how they
    were sampled ({"samples", "seed"}), or None.
    """

    scene: Scene
    axes: tuple
    drawn: dict = field(default_factory=dict)
    _cases: dict = field(default_factory=dict, init=False, repr=False, compare=False)
    _known: dict = field(default_factory=dict, init=False, repr=False, compare=False)  # what looking at all cases gave

    def __post_init__(self):
        if not self.axes:
            raise SceneError("--over needs a key and its values, such as srr and -0.3:0.3:7")
        names = [aliases.full_name(key) for key in self.keys]
        for key, name in zip(self.keys, names):
            if names.count(name) > 1:
                raise SceneError(f"{key} is swept twice: give all its values in one --over")
        if self.count > MOST:
            raise SceneError(f"{self.count} cases are too many; allowed: at most {MOST}")

    @property
    def keys(self):
        """All keys, as the user wrote them."""
        return tuple(key for axis in self.axes for key in axis.keys)

    @property
    def gridded(self):
        """Whether each key has its own dimension; otherwise all cases lie along one, `case`."""
        return not self.drawn and all(len(axis.keys) == 1 for axis in self.axes)

    @property
    def dims(self):
        return self.keys if self.gridded else (ONE,)

    @property
    def shape(self):
        return tuple(len(axis.rows) for axis in self.axes) if self.gridded else (self.count,)

    @property
    def count(self):
        return math.prod(len(axis.rows) for axis in self.axes)

    @property
    def name(self):
        """Name of the scene with six digits that identify the plan; 5 and 5.0 are one value."""
        text = self._text(axis_syntax.real, note="")
        return f"{self.scene.name}-sweep-{hashlib.sha256(text.encode()).hexdigest()[:6]}"

    @property
    def text(self):
        """JSON text of the plan."""
        return self._text()

    def _text(self, written=lambda value: value, **other):
        """Text of the plan with other values of the scene. written: function of a value of an axis."""
        axes = [{"keys": axis.keys, "rows": [[written(value) for value in row] for row in axis.rows]} for axis in self.axes]
        return json.dumps({"scene": {**self.scene.to_dict(), **other}, "axes": axes, "drawn": self.drawn}, sort_keys=True)

    def matches(self, text):
        """Whether a text is of this plan; a different note and keys of newer versions do not matter."""
        try:
            return type(self).from_text(text) == self
        except (ValueError, KeyError, TypeError):
            return False

    @classmethod
    def from_text(cls, text):
        """Plan of such a text. Raises SceneError."""
        data = json.loads(text)
        axes = tuple(axis_syntax.Axis(tuple(axis["keys"]), _tuples(axis["rows"])) for axis in data["axes"])
        return cls(Scene.from_dict(data["scene"]), axes, data["drawn"])

    def positions(self, number):
        """Step number of each axis in a case."""
        out = []
        for axis in reversed(self.axes):
            number, position = divmod(number, len(axis.rows))
            out.append(position)
        return out[::-1]

    def changes(self, number):
        """{key: value} of a case."""
        return {key: value for axis, n in zip(self.axes, self.positions(number)) for key, value in axis.changes(n).items()}

    def case(self, number):
        """Scene of a case; cached while a plan is searched. Raises SceneError."""
        if number not in self._cases:
            found = self.scene.replace(**self.changes(number))
            if self.is_large:
                return found
            self._cases[number] = found
        return self._cases[number]

    def coordinate(self, key):
        """(dimension, values along it) of a key."""
        axis = next(axis for axis in self.axes if key in axis.keys)
        if self.gridded:
            return key, [row[0] for row in axis.rows]
        return ONE, [self.changes(n)[key] for n in range(self.count)]

    def refused(self):
        """{case: reason} of the cases that the scene refuses. Raises SceneError if a value is refused for all other keys: that
        is a mistake.
        """
        found = dict(self._look()[0])
        for axis in self.axes if found and self.gridded else ():
            self._check_values(axis, found)
        if len(found) == self.count:
            raise SceneError(found[0])
        self._check_effect(found)
        return found

    def _look(self):
        """({case: reason} of the refused cases, [numbers of the isothermal ones]), found once."""
        if not self._known:
            refused, isothermal = {}, []
            for number in range(self.count):
                try:
                    isothermal += [number] * self.case(number).isothermal
                except SceneError as error:
                    refused[number] = str(error)
            self._known["all"] = refused, isothermal
        return self._known["all"]

    def _check_effect(self, refused):
        """Raise SceneError for a key without effect in any case: all its rows would be equal."""
        for key in self.keys:
            if len({repr(self.changes(number)[key]) for number in range(self.count)}) > 1 and (why := self._idle(key, refused)):
                raise SceneError(f"{key} has no effect here: {why}; the cases would be equal")

    def _idle(self, key, refused):
        """Reason why a key has no effect, if that holds in every valid case; else ""."""
        why = ""
        for number in (n for n in range(self.count) if n not in refused):
            scene = self.case(number)
            why = idle_keys.idle(scene).get(aliases.full_name(key), "")
            if not why:
                break
        return why

    def doubts(self):
        """Sentences about keys, set or swept, without effect in any case; of a large plan, in any case looked at."""
        every = [list(idle_keys.doubts(scene)) for scene in self.scenes_looked_at()]
        return [sentence for sentence in every[0] if all(sentence in other for other in every)] if every else []

    def warnings(self):
        """Warnings of the cases known before their runs, except those about keys without effect: the first of every kind, with
        the number of its cases. Of a large plan, some cases are looked at.
        """
        scenes = list(self.scenes_looked_at())
        summaries = ((n, lists(one for one in scene.warnings() if one.code != "idle")) for n, scene in enumerate(scenes))
        return counted(summaries, f"{number_of(len(scenes), 'case')}{' looked at' * self.is_large}")

    @property
    def is_large(self):
        """Whether only some cases are looked at: more would take longer than a case."""
        return self.count > LOOKED_AT

    def scenes_looked_at(self):
        """Generator of the scenes of all cases, without refused ones; of a large plan, of cases drawn at random: cases at equal
        distances could all have one value of the last key.
        """
        numbers = np.random.default_rng(0).permutation(self.count)[:LOOKED_AT] if self.is_large else range(self.count)
        for number in sorted(map(int, numbers)):
            with contextlib.suppress(SceneError):
                yield self.case(number)

    def equal(self):
        """{case: earlier case} of cases that differ only in keys without effect; {} for a large plan."""
        seen: dict[str, int] = {}
        found = {}
        for number in range(0 if self.is_large else self.count):
            with contextlib.suppress(SceneError):
                first = seen.setdefault(repr(idle_keys.signature(self.case(number))), number)
                if first != number:
                    found[number] = first
        return found

    def without_temperatures(self):
        """Numbers of the isothermal cases if other cases are thermal; [] if all are alike."""
        refused, isothermal = self._look()
        return isothermal if len(isothermal) < self.count - len(refused) else []

    def _check_values(self, axis, found):
        place = self.axes.index(axis)
        bad = [self.positions(number)[place] for number in found]
        for n in dict.fromkeys(bad):
            if bad.count(n) == self.count // len(axis.rows):
                raise SceneError(next(reason for number, reason in found.items() if self.positions(number)[place] == n))


def plan(scene, over, samples=None, seed=None):
    """Plan of `over`: {key: values}; a tuple of keys has rows of values, which change together.

    values: a list, an array, a text as for --over. With `samples` (a Latin hypercube of this many cases): "low:high",
    "low:high:log", a tuple (low, high), or a list to choose from. Raises SceneError.

    >>> from tehl_taichi.scene import scene
    >>> found = plan(scene("gear"), {"srr": [-0.1, 0.1], "feature.height": "0.5e-6:1.5e-6:3"})
    >>> found.dims, found.shape, found.changes(5)
    (('srr', 'feature.height'), (2, 3), {'srr': 0.1, 'feature.height': 1.5e-06})
    """
    table("over", over, "{key: values}, as in {'srr': [0.0, 0.1]}")
    for keys in over:
        if not (isinstance(keys, str) or isinstance(keys, tuple) and keys and all(isinstance(key, str) for key in keys)):
            raise SceneError(f"over has the key {shown(keys)}; allowed: a name, as 'srr', or a tuple of names")
    if samples is None and seed is not None:
        raise SceneError(f"seed = {shown(seed)} has no effect without samples")
    seed = 0 if seed is None else seed
    if samples is None:
        return Plan(scene, tuple(_axis(scene, keys, rows) for keys, rows in over.items()))
    columns = {key: _numbers(scene, key, _choices(key, found)) for key, found in over.items()}
    whole = {key for key in columns if isinstance(_present(scene, key), int)}
    axes = (latin_hypercube(columns, samples, seed, whole),) if columns else ()
    return Plan(scene, axes, {"samples": int(samples), "seed": int(seed)})


def _axis(scene, keys, rows):
    if isinstance(keys, str):
        return axis_syntax.axis([keys], [_numbers(scene, keys, axis_syntax.column(rows))])
    try:
        rows = [axis_syntax.column(list(row)) for row in plain(rows)]
    except TypeError:  # a number in place of a row, or of the rows
        rows = [[]]
    if any(len(row) != len(keys) for row in rows):
        raise SceneError(f"{', '.join(keys)}: every row needs {number_of(len(keys), 'value')}")
    return axis_syntax.axis(list(keys), [_numbers(scene, key, list(column)) for key, column in zip(keys, zip(*rows))])


def _numbers(scene, key, column):
    """Values of a key, or its span, with numbers in place of texts with a unit. Raises SceneError."""
    full = aliases.full_name(key)
    if isinstance(column, axis_syntax.Span):
        return column.converted(lambda ends: column_in_units(scene, full, ends))
    return column_in_units(scene, full, column)


def _choices(key, found):
    if not isinstance(key, str):
        raise SceneError(f"{', '.join(key)} change together; samples need independent keys")
    return axis_syntax.column(interval(key, found) or found)


def unit(scene, key):
    """Unit of a key, "1" without one."""
    section, _, name = aliases.full_name(key).partition(".")
    if (section, name) == ("contact", "load"):
        return scene.load_unit
    if section + "." + name in aliases.BY_SURFACE:
        return "m/s"
    try:
        return (kinds(type(_part(scene, section, name)))[name.rpartition(".")[2]].unit or "1").replace("-", "1")
    except (KeyError, AttributeError, TypeError, ValueError, IndexError):
        return "1"


def _part(scene, section, name):
    if section == "feature":
        return scene.features[int(name.partition(".")[0])]
    return getattr(scene, f"body_{name[0]}") if section == "bodies" else getattr(scene, section)


def _present(scene, key):
    """Value of a key in the scene, None if the scene uses another key for it."""
    section, _, name = aliases.full_name(key).partition(".")
    try:
        return getattr(_part(scene, section, name), name.rpartition(".")[2])
    except (AttributeError, ValueError, IndexError):
        return None


def _tuples(row):
    return tuple(_tuples(value) if isinstance(value, list) else value for value in row)
