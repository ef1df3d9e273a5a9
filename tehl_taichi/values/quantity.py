"""Declaration of a scene value, once in its class: default, unit, meaning, range.

Input checks, the template of `tehl new` and the documentation read the same declaration: `width: float = quantity(200e-6, "m",
"length along x", 1e-6, 0.1)`, and :func:`check` in `__post_init__`.
"""

import dataclasses
import functools
import inspect
import math
from dataclasses import dataclass
from typing import dataclass_transform

from tehl_taichi.values import checks, units
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.unit_hints import hint

AUTO = "auto"


class Kind:
    """Base of the kinds of values. word: their type in Python; about: meaning; unit: '' without one; allowed: text of the
    range.
    """

    word = "str"
    about: str
    unit: str = ""

    @property
    def allowed(self):
        return ""

    def taken(self, where, value):
        """Checked value; text with a unit becomes a number. Raises SceneError for a wrong unit."""
        return value

    @property
    def sentence(self):
        """Unit, meaning and range in one line."""
        return f"{self.unit}{': ' * bool(self.unit)}{self.about}{f' [{self.allowed}]' if self.allowed else ''}"


@dataclass(frozen=True)
class Number(Kind):
    """A number with a unit.

    strict: `low` itself is refused; infinite: inf is allowed; usual: a value of the usual order (0: unknown); least: smallest
    size except 0, below which another unit was meant; common: (low, high), values beyond are doubted if they are common in
    another unit; auto: the default is "auto".
    """

    word = "float"
    about: str
    unit: str = "-"
    low: float = -math.inf
    high: float = math.inf
    strict: bool = False
    infinite: bool = False
    usual: float = 0.0
    least: float = 0.0
    common: tuple = ()
    auto: bool = False

    def doubted(self, where, value):
        """Sentence about an allowed value that was perhaps meant in another unit, or ""."""
        low, high = self.common or (-math.inf, math.inf)
        if low <= value <= high:
            return ""
        other = hint(value, self.unit, lambda other: low <= other <= high, self.usual)
        return f"{where} = {value:g} {self.unit} is unusual{other}" if other else ""

    def taken(self, where, value):
        return units.in_unit(where, value, self.unit) if isinstance(value, str) else value

    def read(self, where, text, factor=1.0):
        """Checked number of a cell of a table, times the factor. Raises SceneError."""
        try:
            value = float(text) * factor
        except (TypeError, ValueError):
            raise checks.SceneError(f"{where} = {shown(text)} is not a number; allowed: {self.allowed} {self.unit}") from None
        self.check(where, value)
        return value

    def check(self, where, value):
        if self.auto and isinstance(value, str):
            return checks.word(where, value, AUTO, self)
        checks.number(where, value, self.unit.strip("-"), self.low, self.high, self.strict, self.infinite, self.usual,
                      self.least)

    @property
    def allowed(self):
        """Text of the range, '' without one."""
        if self.least:
            return f"0 or {self.least:g} to {self.high:g}{' in size' * (self.low < 0)}"
        if self.low > -math.inf and self.high < math.inf:
            return f"{'more than ' if self.strict else ''}{self.low:g} to {self.high:g}{f', or {AUTO}' if self.auto else ''}"
        above = f"{'more than' if self.strict else 'at least'} {self.low:g}" if self.low > -math.inf else ""
        return above or (f"at most {self.high:g}" if self.high < math.inf else "")


@dataclass(frozen=True)
class Numbers(Number):
    """A list of such numbers; auto: the default is "auto"."""

    word = "sequence of float"

    def taken(self, where, value):
        if not isinstance(value, (tuple, list)):
            return value
        return type(value)(super(Numbers, self).taken(where, entry) for entry in value)

    def check(self, where, value):
        if self.auto and isinstance(value, str) and value == AUTO:
            return
        if not isinstance(value, (tuple, list)):
            either = f"{AUTO!r} or " if self.auto else ""
            raise checks.SceneError(f"{where} = {shown(value)} must be {either}a list of numbers in {self.unit}")
        for entry in value:
            super().check(where, entry)


