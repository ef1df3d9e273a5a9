"""Declaration of a value of a scene, once where it stands: default, unit, meaning, range.

The checks at the door, the template of `tehl new` and the documents all read the same declaration:
`width: float = quantity(200e-6, "m", "length along x", 1e-6, 0.1)`, and :func:`check` in `__post_init__`.
"""

import dataclasses
import math
from dataclasses import dataclass

from tehl_taichi.values import checks, units
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.unit_hints import meant

AUTO = "auto"


class Kind:
    """Base of what a value can be. about: its meaning; unit: '' where it has none; allowed: its range in words."""

    about: str
    unit: str = ""

    @property
    def allowed(self):
        return ""

    def taken(self, where, value):
        """A value as it is checked and kept; text with a unit becomes a number. Raises SceneError for another unit."""
        return value

    @property
    def sentence(self):
        """Unit, meaning and range in one line."""
        return f"{self.unit}{': ' * bool(self.unit)}{self.about}{f' [{self.allowed}]' if self.allowed else ''}"


@dataclass(frozen=True)
class Number(Kind):
    """A number in its unit; strict: `low` itself is refused; infinite: inf is allowed; usual: one of its order (0: unknown);
    least: the smallest size of one that is not 0, below which it was meant in another unit; common: (low, high), what is
    allowed beyond them is doubted where another unit makes a common value of it; auto: the scene itself decides by default."""

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
        """A sentence about a value that is allowed, but was perhaps meant in another unit; "" where it was not."""
        low, high = self.common or (-math.inf, math.inf)
        if low <= value <= high:
            return ""
        other = meant(value, self.unit, lambda other: low <= other <= high, self.usual)
        return f"{where} = {value:g} {self.unit} is unusual{other}" if other else ""

    def taken(self, where, value):
        return units.in_unit(where, value, self.unit) if isinstance(value, str) else value

    def check(self, where, value):
        if self.auto and isinstance(value, str):
            return checks.word(where, value, AUTO, self)
        checks.number(where, value, self.unit.strip("-"), self.low, self.high, self.strict, self.infinite, self.usual,
                      self.least)

    @property
    def allowed(self):
        """The range in words, '' where there is none."""
        if self.least:
            return f"0 or {self.least:g} to {self.high:g}{' in size' * (self.low < 0)}"
        if self.low > -math.inf and self.high < math.inf:
            return f"{'more than ' if self.strict else ''}{self.low:g} to {self.high:g}{f', or {AUTO}' if self.auto else ''}"
        above = f"{'more than' if self.strict else 'at least'} {self.low:g}" if self.low > -math.inf else ""
        return above or (f"at most {self.high:g}" if self.high < math.inf else "")


@dataclass(frozen=True)
class Numbers(Number):
    """A list of such numbers; with `auto`: the scene itself decides by default."""

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

    about: str
    counts: tuple

    def check(self, where, value):
        if isinstance(value, bool) or checks.plain(value) not in self.counts:
            raise checks.SceneError(f"{where} = {shown(value)} is not one of {self.allowed}")

    @property
    def allowed(self):
        return ", ".join(map(str, self.counts))


@dataclass(frozen=True)
class Choice(Kind):
    """One of some words."""

    about: str
    words: tuple

    def check(self, where, value):
        checks.choice(where, value, self.words)

    @property
    def allowed(self):
        return ", ".join(filter(None, self.words))


@dataclass(frozen=True)
class Switch(Kind):
    """true or false; with `auto`: the scene itself decides by default."""

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
    """Words, at most so many characters; one_line: without line breaks."""

    about: str
    most: int = 500
    one_line: bool = True

    def check(self, where, value):
        checks.text(where, value, self.most, self.one_line)


@dataclass(frozen=True)
class Pairs(Kind):
    """A list of pairs of numbers with rising first numbers: empty, or `fewest` to `most` pairs; jumps: a first number may stand
    twice."""

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
        """Whether each of these is more than the one before (with `jumps`: than the one before that)."""
        apart = 2 if self.jumps else 1
        return firsts == sorted(firsts) and all(a < b for a, b in zip(firsts, firsts[apart:]))

    def refusal(self, where, value):
        """Message about a wrong number of pairs, or about missing pairs."""
        return checks.SceneError(f"{where} has {len(value)} pairs; allowed: {self.allowed}")

    @property
    def allowed(self):
        return f"{self.fewest} to {self.most} pairs, the first numbers rising" + ", or the same twice" * self.jumps