@dataclass(frozen=True)
class Count(Kind):
    """A whole number from low to high, a multiple of `multiple`."""

    word = "int"
    about: str
    low: int
    high: int
    multiple: int = 1

    def check(self, where, value):
        checks.integer(where, value, self.low, self.high)
        if value % self.multiple:
            raise checks.SceneError(f"{where} = {value} must be a multiple of {self.multiple}, so that coarser grids exist")

    @property
    def allowed(self):
        return f"{self.low} to {self.high}" + (f" in steps of {self.multiple}" if self.multiple > 1 else "")


@dataclass(frozen=True)
class CountOf(Kind):
    """One of some whole numbers."""

    word = "int"
    about: str
    counts: tuple

    def check(self, where, value):
        if isinstance(value, (bool, float)) or value not in self.counts:  # 4.0 is no number of cells
            raise checks.SceneError(f"{where} = {shown(value)} is not one of {self.allowed}")

    @property
    def allowed(self):
        return ", ".join(map(str, self.counts))


@dataclass(frozen=True)
class Choice(Kind):
    """One of several words."""

    about: str
    words: tuple

    def check(self, where, value):
        checks.choice(where, value, self.words)

    @property
    def allowed(self):
        return ", ".join(filter(None, self.words))


@dataclass(frozen=True)
class Switch(Kind):
    """true or false; auto: the default is "auto"."""

    word = "bool"
    about: str
    auto: bool = False

    def check(self, where, value):
        if not (self.auto and isinstance(value, str) and value == AUTO):
            checks.flag(where, value, AUTO if self.auto else "")

    @property
    def allowed(self):
        return f"true, false or {AUTO}" if self.auto else "true or false"


@dataclass(frozen=True)
class Text(Kind):
    """Text of limited length; one_line: without line breaks."""

    about: str
    most: int = 500
    one_line: bool = True

    def check(self, where, value):
        checks.text(where, value, self.most, self.one_line)


@dataclass(frozen=True)
class Pairs(Kind):
    """A list of pairs of numbers with rising first numbers: empty, or `fewest` to `most` pairs; jumps: a first number may occur
    twice.
    """

    word = "sequence of pairs"
    about: str
    fewest: int
    most: int
    jumps: bool = False

    def check(self, where, value):
        if not isinstance(value, (tuple, list)) or not all(isinstance(q, (tuple, list)) and len(q) == 2 for q in value):
            raise checks.SceneError(f"{where} = {shown(value)} must be a list of pairs; {self.about}")
        for pair in value:
            for entry in pair:
                checks.number(where, entry)
        if value and not (self.fewest <= len(value) <= self.most and self._rises([pair[0] for pair in value])):
            raise self.refusal(where, value)

    def _rises(self, firsts):
        """Whether the numbers rise (with `jumps`: each is greater than the last but one)."""
        apart = 2 if self.jumps else 1
        return firsts == sorted(firsts) and all(a < b for a, b in zip(firsts, firsts[apart:]))

    def refusal(self, where, value):
        """Message about a wrong number of pairs, or about missing pairs."""
        return checks.SceneError(f"{where} has {number_of(len(value), 'pair')}; allowed: {self.allowed}")

    @property
    def allowed(self):
        return f"{self.fewest} to {self.most} pairs, the first numbers rising" + ", or the same twice" * self.jumps


def _declared(default, kind, compare=True):
    return dataclasses.field(default=default, compare=compare, metadata={"kind": kind})


def quantity(default, unit, about, low=-math.inf, high=math.inf, strict=False, infinite=False, usual=0.0, least=0.0,
             common=()):
    """Dataclass field: a number in `unit` within low..high, or "auto" if that is the default; other arguments: see
    :class:`Number`.
    """
    auto = default == AUTO
    usual = usual or (default if not auto and default is not None and math.isfinite(default) else 0.0)
    return _declared(default, Number(about, unit or "-", low, high, strict, infinite, usual, least, common, auto))