def _declared(default, kind, compare=True):
    return dataclasses.field(default=default, compare=compare, metadata={"kind": kind})


def quantity(default, unit, about, low=-math.inf, high=math.inf, strict=False, infinite=False, usual=0.0, least=0.0,
             common=()):
    """Field of a dataclass: a number in `unit` within low..high, or "auto" where that is the default; usual: one of its order,
    where the default is none; least, common: see :class:`Number`."""
    auto = default == AUTO
    usual = usual or (default if not auto and default is not None and math.isfinite(default) else 0.0)
    return _declared(default, Number(about, unit or "-", low, high, strict, infinite, usual, least, common, auto))


def quantities(default, unit, about, low=-math.inf, high=math.inf, auto=False, usual=0.0):
    """Field: a list of such numbers."""
    return _declared(default, Numbers(about, unit, low, high, usual=usual, auto=auto))


def count(default, about, low, high, multiple=1):
    """Field: a whole number."""
    return _declared(default, Count(about, low, high, multiple))


def count_of(default, about, *counts):
    """Field: one of some whole numbers."""
    return _declared(default, CountOf(about, counts))


def choice(default, about, words):
    """Field: one of `words`."""
    return _declared(default, Choice(about, words))


def switch(default, about, auto=False):
    """Field: true or false, or "auto"."""
    return _declared(default, Switch(about, auto))


def text(default, about, most=500, one_line=True, compare=True):
    """Field: words; compare: whether they make two scenes different."""
    return _declared(default, Text(about, most, one_line), compare)


def pairs(default, about, fewest, most, jumps=False):
    """Field: a list of pairs of numbers, or none."""
    return _declared(default, Pairs(about, fewest, most, jumps))


def kinds(cls):
    """{key: its Number, Count, Choice, ...} of a section of a scene, in the order of its keys."""
    return {f.name: f.metadata["kind"] for f in dataclasses.fields(cls) if "kind" in f.metadata}


def documented(cls):
    """Class decorator: the declared keys become the parameters of its docstring, those that differ from their defaults its
    repr."""
    about, mark, examples = cls.__doc__.partition("\n\n    Examples\n")
    rows = "".join(f"\n    {key} : {_default(cls, key)}\n        {_meaning(kind)}" for key, kind in kinds(cls).items())
    cls.__doc__ = f"{about.rstrip()}\n\n    Parameters\n    ----------{rows}{mark}{examples}"
    cls.__repr__ = _changed
    return cls


def _default(cls, key):
    kind = kinds(cls)[key]
    word = {Numbers: "sequence of float", Number: "float", Count: "int", Switch: "bool", Pairs: "sequence of pairs"}
    auto = f" or '{AUTO}'" if getattr(kind, "auto", False) else ""
    return f"{word.get(type(kind), 'str')}{auto}, default {shown(getattr(cls, key, None))}"


def _meaning(kind):
    unit = f", in {kind.unit}" if kind.unit not in ("", "-") else ""
    return f"{kind.about}{unit}{f' [{kind.allowed}]' if kind.allowed else ''}"


def _changed(part):
    """The call that makes this part, without the keys that have their defaults."""
    given = ((key, getattr(part, key)) for key in kinds(type(part)))
    return f"{type(part).__name__}({', '.join(f'{k}={v!r}' for k, v in given if v != getattr(type(part), k, None))})"


def check(part, section="", **in_unit):
    """Check every value of `part` by its declaration, and keep numbers in place of text with a unit; None is allowed where the
    default is None. in_unit: {key: unit} where a unit depends on other values.

    Raises SceneError: one sentence with the value, the unit and what is allowed.
    """
    checks.normalise(part)
    for key, kind in kinds(type(part)).items():
        kind = dataclasses.replace(kind, unit=in_unit[key]) if key in in_unit else kind
        where, value = f"{section}.{key}".lstrip("."), getattr(part, key)
        if value is not None or getattr(type(part), key) is not None:
            if (found := kind.taken(where, value)) is not value:
                object.__setattr__(part, key, found)
            kind.check(where, found)