def quantities(default, unit, about, low=-math.inf, high=math.inf, auto=False, usual=0.0):
    """Dataclass field: a list of such numbers."""
    return _declared(default, Numbers(about, unit, low, high, usual=usual, auto=auto))


def count(default, about, low, high, multiple=1):
    """Dataclass field: a whole number."""
    return _declared(default, Count(about, low, high, multiple))


def count_of(default, about, *counts):
    """Field: one of some whole numbers."""
    return _declared(default, CountOf(about, counts))


def choice(default, about, words):
    """Dataclass field: one of `words`."""
    return _declared(default, Choice(about, words))


def switch(default, about, auto=False):
    """Dataclass field: true or false, or "auto"."""
    return _declared(default, Switch(about, auto))


def text(default, about, most=500, one_line=True, compare=True):
    """Dataclass field: text; compare: scenes with different texts are different."""
    return _declared(default, Text(about, most, one_line), compare)


def pairs(default, about, fewest, most, jumps=False):
    """Dataclass field: a list of pairs of numbers, or none."""
    return _declared(default, Pairs(about, fewest, most, jumps))


def kinds(cls):
    """{key: its Number, Count, Choice, ...} of a section of a scene, in the order of its keys."""
    return {f.name: f.metadata["kind"] for f in dataclasses.fields(cls) if "kind" in f.metadata}


@dataclass_transform(frozen_default=True)
def documented(cls):
    """Class decorator: makes a frozen dataclass; adds the declared keys to the docstring as parameters; the repr shows the keys
    that differ from their defaults; an unknown key is refused (:func:`known_keys`).
    """
    cls = dataclasses.dataclass(frozen=True, repr=False)(cls)
    about, mark, examples = cls.__doc__.partition("\n\n    Examples\n")
    rows = "".join(f"\n    {key} : {_default(cls, key)}\n        {_meaning(kind)}" for key, kind in kinds(cls).items())
    cls.__doc__ = f"{about.rstrip()}\n\n    Parameters\n    ----------{rows}{mark}{examples}"
    cls.__repr__ = _changed
    return known_keys(cls)


def known_keys(cls):
    """Class decorator of a dataclass: its constructor refuses an unknown key, and names the nearest one. A static method
    `_completed` of the class adds values that follow from the given ones.
    """
    made, signature, complete = cls.__init__, inspect.signature(cls), getattr(cls, "_completed", dict)

    @functools.wraps(made)
    def init(self, *values, **given):
        if unknown := given.keys() - signature.parameters.keys():
            raise checks.SceneError(checks.unknown_key(cls.__name__, min(unknown), list(signature.parameters)))
        made(self, **complete(signature.bind(*values, **given).arguments))

    cls.__init__ = init
    return cls


def _default(cls, key):
    kind = kinds(cls)[key]
    auto = f" or '{AUTO}'" if getattr(kind, "auto", False) else ""
    return f"{kind.word}{auto}, default {shown(getattr(cls, key, None))}"


def _meaning(kind):
    unit = f", in {kind.unit}" if kind.unit not in ("", "-") else ""
    return f"{kind.about}{unit}{f' [{kind.allowed}]' if kind.allowed else ''}"


def _changed(part):
    """Text of the call that makes this part, without default values."""
    given = ((key, getattr(part, key)) for key in kinds(type(part)))
    return f"{type(part).__name__}({', '.join(f'{k}={v!r}' for k, v in given if v != getattr(type(part), k, None))})"


def check(part, section="", **in_unit):
    """Check every value of `part` by its declaration; texts with a unit become numbers, None is allowed if it is the default.

    in_unit: {key: unit} for units that depend on other values. Raises SceneError: one sentence with the value, the unit and the
    allowed range.
    """
    checks.normalise(part)
    for key, kind in kinds(type(part)).items():
        kind = dataclasses.replace(kind, unit=in_unit[key]) if key in in_unit else kind
        where, value = f"{section}.{key}".lstrip("."), getattr(part, key)
        if value is not None or getattr(type(part), key) is not None:
            if (found := kind.taken(where, value)) is not value:
                object.__setattr__(part, key, found)
            kind.check(where, found)
